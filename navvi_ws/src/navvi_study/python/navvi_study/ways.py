"""What the journals show of each trial: ways over the map of their world, and when something was said, played or felt."""
import re

from . import table
from .record import Record

DASHES = ("none", "9 4", "2 4", "12 3 2 3", "5 5", "1 3")  # so that conditions are told apart without colours, too
MODALITIES = ("speech", "sound", "rumble")
MOST_LINES = 12  # trials of a condition in the figure of cues


def records(study, progress):
    """(row of trials.csv, Record) of each trial that counts and has a journal."""
    found = []
    for row in table.trials(study, progress):
        if row["counts"] == "yes":
            attempt = table.attempt_of(progress, row)
            record = Record(study.attempt_folder(row["participant"], attempt.step, attempt.number) / attempt.trial)
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


def over_map(picture, ways, conditions, colours):
    """The SVG of `./navvi world show` with the ways drawn over it. \\param conditions  all, in the order of colours
    None where the picture does not name its area."""
    area = re.search(r'data-area="([^"]+)"', picture)
    frame = re.search(r'<clipPath id="map"><rect x="([\d.]+)" y="([\d.]+)" width="([\d.]+)" height="([\d.]+)"', picture)
    if not area or not frame:
        return None
    left, _, right, top = map(float, area[1].split())
    x0, y0, width, _ = map(float, frame.groups())
    scale = width / (right - left)
    edges, lines = "", ""  # white ones below, so that a way is seen on all that it crosses
    for condition, way in ways:
        at = conditions.index(condition)
        points = " ".join(f"{x0 + (x - left) * scale:.1f},{y0 + (top - y) * scale:.1f}" for x, y in way)
        edges += f'<polyline points="{points}" fill="none" stroke="#ffffff" stroke-width="6"/>\n'
        lines += f'<polyline points="{points}" fill="none" stroke="{colours[at % len(colours)]}" stroke-width="3" stroke-dasharray="{DASHES[at % len(DASHES)]}"/>\n'
    return picture.replace("</svg>", edges + lines + "</svg>")


def length(way):
    """m."""
    return sum(((x - a) ** 2 + (y - b) ** 2) ** 0.5 for (a, b), (x, y) in zip(way, way[1:]))


def cues_by_condition(found, conditions):
    """By condition: the trials' lists of (s, modality), and their minutes."""
    result = {}
    for condition in conditions:
        mine = [record for row, record in found if row["condition"] == condition]
        if mine:
            minutes = sum(record.onset(record.rows[-1]) for record in mine) / 60
            result[condition] = [[(onset, modality) for onset, modality, _, _ in record.cues()] for record in mine], minutes
    return result
