"""Studies without a session: what comes next."""
import getpass
import itertools
import multiprocessing
import os
import signal
import subprocess
import time
from pathlib import Path

import pytest

from small_study import Driver, begin, exclusion, frozen, rehearsed, rest, small, trial_of, words, work, write_record, write_summary  # noqa: F401
from navvi_cli import workspace
from navvi_cli.commands import study as command
from navvi_cli.say import fail
from navvi_study import actions, export, journal, measures, overview, report, runner, session, study, table, ways
from navvi_study.analysis import Analysis
from navvi_study.errors import StudyError
from sessions import ROOT, eventually


def test_a_participant_is_led_through_the_plan(work, capsys):
    assert rest(work()) == ["s1-c1-trial-1", "s1-c1-tlx", "s1-c2-trial-1", "s1-c2-tlx", "s1-end"]
    assert work.study.progress().complete(work.study.progress().person("sub-01"))
    actions.status(words(work.study))
    assert "sub-01: 2 of 2 trials; has done everything.\n" in capsys.readouterr().out


def test_next_and_run_end_with_the_codes_of_their_help(work, monkeypatch):
    begun, paused, reports = work("none"), [], []
    begun.runner.pause = lambda: paused.append(True)
    monkeypatch.setattr(actions, "_live_session", lambda study, typed: None if typed else begun)
    monkeypatch.setattr(actions, "_write_report", lambda study, only, rehearsed: reports.append((study.letters, rehearsed)))

    def next_code(session=False):
        return actions.next_(words(work.study, participant="sub-01", typed=False, session=session))
    assert [next_code(), next_code()] == [1, 0] and not paused
    assert next_code(session=True) == 0 and len(paused) == 3 and next_code() == 3, "between its four steps that were left"
    begun.runner.results = ["none"]
    assert actions.run(words(work.study, only=None)) == 1 and not reports
    assert actions.run(words(work.study, only=None)) == 0 and reports == [({}, False)] and work.study.progress().over


def test_nothing_begins_before_the_plan_is_frozen_or_once_it_has_changed(tmp_path):
    kept = study.Study(small(tmp_path))
    with pytest.raises(StudyError, match="not frozen"):
        rest(session.Session(kept, Driver(kept)))
    kept.freeze("test", None)
    changed = study.Study(small(tmp_path, ("limit: 60", "limit: 90")))
    with pytest.raises(StudyError, match="limit: 60.0 is now 90.0"):
        rest(session.Session(changed, Driver(changed)))
    with pytest.raises(StudyError, match="--reason"):
        changed.freeze("test", None)
    with pytest.raises(StudyError, match="nothing has changed"):
        kept.freeze("test", "once more")
    assert changed.freeze("test", "too short") == ["limit: 60.0 is now 90.0"]
    assert changed.progress().freezes[-1]["changes"] == ["limit: 60.0 is now 90.0"]


def test_a_person_is_not_led_through_a_whole_study_at_once(tmp_path):
    kept = frozen(tmp_path, ("operator: simulated", "operator: pad"))
    with pytest.raises(StudyError, match='"pad"; study run is for simulated'):
        actions.run(words(kept, only=None))


def test_a_trial_that_breaks_off_is_kept_and_a_reserve_world_takes_its_place(work):
    begun = work("aborted")
    assert rest(begun)[:2] == ["s1-c1-trial-1", "s1-c1-trial-1"]
    assert begun.runner.driven[:2] == [("easy", 1), ("easy", 11)]
    rows = table.trials(work.study, work.study.progress())
    assert [(row["attempt"], row["counts"], row["excluded"], row["replaces"]) for row in rows[:2]] == [
        ("1", "no", "the trial broke off", "n/a"), ("2", "yes", "n/a", "trial-1")]


def test_what_is_done_and_what_came_of_it_is_told(work):
    class Closing(Driver):
        def close(self, folder):
            closed.append(folder.name)
    closed, said = [], []
    begun = begin(work.study, "none", "killed", "aborted", driver=Closing, say=said.append)
    assert begun.next("sub-01") is None
    with pytest.raises(KeyboardInterrupt):
        begun.next("sub-01")
    begun.next("sub-01")
    assert closed == ["s1-c1-trial-1-a2"]
    assert [row["excluded_by"] for row in table.trials(work.study, work.study.progress())] == ["rule"]
    assert said[0].startswith("navvi: sub-01: ")
    for line in ("no trial began", "sub-01: aborted, 20.0 s; the record is in ", "the trial does not count: the trial broke off."):
        assert any(line in one for one in said), line
    rest(begun)
    assert said[-1] == "navvi: sub-01: has done everything."
    assert session.Session(work.study, None).wait, "a break lasts as long as planned"


def test_who_ends_practice_is_no_drop_out_and_neither_is_who_arrived(tmp_path):
    kept = frozen(tmp_path, ("limit: 60", "practice: {worlds: {world: training, seeds: 1..2}, in_a_row: 1, collisions_at_most: 3, most: 2}\nlimit: 60"))

    class Ending(Driver):
        def trial(self, participant, step, attempt, folder, lock):
            kept.note(participant, attempt, {"utc": "", "mono_ns": 1, "type": "abort", "text": ""})
            super().trial(participant, step, attempt, folder, lock)
    rest(begin(kept, "aborted", driver=Ending))
    assert not any(attempt.dropped_out for attempt in kept.progress().person("sub-01").attempts)


RULE = "exclusions: [{column: result, is: [aborted, invalid], reason: the trial broke off}]"


@pytest.mark.parametrize("results, reasons", [(["invalid"], ["its record is not whole"]), (["aborted", "refused"], ["it broke off"] * 2)])
def test_D5_trials_that_broke_off_count_in_no_plan(tmp_path, results, reasons):
    kept = frozen(tmp_path, (RULE, ""))
    rest(begin(kept, *results))
    assert [(row["counts"], row["excluded"]) for row in table.trials(kept, kept.progress())] == [("no", reason) for reason in reasons] + [("yes", "n/a")] * 2


@pytest.mark.parametrize("exclusions", [True, False])
def test_D5_who_ends_a_trial_is_a_drop_out_and_drives_in_no_easier_world(tmp_path, exclusions, capsys):
    kept = frozen(tmp_path, ("sub-01..sub-04", "sub-01..sub-06"), *([] if exclusions else [(RULE, "")]))

    class GivingUp(Driver):
        """The person ends a trial of sub-01, and the experimenter one of sub-02; one of sub-03 breaks off by itself, and in one of sub-04 the
        experimenter saw that it would."""
        def trial(self, participant, step, attempt, folder, lock):
            ends = participant in ("sub-01", "sub-02", "sub-03", "sub-04") and step.condition == "plain" and attempt.number == 1
            if participant in ("sub-02", "sub-04") and ends:
                kept.note(participant, attempt, {"utc": "", "mono_ns": 1, "type": "abort", "text": ""})
            reason = {"sub-01": "ended_by_person", "sub-02": "stopped_by_signal", "sub-04": "guidance_lost"}.get(participant, "goal_changed")
            self.driven.append((participant, attempt.seed))
            write_summary(folder / f"trial-{len(self.driven)}", "aborted" if ends else "reached", reason=reason if ends else "n/a")
    driver = GivingUp(kept)
    said = []
    for name in kept.plan.participants:
        rest(session.Session(kept, driver, say=said.append, wait=False), name)
    assert [seed for name, seed in driver.driven if seed > 10] == [11, 11], "a world of the reserve for sub-03 and sub-04"
    rows = table.trials(kept, kept.progress())
    assert [row["counts"] for row in rows if row["participant"] in ("sub-01", "sub-02") and row["condition"] == "plain"] == ["drop-out"] * 2
    for name in "sub-03", "sub-04":
        assert [row["counts"] for row in rows if row["participant"] == name and row["condition"] == "plain"] == ["no", "yes"]
    assert {row["excluded_by"] for row in rows if row["counts"] == "drop-out"} == {"rule"}
    assert sum("a drop-out, ended by the" in line and line.endswith("if one is left.") for line in said) == 2 and kept.progress().missing(kept.progress().person("sub-01")) == []
    lines = overview.status(kept, kept.progress())
    assert any("is a drop-out: ended by the person." in line for line in lines) and not any("without a trial" in line for line in lines)
    analysis = Analysis(kept, kept.progress())
    shown = {name: {row["condition"]: (row["trials"], round(row["mean"], 3)) for row in analysis.by_condition(name)} for name in ("reached", "drop_out", "collisions")}
    assert shown == {"reached": {"full": (6, 1.0), "plain": (6, 0.667)}, "drop_out": {"full": (6, 0.0), "plain": (6, 0.333)},
                     "collisions": {"full": (6, 3.0), "plain": (4, 3.0)}}
    name = next(row["trial"] for row in rows if row["counts"] == "drop-out")
    actions.exclude(exclusion(kept, f"sub-01/{name}", "the fire alarm rang"))
    assert "Another world takes its place." in capsys.readouterr().out
    begun = session.Session(kept, driver, say=said.append, wait=False)
    assert len(rest(begun, "sub-01")) == 1 and driver.driven[-1] == ("sub-01", 11)


def test_check_and_freeze_say_what_happens_to_a_trial_that_breaks_off(tmp_path, capsys):
    plan = small(tmp_path)
    actions.TOOLS["version"] = lambda: "test"
    actions.freeze(words(study.Study(plan), reason=None))
    printed = capsys.readouterr().out
    for line in overview.broken_off(plan):
        assert line in printed and line in overview.schedule(plan)
    assert "nothing takes its place" in printed and "The same holds where result is aborted or invalid: the trial broke off." in printed


def test_a_freeze_that_is_given_again_leaves_the_page_whose_write_has_failed(tmp_path, monkeypatch):
    monkeypatch.setitem(actions.TOOLS, "version", lambda: "test")
    args, page = words(study.Study(small(tmp_path)), reason=None), tmp_path / "small/preregistration.md"
    (tmp_path / "small/preregistration.md.new").mkdir(parents=True)  # in the way of the write
    with pytest.raises(StudyError, match="preregistration.md cannot be written: .* give the same command again"):
        actions.freeze(args)
    assert study.Study.of(args.plan).frozen() and not page.exists()
    (tmp_path / "small/preregistration.md.new").rmdir()
    with pytest.raises(StudyError, match="nothing has changed since the plan was frozen"):
        actions.freeze(args)
    text = page.read_text()
    small(tmp_path, ("limit: 60", "limit: 90"))
    page.unlink()
    with pytest.raises(StudyError, match="a change needs --reason"):
        actions.freeze(args)
    assert page.read_text() == text, "of the plan that is frozen"


def test_a_study_where_nothing_stands_is_neither_checked_nor_frozen(tmp_path, monkeypatch):
    monkeypatch.setitem(actions.TOOLS, "version", lambda: "test")
    monkeypatch.setitem(actions.TOOLS, "tool", lambda package, name: ROOT / "navvi_ws/devel/lib" / package / name)
    hall = "<sdf version='1.6'><world name='w'><include><uri>model://ground_plane</uri></include>{}</world></sdf>"
    (tmp_path / "hall.sdf").write_text(hall.format(""))
    plan = small(tmp_path, ("a: {world: easy", "a: {world: hall.sdf"))
    args = words(study.Study(plan), reason=None, no_worlds=False, pictures=False)
    for action in actions.check, actions.freeze:
        with pytest.raises(StudyError) as problem:
            action(args)
        assert "nothing stands in" in str(problem.value) and str(tmp_path / "hall.sdf") in str(problem.value)
    (tmp_path / "hall.sdf").write_text(hall.format("<model name='box'><static>1</static><pose>3 0 .5 0 0 0</pose><link name='l'><collision name='c'>"
                                                   "<geometry><box><size>1 1 1</size></box></geometry></collision></link></model>"))
    actions.freeze(args)
    assert study.Study.of(plan.file).progress().freezes


def test_a_column_that_no_summary_has_excludes_nothing_and_is_refused(tmp_path, monkeypatch):
    for name, given in ("version", lambda: "test"), ("tool", lambda package, name: ROOT / "navvi_ws/devel/lib" / package / name):
        monkeypatch.setitem(actions.TOOLS, name, given)
    args = words(study.Study(small(tmp_path, ("{column: result", "{column: missed_message, above: 9, reason: lost}, {column: result"))),
                 reason=None, no_worlds=False, pictures=False)
    for action in actions.check, actions.freeze:
        with pytest.raises(StudyError, match="\"exclusions\" have the column \"missed_message\", which no summary has; .* such as missed_messages, "):
            action(args)
    (tmp_path / "small.yaml").write_text((tmp_path / "small.yaml").read_text().replace("missed_message,", "missed_messages,"))
    actions.freeze(args)


def test_zones_that_a_session_refuses_are_neither_checked_nor_frozen(tmp_path, monkeypatch):
    monkeypatch.setitem(actions.TOOLS, "version", lambda: "test")
    monkeypatch.setitem(actions.TOOLS, "tool", lambda package, name: ROOT / "navvi_ws/devel/lib" / package / name)
    (tmp_path / "own.yaml").write_text("- {name: dock, kind: slow, corners: [0, 0, 1, 0, 1, 1]}\n")
    args = words(study.Study(small(tmp_path, ("a: {world: easy", "a: {zones: own.yaml, world: easy"))), reason=None, no_worlds=False, pictures=False)
    for action in actions.check, actions.freeze:
        with pytest.raises(StudyError, match="own.yaml, line 1: \"speed\" .m/s. belongs to each slow zone, and to no other.$"):
            action(args)


@pytest.mark.parametrize("names, says", [
    (("gate-4", "dock"), "line 1: \"name\" cannot be spoken"), (("dock", "gateofthegreatnorthernhall"), "line 2: \"name\" cannot be spoken"),
    (("dock", "dock"), "line 2: .*dock")])
def test_a_job_that_a_session_refuses_is_neither_checked_nor_frozen_nor_rehearsed(tmp_path, monkeypatch, names, says):
    monkeypatch.setitem(actions.TOOLS, "version", lambda: "test")
    monkeypatch.setitem(actions.TOOLS, "tool", lambda package, name: ROOT / "navvi_ws/devel/lib" / package / name)
    (tmp_path / "round.yaml").write_text("".join(f"- {{name: {name}, x: {x}, y: 0}}\n" for x, name in enumerate(names)))
    plan = small(tmp_path, ("a: {world: easy", "a: {jobs: round.yaml, world: easy"))
    args = words(study.Study(plan), reason=None, no_worlds=False, pictures=False, only=None)
    for action in actions.check, actions.freeze, actions.rehearse:
        with pytest.raises(StudyError, match=f"round.yaml.*{says}"):
            action(args)


@pytest.mark.parametrize("said", ["Do you agree to take part?", "Write to ethics@uni.example", "Our Rindfleischettikettierung"])
def test_a_consent_that_cannot_be_spoken_is_named_before_it_is_frozen_and_can_only_be_typed(tmp_path, monkeypatch, capsys, said):
    for name, given in (("version", lambda: "test"), ("navvi", lambda *_: None),
                        ("tool", lambda package, name: ROOT / "navvi_ws/devel/lib" / package / name)):
        monkeypatch.setitem(actions.TOOLS, name, given)
    items = "items: [{{name: agree, ask: \"{}\", choices: [\"no\", \"yes\"], required: \"yes\"}}]\ntitle: Consent\n"
    (tmp_path / "own.yaml").write_text(items.format(said))
    kept = study.Study(small(tmp_path, ("limit: 60", "limit: 60\nconsent: own")))
    args = words(kept, reason=None, no_worlds=False, pictures=False, only=None)
    for action in actions.check, actions.freeze:
        action(args)
        says = capsys.readouterr().out
        assert f"{tmp_path}/own.yaml: items[0]/ask cannot be spoken: \"{said}\"; allowed are letters" in says and "next --typed" in says
    assert study.Study.of(args.plan).progress().freezes
    with pytest.raises(StudyError, match="cannot be spoken"):
        actions._live_session(kept, typed=False)
    actions._live_session(kept, typed=True)


@pytest.mark.parametrize("old, new, says", [
    ("lead: words", "lead: wrods", "lead\" is wrods; allowed is one of words, ticks, flow, hand"), ("feedback/lead", "feedback/ledd", "nearest is lead"),
    ("feedback/lead: words", "sim/seed: 3", "seed"),
    ("feedback/lead: words", "feedback/lead: hand", "lead is hand, but haptics/enabled is false"),
    ("feedback/lead: words", "feedback/haptics/classes: [lamp]", "lamp"), ("feedback/lead: words", "touch/lead: 3", "\"touch\" has no parameters")])
def test_parameters_that_a_session_refuses_are_neither_checked_nor_frozen(tmp_path, monkeypatch, old, new, says):
    monkeypatch.setattr(workspace, "is_current", lambda *programs: True)
    for name, given in ("version", lambda: "test"), ("tool", lambda package, name: ROOT / "navvi_ws/devel/lib" / package / name), ("accept", command._accept):
        monkeypatch.setitem(actions.TOOLS, name, given)
    good = "touch: false, parameters: {feedback/lead: words, feedback/language: es}"
    args = words(study.Study(small(tmp_path, ("touch: false", good.replace(old, new)))), reason=None, no_worlds=False, pictures=False)
    for action in actions.check, actions.freeze:
        with pytest.raises(StudyError) as problem:
            action(args)
        assert f"{args.plan}: condition plain: " in str(problem.value) and says in str(problem.value)
    (tmp_path / "small.yaml").write_text((tmp_path / "small.yaml").read_text().replace(good.replace(old, new), good))
    actions.freeze(args)
    assert study.Study.of(args.plan).progress().freezes


def test_parameters_that_cannot_be_checked_as_a_build_failed_are_named(tmp_path, monkeypatch):
    monkeypatch.setattr(workspace, "is_current", lambda *programs: False)
    monkeypatch.setattr(workspace, "build", lambda *targets: fail(None))
    for name, given in ("tool", lambda package, name: ROOT / "navvi_ws/devel/lib" / package / name), ("accept", command._accept):
        monkeypatch.setitem(actions.TOOLS, name, given)
    plan = small(tmp_path, ("touch: false", "touch: false, parameters: {feedback/lead: words}"))
    with pytest.raises(StudyError, match="small.yaml: condition plain: its parameters cannot be checked, as the build failed"):
        actions.freeze(words(study.Study(plan), reason=None))


def test_a_detour_is_of_trials_that_arrived_and_a_plan_that_takes_it_first_says_so(tmp_path):
    row = {"counts": "yes", "result": "timeout", "path_length_m": "5.0", "first_path_length_m": "10.0"}
    assert measures.value(measures.MEASURES["detour"], row) is None
    assert measures.value(measures.MEASURES["detour"], {**row, "result": "reached"}) == 0.5
    with pytest.raises(StudyError) as problem:
        small(tmp_path, ("measure: time", "measure: detour"))
    assert "\"outcomes/primary/measure\" is detour, which is defined for trials that reached the goal alone; allowed are \"trials: reached\"" in str(problem.value)
    plan = small(tmp_path, ("measure: time", "trials: reached, measure: detour"))
    assert plan.values()["primary"]["trials"] == "reached" and "of trials that reached the goal" in overview.question(plan.primary)
    with pytest.raises(StudyError, match="time is defined for trials that count; allowed is to leave it out"):
        small(tmp_path, ("measure: time", "trials: reached, measure: time"))
    assert "trials" not in small(tmp_path).values()["primary"], "plans of before keep their hash"


def test_the_page_on_studies_says_for_which_trials_each_measure_is_defined():
    page = (ROOT / "doc/study.md").read_text()
    for name, measure in measures.MEASURES.items():
        assert f"| {name} | {measure.label}, {measure.unit} | {measure.of} |" in page, name


def test_where_no_trial_began_the_same_world_comes_again(work):
    begun = work("none")
    assert begun.next("sub-01") is None and work.study.journal.rows()[-1]["collisions"] is None
    assert rest(begun)[0] == "s1-c1-trial-1"
    assert begun.runner.driven[:2] == [("easy", 1), ("easy", 1)]


def test_a_world_in_which_no_trial_began_may_be_replaced(work, tmp_path):
    assert work("none").next("sub-01") is None
    kept = study.Study(small(tmp_path, ("sets: {a: {world: easy, seeds: [1]}", "sets: {a: {world: easy, seeds: [5]}")))
    kept.freeze("test", "nothing stands in it")
    assert overview.status(kept, kept.progress())
    begun = begin(kept)
    assert rest(begun)[0] == "s1-c1-trial-1" and begun.runner.driven[0] == ("easy", 5)


def crash_after_the_end(begun, monkeypatch):
    """The next step of sub-01, whose row "end" is the last that is written."""
    append = begun.study.journal.append

    def killed(kind, **fields):
        append(kind, **fields)
        if kind == "end":
            raise KeyboardInterrupt
    monkeypatch.setattr(begun.study.journal, "append", killed)
    with pytest.raises(KeyboardInterrupt):
        begun.next("sub-01")
    monkeypatch.undo()


def test_a_trial_that_broke_off_does_not_count_though_a_crash_came_right_after_its_end(work, monkeypatch):
    crash_after_the_end(work("aborted"), monkeypatch)
    begun = work()
    assert rest(begun)[0] == "s1-c1-trial-1" and begun.runner.driven[0] == ("easy", 11)
    rows = table.trials(work.study, work.study.progress())
    told = [(row["counts"], row["excluded"], row["excluded_by"]) for row in rows[:2]]
    assert told == [("no", "the trial broke off", "rule"), ("yes", "n/a", "n/a")]


def test_a_journal_of_before_whose_rules_wrote_rows_of_their_own_is_read(work):
    trial = {"participant": "sub-01", "step": "s1-c1-trial-1", "attempt": 1}
    work.study.journal.append("begin", **trial, world="easy", seed=1, replaces="")
    work.study.journal.append("end", **trial, trial="trial-1", result="aborted", collisions=None, sums={})
    work.study.journal.append("exclude", **trial, trial="trial-1", reason="drop-out: ended by the person", rule=True, replace=False, drop_out=True)
    attempt = work.study.progress().person("sub-01").attempts[0]
    assert (attempt.phase, attempt.condition, attempt.order, attempt.session, attempt.repeat) == ("trial", "full", 1, 1, 1), "as its step is now"
    assert (attempt.counts, attempt.dropped_out, attempt.final, attempt.excluded_by) == (False, True, True, "rule")


def test_a_calibration_that_failed_comes_again(tmp_path):
    kept = frozen(tmp_path, ("operator: simulated", "operator: pad\ncalibrate: true"))
    said = []

    def next_step(name, code, saved=""):
        """Of a calibration that ends with the code, and whose table says whether it was saved."""
        live = runner.LiveRunner(kept, tmp_path / f"exits_{code}", "true")
        table = f"printf 'measured,value\\ndelay_s,0.4\\nsaved,{saved}\\n' > \"${{word#feedback/record:=}}\"" if saved else "true"
        Path(live.navvi).write_text(f"#!/bin/sh\nfor word; do case $word in feedback/record:=*) {table};; esac; done\nexit {code}\n")
        Path(live.navvi).chmod(0o755)
        return session.Session(kept, live, said.append, wait=False).next(name)
    for ended in (1, ""), (1, "yes"), (130, "yes"), (0, ""):
        assert next_step("sub-01", *ended) is None and "the calibration broke off" in said[-1], ended
    for name, saved in ("sub-01", "yes"), ("sub-02", "no"):
        assert next_step(name, 0, saved).kind == "calibrate"
        progress = kept.progress()
        assert progress.next(progress.person(name)).kind == "trial" and kept.journal.rows()[-1]["saved"] == saved
    assert "ended by the person, and nothing is saved" in said[-1]


@pytest.mark.parametrize("lesson, change", [("calibrate", ("limit: 60", "limit: 60\ncalibrate: true")), ("questionnaire", ("{after_condition", "{at_begin"))])
def test_what_a_lesson_logs_lies_with_all_else_of_the_participant(tmp_path, lesson, change):
    """There a withdrawal deletes it, also where the lesson was killed."""
    kept = frozen(tmp_path, ("operator: simulated", "operator: pad"), change)
    live = runner.LiveRunner(kept, tmp_path / "navvi", "true")
    Path(live.navvi).write_text(f"#!/bin/sh\nprintf '%s\\n' \"$@\" > {tmp_path}/given\n")
    Path(live.navvi).chmod(0o755)
    session.Session(kept, live, lambda line: None, wait=False).next("sub-01")
    given = (tmp_path / "given").read_text().splitlines()
    assert given[0] == lesson and f"out:={kept.home('sub-01')}" in given


def test_a_session_that_was_killed_is_adopted_with_what_it_left(work):
    with pytest.raises(KeyboardInterrupt):
        work("killed").next("sub-01")
    attempt = work.study.progress().person("sub-01").open
    write_summary(work.study.attempt_folder("sub-01", attempt.step, attempt.number) / "trial-9", "reached")
    assert rest(work())[0] == "s1-c1-tlx"
    assert [row["trial"] for row in table.trials(work.study, work.study.progress())][0] == "trial-9"


def test_exclusions_are_rows_and_nothing_is_deleted(work, capsys):
    rest(work())
    before = work.study.journal.path.read_bytes()
    args = exclusion(work.study, "sub-01/trial-1", "the phone rang")
    actions.exclude(args)
    assert work.study.journal.path.read_bytes().startswith(before)
    with pytest.raises(StudyError, match="excluded already"):
        actions.exclude(args)
    begun = work()
    assert rest(begun) == ["s1-c1-trial-1"] and begun.runner.driven == [("easy", 11)]
    row = work.study.journal.rows()[-3]
    assert row["type"] == "exclude" and row["reason"] == "the phone rang" and row["by"] == getpass.getuser()
    assert [row["excluded_by"] for row in table.trials(work.study, work.study.progress())] == [getpass.getuser(), "n/a", "n/a"]


@pytest.mark.parametrize("results, before, no_replacement, comes", [
    ((), None, False, True), ((), None, True, False), (("aborted", "aborted"), None, False, False),
    ((), lambda kept: actions.exclude(exclusion(kept, "sub-01", "was ill")), False, False),
    ((), lambda kept: actions.withdraw(words(kept, participant="sub-01", data="keep")), False, False)],
    ids=["one_is_left", "none_is_wanted", "none_is_left", "excluded", "withdrawn"])
def test_an_exclusion_promises_another_world_only_where_one_comes(tmp_path, capsys, results, before, no_replacement, comes):
    kept = frozen(tmp_path, ("limit: 60", "limit: 60\nprobes: {after: [5, 20], worlds: {world: easy, seeds: [3, 4]}}"))
    begun = begin(kept, "reached", *results)
    begun.runner.ask = lambda *_: None  # broken off
    for _ in range(2 + len(results)):
        begun.next("sub-01")
    if before:
        before(kept)
    actions.exclude(words(kept, what=f"sub-01/{kept.progress().person('sub-01').attempts[-1].trial}", reason="a siren", no_replacement=no_replacement))
    driven = len(begun.runner.driven)
    begun.next("sub-01")
    assert ("Another world takes its place." in capsys.readouterr().out) == comes == (len(begun.runner.driven) > driven)


PAIR = "conditions: {full: {picture: false}, plain: {picture: false, touch: false}}"
MOVES = {
    "a code ahead": (("sub-01..sub-04", "sub-00..sub-04"),), "one order": (("limit: 60", "limit: 60\norder: listed"),),
    "two sessions": (("limit: 60", "limit: 60\nsessions: 2"),),
    "a third condition": ((PAIR, PAIR[:-1] + ", third: {sounds: false}}"), ("seeds: [2]}", "seeds: [2]}, c: {world: easy, seeds: [5]}")),
    "another name": ((PAIR, PAIR.replace("plain", "bare")), ("[plain, full]", "[bare, full]"))}


@pytest.mark.parametrize("change", MOVES)
def test_no_plan_moves_a_trial_that_was_driven(work, tmp_path, change):
    for name in "sub-01", "sub-02":
        rest(work(), name)
    rows, report_of = table.trials(work.study, work.study.progress()), report.trials(work.study.progress())
    other = study.Study(small(tmp_path, *MOVES[change]))
    with pytest.raises(StudyError, match="sub-0[12] has driven s1-c[12]-trial-1 in (full|plain), and the plan has s[12]-c[123]-trial-1 in "):
        other.freeze("test", "a change")
    assert len(other.progress().freezes) == 1 and table.trials(other, other.progress()) == rows, "also before a plan is frozen"
    assert {tuple(row) for row in report_of if row[1]} <= {tuple(row) for row in report.trials(other.progress())}
    assert report.page(other, other.progress(), rehearsed=False)


def test_a_plan_may_have_more_people_and_fewer_worlds_and_no_one_less_who_has_begun(tmp_path):
    kept = frozen(tmp_path, ("seeds: [1]", "seeds: [1, 5]"), ("seeds: [2]", "seeds: [2, 6]"))
    rest(begin(kept))
    rows = table.trials(kept, kept.progress())
    other = study.Study(small(tmp_path, ("sub-01..sub-04", "sub-01..sub-06")))
    other.freeze("test", "shorter sessions")
    assert table.trials(other, other.progress()) == rows and [row["repeat"] for row in rows] == ["1", "2"] * 2
    assert report.page(other, other.progress(), rehearsed=False) and rest(begin(other)) == []
    with pytest.raises(StudyError, match="sub-01 has begun, and the plan has no such participant any more"):
        study.Study(small(tmp_path, ("sub-01..sub-04", "sub-02..sub-04")))


def test_a_report_has_the_ways_and_cues_of_a_condition_that_a_later_plan_drops(tmp_path):
    listed, worlds = MOVES["one order"], ("seeds: [2]}", "seeds: [2]}, c: {world: easy, seeds: [5]}")
    kept = frozen(tmp_path, *listed, worlds, (PAIR, PAIR[:-1] + ", ful-l: {sounds: false}}"))
    rest(begin(kept))
    for at in range(3):
        write_record(trial_of(kept, at=at)[1])
    other = study.Study(small(tmp_path, *listed))
    other.freeze("test", "shorter sessions")
    found = ways.records(other, other.progress())
    assert [row[0] for row in report.cues(found, other.plan)] == ["full", "plain", "ful-l"]
    drawn, = report.maps(found, other.plan, lambda *world: b"", "again")
    assert [row[:2] for row in drawn["rows"]] == [["full", 1], ["plain", 1], ["ful-l", 1]]
    for one in other, other.blinded():
        assert report.page(one, one.progress(), rehearsed=False)
    with pytest.raises(StudyError, match="full and ful-l would both be full "):
        export.write(other, other.progress(), lambda trial: [])


def test_a_trial_is_excluded_whose_step_the_plan_has_no_more(tmp_path, capsys):
    kept = frozen(tmp_path, ("limit: 60", "limit: 60\nprobes: {after: [5, 20], worlds: {world: easy, seeds: [3, 4]}}"))
    begun = begin(kept, "reached")
    begun.runner.ask = lambda *_: None
    begun.next("sub-01")
    begun.next("sub-01")
    study.Study(small(tmp_path)).freeze("test", "no probes")
    actions.exclude(exclusion(kept, "sub-01/trial-2", "a siren"))
    assert capsys.readouterr().out.endswith("sub-01/trial-2 does not count: a siren.\n")


def test_when_the_reserve_is_used_up_the_trial_is_missing_and_the_rest_goes_on(work):
    assert rest(work("aborted", "aborted", "aborted"))[3:] == ["s1-c1-tlx", "s1-c2-trial-1", "s1-c2-tlx", "s1-end"]
    state = work.study.progress()
    assert [step.name for step in state.missing(state.person("sub-01"))] == ["s1-c1-trial-1"]


def test_practice_goes_on_until_its_criterion_or_its_end(tmp_path, capsys):
    kept = frozen(tmp_path, ("limit: 60", "practice: {worlds: {world: training, seeds: 1..2}, in_a_row: 2, collisions_at_most: 3, most: 4}\nlimit: 60"))
    begun = begin(kept, "timeout", "reached", "reached")
    assert rest(begun).count("s1-practice") == 3
    begun = begin(kept, "timeout", "reached", "timeout", "reached")
    assert rest(begun, "sub-02").count("s1-practice") == 4
    people = kept.progress().people
    assert (people["sub-01"].done["s1-practice"]["mastered"], people["sub-02"].done["s1-practice"]["mastered"]) == (True, False)
    actions.exclude(exclusion(kept, f"sub-01/{people['sub-01'].attempts[0].trial}", "the phone rang"))
    assert "does not count: the phone rang.\n" in capsys.readouterr().out, "nothing is driven in its place"


def test_a_practice_trial_that_the_experimenter_excludes_is_no_try(tmp_path):
    kept = frozen(tmp_path, ("limit: 60", "practice: {worlds: {world: training, seeds: 1..2}, in_a_row: 1, collisions_at_most: 3, most: 2}\nlimit: 60"))
    begin(kept, "timeout").next("sub-01")
    actions.exclude(exclusion(kept, "sub-01/trial-1", "a siren"))
    begun = begin(kept, "aborted", "timeout")
    assert [begun.next("sub-01").kind for _ in range(3)] == ["practice", "practice", "trial"], "one that broke off is a try"


def test_practice_that_was_over_when_a_crash_came_goes_no_further(tmp_path, monkeypatch):
    kept = frozen(tmp_path, ("limit: 60", "practice: {worlds: {world: training, seeds: 1..2}, in_a_row: 1, collisions_at_most: 3, most: 2}\nlimit: 60"))
    crash_after_the_end(begin(kept, "reached"), monkeypatch)
    begun = begin(kept, "timeout")
    assert begun.next("sub-01").kind == "practice" and begun.runner.driven == []
    assert kept.progress().person("sub-01").done["s1-practice"]["mastered"] and begun.next("sub-01").kind == "trial"


def test_a_freeze_names_each_trial_that_other_exclusions_judge_otherwise(tmp_path, monkeypatch, capsys):
    monkeypatch.setitem(actions.TOOLS, "version", lambda: "test")
    practice = ("limit: 60", "limit: 60\npractice: {worlds: {world: training, seeds: [3]}, collisions_at_most: 3}")
    kept, many = frozen(tmp_path, practice), "{column: shelf_collision_count, above: 0, reason: too many}, {column: result"

    def frozen_anew(*change):
        capsys.readouterr()
        other = study.Study(small(tmp_path, practice, *change))
        actions.freeze(words(other, reason="once more"))
        told = [line for line in capsys.readouterr().out.splitlines() if "by the plan of now" in line]
        assert ["trials that the exclusions of now judge otherwise than those when they ended", len(told)] in report.quality(other, other.progress())
        return other, told
    rest(begin(kept, "reached", "aborted"))  # the first is practice, which no exclusion judges
    other, told = frozen_anew(("{column: result", many))
    assert told == [f"sub-01/{trial} counts, and by the plan of now it does not: ./navvi study exclude {other.plan.file} sub-01/{trial} "
                    "--reason \"too many\"" for trial in ("trial-3", "trial-4")]
    actions.exclude(exclusion(other, "sub-01/trial-3", "too many"))
    begin(other).next("sub-01")  # in its place, and it does not count by the rule
    assert frozen_anew()[1] == ["sub-01/trial-1 does not count, and by the plan of now it would: too many."]


def test_nobody_drives_without_consent(tmp_path):
    (tmp_path / "consent.yaml").write_text("title: Consent\nitems: [{name: agree, ask: Do you agree, choices: [\"no\", \"yes\"], required: \"yes\"}]")
    kept = frozen(tmp_path, ("limit: 60", "consent: consent\nlimit: 60"))
    said = []
    begun = begin(kept, say=said.append)
    begun.runner.ask = lambda participant, step, items, answered, lock: answered(items[0], "no")
    assert begun.next("sub-01") is None
    assert said[-1] == "navvi: sub-01: consent is not given, by an answer that was drawn: nobody was asked."
    assert kept.journal.rows()[-1]["asked"] == "nobody", "a rehearsed consent is told from a real one"
    with_status = "\n".join(overview.status(kept, kept.progress()))
    assert "sub-01: 0 of 2 trials; has not given consent." in with_status
    assert rest(begun) == [] and begun.runner.driven == []


def test_what_describes_a_person_is_asked_of_those_who_agreed_and_stands_in_the_table(tmp_path, monkeypatch, capsys):
    kept = frozen(tmp_path, ("operator: simulated", "operator: simulated\nconsent: consent_example"), ("{after_condition", "{at_begin: [about_you], after_condition"))
    said = []
    begun = begin(kept, say=said.append)
    answers = {"sub-01": {"describe": "yes", "share": "no"}, "sub-02": {"describe": "no", "share": "yes"}}
    begun.runner.ask = lambda participant, step, items, answered, lock: [
        answered(item, {"take_part": "yes", **answers[participant]}.get(item.name) or item.values()[-1]) for item in items]
    for name in answers:
        rest(begun, name)
    assert any(line == "navvi: sub-02: the questionnaire about_you is left out; the consent has no yes to \"describe\"." for line in said)
    rows = {row["participant"]: row for row in table.trials(kept, kept.progress())}
    columns = ("person_age_band", "person_acuity", "person_onset", "person_hearing", "person_touch")
    assert [rows["sub-01"][name] for name in columns] == ["75 or more", "full sight", "full sight", "hearing aid", "little"]
    assert [rows["sub-02"][name] for name in columns] == ["n/a"] * 5
    for name, at in itertools.product(answers, range(2)):
        write_record(trial_of(kept, name, at)[1])
    folder = export.write(kept, kept.progress(), lambda trial: [])
    assert (folder / "participants.tsv").read_text().splitlines() == ["participant_id\tgroup\t" + "\t".join(columns), "sub-02\tall" + "\tn/a" * 5], "sub-01 said no to share"
    monkeypatch.setattr(export, "way_of", lambda trial: [])
    monkeypatch.setattr(export, "agreed", lambda *_: {"sub-01": False, "sub-02": True, "sub-03": True})
    actions.export(words(kept, bids=True))
    assert "navvi: left out: 1 of 3 participants, without a yes to share in the consent." in capsys.readouterr().out
    assert "at_begin" not in small(tmp_path).values() and "scope" not in str(small(tmp_path).values()), "plans without keep their hash"


@pytest.mark.parametrize("later", ["", "\nconsent: consent"])
def test_a_no_to_sharing_holds_whatever_consent_a_later_plan_has(tmp_path, later):
    (tmp_path / "consent.yaml").write_text("title: Consent\nitems: [{name: agree, ask: Do you agree, choices: [\"no\", \"yes\"], required: \"yes\"}]")
    kept = frozen(tmp_path, ("limit: 60", "limit: 60\nconsent: consent_example"))
    for name, share in ("sub-01", "no"), ("sub-02", "yes"):
        begun = begin(kept)
        begun.runner.ask = lambda participant, step, items, answered, lock, share=share: [
            answered(item, share if item.name == "share" else item.values()[-1]) for item in items]
        rest(begun, name)
    other = study.Study(small(tmp_path, ("limit: 60", "limit: 60" + later)))
    other.freeze("test", "version 2")
    rest(begin(other), "sub-03")
    for name, at in itertools.product(("sub-01", "sub-02", "sub-03"), range(2)):
        write_record(trial_of(other, name, at)[1])
    assert export.agreed(other, other.progress()) == {"sub-01": False, "sub-02": True, "sub-03": True}
    folder = export.write(other, other.progress(), lambda trial: [])
    assert sorted(path.name for path in folder.glob("sub-*")) == ["sub-02", "sub-03"] and "sub-01" not in (folder / "participants.tsv").read_text()


def test_who_withdraws_is_erased_also_when_that_was_broken_off(work, tmp_path):
    rest(work())
    work.study.journal.append("withdraw", participant="sub-01", data="delete")
    home = work.study.home("sub-01")
    home.rename(tmp_path / "moved")
    home.symlink_to(tmp_path / "moved")
    with pytest.raises(StudyError, match="sub-01 cannot be deleted"):
        study.Study(work.study.plan)
    home.unlink()
    (tmp_path / "moved").rename(home)
    (work.study.folder / "bids").symlink_to(tmp_path / "shared")
    (tmp_path / "shared/sub-01").mkdir(parents=True)
    for attempt in (lambda: study.Study(work.study.plan), lambda: export.write(work.study, work.study.progress(), export.way_of)):
        with pytest.raises(StudyError, match="bids cannot be deleted"):
            attempt()
    assert [row["type"] for row in work.study.journal.rows()][-1] == "withdraw"
    (work.study.folder / "bids").unlink()
    again = [study.Study(work.study.plan) for _ in range(2)][-1]  # after a crash, any command, and the next
    assert not again.home("sub-01").exists()
    assert [row["type"] for row in again.journal.rows()][-2:] == ["withdraw", "erased"], "once"
    assert table.trials(again, again.progress()) == [] and table.answers(again, again.progress()) == []
    assert rest(work()) == []


def test_a_check_without_worlds_says_what_was_not_checked(work, capsys):
    assert actions.check(words(work.study, no_worlds=True, pictures=False)) == 0
    assert capsys.readouterr().out.endswith("\nThe worlds and the parameters of the conditions were not checked.\n")


def test_no_table_and_no_export_holds_who_has_withdrawn(work, monkeypatch, capsys):
    monkeypatch.setattr(actions, "_figures", lambda: [])
    monkeypatch.setattr(export, "way_of", lambda trial: [])
    for name in "sub-01", "sub-02":
        rest(work(), name)
        for at in range(2):
            write_record(trial_of(work.study, name, at)[1])

    def holding(name):
        return {path.name for path in work.study.folder.rglob("*.?sv") if name in path.read_text() or name in path.name}
    holders = {"report.html", "report-blind.html", "report.html.new", "time.svg", "time-blind.svg", "trials.csv.new"}
    for delete, left in ("keep", {"trials.csv", "answers.csv", "events.csv", "participants.tsv"}), ("delete", set()):
        actions.table(words(work.study))
        actions.export(words(work.study, bids=True))
        for name in holders:
            (work.study.folder / name).write_text("a line of sub-02")
        actions.withdraw(words(work.study, participant="sub-02", data=delete))
        assert holders & {path.name for path in work.study.folder.iterdir()} == (holders if delete == "keep" else set())
        said = capsys.readouterr().out
        assert ("what was recorded is kept.\n" if delete == "keep" else "\"study report\" and \"study export\" write those anew") in said.splitlines(True)[-1]
        assert holding("sub-02") >= left and (left or not holding("sub-02")), delete
    with pytest.raises(StudyError, match="sub-02 has withdrawn already"):
        actions.withdraw(words(work.study, participant="sub-02", data="keep"))
    actions.table(words(work.study))
    assert holding("sub-01") and not holding("sub-02")


def test_the_study_stops_where_the_plan_says(tmp_path):
    kept = frozen(tmp_path, ("limit: 60", "stop: {completed: 1}\nlimit: 60"))
    begun = begin(kept)
    assert not kept.progress().over
    rest(begun)
    assert kept.progress().over
    with pytest.raises(StudyError, match="stops after 1"):
        begun.next("sub-02")
    with pytest.raises(StudyError, match="sub-09"):
        begun.next("sub-09")


def test_who_is_excluded_does_nothing_more_and_counts_in_nothing(work):
    said = []
    begun = work(say=said.append)
    begun.next("sub-01")
    actions.exclude(exclusion(work.study, "sub-01", "was ill"))
    assert begun.next("sub-01") is None and said[-1] == "navvi: sub-01: is excluded: was ill."
    assert [row["counts"] for row in table.trials(work.study, work.study.progress())] == ["no"]
    for what, reason, says in (("sub-01", "again", "excluded already: was ill"), ("sub-01/trial-9", "again", "names 0 trials"),
                               ("sub-02", "", "--reason is \"\"; allowed")):
        with pytest.raises(StudyError, match=says):
            actions.exclude(exclusion(work.study, what, reason))


def test_two_experimenters_do_not_drive_one_participant(work):
    with work.study.claimed("sub-01"):
        files = len(os.listdir("/proc/self/fd"))
        with pytest.raises(StudyError, match="running still"):
            work().next("sub-01")
        assert len(os.listdir("/proc/self/fd")) == files


def test_a_program_that_holds_a_participant_without_a_session_is_stopped(work):
    with work.study.claimed("sub-01") as lock:
        holder = subprocess.Popen(["sleep", "60"], pass_fds=[lock])
    assert work.study.stop("sub-01") == {holder.pid: "sleep"} and holder.wait() == -signal.SIGINT
    assert work.study.stop("sub-01") == {}
    with work.study.claimed("sub-01") as lock:
        holder = subprocess.Popen(["sh", "-c", "trap '' INT; exec sleep 60"], pass_fds=[lock])
    assert eventually(lambda: work.study.running("sub-01") == {holder.pid: "sleep"}, 10)
    with pytest.raises(StudyError, match=f"did not end within 0.1 s; \"kill -9 {holder.pid}\" ends it"):
        work.study.stop("sub-01", seconds=0.1)
    holder.kill()
    holder.wait()


def test_what_is_frozen_is_no_more_than_the_plan_asks_for(work):
    assert not work.study.seed_file.exists() and not work.study.concealed
    assert study.differences({"a": {"b": 1}, "c": [1]}, {"a": 2, "c": [1, 2]}) == ['a: {"b": 1} is now 2', "c: [1] is now [1, 2]"]


@pytest.mark.parametrize("with_command", [True, False])
def test_D3_a_session_that_outlived_its_terminal_is_named_and_stopped(work, tmp_path, capsys, with_command):
    navvi = tmp_path / "navvi"
    navvi.write_text(f"""#!/bin/sh
trap 'touch {tmp_path}/ended; exit 1' INT
touch {tmp_path}/there
while true; do sleep 0.1; done
""")
    navvi.chmod(0o755)
    child = multiprocessing.Process(target=lambda: session.Session(work.study, runner.LiveRunner(work.study, navvi, "true")).next("sub-01"), daemon=True)
    child.start()
    assert eventually((tmp_path / "there").exists, 20)
    if not with_command:
        os.kill(child.pid, signal.SIGKILL)
        child.join()
    orphan = next(pid for pid, name in work.study.running("sub-01").items() if name == "navvi")
    with pytest.raises(StudyError, match=rf"running still: process .*{orphan} \(navvi\).*\./navvi study stop {work.study.plan.file} sub-01"):
        work().next("sub-01")
    begun = time.monotonic()
    args = words(work.study, participant="sub-01")
    actions.stop(args)
    assert time.monotonic() - begun < 5 and (tmp_path / "ended").exists() and f"{orphan} (navvi)" in capsys.readouterr().out
    child.join()
    actions.stop(args)
    assert "nothing of sub-01 is running" in capsys.readouterr().out
    assert rest(work())[0] == "s1-c1-trial-1"
