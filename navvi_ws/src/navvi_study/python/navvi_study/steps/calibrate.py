"""The calibration of touch and hearing, once."""
from ..checked import flag
from .step import Step


class Calibrate(Step):
    kind = "calibrate"
    words = "calibration"
    usual = 6.0

    @classmethod
    def read(cls, root, folder):
        return {"calibrate": root.take("calibrate", flag, False)}

    @classmethod
    def planned(cls, place):
        return [cls.at(place, "calibrate")] if place.plan.steps["calibrate"] and place.session == 1 else []

    def run(self, session, progress, person, lock):
        if session.runner.command(["calibrate", f"person:={person.name}"], person.name, lock):
            return super().run(session, progress, person, lock)
        session.say(f"navvi: {person.name}: the {self} broke off; the next \"study next\" comes to it again.")
        return False
