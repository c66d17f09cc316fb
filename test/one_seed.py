#!/usr/bin/python3
"""Whether a seed gives the same trial whatever compiles it: builds trials_bench anew with each setting, and prints the hashes of the last states.

    test/one_seed.py [SETTING ...] [--clang=clang++]

Settings: default (the workspace as it is), O0, O3, native, clang, sanitized; without any, all.
Of each, a build folder of some hundred MB, which goes away again. On one processor: taskset -c 0 test/one_seed.py.
"""
import argparse
import csv
import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
WORKSPACE = ROOT / "navvi_ws"
SETTINGS = {
    "default": None, "O0": "-O0 -DNDEBUG", "O3": "-O3 -DNDEBUG", "native": "-O2 -march=native -DNDEBUG",
    "clang": "-O2 -DNDEBUG",
    "sanitized": "-O1 -fsanitize=address,undefined -fno-sanitize-recover=all",
}
WORLDS, SEEDS = "busy,narrow,warehouse,easy", "1-3"


def built(name, flags, clang):
    """The folder of the programs, compiled with the flags."""
    if flags is None:
        return WORKSPACE / "devel"
    words = ["-DCMAKE_BUILD_TYPE=Probe", f"-DCMAKE_CXX_FLAGS_PROBE={flags}"]
    if name == "clang":
        words += [f"-DCMAKE_CXX_COMPILER={clang}"]
    subprocess.run([ROOT / "navvi_cli/shell/run", "cmake_build", "_probe", *words, "--", "trials_bench"], check=True, stdout=sys.stderr)
    return WORKSPACE / "devel_probe"


def hashes(devel):
    """By (world, seed)."""
    words = f"--world={WORLDS} --seeds={SEEDS} --limit=600 --csv=true --cache=0 person/type:=typical"
    shell = f"source {WORKSPACE}/devel/setup.bash; ASAN_OPTIONS=detect_leaks=0 exec {devel}/lib/navvi_study/trials_bench {words}"
    out = subprocess.run(["bash", "-c", shell], check=True, stdout=subprocess.PIPE, text=True).stdout
    return {(row["world"], row["seed"]): row["state_hash"] for row in csv.DictReader(out.splitlines())}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("settings", nargs="*", default=list(SETTINGS), choices=[*SETTINGS, []])
    parser.add_argument("--clang", default="clang++")
    words = parser.parse_args()
    found = {}
    for name in words.settings:
        found[name] = hashes(built(name, SETTINGS[name], words.clang))
        for folder in ("build_probe", "devel_probe"):
            shutil.rmtree(WORKSPACE / folder, ignore_errors=True)
        first = found[words.settings[0]]
        equal = sum(found[name].get(key) == value for key, value in first.items())
        print(f"{name}: {equal} of {len(first)} as {words.settings[0]}", flush=True)
    print("| world | seed | " + " | ".join(found) + " |\n|---|---|" + "---|" * len(found))
    for key in first:
        print("| " + " | ".join([*key, *(rows.get(key, "none")[-8:] for rows in found.values())]) + " |")
    return any(rows != first for rows in found.values())


if __name__ == "__main__":
    sys.exit(main())
