"""How far the study is: a pure function of plan and journal."""
import itertools
from dataclasses import dataclass, field

from .errors import StudyError
from .schedule import steps_of


@dataclass
class Attempt:
    """One start of ./navvi run for a step."""
    step: str
    number: int  # from 1
    world: str
    seed: int
    phase: str = "n/a"  # kind of its step, as it was planned then, like the next four; n/a in journals of before where the plan has no such step
    condition: str = "n/a"
    order: int = 0
    session: int = 0
    repeat: int = 0
    seq: int = 0  # of the journal's row with which it began
    ended: bool = False
    trial: str = ""  # its folder's name; empty where no trial began
    result: str = ""  # empty until it has ended
    collisions: float = None
    replaces: str = ""  # the trial that did not count
    excluded: str = ""  # why
    excluded_by: str = ""
    final: bool = False  # excluded, and no other attempt takes its place
    dropped_out: bool = False  # the person or the experimenter ended it
    legs: dict = field(default_factory=dict)  # by trial, more than one of a job: SHA-256 of its files when it ended, by name; none in journals of before
    job: bool = False  # its world had one when it ended

    @property
    def counts(self):
        return self.ended and bool(self.trial) and not self.excluded


@dataclass
class Participant:
    """What one participant has done."""
    name: str
    steps: list
    attempts: list = field(default_factory=list)
    done: dict = field(default_factory=dict)  # row of the journal by step
    excluded: str = ""
    withdrawn: str = ""  # keep or delete
    erased: bool = False

    def step(self, name):
        """None where the plan has none of that name."""
        return next((step for step in self.steps if step.name == name), None)

    def of(self, step):
        return [attempt for attempt in self.attempts if attempt.step == step.name]

    @property
    def open(self):
        """The attempt that has not ended."""
        return next((attempt for attempt in self.attempts if not attempt.ended), None)

    @property
    def begun(self):
        return bool(self.attempts or self.done)

    @property
    def refused(self):
        """Consent was not given in the last session that asked for it."""
        asked = [row for step in self.steps if step.kind == "consent" and (row := self.done.get(step.name))]
        return bool(asked) and asked[-1].get("given") is False


def lettered(letters, condition):
    """The condition's letter where there are any; n/a of one that the plan has no more."""
    return letters.get(condition, "n/a") if letters else condition


class Progress:
    def __init__(self, plan, rows, letters=None):
        """\\param letters  in place of the names that conditions have in the rows, where the plan is blinded"""
        self.plan, self.letters = plan, letters
        self.people = {name: Participant(name, steps_of(plan, name)) for name in plan.participants}
        if gone := sorted({row["participant"] for row in rows if row.get("participant", "") not in {"", *self.people}}):
            raise StudyError(f"{plan.file}: {gone[0]} has begun, and the plan has no such participant any more; put the code back where it was.")
        self.freezes, self.analyses, self.losses = ([row for row in rows if row["type"] == kind] for kind in ("freeze", "analysis", "loss"))
        for row in rows:
            if row["type"] not in ("freeze", "analysis", "loss"):
                getattr(self, "_" + row["type"])(row)

    @property
    def kept(self):
        """Those who have not withdrawn their data."""
        return [person for person in self.people.values() if person.withdrawn != "delete"]

    def person(self, name):
        self.plan.group_of(name)  # a sentence where the plan lacks it
        return self.people[name]

    def next(self, person):
        """The step that comes next; None where nothing is left, or nothing may be done."""
        if person.withdrawn or person.excluded or person.refused:
            return None
        return next((step for step in person.steps if not step.finished(self, person)), None)

    def complete(self, person):
        return not person.withdrawn and not person.excluded and all(step.finished(self, person) for step in person.steps)

    @property
    def over(self):
        """Whether nobody is left who could do anything."""
        people = self.people.values()
        stopped = self.plan.stop_after and sum(map(self.complete, people)) >= self.plan.stop_after
        return not any(self.next(person) for person in people if person.begun or not stopped)

    def missing(self, person):
        """Trials that no world is left for, or that nothing shall replace."""
        return [step for step in person.steps
                if step.counts and step.finished(self, person) and not any(attempt.counts or attempt.dropped_out for attempt in person.of(step))]

    def find(self, trial):
        """Person and attempt of a trial, by its folder's name, or PARTICIPANT/NAME."""
        owner, _, name = trial.rstrip("/").rpartition("/")
        owner = owner.rpartition("/")[2]
        found = [(person, attempt) for person in self.people.values() for attempt in person.attempts
                 for leg in attempt.legs if leg.rpartition("/")[2] == name and owner in ("", person.name, leg.rpartition("/")[0])]
        if len(found) != 1:
            raise StudyError(f"\"{trial}\" names {len(found)} trials of this study; allowed is a trial's name from \"study status\", such as sub-01/trial-20260101T120000Z.")
        return found[0]

    def moved(self):
        """A sentence for each trial that was driven in another condition than the plan has for it now, or is planned once more."""
        for person in self.kept:
            driven = [one for one in person.attempts if one.phase != "n/a" and (one.trial or not one.ended)]
            for attempt, step in itertools.product(driven if not person.excluded else (), person.steps):
                same = (step.kind, step.condition, step.repeat) == (attempt.phase, attempt.condition, attempt.repeat)
                if same != (step.name == attempt.step):
                    yield f"{person.name} has driven {attempt.step} in {attempt.condition}, and the plan has {step.name} in {step.condition}"

    def _attempt(self, row):
        return next(attempt for attempt in self.people[row["participant"]].attempts
                    if (attempt.step, attempt.number) == (row["step"], row["attempt"]))

    def _begin(self, row):
        person = self.people[row["participant"]]
        place = step.place if (step := person.step(row["step"])) else {}
        if "phase" in row:  # not in journals of before
            place = {**{name: row[name] for name in ("phase", "order", "session", "repeat")}, "condition": lettered(self.letters, row["condition"])}
        person.attempts.append(Attempt(row["step"], row["attempt"], row["world"], row["seed"], seq=row["seq"], replaces=row["replaces"], **place))

    def _end(self, row):
        attempt = self._attempt(row)
        attempt.ended, attempt.trial, attempt.result, attempt.collisions = True, row["trial"], row["result"], row["collisions"]
        attempt.job, attempt.legs = "legs" in row, row.get("legs", {row["trial"]: row.get("sums", {})} if row["trial"] else {})
        if "excluded" in row:  # by a rule, which in journals of before wrote a row of its own
            attempt.excluded, attempt.excluded_by, attempt.final, attempt.dropped_out = row["excluded"], "rule", row["drop_out"], row["drop_out"]

    def _done(self, row):
        self.people[row["participant"]].done[row["step"]] = row

    def _exclude(self, row):
        person = self.people[row["participant"]]
        if "step" not in row:
            person.excluded = row["reason"]
            return
        attempt = self._attempt(row)
        attempt.excluded, attempt.excluded_by, attempt.final = row["reason"], row["rule"] and "rule" or row["by"], not row["replace"]
        attempt.dropped_out = row.get("drop_out", False)

    def _withdraw(self, row):
        self.people[row["participant"]].withdrawn = row["data"]

    def _erased(self, row):
        self.people[row["participant"]].erased = True
