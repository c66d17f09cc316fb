"""Probes: a trial in each condition that stops unannounced, and is asked about at once. Angles: degrees, counter-clockwise from straight
ahead, in (-180, 180]."""
import math
from dataclasses import dataclass

from .. import questionnaire
from ..checked import list_of, number, text
from ..design import drawn
from ..plan import worlds_of
from ..record import Record
from .questions import Questions
from .trial import Driven


@dataclass(frozen=True)
class Planned:
    earliest: float  # s, when it stops
    latest: float
    worlds: tuple
    asks: object  # a Questionnaire


class Probe(Driven):
    kind, key = "probe", "probes"
    words = "a probe in {0.condition}"
    besides = "with a probe"
    columns = {
        "truth": ("of a probe: the answer that was true where the trial stopped; n/a where nobody can tell, or within a metre of the place", ""),
        "error_deg": ("of pointing: answer minus truth, in (-180, 180]", "deg"), "correct": ("of a probe's choice: yes or no", "")}
    ask, simulate = Questions.ask, Questions.simulate

    @classmethod
    def entry(cls, part, folder):
        after = part.take("after", list_of(number(1, 86400)))
        if len(after) != 2 or after[0] > after[1]:
            raise part.error("after", "is not a pair; allowed are the earliest and the latest second, such as [20, 60]")
        return Planned(*after, worlds_of(part.section("worlds", required=True), folder), questionnaire.find(part.take("ask", text, "probe"), folder))

    @classmethod
    def check(cls, root, plan):
        worlds = plan.steps["probes"] and plan.steps["probes"].worlds
        if worlds and plan.steps["probes"].latest > plan.limit:
            raise root.error("probes", f"has \"after\" up to {plan.steps['probes'].latest:g} s, and the limit of a trial is {plan.limit:g} s; "
                             "allowed is up to the limit")
        for group in plan.groups if worlds else ():
            if len(group.conditions) > len(worlds):
                raise root.error("probes", f"has {len(worlds)} worlds, and group {group.name} has {len(group.conditions)} conditions; allowed are as many worlds or more")

    @classmethod
    def registered(cls, plan):
        return [("Measures", "Probes: a trial in each condition that stops unannounced, and questions about it.")] if plan.probes else []

    @classmethod
    def planned(cls, place):
        one = place.plan.steps["probes"]
        if not one:
            return []
        # Whole seconds, drawn for the participant and the place of the condition, so that nobody can tell when it comes.
        stop = round(drawn(place.participant, "probe", place.order).uniform(one.earliest, one.latest))
        return [cls.at(place, "probe", repeat=1, world=one.worlds[place.order - 1], asks=one.asks, limit=float(stop))]

    @classmethod
    def guess(cls, plan):
        return plan.steps["probes"].latest / 60 + 0.3 * len(plan.steps["probes"].asks.items)

    def run(self, session, progress, person, lock):
        """One that does not count is driven again, as long as a world is left."""
        if not self.asks_of(person):
            if self.given_up(progress, person):
                return session.done(person.name, self)
            if not super().run(session, progress, person, lock):
                return False
            if not self.asks_of(session.study.progress().person(person.name)):
                return True
        return Questions.run(self, session, progress, person, lock)

    def asks_of(self, person):
        return next((attempt for attempt in reversed(person.of(self)) if attempt.counts), None)

    def truth(self, study, person, row):
        item = next((item for item in self.asks.items if item.name == row["item"]), None)
        if not item or not item.probes:
            return {}
        stopped = self.asks_of(person)
        known = truth(item, Record(study.attempt_folder(person.name, self.name, stopped.number) / stopped.trial)) if stopped else None
        return {"truth": "n/a" if known is None else known, **off(item, row["answer"], known)}


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
