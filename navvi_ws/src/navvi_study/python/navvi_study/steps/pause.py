"""Breaks between conditions."""
from dataclasses import dataclass

from ..checked import number, whole
from .step import Step


@dataclass(frozen=True)
class Planned:
    after: int  # conditions
    minutes: float


class Pause(Step):
    kind = key = "break"
    words = "a break of {0.minutes:g} min"
    timed = False  # by its own section

    @classmethod
    def read(cls, root, folder):
        return {"pause": super().read(root, folder)["break"]}

    @classmethod
    def entry(cls, part, folder):
        return Planned(part.take("after", whole(1, 20), 1), part.take("minutes", number(0, 600)))

    @classmethod
    def planned(cls, place):
        wanted, driven = place.plan.steps["pause"], place.conditions.index(place.condition) + 1
        due = wanted and driven < len(place.conditions) and driven % wanted.after == 0
        return [cls.at(place, "break", minutes=wanted.minutes)] if due else []

    def run(self, session, progress, person, lock):
        if session.wait:
            session.say(f"navvi: {person.name}: a break of {self.minutes:g} minutes; Ctrl-C ends it early.")
            try:
                session.runner.lines.drop(60 * self.minutes)
            except KeyboardInterrupt:
                session.say("navvi: the break was ended early.")
        return super().run(session, progress, person, lock)
