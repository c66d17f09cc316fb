"""Make a package for this Debian: what a session needs, and no sources.

It holds the programs, the launch files, the manual, and a rule for udev that
lets the user at the machine use a pad's motors. After
"sudo apt install ./navvi_*.deb" the command is navvi, records go to
~/.navvi/trials, and what builds or tests is missing.

Exit codes
0: it is made. 1: it could not be. 2: a wrong argument.
"""
import os
from pathlib import Path

from navvi_cli.places import ROOT
from navvi_cli.say import fail
from navvi_cli.workspace import shell


def folder(word):
    if not os.path.isdir(word) or not os.access(word, os.W_OK):
        fail(f"{word} is not a folder that can be written to; name one, such as /tmp.", 2)
    return Path(word).resolve()


def arguments(parser):
    parser.add_argument("folder", nargs="?", metavar="FOLDER", type=folder, default=ROOT, help="where the package is written to, here by default.")


def run(args):
    shell("deb", args.folder)
