"""Whatever file a user hands in: a pipe, a device, a folder, too large, too deep, garbage or another's text ends in one sentence with exit code 2."""
import os
import re
import resource
import time
from pathlib import Path

import pytest

import small_study
from sessions import ROOT, sourced, within

LIB = ROOT / "navvi_ws/devel/lib"
MEMORY = 1 << 30  # bytes; the programs alone take 100 to 300 MB of it
SECONDS = 30
SECRET = "the sixth line that nobody may cite"
PLAN = small_study.PLAN.replace("{world: easy, seeds: [1]}", "{world: WORLD, seeds: [1]}").replace("limit: 60", "limit: 60\nconsent: CONSENT")


def program(package, name, *words):
    return lambda file: ([LIB / package / name, *words, file], {})


def plan(file):
    return [ROOT / "navvi", "study", "check", file, "--no-worlds"], {}


def planned(word):
    """The file is named by a plan beside it."""
    def command(file):
        path = file.parent / "plan.yaml"
        path.write_text(PLAN.replace(word, file.name).replace("consent: CONSENT\n", "").replace("WORLD", "easy"))
        return [ROOT / "navvi", "study", "freeze", path], {}
    return command


def mesh(file):
    world = file.parent / "w.sdf"
    world.write_text("<sdf version='1.7'><world name='w'><model name='m'><static>true</static><link name='l'><collision name='c'><geometry><mesh>"
                     f"<uri>{file}</uri></mesh></geometry></collision></link></model></world></sdf>")
    return [LIB / "navvi_sim/world_tool", "check", world], {}


def picture(file):
    path = file.parent / "map.yaml"
    path.write_text(f"image: {file.name}\nresolution: 0.05\norigin: [0, 0, 0]\noccupied_thresh: 0.65\nfree_thresh: 0.2\nnegate: 0\n")
    return [LIB / "navvi_nav/navmesh_tool", path], {}


def parameter(name):
    return lambda file: ([LIB / "navvi_feedback/feedback_node", "--parameters", f"{name}:={file}"], {})


def person(file):
    return [LIB / "navvi_feedback/feedback_node", "--parameters", f"person:={file.stem}"], {"NAVVI_PEOPLE": str(file.parent)}


#: What a file is to the product: its name's ending, and the command that reads it.
KINDS = {
    "plan": (".yaml", plan), "consent": (".yaml", planned("CONSENT")), "world of a plan": (".sdf", planned("WORLD")),
    "layout": (".yaml", program("navvi_sim", "world_tool", "check")), "sdf": (".sdf", program("navvi_sim", "world_tool", "check")),
    "config": (".yaml", lambda file: ([LIB / "navvi_sim/world_tool", "check", "easy", f"config:={file}"], {})),
    "classes": (".yaml", lambda file: ([LIB / "navvi_sim/world_tool", "check", ROOT / "navvi_ws/src/navvi_sim/worlds/small_room.world", f"classes:={file}"], {})),
    **{f"mesh {end}": (end, mesh) for end in (".dae", ".stl", ".obj")},
    **{f"map {end}": (end, program("navvi_nav", "navmesh_tool")) for end in (".bt", ".ot", ".yaml")}, "picture of a map": (".pgm", picture),
    "places": (".yaml", parameter("places")), "phrases": (".yaml", parameter("phrases")), "questions": (".yaml", parameter("questions")),
    "person": (".yaml", person),
}


def sparse(file):
    with open(file, "wb") as content:
        content.truncate(4 << 30)


#: What it is instead, or holds.
FAULTS = {
    "pipe": os.mkfifo, "device": lambda file: file.symlink_to("/dev/zero"), "folder": Path.mkdir, "4 GB of zeros": sparse,
    "no file": lambda file: None, "bytes": lambda file: file.write_bytes(bytes(range(256)) * 64),
    "20000 brackets": lambda file: file.write_text("[" * 20000), "20000 mappings": lambda file: file.write_text("{a: " * 20000),
    "20000 dashes": lambda file: file.write_text("- " * 20000), "20000 elements": lambda file: file.write_text("<sdf>" * 20000),
    "aliases": lambda file: file.write_text("a: &a [x, x, x, x, x, x, x, x, x]\n" + "".join(
        f"{chr(98 + at)}: &{chr(98 + at)} [{', '.join(['*' + chr(97 + at)] * 9)}]\n" for at in range(12))),
    "1 MB of values": lambda file: file.write_text("[" + "a, " * 340000 + "]"), "1 MB of a line": lambda file: file.write_text("title: " + "x" * 1000000),
    "another's text": lambda file: file.write_text("root:x:0:0:root:/root:/bin/bash\n" * 5 + SECRET + "\n"),
    "another's keys": lambda file: file.write_text("a: b\n" + f"password: {SECRET}\n"),
}


def bounded():
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))


@pytest.mark.parametrize("fault", FAULTS)
@pytest.mark.parametrize("kind", KINDS)
def test_P1_a_file_that_cannot_be_used_ends_in_a_sentence(kind, fault, tmp_path, record_property):
    ending, command = KINDS[kind]
    file = tmp_path / f"given{ending}"
    FAULTS[fault](file)
    words, more = command(file)
    if kind == "person" and fault == "no file" or kind == "world of a plan" and file.is_file():
        pytest.skip("a new name begins a new file; what is in a world is read when it is driven in")
    begin = time.monotonic()
    done = sourced(*words, env=dict(os.environ, **more), errors="replace", timeout=SECONDS, preexec_fn=bounded)
    within(record_property, "refused", time.monotonic() - begin, 2.0)
    said = done.stdout + done.stderr
    assert done.returncode == 2, said[-2000:]
    assert "Traceback" not in said and "bad_alloc" not in said and SECRET not in said
    assert len(done.stderr.replace(str(tmp_path), "").splitlines()) <= 2 and len(done.stderr.replace(str(tmp_path), "")) < 700, done.stderr[:3000]
    assert re.search(r"given|plan\.yaml|w\.sdf|map\.yaml", done.stderr), done.stderr
