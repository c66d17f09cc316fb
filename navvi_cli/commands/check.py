"""Repeat a trial's simulation from its record and compare each second.

The world is built anew and driven, without ROS, by the commands that were
applied; the state of the world is compared bit for bit. It takes a fraction of
a second.

Exit codes
0: equal, and how many states were. 1: they differ, and where first. 2: it
cannot be compared.
"""
from navvi_cli.places import trial_folder
from navvi_cli.workspace import show, tool


def arguments(parser):
    parser.add_argument("trial", metavar="TRIAL", type=trial_folder, help="the folder of a trial.")


def run(args):
    return show(tool("navvi_study", "check_trial"), args.trial)
