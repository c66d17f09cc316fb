"""Studies without a session: the report, and the models behind it."""
import hashlib
import html.parser
import re
import warnings
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
import scipy.stats

from small_study import Driver, begin, exclusion, frozen, rest, small, trial_of, words, work, write_record, write_summary  # noqa: F401
from navvi_study import actions, analysis, figures, overview, preregistration, report, study, table, ways
from navvi_study.analysis import MODELS, Analysis, Contrast
from navvi_study.errors import StudyError


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
    kept = driven(tmp_path_factory.mktemp("reported"), *SIX)
    kept.journal.append("exclude", participant="sub-06", reason="fell ill", rule=False)
    return kept, report.page(kept, kept.progress(), rehearsed=False)


class Drawn(Driver):
    def trial(self, participant, step, attempt, folder, lock):
        factor = 2.0 if step.condition == "plain" else 1.0
        write_summary(folder / f"trial-{participant}-{step.name}", elapsed=factor * (15.0 + int(participant[-1])))


def driven(folder, *changes):
    kept = frozen(folder, *changes)
    for name in kept.plan.participants:
        rest(begin(kept, driver=Drawn), name)
    return kept


def test_a_report_gives_the_difference_that_is_worked_out_by_hand(reported):
    kept, _ = reported
    one = Analysis(kept, kept.progress()).contrast("time", "plain", "full")
    assert one.participants == 5  # the sixth is excluded
    assert one.difference == pytest.approx(18.0)  # the first minus the second: twice 16 to 20 s, less once that
    assert 16.0 <= one.low < one.difference < one.high <= 20.0
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
    assert ways.length([(0.0, 0.0), (3.0, 4.0), (3.0, 5.0)]) == 6.0


def test_a_report_shows_ways_and_cues_of_trials_with_a_journal(work):
    rest(work())
    for at in range(2):
        _, folder = trial_of(work.study, at=at)
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
    kept, text = reported
    assert overview.question(kept.plan.primary).startswith("time to the goal, plain minus full"), "the first that the plan names minus the second"
    assert "plain minus full" in text and "full minus plain" not in text, "the plan's order, not that of the conditions"
    assert text.count("18 s more") == 1, "in words there is no sign to mistake"


def test_a_report_begins_with_the_answer_and_folds_what_is_behind_it(reported):
    _, text = reported
    page = Page(text)
    # Five people of 16 to 20 s, twice as slow in plain: 18 s on average, with an error of sqrt(2 / 5) and so 18 +- 1.2.
    answer = "In condition plain, participants took 18 s more than in full [17, 19]; more in 5 of 5 pairs."
    who = "Participants: 6 planned, 6 enrolled, 5 completed, 1 excluded, 5 analysed in the primary outcome."
    at = [page.text.index(words) for words in ("Result", answer, who, "Secondary outcomes", "Participants and trials", "Other measures", "Quality of the data")]
    assert at == sorted(at) and answer not in page.folded
    assert page.text.count("Collisions: 3 in each of 10 trials.") == 1, "alike in all trials: nothing is compared"
    assert "Workload, raw NASA-TLX, 0 to 100" in page.folded and "Drop-out: 0 in each of 10 trials." in page.text


def test_the_flow_of_participants_and_trials_is_that_of_a_study_worked_out_by_hand(tmp_path):
    kept = frozen(tmp_path, ("operator: simulated", "operator: simulated\nconsent: consent_example"))
    begun = begin(kept, "aborted", "timeout", "reached", "reached", "reached")  # sub-01: the second in place of the first; then two of sub-03
    begun.runner.ask = lambda participant, step, items, answered, lock: [answered(item, "no" if participant == "sub-02" and item.choices else item.values()[-1]) for item in items]
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
    ("time", [-37.4] * 20, -46.4, -29.2, "In condition a, participants took 37 s less than in b [29, 46]; less in 20 of 20 pairs."),
    ("collisions", [1.0, 1.0, -0.5], -0.02, 1.1, "In condition a, participants had 0.50 more collisions a trial than in b [from 0.02 fewer to 1.10 more]; more in 2 of 3 pairs."),
    ("drop_out", [-0.5, 0.0, 0.0, 0.0], -0.25, 0.0, "In condition a, participants dropped out 12 percentage points less often than in b [0, 25]; less in 1 of 4 pairs, alike in 3."),
    ("time", [-0.6] * 2, -13.8, 13.0, "In condition a, participants took 0.6 s less than in b [from 13.0 more to 13.8 less]; less in 2 of 2 pairs."),
    ("tlx", [2.0, 0.0], None, None, "In condition a, the workload was 1.0 points higher than in b; higher in 1 of 2 pairs, alike in 1."),
    ("sus", [2.0, -2.0], None, None, "Usability, SUS: a and b have the same mean over 2 participants."),
])
def test_a_difference_is_told_in_words_without_a_sign(measure, differences, low, high, words):
    told = Analysis.__new__(Analysis)
    told.plan = SimpleNamespace(exposure="trial")
    assert report.sentence(told, Contrast(measure, "a", "b", pd.Series(differences), sum(differences) / len(differences), low, high)) == words


def test_a_column_without_a_value_is_not_shown():
    assert report.filled(["Name", "p", "Note"], [["a", "n/a", ""], ["b", "n/a", "few"]]) == [["Name", "Note"], ["a", ""], ["b", "few"]]
    assert report.filled(["Name", "p"], []) == [["Name"]]


def test_replaced_is_what_another_trial_was_driven_for(work):
    rest(work("aborted", "aborted", "aborted"))
    assert [row[-1] for row in report.excluded(work.study.progress())] == ["yes", "yes", "no"], "the reserve is used up"


def test_a_report_and_a_status_tell_nothing_of_who_was_erased_but_that_they_withdrew(tmp_path):
    kept = frozen(tmp_path, ("limit: 60", "limit: 60\npractice: {worlds: {world: training, seeds: [3]}, most: 1}"))
    begun = begin(kept, *["reached"] * 3, "timeout", "aborted", "aborted", "aborted")  # sub-02 masters no practice, and no world is left for a trial
    for name in "sub-01", "sub-02":
        rest(begun, name)
    actions.exclude(exclusion(kept, f"sub-02/{kept.progress().person('sub-02').attempts[-1].trial}", "a secret"))

    def told():
        state = kept.progress()
        return report.page(kept, state, rehearsed=False) + "\n".join(overview.status(kept, state)), report.trials(state), report.quality(kept, state)[-1][1]
    before, rows, practice = told()
    assert before.count("a secret") == 2 and sum(row[-1] for row in rows) == 2 and practice == "2 of 2"
    actions.withdraw(words(kept, participant="sub-02", data="delete"))
    after, rows, practice = told()
    assert "a secret" not in after and "sub-02 has withdrawn." in after and sum(row[-1] for row in rows) == 0 and practice == "1 of 1"


def test_a_report_does_not_deny_the_journal_of_a_trial_that_does_not_count(work):
    work("aborted").next("sub-01")
    write_record(trial_of(work.study)[1])
    text = report.page(work.study, work.study.progress(), rehearsed=False)
    assert "No trial that counts has a journal" in text and "No trial has a journal" not in text


@pytest.mark.parametrize("p, words", [(0.077, "the interval excludes 0, and p is not below 0.05"), (0.01, "")])
def test_an_interval_and_a_p_that_differ_are_said_in_words(reported, monkeypatch, p, words):
    kept, _ = reported
    monkeypatch.setitem(analysis.MODELS, "time", lambda result, values, differences: setattr(result, "p", p))
    one = Analysis(kept, kept.progress()).contrast("time", "plain", "full")
    assert one.low > 0 and (words in one.note if words else one.note == "")


def test_a_blinded_report_has_letters_and_tells_no_condition(reported):
    kept, _ = reported
    blinded = kept.blinded()
    text = Page(report.page(blinded, blinded.progress(), rehearsed=False)).text
    assert not {"full", "plain"} & set(re.findall(r"\w+", text)) and "no touch" not in text
    assert re.search("In condition A, participants took 18 s (less|more) than in B", text) and "A minus B" in text
    assert "report small.yaml --blind" in text and {row["condition"] for row in blinded.answers("sub-01")} == {"A", "B"}
    assert sorted(kept.blinded().letters.items()) == sorted(blinded.letters.items()), "the key is kept"
    assert kept.plan.values() == study.Study(kept.plan).plan.values() and blinded.progress().complete(blinded.progress().person("sub-01"))


def test_a_condition_keeps_its_letter_whatever_conditions_a_later_plan_adds_or_drops(tmp_path):
    pair = "{full: {picture: false}, plain: {picture: false, touch: false}}"
    more = [f", other{at}: {{sounds: false, speech: {word}}}" for at, word in ((1, "true"), (2, "false"))]
    listed = ("limit: 60", "limit: 60\norder: listed")

    def planned(added):
        sets = "".join(f", {'cd'[at]}: {{world: easy, seeds: [{5 + at}]}}" for at in range(len(added)))
        return listed, (pair, pair[:-1] + "".join(added) + "}"), ("seeds: [2]}", "seeds: [2]}" + sets)
    kept = frozen(tmp_path, *planned(more))
    rest(begin(kept))
    fewer = study.Study(small(tmp_path, *planned([])))
    fewer.freeze("test", "shorter sessions")
    blinded = fewer.blinded()
    assert len({attempt.condition for attempt in blinded.progress().people["sub-01"].attempts} - {"n/a"}) == 4, "dropped ones are not pooled"
    key = blinded.letters
    for added in more[:1], more, [*more[:1], ", new: {touch: false, speech: false}"]:
        other = study.Study(small(tmp_path, *planned(added)))
        letters = other.blinded().letters
        assert {name: letters[name] for name in key} == key and len(set(letters.values())) == len(letters)
        assert study.Study(other.plan).blinded().letters == letters
    assert sorted(letters.values()) == [*"ABCDE"] and report.page(other.blinded(), other.blinded().progress(), rehearsed=False)


def test_a_blind_plan_names_no_condition_before_its_analysis_is_frozen(tmp_path, monkeypatch):
    monkeypatch.setitem(actions.TOOLS, "draw", lambda *words: None)
    monkeypatch.setitem(actions.TOOLS, "version", lambda: "test")
    monkeypatch.setattr(actions, "_figures", lambda: [])
    monkeypatch.setattr(report, "maps", lambda *given: [])
    assert "blind" not in frozen(tmp_path / "plain").plan.values(), "plans without keep their hash"
    kept = driven(tmp_path, ("limit: 60", "limit: 60\nblind: true"))
    assert "letters for the conditions until" in preregistration.write(kept).read_text()
    args = type("Args", (), {"plan": kept.plan.file, "only": None, "blind": False, "bids": True})
    actions.report(args)
    for action in actions.table, actions.export:
        with pytest.raises(StudyError, match="unblind"):
            action(args)
    assert not (kept.folder / "report.html").exists() and not list(kept.folder.glob("*.csv"))
    blinded = (kept.folder / "report-blind.html").read_text()
    assert not {"full", "plain"} & set(re.findall(r"\w+", Page(blinded).text)) and "study rehearse" not in blinded
    args.reason = "not needed, as all are through"
    (kept.folder / "report-blind.html").unlink()
    actions.report(words(kept, only="time", blind=False))
    actions.unblind(args)
    actions.report(words(kept, only="time", blind=False))
    figures_of = {path.name: path.read_text() for path in kept.folder.glob("*.svg")}
    assert sorted(figures_of) == ["time-blind.svg", "time.svg"] and "full" in figures_of["time.svg"] and "full" not in figures_of["time-blind.svg"]
    with pytest.raises(StudyError, match="--only is \"weight\"; allowed is a measure with values"):
        actions.report(words(kept, only="weight", blind=False))
    assert (kept.folder / "report-blind.html").read_text() == blinded and "study rehearse" not in (kept.folder / "report.html").read_text()
    text = Page((kept.folder / "report.html").read_text()).text
    assert hashlib.sha256((kept.folder / "report-blind.html").read_bytes()).hexdigest() in text and "than in full" in text and "; trials after that: 0." in text and "not needed" not in text
    assert (kept.folder / "trials.csv").exists() and not actions.table(args)
    with pytest.raises(StudyError, match="nothing to unblind"):
        actions.unblind(args)


def test_an_unblinding_before_all_are_through_has_its_reason_and_its_trials_in_the_report(tmp_path, monkeypatch):
    for name in "draw", "version":
        monkeypatch.setitem(actions.TOOLS, name, lambda *words: "test")
    monkeypatch.setattr(actions, "_figures", lambda: [])
    practice = "practice: {worlds: {world: training, seeds: 1..2}, collisions_at_most: 3}"
    kept = frozen(tmp_path, ("limit: 60", f"limit: 60\nblind: true\n{practice}"))
    args = words(kept, only=None, blind=False, reason=None)
    rest(begin(kept))
    begun = begin(kept, "reached", "killed")
    begun.next("sub-02")
    with pytest.raises(KeyboardInterrupt):
        begun.next("sub-02")
    write_summary(kept.attempt_folder("sub-02", "s1-c1-trial-1", 1) / "trial-9")  # of a session that goes on meanwhile
    with pytest.raises(StudyError, match="not all participants are through, .*--reason"):
        actions.unblind(args)
    assert kept.concealed and not kept.progress().analyses
    args.reason = "the board asked"
    actions.unblind(args)
    rest(begin(kept), "sub-02")
    begin(kept).next("sub-03")  # practice
    actions.report(args)
    text = Page((kept.folder / "report.html").read_text()).text
    assert 'not all participants were through, for the reason "the board asked"; trials after that: 1.' in text


def test_the_same_study_gives_the_same_report(reported):
    kept, text = reported
    assert report.page(kept, study.Study(kept.plan).progress(), rehearsed=False) == text


def test_counts_are_divided_by_the_exposure_that_the_plan_names(tmp_path):
    kept = driven(tmp_path, *SIX, ("outcomes: {", "outcomes: {exposure: time, "))
    measured = Analysis(kept, kept.progress())
    one = measured.contrast("collisions", "plain", "full")
    # 3 collisions in t s, and in 2 t s: 180 / t and 90 / t a minute, for t of 16 to 21 s; each has half the rate in plain.
    assert one.difference == pytest.approx(-sum(90 / seconds for seconds in range(16, 22)) / 6)
    assert one.estimate is None and one.note == "the model cannot be estimated: all participants differ alike between the conditions"
    measured.trials.loc[measured.trials["condition"] == "full", "shelf_collision_count"] = ["0", "1", "2", "0", "2", "1"]
    one = measured.contrast("collisions", "plain", "full")
    assert one.estimate == pytest.approx(0.5, abs=0.03) and one.estimate_low < 0.5 < one.estimate_high and measured.unit("collisions") == "a minute"
    assert "In condition plain, participants had 4.9 fewer collisions a minute than in full" in report.page(kept, kept.progress(), rehearsed=False)
    assert kept.plan.values()["exposure"] == "time" and "exposure" not in small(tmp_path).values()


def test_a_participants_rate_is_all_that_was_counted_over_all_exposure():
    rows = [("a", "full", 1.0, 1.0), ("a", "full", 3.0, 3.0), ("a", "plain", 4.0, 1.0)]
    means = analysis.by_participant(pd.DataFrame(rows, columns=["participant", "condition", "value", "exposure"]))
    assert means.loc["a"].to_dict() == {"full": 1.0, "plain": 4.0}


def test_equivalence_is_two_one_sided_tests_within_what_the_plan_names(tmp_path):
    one = analysis._equivalence(Contrast("time", "a", "b", within=3.0), np.array([1.0, 2.0, 3.0, 2.0, 2.0]))
    # Mean 2, SD sqrt(1 / 2), error sqrt(1 / 10): t = (3 - 2) / 0.3162 = 3.162 with 4 degrees of freedom, and 2 +- 2.132 x 0.3162.
    assert one.p == pytest.approx(0.01705, abs=5e-6)
    assert (one.estimate_low, one.estimate_high) == (pytest.approx(1.326, abs=5e-4), pytest.approx(2.674, abs=5e-4))
    assert analysis._equivalence(Contrast("time", "a", "b", within=1.0), np.array([1.0, 2.0, 3.0, 2.0, 2.0])).p == pytest.approx(1 - 0.01705, abs=5e-6)
    for within, words in ((21, "The two are equivalent within 21, the plan's smallest effect of interest."), (19, "not shown to be equivalent within 19,")):
        kept = driven(tmp_path / str(within), ("sub-04", "sub-06"), ("full]}}", f"full], equivalent_within: {within}}}}}"))
        assert words in report.page(kept, kept.progress(), rehearsed=False).replace("&#39;", "'")
    assert "within" not in small(tmp_path).values()["primary"], "plans without keep their hash"


def test_a_workload_with_one_item_declined_is_prorated_and_the_report_says_so(work):
    begun = work()
    begun.runner.ask = lambda participant, step, items, answered, lock: [
        answered(item, "declined" if (step.order, at) in ((1, 0), (2, 0), (2, 1)) else str(10 * at)) for at, item in enumerate(items)]
    rest(begun)
    # Order 1: 10 to 50 without the first of six; order 2: two are declined, which gives no score.
    assert [(row["score"], row["prorated"]) for row in table.scores(work.study, work.study.progress())] == [(30.0, True), (None, False)]
    begun.runner.ask = lambda participant, step, items, answered, lock: [answered(item, "20") for item in items]
    rest(begun, "sub-02")
    assert "1 of 3 scores are prorated: one item was declined" in report.page(work.study, work.study.progress(), rehearsed=False)


@pytest.mark.parametrize("place", [lambda person, first: 1 + (person + first) % 2, lambda person, first: 1 + first], ids=["williams", "listed"])
def test_models_find_what_was_put_in_and_nothing_where_nothing_is(place):
    source = np.random.default_rng(7)
    rows = [{"participant": f"sub-{person:02d}", "order": place(person, first), "first": float(first), "reached": True, "exposure": 1.0,
             "count": source.poisson(3.0 * (2.0 if first else 1.0) * ability), "time": min(60.0, source.exponential(20.0 if first else 40.0) * ability)}
            for person in range(40) for ability in [source.gamma(8.0, 1 / 8.0)] for first in (0, 1) for _ in range(3)]
    values = pd.DataFrame(rows).assign(reached=lambda rows: rows["time"] < 60.0)
    counted, timed = Contrast("collisions", "a", "b"), Contrast("time", "a", "b")
    MODELS["count"](counted, values.assign(value=values["count"].astype(float)), None)
    MODELS["time"](timed, values.assign(value=values["time"]), None)
    assert counted.estimate_low < 2.0 < counted.estimate_high and counted.p < 1e-6
    assert timed.estimate_low < 2.0 < timed.estimate_high and timed.p < 1e-3
    shuffled = values.assign(first=source.permutation(values["first"]))
    nothing = Contrast("collisions", "a", "b")
    MODELS["count"](nothing, shuffled.assign(value=values["count"].astype(float)), None)
    assert nothing.p > 0.01


def test_where_all_are_quicker_in_one_condition_there_is_a_p_though_no_ratio():
    rows = [{"participant": f"sub-{person:02d}", "order": 1 + (person + first) % 2, "first": float(first), "reached": True, "exposure": 1.0,
             "value": 30.0 + person - 10.0 * first} for person in range(12) for first in (0, 1)]
    one = Contrast("time", "a", "b")
    MODELS["time"](one, pd.DataFrame(rows), None)
    # The first of each pair to arrive is in the first condition: 12 times 1 - 1/2, with a variance of 1/4 each.
    assert one.p == pytest.approx(scipy.stats.chi2.sf((12 * 0.5) ** 2 / (12 * 0.25), 1)) and one.estimate is None and "no ratio" in one.note


def test_where_nobody_arrives_in_one_condition_there_is_a_p_though_no_ratio():
    rows = [{"participant": f"sub-{person:02d}", "order": 1 + (person + first) % 2, "first": float(first), "reached": bool(first), "exposure": 1.0,
             "value": 30.0 + person if first else 60.0} for person in range(12) for first in (0, 1)]
    one = Contrast("time", "a", "b")
    MODELS["time"](one, pd.DataFrame(rows), None)
    assert one.p == pytest.approx(scipy.stats.chi2.sf((12 * 0.5) ** 2 / (12 * 0.25), 1))
    assert one.note == "nobody arrived under one of the conditions, so that no ratio can be estimated"
    nobody = Contrast("time", "a", "b")
    with pytest.raises(ValueError, match="nobody arrived$"):
        MODELS["time"](nobody, pd.DataFrame(rows).assign(value=60.0, reached=False), None)


def test_what_cannot_be_tested_is_of_the_family_for_which_p_is_corrected():
    family = [Contrast("time", "a", "b", p=p) for p in (None, 0.02, 0.04)]
    assert [one.corrected for one in analysis.corrected(family, "holm")] == [None, pytest.approx(0.06), pytest.approx(0.08)]
    assert analysis.corrected([], "holm") == []


@pytest.mark.parametrize("kind", ["count", "share"])
def test_where_nothing_is_counted_in_one_condition_ranks_are_compared(kind):
    rows = [{"participant": f"sub-{person:02d}", "order": 1 + first, "first": float(first), "reached": True, "exposure": 1.0,
             "value": 0.0 if not first else float(person % 2)} for person in range(12) for first in (0, 1)]
    values = pd.DataFrame(rows)
    one = Contrast(kind, "a", "b")
    MODELS[kind](one, values, np.array([float(person % 2) for person in range(12)]))
    assert 0.0 < one.p < 0.05 and one.model == "Wilcoxon signed ranks" and "no ratio" in one.note


def test_a_figure_shows_all_values_of_all_groups(monkeypatch):
    groups = {"a": 10.0, "b": 90.0}
    drawn = SimpleNamespace(
        by_condition=lambda name: [{"group": group, "condition": "full", "mean": value, "low": None, "high": None} for group, value in groups.items()],
        values=lambda name: pd.DataFrame([{"group": group, "participant": group, "condition": "full", "value": value, "exposure": 1.0}
                                          for group, value in groups.items()]),
        unit=lambda name: "s")
    limits = []
    monkeypatch.setattr(figures.plt, "close", lambda drawing: limits.extend(panel.get_ylim() for panel in drawing.axes))
    figures.by_condition(drawn, "time")
    assert all(low <= 0.0 and high >= 90.0 for low, high in limits) and len(limits) == 2


@pytest.mark.parametrize("kind", ["count", "share"])
def test_a_test_of_a_dozen_participants_finds_nothing_no_more_often_than_it_may(kind):

    found, tried = 0, 0
    for seed in range(100):
        source = np.random.default_rng(seed)
        rows = [{"participant": f"sub-{person:02d}", "order": 1 + (person + first) % 2, "first": float(first), "reached": True, "exposure": 1.0,
                 "value": float(source.poisson(2.0 * ability) if kind == "count" else source.random() < ability / (1 + ability))}
                for person in range(12) for ability in [source.gamma(4.0, 1 / 4.0)] for first in (0, 1) for _ in range(2)]
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
