"""The kinds of steps in the order in which they are planned: a class each, in a file of its own."""
from .consent import Consent
from .pause import Pause
from .calibrate import Calibrate
from .practice import Practice
from .probe import Probe
from .questions import Questions
from .session_end import SessionEnd
from .trial import Trial

ORDER = {
    "begin": (Consent, Questions, Calibrate, Practice),  # of a session
    "condition": (Practice, Trial, Probe, Questions, Pause),
    "end": (Questions, SessionEnd),  # of a session
}
KINDS = tuple(dict.fromkeys(kind for kinds in ORDER.values() for kind in kinds))
