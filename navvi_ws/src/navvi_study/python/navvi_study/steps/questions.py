"""Questionnaires, and the base of all that is asked."""
from .. import questionnaire
from ..checked import list_of, text
from ..design import drawn
from .step import Step


class Questions(Step):
    kind = "questionnaire"
    words = "the questionnaire {0.asks.name}"
    usual = 3.0

    @classmethod
    def read(cls, root, folder):
        part = root.section("questionnaires")
        planned = {key: tuple(questionnaire.find(name, folder) for name in part.take(key, list_of(text), [])) for key in ("at_begin", "after_condition", "at_end")}
        part.done()
        return planned

    @classmethod
    def planned(cls, place):
        key, session = {"begin": ("at_begin", 1), "condition": ("after_condition", place.session), "end": ("at_end", place.plan.sessions)}[place.at]
        return [cls.at(place, asks.name, asks=asks) for asks in place.plan.steps[key] if place.session == session]

    def run(self, session, progress, person, lock):
        if self.asks.scope and not session.study.agreed(person.name, self.asks.scope):
            session.say(f"navvi: {person.name}: {self} is left out; the consent has no yes to \"{self.asks.scope}\".")
            return session.done(person.name, self, asked=False)
        return self.ask(session, person.name, lock) is not None and session.done(person.name, self)

    def ask(self, session, name, lock):
        """What is left of the items. Returns all answers; None where the person broke it off."""
        study = session.study
        about, known = self.asks_of(study.progress().person(name)), study.answers_of(name, self)
        if left := [item for item in self.asks.items if item.name not in known]:
            session.runner.ask(name, self, left, lambda *given: study.add_answer(name, self, about, *given), lock)
            known = study.answers_of(name, self)
        if all(item.name in known for item in self.asks.items):
            return known
        session.say(f"navvi: {name}: {self} was broken off; the next \"study next\" goes on with it.")
        return None

    def simulate(self, participant, items, answered):
        """Answers that are drawn, whatever was driven: they fill the tables, and mean nothing."""
        for item in items:
            source = drawn(participant, self.name, item.name)
            answered(item, item.required or (questionnaire.DECLINED if source.random() < 0.02 else source.choice(item.values())))
