#!/usr/bin/env python3
"""Adds up the JUnit files under a folder, names what failed and why, and ends with the line `N passed, N failed`.

Exit code 1 if anything failed, was broken off, or if nothing ran at all.
"""
import pathlib
import sys
import xml.etree.ElementTree as ElementTree


LINES = 20  # the last of a failure's; its log holds all


def cases(folder):
    """Yields (name, outcome, reason) for each test case; a file that cannot be read is a failed case of its own."""
    for path in sorted(pathlib.Path(folder).rglob("*.xml")):
        try:
            root = ElementTree.parse(path).getroot()
        except ElementTree.ParseError as problem:
            yield path.stem, "failed", str(problem)
            continue
        for case in root.iter("testcase"):
            name = f"{case.get('classname', '')}.{case.get('name', '')}"
            wrong = [mark for mark in case if mark.tag in ("failure", "error")]
            if wrong:
                yield name, "failed", (wrong[0].text or wrong[0].get("message") or "").strip()
            elif case.find("skipped") is not None or case.get("status") == "notrun" or case.get("result") == "skipped":
                yield name, "skipped", ""
            else:
                yield name, "passed", ""


def main():
    count = {"passed": 0, "failed": 0, "skipped": 0}
    for name, outcome, reason in cases(sys.argv[1]):
        count[outcome] += 1
        if outcome == "failed":
            print(f"failed: {name}")
            for line in reason.splitlines()[-LINES:]:
                print(f"  {line}")
    skipped = f", {count['skipped']} skipped" if count["skipped"] else ""
    print(f"{count['passed']} passed, {count['failed']} failed{skipped}")
    return 0 if count["passed"] and not count["failed"] else 1


if __name__ == "__main__":
    sys.exit(main())
