"""The one source of usage, help, manual and completion: argparse, in plain lines for a screen reader."""
import argparse
import textwrap

from .places import NAVVI
from .say import fail

WIDTH = 80


class Parser(argparse.ArgumentParser):
    """A sub-command. Its text is a summary, paragraphs, and from "Exit codes" on what stands below its arguments.

    `more_help`, if set, gives further lines on the arguments, such as those of a launch file.
    """

    def __init__(self, text="", **more):
        self.summary, _, rest = (text or "").strip().partition("\n")
        self.body, exits, self.end = textwrap.dedent(rest).strip().partition("Exit codes\n")
        self.end = exits + self.end
        self.more_help = None
        super().__init__(add_help=False, allow_abbrev=False, **more)
        self.add_argument("-h", "--help", action="help", help=argparse.SUPPRESS)

    def shown(self):
        return sorted((action for action in self._actions if action.help != argparse.SUPPRESS), key=lambda action: action.nargs == "*")

    def format_usage(self):
        return " ".join([self.prog, *map(usage_of, self.shown())])

    def format_help(self):
        lines = [line for action in self.shown() for line in help_of(action)] + (self.more_help() if self.more_help else [])
        arguments = "\n".join(textwrap.fill(line, WIDTH, break_on_hyphens=False, break_long_words=False) for line in lines)
        usage = textwrap.fill(self.format_usage().replace("|", "| "), WIDTH, break_on_hyphens=False).replace("| ", "|")
        head = usage + "\n" + self.summary
        parts = [head, self.body.strip(), arguments, self.end.strip()]
        return "\n\n".join(part for part in parts if part).replace("./navvi", NAVVI) + "\n"

    def _check_value(self, action, value):
        if action.choices is not None and value not in action.choices:
            fail(f"\"{value}\" is not allowed here; allowed are: {' '.join(map(str, action.choices))}", 2)

    def error(self, message):
        fail(f"{message.replace('the following arguments are required', 'missing')}; allowed is: {self.format_usage()}", 2)

    def parse_known_args(self, args=None, namespace=None):
        """Options may stand anywhere, and a value may begin with a minus, as in --from -1,2; argparse alone takes neither."""
        options, others, words = [], [], iter(args)
        for word in words:
            action = None if self._subparsers else self._option_string_actions.get(word)
            value = next(words, None) if action and action.nargs is None else None
            options += [] if not action else [word] if value is None else [f"{word}={value}" if word.startswith("--") else word + value]
            others += [] if action else [word]
        found, unknown = super().parse_known_args(options + others, namespace)
        if unknown:
            fail(f"\"{unknown[0]}\" is not taken here; allowed is: {self.format_usage()}", 2)
        return found, unknown


def usage_of(action):
    name = action.metavar or "|".join(action.choices or []) or action.dest
    if isinstance(action, argparse._SubParsersAction):
        return "|".join(action.choices) + " ..."
    if action.option_strings:
        option = action.option_strings[-1] + ("" if action.nargs == 0 else " " + name)
        return option if action.required else f"[{option}]"
    return {"*": f"[{name} ...]", "?": f"[{name}]", "+": f"{name} ..."}.get(action.nargs, name)


def help_of(action):
    if isinstance(action, argparse._SubParsersAction):
        return [f"{parser.format_usage()}: {parser.summary}" for parser in action.choices.values()]
    if not action.help:
        return []
    return [f"{usage_of(action).strip('[]') if action.option_strings else action.metavar or action.dest}: {action.help}"]


def add_actions(parser, **actions):
    """Sub-commands of a sub-command, by name; each is a command as add_command takes it."""
    subparsers = parser.add_subparsers(metavar="ACTION", dest="action", required=True, parser_class=Parser)
    for name, command in actions.items():
        add_command(subparsers, name, command)


def add_command(subparsers, name, command):
    """`command`: a module or class with a docstring (the help), arguments(parser) if it takes any, and run(args) unless actions do."""
    parser = subparsers.add_parser(name, text=command.__doc__)
    if hasattr(command, "run"):
        parser.set_defaults(run=command.run)
    if hasattr(command, "arguments"):
        command.arguments(parser)
    return parser
