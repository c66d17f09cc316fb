"""List worlds, check one, or draw it.

The names are those of sim_node's parameters, such as seed:=3, and for a layout
also its own, such as length:=80; "./navvi parameters" lists them all.

Exit codes
0: done. 2: the world is rejected, or no way leads from start to goal, and
why; or a wrong argument.
"""
from navvi_cli.arguments import parameter
from navvi_cli.parser import add_actions
from navvi_cli.pictures import draw, picture
from navvi_cli.say import say
from navvi_cli.workspace import show, tool
from navvi_cli.worlds import Verdict, names, points, table

WORLD_TOOL = "navvi_sim", "world_tool"


def arguments(parser):
    add_actions(parser, list=List, check=Check, show=Show)


def world_arguments(parser):
    parser.add_argument("world", metavar="NAME|FILE", help="the world; \"./navvi world list\" lists the names.").completer = (
        lambda **_: names())
    parser.add_argument("--config", metavar="CONFIG.yaml", help="parameters, as in the config files of sim_node.")
    parser.add_argument("words", nargs="*", default=[], metavar="name:=value", help="parameters, such as seed:=3.", type=parameter)


def words_of(args):
    return [*args.words, *(["--config", args.config] if args.config else [])]


def verdict(args, octomap=None):
    tool(*WORLD_TOOL), tool("navvi_nav", "navmesh_tool")
    return Verdict(args.world, words_of(args), octomap=octomap)


class List:
    """List the worlds that have a name."""

    def arguments(parser):
        parser.add_argument("--csv", action="store_true", help="as a table for a program.")

    def run(args):
        tool(*WORLD_TOOL)
        if args.csv:
            table(["name", "meaning"], names().items())
        else:
            print("\n".join(f"{name}: {meaning}" for name, meaning in names().items()))


class Check:
    """Print what is in a world, and how far a session leads from start to goal."""

    def arguments(parser):
        world_arguments(parser)
        parser.add_argument("--csv", action="store_true", help="as a table for a program.")
        parser.add_argument("-o", dest="octomap", metavar="FILE", help="saves its OctoMap, .bt or .ot.")

    def run(args):
        found = verdict(args, args.octomap)
        if not args.csv:
            print(found.sentences, end="", flush=True)
        found.require()
        way = {name: found.way[name] for name in ("shortest way m", "guide path m")}
        if args.csv:
            table(["what", "value"], {**found.world, **{name: round(value, 1) for name, value in way.items()}}.items())
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
        found = verdict(args)
        guide = [] if found.refusal else ["--path", points(found.way["path"]), "--turns", points(found.way["turns"])]
        status = draw(args.picture, show, tool(*WORLD_TOOL), "show", args.world, *words_of(args), *guide)
        if found.refusal:
            say(found.refusal)
        return status
