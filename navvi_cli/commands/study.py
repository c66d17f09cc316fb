"""Plan a study, run it with participants, and report it.

doc/study.md shows how, from plan to report.

Exit codes
0: it is done. 1: it broke off, something differs (verify), or other worlds are
recommended (check). 2: a wrong argument, or a wrong plan.
"""
import os
from types import SimpleNamespace

from navvi_cli import places
from navvi_cli.parser import add_actions
from navvi_cli.say import Failure, fail
from navvi_study.actions import ACTIONS, TOOLS
from navvi_study.errors import StudyError


def arguments(parser):
    add_actions(parser, **{name: _guarded(name, action) for name, action in ACTIONS.items()})


def run(args):
    """An action runs instead."""


def _tool(package, name):
    from navvi_cli.workspace import enter, tool
    path = tool(package, name)
    if not path.exists():
        fail(f"{name} is not installed; allowed are \"study check --no-worlds\", or a checkout of NavVI.", 2)
    enter()
    return path


def _accept(parameters):
    from navvi_cli.arguments import LaunchFile, words_for
    from navvi_cli.session import check_parameters, nodes_of
    from navvi_cli.workspace import build, enter, is_current
    try:
        words = words_for(LaunchFile("live.launch"), parameters)
        if not is_current(*nodes_of(words).values()):
            build("session")
        enter()
        check_parameters(words)
    except Failure as problem:
        raise StudyError(problem.sentence or "its parameters cannot be checked, as the build failed.") from None


def _draw(world, words, path, driven=()):
    """Draws a world from above. \\param driven  see maps.world"""
    from navvi_cli import maps
    from navvi_cli.commands.world import verdict_on
    try:
        nav = [word for word in words if word.startswith("nav/")]
        found = verdict_on(world, [word for word in words if word not in nav], nav_words=[word.removeprefix("nav/") for word in nav], drawing=True)
        maps.save(maps.world(found.world, found.caption(), None if found.refusal else found.way, driven), path)
    except Failure as problem:
        raise StudyError(problem.sentence or f"{world} cannot be drawn.") from None


def _guarded(name, action):
    """The action, with the product's programs, and its errors as the command prints them."""
    def guarded(args):
        from navvi_cli.version import version
        from navvi_cli.workspace import shell
        if places.WORKSPACE and name in ("report", "rehearse"):
            shell("install_packages", "report")
        os.umask(0o077)  # what a study holds is its owner's alone
        TOOLS.update(tool=_tool, accept=_accept, version=version, navvi=places.ROOT / "navvi", draw=_draw)
        try:
            return action(args)
        except StudyError as problem:
            fail(str(problem), 2)
        except ModuleNotFoundError as missing:
            fail(f"the report needs the package python3-{missing.name}; \"sudo apt install python3-{missing.name}\" installs it.", 2)

    return SimpleNamespace(__doc__=action.__doc__, arguments=action.arguments, run=guarded)
