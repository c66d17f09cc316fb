"""Practice: trials before what counts, until as many in a row as wanted meet the criterion, or `most` were driven."""
from dataclasses import dataclass

from ..checked import one_of, whole
from ..plan import worlds_of
from .trial import Driven, Trial


@dataclass(frozen=True)
class Planned:
    before: str = "study"  # study, session or condition
    in_a_row: int = 1
    collisions: int = 0  # at most
    most: int = 5
    worlds: tuple = ()


class Practice(Driven):
    kind = key = "practice"
    words = "practice"
    drop_out = False
    besides = "of practice"

    @classmethod
    def entry(cls, part, folder):
        planned = Planned(part.take("before", one_of("study", "session", "condition"), "study"), part.take("in_a_row", whole(1, 20), 1),
                          part.take("collisions_at_most", whole(0, 1000), 0), part.take("most", whole(1, 50), 5),
                          worlds_of(part.section("worlds", required=True), folder))
        if planned.in_a_row > planned.most:
            raise part.error("in_a_row", f"is more than \"most\", which is {planned.most}; at most that is allowed")
        return planned

    @classmethod
    def registered(cls, plan):
        one = plan.practice
        return [("Design", f"Practice before each {one.before}, until {one.in_a_row} in a row reach the goal with collisions of at most {one.collisions}, "
                           f"or {one.most} were driven.")] if one else []

    @classmethod
    def planned(cls, place):
        before = place.plan.steps["practice"] and place.plan.steps["practice"].before
        due = {"begin": before == "session" or (before == "study" and place.session == 1), "condition": before == "condition"}
        return [cls.at(place, "practice", condition=place.condition if place.order else place.conditions[0])] if due[place.at] else []

    @classmethod
    def guess(cls, plan):
        trial = plan.minutes[Trial.kind]
        return (Trial.guess(plan) if trial is None else trial) * plan.steps["practice"].in_a_row

    def world_for(self, progress, person):
        worlds = progress.plan.steps["practice"].worlds
        return worlds[sum(bool(attempt.trial) and attempt.phase == self.kind for attempt in person.attempts) % len(worlds)]

    def mastered(self, wanted, person):
        """Whether the practice is over: True by its criterion, False where all tries are used up, None while it goes on."""
        tries = [attempt for attempt in person.of(self) if attempt.trial and attempt.excluded_by in ("", "rule")]
        good = [attempt.result == "reached" and attempt.collisions is not None and attempt.collisions <= wanted.collisions for attempt in tries]
        if len(good) >= wanted.in_a_row and all(good[-wanted.in_a_row:]):
            return True
        return False if len(tries) >= wanted.most else None

    def run(self, session, progress, person, lock):
        wanted = progress.plan.steps["practice"]
        went_on = self.mastered(wanted, person) is not None or super().run(session, progress, person, lock)  # after a crash it may be over
        mastered = self.mastered(wanted, session.study.progress().person(person.name))
        if mastered is not None:
            session.done(person.name, self, mastered=mastered)
            session.say(f"navvi: {person.name}: the practice is over; its criterion was {'met' if mastered else 'not met'}.")
        return went_on
