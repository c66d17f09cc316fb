"""Repeat a trial's simulation from its record and compare each second.

The world is built anew and driven, without ROS, by the commands that were
applied; the state of the world is compared bit for bit. The figures are counted
again from the journal, and compared with the summary.

Exit codes
0: equal, and how many states were. 1: they differ, and where. 2: they cannot
be compared.
"""
from navvi_cli import trials
from navvi_cli.arguments import add_trial
from navvi_cli.workspace import show, tool


def arguments(parser):
    add_trial(parser)


def run(args):
    row = trials.summary(args.trial)
    repeat, count = (tool("navvi_study", name) for name in ("check_trial", "count_trial"))
    status = show(repeat, args.trial)
    if not (args.trial / "journal.csv").is_file():  # a bag alone was kept
        return status
    counted = show(count, "journal", args.trial)
    trials.require_end(args.trial, row)
    return status or counted
