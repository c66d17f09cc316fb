"""Where things are; nothing else names a place."""
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
COMMANDS = ROOT / "navvi_cli" / "commands"
SHELL = ROOT / "navvi_cli" / "shell" / "run"
LAUNCH = ROOT / "launch"
# In an install space there are no sources, hence nothing to build.
WORKSPACE = ROOT / "navvi_ws" if (ROOT / "navvi_ws").is_dir() else None
DEVEL = WORKSPACE / "devel" if WORKSPACE else ROOT.parent.parent
TRIALS = ROOT / "trials" if WORKSPACE else Path.home() / ".navvi" / "trials"
NAVVI = "./navvi" if WORKSPACE else "navvi"  # as a person types it


def share(package):
    return WORKSPACE / "src" / package if WORKSPACE else DEVEL / "share" / package


def config_of(package, profile):
    return share(package) / "config" / f"{profile}.yaml"


def program(package, name):
    return DEVEL / "lib" / package / name


# What the packages have in Python is imported as it is.
sys.path[1:1] = [str(share(package) / "python") for package in ("navvi_people", "navvi_study")]
