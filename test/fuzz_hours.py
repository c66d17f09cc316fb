#!/usr/bin/env python3
"""Gives damaged bytes to all readers, one after the other and round and round, with new seeds each time, until the hours are over.

fuzz_hours.py BUILD FILE.csv [HOURS]: the build folder with the packages' test programs, those with sanitizers if it has them; the file has a
line a target and day, with the seeds that were used, so that the next run goes on with others; hours of the processor, over all runs. Prints
the sum of each target at the end, or when it is stopped. What failed is in BUILD/fuzz.TARGET.SEED.log.
"""
import csv
import datetime
import os
import pathlib
import re
import signal
import subprocess
import sys

TURN = 60  # s of the processor, about
FIRST = 300  # of each kind, in the first turn of a target
ROOT = pathlib.Path(__file__).resolve().parent.parent
# The sanitizer's own copies of what is freed would count as memory of the reader.
ENV = dict(os.environ, ASAN_OPTIONS="detect_leaks=0:detect_stack_use_after_return=1:strict_string_checks=1:quarantine_size_mb=64", UBSAN_OPTIONS="print_stacktrace=1")


def targets(build):
    """Its words, and whether it is one of Python, by the target's name."""
    for program in sorted(build.glob("navvi_*/navvi_*_tests")):
        suite = ""
        for line in subprocess.check_output([program, "--gtest_list_tests", "--gtest_filter=Fuzz*"], text=True).splitlines():
            suite = suite if line.startswith(" ") else line
            if line.startswith(" "):
                yield f"{program.parent.name} {suite}{line.strip()}", [program, f"--gtest_filter={suite}{line.strip()}"]
    python = ["/usr/bin/python3", "-m", "pytest", "-q", "-p", "no:cacheprovider", ROOT / "test/fuzz_test.py"]
    for name in re.findall(r"::(test_a_damaged\S+)", subprocess.check_output([*python, "--collect-only"], text=True)):
        yield "python " + name.split("[")[1].rstrip("-]"), [*python[:-1], f"{python[-1]}::{name}"]


def turn(words, first, count, log):
    """(processor seconds, whether all was as it should be)"""
    with open(log, "w") as file:
        process = subprocess.Popen(list(map(str, words)), env=dict(ENV, NAVVI_FUZZ=f"{count} {first}"), stdout=file, stderr=file)
        try:
            _, status, used = os.wait4(process.pid, 0)
        except KeyboardInterrupt:
            process.kill()
            raise
    return used.ru_utime + used.ru_stime, status == 0


def kept(path):
    """(date, target, first seed, count of seeds, processor seconds, findings)"""
    if not path.exists():
        return []
    with open(path, newline="") as file:
        return [(date, name, int(first), int(count), float(seconds), int(findings)) for date, name, first, count, seconds, findings in csv.reader(file)]


def keep(path, turns):
    new = path.with_suffix(".new")
    with open(new, "w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows(sorted(turns))
    new.replace(path)


def put(turns, turn):
    """A turn of a target that had one that day goes on with its seeds."""
    for at, (date, name, first, count, seconds, findings) in enumerate(turns):
        if (date, name, first + count) == turn[:3]:
            turns[at] = (date, name, first, count + turn[3], round(seconds + turn[4], 1), findings + turn[5])
            return
    turns.append(turn)


def main():
    build, path = map(pathlib.Path, sys.argv[1:3])
    end = 3600.0 * float(sys.argv[3]) if len(sys.argv) > 3 else float("inf")
    found, turns = dict(targets(build)), kept(path)
    if not found:
        sys.exit(f"{build} has no test program with fuzz targets; \"./navvi test --asan fuzz\" builds them.")
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        while found and sum(row[4] for row in turns) < end:
            # The one that has had the least.
            name = min(found, key=lambda one: sum(row[4] for row in turns if row[1] == one))
            of_it = [row for row in turns if row[1] == name]
            first = max((row[2] + row[3] for row in of_it), default=0)
            # What failed has not used its time, and is left out from then on.
            count = int(of_it[-1][3] * (1.0 if of_it[-1][5] else min(10.0, TURN / max(of_it[-1][4], 0.1)))) + 1 if of_it else FIRST
            log = build / f"fuzz.{re.sub(r'[^A-Za-z0-9]+', '_', name)}.{first}.log"
            seconds, good = turn(found[name], first, count, log)
            if good:
                log.unlink()
            else:
                print(f"{name}, seeds {first} to {first + count - 1}: a finding, in {log}", flush=True)
                del found[name]
            put(turns, (datetime.date.today().isoformat(), name, first, count, round(seconds, 1), int(not good)))
            keep(path, turns)
    except KeyboardInterrupt:
        pass
    print("| target | of each kind | processor hours | turns with a finding |\n|---|---|---|---|")
    for name in [*sorted({row[1] for row in turns}), ""]:
        of_it = [row for row in turns if name in ("", row[1])]
        print(f"| {name or 'all'} | {sum(row[3] for row in of_it)} | {sum(row[4] for row in of_it) / 3600:.2f} | {sum(row[5] for row in of_it)} |")


if __name__ == "__main__":
    main()
