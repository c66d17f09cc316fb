"""Consent, in the begin of each session: nobody who does not give it goes on."""
from .. import questionnaire
from ..checked import text
from .questions import Questions


class Consent(Questions):
    kind = "consent"
    words = "consent"
    usual = 5.0

    @classmethod
    def read(cls, root, folder):
        name = root.take("consent", text, None)
        return {"consent": name and questionnaire.find(name, folder)}

    @classmethod
    def planned(cls, place):
        asks = place.plan.steps["consent"]
        return [cls.at(place, "consent", asks=asks)] if asks else []

    def run(self, session, progress, person, lock):
        answers = self.ask(session, person.name, lock)
        if answers is None:
            return False
        given = all(answers[item.name] == item.required for item in self.asks.items if item.required)
        asked = session.runner.asks
        session.done(person.name, self, given=given, asked=asked)
        session.say(f"navvi: {person.name}: consent is {'given' if given else 'not given'}" + (", by an answer that was drawn: nobody was asked." if asked == "nobody" else "."))
        return given
