"""Where things were around the robot when a trial stopped, and how far an answer is off. Angles: degrees, counter-clockwise from straight
ahead, in (-180, 180]."""
import math


def wrapped(degrees):
    return 180.0 - (180.0 - degrees) % 360.0


def truth(item, record):
    """What the item's answer should be, as text; None where the record does not know, or where the robot stands within a metre of the place.
    \\param record  of the trial that stopped"""
    end = record.of("TRIAL_END")
    if not end:
        return None
    if item.beside:
        seen = end[-1].fields.get(item.beside, "n/a")
        return item.choices[item.classes.index(seen)] if seen in item.classes else None
    place, robot = _place(item.point, record), [end[-1].number(name) for name in ("x", "y", "yaw")]
    if place is None or None in robot:
        return None
    x, y, yaw = robot
    if math.hypot(place[0] - x, place[1] - y) < 1.0:
        return None
    return f"{wrapped(math.degrees(math.atan2(place[1] - y, place[0] - x) - yaw)):.0f}"


def off(item, answer, known):
    """error_deg of a pointed answer, or `correct` of a chosen one, as columns of answers.csv; n/a where nobody can tell."""
    name = "error_deg" if item.point else "correct"
    if known is None or answer not in item.values():
        return {name: "n/a"}
    return {name: f"{wrapped(float(answer) - float(known)):.0f}" if item.point else "yes" if answer == known else "no"}


def _place(name, record):
    """Of the goal that was set last, or of the start; m, in map."""
    rows = record.of("GOAL_SET") if name == "goal" else record.of("TRIAL_START")
    names = ("goal_x", "goal_y") if name == "goal" else ("x", "y")
    place = [rows[-1].number(axis) for axis in names] if rows else [None]
    return None if None in place else place
