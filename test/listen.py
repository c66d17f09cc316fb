#!/usr/bin/python3
"""Makes doc/listen anew: what is heard, felt and driven on one way by each way of leading. Wants a quiet machine for three minutes.

    source navvi_ws/devel/setup.bash; test/listen.py
"""
import csv
import subprocess
import tempfile
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from sessions import ROOT, navvi, sound

from navvi_cli import maps
from navvi_cli.commands.world import verdict_on

OUT = ROOT / "doc/listen"
WORLD = ["training", ["seed:=3"]]
WAYS = {"words": ("#0072b2", "-"), "ticks": ("#d55e00", "--"), "flow": ("#009e73", ":"), "hand": ("#000000", "-.")}  # Okabe and Ito's colours


def drive(lead, folder):
    """Track and summary of a simulated person's trial; its sound is in the folder."""
    done = navvi("run", "operator:=simulated", "rviz:=false", f"world:={WORLD[0]}", *WORLD[1], f"feedback/lead:={lead}", f"out:={folder}",
                 **sound(folder))
    assert done.returncode == 0, done.stdout + done.stderr
    trial, = folder.glob("trial-*")
    with open(trial / "summary.csv", newline="") as file:
        return np.load(trial / "track.npy"), next(csv.DictReader(file))


def draw_motors(track):
    time, figure = track["time"] - track["time"][0], Figure((7.0, 3.5), layout="constrained")
    left, right, way = figure.subplots(3, sharex=True)
    for axes, name, colour in ((left, "left", "#0072b2"), (right, "right", "#d55e00")):
        axes.plot(time, track[f"motor_{name}"], color=colour, linewidth=0.9, drawstyle="steps-post")
        axes.set(ylabel=f"{name} motor", ylim=(0.0, 1.0))
    way.plot(time, np.degrees(track["steer"]), color="#555555", linewidth=0.9, label="where to steer, deg, right is positive")
    way.plot(time, 50.0 * track["speed"], color="#009e73", linewidth=0.9, linestyle="--", label="speed, 2 cm/s")
    way.set(xlabel="s")
    way.legend(fontsize=7, ncols=2, loc="upper center")
    figure.savefig(OUT / "motors.png", dpi=100)


def main():
    driven, labels = [], []
    for lead, (colour, dashes) in WAYS.items():
        with tempfile.TemporaryDirectory() as name:
            track, summary = drive(lead, Path(name))
            if lead == "hand":
                draw_motors(track)
            else:  # from the begin of the trial to its last words
                subprocess.run(["sox", "--ignore-length", Path(name) / "sound.wav", "-r", "44100", "-C", "-1", OUT / f"{lead}.ogg",
                                *f"reverse trim 0 {float(summary['elapsed_s']) + 6.0} reverse".split()], check=True)
        print(f"{lead}: {summary['result']} after {summary['elapsed_s']} s, {summary['contacts']} contacts", flush=True)
        driven.append((colour, dashes, np.column_stack([track["x"], track["y"]])))
        labels.append(Line2D([], [], color=colour, linestyle=dashes, label=f"{lead}, {float(summary['elapsed_s']):.0f} s"))
    found = verdict_on(*WORLD, drawing=True)
    figure = maps.world(found.world, found.caption(), driven=driven)
    figure.legend(handles=labels, loc="lower right")
    maps.save(figure, OUT / "paths.png")


if __name__ == "__main__":
    main()
