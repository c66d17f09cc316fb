"""Show the manual: the help of all commands.

Where there is no terminal, or it is dumb, it is printed as plain lines.

Exit codes
0: shown. 2: a wrong option or file.
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile

from navvi_cli import main
from navvi_cli.say import fail, say


def arguments(parser):
    parser.add_argument("--write", metavar="FILE", help="write it in the form of man instead, such as /usr/local/share/man/man1/navvi.1")


def helps():
    names = main.command_names()
    parsers = main.parser_of("help", *(name for name in names if name != "help")).commands
    return {name: parser.format_help() for name, parser in parsers.items()}


def page():
    lines = [".TH NAVVI 1 \"\" \"NavVI\" \"NavVI\"", ".SH NAME", "navvi \\- drive a robot through a warehouse by touch, sound and what sight there is"]
    for name, text in helps().items():
        text = re.sub(r"^(?=[.'])", r"\\&", text.replace("\\", "\\e").replace("-", "\\-"), flags=re.M)
        lines += [f".SH {name.upper()}", ".in 0", ".nf", text + ".fi"]  # each line of a help stands for itself
    return "\n".join(lines) + "\n"


def plain_terminal():
    return not sys.stdout.isatty() or os.environ.get("TERM", "dumb") == "dumb" or os.environ.get("ACCESSIBLE") or os.environ.get("NO_COLOR")


def run(args):
    if args.write:
        try:
            with open(args.write, "w") as file:
                file.write(page())
        except OSError as problem:
            fail(f"\"{args.write}\" cannot be written: {problem.strerror}; name a place that can be, such as /tmp/navvi.1.", 2)
        say(f"the manual is in {args.write}; man -l {args.write} shows it.")
    elif plain_terminal() or not shutil.which("man"):
        print("\n".join(helps().values()))
    else:
        with tempfile.NamedTemporaryFile("w", suffix=".1") as file:
            file.write(page())
            file.flush()
            subprocess.run(["man", "-l", file.name])
