"""Drive a robot through a warehouse by touch, sound and what sight there is.

Each command installs and builds what it needs. "./navvi COMMAND --help" shows
the details of one, "./navvi man" the full manual. Exit codes are 0 for success,
1 where something did not succeed, 2 for a wrong argument, 130 after Ctrl-C (of
replay, robot start, glossary and questionnaire 0, of run and tutorial that of
the trial). For the Tab key: source <(./navvi completion)
"""
from navvi_cli import main


def arguments(parser):
    parser.add_argument("command", nargs="?", metavar="COMMAND", choices=main.command_names(), help="the command whose details are shown.")
    parser.set_defaults(parser=parser)
    parser.more_help = lambda: ["", *(f"{name}: {main.load(name).__doc__.partition(chr(10))[0]}" for name in main.command_names() if name != "help")]


def run(args):
    print(main.parser_of(args.command).commands[args.command].format_help() if args.command else args.parser.format_help(), end="")
