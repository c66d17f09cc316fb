"""Studies without a session: the design, the plan and what is refused in it, the schedule."""
import collections
import hashlib
import itertools
import json

import pytest

from small_study import EXAMPLE, PACKAGE, begin, frozen, rest, small
from sessions import ROOT
from navvi_study import checked, design, overview, plan_file, preregistration, progress, questionnaire, report, runner, schedule, steps, study, worlds
from navvi_study.errors import StudyError
from navvi_study.steps.step import Step

# The design.

@pytest.mark.parametrize("size", range(1, 9))
def test_orders_are_balanced_for_place_and_first_order_carry_over(size):
    rows = design.williams(size)
    assert len(rows) == (size if size % 2 == 0 else 2 * size)
    for place in range(size):
        assert len(set(collections.Counter(row[place] for row in rows).values())) == 1
    followed = collections.Counter(pair for row in rows for pair in itertools.pairwise(row))
    assert len(followed) == size * (size - 1)
    assert len(set(followed.values())) <= 1


@pytest.mark.parametrize("size", range(2, 7))
def test_each_condition_is_driven_in_each_set_of_worlds_equally_often(size):
    orders = len(design.williams(size))
    met = collections.Counter((condition, design.set_of(participant, condition, size, orders))
                              for participant in range(orders * size) for condition in range(size))
    assert len(met) == size * size and len(set(met.values())) == 1


@pytest.mark.parametrize("size", range(2, 7))
def test_no_set_of_worlds_stays_tied_to_a_place_in_the_order(size):
    rows = design.williams(size)
    met = collections.Counter((place, design.set_of(participant, rows[participant % len(rows)][place], size, len(rows)))
                              for participant in range(len(rows) * size) for place in range(size))
    assert len(met) == size * size and len(set(met.values())) == 1


@pytest.mark.parametrize("size", range(1, 9))
def test_a_drawn_order_is_as_balanced_as_a_listed_one_and_another_with_each_seed(size):
    places = {seed: [design.allotted(seed, "all", at, size) for at in range(3 * size)] for seed in ("a", "b", "c", "d", "e")}
    for drawn in places.values():
        assert [sorted(drawn[at:at + size]) for at in range(0, 3 * size, size)] == [list(range(at, at + size)) for at in range(0, 3 * size, size)]
    assert size < 3 or len(set(map(tuple, places.values()))) > 1
    assert places["a"] == [design.allotted("a", "all", at, size) for at in range(3 * size)]


DRAWN = ("limit: 60", "limit: 60\norder: drawn")


def test_orders_are_drawn_by_a_seed_that_is_kept_apart_and_not_printed_before_it_is_due(tmp_path):
    plan = small(tmp_path, DRAWN)
    shown = "\n".join(overview.schedule(plan))
    assert "sub-02" not in shown and "it is one of: full, plain; plain, full." in shown
    kept = study.Study(plan)
    kept.freeze("test", None)
    seed = (tmp_path / "small/allocation.seed").read_text().strip()
    assert len(seed) == 32 and kept.journal.rows()[0]["allocation"] == hashlib.sha256(seed.encode()).hexdigest()
    files = [path for path in (tmp_path / "small").iterdir() if path.name != "allocation.seed"] + [preregistration.write(kept)]
    assert not any(seed in path.read_text() for path in files), "the frozen plan and the journal do not tell it"
    firsts = [next(step.condition for step in person.steps if step.kind == "trial") for person in study.Study(plan).progress().people.values()]
    assert [sorted(firsts[:2]), sorted(firsts[2:])] == [["full", "plain"]] * 2
    waiting = "\n".join(overview.status(kept, kept.progress()))
    assert "next is s1-c1-trial-1." in waiting and "in full" not in waiting and "in plain" not in waiting
    assert "printed here once" in report.opening(kept.progress())
    for name in plan.participants:
        rest(begin(kept), name)
    assert f"drawn by the seed {seed}" in report.opening(kept.progress())
    (tmp_path / "small/allocation.seed").write_text("another")
    with pytest.raises(StudyError, match="allocation.seed is missing or changed since the plan was frozen"):
        study.Study(plan)


# The plan.

@pytest.mark.parametrize("old, new, sentence", [
    ("limit: 60", "limt: 60", "\"limit\" is missing; \"limt\" is unknown"),
    ("operator: simulated", "oprator: simulated", "small.yaml:9: \"oprator\" is unknown; known are: "),
    ("limit: 60", "limit: -1", "\"limit\" is -1; allowed is a number from 1 to 86400"),
    ("limit: 60", "limit: 60\nlimit: 61", "the key \"limit\" is given twice"),
    ("limit: 60", "limit: [", "cannot parse the YAML"),
    ("touch: false", "tuch: false", "\"conditions/plain/tuch\" is unknown"),
    ("touch: false", "touch: off_", "\"conditions/plain/touch\" is \"off_\"; allowed is true or false"),
    ("touch: false", "touch: true", "full and plain, which are alike"),
    ("touch: false", "parameters: {feedback/haptics/enabled: false}", "is set by the study itself"),
    ("touch: false", "parameters: {strength: 1}", "is not a parameter of a node"),
    ("seeds: [2]", "seeds: [1]", "has easy 1 twice"),
    ("seeds: [2]", "seeds: [2, 3]", "sets of different sizes"),
    ("seeds: 11..12", "seeds: 1..3", "has easy 1 twice"),
    (", b: {world: easy, seeds: [2]}", "", "has 1 sets, and group all has 2 conditions"),
    ("world: easy, seeds: [1]", "world: own.yaml, seeds: [1]", "own.yaml is not a file"),
    ("sub-01..sub-04", "[sub-01, sub-01]", "plans sub-01 twice"),
    ("sub-01..sub-04", "[Ann Smith]", "letters, digits, - and _"),
    ("[plain, full]", "[plain, none]", "allowed is one of: full, plain"),
    ("[plain, full]", "[plain, plain]", "allowed are two conditions"),
    ("measure: time", "measure: sus", "does not ask sus"),
    ("{after_condition: [tlx]}", "{at_begin: [about_you]}", "needs \"yes\" to the item describe of the consent; the consent's items with a yes are: none"),
    ("measure: time", "equivalent_within: 0, measure: time", "\"outcomes/primary/equivalent_within\" is 0; allowed is a number from 1e-06"),
    ("measure: time", "sd: 3, measure: time", "needs \"sd\" with one of the keys \"effect\" and \"equivalent_within\""),
    ("outcomes: {", "outcomes: {exposure: way, ", "\"outcomes/exposure\" is \"way\"; allowed is one of: trial, time, path"),
    ("[tlx]", "[txl]", "allowed are files in"),
    ("column: result, is: [aborted, invalid]", "column: result", "needs one of the keys"),
    ("title: A small study", "", "the key \"title\" is missing"),
    ("operator: simulated", "sessions: 3", "a condition a session or more"),
    ("limit: 60", "limit: 60\nprobes: {after: [20, 5], worlds: {world: easy, seeds: [3, 4]}}", "is not a pair; allowed are the earliest and the latest second"),
    ("limit: 60", "limit: 60\nprobes: {after: [5, 20], worlds: {world: easy, seeds: [3]}}", "has 1 worlds, and group all has 2 conditions"),
    ("limit: 60", "limit: 60\nprobes: {after: [5, 20], worlds: {world: easy, seeds: [1, 3]}}", "has easy 1 twice"),
    ("limit: 60", "limit: 60\nprobes: {after: [5, 61], worlds: {world: easy, seeds: [3, 4]}}",
     "has \"after\" up to 61 s, and the limit of a trial is 60 s"),
    ("[tlx]", "[tlx, tlx]", "has the step s1-c1-tlx twice"),
    ("{after_condition: [tlx]}", "{at_begin: [tlx], at_end: [tlx]}", "has the step s1-tlx twice"),
    ("[tlx]", "[probe]", "allowed are such items below the plan's key \"probes\""),
    ("measure: time", "measure: pointing", "does not ask probe"),
    ("measure: time", r'measure: "\e[2J"', "is \"\N{REPLACEMENT CHARACTER}[2J\"; allowed is"),
])
def test_a_wrong_plan_is_refused_with_file_key_and_what_is_allowed(tmp_path, old, new, sentence):
    with pytest.raises(StudyError) as problem:
        small(tmp_path, (old, new))
    assert str(tmp_path) in str(problem.value)
    assert sentence in str(problem.value)


def test_the_example_can_be_checked_and_nobody_meets_a_world_twice():
    example = plan_file.load(EXAMPLE)
    assert len(example.participants) == 20
    for name in example.participants:
        worlds = [step.world for step in schedule.steps_of(example, name) if step.world]
        assert len(worlds) == len(set(worlds)) == 8
    text = "\n".join(overview.schedule(example))
    assert "sub-20: " in text and "4 orders" in text and "hours" in text
    assert "balanced for order and first-order carry-over" in text


def test_a_pre_registration_tells_the_frozen_plan_in_words(tmp_path):
    kept = study.Study(small(tmp_path, ("[plain, full]}", "[plain, full], equivalent_within: 5}, exposure: path, secondary: [{measure: collisions, conditions: [plain, full]}]")))
    kept.freeze("0.1.0", None)
    text = preregistration.write(kept).read_text()
    assert text.startswith(f"# A small study: pre-registration\n\nStudy small; the plan was frozen on ") and kept.plan.hash() in text
    headings = [line for line in text.splitlines() if line.startswith("## ")]
    assert headings == [f"## {name}" for name in ("Hypotheses", "Design", "Participants", "Measures", "Analysis", "Exclusions")]
    for line in ("Primary: Time to the goal: plain and full are equivalent within 5 (s).", "Secondary: Collisions: plain and full differ.",
                 "Group all: 2 orders, balanced for order and first-order carry-over.", "Group all: 4, in the conditions full, plain.",
                 "Collisions, per 100 m, of trials that count.", "Condition plain: no touch, speech, sounds, no picture, profile default.",
                 "The same holds where result is aborted or invalid: the trial broke off.", preregistration.MODELS["count"], preregistration.EQUIVALENCE):
        assert f"- {line}\n" in text
    assert preregistration.MODELS["time"] not in text, "no difference of times is tested"
    changed = study.Study(small(tmp_path, ("limit: 60", "limit: 90")))
    changed.freeze("0.1.0", "too short")
    text = preregistration.write(changed).read_text()
    assert ", too short: limit: 60.0 is now 90.0" in text and "plain and full differ." in text and "after 90 s" in text


def test_a_pre_registration_has_counts_in_the_unit_of_the_analysis(tmp_path):
    kept = frozen(tmp_path, ("measure: time", "measure: collisions"), ("full]}", "full], equivalent_within: 2, sd: 3}, exposure: path"))
    text = preregistration.write(kept).read_text()
    assert "are equivalent within 2 (per 100 m)." in text and "equivalence within 2 (per 100 m), where" in text and "a trial)" not in text


@pytest.mark.parametrize("keys, words", [
    # (1.960 + 0.842)^2 (8 / 5)^2 + 1.960^2 / 2 = 22.01, and 28.8 with 1.282; of equivalence with 1.645 and 1.282, 23.3, and with 1.645 29.1.
    ("effect: 5, sd: 8", "a difference of 5 (s), where participants' differences have an SD of 8, is shown with 80 % power by 23 participants, with 90 % by 29; 4 are planned."),
    ("equivalent_within: 5, sd: 8", "equivalence within 5 (s), where participants' differences have an SD of 8, is shown with 80 % power by 24 participants, with 90 % by 30; 4 are planned.")])
def test_a_pre_registration_has_the_sample_size_of_the_plans_effect_and_variance(tmp_path, keys, words):
    kept = frozen(tmp_path, ("full]}}", f"full], {keys}}}}}"))
    assert f"- Sample size: {words}\n" in preregistration.write(kept).read_text()
    assert "sd" not in small(tmp_path).values()["primary"], "plans without keep their hash"


def test_a_questionnaire_whose_name_no_file_can_have_is_refused(tmp_path):
    with pytest.raises(StudyError, match="is not found"):
        questionnaire.find("x" * 300, tmp_path)


def test_every_questionnaire_that_ships_can_be_spoken_and_scored():
    for path in (PACKAGE / "studies/questionnaires").glob("*.yaml"):
        asked = questionnaire.load(path)
        questionnaire.require_speakable(asked, ROOT / "navvi_ws/devel/lib/navvi_feedback/feedback_node")
    sus = questionnaire.find("sus", EXAMPLE.parent)
    assert sus.scored({item.name: "3" for item in sus.items}, {}) == 50.0
    assert sus.scored({item.name: "5" if at % 2 == 0 else "1" for at, item in enumerate(sus.items)}, {}) == 100.0
    tlx = questionnaire.find("tlx", EXAMPLE.parent)
    assert tlx.scored({item.name: str(10 * at) for at, item in enumerate(tlx.items)}, {}) == 25.0
    assert tlx.scored({item.name: "declined" for item in tlx.items}, {}) is None
    assert sus.scored({item.name: "3" if at else "declined" for at, item in enumerate(sus.items)}, {}) is None
    probe = questionnaire.find("probe", EXAMPLE.parent)
    assert probe.scored({"goal": "80", "start": "0", "left": "wall"}, {"goal": "-20", "start": "40", "left": "n/a"}) == 30.0
    assert probe.scored({"goal": "declined"}, {"goal": "n/a"}) is None
    for name in ("tlx", "sus", "probe"):  # another language asks the same, and is compared with it
        first, other = (questionnaire.find(word, EXAMPLE.parent) for word in (name, name + "_es"))
        assert other.measured == name and other.score == first.score
        assert [(item.name, item.classes or item.values()) for item in other.items] == [(item.name, item.classes or item.values()) for item in first.items]


def test_a_condition_becomes_arguments_that_lock_it(tmp_path):
    kept = study.Study(small(tmp_path))
    step = next(step for step in schedule.steps_of(kept.plan, "sub-01") if step.condition == "plain" and step.kind == "trial")
    attempt = progress.Attempt(step.name, 1, "easy", 2)
    words = runner.LiveRunner(kept, "navvi", "close_trials").arguments("sub-01", step, attempt, tmp_path)
    assert words["feedback/haptics/enabled"] == "false" and words["feedback/sounds/enabled"] == "true"
    assert words["feedback/locked"] == words["trial/locked"] == "true"
    assert words["trial/study/condition"] == "plain" and words["participant"] == "sub-01" and words["once"] == "true"


def test_minutes_are_printed_with_one_decimal_at_most(tmp_path):
    shown = "\n".join(overview.schedule(small(tmp_path, ("limit: 60", "limit: 100"))))
    assert "easy 1, about 0.8 min\n" in shown and "tlx, about 3 min\n" in shown


def test_zones_of_a_world_are_a_file_beside_the_plan_that_is_frozen_with_what_is_in_it(tmp_path):
    assert "zones" not in json.dumps(small(tmp_path).values()), "plans without keep their hash"
    with_zones = ("a: {world: easy", "a: {zones: own.yaml, world: easy")
    with pytest.raises(StudyError, match="\"worlds/sets/a/zones\" is \"own.yaml\", and .* is not a file; allowed are files beside the plan.$"):
        small(tmp_path, with_zones)
    file = tmp_path / "own.yaml"
    file.write_text("- {name: dock, kind: keep_out, corners: [0, 0, 1, 0, 1, 1]}\n")
    kept = frozen(tmp_path, with_zones)
    step = next(step for step in schedule.steps_of(kept.plan, "sub-01") if step.kind == "trial")
    calls = tmp_path / "calls"
    (tmp_path / "bench").write_text(f"#!/bin/sh\necho \"$@\" >> {calls}; echo 'result\nreached'\n")
    (tmp_path / "bench").chmod(0o755)
    for seed, given in (1, str(file)), (2, None):
        attempt = progress.Attempt(step.name, 1, "easy", seed)
        assert runner.LiveRunner(kept, "navvi", "close_trials").arguments("sub-01", step, attempt, tmp_path).get("zones") == given
        runner.LoopRunner(kept, tmp_path / "bench", "test").trial("sub-01", step, attempt, tmp_path, 0)
        assert (f" nav/mesh/zones:={file}" in calls.read_text().splitlines()[-1]) == bool(given)
    calls.unlink()
    assert worlds.drive(kept.plan, tmp_path / "bench", 1)
    assert sum("nav/mesh/zones" in line for line in calls.read_text().splitlines()) == 1
    drawn = []
    worlds.pictures(kept.plan, lambda world, words, path: drawn.append(words))
    assert drawn[:2] == [["seed:=1", f"nav/mesh/zones:={file}"], ["seed:=2"]]
    file.write_text("- {name: dock, kind: keep_out, corners: [0, 0, 2, 0, 2, 2]}\n")
    with pytest.raises(StudyError, match="world_files/own.yaml: .* is now"):
        study.Study.of(kept.plan.file).require_frozen()


def test_a_plan_whose_voice_has_another_language_is_rehearsed_without_it(tmp_path):
    kept = frozen(tmp_path, ("full: {picture: false}", "full: {picture: false, parameters: {feedback/language: es, feedback/person: p, "
                             "feedback/speaker/rate: 200, perception/no_return: free, nav/map_frame: map, feedback/haptics/strength: 0.5, "
                             "feedback/lead: ticks}}"),
                  ("limit: 60", "limit: 2"))
    step = next(step for step in schedule.steps_of(kept.plan, "sub-01") if step.condition == "full" and step.kind == "trial")
    bench = ROOT / "navvi_ws/devel/lib/navvi_study/trials_bench"
    runner.LoopRunner(kept, bench, "test").trial("sub-01", step, progress.Attempt(step.name, 1, "easy", 1), tmp_path / "out", 0)
    assert next((tmp_path / "out").glob("trial-*/summary.csv")).is_file()
    parameters = next((tmp_path / "out").glob("trial-*/journal.csv")).read_text()
    assert "strength" in parameters and "lead" in parameters and "language" not in parameters


def test_a_new_kind_of_step_is_one_class(tmp_path, monkeypatch):
    class Hearing(Step):
        kind = key = "hearing"
        words = "the hearing test"
        usual = 4.0

        @classmethod
        def entry(cls, part, folder):
            return {"tones": part.take("tones", checked.whole(1, 9))}

        @classmethod
        def registered(cls, plan):
            return [("Measures", f"Hearing: {plan.hearing.tones} tones.")] if plan.hearing else []

        @classmethod
        def planned(cls, place):
            return [cls.at(place, "hearing")] if place.plan.steps["hearing"] else []

        def run(self, session, progress, person, lock):
            return session.done(person.name, self, heard=session.study.plan.steps["hearing"]["tones"])
    before = small(tmp_path).hash()
    monkeypatch.setitem(steps.ORDER, "begin", (*steps.ORDER["begin"], Hearing))
    for module in (plan_file, preregistration):
        monkeypatch.setattr(module, "KINDS", (*steps.KINDS, Hearing))
    assert small(tmp_path).hash() == before, "plans without keep their hash"
    assert "Hearing" not in preregistration.write(frozen(tmp_path / "without")).read_text()
    with pytest.raises(StudyError, match="\"hearing/tones\" is 0; allowed is a whole number from 1 to 9"):
        small(tmp_path, ("limit: 60", "limit: 60\nhearing: {tones: 0}"))
    kept = frozen(tmp_path, ("limit: 60", "limit: 60\nhearing: {tones: 3}\nminutes: {hearing: 2}"))
    assert "  s1-hearing: the hearing test, about 2 min" in overview.schedule(kept.plan)
    assert "- Hearing: 3 tones.\n" in preregistration.write(kept).read_text()
    assert rest(begin(kept))[:2] == ["s1-hearing", "s1-c1-trial-1"]
    assert kept.progress().people["sub-01"].done["s1-hearing"]["heard"] == 3


def test_what_was_learnt_of_a_person_is_kept_from_the_last_trial_that_tells():
    before = [{"stopping_delay_s": "0.5", "stopping_spread_s": "0.1"}, {"stopping_delay_s": "0.7", "stopping_spread_s": "0.2"},
              {"stopping_delay_s": "n/a"}]
    assert runner.learnt_before(before) == {"feedback/sounds/turn/stopping_delay": "0.7", "feedback/sounds/turn/stopping_spread": "0.2"}
    assert runner.learnt_before([{}]) == {}


def test_sets_are_alike_by_ways_turns_and_times_and_movers_are_counted(tmp_path):
    plan = small(tmp_path)

    def compared(**second):
        row = {"result": "reached", "shortest_path_m": "40.000", "elapsed_s": "120.000", "turns_per_min": "2.0", "mover_proximity_count": "12"}
        return worlds.compared(plan, {world: {**row, **(second if world.seed == 2 else {})} for world in plan.worlds})
    lines, alike = compared()
    assert "The turns of set 2 are 4, those of set 1 4; alike enough." in lines
    assert alike and "  set 1: easy 1: reached, way 40.0, turns 4, movers 12, time 120.0." in lines
    assert not compared(shortest_path_m="51.0")[1] and not compared(elapsed_s="151.0", turns_per_min="1.6")[1] and not compared(turns_per_min="4.0")[1]
    assert compared(turns_per_min="3.0")[1], "two turns apart are alike, however few they are"
    assert any(line == "The turns of set 2 are 8, those of set 1 4; other seeds would be better: alike are 1.25 times, or 2 turns." for line in compared(turns_per_min="4.0")[0])
