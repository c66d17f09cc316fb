"""List worlds, check one, or draw it.

The names are those of sim_node's parameters, such as seed:=3, and for a layout
also its own, such as length:=80; "./navvi parameters" lists them all.

Exit codes
0: done. 2: the world is rejected, or no way leads from start to goal, and
why; or a wrong argument.
"""
from pathlib import Path

from navvi_cli.arguments import parameter
from navvi_cli.parser import add_actions
from navvi_cli.say import fail, say
from navvi_cli.workspace import tool
from navvi_cli.worlds import Verdict, names, picture, table


def arguments(parser):
    add_actions(parser, list=List, check=Check, show=Show)


def world_arguments(parser):
    parser.add_argument("world", metavar="NAME|FILE", help="the world; \"./navvi world list\" lists the names.").completer = (
        lambda **_: names())
    parser.add_argument("--config", metavar="CONFIG.yaml", help="parameters, as in the config files of sim_node.")
    parser.add_argument("words", nargs="*", default=[], metavar="name:=value", help="parameters, such as seed:=3.", type=parameter)


def octomap(word):
    if Path(word).suffix not in (".bt", ".ot"):
        fail(f"\"{word}\" is not an OctoMap; .bt and .ot are allowed.", 2)
    return word


def verdict_on(world, words, **more):
    tool("navvi_sim", "world_tool"), tool("navvi_nav", "navmesh_tool")
    return Verdict(world, words, **more)


def verdict(args, **more):
    return verdict_on(args.world, [*args.words, *([f"config:={args.config}"] if args.config else [])], **more)


class List:
    """List the worlds that have a name."""

    def arguments(parser):
        parser.add_argument("--csv", action="store_true", help="as a table for a program.")

    def run(args):
        tool("navvi_sim", "world_tool")
        if args.csv:
            table(["name", "meaning"], names().items())
        else:
            print("\n".join(f"{name}: {meaning}" for name, meaning in names().items()))


class Check:
    """Print what is in a world, and how far a session leads from start to goal."""

    def arguments(parser):
        world_arguments(parser)
        parser.add_argument("--csv", action="store_true", help="as a table for a program.")
        parser.add_argument("-o", dest="octomap", metavar="FILE", type=octomap, help="saves its OctoMap, .bt or .ot.")

    def run(args):
        found = verdict(args, octomap=args.octomap)
        if not args.csv:
            print("\n".join(found.sentences()), flush=True)
        found.require()
        way = {name: round(found.way[name], 1) for name in ("shortest way m", "guide path m")}
        if args.csv:
            facts = ("world", "seed", "world hash", "floor z m", "start x m, y m, yaw rad", "goal x m, y m")
            table(["what", "value"], {**found.world["counts"], **{name: found.world[name] for name in facts}, **way}.items())
        else:
            print("\n".join(f"{name[:-2]} {value:.1f} m" for name, value in way.items()))


class Show:
    """Draw a world from above.

    The picture has start, goal, the path that a person is led along with the
    turns that are said, and the routes of what moves.
    """

    def arguments(parser):
        world_arguments(parser)
        parser.add_argument("-o", dest="picture", metavar="FILE", type=picture, help="the picture, .svg or .png; NAME.svg by default.")

    def run(args):
        from navvi_cli import maps
        path = args.picture or Path(Path(args.world).stem + ".svg")
        found = verdict(args, drawing=True)
        maps.save(maps.world(found.world, found.caption(), None if found.refusal else found.way), path)
        print("\n".join(found.sentences()), flush=True)
        say(f"the picture is in {path}.")
        if found.refusal:
            say(found.refusal)
