"""Questionnaires as YAML files: items, answers and scores."""
import os
import re
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

import yaml

from . import checked
from .checked import code, list_of, number, one_of, text
from .errors import StudyError
from .journal import rows_of

SHIPPED = Path(__file__).resolve().parents[2] / "studies" / "questionnaires"  # in the sources, or installed
LONGEST = 80  # bytes of a sentence that the voice speaks
DECLINED = "declined"  # rather not say
PRORATED = 5  # items, from which on a mean may leave one out


@dataclass(frozen=True)
class Item:
    name: str
    ask: str
    low: float = 0.0  # of a scale, whose ends are called `least` and `most`
    high: float = 0.0
    step: float = 1.0
    least: str = ""
    most: str = ""
    choices: tuple = ()  # instead of a scale
    required: str = ""  # the choice without which nothing goes on
    point: str = ""  # instead of a scale: the person points with the stick at the goal, or the start
    beside: str = ""  # of choices: the right one is what stood on the left, or the right
    classes: tuple = ()  # of things, in the order of the choices

    @property
    def probes(self):
        """Whether the answer is true or false of a trial that stopped."""
        return bool(self.point or self.beside)

    def values(self):
        """All answers that can be given, as they stand in the table."""
        if self.point:  # degrees, counter-clockwise from straight ahead
            return [str(degrees) for degrees in range(-179, 181)]
        if self.choices:
            return list(self.choices)
        return [f"{self.low + at * self.step:g}" for at in range(round((self.high - self.low) / self.step) + 1)]


@dataclass(frozen=True)
class Questionnaire:
    name: str
    file: str
    title: str
    intro: str
    items: tuple
    score: str  # none, mean, sus or pointing
    same_as: str = ""  # the questionnaire that it is in another language
    scope: str = ""  # the item of the consent without whose "yes" it is not asked

    @property
    def measured(self):
        """Under which name its score is compared."""
        return self.same_as or self.name

    def prorated(self, answers):
        """Whether the score is the mean of all items but one, which was declined; of at least PRORATED items."""
        return self.score == "mean" and len(self.items) >= PRORATED and list(answers.values()).count(DECLINED) == 1

    def scored(self, answers, errors):
        """\\param answers  by item's name, as text. None where one is missing or declined; a mean leaves one declined item out (prorated).
        \\param errors  of pointing, by item's name, as text"""
        if self.score == "pointing":
            known = [abs(float(error)) for error in errors.values() if error not in ("", "n/a")]
            return sum(known) / len(known) if known else None
        try:
            numbers = [float(answers[item.name]) for item in self.items if not (self.prorated(answers) and answers[item.name] == DECLINED)]
        except (KeyError, ValueError):
            return None
        if self.score == "mean":
            return sum(numbers) / len(numbers)
        if self.score == "sus":  # Brooke 1996: odd items count upwards, even ones downwards
            return 2.5 * sum(value - 1 if at % 2 == 0 else 5 - value for at, value in enumerate(numbers))
        return None


def find(name, folder):
    """The file of that name beside the plan, or the one that ships. Raises StudyError."""
    for place in [folder / name, folder / f"{name}.yaml", SHIPPED / f"{name}.yaml"]:
        if os.path.isfile(place):  # no error of a name that is too long
            return load(place)
    shipped = sorted(path.stem for path in SHIPPED.glob("*.yaml"))
    raise StudyError(f"the questionnaire \"{name}\" is not found; allowed are files in {folder}, and: {', '.join(shipped)}.")


def load(path):
    root = checked.load(path)
    items = tuple(_item(part) for part in root.items("items"))
    one = Questionnaire(Path(path).stem, str(path), root.take("title", text), root.take("intro", text, ""), items,
                        root.take("score", one_of("none", "mean", "sus", "pointing"), "none"), root.take("same_as", code, ""), root.take("scope", code, ""))
    root.done()
    names = [item.name for item in items]
    if len(set(names)) < len(names):
        raise root.error("items", "has two items of one name; allowed is a name of its own for each")
    if one.score == "pointing" and not any(item.point for item in items):
        raise root.error("score", "is pointing, and no item is answered by pointing; allowed is an item with the key point")
    if one.score == "sus" and [(item.low, item.high, item.step) for item in items] != [(1, 5, 1)] * 10:
        raise root.error("score", "is sus, which is made of ten items from 1 to 5")
    for words in [one.title, one.intro, *[words for item in items for words in (item.ask, item.least, item.most, *item.choices)]]:
        for sentence in words.split(". "):
            if len(sentence.encode()) > LONGEST:
                raise StudyError(f"{path}: \"{sentence}\" is too long to be spoken; allowed are {LONGEST} bytes a sentence.")
    return one


def _choice(value):
    """As it stands in tables and is spoken."""
    if not isinstance(value, str) or not re.fullmatch(r"[A-Za-z0-9_.-]{1,24}( [A-Za-z0-9_.-]{1,24}){0,9}", value):
        raise ValueError("words of letters, digits, . - and _; yes and no in quotes")
    return value


def _item(part):
    name, ask = part.take("name", code), part.take("ask", text)
    choices = tuple(part.take("choices", list_of(_choice), []))
    required = part.take("required", text, "")
    point, beside = part.take("point", one_of("goal", "start"), ""), part.take("beside", one_of("left", "right"), "")
    classes = tuple(part.take("classes", list_of(code), list(choices)))
    scale = part.section("scale")
    if bool(choices) + bool(scale.values) + bool(point) != 1:
        raise StudyError(f"{part.file}: \"{part.path}\" needs one of the keys \"scale\", \"choices\" and \"point\".")
    if beside and len(classes) != len(choices):
        raise StudyError(f"{part.file}: \"{part.path}\" needs as many \"classes\" as \"choices\"; it has {len(classes)} and {len(choices)}.")
    if required and required not in choices:
        raise part.error("required", f"is \"{required}\"; allowed is one of the choices")
    if point:
        item = Item(name, ask, point=point)
    elif choices:
        item = Item(name, ask, choices=choices, required=required, beside=beside, classes=classes if beside else ())
    else:
        item = Item(name, ask, scale.take("from", number(-1000, 1000)), scale.take("to", number(-1000, 1000)),
                    scale.take("step", number(0.01, 1000), 1.0), scale.take("least", text), scale.take("most", text))
        scale.done()
        steps = (item.high - item.low) / item.step
        if steps < 1 or abs(steps - round(steps)) > 1e-6:
            raise scale.error("to", f"is {item.high:g}; allowed is \"from\" and a whole number of steps more")
    part.done()
    return item


def script(items, title, intro):
    """The file that the lesson asks from (lessons/questionnaire.hpp): each value, and how it is said."""
    def said(item, at, value):
        end = {0: item.least, len(item.values()) - 1: item.most}.get(at, "")
        return f"{value}, {end}" if end else value
    asks = [{"name": item.name, "ask": item.ask, **({"point": True} if item.point else {
        "values": item.values(), "spoken": [said(item, at, value) for at, value in enumerate(item.values())]})} for item in items]
    asks[0]["ask"] = ". ".join(words for words in (title, intro, asks[0]["ask"]) if words)
    return yaml.safe_dump({"items": asks}, allow_unicode=True, sort_keys=False, width=1000)


def require_speakable(one, feedback_node):
    """Raises StudyError for what the voice refuses. \\param feedback_node  the program that asks"""
    with tempfile.NamedTemporaryFile("w", encoding="utf-8") as file:
        file.write(script(one.items, one.title, one.intro))
        file.flush()
        command = [str(feedback_node), "--parameters", f"questions:={file.name}"]
        asked = subprocess.run(command, capture_output=True, text=True, errors="replace", check=False)
    if asked.returncode != 0:
        raise StudyError(f"{one.file}: {asked.stderr.strip().removeprefix(f'{file.name}: ')}")


def read_answers(path):
    """The table that the lesson writes, or this program: item, answer, seconds. Empty where it is not there."""
    return [row for row in rows_of(path) if row.get("answer")]
