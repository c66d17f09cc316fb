"""What is compared between conditions, from the tables of a study."""
from dataclasses import dataclass


DROP_OUT = "drop-out"  # in the column counts
# For which trials a measure is defined. Of those that count, which are reached or timed out; who broke one off is a drop-out.
ALL = "trials that count"
REACHED = "trials that reached the goal"
BEGUN = "trials that count, and drop-outs"
ANSWERED = "questionnaires answered in every item"
PROBED = "probes with a true direction"


@dataclass(frozen=True)
class Measure:
    label: str
    unit: str
    kind: str  # count, time (censored where the goal was not reached), share, number
    columns: tuple = ()  # of trials.csv; summed, or the first divided by the second; of a share, the result whose share it is
    questionnaire: str = ""  # whose score it is
    less_is_better: bool = True
    of: str = ALL


MEASURES = {
    "time": Measure("Time to the goal", "s", "time", ("elapsed_s",)),
    "collisions": Measure("Collisions", "a trial", "count", ("shelf_collision_count", "obstacle_collision_count")),
    "shelf_collisions": Measure("Collisions with shelves", "a trial", "count", ("shelf_collision_count",)),
    "obstacle_collisions": Measure("Collisions with obstacles", "a trial", "count", ("obstacle_collision_count",)),
    "reached": Measure("Goal reached", "share of trials", "share", ("reached",), less_is_better=False, of=BEGUN),
    "drop_out": Measure("Drop-out", "share of trials", "share", ("drop-out",), of=BEGUN),
    "detour": Measure("Way driven over the first path", "times", "number", ("path_length_m", "first_path_length_m"), of=REACHED),
    "stuck": Measure("Stuck", "a trial", "count", ("stuck_count",)),
    "pointing": Measure("Error of pointing at goal and start", "degrees", "number", (), "probe", of=PROBED),
    "tlx": Measure("Workload, raw NASA-TLX", "0 to 100", "number", (), "tlx", of=ANSWERED),
    "sus": Measure("Usability, SUS", "0 to 100", "number", (), "sus", False, of=ANSWERED),
}


def value(measure, row):
    """Of one trial, a row of trials.csv; None where it is not known, or the measure is not defined for the trial."""
    if row["counts"] != "yes" and not (measure.of == BEGUN and row["counts"] == DROP_OUT):
        return None
    if measure.kind == "share":
        return float((DROP_OUT if row["counts"] == DROP_OUT else row["result"]) == measure.columns[0])
    if measure.of == REACHED and row["result"] != "reached":
        return None
    numbers = [number(row.get(column)) for column in measure.columns]
    if None in numbers:
        return None
    if measure.kind == "number":
        return numbers[0] / numbers[1] if numbers[1] > 0 else None
    return sum(numbers)


def number(cell):
    try:
        return float(cell)
    except (TypeError, ValueError):
        return None
