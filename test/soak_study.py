#!/usr/bin/env python3
"""A study of simulated people, live at 5 times real time, with a fault of doc/faults.md in the first trial of each person.

soak_study.py FOLDER [PEOPLE]. Prints a line for each trial, with its result and the reason, and what `./navvi study verify` says at the end; its
exit code.
"""
import os
import pathlib
import random
import signal
import sys
import time

from small_study import small
from sessions import Command, eventually, rows_of

CHANGES = [("{picture: false}", "{parameters: {sim/rate: 5}}"), ("{picture: false, touch: false}", "{touch: false, parameters: {sim/rate: 5}}"),
           ("{world: easy, seeds: [1]}", "{world: training, seeds: [3]}"), ("{world: easy, seeds: [2]}", "{world: training, seeds: [4]}"),
           ("{world: easy, seeds: 11..12}", "{world: training, seeds: 11..90}"), ("limit: 60", "limit: 90")]
FAULTS = {  # by its row: what is done to which program of a session, and s until it goes on
    "none": None, "C1": ("/feedback_node", signal.SIGKILL, 0), "C2": ("/feedback_node", signal.SIGSTOP, 3), "N1": ("/nav_node", signal.SIGKILL, 0),
    "S1": ("/sim_node", signal.SIGKILL, 0), "T3": ("/sim_node", signal.SIGSTOP, 3), "F4": ("espeak_voice", signal.SIGKILL, 0),
    "R1": ("/record", signal.SIGKILL, 0), "M1": ("/rosmaster", signal.SIGKILL, 0), "L5 roslaunch": ("/roslaunch", signal.SIGKILL, 0),
    "L5 trial_node": ("/trial_node", signal.SIGKILL, 0), "person": ("/operator_node", signal.SIGKILL, 0), "D5": signal.SIGINT, "D3": signal.SIGKILL}


def disturb(begun, fault):
    """While its trial runs: the program, or, by a signal alone, the command itself."""
    if isinstance(fault, tuple):
        program, how, seconds = fault
        number = next(number for number, line in begun.of_it().items() if program in line.split(" __name:=")[0])
        os.kill(number, how)
        if seconds:
            time.sleep(seconds)
            os.kill(number, signal.SIGCONT)
    elif fault:
        os.kill(begun.process.pid, fault)


def led(plan, folder, name, fault):
    """Lines on one person, who is led to the end of the plan, however often a session breaks off."""
    for turn in range(9):
        before = set(folder.glob(f"small/{name}/*/trial-*"))
        with Command("study", "next", plan, name, "--session") as begun:
            if turn == 0:
                begun.wait_until(lambda: "has begun" in begun.text(), 300, "a trial begins")
                time.sleep(random.uniform(0.5, 3.0))
                disturb(begun, FAULTS[fault])
            said = begun.wait_until_ended(300)
        if not eventually(lambda: not begun.of_it(), 60):  # by D3 a session outlives its command
            yield f"{name} {fault}: still there: {list(begun.of_it().values())}"
        for trial in sorted(set(folder.glob(f"small/{name}/*/trial-*")) - before):
            row = rows_of(trial / "summary.csv")[0] if (trial / "summary.csv").exists() else {}
            yield f"{name} {'then' if turn else fault}: {row.get('result')} {row.get('reason')}, bag {row.get('bag')}"
        if begun.process.returncode == 3 or "has done everything" in said:
            return
    yield f"{name}: not through: {said[-500:]}"


def main():
    folder, people = pathlib.Path(sys.argv[1]).resolve(), int((sys.argv[2:] or [20])[0])
    folder.mkdir(parents=True)
    random.seed(1)
    plan = small(folder, ("sub-04", f"sub-{people:02d}"), *CHANGES)
    Command("study", "freeze", plan.file).wait_until_ended()
    faults = [fault for _ in range(people // len(FAULTS) + 1) for fault in random.sample(list(FAULTS), len(FAULTS))]
    for name, fault in zip(plan.participants, faults):
        for line in led(plan.file, folder, name, fault):
            print(line, flush=True)
    verify = Command("study", "verify", plan.file)
    print(verify.wait_until_ended(3600))
    return verify.process.returncode


if __name__ == "__main__":
    sys.exit(main())
