"""What the simulator and navigation make of a world: they know each other's work by the OctoMap alone."""
import csv
import json
import re
import subprocess
import sys
import tempfile
import threading
from pathlib import Path

from .places import config_of, program, share
from .say import Failure, aside, fail


def answer(path, *words):
    """Runs a program with --json: how it ended with what it told people, and what it told programs (None if nothing)."""
    hint = threading.Timer(3.0, aside, ["still at work; a large world takes minutes."])
    hint.start()
    with tempfile.NamedTemporaryFile(suffix=".json") as file:
        try:
            done = subprocess.run([str(path), *map(str, words), "--json", file.name], text=True, errors="replace", stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        finally:
            hint.cancel()
        text = file.read()
    return done, json.loads(text.decode(errors="replace")) if text else None


def names():
    """Worlds that have a name, with their meaning; for completion, hence without an error where nothing is built."""
    tool = program("navvi_sim", "world_tool")
    return answer(tool, "list")[1] if tool.exists() else {}


def check_name(world):
    """Refuses a word that is neither a name nor a file, also where nothing is built."""
    presets = (share("navvi_sim") / "config" / "presets.yaml").read_text()
    known = re.findall(r"^- name: (\w+)", presets, re.M)
    if world not in known and not Path(world).is_file():
        fail(f"no world and no file has the name \"{world}\"; allowed are: {' '.join(known)}, or a .yaml, .sdf or .world file.", 2)


def table(header, rows):
    """Prints rows as CSV, lists with commas between numbers and blanks between points."""
    writer = csv.writer(sys.stdout, lineterminator="\n")
    writer.writerow(header)
    for name, value in rows:
        nested = isinstance(value, list) and value and isinstance(value[0], list)
        writer.writerow([name, points(value) if nested else ",".join(map(str, value)) if isinstance(value, list) else value])


def points(path):
    """Such as "1.5,2 3,-4", m."""
    return " ".join(",".join(map(str, point)) for point in path)


class Verdict:
    """A world as the simulator describes it (`sentences` for people, `world` for programs) and the way from start to goal, `way`;
    where there is none, `refusal` tells why."""

    def __init__(self, name, words=(), nav_words=(), profile="default", octomap=None):
        with tempfile.TemporaryDirectory() as folder:
            octomap = octomap or Path(folder) / "world.bt"
            checked, self.world = answer(program("navvi_sim", "world_tool"), "check", name, *words, "-o", octomap)
            sys.stderr.write(checked.stderr)
            if checked.returncode:
                raise Failure(None, 2)
            self.sentences = checked.stdout
            self.start, self.goal = (",".join(map(str, self.world[end][:2])) for end in ("start x m, y m, yaw rad", "goal x m, y m"))
            level = {"mesh/climb": 0, "mesh/floor_height": self.world["floor z m"]}
            given = [word.partition(":=")[0] for word in nav_words]
            planned, self.way = answer(program("navvi_nav", "navmesh_tool"), octomap, "--config", config_of("navvi_nav", profile),
                                       *(f"{name}:={value}" for name, value in level.items() if name not in given), *nav_words,
                                       "--from", self.start, "--to", self.goal)
        self.refusal = ""
        if planned.returncode:
            why = (self.way or {}).get("refusal") or planned.stderr.strip()
            self.refusal = f"no session from {self.start} to {self.goal}: {why}"

    def require(self):
        if self.refusal:
            fail(self.refusal, 2)
        return self
