"""Studies without a session: tables, report, paper and export."""
import html.parser
import json
import math
import os
import shutil
import signal
import time

import pytest

from small_study import Driver, EXAMPLE, PACKAGE, bench, rehearsed, rest, small, work, write_summary  # noqa: F401
from navvi_study import actions, journal, overview, probe, progress, questionnaire, record, runner, schedule, session, study, table  # noqa: E402
from navvi_study.errors import StudyError  # noqa: E402

# The tables.

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
    from navvi_study import verify
    rest(work())
    state = work.study.progress()
    programs = []
    for name, code in (("good", 0), ("bad", 1)):
        (tmp_path / name).write_text(f"#!/bin/sh\necho elapsed_s is 1 in the summary and 2 in the recount\n[ $1 = journal ] || exit {code}\n")
        (tmp_path / name).chmod(0o755)
        programs.append(tmp_path / name)
    good, bad = programs
    assert verify.verify(work.study, state, bad)[1] == 0, "nothing is counted where there is neither journal nor bag"
    attempt = state.person("sub-01").attempts[0]
    trial = work.study.attempt_folder("sub-01", attempt.step, attempt.number) / attempt.trial
    write_record(trial)
    (trial / "trial.bag").touch()
    assert verify.verify(work.study, state, good)[1] == 0
    sentences, differ = verify.verify(work.study, state, bad)
    assert differ == 1 and "bag differs: elapsed_s is 1 in the summary and 2 in the recount" in sentences[0] and "journal equal" in sentences[0]


def test_a_trial_whose_bag_is_recorded_as_bad_agrees_without_one(tmp_path):
    from navvi_study import verify
    assert "recorded as bad" in verify._bag(None, tmp_path, {"bag": "bad"})
    assert verify._bag(None, tmp_path, {"bag": "ok"}) == "is missing"


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


PROBES = ("limit: 60", "limit: 60\nprobes: {after: [5, 20], worlds: {world: easy, seeds: [3, 4]}}")


@pytest.fixture
def probed(tmp_path):
    """A frozen study with probes, whose trials stop at (2, 1) m with a heading of 90 degrees, having begun at (0, 0); the goal is at (2, 6)."""
    kept = study.Study(small(tmp_path, PROBES))
    kept.freeze("test", None)

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
    return lambda *results: session.Session(kept, Stopping(kept, *results), say=lambda line: None, wait=False)


def test_a_probe_stops_a_trial_of_each_condition_at_a_time_that_nobody_can_tell(tmp_path):
    plan = small(tmp_path, PROBES)
    assert rest_of_kinds(plan, "sub-01") == ["trial", "probe", "questionnaire"] * 2 + ["session_end"]
    stops = [step.limit for name in plan.participants for step in schedule.steps_of(plan, name) if step.kind == "probe"]
    assert len(set(stops)) > 3 and all(5 <= stop <= 20 for stop in stops)
    step = next(step for step in schedule.steps_of(plan, "sub-01") if step.kind == "probe")
    words = runner.LiveRunner(study.Study(plan), "navvi", "close_trials").arguments("sub-01", step, progress.Attempt(step.name, 1, "easy", 3, "", 0), tmp_path)
    assert words["limit"] == f"{step.limit:g}" and words["trial/study/phase"] == "probe"
    assert "probes" not in small(tmp_path).values() and plan.hash() != small(tmp_path).hash()


def rest_of_kinds(plan, name):
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


def test_where_the_robot_stands_at_the_place_or_the_record_does_not_know_nothing_is_true(tmp_path):
    probe_of, folder = questionnaire.find("probe", EXAMPLE.parent), tmp_path / "trial"
    folder.mkdir()
    for end, known in (("x=0.5;y=0;yaw=0;left=n/a", [None, None, None]), ("x=3;y=0", [None, None, None]),
                       ("x=-3;y=0;yaw=3.1;left=nothing", [None, "-178", "nothing"])):
        (folder / "journal.csv").write_text("head\n" + f"t,1,0,0,TRIAL_START,x=0;y=0,0\nt,2,9,9,TRIAL_END,{end},0\n")
        assert [probe.truth(item, record.Record(folder)) for item in probe_of.items] == known
    assert [probe.wrapped(angle) for angle in (180, -180, 181, 540, 0)] == [180, 180, -179, 180, 0]


def test_marks_and_interventions_stand_in_the_table(work):
    begun = work()
    drive = begun.driver.trial

    def trial(participant, step, attempt, folder, lock):
        desk = runner.Desk(None, lambda row: work.study.note(participant, attempt, row))
        for line in ("m", "n the door opened", "i led the robot", "what", "", "p"):
            desk.obey(line)
        assert desk.paused
        drive(participant, step, attempt, folder, lock)
    begun.runner.trial = trial
    begun.next("sub-01")
    row = table.trials(work.study, work.study.progress())[0]
    assert (row["marks"], row["interventions"]) == ("2", "1")
    assert [note["text"] for note in work.study.notes("sub-01")] == ["", "the door opened", "led the robot", ""]


def test_D1_a_note_of_any_bytes_is_kept_and_none_ends_the_desk(work, capsys):
    begun = work()
    begun.next("sub-01")
    attempt = work.study.progress().person("sub-01").attempts[0]
    reader, writer = os.pipe()
    os.write(writer, b"n caf\xe9\nn one\xe2\x80\xa8two\xe2\x80\xa9three\xc2\x85four\nwhat\nwhat\ni led the robot")
    os.close(writer)
    desk = runner.Desk(None, lambda row: work.study.note("sub-01", attempt, row), runner.Lines(reader))
    for _ in range(6):
        desk.listen(0.0)
    assert [note["text"] for note in work.study.notes("sub-01")] == ["caf\ufffd", "one\u2028two\u2029three\x85four", "led the robot"]
    told = capsys.readouterr().out
    assert told.count("\"what\" is not understood") == 2 and told.count(runner.DESK) == 1
    row = table.trials(work.study, work.study.progress())[0]
    assert (row["marks"], row["interventions"]) == ("2", "1")


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
    from navvi_study import verify
    rest(work())
    attempt = work.study.progress().person("sub-01").attempts[0]
    for text in ("one", "two"):
        work.study.note("sub-01", attempt, {"utc": "2026-01-01T00:00:00Z", "mono_ns": 1, "type": "note", "text": text})
    assert verify.notes_and_answers(work.study, work.study.progress())[1:] == ({"notes": 2, "answers": 12}, 0)
    for kind, damage in (("notes", b'{"step": "s1-c1-trial-1", "att\n[1]\n'), ("answers", b"\xff\n" + b"[" * 100000 + b"\n")):
        with open(work.study.home("sub-01") / f"{kind}.jsonl", "ab") as file:
            file.write(damage)
    sentences, counts, lost = verify.notes_and_answers(work.study, work.study.progress())
    assert sentences[0] == "sub-01: notes 2 of 4, answers 12 of 14." and counts == {"notes": 4, "answers": 14} and lost == 4
    named = [f"{work.study.home('sub-01') / kind}.jsonl:{number}: the line is damaged or unfinished, and is passed over."
             for kind, numbers in (("notes", (3, 4)), ("answers", (13, 14))) for number in numbers]
    assert sentences[1:] == named and all(f"  {sentence}" in overview.status(work.study, work.study.progress()) for sentence in named)
    assert len(table.answers(work.study, work.study.progress())) == 12


def test_a_reason_that_is_not_utf_8_leaves_the_journal_whole(work):
    rest(work())
    actions.Exclude.run(type("Args", (), {"plan": work.study.plan.file, "what": "sub-01", "reason": "caf\udce9", "no_replacement": False}))
    assert work.study.journal.rows()[-1]["reason"] == "caf?" == journal.Journal(work.study.journal.path).rows()[-1]["reason"]


def test_a_record_whose_bytes_are_not_utf_8_is_read(work):
    rest(work())
    attempt = work.study.progress().person("sub-01").attempts[0]
    trial = work.study.attempt_folder("sub-01", attempt.step, attempt.number) / attempt.trial
    write_record(trial)
    for name, more in (("events.csv", b"3.000,0,t,caf\xe9\xe2\x80\xa8,1.0,2.0,n/a\n"), ("journal.csv", b"\x85\xff\n"), ("summary.csv", b"\xff")):
        with open(trial / name, "ab") as file:
            file.write(more)
    assert [row["trial_type"] for row in table.events(work.study, work.study.progress())] == ["goal reached", "caf\ufffd\u2028"]
    assert len(record.Record(trial).rows) == 3


def write_record(folder, end=30.0):
    """A journal from 10 s of ROS time on, whose monotonic clock stands at 1000 s then and runs half as fast, and the events of it."""
    rows = [(10.0, 1000.0, "TRIAL_START", "x=0;y=0"), (15.0, 1002.5, "PROGRESS", "x=1;y=0"), (end, 1000.0 + (end - 10.0) / 2, "TRIAL_END", "x=2;y=0")]
    (folder / "journal.csv").write_text("trial,seq,sim_ns,mono_ns,type,fields,crc32\n" + "".join(
        f"t,{seq},{int(sim * 1e9)},{int(mono * 1e9)},{kind},{fields},00000000\n" for seq, (sim, mono, kind, fields) in enumerate(rows, 1)))
    (folder / "events.csv").write_text("onset_s,duration_s,trial,trial_type,robot_x_m,robot_y_m,detail\n2.500,0,t,goal reached,1.0,2.0,n/a\n")


def test_marks_stand_among_the_events_of_their_trial_at_its_own_time(work):
    begun = work()
    begun.next("sub-01")
    attempt = work.study.progress().person("sub-01").attempts[0]
    write_record(work.study.attempt_folder("sub-01", attempt.step, attempt.number) / attempt.trial)
    for mono, kind, text in ((1002.0, "mark", ""), (1000.5, "note", "the door opened"), (1012.0, "intervention", "late")):
        work.study.note("sub-01", attempt, {"utc": "2026-01-01T00:00:00Z", "mono_ns": int(mono * 1e9), "type": kind, "text": text})
    rows = table.events(work.study, work.study.progress())
    assert [(row["onset_s"], row["trial_type"], row["detail"]) for row in rows] == [
        ("1.000", "note", "the door opened"), ("2.500", "goal reached", "n/a"), ("4.000", "mark", "n/a"), ("22.000", "intervention", "late")]
    assert all(row["participant"] == "sub-01" and row["counts"] == "yes" and row["trial"] == attempt.trial for row in rows)
    files = table.write(work.study, work.study.progress(), FIGURES)
    described = json.loads((work.study.folder / "events.json").read_text())
    assert described["onset_s"]["Units"] == "s" and work.study.folder / "events.csv" in files


def test_nothing_of_a_study_names_a_person_but_by_code(work):
    rest(work())
    shutil.rmtree(work.study.home("sub-01"))
    text = work.study.journal.path.read_text()
    assert "sub-01" in text and "mental" not in text


# The report.

class Page(html.parser.HTMLParser):
    """The headings, images and tables of a page, in their order."""

    def __init__(self, text):
        super().__init__()
        self.parts, self.links, self.text, self.folded, self.open = [], [], "", "", []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        if tag in ("h1", "h2", "h3", "img", "table", "html"):
            self.parts.append((tag, attributes))
        if tag == "th":
            assert attributes["scope"] in ("col", "row")
        if tag in ("details", "summary"):
            self.open.append(tag)
        self.links += [attributes[name] for name in ("src", "href") if name in attributes]

    def handle_endtag(self, tag):
        if tag in ("details", "summary"):
            assert self.open.pop() == tag

    def handle_data(self, data):
        self.text += data
        self.folded += data if self.open == ["details"] else ""


SIX = (("sub-04", "sub-06"), ("full]}}", "full]}, secondary: [{measure: collisions, conditions: [plain, full]}]}"))


@pytest.fixture(scope="module")
def reported(tmp_path_factory):
    """A study of six people, half as quick in one condition, with 3 collisions in each trial."""
    from navvi_study import report
    kept = driven(tmp_path_factory.mktemp("reported"), *SIX)
    kept.journal.append("exclude", participant="sub-06", reason="fell ill", rule=False)
    return kept, report.page(kept, kept.progress(), rehearsed=False)


def driven(folder, *changes):
    kept = study.Study(small(folder, *changes))
    kept.freeze("0.1.0", None)

    class Drawn(Driver):
        def trial(self, participant, step, attempt, folder, lock):
            factor = 2.0 if step.condition == "plain" else 1.0
            write_summary(folder / f"trial-{participant}-{step.name}", elapsed=factor * (15.0 + int(participant[-1])))
    for name in kept.plan.participants:
        rest(session.Session(kept, Drawn(kept), say=lambda line: None, wait=False), name)
    return kept


def test_a_report_gives_the_difference_that_is_worked_out_by_hand(reported):
    from navvi_study.analysis import Analysis
    kept, _ = reported
    one = Analysis(kept, kept.progress()).contrast("time", "plain", "full")
    assert one.participants == 5  # the sixth is excluded
    assert one.difference == pytest.approx(-18.0)  # the mean of 16 to 20 s, less than twice as much
    assert -20.0 <= one.low < one.difference < one.high <= -16.0
    detour = Analysis(kept, kept.progress()).contrast("detour", "plain", "full")
    assert detour.difference == 0.0 and detour.p is None and "cannot be estimated" in detour.note


def test_a_report_is_read_without_eyes_and_without_a_network(reported):
    kept, text = reported
    page = Page(text)
    assert dict(page.parts[0][1])["lang"] == "en"
    headings = [int(tag[1]) for tag, _ in page.parts if tag.startswith("h") and tag != "html"]
    assert headings[0] == 1 and headings.count(1) == 1 and all(after <= before + 1 for before, after in zip(headings, headings[1:]))
    images = [at for at, (tag, _) in enumerate(page.parts) if tag == "img"]
    assert len(images) == 2, "of time and workload; the others are alike in all trials"
    for at in images:
        assert len(page.parts[at][1]["alt"]) > 60
        assert page.parts[at + 1][0] == "table"
    assert page.links and all(link.startswith("data:") for link in page.links)
    assert "sub-06 is excluded: fell ill." in page.text
    assert "./navvi study report small.yaml --only time" in page.text and str(kept.folder.parent) not in text, "no folder of the researcher"


def test_a_way_is_as_long_as_its_legs():
    from navvi_study import ways
    assert ways.length([(0.0, 0.0), (3.0, 4.0), (3.0, 5.0)]) == 6.0


def test_a_report_shows_ways_and_cues_of_trials_with_a_journal(work):
    from navvi_study import report, ways
    rest(work())
    for attempt in work.study.progress().person("sub-01").attempts:
        folder = work.study.attempt_folder("sub-01", attempt.step, attempt.number) / attempt.trial
        write_record(folder)
        lines = (folder / "journal.csv").read_text().splitlines(keepends=True)
        cue = "t,9,12000000000,1001000000000,CUE,id=1;modality=speech;kind=turn;text=turn left,00000000\n"
        (folder / "journal.csv").write_text("".join([*lines[:2], cue, *lines[2:]]))
    asked = []
    text = report.page(work.study, work.study.progress(), rehearsed=False, picture=lambda *world: asked.append(world) or b"")
    page = Page(text)
    assert "Cues a minute" in page.text and "The map of this world could not be drawn." in page.text
    assert report.cues(ways.records(work.study, work.study.progress()), work.study.plan) == [["full", 1, "3", "0", "0"], ["plain", 1, "3", "0", "0"]]
    (world, seed, [(colour, dashes, way), *_]), = asked
    assert (world, seed, colour, dashes) == ("n/a", "n/a", "#0072b2", "solid") and len(way) > 1
    shown = report.page(work.study, work.study.progress(), rehearsed=False, picture=lambda *world: b"<svg")
    assert "The map of this world could not be drawn." not in Page(shown).text and "data:image/svg+xml;base64,PHN2Zw==" in shown


def test_a_contrast_has_one_sign_in_all_of_a_report(reported):
    _, text = reported
    assert "full minus plain" in text and "plain minus full" not in text, "the plan's order, not that of the conditions"
    assert "-18" not in text and text.count("18 s less") == 1, "in words there is no sign to mistake"


def test_a_report_begins_with_the_answer_and_folds_what_is_behind_it(reported):
    _, text = reported
    page = Page(text)
    # Five people of 16 to 20 s, twice as slow in plain: -18 s on average, with an error of sqrt(2 / 5) and so 18 +- 1.2.
    answer = "In condition full, participants took 18 s less than in plain [17, 19]; less in 5 of 5 pairs."
    who = "Participants: 6 planned, 6 enrolled, 5 completed, 1 excluded, 5 analysed in the primary outcome."
    at = [page.text.index(words) for words in ("Result", answer, who, "Secondary outcomes", "Participants and trials", "Other measures", "Quality of the data")]
    assert at == sorted(at) and answer not in page.folded
    assert page.text.count("Collisions: 3 in each of 10 trials.") == 1, "alike in all trials: nothing is compared"
    assert "Workload, raw NASA-TLX, 0 to 100" in page.folded and "Drop-out: 0 in each of 10 trials." in page.text


def test_the_flow_of_participants_and_trials_is_that_of_a_study_worked_out_by_hand(tmp_path):
    from navvi_study import report
    from navvi_study.analysis import Analysis
    kept = study.Study(small(tmp_path, ("operator: simulated", "operator: simulated\nconsent: consent_example")))
    kept.freeze("test", None)
    driver = Driver(kept, "aborted", "timeout", "reached", "reached", "reached")  # sub-01: the second in place of the first; then two of sub-03
    driver.ask = lambda participant, step, items, answered, lock: [answered(item, "no" if participant == "sub-02" and item.choices else item.values()[-1]) for item in items]
    begun = session.Session(kept, driver, say=lambda line: None, wait=False)
    for name in ("sub-01", "sub-02", "sub-03"):  # sub-04 does not begin
        rest(begun, name)
    kept.journal.append("exclude", participant="sub-03", reason="fell ill", rule=False)
    state = kept.progress()
    primary, _ = Analysis(kept, state).confirmatory()
    # Planned, enrolled, completed, withdrawn, without consent, excluded, analysed.
    assert report.flow(state, primary) == [["all", 4, 2, 1, 0, 1, 1, 1]]
    assert report.who(state, primary) == "Participants: 4 planned, 2 enrolled, 1 completed, 1 without consent, 1 excluded, 1 analysed in the primary outcome."
    # Driven, reached, at the limit, drop-outs, excluded, not replaced.
    assert report.trials(state) == [["full", 3, 0, 1, 0, 2, 0], ["plain", 2, 1, 0, 0, 1, 0]]


@pytest.mark.parametrize("measure, differences, low, high, words", [
    ("time", [-37.4] * 20, -46.4, -29.2, "In condition b, participants took 37 s less than in a [29, 46]; less in 20 of 20 pairs."),
    ("collisions", [1.0, 1.0, -0.5], -0.02, 1.1, "In condition b, participants had 0.50 more collisions a trial than in a [from 0.02 fewer to 1.10 more]; more in 2 of 3 pairs."),
    ("drop_out", [-0.5, 0.0, 0.0, 0.0], -0.25, 0.0, "In condition b, participants dropped out 12 percentage points less often than in a [0, 25]; less in 1 of 4 pairs, alike in 3."),
    ("time", [-0.6] * 2, -13.8, 13.0, "In condition b, participants took 0.6 s less than in a [from 13.0 more to 13.8 less]; less in 2 of 2 pairs."),
    ("tlx", [2.0, 0.0], None, None, "In condition b, the workload was 1.0 points higher than in a; higher in 1 of 2 pairs, alike in 1."),
    ("sus", [2.0, -2.0], None, None, "Usability, SUS: b and a have the same mean over 2 participants."),
])
def test_a_difference_is_told_in_words_without_a_sign(measure, differences, low, high, words):
    import pandas as pd
    from navvi_study import report
    from navvi_study.analysis import Analysis, Contrast
    told = Analysis.__new__(Analysis)
    told.plan = type("Plan", (), {"exposure": "trial"})
    assert report.sentence(told, Contrast(measure, "a", "b", pd.Series(differences), sum(differences) / len(differences), low, high)) == words


def test_a_column_without_a_value_is_not_shown():
    from navvi_study import report
    assert report.filled(["Name", "p", "Note"], [["a", "n/a", ""], ["b", "n/a", "few"]]) == [["Name", "Note"], ["a", ""], ["b", "few"]]
    assert report.filled(["Name", "p"], []) == [["Name"]]


def test_replaced_is_what_another_trial_was_driven_for(work):
    from navvi_study import report
    rest(work("aborted", "aborted", "aborted"))
    assert [row[-1] for row in report.excluded(work.study.progress())] == ["yes", "yes", "no"], "the reserve is used up"


def test_a_report_does_not_deny_the_journal_of_a_trial_that_does_not_count(work):
    from navvi_study import report
    work("aborted").next("sub-01")
    attempt = work.study.progress().person("sub-01").attempts[0]
    write_record(work.study.attempt_folder("sub-01", attempt.step, attempt.number) / attempt.trial)
    text = report.page(work.study, work.study.progress(), rehearsed=False)
    assert "No trial that counts has a journal" in text and "No trial has a journal" not in text


@pytest.mark.parametrize("p, words", [(0.077, "the interval excludes 0, and p is not below 0.05"), (0.01, "")])
def test_an_interval_and_a_p_that_differ_are_said_in_words(reported, monkeypatch, p, words):
    from navvi_study import analysis
    kept, _ = reported
    monkeypatch.setitem(analysis.MODELS, "time", lambda result, values, differences: setattr(result, "p", p))
    one = analysis.Analysis(kept, kept.progress()).contrast("time", "plain", "full")
    assert one.high < 0 and (words in one.note if words else one.note == "")


def test_the_same_study_gives_the_same_report(reported):
    from navvi_study import report
    kept, text = reported
    assert report.page(kept, study.Study(kept.plan).progress(), rehearsed=False) == text


def test_counts_are_divided_by_the_exposure_that_the_plan_names(tmp_path):
    from navvi_study import report
    from navvi_study.analysis import Analysis
    kept = driven(tmp_path, *SIX, ("outcomes: {", "outcomes: {exposure: time, "))
    analysis = Analysis(kept, kept.progress())
    one = analysis.contrast("collisions", "plain", "full")
    # 3 collisions in t s, and in 2 t s: 180 / t and 90 / t a minute, for t of 16 to 21 s; each has twice the rate in full.
    assert one.difference == pytest.approx(sum(90 / seconds for seconds in range(16, 22)) / 6)
    assert one.estimate == pytest.approx(2.0) and analysis.unit("collisions") == "a minute"
    assert "In condition full, participants had 4.9 more collisions a minute than in plain" in report.page(kept, kept.progress(), rehearsed=False)
    assert kept.plan.values()["exposure"] == "time" and "exposure" not in small(tmp_path).values()


def test_a_participants_rate_is_all_that_was_counted_over_all_exposure():
    import pandas as pd
    from navvi_study.analysis import by_participant
    rows = [("a", "full", 1.0, 1.0), ("a", "full", 3.0, 3.0), ("a", "plain", 4.0, 1.0)]
    means = by_participant(pd.DataFrame(rows, columns=["participant", "condition", "value", "exposure"]))
    assert means.loc["a"].to_dict() == {"full": 1.0, "plain": 4.0}


def test_equivalence_is_two_one_sided_tests_within_what_the_plan_names(tmp_path):
    import numpy as np
    from navvi_study import report
    from navvi_study.analysis import Contrast, _equivalence
    one = _equivalence(Contrast("time", "a", "b", within=3.0), np.array([1.0, 2.0, 3.0, 2.0, 2.0]))
    # Mean 2, SD sqrt(1 / 2), error sqrt(1 / 10): t = (3 - 2) / 0.3162 = 3.162 with 4 degrees of freedom, and 2 +- 2.132 x 0.3162.
    assert one.p == pytest.approx(0.01705, abs=5e-6)
    assert (one.estimate_low, one.estimate_high) == (pytest.approx(1.326, abs=5e-4), pytest.approx(2.674, abs=5e-4))
    assert _equivalence(Contrast("time", "a", "b", within=1.0), np.array([1.0, 2.0, 3.0, 2.0, 2.0])).p == pytest.approx(1 - 0.01705, abs=5e-6)
    for within, words in ((21, "The two are equivalent within 21, the plan's smallest effect of interest."), (19, "not shown to be equivalent within 19,")):
        kept = driven(tmp_path / str(within), ("sub-04", "sub-06"), ("full]}}", f"full], equivalent_within: {within}}}}}"))
        assert words in report.page(kept, kept.progress(), rehearsed=False).replace("&#39;", "'")
    assert "within" not in small(tmp_path).values()["primary"], "plans without keep their hash"


def test_a_workload_with_one_item_declined_is_prorated_and_the_report_says_so(work):
    from navvi_study import report
    begun = work()
    begun.runner.ask = lambda participant, step, items, answered, lock: [
        answered(item, "declined" if (step.order, at) in ((1, 0), (2, 0), (2, 1)) else str(10 * at)) for at, item in enumerate(items)]
    rest(begun)
    # Order 1: 10 to 50 without the first of six; order 2: two are declined, which gives no score.
    assert [(row["score"], row["prorated"]) for row in table.scores(work.study, work.study.progress())] == [(30.0, True), (None, False)]
    begun.runner.ask = lambda participant, step, items, answered, lock: [answered(item, "20") for item in items]
    rest(begun, "sub-02")
    assert "1 of 3 scores are prorated: one item was declined" in report.page(work.study, work.study.progress(), rehearsed=False)


def test_models_find_what_was_put_in_and_nothing_where_nothing_is():
    import numpy as np
    import pandas as pd
    from navvi_study.analysis import MODELS, Contrast
    source = np.random.default_rng(7)
    rows = [{"participant": f"sub-{person:02d}", "order": 1 + (person + second) % 2, "second": float(second), "reached": True, "exposure": 1.0,
             "count": source.poisson(3.0 * (2.0 if second else 1.0) * ability), "time": min(60.0, source.exponential(20.0 if second else 40.0) * ability)}
            for person in range(40) for ability in [source.gamma(8.0, 1 / 8.0)] for second in (0, 1) for _ in range(3)]
    values = pd.DataFrame(rows).assign(reached=lambda rows: rows["time"] < 60.0)
    counted, timed = Contrast("collisions", "a", "b"), Contrast("time", "a", "b")
    MODELS["count"](counted, values.assign(value=values["count"].astype(float)), None)
    MODELS["time"](timed, values.assign(value=values["time"]), None)
    assert counted.estimate_low < 2.0 < counted.estimate_high and counted.p < 1e-6
    assert timed.estimate_low < 2.0 < timed.estimate_high and timed.p < 1e-3
    shuffled = values.assign(second=source.permutation(values["second"]))
    nothing = Contrast("collisions", "a", "b")
    MODELS["count"](nothing, shuffled.assign(value=values["count"].astype(float)), None)
    assert nothing.p > 0.01


def test_where_all_are_quicker_in_one_condition_there_is_a_p_though_no_ratio():
    import pandas as pd
    import scipy.stats
    from navvi_study.analysis import MODELS, Contrast
    rows = [{"participant": f"sub-{person:02d}", "order": 1 + (person + second) % 2, "second": float(second), "reached": True, "exposure": 1.0,
             "value": 30.0 + person - 10.0 * second} for person in range(12) for second in (0, 1)]
    one = Contrast("time", "a", "b")
    MODELS["time"](one, pd.DataFrame(rows), None)
    # Of each pair the first to arrive is the second condition: 12 times 1 - 1/2, with a variance of 1/4 each.
    assert one.p == pytest.approx(scipy.stats.chi2.sf((12 * 0.5) ** 2 / (12 * 0.25), 1)) and one.estimate is None and "no ratio" in one.note


@pytest.mark.parametrize("kind", ["count", "share"])
def test_where_nothing_is_counted_in_one_condition_ranks_are_compared(kind):
    import numpy as np
    import pandas as pd
    from navvi_study.analysis import MODELS, Contrast
    rows = [{"participant": f"sub-{person:02d}", "order": 1 + second, "second": float(second), "reached": True, "exposure": 1.0,
             "value": 0.0 if not second else float(person % 2)} for person in range(12) for second in (0, 1)]
    values = pd.DataFrame(rows)
    one = Contrast(kind, "a", "b")
    MODELS[kind](one, values, np.array([float(person % 2) for person in range(12)]))
    assert 0.0 < one.p < 0.05 and one.model == "Wilcoxon signed ranks" and "no ratio" in one.note


def test_a_figure_shows_all_values_of_all_groups():
    import pandas as pd
    from navvi_study import figures

    class Drawn:
        @staticmethod
        def by_condition(name):
            return [{"group": group, "condition": "full", "mean": value, "low": None, "high": None} for group, value in (("a", 10.0), ("b", 90.0))]

        @staticmethod
        def values(name):
            return pd.DataFrame([{"group": group, "participant": group, "condition": "full", "value": value, "exposure": 1.0}
                                 for group, value in (("a", 10.0), ("b", 90.0))])

        @staticmethod
        def unit(name):
            return "s"
    limits = []
    close = figures.plt.close
    figures.plt.close = lambda drawing: (limits.extend(panel.get_ylim() for panel in drawing.axes), close(drawing))
    try:
        figures.by_condition(Drawn, "time")
    finally:
        figures.plt.close = close
    assert all(low <= 0.0 and high >= 90.0 for low, high in limits) and len(limits) == 2


@pytest.mark.parametrize("kind", ["count", "share"])
def test_a_test_of_a_dozen_participants_finds_nothing_no_more_often_than_it_may(kind):
    import warnings

    import numpy as np
    import pandas as pd
    from navvi_study.analysis import MODELS, Contrast
    found, tried = 0, 0
    for seed in range(100):
        source = np.random.default_rng(seed)
        rows = [{"participant": f"sub-{person:02d}", "order": 1 + (person + second) % 2, "second": float(second), "reached": True, "exposure": 1.0,
                 "value": float(source.poisson(2.0 * ability) if kind == "count" else source.random() < ability / (1 + ability))}
                for person in range(12) for ability in [source.gamma(4.0, 1 / 4.0)] for second in (0, 1) for _ in range(2)]
        one = Contrast(kind, "a", "b")
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                MODELS[kind](one, pd.DataFrame(rows), None)
        except (ValueError, np.linalg.LinAlgError):
            continue
        tried += 1
        found += one.p < 0.05
    assert tried > 75 and found / tried < 0.08, f"{found} of {tried}"


# The paper.

def script(name):
    import importlib.machinery
    import importlib.util
    loader = importlib.machinery.SourceFileLoader(name, str(PACKAGE / "bench" / name))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(module)
    return module


def paper_bench():
    return script("paper_bench")


def test_latencies_are_whole_with_figures_of_others_beside_them_and_not_without_one():
    bench = script("latency_bench")
    own = {f"{name}_{figure}": "1" for name in bench.OWN for figure in ("p50_ms", "p99_ms", "max_ms", "count")}
    chain = bench.Chain("a button, to the answer", 150)
    assert not bench.whole([chain], own)
    chain.begin()
    chain.end([(chain.begun + 0.1, 'began "go on"')])
    assert chain.longest == '+100 ms began "go on"'
    assert bench.whole([chain], {**own, "learnt_count": "3"})
    assert not bench.whole([chain], {key: value for key, value in own.items() if not key.startswith("words")})


def test_each_claim_of_the_paper_names_a_test_that_is_there(capsys):
    bench = paper_bench()
    assert bench.claims() == 0
    bench.CLAIMS.append(("a claim", "Nothing.that_" + "is_tested"))
    assert bench.claims() == 1 and "THERE IS NO SUCH TEST" in capsys.readouterr().out


def test_a_constant_of_the_paper_that_differs_is_counted(capsys, monkeypatch):
    bench = paper_bench()
    printed = {part: {} for part in bench.NODES}
    for _, _, value, part, name in bench.CONSTANTS:
        printed[part][name] = value
    monkeypatch.setattr(bench, "parameters", printed.get)
    assert bench.constants() == 0
    printed["nav"]["alpha"] = 2.0
    assert bench.constants() == 1 and "alpha of the heuristic: 1.0, 2.0, 2.0  DIFFERS" in capsys.readouterr().out


# The export.

def test_a_way_is_resampled_at_an_even_rate_and_turns_the_short_way_round():
    from navvi_study.export import resampled
    rows = resampled([(10.0, 0.0, 0.0, 3.0), (10.2, 1.0, 0.0, -3.0), (10.3, 1.0, 2.0, -3.0)], 10.0)
    assert [(round(x, 6), round(y, 6)) for x, y, _ in rows] == [(0.0, 0.0), (0.5, 0.0), (1.0, 0.0), (1.0, 2.0)]
    assert rows[1][2] == pytest.approx(math.pi, abs=1e-6) or rows[1][2] == pytest.approx(-math.pi, abs=1e-6)
    assert resampled([], 10.0) == []


def test_an_export_has_the_names_of_bids_no_date_and_the_same_bytes_twice(work):
    from navvi_study import export
    rest(work())
    state = work.study.progress()
    for attempt in state.person("sub-01").attempts:
        trial = work.study.attempt_folder("sub-01", attempt.step, attempt.number) / attempt.trial
        write_record(trial)

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
    assert not any(b"2026" in content for content in first.values())
