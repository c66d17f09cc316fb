"""A study of two simulated participants, two conditions and one world each, run live to its end and killed amid it."""
import json
import os
import signal
import subprocess
from pathlib import Path

import pytest

from sessions import ROOT, eventually, rows_of

PLAN = """
study: tiny
title: A tiny study
groups: {all: {participants: sub-01..sub-02}}
conditions: {full: {}, plain: {touch: false}}
worlds:
  sets: {a: {world: training, seeds: [3]}, b: {world: training, seeds: [4]}}
  reserve: {world: training, seeds: 11..14}
operator: simulated
limit: 120
questionnaires: {after_condition: [tlx]}
outcomes: {primary: {measure: time, conditions: [plain, full]}}
exclusions: [{column: result, is: [aborted, invalid], reason: the trial broke off}]
"""


class Study:
    def __init__(self, folder):
        self.plan = folder / "tiny.yaml"
        self.plan.write_text(PLAN)
        self.folder = folder / "tiny"

    def begin(self, *words):
        return subprocess.Popen([str(ROOT / "navvi"), "study", words[0], str(self.plan), *words[1:]], text=True, stdin=subprocess.DEVNULL,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT)

    def run(self, *words):
        process = self.begin(*words)
        said = process.communicate(timeout=400)[0]
        return process.returncode, said

    def rows(self):
        path = self.folder / "journal.jsonl"
        return [json.loads(line) for line in path.read_text().splitlines()] if path.exists() else []

    def wait_for(self, condition, seconds=120):
        assert eventually(condition, seconds), self.rows()[-3:]

    def table(self):
        return rows_of(self.folder / "trials.csv")


@pytest.fixture(scope="module")
def done(tmp_path_factory):
    study = Study(tmp_path_factory.mktemp("study"))
    assert study.run("freeze")[0] == 0
    # Killed while the first trial runs: the session ends with its command, and a trial in a world of the reserve follows.
    first = study.begin("next", "sub-01")
    study.wait_for(lambda: "TRIAL_START" in "".join(path.read_text() for path in study.folder.glob("sub-01/*/trial-*/journal.csv")), 500)
    # So is the command that it has started.
    below = [int(number) for number in Path(f"/proc/{first.pid}/task/{first.pid}/children").read_text().split()]
    assert below
    for number in (first.pid, *below):
        os.kill(number, signal.SIGKILL)
    first.wait()
    study.wait_for(lambda: list(study.folder.glob("sub-01/*/trial-*/summary.csv")))
    study.wait_for(lambda: study.run("next", "sub-01", "--session")[0] == 0)
    assert study.run("run")[0] == 0  # the rest, to the report
    assert study.run("next", "sub-02")[0] == 3
    return study


def counted(done):
    return [row for row in done.table() if row["counts"] == "yes"]


def test_D3_nothing_is_lost_and_nothing_is_doubled(done):
    begun = [(row["participant"], row["step"], row["attempt"]) for row in done.rows() if row["type"] == "begin"]
    ended = [(row["participant"], row["step"], row["attempt"]) for row in done.rows() if row["type"] == "end"]
    assert begun == ended and len(begun) == len(set(begun)) == 5
    assert sorted((row["participant"], row["condition"]) for row in counted(done)) == [(name, condition) for name in ("sub-01", "sub-02") for condition in ("full", "plain")]


def test_each_trial_names_its_place_in_the_study_in_its_own_record(done):
    for row in counted(done):
        assert row["study"] == "tiny" and row["result"] == "reached" and row["bag"] == "ok"
        assert row["operator"] == "simulated" and row["compiler"].startswith("GCC") and row["cpu"] != ""
        assert f"feedback/haptics/enabled={'false' if row['condition'] == 'plain' else 'true'}" in row["parameters"]
        assert "feedback/locked=true" in row["parameters"]
        folder = next(done.folder.glob(f"{row['participant']}/*/{row['trial']}"))
        own = rows_of(folder / "summary.csv")[0]
        for name in ("condition", "group", "phase", "repeat", "attempt", "session"):
            assert own[name] == row[name], name


def test_the_report_has_both_conditions(done):
    text = (done.folder / "report.html").read_text()
    assert "all, full" in text and "all, plain" in text and "fewer than 5 participants" in text
    assert "Cues a minute" in text and text.count("The map of world training") == 3


def test_journal_bag_and_table_are_equal(done):
    code, said = done.run("verify")
    assert code == 0 and "5 trials, 0 differ." in said, said
    assert said.count("journal equal, bag equal, table equal.") == 5


def test_the_figures_of_a_trial_are_those_that_are_counted_in_its_journal(done):
    """By the rows alone, without any of the programs that write them."""
    for row in counted(done):
        folder = next(done.folder.glob(f"{row['participant']}/*/{row['trial']}"))
        rows = [(int(line["sim_ns"]), line["type"], dict(pair.split("=", 1) for pair in line["fields"].split(";"))) for line in rows_of(folder / "journal.csv")]
        start = next(sim for sim, kind, _ in rows if kind == "TRIAL_START")
        reached = next(sim for sim, kind, _ in rows if kind == "GOAL_REACHED")
        end = next(fields for _, kind, fields in rows if kind == "TRIAL_END")
        hits = [fields["kind"] for _, kind, fields in rows if kind == "COLLISION"]
        spoken = sum(kind == "CUE" and fields["modality"] == "speech" for _, kind, fields in rows)
        assert float(row["elapsed_s"]) == pytest.approx((reached - start) / 1e9, abs=0.001)
        assert (int(row["shelf_collision_count"]), int(row["obstacle_collision_count"])) == (hits.count("shelf"), len(hits) - hits.count("shelf"))
        assert int(row["stuck_count"]) == sum(kind == "STUCK" for _, kind, _ in rows)
        assert int(row["cues_spoken"]) == spoken and row["path_length_m"] == end["path_length"] and row["result"] == end["result"]
        places = [(float(fields["x"]), float(fields["y"])) for _, kind, fields in rows if kind in ("TRIAL_START", "PROGRESS", "TRIAL_END")]
        chords = sum(((x - a) ** 2 + (y - b) ** 2) ** 0.5 for (a, b), (x, y) in zip(places, places[1:]))
        assert 0.9 * float(row["path_length_m"]) <= chords <= float(row["path_length_m"]) + 0.1


def test_the_page_on_pandas_reads_tables_and_track(done):
    page = (ROOT / "doc/study.md").read_text().split("```python\n")[1].split("```")[0]
    assert len(page.splitlines()) <= 30
    shell = f"source {ROOT}/navvi_ws/devel/setup.bash && exec /usr/bin/python3 -c \"$1\""
    page = page.replace('"touch_and_sounds"', json.dumps(str(done.folder)))
    result = subprocess.run(["bash", "-c", shell, "_", page], text=True, capture_output=True, timeout=120)
    assert result.returncode == 0, result.stderr
    assert "path_length_m" in result.stdout and float(result.stdout.split()[-1]) > 5.0
