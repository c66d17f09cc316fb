#!/usr/bin/python3
"""A condition of one's own: closed-loop trials with and without it, on the same worlds. Run as: examples/condition.py nav/smoothing/preferred_clearance:=0.3"""
import csv
import io
import statistics
import subprocess
import sys
from pathlib import Path

NAVVI = Path(__file__).resolve().parent.parent / "navvi"


def rows(*words):
    """A dictionary of figures a trial, of five worlds."""
    command = [NAVVI, "bench", "trials", "--world=training", "--seeds=1-5", "--csv", *words]
    table = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    return list(csv.DictReader(io.StringIO(table[table.index("world,seed"):])))


if __name__ == "__main__":
    before, after = rows(), rows(*sys.argv[1:])
    for figure in ("elapsed_s", "contacts", "path_length_m"):
        change = [float(b[figure]) - float(a[figure]) for a, b in zip(before, after)]
        print(f"{figure}: {statistics.mean(change):+.2f} on the mean of {len(change)} worlds")
