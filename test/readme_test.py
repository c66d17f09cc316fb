"""The documents agree with the code: topics, functions, rooms, commands, links."""
import ast
import re
import subprocess
import sys

import pytest
from PIL import Image

import find_tests
from rooms_test import PACKAGES as ROOMS, SOURCES, rooms_of
from sessions import ROOT, script

CODE = "\n".join(path.read_text() for path in SOURCES.rglob("*.[ch]pp"))


def topic_rows():
    """The cells of each row that begins with a topic."""
    text = (ROOT / "doc/topics.md").read_text()
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in text.splitlines() if line.startswith("| /")]


def bodies_of_classes():
    found = {}
    for match in re.finditer(r"^(?:class|struct) (\w+)[^;{]*{", CODE, re.M):
        found.setdefault(match[1], []).append(CODE[match.end():CODE.find("\n};", match.end())])
    return found


CLASSES = bodies_of_classes()


def exists(name):
    """A class, a function, or a member of just this class."""
    owner, _, member = name.rpartition("::")
    if not owner:
        return bool(re.search(rf"{member}\b", CODE))
    return f"{owner}::{member}(" in CODE or any(re.search(rf"\b{member}(\(|;| = )", body) for body in CLASSES.get(owner, []))


def test_every_function_of_the_topic_tables_exists():
    rows = topic_rows()
    assert all(len(row) == 5 for row in rows)
    names = {name for row in rows for cell in row[3:] for name in re.findall(r"`([A-Za-z_:]+)`", cell)}
    assert len(names) > 20
    assert sorted(name for name in names if not exists(name)) == []
    assert not exists("Planner::fly") and not exists("Outlets::diagnose")


def test_every_member_of_a_class_that_a_document_names_exists():
    names = {(page.name, name) for page in PAGES if page.name != "CHANGELOG.md" for name in re.findall(r"`([A-Z]\w+::\w+)`", page.read_text())}
    assert len(names) > 60
    assert sorted((page, name) for page, name in names if not exists(name)) == []


def test_every_topic_of_the_table_is_named_in_the_code():
    topics = {topic for row in topic_rows() for topic in re.findall(r"/([a-z_/]+)", row[0])}
    missing = [topic for topic in topics if topic not in ("tf", "tf_static") and f'"{topic}"' not in CODE and f'"/{topic}"' not in CODE]
    assert sorted(missing) == []


def test_every_topic_that_a_node_publishes_is_in_one_row():
    rows = [topic for row in topic_rows() for topic in re.findall(r"/([a-z_/]+)", row[0])]
    assert sorted(set(rows)) == sorted(rows)
    product = "\n".join(path.read_text() for path in SOURCES.glob("*/src/**/*.cpp") if not path.name.endswith("_test.cpp"))
    published = set(re.findall(r'advertise<[\w:]+>\(\s*"/?([a-z_/]+)"', product))
    assert len(published) > 25
    assert sorted(published - set(rows) - {"cmd_vel"}) == []


def test_rostopic_can_show_every_topic():
    text = (ROOT / "doc/topics.md").read_text()
    types = set(re.findall(r"\b([a-z0-9_]+_msgs)/([A-Z][A-Za-z0-9]+)", text)) - {("nav_msgs", "GetPlan")}  # a service
    assert len(types) > 20
    assert ("tf2_msgs", "TFMessage") in types
    lines = [f"from {package}.msg import {name}" for package, name in sorted(types)]
    found = subprocess.run([sys.executable, "-c", "\n".join(lines)], capture_output=True, text=True, timeout=60)
    assert found.returncode == 0, found.stderr


PAGES = sorted([*ROOT.glob("*.md"), *ROOT.glob("doc/**/*.md"), *SOURCES.glob("*/README.md")])


def anchors_of(page):
    """As GitHub forms them of headings."""
    text = re.sub(r"^```.*?^```$", "", page.read_text(), flags=re.M | re.S)
    heads = re.findall(r"^#+ (.*)$", text, re.M)
    return {re.sub(r"[^\w\- ]", "", head.lower()).replace(" ", "-") for head in heads}


def test_links_of_the_documents_lead_to_files_and_headings():
    lost = []
    for page in PAGES:
        text = page.read_text()
        for target in [*re.findall(r"\]\((?!https?:)([^)]+)\)", text), *re.findall(r'<img src="([^"]+)"', text)]:
            name, _, anchor = target.partition("#")
            file = page.parent / name if name else page
            if not file.exists() or (anchor and anchor not in anchors_of(file)):
                lost.append(f"{page.relative_to(ROOT)}: {target}")
    assert lost == []


def test_the_readme_is_short_and_each_package_has_one():
    assert len((ROOT / "README.md").read_text().split()) <= 1200
    ours = {path.parent.name for path in SOURCES.glob("navvi_*/CMakeLists.txt")} - {"navvi_msgs", "navvi_build"}
    assert sorted(name for name in ours if not (SOURCES / name / "README.md").exists()) == []


@pytest.mark.parametrize("package", ROOMS)
def test_the_readme_of_a_package_names_its_rooms(package):
    text = (SOURCES / package / "README.md").read_text()
    assert [room for room in rooms_of(package) if f"`{room}`" not in text] == []


def test_the_readme_of_the_simulator_has_a_row_a_room_in_the_order_of_cmake():
    text = (SOURCES / "navvi_sim/README.md").read_text()
    assert re.findall(r"^\| \d+ \| `(\w+)`", text, re.M) == list(rooms_of("navvi_sim"))


def test_contributing_names_rooms_files_and_classes_that_exist():
    rows = [line.split("|")[2] for line in (ROOT / "CONTRIBUTING.md").read_text().splitlines() if line.startswith("| ")]
    words = {word for row in rows for word in re.findall(r"`([^`]+)`", row)}
    places = {word for word in words if re.fullmatch(r"navvi_[\w/.]+", word)}
    assert len(places) > 30

    def stands(place):
        package, _, rest = place.partition("/")
        homes = [ROOT / place, SOURCES / place, SOURCES / package / "src" / rest, SOURCES / package / "include" / package / rest]
        return any(home.exists() for home in homes)

    assert sorted(place for place in places if not stands(place.replace("NAME", "run"))) == []
    classes = {word for word in words if re.fullmatch(r"[A-Z]\w+(::\w+)?", word) and not word.isupper()}
    assert len(classes) > 25
    assert sorted(name for name in classes if not exists(name)) == []


def test_each_command_that_a_document_names_exists():
    commands = {path.stem for path in (ROOT / "navvi_cli/commands").glob("*.py")}
    named = {(page.relative_to(ROOT).as_posix(), word) for page in PAGES if page.name != "CHANGELOG.md"
             for word in re.findall(r"\./navvi ([a-z]+)", page.read_text())}
    assert len({word for _, word in named}) > 15
    assert sorted((page, word) for page, word in named if word not in commands) == []


def test_entries_of_the_changelog_are_of_one_line():
    text = (ROOT / "CHANGELOG.md").read_text()
    entries = text[text.index("## [Unreleased]"):text.index("\n## [", text.index("## [Unreleased]") + 1)].splitlines()[1:]
    assert [line for line in entries if line and not line.startswith(("- ", "### "))] == []
    assert [line for line in entries if len(line) > 160] == []
    assert len(set(entries) - {""}) == len([line for line in entries if line])


def test_each_row_of_the_fault_matrix_has_tests_and_each_name_of_a_row_is_one():
    rows = re.findall(r"^\| ([A-Z]\d+) \|", (ROOT / "doc/faults.md").read_text(), re.MULTILINE)
    assert len(set(rows)) > 60
    assert [row for row in rows if not list(find_tests.programs(f"(^|[^A-Za-z0-9]){row}_"))] == []
    names = "\n".join(path.read_text() for path in [*SOURCES.rglob("*_test.cpp"), *(ROOT / "test").glob("*_test.py")])
    assert set(re.findall(r"(?:test_|, )([A-Z]\d+)_[a-z]", names)) <= set(rows)
    assert {"navvi_safety/command_gate", "_ctest_navvi_sim_rostest_test_sim_node.test", "stop"} <= set(find_tests.programs("T1_"))
    assert list(find_tests.programs("no_test_is_called_" + "so")) == []


def sentences_of(path):
    """The texts in the code of a program, without comments."""
    if path.suffix == ".py":
        tree = ast.parse(path.read_text())
        documents = {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Expr)}
        return [node.value for node in ast.walk(tree) if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in documents]
    return re.findall(r'"((?:[^"\\\n]|\\.)*)"', re.sub(r'"\s*\n\s*"', "", re.sub(r"^\s*//.*", "", path.read_text(), flags=re.M)))


def test_no_sentence_says_that_a_thing_is_no_other_thing():
    paths = [path for folder in (SOURCES, ROOT / "navvi_cli") for path in folder.rglob("*")
             if path.suffix in (".cpp", ".hpp", ".py") and "test" not in path.name and "test" not in path.parent.name]
    assert len(paths) > 500
    found = [f"{path.relative_to(ROOT)}: {text}" for path in paths for text in sentences_of(path)
             if re.search(r"(?<!here )\b(is|are) no (?!longer\b)[a-zA-Z]", text)]
    assert not found, "say 'is not a ...', and what is allowed"


@pytest.mark.parametrize("name", ["session", "seen"])
def test_the_documents_pictures_show_what_is_drawn_today(name):
    bench = script(SOURCES / "navvi_rviz/bench/picture_bench")
    assert Image.open(ROOT / f"doc/{name}.png").text.get("look") == bench.look_of_today(), (
        "the drawing code has changed since; \"./navvi bench picture --doc\" makes them anew")
