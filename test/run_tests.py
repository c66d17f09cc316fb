#!/usr/bin/env python3
"""Runs ctest, and alone, once more, what failed in a crowd: a session in real time fails where its programs get no processor.

run_tests.py RESULT.xml WORD...: the words are ctest's; the result is its JUnit file, with the last outcome of each program. Nothing is
repeated until it passes: what fails alone has failed. Only where programs that are not of the tests held the processors meanwhile is it
run a third time, and at last, unless its words were the same each time, left out ("skipped"), at most LEFT_OUT programs.
"""
import os
import pathlib
import re
import resource
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

from count_results import result_file

BUSY = 2 / 3  # of the processors' time, held by others
LEFT_OUT = 3
CROWD = 10  # as many programs do not fail by chance
# In a reason: addresses, and numbers but for those of wall time, by which a busy machine fails each time.
CHANCE = re.compile(r"0x[0-9a-f]+|\(\d+ ms\)|\d+(?:\.\d+)?(?:e[-+]?\d+)?(?![\d.]| ?m?s\b| a processor)")
REASON = re.compile(r"\[  FAILED  \] .*ms\)|FAILED |E  ")


class Others:
    """The share of the processors' time that went to programs other than the children of this one, and to other machines of its host."""

    def __init__(self):
        self.busy, self.all, self.ours = self.times()

    @staticmethod
    def times():
        with open("/proc/stat") as file:
            user, nice, system, idle, iowait, irq, softirq, steal = (int(word) for word in file.readline().split()[1:9])
        ours = resource.getrusage(resource.RUSAGE_CHILDREN)
        busy = user + nice + system + irq + softirq + steal
        return busy, busy + idle + iowait, (ours.ru_utime + ours.ru_stime) * os.sysconf("SC_CLK_TCK")

    def share(self):
        busy, all_, ours = (now - then for now, then in zip(self.times(), (self.busy, self.all, self.ours)))
        return max(0.0, busy - ours) / max(all_, 1)


def run(result, *words):
    """(names of the programs that failed with the lines that say why, others' share)."""
    failed, name, others = {}, "", Others()
    with subprocess.Popen(["ctest", *words, "--output-on-failure", "--output-junit", result], stdout=subprocess.PIPE, text=True,
                          errors="replace") as ctest:
        for line in ctest.stdout:
            print(line, end="", flush=True)
            if match := re.match(r"(?: *\d+/\d+ +Test +#\d+: (\S+) \.*(.*)| +Start +\d+: )", line):
                name = match[1] if match[1] and not re.match(" +(Passed|Skipped)", match[2]) else ""
                if name:
                    failed[name] = []
            elif name and REASON.match(line) and len(failed[name]) < 6:
                failed[name].append(line.rstrip()[:200])
    return failed, others.share()


def put(result, name, case):
    """The outcome of a program in the whole run's file."""
    tree = ElementTree.parse(result)
    for at, old in enumerate(tree.getroot()):
        if old.get("name") == name:
            tree.getroot()[at] = case
    tree.write(result)


def again(result, name, lines):
    """Alone. Why it is left out, where it is. The lines told why it failed in the crowd."""
    alone, told = result + ".alone", [lines]
    for _ in range(2):
        failed, others = run(alone, "-R", f"^{re.escape(name)}$")
        told.append(failed.get(name))
        case = next(case for case in ElementTree.parse(alone).getroot() if case.get("name") == name)
        if not failed or others < BUSY:
            put(result, name, case)
            return ""
    if lines and all(CHANCE.sub("", str(one)) == CHANCE.sub("", str(lines)) for one in told):
        put(result, name, case)
        return ""
    return f"other programs held {others:.0%} of this machine's processors"


def main():
    result, *words = sys.argv[1:]
    failed, others = run(result, *words)
    count = len(ElementTree.parse(result).getroot())
    if len(failed) > CROWD or (count == 1 and others < BUSY):
        return
    left_out = {}
    for name, lines in failed.items():
        print(f"run again, alone: {name}", *lines, sep="\n  ", flush=True)
        if why := again(result, name, lines):
            left_out[name] = why
    for name, why in left_out.items():
        print(f"left out: {name}: {why}")
        if len(left_out) <= LEFT_OUT:
            skipped = ElementTree.Element("testcase", name=name, classname=name, status="notrun")
            ElementTree.SubElement(skipped, "skipped", message=why)
            put(result, name, skipped)
            for file in pathlib.Path(result).with_suffix("").rglob(result_file(name)):
                file.unlink()


if __name__ == "__main__":
    main()
