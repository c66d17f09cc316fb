#!/usr/bin/env python3
"""Adds up the JUnit files of a test run, names what failed and why, and ends with the line `N passed, N failed`.

count_results.py [--slowest] CTEST.xml FOLDER: ctest's own JUnit file, which names the programs that ran, and the folder of
those that they wrote, which name each test. Exit code 1 if anything failed, was broken off, or if nothing ran at all.
"""
import pathlib
import sys
import xml.etree.ElementTree as ElementTree

LINES = 20  # the last of a failure's; its log holds all
SLOWEST = 30


def cases(path):
    """Yields (name, outcome, reason, seconds) for each test case; a file that cannot be read is a failed case of its own."""
    try:
        root = ElementTree.parse(path).getroot()
    except (ElementTree.ParseError, OSError) as problem:
        yield path.stem, "failed", str(problem), 0.0
        return
    for case in root.iter("testcase"):
        name = case.get("name")
        if case.get("classname") not in (None, "", name):  # ctest gives its name twice
            name = f"{case.get('classname')}.{name}"
        seconds = float(case.get("time") or 0)
        wrong = [mark for mark in case if mark.tag in ("failure", "error")]
        if wrong:
            yield name, "failed", (wrong[0].text or case.findtext("system-out") or wrong[0].get("message") or "").strip(), seconds
        elif (skip := case.find("skipped")) is not None or "notrun" in (case.get("status"), case.get("result")) \
                or case.get("result") == "skipped":
            yield name, "skipped", skip.get("message") or "" if skip is not None else "", seconds
        else:
            yield name, "passed", "", seconds


def results(ctest, folder):
    """All test cases; a program that failed without a result of its own, such as by a crash, is a failed case."""
    found = [case for path in sorted(folder.rglob("*.xml")) for case in cases(path)]
    yield from found
    failed = any(outcome == "failed" for _, outcome, _, _ in found)
    for name, outcome, reason, seconds in cases(ctest):
        written = list(folder.rglob(result_file(name)))
        if outcome == "failed" and (not written or not any(o == "failed" for path in written for _, o, _, _ in cases(path))):
            if not (failed and "rostest" in name):
                yield name, outcome, reason, seconds
        elif outcome == "skipped" and not written:  # left out by run_tests.py; else it could not be run, as while it is being built
            yield name, "skipped" if reason.startswith("other programs") else "failed", reason, seconds


def result_file(program):
    """The file that a program of ctest writes: navvi_sim/live/world writes live.world.xml."""
    return ".".join(program.split("/")[1:] or [program]) + ".xml"


def main():
    words = sys.argv[1:]
    by_time = "--slowest" in words
    ctest, folder = (pathlib.Path(word) for word in words if word != "--slowest")
    found = list(results(ctest, folder))
    if by_time:
        for name, _, _, seconds in sorted(found, key=lambda case: -case[3])[:SLOWEST]:
            print(f"{seconds:7.1f} s  {name}")
        return 0
    count = {"passed": 0, "failed": 0, "skipped": 0}
    for name, outcome, reason, _ in found:
        count[outcome] += 1
        if outcome == "failed":
            print(f"failed: {name}")
            for line in reason.splitlines()[-LINES:]:
                print(f"  {line}")
        elif outcome == "skipped":
            print(f"skipped: {name}{': ' if reason else ''}{reason.splitlines()[0] if reason else ''}")
    skipped = f", {count['skipped']} skipped" if count["skipped"] else ""
    print(f"{count['passed']} passed, {count['failed']} failed{skipped}")
    return 0 if count["passed"] and not count["failed"] else 1


if __name__ == "__main__":
    sys.exit(main())
