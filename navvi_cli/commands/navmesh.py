"""Print a map's mesh in numbers, draw it, and search a path on it.

Exit codes
0: done. 1: no path. 2: a wrong argument, or a map that cannot be read.

Example
./navvi navmesh my_map.bt -o mesh.png --from 1,-9 --to 1,6
"""
import os
import sys

from navvi_cli.arguments import parameter
from navvi_cli.pictures import draw, picture
from navvi_cli.say import fail
from navvi_cli.workspace import show, tool
from navvi_cli.worlds import answer, table

STAGES = ["map", "bake", "mesh", "search", "smooth"]


def map_file(word):
    if os.path.splitext(word)[1] not in (".bt", ".ot", ".yaml"):
        fail(f"\"{word}\" is not a map; files that end in .bt, .ot (OctoMap) and .yaml (map_server) are allowed.", 2)
    return word


def arguments(parser):
    parser.add_argument("map", metavar="MAP", type=map_file, help="an OctoMap (.bt, .ot) or a map_server map (.yaml).")
    parser.add_argument("--csv", action="store_true", help="the numbers as a table for a program.")
    parser.add_argument("-o", dest="picture", metavar="FILE", type=picture, help="draw the map, its mesh, the cylinders and the path, as .svg or .png.")
    parser.add_argument("--from", metavar="X,Y", help="where a path begins; m in map.")
    parser.add_argument("--to", metavar="X,Y", help="where it ends.")
    parser.add_argument("--cylinder", metavar="X,Y,R", action="append", default=[], help="cut a hole around something that moves; m in map.")
    parser.add_argument("--stage", metavar="STAGE", choices=STAGES,
                        help="stop after map, bake, mesh (holes), search (shortest path) or smooth (the default).")
    parser.add_argument("--config", metavar="FILE", help="a .yaml with parameters that differ from the defaults, as in nav_node's config files.")
    parser.add_argument("parameters", nargs="*", default=[], metavar="NAME:=VALUE", type=parameter, help="a single one, as in mesh/climb:=0.1")


def run(args):
    options = {name: value for name, value in vars(args).items() if name in ("from", "to", "stage", "config") and value is not None}
    words = [args.map, *(word for name, value in options.items() for word in (f"--{name}", value)),
             *(word for at in args.cylinder for word in ("--cylinder", at)), *args.parameters]
    program = tool("navvi_nav", "navmesh_tool")
    return draw(args.picture, numbers if args.csv else show, program, *words)


def numbers(program, *words):
    done, found = answer(program, *words)
    if found:
        table(["what", "value"], found.items())
    sys.stderr.write(done.stderr)
    return done.returncode
