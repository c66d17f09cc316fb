"""Finds the sub-command, parses its arguments, runs it, and turns how it ended into an exit code."""
import importlib
import os
import signal
import sys

from .parser import Parser, add_command
from .places import COMMANDS
from .say import Failure, aside, fail


def command_names():
    return sorted(path.stem for path in COMMANDS.glob("[a-z]*.py"))


def load(name):
    return importlib.import_module(f"navvi_cli.commands.{name}")


def parser_of(*names):
    """The whole command, or as much of it as the names need."""
    parser = Parser(prog="./navvi")
    subparsers = parser.add_subparsers(metavar="COMMAND", dest="command", parser_class=Parser)
    for name in names:
        add_command(subparsers, name, load(name))
    parser.commands = subparsers.choices
    return parser


def run(words):
    name = words[0] if words else "help"
    name = {"--help": "help", "-h": "help", "--version": "version"}.get(name, name)
    if name not in command_names():
        fail(f"\"{name}\" is not a sub-command; \"./navvi help\" lists them.", 2)
    args = parser_of(name).parse_args([name, *words[1:]])
    return args.run(args) or 0


def main(words):
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # `./navvi man | head`
    for stream in filter(None, (sys.stdin, sys.stdout)):  # a sign that a terminal sends or lacks ends no session
        stream.reconfigure(errors="replace")
    if "_ARGCOMPLETE" in os.environ:
        import argcomplete
        argcomplete.autocomplete(parser_of(*command_names()))
    try:
        return run(words)
    except Failure as failure:
        if failure.sentence:
            aside(failure.sentence)
        return failure.code
    except OSError as problem:
        aside(f"{problem.filename or 'a file or the output'} cannot be used: {problem.strerror or problem}.")
        return 2
    except ModuleNotFoundError as missing:
        package = f"python3-{str(missing.name).partition('.')[0].lower()}"
        if "navvi" in package:
            raise
        aside(f"this needs the package {package}; \"sudo apt install {package}\" installs it.")
        return 2
    except UnicodeError as problem:
        aside(f"what was given is not in UTF-8, as is needed: {problem}.")
        return 2
    except KeyboardInterrupt:
        aside("stopped by Ctrl-C, before it was done. The same command goes on from here.")
        return 130
    finally:
        sys.stdout.flush()
