"""The end of a session, with nothing to do."""
from .step import Step


class SessionEnd(Step):
    kind = "session_end"
    words = "the end of session {0.session}"
    timed = False

    @classmethod
    def planned(cls, place):
        return [cls.at(place, "end")]
