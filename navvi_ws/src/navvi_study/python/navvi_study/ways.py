"""What the journals show of each trial: ways over the map of their world, and how much was said, played and felt."""
from . import table
from .record import Record

DASHES = ("solid", (0, (4, 2)), (0, (1, 2)), (0, (6, 2, 1, 2)), (0, (3, 3)), (0, (1, 1)))  # of lines: conditions are told apart without colours, too
MODALITIES = ("speech", "sound", "rumble")


def records(study, progress):
    """(row of trials.csv, Record) of each trial that counts and has a journal."""
    found = []
    for row in table.trials(study, progress):
        if row["counts"] == "yes":
            attempt = table.attempt_of(progress, row)
            record = Record(study.attempt_folder(row["participant"], attempt.step, attempt.number) / row["trial"])
            if record.first("TRIAL_START"):
                found.append((row, record))
    return found


def by_world(found):
    """By (world, seed): pairs of condition and way, such as ("words", [(x, y), ...])."""
    worlds = {}
    for row, record in found:
        way = [(x, y) for _, x, y in record.way()]
        if len(way) > 1:
            worlds.setdefault((row.get("world", "n/a"), row.get("seed", "n/a")), []).append((row["condition"], way))
    return dict(sorted(worlds.items()))


def length(way):
    """m."""
    return sum(((x - a) ** 2 + (y - b) ** 2) ** 0.5 for (a, b), (x, y) in zip(way, way[1:]))


def cues_by_condition(found, conditions):
    """By condition: its trials, their minutes, and how many cues each modality had."""
    result = {}
    for condition in conditions:
        mine = [record for row, record in found if row["condition"] == condition]
        if mine:
            cues = [modality for record in mine for _, modality, _, _ in record.cues()]
            result[condition] = len(mine), sum(record.onset(record.rows[-1]) for record in mine) / 60, list(map(cues.count, MODALITIES))
    return result
