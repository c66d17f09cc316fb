#!/usr/bin/python3
"""Whether the tests notice a fault: changes sources one place at a time and runs the tests of their package.

    test/mutants.py navvi_safety/src/command_gate.cpp ... [--filter=GTEST_FILTER] [--jobs=2]
    test/mutants.py navvi_study/python/navvi_study/verify.py ... --tests=study_table_test.py,study_plan_test.py
    test/mutants.py navvi_safety/src/relay_node.cpp ... --program=lib/navvi_safety/relay_node --run="rostest navvi_safety relay_node.test" --jobs=1

Of a header, all sources of its package that include it are compiled anew. With --program, the changed source is linked into that program of the
devel space, which is put back later. Needs a built workspace with tests. Prints each change that no test noticed, and last "N of M noticed".
"""
import argparse
import ast
import concurrent.futures
import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

WORKSPACE = Path(__file__).resolve().parent.parent / "navvi_ws"
SWAPS = [(r"&&", "||"), (r"\|\|", "&&"), (r" >= ", " < "), (r" <= ", " > "), (r" > ", " <= "), (r" < (?=[\w(])", " >= "), (r"==", "!="), (r"!=", "=="),
         (r"\bif \((?!const )(?=.*\)[ ;{]|.*\)$)", "if (!"), (r"\btrue\b", "false"), (r"\bfalse\b", "true"), (r"std::max\b", "std::min"),
         (r"std::min\b", "std::max"), (r" - (?=[\w(])", " + "), (r"std::clamp\(", "[](auto all, auto, auto) { return all; }("), (r"std::abs\(", "("),
         (r"(?<=[( ])!(?=[\w(])", "")]
FLIPPED = {ast.Lt: ast.GtE, ast.GtE: ast.Lt, ast.Gt: ast.LtE, ast.LtE: ast.Gt, ast.Eq: ast.NotEq, ast.NotEq: ast.Eq, ast.In: ast.NotIn, ast.NotIn: ast.In,
           ast.Is: ast.IsNot, ast.IsNot: ast.Is, ast.And: ast.Or, ast.Or: ast.And, ast.Sub: ast.Add}
LONGEST = 5  # times as long as without a change the tests may take: what makes them endless is noticed


def mutants(source, text):
    """(line, what became of it, text): comparisons turned round, limits ten times as high, statements left out."""
    if source.suffix == ".py":
        yield from python_mutants(text)
        return
    lines = text.split("\n")
    for number, changed in changed_lines(lines):
        yield number, changed, "\n".join(lines[:number] + [changed] + lines[number + 1:])


def python_mutants(text):
    nodes = list(ast.walk(ast.parse(text)))
    for place, node in enumerate(nodes):
        for at in range(len(changes(node))):
            tree = ast.parse(text)
            changed = list(ast.walk(tree))[place]
            line = changes(changed)[at]()
            yield (line or changed.lineno) - 1, "left out, or not so" if line else ast.unparse(changed).splitlines()[0], ast.unparse(ast.fix_missing_locations(tree))


def changes(node):
    """Functions that change it; they return its line where it is not the node's own."""
    def put(name, value):
        return lambda: setattr(node, name, value)

    def leave_out(body, at):
        line = body[at].lineno
        body[at] = ast.Pass()
        return line

    def negate(tests, at):
        line = tests[at].lineno
        tests[at] = ast.UnaryOp(ast.Not(), tests[at])
        return line
    found = []
    if isinstance(node, ast.Compare):
        found += [lambda: node.ops.__setitem__(0, FLIPPED[type(node.ops[0])]())]
    if type(getattr(node, "op", None)) in FLIPPED:
        found += [put("op", FLIPPED[type(node.op)]())]
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not):
        found += [put("operand", ast.UnaryOp(ast.Not(), node.operand))]
    if hasattr(node, "test") and not isinstance(node.test, (ast.Compare, ast.UnaryOp)):
        found += [put("test", ast.UnaryOp(ast.Not(), node.test))]
    if isinstance(node, ast.comprehension):
        found += [lambda at=at: negate(node.ifs, at) for at in range(len(node.ifs)) if not isinstance(node.ifs[at], (ast.Compare, ast.UnaryOp))]
    if isinstance(node, ast.Constant) and isinstance(node.value, bool):
        found += [put("value", not node.value)]
    for body in (getattr(node, "body", []), getattr(node, "orelse", []), getattr(node, "finalbody", [])):
        found += [lambda body=body, at=at: leave_out(body, at) for at, one in enumerate(body if isinstance(body, list) else [])
                  if isinstance(one, (ast.Raise, ast.AugAssign)) or isinstance(one, ast.Expr) and isinstance(one.value, ast.Call)
                  or isinstance(one, ast.Assign) and isinstance(one.targets[0], ast.Attribute)]
    return found


def changed_lines(lines):
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
        limit = re.match(r"(\s*(?:static )?(?:constexpr )?(?:double|int|off_t|std::\w+) \w+ = )(\d*\.?\d*[1-9]\d*);", code)
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
    """The tests of a package, or a program that they start, linked anew with objects changed."""

    def __init__(self, source, words):
        self.source, self.package, self.words = source, source.relative_to(WORKSPACE / "src").parts[0], words
        self.build, self.program = WORKSPACE / "build", f"{self.package}/{self.package}_tests"
        if words.program:
            self.program = str(WORKSPACE / "devel" / words.program)
        commands = subprocess.run(["ninja", "-C", str(self.build), "-t", "commands", self.program], capture_output=True, text=True, check=True).stdout.splitlines()
        sources = [source]
        if source.suffix == ".hpp":
            headers, before = {source}, 0
            while before < (before := len(headers)):
                headers |= set(including(headers, self.package, "*.hpp"))
            sources = including(headers, self.package, "*.cpp")
        self.compile = {path: shlex.split(line.replace("ccache ", "")) for path in sources for line in commands if f" -c {path}" in line}
        self.link = next(line for line in reversed(commands) if f"-o {self.program} " in line or f",{self.program} " in line)

    def notice(self, text):
        """Whether a test fails; None where the compiler refuses it."""
        with tempfile.TemporaryDirectory() as folder:
            link = self.link
            for at, (path, words) in enumerate(self.compile.items()):
                if (made := self.made(f"{folder}/{at}.o", path, list(words), text)) is None:
                    return None
                # What is not of a library stands in the line.
                link = link.replace(f" {made} ", f" {folder}/{at}.o ") if f" {made} " in link else re.sub(r"(/usr/bin/\S+\+\+) ", rf"\1 {folder}/{at}.o ", link, 1)
            link = re.sub(rf"-o {re.escape(self.program)} ", f"-o {folder}/tests ", link)
            link = re.split(r" && (?=/usr/bin/cmake|cd )", link)[0].removeprefix(": && ")
            linked = subprocess.run(f"{link} -fuse-ld=gold -Wl,-S", shell=True, cwd=self.build, capture_output=True, text=True)
            if linked.returncode:
                sys.exit(f"{self.package}: the tests cannot be linked: {linked.stderr[-400:]}")
            if not self.words.program:
                return fails([f"{folder}/tests", "--gtest_brief=1", f"--gtest_filter={self.words.filter}", "--gtest_fail_fast"], self.build / self.package, self.words.limit)
            kept = shutil.copy2(self.program, f"{folder}/kept")
            try:
                os.replace(shutil.copy2(f"{folder}/tests", self.program + ".new"), self.program)
                return fails(shlex.split(self.words.run), WORKSPACE.parent / "test", self.words.limit)
            finally:
                os.replace(shutil.copy2(kept, self.program + ".new"), self.program)

    def made(self, to, path, words, text):
        """The object as it was, once another one is compiled."""
        folder = Path(to).parent
        made = words[words.index("-o") + 1]
        words[words.index("-o") + 1] = to
        words = drop([word for word in words if word != "-Werror"] + ["-w"], "-MF")  # as optimized as the precompiled headers are
        if path != self.source:
            changed = folder / re.fullmatch(r".*/(?:include|src)/(.*)", str(self.source))[1]
            words[1:1] = [f"-I{folder}"]
        else:
            changed = folder / path.name
            words = [str(changed) if word == str(path) else word for word in words]
            words[1:1] = ["-iquote", str(path.parent)]
        changed.parent.mkdir(parents=True, exist_ok=True)
        changed.write_text(text)
        return None if subprocess.run(words, cwd=self.build, capture_output=True).returncode else made


class Pytest:
    """Files of Python tests that find the changed module in a copy of its package."""

    def __init__(self, source, words):
        self.source, self.words = source, words
        self.root = WORKSPACE / "src" / source.relative_to(WORKSPACE / "src").parts[0]

    def notice(self, text):
        with tempfile.TemporaryDirectory() as folder:
            copy = Path(folder) / self.root.name
            shutil.copytree(self.root, copy, ignore=shutil.ignore_patterns("src", "include"))
            (copy / self.source.relative_to(self.root)).write_text(text)
            begin = f"import sys; sys.path[:0] = ['{copy}/python']; import {self.root.name}, pytest; sys.exit(pytest.main())"
            return fails([sys.executable, "-c", begin, "-xq", "-p", "no:cacheprovider", f"--basetemp={folder}/tests", *self.words.tests.split(","), *self.words.pytest],
                         WORKSPACE.parent / "test", self.words.limit)


def fails(words, folder, limit):
    with subprocess.Popen(words, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True) as process:
        try:
            return process.wait(limit) != 0
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            return True


def including(headers, package, pattern):
    names = re.compile("|".join(rf"[/\"]{header.name}[\">]" for header in headers))
    return [path for path in (WORKSPACE / "src" / package).rglob(pattern) if names.search(path.read_text())]


def drop(words, option):
    if option not in words:
        return words
    place = words.index(option)
    return words[:place] + words[place + 2:]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("sources", nargs="+", help="below navvi_ws/src")
    parser.add_argument("--filter", default="*", help="of the tests, as --gtest_filter has it")
    parser.add_argument("--program", default="", help="of the devel space, which --run starts")
    parser.add_argument("--run", default="", help="a command that fails where the program is at fault")
    parser.add_argument("--tests", default="", help="files of Python tests")
    parser.add_argument("--pytest", action="append", default=[], help="a word for pytest")
    parser.add_argument("--lines", type=lambda text: set(map(int, text.split(","))), help="these alone, such as 9,71")
    parser.add_argument("--jobs", type=int, default=2)
    words = parser.parse_args()
    signal.signal(signal.SIGINT, signal.default_int_handler)  # a background job's tests would ignore it
    noticed = counted = 0
    for name in words.sources:
        source = (WORKSPACE / "src" / name).resolve()
        tests, text = (Pytest if source.suffix == ".py" else Tests)(source, words), source.read_text()
        words.limit, begun = None, time.monotonic()
        if tests.notice(text) is not False:
            sys.exit(f"{name}: the tests fail as it is.")
        words.limit = 20.0 + LONGEST * (time.monotonic() - begun)
        lines = text.split("\n")
        all_of_it = [one for one in mutants(source, text) if not words.lines or one[0] + 1 in words.lines]
        with concurrent.futures.ThreadPoolExecutor(words.jobs) as pool:
            for (number, changed, _), result in zip(all_of_it, pool.map(tests.notice, [text for _, _, text in all_of_it])):
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
