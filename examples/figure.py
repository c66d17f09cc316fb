#!/usr/bin/python3
"""A figure of one's own, over the record of a trial: the share of its time that the robot drove beside something nearer than 0.5 m.
Run as: examples/figure.py trials/NAME; the columns of track.npy stand in doc/record.md."""
import sys
from pathlib import Path

import numpy


def share_driven_close(folder, near=0.5):
    track = numpy.load(Path(folder) / "track.npy")
    drives = numpy.abs(track["speed"]) > 0.05  # m/s
    return numpy.count_nonzero(drives & (track["gap"] < near)) / max(1, numpy.count_nonzero(drives))


if __name__ == "__main__":
    print(f"{share_driven_close(sys.argv[1]):.3f}")
