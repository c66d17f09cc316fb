"""The README's topic table names functions that exist, and its links lead somewhere."""
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SOURCES = ROOT / "navvi_ws" / "src"
CODE = "\n".join(path.read_text() for path in SOURCES.rglob("*.[ch]pp"))


def topic_rows():
    text = (ROOT / "README.md").read_text()
    table = text[text.index("## Topics"):text.index("## A session")]
    return [line for line in table.splitlines() if line.startswith("| /")]


def exists(name):
    owner, _, function = name.rpartition("::")
    defined = re.search(rf"\b{re.escape(function)}\b", CODE)
    return bool(defined and (not owner or re.search(rf"\b(?:class|struct) {re.escape(owner)}\b", CODE)))


def test_every_function_of_the_topic_table_exists():
    names = {name for row in topic_rows() for name in re.findall(r"`([A-Za-z_:]+)`", row.split("|")[-2])}
    assert len(names) > 20
    assert sorted(name for name in names if name != "tick" and not exists(name)) == []


def test_every_topic_of_the_table_is_named_in_the_code():
    topics = {topic for row in topic_rows() for topic in re.findall(r"/([a-z_/]+)", row.split("|")[1])}
    missing = [topic for topic in topics if topic not in ("tf", "tf_static") and f'"{topic}"' not in CODE and f'"/{topic}"' not in CODE]
    assert sorted(missing) == []


def test_rostopic_can_show_every_topic():
    types = {found for row in topic_rows() for found in re.findall(r"\b([a-z0-9_]+_msgs)/([A-Z][A-Za-z0-9]+)", row)}
    assert ("tf2_msgs", "TFMessage") in types
    lines = [f"from {package}.msg import {name}" for package, name in sorted(types)]
    found = subprocess.run([sys.executable, "-c", "\n".join(lines)], capture_output=True, text=True, timeout=60)
    assert found.returncode == 0, found.stderr


def test_links_of_the_documents_lead_to_files():
    lost = []
    for page in [*ROOT.glob("*.md"), *ROOT.glob("doc/*.md"), *SOURCES.glob("*/README.md")]:
        for target in re.findall(r"\]\((?!https?:)([^)#]+)\)", page.read_text()):
            if not (page.parent / target).exists():
                lost.append(f"{page.relative_to(ROOT)}: {target}")
    assert lost == []


def test_each_test_of_the_fault_matrix_exists():
    tests = "\n".join(path.read_text() for path in [*SOURCES.rglob("*_test.cpp"), *(ROOT / "test").glob("*_test.py")])
    cells = [line.rsplit("|", 2)[1] for line in (ROOT / "doc/faults.md").read_text().splitlines() if line.startswith("| ")]
    names = {name for cell in cells for name in re.findall(r"`(\w+)`", cell)}
    assert len(names) > 60
    assert sorted(name for name in names if name not in tests) == []
