"""Print the summary of a trial: each figure on a line, its result last.

Exit codes
0: printed. 1: printed, and the journal is cut off. 2: no summary in order.

Example
./navvi show trials/trial-20260101T120000Z
"""
from navvi_cli import trials
from navvi_cli.arguments import add_trial


def arguments(parser):
    add_trial(parser, "summary.csv")
    parser.add_argument("--csv", action="store_true", help="as a table for a program.")


def run(args):
    row = trials.summary(args.trial)
    if args.csv:
        print((args.trial / "summary.csv").read_text(errors="replace"), end="")
    else:
        print("\n".join([*trials.lines(row, row), f"The record is in {args.trial}", trials.sentence(row)]))
    trials.require_end(args.trial, row)
