"""Repeat a trial's simulation from its record and compare each second.

The world is built anew and driven, without ROS, by the commands that were
applied; the state of the world is compared bit for bit. It takes a fraction of
a second.

Exit codes
0: equal, and how many states were. 1: they differ, and where first. 2: it
cannot be compared.
"""
from navvi_cli.arguments import add_trial
from navvi_cli.workspace import show, tool


def arguments(parser):
    add_trial(parser)


def run(args):
    return show(tool("navvi_study", "check_trial"), args.trial)
