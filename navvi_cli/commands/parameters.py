"""List the parameters of all nodes: meaning, default, what is allowed.

Each can be given to a session, as in
./navvi run feedback/speaker/rate:=300

Exit codes
0: listed. 2: a wrong argument.
"""
import csv
import json
import subprocess
import sys

from navvi_cli.places import DEVEL
from navvi_cli.say import fail
from navvi_cli.workspace import build, is_current

COLUMNS = ["parameter", "default", "allowed", "meaning"]


def arguments(parser):
    parser.add_argument("filter", nargs="?", default="", metavar="FILTER",
                        help="a node, such as feedback, or else a word of the parameters to list, such as turn.")
    parser.add_argument("--csv", action="store_true", help="as a table for a program.")


def programs():
    return sorted(path for name in ("*_node", "cue_player", "world_tool") for path in (DEVEL / "lib").glob(f"navvi_*/{name}"))


def run(args):
    if not programs() or not is_current(*programs()):
        build()
    nodes = [node for node in programs() if args.filter in node.name]
    rows_of = {node: rows for node in nodes or programs() if (rows := rows_in(node, "" if nodes else args.filter))}
    if not rows_of:
        fail(f"\"{args.filter}\" is in no parameter; allowed are words of these, and parts of: {' '.join(node.name for node in programs())}", 2)
    table = csv.writer(sys.stdout, lineterminator="\n")
    if args.csv:
        table.writerow(["node", *COLUMNS])
    for node, rows in rows_of.items():
        if args.csv:
            table.writerows([node.name, *(row[column] for column in COLUMNS)] for row in rows)
        else:
            print("\n".join(["", node.name, *map(sentence, rows)]))


def rows_in(node, word):
    """That have the word in their name or meaning."""
    rows = json.loads(subprocess.run([str(node), "--parameters"], check=True, stdout=subprocess.PIPE).stdout)
    return [row for row in rows if word.lower() in f"{row['parameter']} {row['meaning']}".lower()]


def sentence(row):
    return f"{row['parameter']}: {row['meaning']}. It is {row['default'] or 'empty'}; allowed: {row['allowed'] or 'a text'}."
