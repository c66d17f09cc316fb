"""The house is as its plan says: rooms include only the rooms that CMakeLists.txt names, and never one above them."""
import re

import pytest

from sessions import ROOT

SOURCES = ROOT / "navvi_ws/src"
PACKAGES = sorted(path.parent.name for path in SOURCES.glob("*/CMakeLists.txt") if "navvi_room(" in path.read_text())
MOST_ARROWS = {"navvi_nav": 30, "navvi_sim": 42}


def rooms_of(package):
    """The rooms in the order of CMakeLists.txt, each with the rooms that it may use."""
    text = re.sub(r"#.*", "", (SOURCES / package / "CMakeLists.txt").read_text())
    rooms = {}
    for body in re.findall(r"navvi_room\(([^()]*(?:\$<[^>]*>[^()]*)*)\)", text):
        words = body.split()
        used, mode = [], None
        for word in words[1:]:
            if word.isupper():
                mode = word
            elif mode == "USES":
                used.append(word)
        rooms[words[0]] = used
    return rooms


def files_of(package):
    """Product files of the rooms: (room, path)."""
    folder = SOURCES / package
    for path in sorted([*folder.glob("src/*/*.[ch]pp"), *folder.glob(f"include/{package}/*/*.hpp")]):
        if not path.name.endswith("_test.cpp"):
            yield path.parent.name, path


def included_by(package, path):
    """The rooms of the package whose headers a file includes."""
    rooms = rooms_of(package)
    for name in re.findall(rf'#include [<"](?:{package}/)?([a-z_]+)/[a-z_0-9]+\.hpp[>"]', path.read_text()):
        if name in rooms:
            yield name


def arrows_of(package):
    return {(room, other) for room, path in files_of(package) for other in included_by(package, path) if other != room}


@pytest.mark.parametrize("package", PACKAGES)
def test_a_room_includes_the_rooms_that_it_says_it_uses_and_no_others(package):
    assert arrows_of(package) == {(room, used) for room, uses in rooms_of(package).items() for used in uses}


@pytest.mark.parametrize("package", PACKAGES)
def test_a_room_uses_only_rooms_below_it(package):
    floors = list(rooms_of(package))
    upward = [f"{room} -> {used}" for room, uses in rooms_of(package).items() for used in uses
              if floors.index(used) >= floors.index(room)]
    assert not upward


@pytest.mark.parametrize("package", sorted(MOST_ARROWS))
def test_a_large_package_stays_easy_to_draw(package):
    assert len(arrows_of(package)) <= MOST_ARROWS[package]


@pytest.mark.parametrize("package", PACKAGES)
def test_a_header_is_public_only_if_another_package_needs_it(package):
    public = {f"{path.parent.name}/{path.name}": path for path in (SOURCES / package / "include" / package).glob("*/*.hpp")}
    pattern = re.compile(rf'#include [<"]{package}/([a-z_]+/[a-z_0-9]+\.hpp)[>"]')
    needed = set()
    for other in SOURCES.iterdir():
        if other.name != package:
            for path in other.rglob("*.[ch]pp"):
                needed |= set(pattern.findall(path.read_text()))
    seen = set()
    while needed - seen:
        name = (needed - seen).pop()
        seen.add(name)
        if name in public:
            needed |= set(pattern.findall(public[name].read_text()))
    assert sorted(set(public) - needed) == []


@pytest.mark.parametrize("package", PACKAGES)
def test_a_room_has_a_namespace_of_its_own(package):
    strangers = []
    for room, path in files_of(package):
        names = set(re.findall(rf"^namespace ({package}(?:::[a-z_]+)?) \{{", path.read_text(), re.M))
        own = {package} if room == "description" else {f"{package}::{room}"}
        if names and not own <= names <= own | {package}:
            strangers.append(f"{room}/{path.name}: {sorted(names)}")
    assert strangers == []


def test_each_file_of_tests_is_in_one_tier():
    text = (SOURCES / "navvi" / "CMakeLists.txt").read_text()
    named = [name for names in re.findall(r"navvi_system_tests\(\w+ ([^)$]*)\)", text) for name in names.split()]
    there = [path.name.removesuffix("_test.py") for path in (ROOT / "test").glob("*_test.py")]
    assert sorted(named) == sorted(there)


def test_a_prefix_of_pkg_config_means_the_same_modules_in_all_packages():
    """All packages share one CMake cache: with two meanings, the second configuration gives one package what another asked for."""
    meanings = {}
    for path in SOURCES.glob("*/CMakeLists.txt"):
        for prefix, words in re.findall(r"pkg_(?:check_modules|search_module)\((\w+) ([^)]*)\)", path.read_text()):
            meanings.setdefault(prefix, set()).add(tuple(word for word in words.split() if not word.isupper()))
    assert [prefix for prefix, modules in meanings.items() if len(modules) > 1] == []
