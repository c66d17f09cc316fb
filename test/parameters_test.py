"""Each parameter has a user that names it: a hand-written page, a profile, a preset, a study, a launch file or the command."""
import json
import re
import subprocess

import yaml

from sessions import ROOT

SOURCES = ROOT / "navvi_ws/src"
PARTS = {"relay_node": "safety", "cue_player": "feedback", "world_tool": "sim"}


def parameters():
    """All that programs take, such as feedback/drive/max_forward."""
    lib = ROOT / "navvi_ws/devel/lib"
    for program in sorted(path for name in ("*_node", "cue_player", "world_tool") for path in lib.glob(f"navvi_*/{name}")):
        part = "" if program.name == "operator_node" else PARTS.get(program.name, program.name.removesuffix("_node")) + "/"
        rows = json.loads(subprocess.run([program, "--parameters"], check=True, stdout=subprocess.PIPE).stdout)
        yield from (part + row["parameter"] for row in rows)


def in_pages():
    """The words of code in them. The table of traits is a generated list, which names nothing."""
    pages = [*ROOT.glob("*.md"), *(ROOT / "doc").rglob("*.md"), *SOURCES.glob("navvi_*/README.md")]
    for page in pages:
        text = page.read_text()
        if page.name == "people.md":
            text = re.sub(r"^\| .*\|$", "", text, flags=re.M)
        if page.name != "CHANGELOG.md":
            for code in re.findall(r"`[^`]*`|^    .*$", text, re.M):
                yield from re.findall(r"[\w*/]+", code)


def in_programs():
    """What the command, its scripts and launch files set or read."""
    folders = [ROOT / "navvi_cli", ROOT / "launch", *SOURCES.glob("*/python"), *SOURCES.glob("*/scripts"), *SOURCES.glob("*/bench")]
    for path in (path for folder in folders for path in folder.rglob("*") if path.suffix in ("", ".py", ".launch") and path.is_file()):
        yield from re.findall(r"\w+(?:/\w+)+|\w+(?=:=)|(?<=\")\w+(?=\")", path.read_text())


def in_yaml(node, prefix=""):
    if isinstance(node, list):
        for item in node:
            yield from in_yaml(item, prefix)
    elif isinstance(node, dict):
        for name, item in node.items():
            yield f"{prefix}{name}"
            yield from in_yaml(item, f"{prefix}{name}/")


def test_each_parameter_is_named_by_who_uses_it():
    files = [path for name in ("config", "studies", "worlds") for path in SOURCES.glob(f"navvi_*/{name}/*.yaml")]
    words = {*in_pages(), *in_programs(), *(key for file in files for key in in_yaml(yaml.safe_load(file.read_text())))}
    groups = [re.compile(re.escape(word).replace(r"\*", "[^/]+")) for word in words if "*" in word]
    tails = {word[at + 1:] for word in words for at, letter in enumerate(word) if letter == "/"}  # conditions/all/x

    def is_named(name):
        return name in words or name.partition("/")[2] in words | tails or any(group.fullmatch(name) for group in groups)
    everything = list(parameters())
    assert len(everything) > 150
    assert sorted(name for name in everything if not is_named(name)) == []
