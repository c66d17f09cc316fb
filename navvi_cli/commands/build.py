"""Build the workspace.

The first time takes some minutes, later only what changed is built. Every
other command does this, too. While it builds, a line each 10 s tells how
much is done and how long it may still take. The output of the compiler is in
navvi_ws/build.log. Ctrl-C ends it; the next build goes on from there.

Exit codes
0: it is built. 1: it could not be. 2: a wrong argument.
"""
from navvi_cli.say import say
from navvi_cli.workspace import build


def arguments(parser):
    variant = parser.add_mutually_exclusive_group()
    variant.add_argument("--asan", dest="variant", action="store_const", const="--asan",
                         help="build with the address and undefined-behaviour sanitizers.")
    variant.add_argument("--odr", dest="variant", action="store_const", const="--odr",
                         help="only compare the types of all libraries; two that share a name are an error that compilers do not diagnose.")


def run(args):
    build(*([args.variant] if args.variant else []))
    say("the build is done. \"./navvi run\" starts a session.")
