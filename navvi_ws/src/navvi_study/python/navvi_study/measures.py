"""What is compared between conditions, from the tables of a study."""
import math
from dataclasses import dataclass
from statistics import NormalDist

DROP_OUT = "drop-out"  # in the column counts
# For which trials a measure is defined. Of those that count, which are reached or timed out; who broke one off is a drop-out.
ALL = "trials that count"
REACHED = "trials that reached the goal"
BEGUN = "trials that count, and drop-outs"
ANSWERED = "questionnaires answered in every item"
PRORATED = "questionnaires with one item declined at most"
PROBED = "probes with a true direction"

LEAST = 5  # participants, below which an interval or a test is not given
RESAMPLES = 10000  # of a bootstrap
# What counts are divided by, as the plan's outcomes say: the unit, a column of trials.csv, and how much of it is one.
EXPOSURES = {"trial": ("a trial", None, 1.0), "time": ("a minute", "elapsed_s", 60.0), "path": ("per 100 m", "path_length_m", 100.0)}


@dataclass(frozen=True)
class Measure:
    label: str
    unit: str
    kind: str  # count, time (censored where the goal was not reached), share, number
    sentence: str  # after "In condition sounds, ": {amount} and {more} stand for the difference, {unit} for the unit of a count
    columns: tuple = ()  # of trials.csv; summed, or the first divided by the second; of a share, the result whose share it is
    questionnaire: str = ""  # whose score it is
    of: str = ALL
    more: tuple = ("less", "more")  # {more} of a difference below and above 0


_HITS = {"kind": "count", "unit": EXPOSURES["trial"][0], "more": ("fewer", "more")}
MEASURES = {
    "time": Measure("Time to the goal", "s", "time", "participants took {amount} s {more}", ("elapsed_s",)),
    "collisions": Measure("Collisions", sentence="participants had {amount} {more} collisions {unit}",
                          columns=("shelf_collision_count", "obstacle_collision_count"), **_HITS),
    "shelf_collisions": Measure("Collisions with shelves", sentence="participants had {amount} {more} collisions with shelves {unit}",
                                columns=("shelf_collision_count",), **_HITS),
    "obstacle_collisions": Measure("Collisions with obstacles", sentence="participants had {amount} {more} collisions with obstacles {unit}",
                                   columns=("obstacle_collision_count",), **_HITS),
    "reached": Measure("Goal reached", "share of trials", "share", "participants reached the goal {amount} percentage points {more} often", ("reached",), of=BEGUN),
    "drop_out": Measure("Drop-out", "share of trials", "share", "participants dropped out {amount} percentage points {more} often", ("drop-out",), of=BEGUN),
    "detour": Measure("Way driven over the first path", "times", "number", "the way driven was {amount} times the first path {more}",
                      ("path_length_m", "first_path_length_m"), of=REACHED, more=("shorter", "longer")),
    "stuck": Measure("Stuck", sentence="participants were stuck {amount} times {unit} {more}", columns=("stuck_count",), **{**_HITS, "more": ("less", "more")}),
    "pointing": Measure("Error of pointing at goal and start", "degrees", "number", "participants pointed {amount} degrees {more} off", (), "probe", of=PROBED),
    "tlx": Measure("Workload, raw NASA-TLX", "0 to 100", "number", "the workload was {amount} points {more}", (), "tlx", of=PRORATED, more=("lower", "higher")),
    "sus": Measure("Usability, SUS", "0 to 100", "number", "the usability was {amount} points {more}", (), "sus", of=ANSWERED, more=("lower", "higher")),
}


def value(measure, row):
    """Of one trial, a row of trials.csv; None where it is not known, or the measure is not defined for the trial."""
    if row["counts"] != "yes" and not (measure.of == BEGUN and row["counts"] == DROP_OUT):
        return None
    if measure.columns == (DROP_OUT,):  # of a job once, however far it came
        return float(row["counts"] == DROP_OUT) if row.get("leg", "1") == "1" else None
    if measure.kind == "share":
        return float(row["result"] == measure.columns[0])
    if measure.of == REACHED and row["result"] != "reached":
        return None
    numbers = [number(row.get(column)) for column in measure.columns]
    if None in numbers:
        return None
    if measure.kind == "number":
        return numbers[0] / numbers[1] if numbers[1] > 0 else None
    return sum(numbers)


def unit(name, per):
    """Of a measure's values. \\param per  a key of EXPOSURES"""
    return EXPOSURES[per][0] if MEASURES[name].kind == "count" else MEASURES[name].unit


def exposure(measure, row, per):
    """What the value of a trial is divided by: 1 but for counts, whose exposure the plan may name; None where it is not known.
    \\param per  a key of EXPOSURES"""
    _, column, one = EXPOSURES[per]
    if measure.kind != "count" or column is None:
        return 1.0
    driven = number(row.get(column))
    return driven / one if driven else None


def sample_size(effect, sd, power, equivalence=False):
    """Participants of a paired t test, two-sided at 5 %, by the normal distribution with the correction of Guenther (The American Statistician 35,
    1981); or of two one-sided tests at 5 %, whose bound is the effect, where there is no difference."""
    z = NormalDist().inv_cdf
    alpha = z(0.95 if equivalence else 0.975)
    return math.ceil(((alpha + z((1 + power) / 2 if equivalence else power)) * sd / effect) ** 2 + alpha ** 2 / 2)


def number(cell):
    try:
        return float(cell)
    except (TypeError, ValueError):
        return None
