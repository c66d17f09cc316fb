#!/usr/bin/python3
"""Whether the tests notice a fault: changes sources one place at a time and runs the tests of their package.

    test/mutants.py navvi_safety/src/command_gate.cpp ... [--filter=GTEST_FILTER] [--jobs=2]

Needs a built workspace with tests. Prints each change that no test noticed, and last "N of M noticed".
"""
import argparse
import concurrent.futures
import os
import re
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path

WORKSPACE = Path(__file__).resolve().parent.parent / "navvi_ws"
SWAPS = [(r"&&", "||"), (r"\|\|", "&&"), (r" >= ", " < "), (r" <= ", " > "), (r" > ", " <= "), (r" < (?=[\w(])", " >= "), (r"==", "!="), (r"!=", "=="),
         (r"\bif \((?!const )(?=.*\)[ ;{]|.*\)$)", "if (!"), (r"\btrue\b", "false"), (r"\bfalse\b", "true"), (r"std::max\b", "std::min"),
         (r"std::min\b", "std::max"), (r" - (?=[\w(])", " + ")]
LONGEST = 60  # s, of the tests: what makes them endless is noticed


def mutants(text):
    """(line, what became of it, text): comparisons turned round, limits ten times as high, statements left out."""
    lines = text.split("\n")
    for number, line in enumerate(lines):
        code = line.split("//")[0]
        if not code.strip() or code.lstrip().startswith(("#", "visit(", "\"", "template", "using", "namespace")):
            continue
        for pattern, to in SWAPS:
            for found in re.finditer(pattern, code):
                changed = code[:found.start()] + to + code[found.end():]
                if to == "if (!":
                    changed = code[:found.start()] + negated(code[found.start():])
                if changed != code:
                    yield number, changed
        limit = re.match(r"(\s*constexpr \w+ k\w+ = )([\d.]+);", code)
        if limit:
            yield number, f"{limit[1]}10 * {limit[2]};"
        elif re.fullmatch(r"\s+(\+\+)?[\w.>\-]+(\(.*\)| [+\-*]?= .*)?;", code) and not re.match(r"\s*(return|const|auto|break|continue|double|int|bool)\b", code):
            yield number, re.match(r"\s*", code)[0] + ";"


def negated(code):
    """A line that begins with "if (": its condition is turned round, where it ends on the line."""
    depth = 0
    for place, letter in enumerate(code):
        depth += (letter == "(") - (letter == ")")
        if letter == ")" and depth == 0:
            return f"if (!{code[3:place + 1]}){code[place + 1:]}"
    return code


class Tests:
    """The tests of a package, linked anew with one object changed."""

    def __init__(self, source, only):
        self.source, self.package = source, source.relative_to(WORKSPACE / "src").parts[0]
        self.build = WORKSPACE / "build"
        program = f"{self.package}/{self.package}_tests"
        commands = subprocess.run(["ninja", "-C", str(self.build), "-t", "commands", program], capture_output=True, text=True, check=True).stdout.splitlines()
        self.compile = shlex.split(next(line for line in commands if f" -c {source}" in line).replace("ccache ", ""))
        self.link = next(line for line in reversed(commands) if f"-o {program}" in line)
        self.program, self.filter = program, only

    def notice(self, text):
        """Whether a test fails, or the compiler refuses it (None)."""
        with tempfile.TemporaryDirectory() as folder:
            changed = self.source.with_name(f".{self.source.stem}-{os.path.basename(folder)}.cpp")
            changed.write_text(text)
            try:
                words = [str(changed) if word == str(self.source) else word for word in self.compile]
                words[words.index("-o") + 1] = f"{folder}/changed.o"
                words = [word for word in words if word != "-Werror"] + ["-w", "-O0"]
                words = drop(words, "-MF")
                if subprocess.run(words, cwd=self.build, capture_output=True).returncode:
                    return None
            finally:
                changed.unlink()
            link = re.sub(rf"-o {re.escape(self.program)}\b", f"-o {folder}/tests {folder}/changed.o", self.link)
            link = re.split(r" && (?=/usr/bin/cmake|cd )", link)[0].removeprefix(": && ")
            made = subprocess.run(link, shell=True, cwd=self.build, capture_output=True, text=True)
            if made.returncode:
                sys.exit(f"{self.package}: the tests cannot be linked: {made.stderr[-400:]}")
            words = [f"{folder}/tests", "--gtest_brief=1", f"--gtest_filter={self.filter}", "--gtest_fail_fast"]
            try:
                return subprocess.run(words, cwd=self.build / self.package, capture_output=True, timeout=LONGEST).returncode != 0
            except subprocess.TimeoutExpired:
                return True


def drop(words, option):
    if option not in words:
        return words
    place = words.index(option)
    return words[:place] + words[place + 2:]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("sources", nargs="+", help="below navvi_ws/src")
    parser.add_argument("--filter", default="*", help="of the tests, as --gtest_filter has it")
    parser.add_argument("--jobs", type=int, default=2)
    words = parser.parse_args()
    noticed = counted = 0
    for name in words.sources:
        source = (WORKSPACE / "src" / name).resolve()
        tests, text = Tests(source, words.filter), source.read_text()
        if tests.notice(text) is not False:
            sys.exit(f"{name}: the tests fail as it is.")
        lines, all_of_it = text.split("\n"), list(mutants(text))
        texts = ["\n".join(lines[:number] + [changed] + lines[number + 1:]) for number, changed in all_of_it]
        with concurrent.futures.ThreadPoolExecutor(words.jobs) as pool:
            for (number, changed), result in zip(all_of_it, pool.map(tests.notice, texts)):
                if result is None:
                    continue
                counted += 1
                noticed += result
                if not result:
                    print(f"{name}:{number + 1}: {lines[number].strip()}  ->  {changed.strip()}", flush=True)
    print(f"{noticed} of {counted} noticed")
    return noticed < counted


if __name__ == "__main__":
    sys.exit(main())
