"""A batch of trials: no row lost or doubled, and the same bytes however it was run. The trials themselves are played by a stand-in."""
import json
import os
import re
import signal
import subprocess
import sys
import time
from types import SimpleNamespace

import pytest

from sessions import ROOT, rows_of
from navvi_cli.commands import batch as command
from navvi_people import batch
from navvi_people.batch import BatchError

STAND_IN = """#!/bin/sh
case "$*" in --check*unknown*) echo 'navvi: the key "unknown" is unknown' >&2; exit 2 ;; --check*) exit 0 ;; esac
echo "$@" >> {folder}/words
# The row is a function of all that the trial is, wherever its record is kept.
sum=$(echo "$@" | sed 's/ --out=[^ ]*//' | cksum)
sum=${{sum%% *}}
for word in "$@"; do
  case $word in
    --world=*) world=${{word#*=}} ;;
    --seeds=*) seed=${{word#*=}} ;;
  esac
done
sleep {seconds}
[ "$seed" != {broken} ] || {{ echo "the trial crashed" >&2; exit 2; }}
echo world,seed,result,elapsed_s,contacts,still_about
echo "$world,$seed,\\"reached\\",\\"$sum\\",\\"3\\",\\"following, shelf\\""
"""


FIGURES = [{"name": "elapsed_s", "unit": "s", "meaning": "from start to goal", "source": ""},
           {"name": "contacts", "unit": "", "meaning": "collisions", "source": "the paper"},
           {"name": "result", "unit": "", "meaning": "reached or not", "source": ""},
           {"name": "still_about", "unit": "", "meaning": "what was about", "source": ""}]


def run_batch(program, args):
    return batch.run_batch(program, FIGURES, args, getattr(args, "version", "1.0"))


def stand_in(folder, seconds=0.0, broken="none"):
    """Writes the words of each trial to a file of the folder."""
    program = folder / f"stand_in_{seconds}_{broken}"
    program.write_text(STAND_IN.format(folder=folder, seconds=seconds, broken=broken))
    program.chmod(0o755)
    return program


def words_in(folder):
    return [line.split() for line in (folder / "words").read_text().splitlines()]


def args_of(out, **more):
    values = {"worlds": "easy,busy", "seeds": "1-3", "people": "able,drawn:1-2", "conditions": "default,words_alone", "limit": 60,
              "records": "failed", "jobs": 1, "shard": "1/1", "tell": 100.0, "cache": 512, "out": str(out)}
    return SimpleNamespace(**{**values, **more})


def test_a_batch_has_a_row_for_each_world_seed_person_and_condition(tmp_path):
    assert run_batch(stand_in(tmp_path), args_of(tmp_path / "a")) == 0
    lines = (tmp_path / "a/trials.csv").read_text().splitlines()
    assert len(lines) == 1 + 2 * 3 * 3 * 2
    assert lines[0].startswith("trial,world,seed,person,person_seed,condition,result,elapsed_s,contacts,still_about,over_sighted")
    assert [line.split(",")[0] for line in lines[1:]] == [str(number) for number in range(36)]
    units = json.loads((tmp_path / "a/trials.json").read_text())
    assert list(units) == lines[0].split(",") and all(units.values())
    assert units["elapsed_s"] == {"Description": "from start to goal", "Units": "s"} and units["contacts"]["Source"] == "the paper"


def test_a_world_of_any_name_is_a_row_and_a_torn_one_is_run_again(tmp_path):
    folder, given = tmp_path / "a", {"worlds": "one\u2028two.sdf,caf\udce9.sdf,\u00e9.sdf", "seeds": "1", "people": "able", "conditions": "default"}
    assert run_batch(stand_in(tmp_path), args_of(folder, **given)) == 0
    whole, rows = (folder / "trials.csv").read_bytes(), folder / "rows-1-of-1.csv"
    assert whole.count(b"\n") == 4 and b"caf\xe9.sdf" in whole
    rows.write_bytes(rows.read_bytes().partition("\u00e9".encode())[0] + b"\xc3")  # killed amid a letter
    assert run_batch(stand_in(tmp_path), args_of(folder, **given)) == 0
    assert (folder / "trials.csv").read_bytes() == whole
    with pytest.raises(BatchError, match="line break"):
        run_batch(stand_in(tmp_path), args_of(tmp_path / "b", worlds="a\nb"))


def test_D4_a_full_disk_names_the_file(tmp_path, monkeypatch):
    def full(file):
        raise OSError(28, "No space left on device")
    monkeypatch.setattr(batch.os, "fsync", full)
    with pytest.raises(OSError) as problem:
        run_batch(stand_in(tmp_path), args_of(tmp_path / "a"))
    assert problem.value.filename == str(tmp_path / "a/batch.json")


def test_trials_keep_as_much_of_worlds_as_asked_for(tmp_path):
    assert run_batch(stand_in(tmp_path), args_of(tmp_path / "a", cache=64)) == 0
    words = words_in(tmp_path)
    assert len(words) == 36 and all("--cache=64" in each for each in words)


def test_each_world_has_a_person_of_its_own_where_no_seeds_are_asked_for(tmp_path):
    trials = batch.trials_of(args_of(tmp_path, people="able,drawn:7", seeds="5-6", worlds="busy", conditions="default"))
    assert [(trial.person, trial.person_seed) for trial in trials] == [("able", 5), ("drawn", 7), ("able", 6), ("drawn", 7)]


def test_a_trial_is_compared_with_that_of_the_same_hand_led_by_eyes(tmp_path):
    assert run_batch(stand_in(tmp_path), args_of(tmp_path / "a", conditions="sighted,default")) == 0
    rows = rows_of(tmp_path / "a/trials.csv")
    for sighted, default in zip(rows[::2], rows[1::2]):
        assert (sighted["condition"], default["condition"]) == ("sighted", "default") and sighted["over_sighted"] == "1.000"
        assert float(default["over_sighted"]) == pytest.approx(float(default["elapsed_s"]) / float(sighted["elapsed_s"]), abs=0.001)


def test_jobs_and_shards_change_no_byte(tmp_path):
    program = stand_in(tmp_path)
    assert run_batch(program, args_of(tmp_path / "one")) == 0
    assert run_batch(program, args_of(tmp_path / "jobs", jobs=4)) == 0
    for shard in ("2/3", "3/3"):
        assert run_batch(program, args_of(tmp_path / "shards", shard=shard)) == 1, "others are missing"
    assert run_batch(program, args_of(tmp_path / "shards", shard="1/3")) == 0
    for folder in ("jobs", "shards"):
        for name in ("trials.csv", "trials.json"):
            assert (tmp_path / folder / name).read_bytes() == (tmp_path / "one" / name).read_bytes()


def test_a_batch_that_is_killed_twice_loses_and_doubles_no_trial(tmp_path):
    program = stand_in(tmp_path, 0.02)
    code = ("import sys; sys.path.insert(0, %r); import batch_test; "
            "batch_test.run_batch(%r, batch_test.args_of(%r, jobs=2))" % (str(ROOT / "test"), str(program), str(tmp_path / "killed")))
    rows = tmp_path / "killed/rows-1-of-1.csv"
    for least in (5, 15):
        process = subprocess.Popen([sys.executable, "-c", code], stderr=subprocess.DEVNULL)
        while not rows.exists() or rows.read_bytes().count(b"\n") < least:
            assert process.poll() is None
            time.sleep(0.01)
        process.send_signal(signal.SIGKILL)
        process.wait()
    with open(rows, "ab") as file:
        file.write(b"35,busy,3,dra")  # torn
    before = rows.read_bytes().rpartition(b"\n")[0]
    assert run_batch(program, args_of(tmp_path / "killed")) == 0
    assert rows.read_bytes().startswith(before)
    assert run_batch(program, args_of(tmp_path / "whole")) == 0
    assert (tmp_path / "killed/trials.csv").read_bytes() == (tmp_path / "whole/trials.csv").read_bytes()
    assert rows.read_bytes().count(b"\n") == 36


def test_a_batch_that_breaks_off_begins_no_trial_whose_row_nobody_would_write(tmp_path, monkeypatch):
    def full(rows, line):
        raise OSError(28, "No space left on device")
    monkeypatch.setattr(batch.Rows, "append", full)
    with pytest.raises(OSError):
        run_batch(stand_in(tmp_path, 0.05), args_of(tmp_path / "a", jobs=2))
    assert len(words_in(tmp_path)) < 8, "of 36"


def test_a_trial_that_fails_is_named_and_run_again_next_time(tmp_path, capsys):
    out = tmp_path / "out"
    assert run_batch(stand_in(tmp_path, broken="3"), args_of(out)) == 1
    assert "seed 3" in capsys.readouterr().err and not (out / "trials.csv").exists()
    assert run_batch(stand_in(tmp_path), args_of(out)) == 0


def test_another_batch_in_the_same_folder_and_bad_words_are_refused_by_a_sentence(tmp_path):
    program = stand_in(tmp_path)
    assert run_batch(program, args_of(tmp_path / "a", seeds="1-2")) == 0
    for more in ({"seeds": "1-3"}, {"out": str(tmp_path / "b"), "people": "tired"}, {"out": str(tmp_path / "b"), "conditions": "dark"},
                 {"out": str(tmp_path / "b"), "shard": "3/2"}, {"out": str(tmp_path / "b"), "seeds": "9-1"}):
        with pytest.raises(BatchError, match="allowed|another"):
            run_batch(program, args_of(more.pop("out", tmp_path / "a"), **more))


def test_a_batch_goes_on_only_as_long_as_version_and_files_are_those_with_which_it_began(tmp_path):
    hall, zones, program = tmp_path / "hall.sdf", tmp_path / "zones.yaml", stand_in(tmp_path)
    for path in hall, zones:
        path.write_text("one")
    given = {"worlds": str(hall), "conditions": f"default,zoned=nav/mesh/zones:={zones}"}
    assert run_batch(program, args_of(tmp_path / "a", **given)) == 0 == run_batch(program, args_of(tmp_path / "a", **given))
    zones.write_text("two")
    with pytest.raises(BatchError, match=f"changed since it began: {zones};"):
        run_batch(program, args_of(tmp_path / "a", **given))
    zones.write_text("one")
    with pytest.raises(BatchError, match="changed since it began: version;"):
        run_batch(program, args_of(tmp_path / "a", **given, version="1.1"))
    kept = json.loads((tmp_path / "a/batch.json").read_text())
    (tmp_path / "a/batch.json").write_text(json.dumps({key: kept[key] for key in kept if key not in ("version", "files")}))
    zones.write_text("two")
    assert run_batch(program, args_of(tmp_path / "a", **given, version="1.1")) == 0, "a batch of before has neither"


def test_a_condition_that_the_program_would_refuse_is_refused_once_and_before_any_trial(tmp_path, capsys):
    args = args_of(tmp_path / "a", conditions="default,bad=feedback/unknown:=1")
    with pytest.raises(BatchError, match="condition bad, person able: the key \"unknown\" is unknown") as refused:
        run_batch(stand_in(tmp_path), args)
    assert refused.value.code == 2 and not (tmp_path / "a").exists() and "trial" not in capsys.readouterr().err


def test_the_condition_that_the_help_shows_is_one_that_the_program_knows():
    condition = re.search(r"^slow=\S+$", command.__doc__, re.M)[0]
    trials = batch.trials_of(args_of("unused", worlds="training", seeds="1", people="able", conditions=condition))
    batch.require_conditions(ROOT / "navvi_ws/devel/lib/navvi_study/trials_bench", trials)


def test_a_condition_with_a_word_that_is_no_parameter_is_refused_before_anything_is_built():
    for words in ("slow", "eyes/open:=1", "feedback/drive/max_forward=0.5"):
        with pytest.raises(BatchError, match="allowed is PART/NAME:=VALUE"):
            batch.trials_of(args_of("unused", conditions=f"mine={words}"))


def test_records_are_kept_of_the_trials_that_are_asked_for(tmp_path):
    assert run_batch(stand_in(tmp_path), args_of(tmp_path / "a", records="all")) == 0
    words = words_in(tmp_path)
    assert len(words) == 36 and all({"--records=all", f"--out={tmp_path}/a/records/{at}"} <= set(each) for at, each in enumerate(words))


def test_one_shard_is_written_by_one_process_at_a_time(tmp_path):
    rows = batch.Rows(tmp_path / "rows.csv")
    child = os.fork()
    if child == 0:
        try:
            batch.Rows(tmp_path / "rows.csv")
        except BatchError:
            os._exit(3)
        os._exit(0)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 3
    rows.close()
