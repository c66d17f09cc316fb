"""Print what makes bash or zsh complete words with the Tab key.

In bash or zsh, once a terminal (or in ~/.bashrc or ~/.zshrc):
source <(./navvi completion)
source <(./navvi completion zsh)

Then Tab completes commands, names of arguments and some of their values.

Exit codes
0: printed. 1: the package python3-argcomplete of Debian is missing. 2: a wrong
argument.
"""
from navvi_cli.places import ROOT
from navvi_cli.say import fail


def arguments(parser):
    parser.add_argument("shell", metavar="SHELL", nargs="?", choices=["bash", "zsh"], default="bash", help="bash, the default, or zsh.")


def run(args):
    try:
        import argcomplete
    except ImportError:
        fail("completion needs the package python3-argcomplete of Debian; \"apt install python3-argcomplete\" installs it, as root.")
    if args.shell == "zsh":
        print("(( $+functions[compdef] )) || { autoload -U compinit && compinit -i; }; autoload -U bashcompinit && bashcompinit")
    print(argcomplete.shellcode(["./navvi", "navvi", str(ROOT / "navvi")], shell="bash"))
