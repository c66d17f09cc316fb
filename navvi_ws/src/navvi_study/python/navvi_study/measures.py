"""What is compared between conditions, from the tables of a study."""
from dataclasses import dataclass


@dataclass(frozen=True)
class Measure:
    label: str
    unit: str
    kind: str  # count, time (censored where the goal was not reached), share, number
    columns: tuple = ()  # of trials.csv; summed, or the first divided by the second
    questionnaire: str = ""  # whose score it is
    less_is_better: bool = True


MEASURES = {
    "time": Measure("Time to the goal", "s", "time", ("elapsed_s",)),
    "collisions": Measure("Collisions", "a trial", "count", ("shelf_collision_count", "obstacle_collision_count")),
    "shelf_collisions": Measure("Collisions with shelves", "a trial", "count", ("shelf_collision_count",)),
    "obstacle_collisions": Measure("Collisions with obstacles", "a trial", "count", ("obstacle_collision_count",)),
    "reached": Measure("Goal reached", "share of trials", "share", ("result",), less_is_better=False),
    "detour": Measure("Way driven over the first path", "times", "number", ("path_length_m", "first_path_length_m")),
    "stuck": Measure("Stuck", "a trial", "count", ("stuck_count",)),
    "pointing": Measure("Error of pointing at goal and start", "degrees", "number", (), "probe"),
    "tlx": Measure("Workload, raw NASA-TLX", "0 to 100", "number", (), "tlx"),
    "sus": Measure("Usability, SUS", "0 to 100", "number", (), "sus", False),
}


def value(measure, row):
    """Of one trial, a row of trials.csv; None where it is not known."""
    if measure.kind == "share":
        return float(row["result"] == "reached")
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
