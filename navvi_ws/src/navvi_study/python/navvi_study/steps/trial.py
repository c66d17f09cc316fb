"""Trials: what a study is about, and the base of all that is driven."""
from .step import Step


class Driven(Step):
    """A step of trials by ./navvi run."""
    drives = True
    drop_out = True  # who ends it before goal and limit is a drop-out

    def world_for(self, progress, person):
        """What the next attempt drives in: the planned world, unless it was met and the trial does not count; then one of the reserve."""
        met = {(attempt.world, attempt.seed) for attempt in person.attempts if attempt.trial}
        return next((world for world in (self.world, *progress.plan.reserve) if (world.world, world.seed) not in met), None)

    def given_up(self, progress, person):
        """Whether its trial does not count, and nothing shall replace it or no world is left for it."""
        attempts = person.of(self)
        return bool(attempts) and (attempts[-1].final or self.world_for(progress, person) is None)

    def run(self, session, progress, person, lock):
        study, before, world = session.study, person.of(self), self.world_for(progress, person)
        replaces = next((attempt.trial for attempt in reversed(before) if attempt.trial), "")
        number = len(before) + 1
        study.journal.append("begin", participant=person.name, step=self.name, attempt=number, world=world.world, seed=world.seed, replaces=replaces,
                             **self.place)
        attempt, folder = study.progress().person(person.name).open, study.attempt_folder(person.name, self.name, number)
        if folder.exists():  # it was driven, and the journal has lost its rows
            session.runner.close(folder)
        else:
            session.runner.trial(person.name, self, attempt, folder, lock)
        return session.end(person.name, attempt)


class Trial(Driven):
    kind = "trial"
    words = "trial {0.repeat} in {0.condition}"
    counts = True

    @classmethod
    def planned(cls, place):
        return [cls.at(place, f"trial-{repeat}", repeat=repeat, world=world) for repeat, world in enumerate(place.worlds, 1)]

    @classmethod
    def guess(cls, plan):
        return plan.limit / 120

    def finished(self, progress, person):
        return any(attempt.counts for attempt in person.of(self)) or self.given_up(progress, person)
