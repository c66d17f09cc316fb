"""What a trial left in its folder."""
from pathlib import Path

from .places import NAVVI  # first, as it says where the next one is
from navvi_study.errors import StudyError  # noqa: E402
from navvi_study.record import Record, summary_of  # noqa: E402
from .say import fail

# What a person reads at a session's end; all of it by ./navvi show.
BRIEF = ["path_length_m", "safe_stop_count", "cues_spoken"]


def summary(folder):
    try:
        return summary_of(Path(folder))
    except StudyError as problem:
        fail(str(problem), 2)


def require_end(folder, row):
    """Refuses a journal that ends before its trial, as the summary tells it."""
    path = Path(folder) / "journal.csv"
    if path.is_file() and row["reason"] != "no_end" and not Record(path.parent).first("TRIAL_END"):
        fail(f"{path} has no end (TRIAL_END), and summary.csv says that the trial ended: {row['result']}. Restore the journal from a copy.")


def summed_up(begun, out):
    """The folders of `out` of a session's trials, by their names in the order in which they began; others may be of another session."""
    return [out / name for name in begun if (out / name / "summary.csv").is_file()]


def conditions(folder):
    """The fields of the journal's TRIAL_START by name; its settings, such as nav/mesh/climb, as `settings` by theirs."""
    start = Record(Path(folder)).first("TRIAL_START")
    fields = dict(start.fields) if start else {}  # of a folder that holds a bag alone
    fields["settings"] = dict(word.split("=", 1) for word in fields.get("settings", "").split(" ") if "=" in word)
    return fields


def times(folder, since_start=True):
    """s of each row of the journal, by type; since the trial began, or as the ROS time it was."""
    found = {}
    for row in Record(Path(folder)).rows:
        found.setdefault(row.type, []).append(row.sim_ns / 1e9)
    begun = found.get("TRIAL_START", [0.0])[0] if since_start else 0.0
    return {kind: [time - begun for time in moments] for kind, moments in found.items()}


def sentence(row):
    """How a trial ended."""
    if row["result"] != "reached":
        return f"The goal was not reached: {row['result']}, {row['reason'].replace('_', ' ')}."
    if row["shelf_collision_count"] == "unknown":
        return f"The goal was reached in {row['elapsed_s']} s; contacts are unknown, as nothing told of them."
    shelves = row["shelf_collision_count"]
    return (f"The goal was reached in {row['elapsed_s']} s, with {shelves} collision{'s' * (shelves != '1')} with shelves "
            f"and {row['obstacle_collision_count']} with obstacles.")


def lines(row, names):
    return [f"{name.replace('_', ' ')}: {row.get(name, 'n/a')}" for name in names]


def report(folder):
    """The end of a session in at most 8 lines, the sentence last; the exit code."""
    row = summary(folder)
    broken = ["bag"] if row.get("bag") != "ok" else []
    print("\n".join([*lines(row, [*BRIEF, *broken]), f"The record is in {folder}; \"{NAVVI} show\" with this folder prints all of it.", sentence(row)]))
    return 0 if row["result"] == "reached" else 1
