"""Run the tests.

quick, the default: what every commit passes: all parts by themselves, the
structure, the documents, one session with its record. Some minutes.
whole: what every change passes before it lands: quick, the nodes, and
sessions by pad, by keyboard, by sensors, watched, stopped and broken.
release: whole, the picture in each vision, all lessons, the package of
Debian, long runs, and the parts with sanitizers. About an hour.

faults: the tests of all rows of doc/faults.md, or of the row that follows,
such as C1. Prints how often they have run, and the longest times.
hours: damaged bytes to each reader of foreign bytes, with new ones each time,
for the processor's hours that follow, or until Ctrl-C; goes on where it was.

A line each 10 s tells how far it is. The output of the tests goes to
navvi_ws/test.log; of a test that fails, name and reason are shown, too.
The last line is "N passed, N failed".

Exit codes
0: all passed. 1: one failed, or none ran. 2: a wrong argument.
"""
from navvi_cli.arguments import number
from navvi_cli.say import fail
from navvi_cli.workspace import shell

TIERS = ["quick", "whole", "release"]
SHELL = {"faults": "fault_rows", "hours": "fuzz_hours"}


def arguments(parser):
    parser.add_argument("words", nargs="*", default=[], metavar="quick|whole|release|faults|hours|FILTER",
                        help="a tier, and a part of the names of tests, such as accessibility; without a tier, of all tiers.").completer = (
                            lambda **_: [*TIERS, *SHELL])
    kind = parser.add_mutually_exclusive_group()
    kind.add_argument("--asan", action="store_true", help="the tests of the parts, with sanitizers, in a build of their own.")
    kind.add_argument("--slowest", action="store_true", help="which tests of the last run took the longest.")


def run(args):
    words = list(args.words)
    tier = words.pop(0) if words and words[0] in [*TIERS, *SHELL] and not args.asan else None
    if len(words) > 1 or (args.slowest and args.words):
        fail(f"unexpected argument \"{words[-1] if words else tier}\"; allowed are a tier and one part of a test's name.", 2)
    if tier == "hours" and words:
        number("the time in hours", 0, 10**6, float)(words[0])
    if args.slowest:
        shell("slowest")
    elif args.asan:
        shell("sanitized_tests", *words)
    elif tier in SHELL:
        shell(SHELL[tier], *words)
    else:
        shell("tests", tier or ("release" if words else "quick"), *words)
