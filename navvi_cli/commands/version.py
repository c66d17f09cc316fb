"""Print the version, and the commit of a checkout.

Exit codes
0: printed.
"""
from navvi_cli.version import version


def run(args):
    print(f"navvi {version()}")
