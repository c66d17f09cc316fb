"""The journal of a study: damage, crashes and full disks."""
import errno
import fcntl
import functools
import html
import itertools
import multiprocessing
import os
import shutil
import signal
import sys
import time

import pytest
import rosbag

from small_study import Driver, begin, bench, exclusion, frozen, rehearsed, rest, small, trial_of, words, work  # noqa: F401
from navvi_study import actions, journal, overview, report, runner, session, study, table, verify
from navvi_study.errors import StudyError
from sessions import ROOT, eventually


def test_a_torn_row_is_set_aside_and_a_changed_one_is_refused(tmp_path):
    kept = journal.Journal(tmp_path / "journal.jsonl")
    for number in range(3):
        kept.append("done", number=number)
    with open(kept.path, "ab") as file:
        file.write(b'{"seq": 4, "ty')
    assert [row["number"] for row in journal.Journal(kept.path).rows()] == [0, 1, 2]
    assert (tmp_path / "journal.torn").read_bytes() == b'{"seq": 4, "ty\n'
    assert kept.append("done", number=3)["seq"] == 4 and len(journal.Journal(kept.path).rows()) == 4
    lines = kept.path.read_text().splitlines(keepends=True)
    for changed in ([lines[0].replace('"number": 0', '"number": 7'), *lines[1:]], [lines[0], *lines[2:]], [*lines[1:]], ["{}\n"]):
        kept.path.write_text("".join(changed))
        with pytest.raises(StudyError, match="damaged, changed"):
            journal.Journal(kept.path).rows()
    kept.path.write_bytes(b"{")
    (tmp_path / "journal.torn").unlink()
    (tmp_path / "journal.torn").mkdir()
    with pytest.raises(StudyError, match="unfinished row, which cannot be set aside: Is a directory"):
        journal.Journal(kept.path).rows()


def test_a_journal_without_the_copy_of_its_last_row_has_lost_rows_but_for_one_of_before(tmp_path, monkeypatch):
    kept = journal.Journal(tmp_path / "journal.jsonl")
    row = {"seq": 1, "utc": "2026-01-01T00:00:00.000Z", "mono_ns": 1, "by": "somebody", "type": "done", "before": journal.BEGIN}
    kept.path.write_text(journal.json.dumps({**row, "hash": journal.hash_of(row)}) + "\n")
    assert kept.lost() == ""
    with monkeypatch.context() as disk, pytest.raises(KeyboardInterrupt):
        disk.setattr(journal, "utc_now", killed_at_once)
        kept.append("done")
    assert kept.last.exists() and kept.lost() == "", "the copy is there before the first row that has one"
    kept.append("done")
    kept.last.unlink()
    with pytest.raises(StudyError, match="journal.jsonl lacks journal.last, the copy of its last row, written before; restore it from a copy."):
        kept.append("done")
    kept.append("loss")
    assert kept.lost() == "" and kept.append("done")["seq"] == 4
    kept.last.unlink()
    kept.path.write_bytes(b"")
    kept.last.symlink_to(tmp_path / "none" / "journal.last")
    with pytest.raises(StudyError, match="journal.last cannot be made: No such file or directory. Nothing is begun"):
        journal.Journal(kept.path).append("done")
    kept.last.unlink()
    kept.last.mkdir()
    assert journal.Journal(kept.path).append("done")["seq"] == 1, "a copy that cannot be written stops nothing"


def killed_at_once():
    raise KeyboardInterrupt


SHORTER = {"within a row": lambda lines: lines[:1] + [lines[1][:9]], "by two rows": lambda lines: lines[:-2], "to nothing": lambda lines: [], "by all but its first row": lambda lines: lines[:1]}

WAYS = [*((True, how) for how in SHORTER), (False, "by two rows"), (False, "within a row"), (False, "to nothing")]


@pytest.mark.parametrize("with_last, how", WAYS)
def test_a_journal_that_lost_rows_is_named_and_nothing_goes_on(work, monkeypatch, capsys, with_last, how):
    for name, path in ("version", "test"), ("tool", "true"):
        monkeypatch.setitem(actions.TOOLS, name, lambda *given, path=path: path)
    rest(work())
    kept, whole, last = work.study, work.study.journal.path.read_bytes(), work.study.journal.last.read_bytes()
    args = words(kept, participant="sub-01", reason="x", only=None, blind=False, bids=True, what="sub-01", data="keep", typed=True, session=False,
                 accept_loss=None)
    assert actions.verify(args) == 0
    kept.journal.path.write_bytes(b"".join(SHORTER[how](whole.splitlines(keepends=True))))
    if not with_last:
        kept.journal.last.unlink()
    named = "done sub-01 s1-end" if with_last else {
        "by two rows": "lacks journal.last", "within a row": str(trial_of_first(kept)), "to nothing": str(kept.folder / "frozen.json")}[how]
    for action in (actions.next_, actions.freeze, actions.report, actions.table, actions.export, actions.run, actions.exclude, actions.withdraw, actions.unblind):
        with pytest.raises(StudyError) as problem:
            action(args)
        assert named in str(problem.value) and "restore" in str(problem.value) and "--accept-loss" in str(problem.value), action
    capsys.readouterr()
    assert actions.verify(args) == 1 and named in capsys.readouterr().out
    actions.stop(args)
    actions.status(args)
    assert named in capsys.readouterr().out
    kept.journal.path.write_bytes(whole)
    kept.journal.last.write_bytes(last)
    assert actions.verify(args) == 0
    with pytest.raises(StudyError, match="nothing to accept"):
        actions.verify(words(kept, accept_loss="the disk failed"))
    with pytest.raises(StudyError, match="^--accept-loss is \"\""):
        actions.verify(words(kept, accept_loss=""))


@pytest.mark.parametrize("with_last, how", WAYS)
def test_a_loss_that_is_accepted_is_named_and_nothing_is_driven_or_asked_again(work, monkeypatch, capsys, with_last, how):
    monkeypatch.setitem(actions.TOOLS, "tool", lambda *given: "true")
    rest(work("aborted"))
    kept = work.study
    rows, answers, lines = table.trials(kept, kept.progress()), kept.answers("sub-01"), kept.journal.path.read_bytes().splitlines(keepends=True)
    kept.journal.path.write_bytes(b"".join(SHORTER[how](lines)))
    if not with_last:
        kept.journal.last.unlink()
    kept = study.Study(kept.plan)
    lost = [*kept.unrecorded()]
    assert actions.verify(words(kept, accept_loss="the disk failed")) == 0 and not kept.unrecorded()
    if not kept.progress().freezes:
        kept.freeze("test", None)
    begun = begin(kept)
    rest(begun)
    assert begun.runner.driven == [] and kept.answers("sub-01") == answers and table.trials(kept, kept.progress()) == rows
    named = f'for the reason "the disk failed": {", ".join(lost)}.'
    capsys.readouterr()
    assert actions.verify(words(kept, accept_loss=None)) == 0 and named in capsys.readouterr().out
    assert named in html.unescape(report.page(kept, kept.progress(), rehearsed=False))


def test_who_withdraws_is_erased_also_where_the_journal_has_lost_rows(work, monkeypatch, capsys):
    monkeypatch.setitem(actions.TOOLS, "tool", lambda *given: "true")
    rest(work())
    kept, args = work.study, words(work.study, participant="sub-01", data="delete", accept_loss=None)

    def cut(rows):
        kept.journal.path.write_bytes(b"".join(kept.journal.path.read_bytes().splitlines(keepends=True)[:-rows]))
    cut(2)
    actions.withdraw(args)
    assert not kept.home("sub-01").exists() and "withdraw again" in capsys.readouterr().out
    assert "done sub-01 s1-end" in str(study.Study.of(args.plan).unrecorded()), "the copy of the last row tells of the loss still"
    study.Study.of(args.plan).accept_loss("the disk failed")
    args.participant = "sub-02"
    actions.withdraw(args)
    cut(1)
    for action, code in (actions.stop, None), (actions.status, None), (actions.verify, 1):
        assert action(args) == code
        capsys.readouterr() if action == actions.stop else None
    assert "(erased sub-02)" in capsys.readouterr().out


@pytest.mark.parametrize("rows, named", [(4, "rows {} to {} (the last: done sub-01 s1-end)"), (1, "row {1} (done sub-01 s1-end)")])
def test_all_rows_that_were_lost_are_named_also_once_others_follow(work, rows, named):
    rest(work())
    kept, lines = work.study, work.study.journal.path.read_bytes().splitlines(keepends=True)
    kept.journal.path.write_bytes(b"".join(lines[:-rows]))
    named = named.format(len(lines) - rows + 1, len(lines))
    study.Study(kept.plan).journal.append("withdraw", participant="sub-02", data="delete")
    assert f"lacks {named}," in str(study.Study(kept.plan).unrecorded())
    study.Study(kept.plan).accept_loss("the disk failed")
    assert named in overview.losses(study.Study(kept.plan).progress())[0]


def trial_of_first(kept):
    return kept.attempt_folder("sub-01", "s1-c1-trial-1", 1)


def test_a_freeze_and_a_trial_that_were_killed_lack_no_row(tmp_path, monkeypatch):
    kept = study.Study(small(tmp_path))
    for fails in "append", "replace":
        with monkeypatch.context() as disk, pytest.raises(KeyboardInterrupt):
            disk.setattr(*((kept.journal, "append") if fails == "append" else (study.os, "replace")), functools.partial(killed, os.replace))
            kept.freeze("test", None)
        assert study.Study(kept.plan).unrecorded() == {}
    kept.require_frozen()
    with pytest.raises(KeyboardInterrupt):
        begin(kept, "killed").next("sub-01")
    trial_of_first(kept).mkdir()
    kept.journal.last.write_bytes(b"\0" * 99)  # of a power cut
    assert study.Study(kept.plan).unrecorded() == {} and rest(begin(kept))[0] == "s1-c1-trial-1"


def killed(replace, old, *more, **fields):
    if fields or str(old).endswith(".next"):
        raise KeyboardInterrupt
    replace(old, *more)


def test_D4_what_was_written_is_on_the_disk_with_the_name_of_its_file(tmp_path, monkeypatch):
    synced, real = [], os.fsync

    def fsync(file):
        path = os.readlink(f"/proc/self/fd/{file}")
        synced.append(os.path.basename(path))
        assert os.path.getsize(path), "the bytes have reached the file"
        if path.endswith(".jsonl"):
            with open(path, "rb") as other, pytest.raises(BlockingIOError):  # no other program writes meanwhile
                fcntl.flock(other, fcntl.LOCK_EX | fcntl.LOCK_NB)
        real(file)
    monkeypatch.setattr(os, "fsync", fsync)
    kept, notes = journal.Journal(tmp_path / "one/home/journal.jsonl"), tmp_path / "two/home/notes.jsonl"
    files = len(os.listdir("/proc/self/fd"))
    for write, wanted in ((lambda: kept.append("done"), ["home", "home", "journal.jsonl"]), (lambda: kept.append("done"), ["journal.jsonl"]),
                          (lambda: (kept.path.open("ab").write(b"torn"), kept.rows()), ["journal.torn", "home", "journal.jsonl"]),
                          (lambda: journal.append_line(notes, {}), ["home", "notes.jsonl"]), (lambda: journal.append_line(notes, {}), ["notes.jsonl"]),
                          (lambda: study.write_safely(tmp_path / "three/home/key", "{}"), ["key.new", "home"])):
        write()
        assert synced == wanted
        synced.clear()
    assert len(os.listdir("/proc/self/fd")) == files
    with pytest.raises(StudyError, match="line.jsonl cannot be written: File exists"):
        journal.append_line(notes / "line.jsonl", {})
    with pytest.raises(StudyError, match="key cannot be written: .* give the same command again"):
        study.write_safely(notes / "key", "{}")
    kept.path.write_bytes(b"")
    with pytest.raises(StudyError, match="has become shorter"):
        kept.rows()


def test_D4_a_row_that_may_not_last_is_not_read(tmp_path, monkeypatch):
    kept = journal.Journal(tmp_path / "journal.jsonl")
    kept.append("done", number=0)

    def fail(_):
        raise OSError(errno.EIO, "Input/output error")
    with monkeypatch.context() as disk:
        disk.setattr(os, "fsync", fail)
        with pytest.raises(StudyError, match="cannot be written: Input/output error. Nothing is begun"):
            kept.append("done", number=1)
        disk.setattr(os, "write", lambda file, line, write=os.write: write(file, line[:9]))
        with pytest.raises(StudyError, match="No space left"):
            kept.append("done", number=2)
    for one in (kept, journal.Journal(kept.path)):
        assert [row["number"] for row in one.rows()] == [0]
    assert kept.append("done", number=3)["seq"] == 2


def test_a_damaged_file_of_the_frozen_plan_is_a_sentence(work):
    for content in (b"{", b"\xff", b"[]", b"{}"):
        (work.study.folder / "frozen.json").write_bytes(content)
        with pytest.raises(StudyError, match="restore it from a copy"):
            work.study.require_frozen()


@pytest.mark.parametrize("damage", [
    lambda data: data[:len(data) // 3], lambda data: data[:-1], lambda data: data.replace(b"reached", b"r\xffached"),
    lambda data: data.replace(b"elapsed_s", b"elapsed_z"), lambda data: data.replace(b"n/a", b'"n"/a'),
    lambda data: data.replace(b",10.0\n", b"\n"), None], ids=["cut", "no end", "bytes", "title", "quotes", "cell", "missing"])
def test_a_trial_whose_summary_is_damaged_stops_the_report_until_it_is_excluded(work, monkeypatch, damage):
    monkeypatch.setattr(actions, "_figures", lambda: [])
    rest(work())
    attempt, trial = trial_of(work.study)
    path = trial / "summary.csv"
    path.write_bytes(damage(path.read_bytes())) if damage else path.unlink()
    args = words(work.study, only="time", blind=False, bids=True)
    for action in actions.report, actions.table, actions.export:
        with pytest.raises(StudyError, match=f"{path} .*study exclude {args.plan} sub-01/{attempt.trial} --reason"):
            action(args)
    sentences, bad = verify.verify(work.study, work.study.progress(), "true")
    assert bad == verify.changed(work.study, work.study.progress()) == 1
    assert "files differ: summary.csv" in sentences[0] and "table differs: summary.csv is missing or damaged" in sentences[0]
    actions.exclude(exclusion(work.study, f"sub-01/{attempt.trial}", "its summary is lost"))
    rows = table.trials(work.study, work.study.progress())
    assert [(row["counts"], row["excluded"], "result" in row) for row in rows] == [("no", "its summary is lost", False), ("yes", "n/a", True)]
    assert report.page(work.study, work.study.progress(), rehearsed=False)


def test_a_trial_whose_summary_was_cut_and_cannot_be_made_again_was_driven_and_is_replaced(work):
    class Cut(Driver):
        def trial(self, participant, step, attempt, folder, lock):
            super().trial(participant, step, attempt, folder, lock)
            if len(self.driven) == 1:
                path = folder / "trial-1/summary.csv"
                path.write_bytes(path.read_bytes()[:9])
                raise KeyboardInterrupt
    begun = begin(work.study, driver=Cut)
    with pytest.raises(KeyboardInterrupt):
        begun.next("sub-01")
    rest(begun)
    assert begun.runner.driven[:2] == [("easy", 1), ("easy", 11)], "its world was met"
    rows = [(row["trial"], row["counts"], row["excluded"]) for row in table.trials(work.study, work.study.progress())]
    assert rows[:2] == [("trial-1", "no", "the trial broke off"), ("trial-2", "yes", "n/a")]


def test_the_bag_of_a_trial_that_a_power_cut_ended_is_no_difference_once_it_is_repaired(tmp_path):
    programs = ROOT / "navvi_ws/devel/lib/navvi_study"

    class Cut(runner.LoopRunner):
        """The power fails a moment before the trial's end; the disk has all until then."""
        def trial(self, *given):
            super().trial(*given)
            trial, = given[3].glob("trial-*")
            lines = (trial / "journal.csv").read_bytes().splitlines(keepends=True)
            (trial / "journal.csv").write_bytes(b"".join(lines[:next(at for at, line in enumerate(lines) if b",TRIAL_END," in line)]))
            with rosbag.Bag(str(trial / "trial.bag")) as bag, rosbag.Bag(str(trial / verify.OPEN), "w") as other:
                for topic, message, stamp in itertools.takewhile(lambda one: getattr(one[1], "type", "") != "TRIAL_END", bag.read_messages()):
                    other.write(topic, message, stamp)
            (trial / "trial.bag").unlink()
            (trial / "summary.csv").unlink()
            raise KeyboardInterrupt

        def close(self, folder):
            runner.LiveRunner.close(self, folder)
    kept = frozen(tmp_path, ("limit: 60", "limit: 2"))
    driver = Cut(kept, programs / "trials_bench", "test")
    driver.close_trials = programs / "close_trials"
    begun = session.Session(kept, driver, say=lambda line: None, wait=False)
    with pytest.raises(KeyboardInterrupt):
        begun.next("sub-01")
    begun.recover("sub-01")
    _, trial = trial_of(kept)

    def verified():
        return verify.verify(kept, kept.progress(), programs / "count_trial")
    (sentence,), bad = verified()
    assert bad == 1 and "files equal, journal equal, bag was not closed" in sentence
    (trial / verify.OPEN).rename(trial / "trial.bag")
    (sentence,), bad = verified()
    assert bad == 0 and "files equal, journal equal, bag no end, as the trial's record broke off, table equal." in sentence
    (trial / "trial.bag").unlink()
    (sentence,), bad = verified()
    assert bad == 1 and f"files differ: {verify.OPEN}," in sentence


def _write_for_ever(path):
    kept = journal.Journal(path)
    for number in itertools.count():
        kept.append("done", number=number)
        sys.stdout.write(f"{number}\n")
        sys.stdout.flush()


def test_kill_9_loses_no_row_that_was_acknowledged_and_doubles_none(tmp_path):
    path, told = tmp_path / "journal.jsonl", 0
    for _ in range(3):
        reader, writer = os.pipe()
        process = multiprocessing.Process(target=lambda: (os.dup2(writer, 1), setattr(sys, "stdout", os.fdopen(1, "w")), _write_for_ever(path)))
        process.start()
        os.close(writer)
        assert eventually(lambda: path.exists() and path.read_bytes().count(b"\n") > told + 5, 60)
        os.kill(process.pid, signal.SIGKILL)
        process.join()
        with os.fdopen(reader) as lines:
            acknowledged = sum(1 for _ in lines)
        rows = journal.Journal(path).rows()
        assert acknowledged > 3
        assert told + acknowledged <= len(rows) <= told + acknowledged + 1
        assert [row["seq"] for row in rows] == list(range(1, len(rows) + 1))
        told = len(rows)


def test_D4_a_full_disk_begins_nothing(work, monkeypatch):
    monkeypatch.setattr(journal.os, "write", lambda file, line: len(line) // 2)
    begun = work()
    with pytest.raises(StudyError, match="cannot be written"):
        begun.next("sub-01")
    monkeypatch.undo()
    assert begun.runner.driven == []
    assert rest(begun)[0] == "s1-c1-trial-1"


def test_a_rehearsal_that_was_killed_goes_on_and_ends_with_the_same_table(tmp_path, bench):
    whole = rehearsed(tmp_path, bench, [])
    wanted = [(row["participant"], row["condition"], row["elapsed_s"]) for row in table.trials(whole, whole.progress())]
    shutil.rmtree(whole.folder)
    (tmp_path / "calls").unlink()
    (tmp_path / "wait").touch()
    process = multiprocessing.Process(target=lambda: (os.setsid(), rehearsed(tmp_path, bench, [])))
    process.start()
    assert eventually((tmp_path / "there").exists, 20)
    os.killpg(process.pid, signal.SIGKILL)
    process.join()
    (tmp_path / "wait").unlink()
    said = []
    again = rehearsed(tmp_path, bench, said)
    assert "goes on" in said[0]
    assert [(row["participant"], row["condition"], row["elapsed_s"]) for row in table.trials(again, again.progress())] == wanted
    assert len(again.progress().freezes) == 1
    said.clear()
    rehearsed(tmp_path, bench, said)
    assert "goes on" not in said[0], "it was done, and begins anew"


def test_a_rehearsal_on_a_full_disk_is_a_sentence_and_goes_on_once_there_is_room(tmp_path, bench, monkeypatch):
    real, left = os.fsync, [40]

    def fsync(file):
        left[0] -= 1
        if left[0] < 0:
            raise OSError(28, "No space left on device")
        real(file)
    monkeypatch.setattr(os, "fsync", fsync)
    with pytest.raises(StudyError, match="No space left"):
        rehearsed(tmp_path, bench, [])
    monkeypatch.undo()
    said = []
    kept = rehearsed(tmp_path, bench, said)
    assert "goes on" in said[0]
    counted = [(row["participant"], row["condition"]) for row in table.trials(kept, kept.progress()) if row["counts"] == "yes"]
    assert len(counted) == len(set(counted)) == 8
