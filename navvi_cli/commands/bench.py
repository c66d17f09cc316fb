"""Run the benchmarks, or whole sessions with a simulated person.

The sim and nav benchmarks print ratios to a plain use of the same library in
the same run. nav takes --maps for maps alone, --resolution=0.05 and
--largest=100 (m). build times what a newcomer waits for, in a clone of its own
and without the compiler's cache. latency [--rounds=100] times what a person
waits for, with nodes as they run live.
trials [--world=NAME|FILE[,...]] [--seeds=1-10] [--limit=300] [--profile=paper]
[--sensing=truth|lidar|robot] [--jobs=1] [--cache=512] [--csv]
[--trace[=FROM-TO]] [PART/NAME:=VALUE ...] runs sessions without ROS and prints
one row a trial, or with --csv a table for a program. --trace prints what
happens second by second, between FROM and TO (s). --sensing gives guidance and
feedback what a lidar, or a lidar and a depth camera (robot), show of the world.
--cache bounds the worlds kept for other trials (MB; 0: none). PART is sim, nav,
feedback, person or perception, with the parameters of its node, such as
nav/replan/hold_time:=3 or sim/goal:=3,4.
paper [--seeds=1-6] [--world=busy] [TRIAL] prints what the paper prints, with
NavVI's own beside it, and why some of it cannot be repeated.
people [TYPE] prints published effects of guidance on people beside those of the
simulated person; guidance DIR the tables of a batch, guidance DIR -o FILE.md
doc/guidance.md anew: it runs what is missing of that page's batches.

Exit codes
0: done. 1: one failed. 2: a wrong argument.

Examples
./navvi bench nav --seed=2
./navvi bench trials --world=busy --seeds=1-20 --jobs=2
"""
import argparse
import re

from navvi_cli.places import WORKSPACE, program
from navvi_cli.say import fail
from navvi_cli.workspace import build, enter, shell, show
from navvi_cli.worlds import check_name


# Programs that a script runs, besides those of a session.
NEEDS = {"study/paper_bench": ["trials_bench"]}


def benchmarks():
    """The file of each, by names such as nav/nav."""
    found = {}
    for path in sorted([*WORKSPACE.glob("src/navvi_*/bench/*_bench.cpp"), *WORKSPACE.glob("src/navvi_*/scripts/*_bench")]):
        name = f"{path.parent.parent.name[len('navvi_'):]}/{path.stem}"
        if re.fullmatch(r"[a-z]+/[a-z_]+", name):
            found[name] = path
    return found


def arguments(parser):
    parser.add_argument("filter", nargs="?", default="", metavar="FILTER",
                        help="a benchmark's name, or a part of package/name.").completer = lambda **_: benchmarks()
    parser.add_argument("words", nargs=argparse.REMAINDER, metavar="ARGUMENT ...", help="what the benchmarks take.")


def run(args):
    known = benchmarks()
    chosen = {name: path for name, path in known.items() if args.filter in name and (not name.startswith("build/") or args.filter == "build")}
    # That whose own name it is, not all others of its package.
    chosen = {name: path for name, path in chosen.items() if path.stem == f"{args.filter}_bench"} or chosen
    if not chosen:
        fail(f"no benchmark's name contains \"{args.filter}\"; allowed are parts of: {' '.join(known)}", 2)
    for word in args.words:
        if word.startswith("--world="):
            for world in word.partition("=")[2].split(","):
                check_name(world)
    shell("install_packages", "benchmarks")
    build("session", *(path.stem for path in chosen.values() if path.suffix == ".cpp"), *(target for name in chosen for target in NEEDS.get(name, [])))
    enter()
    failed = 0
    for name, path in sorted(chosen.items(), key=lambda item: item[1].suffix != ".cpp"):
        print(name, flush=True)
        failed = failed or show(program(f"navvi_{name.split('/')[0]}", path.stem) if path.suffix == ".cpp" else path, *args.words)
    return failed
