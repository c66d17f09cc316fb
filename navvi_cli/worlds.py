"""What the simulator and navigation make of a world: they know each other's work by the OctoMap alone."""
import csv
import json
import os
import re
import subprocess
import sys
import tempfile
import threading
from pathlib import Path

from .places import config_of, program, share
from .say import Failure, aside, fail


def answer(path, *words):
    """Runs a program that prints JSON: how it ended, and what it printed (None if nothing)."""
    hint = threading.Timer(3.0, aside, ["still at work; a large world takes minutes."])
    hint.start()
    try:
        done = subprocess.run([str(path), *map(str, words)], text=True, errors="replace", stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    finally:
        hint.cancel()
    if done.returncode < 0:
        fail(f"{path.name} broke off by signal {-done.returncode}; such an error is worth a report.", 1)
    return done, json.loads(done.stdout) if done.stdout else None


def names():
    """Worlds that have a name, with their meaning; for completion, hence without an error where nothing is built."""
    tool = program("navvi_sim", "world_tool")
    return answer(tool, "list")[1] if tool.exists() else {}


def check_name(world):
    """Refuses a word that is neither a name nor a file, also where nothing is built."""
    presets = (share("navvi_sim") / "config" / "presets.yaml").read_text()
    known = re.findall(r"^- name: (\w+)", presets, re.M)
    if world not in known and not os.path.isfile(world):
        wrong = f"\"{world}\" is a folder" if os.path.isdir(world) else f"no world and no file has the name \"{world}\""
        fail(f"{wrong}; allowed are: {' '.join(known)}, or a .yaml, .sdf or .world file.", 2)


def check_world(words):
    """Refuses the arguments of a world that are neither here nor drawn. Nodes run elsewhere: paths become absolute."""
    check_name(words["world"])
    for name in ("world", "classes"):
        if name in words and os.path.isfile(words[name]):
            words[name] = Path(words[name]).resolve()
    folders = [folder for folder in words.get("models", "").split(":") if folder]
    for folder in folders:
        if not os.path.isdir(folder):
            fail(f"models:={folder} is not a folder; folders that exist are allowed, separated by colons.", 2)
    if folders:
        words["models"] = ":".join(str(Path(folder).resolve()) for folder in folders)


def picture(word):
    """The argument type of a picture's file."""
    if Path(word).suffix not in (".svg", ".png"):
        fail(f"\"{word}\" is not a picture; .svg and .png are allowed.", 2)
    return Path(word)


def table(header, rows):
    """Prints rows as CSV, lists with commas between numbers and blanks between points."""
    writer = csv.writer(sys.stdout, lineterminator="\n")
    writer.writerow(header)
    for name, value in rows:
        nested = isinstance(value, list) and value and isinstance(value[0], list)
        writer.writerow([name, points(value) if nested else numbers(value) if isinstance(value, list) else value])


def numbers(values):
    return ",".join(map(str, values))


def points(path):
    """Such as "1.5,2 3,-4", m."""
    return " ".join(map(numbers, path))


class Verdict:
    """A world as the simulator describes it, `world`, and the way from start to goal, `way`; where there is none, or none to one of the
    `places` of a job, (x, y) in m, `refusal` tells why."""

    def __init__(self, name, words=(), nav_words=(), profile="default", octomap=None, drawing=False, places=()):
        with tempfile.TemporaryDirectory() as folder:
            octomap = octomap or Path(folder) / "world.bt"
            drawn = ["drawing:=true"] if drawing else []
            checked, self.world = answer(program("navvi_sim", "world_tool"), "check", name, *words, f"save:={octomap}", *drawn)
            sys.stderr.write(checked.stderr)
            if checked.returncode:
                raise Failure(None, 2)
            start, goal = self.world["start x m, y m, yaw rad"][:2], self.world["goal x m, y m"]
            level = {"mesh/climb": 0, "mesh/floor_height": self.world["floor z m"]}
            given = [word.partition(":=")[0] for word in nav_words]
            planned, self.way = answer(program("navvi_nav", "navmesh_tool"), octomap, f"config:={config_of('navvi_nav', profile)}",
                                       *(f"{name}:={value}" for name, value in level.items() if name not in given), *nav_words,
                                       f"from:={start}", f"to:={[*goal, *sum(places, ())]}")
        self.refusal = ""
        if planned.returncode:
            why = (self.way or {}).get("refusal") or planned.stderr.strip()
            self.refusal = f"no session from {numbers(start)} to {numbers((self.way or {}).get('refused m', goal))}: {why}"

    def caption(self):
        world = self.world
        return f"seed {world['seed']}, world {world['world hash']}" + (f"; {world['scenario']}" if world["scenario"] else "")

    def sentences(self):
        """What is in the world, for a person."""
        world = self.world
        ends = [",".join(f"{value:.3f}" for value in world[end]) for end in ("start x m, y m, yaw rad", "goal x m, y m")]
        return [*world["notes"], *(f"{number} {what}" for what, number in world["counts"].items()), f"{world['world']}, {self.caption()}",
                f"floor at z = {world['floor z m']:.3f} m", f"start {ends[0]} goal {ends[1]}"]

    def require(self):
        if self.refusal:
            fail(self.refusal, 2)
        return self
