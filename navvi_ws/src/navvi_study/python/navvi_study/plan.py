"""What a study plans, as values."""
import hashlib
import json
import os
from dataclasses import asdict, dataclass, field
from pathlib import Path

from . import checked
from .errors import StudyError
from .measures import number

# What a condition switches, and the parameters of feedback_node that do it. Words for safety are never off.
SWITCHES = {
    "touch": ["feedback/haptics/enabled"],
    "speech": ["feedback/cues/wording/way", "feedback/cues/wording/near"],
    "sounds": ["feedback/sounds/enabled"],
}
WORLD_FILES = (".yaml", ".sdf", ".world")
LARGEST_WORLD = 20 << 20  # bytes, as world_tool reads
# Of kinds of steps, what stands in a plan's values also where it is empty or not given; all others do not, so that plans without keep their hash.
ALWAYS = {"practice", "pause", "calibrate", "consent", "questionnaire", "after_condition", "at_end", "trial", "probe"}
# Given by the study itself to each session.
OWN = {"feedback/locked", "trial/locked", "feedback/sounds/turn/learn", "feedback/sounds/turn/stopping_delay", "feedback/sounds/turn/stopping_spread"}


@dataclass(frozen=True)
class World:
    """What ./navvi run draws from a name, or a file, and a seed."""
    world: str
    seed: int
    zones: str = field(default="", compare=False)  # their file
    jobs: str = field(default="", compare=False)  # the file of the job that is done there

    def __str__(self):
        return f"{self.world} {self.seed}"


def worlds_of(part, folder):
    """`{world: NAME, seeds: [...], zones: FILE, jobs: FILE}`; files are looked for beside the plan."""
    world, zones, jobs = part.take("world", checked.text), part.take("zones", checked.text, ""), part.take("jobs", checked.text, "")
    for key, name in ("world", world if world.endswith(WORLD_FILES) else ""), ("zones", zones), ("jobs", jobs):
        if name and not os.path.isfile(folder / name):
            names = ", and names of ./navvi world list" if key == "world" else ""
            raise part.error(key, f"is \"{name}\", and {folder / name} is not a file; allowed are files beside the plan{names}")
    if jobs:
        places_in(folder / jobs)
    worlds = tuple(World(world, seed, zones, jobs) for seed in part.take("seeds", checked.numbered(checked.whole(0, 2**31 - 1))))
    part.done()
    return worlds


def places_in(file):
    """(x, y, name, what is done there) of each place of a job, m in map. Raises StudyError."""
    places = []
    for part in checked.load(file, "places").items("places"):
        places.append((*(part.take(key, checked.number(-1e4, 1e4)) for key in "xy"), part.take("name", checked.text),
                       part.take("do", checked.one_of("drive", "pick", "drop", "scan"), "drive")))
        part.done()
    return places


@dataclass(frozen=True)
class Condition:
    name: str
    profile: str
    touch: bool
    speech: bool
    sounds: bool
    picture: bool
    parameters: tuple  # of (PART/NAME, value as text)

    def arguments(self):
        """Of ./navvi run."""
        words = {"profile": self.profile, "rviz": shown(self.picture)}
        for switch, names in SWITCHES.items():
            words.update({name: shown(getattr(self, switch)) for name in names})
        words.update(self.parameters)
        return words


@dataclass(frozen=True)
class Group:
    name: str
    participants: tuple
    conditions: tuple


@dataclass(frozen=True)
class Rule:
    """A trial whose column is so does not count."""
    column: str
    reason: str
    one_of: tuple = ()
    above: float = None

    def meets(self, row):
        cell = row.get(self.column, "n/a")
        return cell in self.one_of if self.one_of else number(cell) is not None and number(cell) > self.above


#: Hold in every plan, after its own: such a trial has no figures that could count.
BROKEN_OFF = (Rule("result", "its record is not whole", ("invalid",)), Rule("result", "it broke off", ("aborted", "refused")))


@dataclass(frozen=True)
class Question:
    """A measure compared between two conditions."""
    measure: str
    first: str
    second: str
    trials: str = ""  # "reached": of a measure that is defined for these alone, and the plan says so
    within: float = 0.0  # above 0: the two are equivalent if they differ by less; in the unit of the measure
    effect: float = 0.0  # the difference that the sample is to show, likewise
    sd: float = 0.0  # of the participants' differences, likewise


@dataclass(frozen=True)
class Plan:
    file: str
    study: str
    title: str
    operator: str
    learning: str
    limit: float  # s a trial
    sessions: int
    order: str
    groups: tuple
    conditions: tuple
    sets: tuple  # of tuples of worlds
    reserve: tuple
    steps: dict  # what the kinds of steps need, by key (steps/)
    lsl: bool
    blind: bool  # reports have letters for the conditions until the analysis is frozen
    primary: Question
    secondary: tuple
    exposure: str  # what counts are divided by: a key of measures.EXPOSURES
    exclusions: tuple
    stop_after: int  # participants who have completed; 0: all
    minutes: dict = field(default_factory=dict, compare=False)
    seed: str = field(default="", repr=False, compare=False)  # of an order that is drawn; the study keeps it, apart from the plan

    def condition(self, name):
        return next(condition for condition in self.conditions if condition.name == name)

    def reason_against(self, rows):
        """Why a trial does not count, by the summaries of its legs; empty where it does."""
        return next((rule.reason for rule in (*self.exclusions, *BROKEN_OFF) if any(map(rule.meets, rows))), "")

    def group_of(self, participant):
        for group in self.groups:
            if participant in group.participants:
                return group
        known = ", ".join(name for group in self.groups for name in group.participants)
        raise StudyError(f"{self.file}: \"{participant}\" is not planned; planned are: {known}.")

    @property
    def folder(self):
        """Where all of the study is kept: beside the plan, under its name."""
        return Path(self.file).absolute().parent / self.study

    @property
    def participants(self):
        return [name for group in self.groups for name in group.participants]

    @property
    def worlds(self):
        """All that anybody may drive in."""
        return [world for worlds in (*self.sets, self.reserve, *self.other_worlds.values()) for world in worlds]

    @property
    def other_worlds(self):
        """Of steps that bring their own: by key."""
        return {key: entry.worlds for key, entry in self.steps.items() if hasattr(entry, "worlds")}

    @property
    def asked(self):
        """Questionnaires whose answers are told in the report."""
        return (*self.steps["at_begin"], *(entry.asks for entry in self.steps.values() if hasattr(entry, "asks")), *self.steps["after_condition"], *self.steps["at_end"])

    def world_file(self, world):
        """The file of a world that is no name; None for a name."""
        return Path(self.file).absolute().parent / world.world if world.world.endswith(WORLD_FILES) else None

    def beside(self, world):
        """The files of its zones and of its job, as far as it has them, by argument of ./navvi run."""
        one = next((one for one in self.worlds if (one.world, one.seed) == (world.world, world.seed)), None)
        return {key: str(Path(self.file).absolute().parent / name) for key in ("zones", "jobs") if one and (name := getattr(one, key))}

    def zones(self, world):
        """The word by which a session has them; none without zones."""
        return [f"nav/mesh/zones:={file}" for key, file in self.beside(world).items() if key == "zones"]

    def places(self, world):
        """Those of its job, in their order; none without a job."""
        return [place for key, file in self.beside(world).items() if key == "jobs" for place in places_in(file)]

    def legs(self, world):
        """The words of trials_bench for each leg of a trial, that is one without a job; each begins where the one before ends."""
        words = self.zones(world)
        places = [f"{x:g},{y:g}" for x, y, _, _ in self.places(world)]
        starts = [[]] + [[f"sim/start:={place},0"] for place in places]
        return [[*words, *start, f"sim/goal:={place}"] for start, place in zip(starts, places)] or [words]

    def values(self):
        """All that is planned, as JSON values; what a freeze keeps. Where the files are is no part of it, what is in them is."""
        values = _without_places(json.loads(json.dumps(asdict(self))))
        values.update({key: entry for key, entry in values.pop("steps").items() if entry or key in ALWAYS})
        values["minutes"] = {key: entry for key, entry in values["minutes"].items() if entry is not None or key in ALWAYS}
        del values["seed"]
        for key, usual in ("exposure", "trial"), ("blind", False):
            if values[key] == usual:
                del values[key]
        for question in (values["primary"], *values["secondary"]):
            for key in ("trials", "within", "effect", "sd"):
                if not question[key]:
                    del question[key]
        files = {world.world: self.world_file(world) for world in self.worlds if self.world_file(world)}
        files.update({getattr(world, key): file for world in self.worlds for key, file in self.beside(world).items()})
        return dict(values, world_files={name: hashlib.sha256(checked.read(file, LARGEST_WORLD)).hexdigest() for name, file in files.items()})

    def hash(self):
        return hashlib.sha256(json.dumps(self.values(), sort_keys=True).encode()).hexdigest()


def _without_places(value):
    if isinstance(value, dict):
        return {key: _without_places(below) for key, below in value.items() if key != "file" and (key, below) not in (("scope", ""), ("zones", ""), ("jobs", ""))}
    return [_without_places(below) for below in value] if isinstance(value, list) else value


def shown(value):
    """As an argument of ./navvi run."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, list):
        return "[" + ", ".join(shown(entry) for entry in value) + "]"
    return str(value)
