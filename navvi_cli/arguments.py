"""Words such as seed:=7, checked against the launch file that takes them and against what is allowed."""
import os
import re
from pathlib import Path
from xml.etree import ElementTree

from . import worlds
from .places import LAUNCH, TRIALS
from .say import fail

CHOICES = {
    "operator": ["auto", "pad", "keyboard", "simulated"], "speech": ["auto", "true", "false"], "profile": ["default", "paper"],
    "once": ["true", "false"], "lesson": ["none", "tutorial"], "rviz": ["auto", "true", "false"], "sensing": ["truth", "lidar", "robot"], "lsl": ["true", "false"],
    "vision": ["high_contrast", "yellow_on_black", "large", "color_blind", "paper"], "view": ["chase", "top", "forward"],
}
NUMBER = r"[0-9]+(\.[0-9]+)?", "numbers, 0 or more"
ABOVE = r"(?=.*[1-9])" + NUMBER[0], "numbers above 0"
COORDINATE = r"[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?"
FORMS = {
    "limit": NUMBER, "rate": ABOVE, "radius": ABOVE, "height": ABOVE, "skip": NUMBER, "pace": NUMBER,
    "port": (r"[0-9]{1,5}", "numbers of ports"),
    "robot": (r"[A-Za-z0-9.-]{1,253}(:[0-9]{1,5})?", "hosts, such as 10.8.0.2 or 10.8.0.2:11312"),
    "address": (r"([0-9]{1,3}\.){3}[0-9]{1,3}", "addresses of this machine, such as 10.8.0.2"),
    "seed": (r"[0-9]{1,10}", "whole numbers from 0 to 2147483647"),
    "start": (rf"(|{COORDINATE},{COORDINATE},{COORDINATE})", "values of the form x,y,yaw in m and rad"),
    "goal": (rf"(|{COORDINATE},{COORDINATE})", "values of the form x,y in m"),
    "participant": (r"[A-Za-z0-9_-]{1,32}|n/a", "up to 32 letters, digits, - and _, such as sub-01"),
    "person": (r"[A-Za-z0-9_-]{1,24}", "up to 24 letters, digits, - and _, such as anna"),
    "out": (r"(?!-).*", "paths that do not begin with \"-\", which programs take for an option, such as ./-x"),
}
# Parameters that name a file: nodes run in another folder than the command.
FILES = ("feedback/phrases", "feedback/questions", "feedback/record", "nav/mesh/zones", "perception/prior")
# The part whose parameters a node takes, where its name is another; without _node.
PART_OF = {"relay": "safety"}
# The command itself sets these.
INTERNAL = re.compile(r".*parameters|version|bag|clock|far")


class LaunchFile:
    """What a launch file takes, read from its XML."""

    def __init__(self, name):
        self.path = LAUNCH / name
        root = ElementTree.parse(self.path).getroot()
        args = {arg.get("name"): arg for arg in root.findall("arg")}
        docs = {arg.get("name"): arg.get("doc") for side in [*reversed([*sides(root)]), root] for arg in side.findall("arg") if arg.get("doc")}
        self.arguments = {name: (arg.get("default", ""), " ".join(docs[name].split())) for name, arg in args.items()
                          if name in docs and not INTERNAL.fullmatch(name)}
        self.parts = sorted(name[:-len("_parameters")] for name in args if name.endswith("_parameters"))
        self.fixed = fixed_parameters(root)

    def names(self):
        return [*self.arguments, *(["person"] if "feedback" in self.parts else []),
                *(["robot"] if self.path.name in ("live.launch", "person.launch") else [])]

    def help(self):
        return ["Each argument with its default:",
                *(f"{name}:={default}: {doc}" if default and not default.startswith("$") else f"{name}: {doc}"
                  for name, (default, doc) in self.arguments.items())]


def sides(root):
    """The launch files that one includes, and those that they include."""
    for include in root.iter("include"):
        side = ElementTree.parse(LAUNCH / include.get("file").rpartition("/")[2]).getroot()
        yield side
        yield from sides(side)


def fixed_parameters(root):
    """Parameters such as sim/seed that a launch file, or one that it includes, gives to a node as <param>: these win."""
    roots = [root, *sides(root)]
    found = [(node.get("name")[:-len("_node")], param) for root in roots for node in root.iter("node")
             if node.get("name").endswith("_node") for param in node.findall("param")]
    return {f"{PART_OF.get(name, name)}/{param.get('name')}" for name, param in found}


class Words(dict):
    """The values of words such as seed:=7 by name, and in `parameters` words such as sim/rate:=2, for a node each."""

    def __init__(self, words, known, parts=(), fixed=(), choices=()):
        super().__init__()
        self.parameters, self.choices = [], {**CHOICES, **dict(choices)}
        for word in words:
            name, separator, value = word.partition(":=")
            if not separator:
                fail(f"\"{word}\" is not an argument; arguments look like name:=value.", 2)
            if "$(" in word:  # roslaunch would replace it
                fail(f"\"{word}\" holds \"$(\"; allowed are values without it.", 2)
            if "/" in name and parts:
                self.take_parameter(name, value, known, parts, fixed)
            elif name not in known:
                more = "; parameters are given with their part, such as feedback/language:=es" if "feedback" in parts else ""
                fail(f"\"{name}\" is unknown; known are: {' '.join(sorted(known))}{more}", 2)
            elif name in self:
                fail(f"\"{name}\" is given twice; once is allowed.", 2)
            else:
                self[name] = value
                self.check(name)

    def take_parameter(self, name, value, known, parts, fixed):
        part, last = name.split("/")[0], name.split("/")[-1]
        if part not in parts:
            fail(f"\"{part}\" has no parameters here; those of {' '.join(parts)} can be given.", 2)
        if name in fixed and last in known:
            fail(f"\"{name}\" would have no effect; allowed is {last}:={value}.", 2)
        if name in fixed:
            fail(f"\"{name}\" cannot be given: the session itself sets it; other parameters of {part} are allowed.", 2)
        self.parameters.append(f"{name}:={os.path.abspath(value) if value and name in FILES else value}")

    def check(self, name):
        value = self[name]
        if name in self.choices and value not in self.choices[name]:
            fail(f"{name}:={value} is not allowed; allowed are: {' '.join(self.choices[name])}", 2)
        form, allowed = FORMS.get(name, (".*", ""))
        if not re.fullmatch(form, value, re.S) or name == "seed" and int(value) >= 2**31:
            fail(f"{name}:={value} is not allowed; allowed are {allowed}.", 2)

    def parameters_of(self, part):
        return [word.partition("/")[2] for word in self.parameters if word.startswith(f"{part}/")]


def words_for(launch, words, choices=()):
    """The words that a launch file takes; person:=NAME stands for feedback/person:=NAME."""
    person = [word for word in words if word.startswith("person:=")]
    if person:
        Words(person, ["person"])
    words = [f"feedback/{word}" if word in person else word for word in words]
    return Words(words, launch.names(), launch.parts, launch.fixed, choices)


def parameter(word):
    """The argument type of name:=value, whose names a program knows."""
    if not re.fullmatch(r"[^:=]+:=.*", word, re.S):
        fail(f"unexpected argument \"{word}\"; only parameters are allowed beside the rest, and look like name:=value.", 2)
    return word


def number(name, least, most, kind=int):
    """The argument type of a number in a range, in the words of a sentence that refuses another."""
    def read(word):
        try:
            value = kind(word)
        except ValueError:
            value = None
        if value is None or not least <= value <= most:
            fail(f"{name} is \"{word}\"; allowed are {'whole numbers' if kind is int else 'numbers'} from {least} to {most}.", 2)
        return value
    return read


def trial_in(word, holds="trial.bag"):
    """The path of a trial's folder, also by the folder that holds it alone, as records of a batch are."""
    path = Path(os.path.abspath(word))
    inside = [*path.glob("trial-*")]
    if len(inside) == 1 and not os.path.exists(path / holds):
        path = inside[0]
    if not os.path.isfile(path / holds):
        fail(f"{word} holds no {holds}; the folder of a trial is allowed, such as trials/trial-20260101T120000Z.", 2)
    return path


def trials_that_hold(name):
    return [os.path.relpath(path.parent) for path in TRIALS.glob(f"trial-*/{name}")]


def add_trial(parser, holds="trial.bag"):
    trial = parser.add_argument("trial", metavar="TRIAL", type=lambda word: trial_in(word, holds),
                                help="the folder of a trial, such as trials/trial-20260101T120000Z.")
    trial.completer = lambda **_: trials_that_hold(holds)


def add_words(parser, launch_name, *more, choices=(), shown=True):
    """Takes the words of a launch file; `more`: further lines of help on them, "NAME:=VALUE: meaning"."""
    words = parser.add_argument("words", nargs="*", default=[], metavar="name:=value")
    words.completer = lambda prefix, **_: completions(prefix, LaunchFile(launch_name).names(), choices)
    if shown:
        parser.more_help = lambda: [*LaunchFile(launch_name).help(), *more]


def completions(prefix, names, choices=()):
    name, separator, _ = prefix.partition(":=")
    if not separator:
        return [f"{name}:=" for name in names]
    if name == "world":
        return [f"world:={value}" for value in worlds.names()]
    return [f"{name}:={value}" for value in {**CHOICES, **dict(choices)}.get(name, [])]
