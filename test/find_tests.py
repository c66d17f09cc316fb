#!/usr/bin/env python3
"""Prints the programs of ctest that hold a test case in whose name a pattern is found, one a line.

find_tests.py PATTERN: from the sources, so that nothing has to be built before a wrong word is rejected. Exit code 1 if neither a case nor
a program has that name.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
CASE = re.compile(r"^TEST(?:_[FP])?\(\s*(\w+),\s*(\w+)\s*\)", re.MULTILINE)
SYSTEM_CASE = re.compile(r"^ *def (test_\w+)|^ *ids=\[(.*)\]|, ids=\[(.*)\]", re.MULTILINE)


def programs(word, root=ROOT):
    for file in sorted((root / "navvi_ws/src").glob("*/src/**/*_test.cpp")):
        if any(re.search(word, f"{suite}.{name}") for suite, name in CASE.findall(file.read_text())):
            package, _, *rooms = file.relative_to(root / "navvi_ws/src").parts
            yield f"{package}/{'/'.join(rooms)}".removesuffix("_test.cpp")
    for file in sorted((root / "navvi_ws/src").glob("*/test/*_node_test.cpp")):
        if any(re.search(word, f"{suite}.{name}") for suite, name in CASE.findall(file.read_text())):
            for launch in sorted(file.parent.glob(f"{file.name.removesuffix('_test.cpp')}*.test")):
                yield f"_ctest_{file.parent.parent.name}_rostest_test_{launch.name}"
    for file in sorted((root / "test").glob("*_test.py")):
        if any(re.search(word, "".join(names)) for names in SYSTEM_CASE.findall(file.read_text())):
            yield file.name.removesuffix("_test.py")


if __name__ == "__main__":
    found = list(programs(sys.argv[1]))
    print("\n".join(found))
    sys.exit(not found and not any(re.search(sys.argv[1], name) for name in programs("")))
