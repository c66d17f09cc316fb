"""The kinds of steps in the order in which they are planned: a class each, in a file of its own."""
from .consent import Consent
from .pause import Pause
from .calibrate import Calibrate
from .practice import Practice
from .probe import Probe
from .questions import Questions
from .session_end import SessionEnd
from .trial import Driven, Trial

ORDER = {
    "begin": (Consent, Questions, Calibrate, Practice),  # of a session
    "condition": (Practice, Trial, Probe, Questions, Pause),
    "end": (Questions, SessionEnd),  # of a session
}
KINDS = tuple(dict.fromkeys(kind for kinds in ORDER.values() for kind in kinds))


def kind_of(attempt):
    """The class of the step that it was for, also where the plan has no such step any more."""
    return next((kind for kind in KINDS if kind.kind == attempt.phase), Driven)
