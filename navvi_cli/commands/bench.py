"""Run the benchmarks: stopwatches, and figures beside those of the paper.

The sim and nav benchmarks print ratios to a plain use of the same library in
the same run. nav takes --maps for maps alone, --resolution=0.05 and
--largest=100 (m). build times what a newcomer waits for, in a clone of its own
and without the compiler's cache. latency [--rounds=100] times what a person
waits for, with nodes as they run live. picture measures what RViz costs.
paper [--seeds=1-6] [--world=busy] [TRIAL] prints what the paper prints, with
NavVI's own beside it, and why some of it cannot be repeated.

Researchers run ./navvi batch. The older words remain: trials plays single
trials without ROS, a row each (trials --help names its options, such as
--trace and --out); people [TYPE] prints published effects of guidance beside
those of the simulated person; guidance DIR the tables of a batch, guidance DIR
-o FILE.md doc/guidance.md anew.

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


ALONE = ("build/build_bench", "people/guidance_bench")  # only where their own name is given: one builds a clone, one needs a folder
# Programs that a script runs, besides those of a session.
NEEDS = {"study/paper_bench": ["trials_bench"], "rviz/picture_bench": ["navvi_rviz"]}


def benchmarks():
    """The file of each, by names such as nav/nav."""
    found = {}
    for path in sorted([*WORKSPACE.glob("src/navvi_*/bench/*_bench.cpp"), *WORKSPACE.glob("src/navvi_*/bench/*_bench")]):
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
    chosen = {name: path for name, path in known.items() if args.filter in name and name not in ALONE}
    # That whose own name it is, not all others of its package.
    chosen = {name: path for name, path in known.items() if path.stem == f"{args.filter}_bench" or name == args.filter} or chosen
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
