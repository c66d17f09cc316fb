"""What a kind of step is made of."""
from dataclasses import dataclass


@dataclass(frozen=True)
class Place:
    """Where steps are planned in the course of a participant."""
    plan: object
    participant: str
    session: int
    conditions: tuple  # of the session: names in their order
    at: str  # begin, condition or end
    condition: str = "n/a"
    worlds: tuple = ()  # of the condition
    order: int = 0  # of the condition, from 1; 0 where there is none


@dataclass(frozen=True)
class Step:
    """Each kind is a subclass; what it leaves out is as here."""
    name: str  # unique for the participant: s1-c2-trial-1
    session: int
    condition: str = "n/a"
    order: int = 0  # place of the condition, from 1; 0 where there is none
    repeat: int = 0  # of the trial in the condition, from 1
    world: object = None  # a World, of a trial
    asks: object = None  # a Questionnaire
    minutes: float = 0.0
    limit: float = None  # s, after which a probe stops its trial; that of the plan where there is none

    words = ""  # for the experimenter, with the step as {0}
    kind = ""  # in the journal, in the plan's minutes, and in the column `phase` of its trial
    timed = True  # the plan may say its minutes
    usual = None  # minutes
    drives = counts = False  # trials; whether these are what is analysed
    besides = ""  # words for its trials, where they are not
    key = ""  # of its section in the plan's file
    columns = {}  # of answers.csv, that truth() adds: meaning and unit

    @classmethod
    def read(cls, root, folder):
        """What the plan's file has for it: by key of the plan's values, empty where it has nothing. Raises StudyError."""
        if not cls.key:
            return {}
        part = root.section(cls.key)
        planned = cls.entry(part, folder) if part.values else None
        part.done()
        return {cls.key: planned}

    @classmethod
    def entry(cls, part, folder):
        """Its section as a value, with `worlds` where it has worlds, `asks` where it has a questionnaire."""

    @classmethod
    def check(cls, root, plan):
        """Raises StudyError for what is wrong between it and other parts of the plan."""

    @classmethod
    def registered(cls, plan):
        """Sections and sentences of the pre-registration. \\param plan  that was frozen, its values as attributes"""
        return []

    @classmethod
    def planned(cls, place):
        """The steps of this kind there."""
        return []

    @classmethod
    def at(cls, place, name, **more):
        """A step at the place."""
        given = place.plan.minutes.get(cls.kind)
        return cls(f"s{place.session}-" + (f"c{place.order}-" if place.order else "") + name, place.session,
                   **{"condition": place.condition, "order": place.order, "minutes": cls.guess(place.plan) if given is None else given, **more})

    @classmethod
    def guess(cls, plan):
        """Minutes where the plan says nothing."""
        return cls.usual or 0.0

    @property
    def place(self):
        """In the course of the participant; an attempt keeps it, as the plan may change."""
        return {"phase": self.kind, "condition": self.condition, "order": self.order, "session": self.session, "repeat": self.repeat}

    def __str__(self):
        return self.words.format(self)

    def finished(self, progress, person):
        return self.name in person.done

    def run(self, session, progress, person, lock):
        """Does it. Returns False where the participant cannot go on."""
        return session.done(person.name, self)

    def asks_of(self, person):
        """The attempt whose trial its questions are about; None of questions about no trial, or while it has none that counts."""

    def holds(self, person, row):
        """Whether an answer stands: one about a trial as long as that counts. Those of before name no attempt."""
        return "attempt" not in row or (about := self.asks_of(person)) is not None and about.number == row["attempt"]

    def truth(self, study, person, row):
        """Columns of an answer to it, besides those of all. \\param row  of the participant's answers"""
        return {}
