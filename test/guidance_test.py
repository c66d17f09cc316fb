"""The tables of doc/guidance.md, of rows whose figures are known by hand."""
from types import SimpleNamespace
from xml.etree import ElementTree

from navvi_people import batch, guidance_page as page, guidance_plots as plots, guidance_tables as tables


def row(seed, person="able", condition="default", **more):
    values = {"world": "busy", "seed": str(seed), "person": person, "person_seed": "1", "condition": condition, "contacts": "0", "spl": "0.960",
              "result": "reached", "elapsed_s": "100", "path_length_m": "50.0", "over_sighted": "1.1", "residual_deg": "3.0", "cues_per_min": "6.0", "hits": "-",
              "still_s": "5.0", "speechless": "0"}
    return {**values, **more}


def batch_of(change):
    """Ten worlds, three persons, and a condition beside default. \\param change  of time, s, of each person"""
    rows = []
    for seed in range(10):
        for person, seconds in zip(tables.TYPES, change):
            rows.append(row(seed, person, elapsed_s=str(100 + seed)))
            rows.append(row(seed, person, "sounds_off", elapsed_s=str(100 + seed + seconds + 0.1 * seed)))
    return rows


def test_an_interval_holds_the_mean_and_is_the_same_each_time():
    numbers = [1.0, 2.0, 3.0, 4.0, 10.0]
    value, low, high = tables.interval(numbers)
    assert value == 4.0 and 1.0 <= low < 4.0 < high <= 10.0
    assert tables.interval(numbers) == (value, low, high)
    assert tables.interval([2.0] * 5) == (2.0, 2.0, 2.0)


def test_changes_are_of_the_same_worlds_alone():
    rows = [row(1, elapsed_s="100"), row(2, elapsed_s="300"), row(1, condition="brief", elapsed_s="90"), row(3, condition="brief", elapsed_s="1")]
    assert tables.differences(rows, "able", "brief", "elapsed_s") == [-10.0]


def test_a_conclusion_turns_round_where_it_is_better_for_one_person_and_worse_for_another():
    lines = {line.split(" | ")[1]: line for line in tables.flips(batch_of((20.0, 20.0, -20.0)))[2:]}
    assert lines["time, s"].endswith("| yes |") and lines["time, s"].count("worse") == 2 and lines["time, s"].count("better") == 1
    assert lines["SPL"].endswith("| no |") and "worse" not in lines["SPL"]
    assert tables.flips(batch_of((20.0, 20.0, 20.0)))[3].endswith("| no |")


def test_goals_are_met_or_missed():
    cells = {line.split(" | ")[0]: line.split(" | ")[1:] for line in tables.goals(batch_of((20.0, 20.0, -20.0)))[2:]}
    assert [cell.partition(": ")[2].strip(" |") for cell in cells["| contacts a trial"]] == ["met"] * 3
    assert [cell.partition(": ")[2].strip(" |") for cell in cells["| SPL"]] == ["met"] * 3
    assert "| `flow`: contacts a trial" not in cells, "it was not measured"
    led = [row(seed, person, "hand_alone", result="gave_up" if seed == 0 else "reached") for seed in range(10) for person in tables.TYPES]
    cells = {line.split(" | ")[0]: line.split(" | ")[1:] for line in tables.goals(batch_of((0.0, 0.0, 0.0)) + led)[2:]}
    assert cells["| `hand` without any sound: goals reached"][0].startswith("0.900 [") and "at least 0.99: missed" in cells[
        "| `hand` without any sound: goals reached"][0]
    rows = [{**one, "contacts": "1", "spl": "0.930", "residual_deg": "4.1"} for one in batch_of((0.0, 0.0, 0.0))]
    cells = {line.split(" | ")[0]: line.split(" | ")[1:] for line in tables.goals(rows)[2:]}
    for measure, wanted in (("| contacts a trial", ["missed"] * 3), ("| SPL", ["missed", "met", "met"]),
                            ("| residual turn error, deg, median", ["missed", "met", "met"])):
        assert [cell.partition(": ")[2].strip(" |") for cell in cells[measure]] == wanted


def test_touch_in_noise_is_held_to_the_same_worlds_without_it():
    rows = [row(seed, person, condition, contacts=contacts) for seed in range(5) for person in tables.TYPES
            for condition, contacts in (("noise_numb", "1"), ("noise_hand", "0"))]
    assert tables.noise(rows)[2].split(" | ")[1] == "-1.00 [-1.00, -1.00]"


def test_a_row_of_the_table_has_what_a_condition_changes_over_the_same_worlds():
    lines = tables.guidance(batch_of((20.0, 20.0, -20.0)))
    cells = {tuple(line.split(" | ")[:2]): line for line in lines[2:]}
    assert {line.count(" | ") for line in lines[2:]} == {lines[0].count(" | ")} and len(cells) == 6
    assert "| 10/10 | 0.00 | 104 |" in cells["| able", "default"] and "+20.45 [" in cells["| able", "sounds_off"]


def test_each_class_of_failure_names_its_first_trial():
    rows = [row(1), row(2, hits="shelf 1"), row(3, hits="forklift 1 shelf 2"), row(4, result="gave_up"), row(5, condition="brief", hits="worker 1")]
    lines = {line.split(" | ")[0].strip("| "): line.split(" | ")[1:] for line in tables.failures(rows)[2:]}
    assert lines["hits a shelf or a wall"][0] == "2" and "--seeds=2 " in lines["hits a shelf or a wall"][1]
    assert lines["hits what moves"][0] == "1" and "--seeds=3 " in lines["hits what moves"][1]
    assert lines["does not reach the goal"][0] == "1" and lines["hits another thing"] == ["0", "- |"]


def test_a_plot_has_a_mark_a_person_and_condition_and_the_same_bytes_twice():
    rows = batch_of((20.0, 20.0, -20.0))
    text = plots.drawn("Choices", plots.changes(rows))
    assert text == plots.drawn("Choices", plots.changes(rows))
    circles = [one for one in ElementTree.fromstring(text).iter() if one.tag.endswith("circle")]
    assert len(circles) == 3 + 3 * 3, "three in the key, and three persons in each of three panels"


def test_the_batches_of_the_page_can_be_run():
    for words in page.BATCHES.values():
        given = dict(word[2:].split("=", 1) for word in words)
        assert len(batch.trials_of(SimpleNamespace(**{"worlds": "busy", **given}))) >= 300
