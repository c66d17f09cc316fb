"""The tables of a batch of trials (./navvi batch), as lines of Markdown.

Each person and condition, and, over the same worlds and seeds, the mean of what a condition changes beside the condition
"default" with its 95 % interval (bootstrap of the pairs).
"""
import csv
import random
import statistics
from pathlib import Path
from typing import NamedTuple

MEASURES = {"contacts": "contacts a trial", "elapsed_s": "time, s", "spl": "SPL"}
BETTER = {"contacts": -1.0, "elapsed_s": -1.0, "spl": 1.0}
TYPES = ("able", "typical", "struggling")
DRAWS = 2000


class Goal(NamedTuple):
    measure: str
    text: str
    form: str
    most: tuple  # of each type; for SPL and goals reached the least
    condition: str = "default"


GOALS = (
    Goal("contacts", "contacts a trial", ".3f", (0.02, 0.05, 0.3)),
    Goal("spl", "SPL", ".3f", (0.95, 0.93, 0.88)),
    Goal("over_sighted", "time over the sighted reference", ".2f", (1.2, 1.5, 2.2)),
    Goal("residual_deg", "residual turn error, deg, median", ".1f", (4.0, 8.0, 12.0)),
    Goal("cues_per_min", "utterances a minute", ".1f", (8.0, 8.0, 8.0)),
    Goal("over_sighted", "`flow`: time over the sighted reference", ".2f", (1.06, 1.1, 1.2), "flow"),
    Goal("contacts", "`flow`: contacts a trial", ".3f", (0.01, 0.03, 0.08), "flow"),
    Goal("reached", "`hand` without any sound: goals reached", ".3f", (0.99, 0.99, 0.98), "hand_alone"),
    Goal("over_sighted", "likewise: time over the sighted reference", ".2f", (1.15, 1.2, 1.3), "hand_alone"),
    Goal("contacts", "likewise: contacts a trial", ".3f", (0.05, 0.06, 0.12), "hand_alone"),
)


# Columns as batches of before 1.0.0 name them.
RENAMED = {"time": "elapsed_s", "driven": "path_length_m", "residual": "residual_deg", "cues": "cues_per_min", "still": "still_s"}


def read(folder):
    with open(Path(folder) / "trials.csv", encoding="utf-8", newline="") as file:
        return [{RENAMED.get(name, name): cell for name, cell in row.items()} for row in csv.DictReader(file)]


def ordered(rows, name):
    return list(dict.fromkeys(row[name] for row in rows))


def of(rows, person, condition):
    return [row for row in rows if row["person"] == person and row["condition"] == condition]


def values(rows, name):
    """Of the trials that have it."""
    if name == "reached":
        return [float(row["result"] == "reached") for row in rows]
    return [float(row[name]) for row in rows if row.get(name) not in (None, "", "n/a")]


def differences(rows, person, condition, measure, beside="default"):
    """Over the trials that both conditions have."""
    def by_trial(name):
        return {(row["world"], row["seed"], row["person_seed"]): float(row[measure]) for row in of(rows, person, name)}
    there, base = by_trial(condition), by_trial(beside)
    return [there[key] - base[key] for key in there if key in base]


def interval(numbers, estimate=statistics.fmean):
    """The estimate and its 95 % interval; the draws are the same each time."""
    draw = random.Random(1)
    drawn = sorted(estimate(draw.choices(numbers, k=len(numbers))) for _ in range(DRAWS))
    return estimate(numbers), drawn[int(0.025 * DRAWS)], drawn[int(0.975 * DRAWS)]


def shown(value, low, high, form="+.2f"):
    return f"{value:{form}} [{low:{form}}, {high:{form}}]"


def verdict(measure, low, high):
    """better, worse, or nothing that the interval excludes."""
    if low <= 0.0 <= high:
        return "-"
    return "better" if low * BETTER[measure] > 0.0 else "worse"


def head(*titles):
    return ["| " + " | ".join(titles) + " |", "|" + "---|" * len(titles)]


def line(*cells):
    return "| " + " | ".join(str(cell) for cell in cells) + " |"


def median(rows, name, form):
    numbers = values(rows, name)
    return format(statistics.median(numbers), form) if numbers else "-"


def changed_conditions(rows):
    return [condition for condition in ordered(rows, "condition") if condition not in ("default", "sighted")]


def guidance(rows):
    changes_of = {name: text for name, text in MEASURES.items() if name != "spl"}
    lines = head("person", "condition", "reached", "contacts", "time, s", "over sighted", "SPL", "residual turn error, deg", "utterances/min",
                 *(f"change of {text}" for text in changes_of.values()))
    for person in ordered(rows, "person"):
        for condition in ordered(rows, "condition"):
            own = of(rows, person, condition)
            mean = {name: statistics.fmean(float(row[name]) for row in own) for name in [*MEASURES, "cues_per_min"]}
            changes = [""] * len(changes_of) if condition in ("default", "sighted") else [
                shown(*interval(differences(rows, person, condition, name))) for name in changes_of]
            lines.append(line(person, condition, f"{sum(row['result'] == 'reached' for row in own)}/{len(own)}", f"{mean['contacts']:.2f}",
                              f"{mean['elapsed_s']:.0f}", median(own, "over_sighted", ".2f"), f"{mean['spl']:.3f}", median(own, "residual_deg", ".1f"),
                              "-" if condition == "sighted" else f"{mean['cues_per_min']:.1f}", *changes))
    return lines


def goals(rows):
    """What was aimed at beside what is, each with its interval, and whether the figure meets the goal."""
    lines = head("measure", *TYPES)
    for goal in (goal for goal in GOALS if goal.condition in ordered(rows, "condition")):
        cells = []
        for person, bound in zip(TYPES, goal.most):
            estimate = statistics.median if goal.measure == "residual_deg" else statistics.fmean
            value, low, high = interval(values(of(rows, person, goal.condition), goal.measure), estimate)
            least = goal.measure in ("spl", "reached")
            met = value >= bound if least else value <= bound
            cells.append(f"{shown(value, low, high, goal.form)}, {'at least' if least else 'at most'} {bound:g}: {'met' if met else 'missed'}")
        lines.append(line(goal.text, *cells))
    return lines


def noise(rows):
    """What touch changes for people who hear one cue in two."""
    lines = head("by the hand, beside ticks without touch", *TYPES)
    for name, text in MEASURES.items():
        lines.append(line(text, *(shown(*interval(differences(rows, person, "noise_hand", name, "noise_numb"))) for person in TYPES)))
    return lines


def worse(rows):
    """Time over sighted and contacts of people who are slower and err more."""
    lines = head("way", "measure", *TYPES)
    for condition, way in (("flow_worse", "`flow`"), ("hand_worse", "`hand`")):
        for name, text, form in (("over_sighted", "time over sighted", ".2f"), ("contacts", "contacts a trial", ".3f")):
            lines.append(line(way, text, *(shown(*interval(values(of(rows, person, condition), name)), form) for person in TYPES)))
    return lines


def flips(rows):
    """The conclusions from person to person: better or worse than default where the interval excludes none."""
    people = ordered(rows, "person")
    lines = head("condition, beside default", "measure", *people, "order reverses")
    for condition in changed_conditions(rows):
        for name, text in MEASURES.items():
            verdicts, cells = [], []
            for person in people:
                found = interval(differences(rows, person, condition, name))
                verdicts.append(verdict(name, *found[1:]))
                cells.append(shown(*found) + (f" {verdicts[-1]}" if verdicts[-1] != "-" else ""))
            lines.append(line(condition, text, *cells, "yes" if {"better", "worse"} <= set(verdicts) else "no"))
    return lines


def failures(rows):
    """One trial of each class, the first of the batch, with the words that run it again and trace it."""
    def number(row, name):
        return float(row[name]) if row.get(name) not in (None, "", "n/a") else 0.0
    movers = ("worker", "forklift", "pallet_robot")
    led = [row for row in rows if row["condition"] == "default"]
    classes = {
        "hits a shelf or a wall": lambda row: "shelf" in row["hits"] or "wall" in row["hits"],
        "hits what moves": lambda row: any(name in row["hits"] for name in movers),
        "hits another thing": lambda row: row["hits"] != "-" and not any(name in row["hits"] for name in ("shelf", "wall", *movers)),
        "does not reach the goal": lambda row: row["result"] != "reached",
        "needs more than three times as long as the sighted reference": lambda row: number(row, "over_sighted") > 3.0,
        "turns that leave more than 20 deg, the median": lambda row: number(row, "residual_deg") > 20.0,
        "stands for more than a minute": lambda row: number(row, "still_s") > 60.0,
        "pushes in vain without a word": lambda row: number(row, "speechless") > 0.0,
    }
    lines = head("class", "trials of " + str(len(led)), "WORDS of the first")
    for name, belongs in classes.items():
        found = [row for row in led if belongs(row)]
        again = "-" if not found else f"`--worlds={found[0]['world']} --seeds={found[0]['seed']} --people={found[0]['person']}:{found[0]['person_seed']}`"
        lines.append(line(name, len(found), again))
    return lines
