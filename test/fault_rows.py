#!/usr/bin/env python3
"""Adds the results of a test run to those of before, and prints for each row of doc/faults.md its runs and the largest of its measured times.

fault_rows.py RUNS.csv FOLDER: the folder has the JUnit files of the run.
"""
import csv
import datetime
import pathlib
import re
import sys
import xml.etree.ElementTree as ElementTree

ROW = re.compile(r"(?<![A-Za-z0-9])([A-Z]\d{1,2})_")  # in the name of a test


def results(folder):
    """(row, test, outcome, what was measured and of how many) of the run; a test that measures nothing has one without."""
    for path in sorted(folder.rglob("*.xml")):
        for case in ElementTree.parse(path).getroot().iter("testcase"):
            outcome = next((mark.tag for mark in case if mark.tag in ("failure", "error", "skipped")), "passed")
            for row in ROW.findall(case.get("name")) if outcome != "skipped" else []:
                yield row, case.get("name"), outcome, ""
                for entry in (one for one in case.iter("property") if " of " in one.get("value")):
                    yield row, case.get("name"), outcome, f"{entry.get('name').rstrip(' 0123456789')}: {entry.get('value')}"


def table(runs):
    yield "| row | tests | runs | passed | longest | last |\n|---|---|---|---|---|---|"
    for row in sorted({run[1] for run in runs}, key=lambda name: (name[0], int(name[1:]))):
        of_it = [run for run in runs if run[1] == row]
        ran = [run for run in of_it if not run[4]]
        longest = {}
        for time in (run[4] for run in of_it if run[4]):
            what, number, of = re.fullmatch(r"(.*): (\d+) of (.*)", time).groups()
            longest[what, of] = max(int(number), longest.get((what, of), 0))
        yield (f"| {row} | {len({run[2] for run in ran})} | {len(ran)} | {sum(run[3] == 'passed' for run in ran)} | "
               f"{', '.join(f'{what} {number} of {of}' for (what, of), number in longest.items())} | {max(run[0] for run in of_it)[:10]} |")


def main():
    kept, folder = map(pathlib.Path, sys.argv[1:])
    now = datetime.datetime.now().isoformat(timespec="seconds")
    with open(kept, "a", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([now, *result] for result in results(folder))
    with open(kept, newline="") as file:
        print("\n".join(table(list(csv.reader(file)))))


if __name__ == "__main__":
    main()
