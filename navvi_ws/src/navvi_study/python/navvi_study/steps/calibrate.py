"""The calibration of touch and hearing, once."""
from ..checked import flag
from ..journal import rows_of
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
        home = session.study.home(person.name)  # of the logs, too: they hold what is said to the person
        record = home / "calibrate.csv"
        record.unlink(missing_ok=True)
        code = session.runner.command(["calibrate", f"person:={person.name}", f"out:={home}", f"feedback/record:={record}"], person.name, lock)
        saved = {row.get("measured"): row.get("value") for row in rows_of(record)}.get("saved")
        if code or code == 0 and not saved:
            session.say(f"navvi: {person.name}: the {self} broke off; the next \"study next\" comes to it again.")
            return False
        if saved == "no":
            session.say(f"navvi: {person.name}: the {self} was ended by the person, and nothing is saved.")
        return session.done(person.name, self, saved=saved)
