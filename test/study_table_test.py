"""Studies without a session: tables, notes, answers, probes and export."""
import functools
import json
import math
import os
import pty
import re
import shutil
import signal
import subprocess
import threading
import time

import pytest

from small_study import Driver, EXAMPLE, begin, exclusion, frozen, rest, small, trial_of, words, work, write_record, write_summary  # noqa: F401
from navvi_study import actions, export, journal, overview, progress, questionnaire, record, report, runner, schedule, session, study, table, verify, worlds
from navvi_study.analysis import Analysis
from navvi_study.errors import StudyError
from navvi_study.steps import probe


FIGURES = [{"name": "elapsed_s", "unit": "s", "meaning": "simulated time from start to goal", "source": "the paper"}]


def test_tables_describe_each_column_and_the_same_study_gives_the_same_bytes(work):
    rest(work())
    files = table.write(work.study, work.study.progress(), FIGURES)
    before = [path.read_bytes() for path in files]
    assert before == [path.read_bytes() for path in table.write(work.study, work.study.progress(), FIGURES)]
    header = files[0].read_text().splitlines()[0].split(",")
    described = json.loads(files[1].read_text())
    assert list(described) == header and described["elapsed_s"]["Units"] == "s"
    assert described["elapsed_s"]["Source"] == "the paper"
    assert len(files[2].read_text().splitlines()) == 1 + 2 * 6


def test_journal_bag_and_table_are_held_against_each_other(work, tmp_path):
    rest(work())
    state = work.study.progress()
    programs = []
    for name, code in (("good", 0), ("bad", 1)):
        (tmp_path / name).write_text(f"#!/bin/sh\necho elapsed_s is 1 in the summary and 2 in the recount\n[ $1 = journal ] || exit {code}\n")
        (tmp_path / name).chmod(0o755)
        programs.append(tmp_path / name)
    good, bad = programs
    assert verify.verify(work.study, state, bad)[1] == 0, "nothing is counted where there is neither journal nor bag"
    _, trial = trial_of(work.study)
    write_record(trial)
    (trial / "trial.bag").touch()
    assert verify.verify(work.study, state, good)[1] == 0
    sentences, differ = verify.verify(work.study, state, bad)
    assert differ == 1 and "bag differs: elapsed_s is 1 in the summary and 2 in the recount" in sentences[0] and "journal equal" in sentences[0]


def test_a_file_that_changed_after_its_trial_is_named(work):
    rest(work())
    attempt, trial = trial_of(work.study)
    sentences, bad = verify.verify(work.study, work.study.progress(), "true")
    assert bad == 0 and sentences[0] == f"sub-01/{attempt.trial}: files equal, journal no journal, bag no bag, table equal."
    (trial / "summary.csv").write_text((trial / "summary.csv").read_text().replace("20.0", "19.0"))
    sentences, bad = verify.verify(work.study, work.study.progress(), "true")
    assert bad == 1 and "files differ: summary.csv," in sentences[0]
    assert verify._files(trial, {}) == "no sums", "as in journals of before"


def test_a_summary_that_changed_is_counted_by_report_table_and_export(work, monkeypatch, capsys):
    monkeypatch.setattr(actions, "_figures", lambda: [])
    rest(work())
    for at in range(2):
        write_record(trial_of(work.study, at=at)[1])
    monkeypatch.setattr(export, "way_of", lambda trial: [])
    _, trial = trial_of(work.study)
    told = f"1 trial with files that changed since the trial ended; \"./navvi study verify {work.study.plan.file}\""
    for content, count in ((trial / "summary.csv").read_text(), 0), ((trial / "summary.csv").read_text().replace("20.0", "19.0"), 1):
        (trial / "summary.csv").write_text(content)
        for action in actions.report, actions.table, actions.export:
            action(words(work.study, only="time", blind=False, bids=True))
            assert (told in capsys.readouterr().out) == bool(count)
        assert ["trials whose tables changed since they ended", count] in report.quality(work.study, work.study.progress())


def test_what_a_program_says_ends_within_the_sentence_of_its_trial(work, tmp_path):
    rest(work())
    _, trial = trial_of(work.study)
    write_record(trial)
    (trial / "trial.bag").touch()
    (tmp_path / "bad").write_text("#!/bin/sh\necho There is no summary.csv in order in $2. >&2\nexit 2\n")
    (tmp_path / "bad").chmod(0o755)
    found = verify.verify(work.study, work.study.progress(), tmp_path / "bad")[0][0]
    assert f"journal differs: There is no summary.csv in order in {trial}, bag differs: There is no summary.csv in order in {trial}, table" in found


def test_verify_names_what_differs_in_journal_and_table(work, tmp_path):
    rest(work())
    attempt, trial = trial_of(work.study)
    write_record(trial)
    header, cells = (trial / "summary.csv").read_text().splitlines()
    (trial / "summary.csv").write_text(f"{header},condition\n{cells},plain\n")
    (tmp_path / "bad").write_text("#!/bin/sh\necho row 3 is damaged >&2\necho more\nexit 1\n")
    (tmp_path / "bad").chmod(0o755)
    row, state = table.trials(work.study, work.study.progress())[0], work.study.progress()
    found = verify.verify(work.study, state, tmp_path / "bad")[0][0]
    assert "journal differs: row 3 is damaged, bag no bag" in found
    for condition, words in (("plain", "equal"), ("full", "differs in condition")):
        assert verify._table(work.study, {**row, "condition": condition}, attempt) == words
    assert verify._table(work.study, {**row, "condition": "plain", "elapsed_s": "1"}, attempt) == "differs in elapsed_s"


JOB = ("a: {world: easy", "a: {jobs: round.yaml, world: easy")


class Legs(Driver):
    """A summary a leg in worlds with a job: as many as `results` has, in turn."""

    def trial(self, participant, step, attempt, folder, lock):
        self.driven.append((attempt.world, attempt.seed))
        for at, result in enumerate(self.results.pop(0) if self.results else ["reached"] * (2 if attempt.seed == 1 else 1), 1):
            reason = "ended_by_person" if result == "aborted" else "n/a"
            write_summary(folder / f"trial-{len(self.driven)}-{at}", result, elapsed=10.0 * at, reason=reason)


def job(folder):
    (folder / "round.yaml").write_text("- {name: packing table, x: 4, y: -6.2, do: pick}\n- {name: gate 4, x: 7, y: -3}\n")
    return frozen(folder, JOB)


def test_a_job_is_a_trial_with_a_row_a_leg_in_tables_and_report(tmp_path):
    kept = job(tmp_path)
    assert rest(begin(kept, driver=Legs))
    rows = table.trials(kept, kept.progress())
    assert [[row.get(name, "n/a") for name in ("leg", "place", "do", "elapsed_s", "counts")] for row in rows] == [
        ["1", "packing table", "pick", "10.0", "yes"], ["2", "gate 4", "drive", "20.0", "yes"], ["n/a", "n/a", "n/a", "10.0", "yes"]]
    assert rows[0]["trial"] != rows[1]["trial"] and report.legs(kept, kept.progress()) == [
        ["full: 1. packing table, pick", 1, 1, "10"], ["full: 2. gate 4, drive", 1, 1, "20"]]
    assert "Legs of jobs" in report.page(kept, kept.progress(), rehearsed=False)
    sentences, bad = verify.verify(kept, kept.progress(), "true")
    assert bad == 0 and len(sentences) == 3 and all("files equal" in sentence for sentence in sentences)
    attempt = kept.progress().person("sub-01").attempts[0]
    assert attempt.result == "reached" and attempt.collisions == 6 and kept.progress().find(f"sub-01/{rows[0]['trial']}")[1].step == attempt.step
    next(tmp_path.glob("small/sub-01/*/trial-1-1/summary.csv")).write_text("changed")
    assert "files differ: summary.csv" in verify.verify(kept, kept.progress(), "true")[0][0]


NAMED = (("packing table", "pick"), ("gate 4", "drive"))


class Named(Legs):
    """Each leg's journal names its place, as that of a session does."""

    def trial(self, participant, step, attempt, folder, lock):
        super().trial(participant, step, attempt, folder, lock)
        for trial, (name, task) in zip(sorted(folder.iterdir()), NAMED if attempt.seed == 1 else ()):
            write_record(trial)
            path = trial / "journal.csv"
            path.write_text(path.read_text().replace("TRIAL_START,x=0", f"TRIAL_START,job_name={name.replace(' ', '%20')};job_task={task};x=0"))


def _drop_outs(kept):
    return [(row["condition"], row["trials"], row["mean"]) for row in Analysis(kept, kept.progress()).by_condition("drop_out")]


@pytest.mark.parametrize("results", [["reached", "reached"], ["aborted"]])
@pytest.mark.parametrize("later", ["swapped", "none", "one more"])
def test_a_leg_keeps_its_place_and_task_whatever_job_a_later_plan_has(tmp_path, results, later):
    kept = job(tmp_path)
    rest(begin(kept, results, driver=Named))
    rows, dropped, text = table.trials(kept, kept.progress()), _drop_outs(kept), (tmp_path / "round.yaml").read_text()
    assert [(row["leg"], row["place"], row["do"]) for row in rows[:-1]] == [(str(at + 1), *NAMED[at]) for at in range(len(results))]
    if later == "swapped":
        (tmp_path / "round.yaml").write_text("".join(reversed(text.splitlines(True))))
    more = ("b: {world: easy", "b: {jobs: round.yaml, world: easy")
    other = study.Study(small(tmp_path, *{"swapped": [JOB], "none": [], "one more": [JOB, more]}[later]))
    other.freeze("test", later)
    assert table.trials(other, other.progress()) == rows and _drop_outs(other) == dropped
    assert report.legs(other, other.progress()) == report.legs(kept, kept.progress())


@pytest.mark.parametrize("results, result, counts", [
    (["timeout", "reached"], "timeout", True), (["reached", "aborted"], "aborted", False), (["reached"], "aborted", False), (["invalid"], "invalid", False)])
def test_a_job_counts_where_each_of_its_legs_was_driven_to_its_end(tmp_path, results, result, counts):
    kept = job(tmp_path)
    begin(kept, results, driver=Legs).next("sub-01")
    attempt = kept.progress().person("sub-01").attempts[0]
    assert (attempt.result, attempt.counts, len(attempt.legs)) == (result, counts, len(results))


@pytest.mark.parametrize("gave_up, reached", [(["aborted"], 2 / 3), (["reached", "aborted"], 3 / 4)])
def test_who_gives_up_a_job_drops_out_once_however_far_it_came(tmp_path, gave_up, reached):
    (tmp_path / "round.yaml").write_text("- {name: packing table, x: 4, y: -6.2, do: pick}\n- {name: gate 4, x: 7, y: -3}\n")
    kept = frozen(tmp_path, JOB, ("seeds: [1]", "seeds: [1, 5]"), ("seeds: [2]", "seeds: [2, 6]"))
    rest(begin(kept, ["reached", "reached"], gave_up, driver=Legs))
    measured = Analysis(kept, kept.progress())
    shown = {name: {row["condition"]: (row["trials"], row["mean"]) for row in measured.by_condition(name)} for name in ("drop_out", "reached")}
    assert shown["drop_out"] == {"full": (2, 0.5), "plain": (2, 0.0)} and shown["reached"]["full"] == (2 + len(gave_up), pytest.approx(reached))


def test_the_experimenter_ends_a_job_between_two_places_too(tmp_path):
    kept = job(tmp_path)

    class Ending(Legs):
        def trial(self, participant, step, attempt, folder, lock):
            kept.note(participant, attempt, {"utc": "", "mono_ns": 1, "type": "abort", "text": ""})
            super().trial(participant, step, attempt, folder, lock)
    begin(kept, ["reached"], driver=Ending).next("sub-01")
    assert kept.progress().person("sub-01").attempts[0].excluded == "drop-out: ended by the experimenter"


def test_a_job_with_a_leg_to_another_goal_has_tables_that_name_no_place(tmp_path):
    kept = job(tmp_path)
    begin(kept, ["reached"] * 3, driver=Legs).next("sub-01")
    rows = table.trials(kept, kept.progress())
    assert [(row["leg"], row["place"], row["do"]) for row in rows] == [(str(leg), "n/a", "n/a") for leg in (1, 2, 3)]


def test_a_job_is_rehearsed_leg_by_leg_and_its_file_is_part_of_the_plan(tmp_path):
    kept = job(tmp_path)
    step = next(step for step in schedule.steps_of(kept.plan, "sub-01") if step.kind == "trial")
    bench = tmp_path / "trials_bench"
    bench.write_text(f"#!/bin/sh\necho \"$@\" >> {tmp_path}/calls\nfor word in \"$@\"; do case $word in --out=*) mkdir -p ${{word#--out=}}/trial-easy-1 ;; esac; done\n"
                     "echo result,shortest_path_m,elapsed_s,mover_proximity_count,turns_per_min; echo reached,4,10,1,6\n")
    bench.chmod(0o755)
    runner.LoopRunner(kept, bench, "test").trial("sub-01", step, progress.Attempt(step.name, 1, "easy", 1), tmp_path / "out", 0)
    first, second = (tmp_path / "calls").read_text().splitlines()
    assert "sim/goal:=4,-6.2" in first and "sim/start" not in first and "sim/start:=4,-6.2,0 sim/goal:=7,-3" in second
    assert sorted(path.name for path in (tmp_path / "out").glob("trial-*")) == ["trial-easy-1-leg-01", "trial-easy-1-leg-02"]
    rows = worlds.drive(kept.plan, bench, 1)
    assert rows[kept.plan.worlds[0]] == {"result": "reached", "shortest_path_m": 8, "elapsed_s": 20, "mover_proximity_count": 2, "turns_per_min": 6}
    words = runner.LiveRunner(kept, "navvi", "close").arguments("sub-01", step, progress.Attempt(step.name, 1, "easy", 1), tmp_path)
    assert words["jobs"] == str(tmp_path / "round.yaml") and words["goal"] == "4,-6.2"
    (tmp_path / "round.yaml").write_text("- {name: gate 4, x: 7, y: -3}\n")
    with pytest.raises(StudyError, match="world_files/round.yaml"):
        study.Study.of(kept.plan.file).require_frozen()
    for text, says in ("[]", "at least one entry"), ("- {name: gate 4, x: 7}", "y\" is missing"), ("- {name: a, x: 1, y: 2, do: eat}", "drive, pick, drop, scan"):
        (tmp_path / "round.yaml").write_text(text)
        with pytest.raises(StudyError, match=says):
            small(tmp_path, JOB)


def test_a_trial_whose_bag_is_recorded_as_bad_agrees_without_one(tmp_path):
    assert "recorded as bad" in verify._bag(None, tmp_path, {"bag": "bad"})
    assert verify._bag(None, tmp_path, {"bag": "ok"}) == "is missing"


@pytest.mark.parametrize("said, end, words", [
    ("the bag does not hold the trial's end", "TRIAL_END,x=2;reason=journal_damaged", "no end, as the trial's record broke off"),
    ("the bag does not hold the trial's end", "TRIAL_END,x=2;reason=limit", "differs: the bag"),
    ("the bag does not hold the trial's end", "PROGRESS,x=2", "differs: the bag"),
    ("a row is missing", "TRIAL_END,x=2;reason=journal_damaged", "differs: a row")])
def test_a_bag_without_the_end_that_was_written_after_a_crash_agrees(tmp_path, said, end, words):
    write_record(tmp_path)
    journal = tmp_path / "journal.csv"
    journal.write_text(journal.read_text().replace("TRIAL_END,x=2", end))
    (tmp_path / "trial.bag").touch()
    (tmp_path / "program").write_text(f"#!/bin/sh\necho \"{said}\"\nexit 1\n")
    (tmp_path / "program").chmod(0o755)
    assert verify._bag(tmp_path / "program", tmp_path, {"bag": "ok"}).startswith(words)


def test_a_bag_that_a_power_cut_left_open_is_counted_until_it_is_repaired(work):
    class Cut(Driver):
        def trial(self, participant, step, attempt, folder, lock):
            super().trial(participant, step, attempt, folder, lock)
            (folder / f"trial-{len(self.driven)}" / "trial.bag.active").write_bytes(b"#ROSBAG V2.0")
    rest(begin(work.study, driver=Cut))
    _, trial = trial_of(work.study)
    sentences, bad = verify.verify(work.study, work.study.progress(), "true")
    assert bad == 2 and f"files equal, journal no journal, bag was not closed: \"rosbag reindex {trial}/trial.bag.active\" repairs it" in sentences[0]
    (trial / "trial.bag.active").rename(trial / "trial.bag")
    assert verify.verify(work.study, work.study.progress(), "true")[1] == 1, "the other one"


def test_answers_that_were_given_are_not_asked_again(work):
    begun = work()
    asked = []

    def ask(participant, step, items, answered, lock):
        asked.append([item.name for item in items])
        for item in items[:2]:
            answered(item, "50")
    begun.runner.ask = ask
    begun.next("sub-01")
    for _ in range(3):
        begun.next("sub-01")
    assert asked == [["mental", "physical", "temporal", "performance", "effort", "frustration"],
                     ["temporal", "performance", "effort", "frustration"], ["effort", "frustration"]]
    assert len(work.study.answers("sub-01")) == 6


class Voice(Driver):
    """Asks by the voice: ./navvi writes an answer to the first item that it is to ask, and this program dies of what comes next in `dies`."""

    def __init__(self, kept, *results):
        super().__init__(kept, *results)
        navvi = kept.folder.parent / "navvi"
        navvi.write_text("""#!/bin/sh
for word; do case $word in feedback/questions:=*) questions=${word#*:=};; feedback/record:=*) record=${word#*:=};; esac; done
printf 'item,answer,seconds\\n%s,50,1.0\\n' $(sed -n 's/.* name: //p;s/^- name: //p' $questions | head -n 1) > $record
""")
        navvi.chmod(0o755)
        self.live, self.dies, self.asked = runner.LiveRunner(kept, navvi, "true"), [], []
        self.run, self.live._run = self.live._run, self.killed

    def killed(self, *given):
        self.run(*given)
        if self.dies:
            raise self.dies.pop()

    def ask(self, participant, step, items, answered, lock):
        self.asked.append([item.name for item in items])
        self.live.ask(participant, step, items, answered, lock)


def test_answers_that_the_voice_has_taken_are_kept_though_study_next_dies(tmp_path):
    kept = frozen(tmp_path, ("operator: simulated", "operator: pad"))
    begun = begin(kept, driver=Voice)
    begun.next("sub-01")
    begun.runner.dies = [KeyboardInterrupt()]
    with pytest.raises(KeyboardInterrupt):
        begun.next("sub-01")
    assert kept.answers("sub-01") == []
    begun.next("sub-01")
    assert [(row["item"], row["seconds"]) for row in kept.answers("sub-01")] == [("mental", "1.0"), ("physical", "1.0")]
    begun.next("sub-01")
    assert [len(items) for items in begun.runner.asked] == [6, 6, 4] and not list(kept.home("sub-01").glob("*.csv"))


def test_answers_about_an_excluded_probe_that_the_voice_has_taken_are_not_those_about_the_next(tmp_path):
    kept = frozen(tmp_path, PROBES, ("operator: simulated", "operator: pad"))
    begun = begin(kept, driver=Voice)
    begun.next("sub-01")
    begun.runner.dies = [KeyboardInterrupt()]
    with pytest.raises(KeyboardInterrupt):
        begun.next("sub-01")
    actions.exclude(exclusion(kept, "sub-01/trial-2", "a siren"))
    begun.next("sub-01")
    assert [(row["item"], row["attempt"]) for row in kept.answers("sub-01")] == [("goal", 2)]


def test_what_is_typed_is_kept_once_the_next_answer_is_and_until_then_corrected(capsys):
    tlx, given = questionnaire.find("tlx", EXAMPLE.parent), []

    def typed(*lines):
        given.clear()
        runner.ask_in_terminal(tlx, tlx.items, lambda item, answer: given.append((item.name, answer)), iter([*lines, None]).__next__)
        return given
    assert typed("10", "20", "30") == [("mental", "10"), ("physical", "20")]
    assert typed("10", "b", "15", "20", "b", "b", "25", "x", "r", "d") == [("mental", "15"), ("physical", "25")]
    assert typed(*["10"] * 5, "d") == [(item.name, "10") for item in tlx.items[:5]] + [("frustration", "declined")]


PROBES = ("limit: 60", "limit: 60\nprobes: {after: [5, 20], worlds: {world: easy, seeds: [3, 4]}}")


@pytest.fixture
def probed(tmp_path):
    """A frozen study with probes, whose trials stop at (2, 1) m with a heading of 90 degrees, having begun at (0, 0); the goal is at (2, 6)."""
    class Stopping(Driver):
        def trial(self, participant, step, attempt, folder, lock):
            super().trial(participant, step, attempt, folder, lock)
            trial = next(folder.iterdir())
            rows = [(10, "TRIAL_START", "x=0;y=0"), (10, "GOAL_SET", "x=0;y=0;goal_x=2;goal_y=6"),
                    (20, "TRIAL_END", f"x=2;y=1;yaw={math.pi / 2};left=shelf;right=nothing")]
            (trial / "journal.csv").write_text("trial,seq,sim_ns,mono_ns,type,fields,crc32\n" + "".join(
                f"t,{seq},{sim * 10**9},{sim * 10**9},{kind},{fields},00000000\n" for seq, (sim, kind, fields) in enumerate(rows, 1)))

        def ask(self, participant, step, items, answered, lock):
            if step.kind != "probe":
                return super().ask(participant, step, items, answered, lock)
            for item in items:
                answered(item, {"goal": "-10", "start": "170", "left": "wall"}[item.name], "1.5")
            return None
    return functools.partial(begin, frozen(tmp_path, PROBES), driver=Stopping)


def test_a_probe_stops_a_trial_of_each_condition_at_a_time_that_nobody_can_tell(tmp_path):
    plan = small(tmp_path, PROBES)
    assert kinds_of(plan, "sub-01") == ["trial", "probe", "questionnaire"] * 2 + ["session_end"]
    stops = [step.limit for name in plan.participants for step in schedule.steps_of(plan, name) if step.kind == "probe"]
    assert len(set(stops)) > 3 and all(5 <= stop <= 20 for stop in stops)
    step = next(step for step in schedule.steps_of(plan, "sub-01") if step.kind == "probe")
    words = runner.LiveRunner(study.Study(plan), "navvi", "close_trials").arguments("sub-01", step, progress.Attempt(step.name, 1, "easy", 3), tmp_path)
    assert words["limit"] == f"{step.limit:g}" and words["trial/study/phase"] == "probe"
    assert "probes" not in small(tmp_path).values() and plan.hash() != small(tmp_path).hash()


def kinds_of(plan, name):
    return [step.kind for step in schedule.steps_of(plan, name)]


def test_what_was_answered_to_a_probe_stands_beside_what_was_true(probed):
    begun = probed("timeout", "timeout")
    assert rest(begun)[:3] == ["s1-c1-trial-1", "s1-c1-probe", "s1-c1-tlx"]
    kept, state = begun.study, begun.study.progress()
    first = {row["item"]: row for row in table.answers(kept, state) if row["step"] == "s1-c1-probe"}
    assert (first["goal"]["truth"], first["goal"]["error_deg"], first["goal"]["seconds"]) == ("0", "-10", "1.5"), "it is straight ahead"
    # The start is 2 m to the left of the heading and 1 m behind: 90 + atan(1/2).
    assert (first["start"]["truth"], first["start"]["error_deg"]) == ("117", "53")
    assert (first["left"]["truth"], first["left"]["correct"]) == ("shelf", "no")
    assert [row["score"] for row in table.scores(kept, state) if row["questionnaire"] == "probe"] == [31.5, 31.5]
    phases = [(row["phase"], row["counts"]) for row in table.trials(kept, state)]
    assert phases == [("trial", "yes"), ("probe", "no")] * 2, "no figure of a trial is made of a probe"
    files = {path.name: path for path in table.write(kept, state, FIGURES)}
    assert json.loads(files["answers.json"].read_text())["error_deg"]["Units"] == "deg"


def test_a_probe_whose_trial_does_not_count_is_driven_again_before_it_is_asked(probed):
    begun = probed("reached", "aborted")
    steps = rest(begun)
    assert steps[:4] == ["s1-c1-trial-1", "s1-c1-probe", "s1-c1-probe", "s1-c1-tlx"]
    assert begun.runner.driven[1:3] == [("easy", 3), ("easy", 11)]
    assert len([row for row in begun.study.answers("sub-01") if row["step"] == "s1-c1-probe"]) == 3


def test_answers_about_a_probe_that_is_driven_again_are_given_again_and_the_first_are_in_no_result(probed):
    begun = probed("reached", "timeout")
    kept, asked, ask = begun.study, [], begun.runner.ask

    def ask_first(participant, step, items, answered, lock):
        asked.append([item.name for item in items])
        return answered(items[0], "90") if len(asked) == 1 else ask(participant, step, items, answered, lock)
    begun.runner.ask = ask_first
    for _ in range(2):
        begun.next("sub-01")
    actions.exclude(exclusion(kept, "sub-01/trial-2", "a siren"))
    assert table.answers(kept, kept.progress()) == []
    rest(begun)
    assert asked[:2] == [["goal", "start", "left"]] * 2
    rows = [row for row in table.answers(kept, kept.progress()) if row["step"] == "s1-c1-probe"]
    assert [(row["item"], row["answer"], row["attempt"]) for row in rows] == [("goal", "-10", "2"), ("start", "170", "2"), ("left", "wall", "2")]
    assert [row["score"] for row in table.scores(kept, kept.progress()) if row["questionnaire"] == "probe"] == [31.5, 31.5]
    path = kept.home("sub-01") / "answers.jsonl"
    path.write_text("".join(line.replace(', "attempt": 2', "") for line in path.read_text().splitlines(keepends=True) if '"attempt": 1' not in line))
    assert len([row for row in table.answers(kept, kept.progress()) if row["step"] == "s1-c1-probe"]) == 3, "those of before name no attempt"


def test_where_the_robot_stands_at_the_place_or_the_record_does_not_know_nothing_is_true(tmp_path):
    probe_of, folder = questionnaire.find("probe", EXAMPLE.parent), tmp_path / "trial"
    folder.mkdir()
    for end, known in (("x=0.5;y=0;yaw=0;left=n/a", [None, None, None]), ("x=3;y=0", [None, None, None]),
                       ("x=-3;y=0;yaw=3.1;left=nothing", [None, "-178", "nothing"])):
        (folder / "journal.csv").write_text("head\n" + f"t,1,0,0,TRIAL_START,x=0;y=0,0\nt,2,9,9,TRIAL_END,{end},0\n")
        assert [probe.truth(item, record.Record(folder)) for item in probe_of.items] == known
    assert [probe.wrapped(angle) for angle in (180, -180, 181, 540, 0)] == [180, 180, -179, 180, 0]


def test_D1_a_note_of_any_bytes_is_kept_and_none_ends_the_desk(work, capsys):
    work().next("sub-01")
    attempt, _ = trial_of(work.study)
    reader, writer = os.pipe()
    os.write(writer, b"n caf\xe9\nn one\xe2\x80\xa8two\xe2\x80\xa9three\xc2\x85four\nwhat\nwhat\nm\n\np\ni led the robot")
    os.close(writer)
    desk = runner.Desk(None, lambda row: work.study.note("sub-01", attempt, row), runner.Lines(reader))
    for _ in range(9):
        desk.listen(0.0)
    assert [note["text"] for note in work.study.notes("sub-01")] == ["caf\ufffd", "one\u2028two\u2029three\x85four", "", "", "led the robot"] and desk.paused
    told = capsys.readouterr().out
    assert told.count("\"what\" is not understood") == 2 and told.count(runner.DESK) == 1
    row = table.trials(work.study, work.study.progress())[0]
    assert (row["marks"], row["interventions"]) == ("3", "1")


def test_what_is_typed_while_no_trial_runs_is_told_and_is_no_note_of_the_next_trial(tmp_path, capsys):
    kept = frozen(tmp_path, ("limit: 60", "limit: 60\nbreak: {minutes: 0.001}"))
    live, (reader, writer) = runner.LiveRunner(kept, tmp_path / "navvi", "true"), os.pipe()
    live.lines, told = runner.Lines(reader), " was typed while no trial runs, and nothing is written.\n"
    (tmp_path / "navvi").write_text("#!/bin/sh\nsleep 0.5\n")
    (tmp_path / "navvi").chmod(0o755)
    os.write(writer, b"n in a lesson\n")
    runner.Desk(None, None, live.lines).listen(0.0)
    os.write(writer, b"n in a break\n\n")
    pause = next(step for step in schedule.steps_of(kept.plan, "sub-01") if step.kind == "break")
    pause.run(session.Session(kept, live), kept.progress(), kept.progress().person("sub-01"), None)
    os.write(writer, b"a\n")
    live.paused, went_on = True, threading.Event()

    def enter():
        while not went_on.wait(0.2):  # the first may come before the pause waits for it
            os.write(writer, b"\n")
    entering = threading.Thread(target=enter, daemon=True)
    entering.start()
    live.pause()
    went_on.set()
    entering.join()
    os.write(writer, b"n before a trial\n")
    session.Session(kept, live, say=lambda line: None).next("sub-01")
    assert [line for line in capsys.readouterr().out.splitlines(keepends=True) if told in line] == [
        f'navvi: "{line}"{told}' for line in ("n in a lesson", "n in a break", "a", "n before a trial")]
    assert kept.notes("sub-01") == []
    os.close(writer)
    begun = time.monotonic()
    live.lines.drop(0.1)
    assert time.monotonic() - begun >= 0.1, "also where nothing can be typed"


def test_all_lines_of_a_terminal_that_were_typed_while_no_trial_ran_are_no_notes_of_the_next(capsys):
    master, slave = pty.openpty()
    lines = runner.Lines(slave)
    os.write(master, b"n first\nn second\na\n")
    lines.drop()
    assert lines.next(0.0) is None and capsys.readouterr().out.count(" was typed while no trial runs") == 3
    os.write(master, b"n in the trial\n")
    assert lines.next(5.0) == "n in the trial"
    for end in master, slave:
        os.close(end)


@pytest.mark.parametrize("seconds", [0.0, 0.01])
def test_what_does_not_cease_to_come_is_read_no_longer_than_it_shall_be(tmp_path, seconds):
    (tmp_path / "typed").touch()
    os.truncate(tmp_path / "typed", 1 << 30)  # of zeros, which are all there at once
    with open(tmp_path / "typed", "rb", buffering=0) as typed:
        lines = runner.Lines(typed.fileno())
        lines.drop(seconds)
        assert lines.open and 0 < typed.tell() < 1 << 30
    with subprocess.Popen(["yes"], stdout=subprocess.PIPE) as typing:
        runner.Lines(typing.stdout.fileno()).drop(seconds)
        typing.kill()


@pytest.mark.parametrize("problem", [StudyError("the disk is full"), UnicodeEncodeError("utf-8", "\udce9", 0, 1, "no"), OSError(28, "No space left")])
def test_D2_a_note_that_cannot_be_written_is_told_and_the_trial_is_ended_all_the_same(problem, capsys, monkeypatch):
    ended = []
    monkeypatch.setattr(runner.os, "killpg", lambda *given: ended.append(given))

    def note(row):
        raise problem
    desk = runner.Desk(type("Process", (), {"pid": 7}), note)
    desk.obey("n the door opened")
    desk.obey("a")
    assert capsys.readouterr().out.count("is NOT written") == 2 and ended == [(7, signal.SIGINT)]


def test_D1_verify_counts_notes_and_answers_and_names_each_line_that_is_passed_over(work):
    rest(work())
    attempt, _ = trial_of(work.study)
    for text in ("one", "two"):
        work.study.note("sub-01", attempt, {"utc": "2026-01-01T00:00:00Z", "mono_ns": 1, "type": "note", "text": text})
    assert verify.notes_and_answers(work.study, work.study.progress())[1:] == ({"notes": 2, "answers": 12}, 0)
    for kind, damage in (("notes", b'{"step": "s1-c1-trial-1", "att\n[1]\n'), ("answers", b"\xff\n" + b"[" * 100000 + b"\n")):
        with open(work.study.home("sub-01") / f"{kind}.jsonl", "ab") as file:
            file.write(damage)
    sentences, counts, lost = verify.notes_and_answers(work.study, work.study.progress())
    assert sentences[0] == "sub-01: notes 2 of 4, answers 12 of 14." and counts == {"notes": 4, "answers": 14} and lost == 4
    named = [f"{work.study.home('sub-01') / kind}.jsonl:{number}: the line is damaged or unfinished{more}; it is passed over."
             for kind, more, numbers in (("notes", "", (3, 4)), ("answers", ", or its item does not allow the answer", (13, 14)))
             for number in numbers]
    assert sentences[1:] == named and all(f"  {sentence}" in overview.status(work.study, work.study.progress()) for sentence in named)
    assert len(table.answers(work.study, work.study.progress())) == 12


CHANGES = {
    "file": lambda lines: [], "line": lambda lines: lines[:3] + lines[4:],
    "twice": lambda lines: [*lines, lines[2].replace('"step": ', '"again": 1, "step": ')],
    "answer": lambda lines: [lines[0].replace('"answer": "', '"answer": "1'), *lines[1:]]}


@pytest.mark.parametrize("change", CHANGES)
def test_verify_names_the_step_whose_answers_are_not_those_that_were_given(work, monkeypatch, capsys, change):
    monkeypatch.setitem(actions.TOOLS, "tool", lambda *given: "true")
    rest(work())
    assert actions.verify(words(work.study, accept_loss=None)) == 0
    path, told = work.study.home("sub-01") / "answers.jsonl", "sub-01 s1-c1-tlx: the answers are not those that were given"
    path.write_text("".join(CHANGES[change](path.read_text().splitlines(keepends=True))))
    capsys.readouterr()
    assert actions.verify(words(work.study, accept_loss=None)) == 1
    said = capsys.readouterr().out
    assert told in said and ("sub-01 s1-c2-tlx" in said) == (change == "file") and ", 0 lost" not in said
    for row in (state := work.study.progress()).people["sub-01"].done.values():
        row.pop("answers", None)
    assert told not in str(verify.notes_and_answers(work.study, state)), "as in journals of before"


@pytest.mark.parametrize("answer", ["9999", "abc", "nan", "-1"])
def test_an_answer_that_its_item_does_not_allow_is_named_and_is_in_no_result(work, answer):
    rest(work())
    path = work.study.home("sub-01") / "answers.jsonl"
    first, *others = map(json.loads, path.read_text().splitlines())
    path.write_text("".join(json.dumps(row) + "\n" for row in ({**first, "answer": answer}, *others)))
    state = work.study.progress()
    assert len(table.answers(work.study, state)) == 11 and table.scores(work.study, state)[0]["score"] is None
    sentences, _, lost = verify.notes_and_answers(work.study, state)
    assert lost == 2 and f"{path}:1: the line is damaged or unfinished, or its item does not allow the answer; it is passed over." in sentences
    assert ["lines of notes and answers that cannot be read", 1] in report.quality(work.study, state)
    assert report.page(work.study, state, rehearsed=False)


def test_nobody_tells_answers_by_their_sum_once_they_are_erased(work):
    rest(work())
    assert all("salt" not in row for row in work.study.answers("sub-01"))
    path = work.study.home("sub-01") / "answers.jsonl"
    assert len({json.loads(line)["salt"] for line in path.read_text().splitlines()}) == 12


def test_a_reason_that_is_not_utf_8_leaves_the_journal_whole(work):
    rest(work())
    actions.exclude(exclusion(work.study, "sub-01", "caf\udce9"))
    assert work.study.journal.rows()[-1]["reason"] == "caf?" == journal.Journal(work.study.journal.path).rows()[-1]["reason"]


def test_a_record_whose_bytes_are_not_utf_8_is_read(work):
    rest(work())
    _, trial = trial_of(work.study)
    write_record(trial)
    for name, more in (("events.csv", b"3.000,0,t,caf\xe9\xe2\x80\xa8,1.0,2.0,n/a\n"), ("journal.csv", b"\x85\xff\n")):
        with open(trial / name, "ab") as file:
            file.write(more)
    assert [row["trial_type"] for row in table.events(work.study, work.study.progress())] == ["goal reached", "caf\ufffd\u2028", "intruder"]
    assert len(record.Record(trial).rows) == 3


def test_marks_stand_among_the_events_of_their_trial_at_its_own_time(work):
    work().next("sub-01")
    attempt, trial = trial_of(work.study)
    write_record(trial)
    for mono, kind, text in ((1002.0, "mark", ""), (1000.5, "note", "the door opened"), (1012.0, "intervention", "late")):
        work.study.note("sub-01", attempt, {"utc": "2026-01-01T00:00:00Z", "mono_ns": int(mono * 1e9), "type": kind, "text": text})
    rows = table.events(work.study, work.study.progress())
    assert [(row["onset_s"], row["trial_type"], row["detail"]) for row in rows] == [
        ("1.000", "note", "the door opened"), ("2.500", "goal reached", "n/a"), ("3.500", "intruder", "/rostopic_7_1767225600000"),
        ("4.000", "mark", "n/a"), ("22.000", "intervention", "late")]
    assert all(row["participant"] == "sub-01" and row["counts"] == "yes" and row["trial"] == attempt.trial for row in rows)
    files = table.write(work.study, work.study.progress(), FIGURES)
    described = json.loads((work.study.folder / "events.json").read_text())
    assert described["onset_s"]["Units"] == "s" and work.study.folder / "events.csv" in files


def test_notes_before_between_and_after_the_legs_of_a_job_are_each_in_one_leg(tmp_path):
    kept = job(tmp_path)
    begin(kept, driver=Named).next("sub-01")
    attempt, last = trial_of(kept)
    path = last / "journal.csv"  # which begins 20 s after the end of the first
    path.write_text(re.sub(r",(1\d{12}),", lambda found: f",{int(found[1]) + 30 * 10**9},", path.read_text()))
    for mono, text in (990, "before"), (1002, "in the first"), (1020, "between"), (1032, "in the second"), (1050, "after"):
        kept.note("sub-01", attempt, {"utc": "2026-01-01T00:00:00Z", "mono_ns": mono * 10**9, "type": "note", "text": text})
    told = [(row["trial"], row["detail"]) for row in table.events(kept, kept.progress()) if row["trial_type"] == "note"]
    first, second = attempt.legs
    assert told == [(first, "before"), (first, "in the first"), (first, "between"), (second, "in the second"), (second, "after")]
    assert [row["marks"] for row in table.trials(kept, kept.progress())] == ["5", "0"]


def test_nothing_of_a_study_names_a_person_but_by_code(work):
    rest(work())
    shutil.rmtree(work.study.home("sub-01"))
    text = work.study.journal.path.read_text()
    assert "sub-01" in text and "mental" not in text


def test_a_way_is_resampled_at_an_even_rate_and_turns_the_short_way_round():
    rows = export.resampled([(10.0, 0.0, 0.0, 3.0), (10.2, 1.0, 0.0, -3.0), (10.3, 1.0, 2.0, -3.0)], 10.0)
    assert [(round(x, 6), round(y, 6)) for x, y, _ in rows] == [(0.0, 0.0), (0.5, 0.0), (1.0, 0.0), (1.0, 2.0)]
    assert rows[1][2] == pytest.approx(math.pi, abs=1e-6) or rows[1][2] == pytest.approx(-math.pi, abs=1e-6)
    assert export.resampled([], 10.0) == []


def test_an_export_has_the_names_of_bids_no_date_and_the_same_bytes_twice(work):
    rest(work())
    state = work.study.progress()
    for at in range(2):
        write_record(trial_of(work.study, at=at)[1])

    for kind in "mark", "note", "intervention", "pause", "abort":
        work.study.note("sub-01", trial_of(work.study)[0], {"utc": "", "mono_ns": int(1002e9), "type": kind, "text": "Anna sat down"})

    def way(path):
        return [(9.0 + step, float(step), 0.0, 0.0) for step in range(30)]
    folder = export.write(work.study, state, way)
    first = {path.relative_to(folder): path.read_bytes() for path in folder.rglob("*") if path.is_file()}
    assert {path.relative_to(folder): path.read_bytes() for path in export.write(work.study, state, way).rglob("*") if path.is_file()} == first
    motion = folder / "sub-01/ses-1/motion"
    names = sorted(path.name for path in motion.iterdir())
    assert len(names) == 2 * 5 and "sub-01_ses-1_task-drive_tracksys-odometry_acq-plain_run-01_motion.tsv" in names
    lines = next(motion.glob("*_motion.tsv")).read_text().splitlines()
    assert len(lines) == 20 * 20 + 1 and lines[0].split("\t")[0] == "1.0000"  # from the begin of the trial on, 20 s at 20 Hz
    assert not any(word in content for content in first.values() for word in (b"2026", b"1767225600", b"Anna"))
    assert next(motion.glob("*acq-full*_events.tsv")).read_text().count("\tnote\tn/a\tn/a\tn/a\n") == 1
    assert next(motion.glob("*acq-full*_events.tsv")).read_text().count("\tintruder\t1.0\t2.0\tn/a\n") == 1


@pytest.mark.parametrize("change, both", [
    (("participants: sub-01..sub-04", "participants: [p-1, p1]"), "p-1 and p1 would both be sub-p1 "),
    (("conditions: {full: {picture: false}, plain:", "conditions: {full: {picture: false}, ful-l:"), "full and ful-l would both be full ")])
def test_an_export_in_which_two_would_have_one_name_is_refused_and_leaves_the_one_of_before(tmp_path, change, both):
    kept = frozen(tmp_path, change, *([("[plain, full]", "[ful-l, full]")] if "ful-l" in change[1] else []))
    before = tmp_path / "small/bids/README"
    before.parent.mkdir()
    before.touch()
    with pytest.raises(StudyError, match=both):
        export.write(kept, kept.progress(), None)
    assert before.exists()
