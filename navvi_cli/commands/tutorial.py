"""Learn to drive without looking, step by step, to a first goal.

A session in the training hall that tells each step and goes on when you have
done it: let go, drive ahead, stop at a word, turn and stop in time, tell on
which side something is, ask with the buttons, drive to a goal. Where it went
wrong you are told what, and try again; the weakest step comes once more at
the end. On the pad, the lower button tells a step again, arrow down leaves it
out, select ends the tutorial; on the keyboard space, page down and F8.

How each step went (tries, seconds, passed) is in tutorial.csv in the folder
of the trial to the goal, and told in words at the end.

It takes the arguments of "./navvi run" but robot:=; world:= for another world.

Exit codes
0: the goal was reached. 1: it was not. 2: a wrong argument, nothing started.

Example
./navvi tutorial feedback/language:=es participant:=sub-01
"""
import csv
import os
import tempfile
import time
from pathlib import Path

from navvi_cli import trials
from navvi_cli.arguments import add_words
from navvi_cli.commands import run as run_command
from navvi_cli.places import TRIALS
from navvi_cli.say import say

HALL = {"world": "training", "start": "-6.5,-5,1.57", "goal": "0.2,-1"}


def arguments(parser):
    add_words(parser, "live.launch", shown=False)


def run(args):
    names = [word.partition(":=")[0] for word in args.words]
    hall = {} if "world" in names else {name: value for name, value in HALL.items() if name not in names}
    begun = []
    with tempfile.TemporaryDirectory() as folder:
        record = Path(folder) / "tutorial.csv"
        words = [*(f"{name}:={value}" for name, value in hall.items()), "lesson:=tutorial", f"feedback/record:={record}", *args.words]
        try:
            return run_command.session(words, begun)
        finally:
            if record.exists() and record.stat().st_size:
                out = next((word[len("out:="):] for word in args.words if word.startswith("out:=")), TRIALS)
                keep(record.read_text(), Path(os.path.abspath(out)), begun)


def keep(record, out, begun):
    """In the trial's folder, or beside it where there was no trial; and in words."""
    folders = trials.summed_up(begun, out)
    path = folders[-1] / "tutorial.csv" if folders else out / time.strftime("tutorial-%Y%m%dT%H%M%SZ.csv", time.gmtime())
    path.write_text(record)
    say(f"how the steps of the tutorial went is in {path}:")
    for step, tries, seconds, passed, again in list(csv.reader(record.splitlines()))[1:]:
        print(f"{step.replace('_', ' ')}{', once more' if again == 'yes' else ''}: {'passed' if passed == 'yes' else 'not passed'}, "
              f"tries {tries}, {seconds} seconds.")
