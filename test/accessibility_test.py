"""What a person with a screen reader, a braille display, a dumb terminal, little sight or one hand needs: the checklist.

Each line names the test that holds NavVI to it; `./navvi test accessibility` runs all of them. Those in other files carry the mark
`accessibility`; CORES runs those in C++.

 1. No control characters without a terminal, or with NO_COLOR, TERM=dumb, ACCESSIBLE=1: test_a_terminal_gets_no_control_characters,
    test_without_a_terminal_there_are_no_control_characters.
 2. No line is drawn anew: test_progress_comes_in_whole_lines_with_percent_and_time_so_far (a carriage return is a control character).
 3. Progress as whole lines, 5 to 30 s apart: the same.
 4. Success in words: test_success_is_told_in_words.
 5. An error's first line says what, where and what to do: entry_test.py, test_a_wrong_word_is_refused_with_a_sentence; exit codes are
    documented: test_help_is_short_without_columns_and_tells_the_exit_codes.
 6. Help of at most 40 lines of at most 80 characters: the same.
 7. No meaning by colour or column: the same.
 8. Each table as csv, too: test_a_table_comes_as_csv_too.
 9. Long output goes to a file: test_long_output_goes_to_a_file.
10. A man page: test_the_manual_holds_every_help.
11. Every question answerable by option, none waits without a terminal: test_nothing_asks_where_there_is_no_terminal.
12. Ctrl-C ends within 2 s, with a sentence: test_ctrl_c_ends_long_work_within_two_seconds_and_says_so.
13. Nothing essential only in RViz: watch_test.py, test_nothing_that_the_guide_knows_is_told_in_the_picture_alone.
14. The same by speech-dispatcher and on a plain terminal: watch_test.py, test_each_line_is_spoken_and_the_next_waits_until_it_was.
15. The panel by AT-SPI: panel_test.py, test_a_screen_reader_meets_each_part_by_role_and_name and the two after it.
16. All functions of the panel by key: panel_test.py, test_the_tab_key_goes_through_all_that_can_be_pressed, test_keys_*,
    test_the_menu_is_shown_and_driven_by_keys_and_by_a_screen_reader;
    by_panel_test.py, test_a_goal_by_panel_and_keys_alone.
17. Sizes of letters: panel_test.py, test_letters_are_large_and_twice_as_large_for_who_wants_that.
18. Contrast: picture_test.py, test_each_thing_or_its_edge_stands_out_from_all_that_it_is_before.
19. Shape, not hue: picture_test.py, test_path_goal_and_mover_are_found_in_grey_and_as_by_20_200.
20. No flash above 3 Hz: SteadyBanner in CORES.
21. Every cue in two senses, each with its own strength and off switch: test_each_sense_has_its_strength_and_its_switch,
    test_what_is_felt_or_sounds_is_said_too, and what is said is shown: panel_test.py.
22. Glossary and tutorial: lesson_test.py.
23. Controls remappable, one hand, no holds: CORES, and by_pad_test.py, test_three_goals_by_pad_alone.
24. README and reports with headings, alternative texts, table headers: test_documents_have_headings_alt_texts_and_table_headers.
"""
import ast
import csv
import os
import re
import shutil
import signal
import subprocess
import time

import pytest

from sessions import DARK, ROOT, heed_ctrl_c, navvi, within

LONG = 100000 + os.getpid()  # s, slept by no other run of these tests

pytestmark = pytest.mark.accessibility
COMMANDS = sorted(path.stem for path in (ROOT / "navvi_cli/commands").glob("*.py"))


def on_a_terminal(words, **more):
    """What a command writes when it believes that a person sits at a terminal."""
    line = " ".join([str(ROOT / "navvi"), *words])
    return subprocess.run(["script", "-qec", line, "/dev/null"], capture_output=True, text=True, stdin=subprocess.DEVNULL,
                          timeout=120, env=dict(DARK, **more)).stdout.replace("\r\n", "\n")


def controls(text):
    return re.findall(r"[^\n\t -~\u00a0-\uffff]", text)


# --- help

@pytest.mark.parametrize("command", COMMANDS)
def test_help_is_short_without_columns_and_tells_the_exit_codes(command):
    text = navvi(command, "--help").stdout
    assert 3 < len(text.splitlines()) <= 40 and max(map(len, text.splitlines())) <= 80
    assert command == "help" or re.search(r"^Exit codes\n0: ", text, re.M)
    assert "  " not in text and "\t" not in text, "what stands in a column is lost where lines are read one after the other"


def test_every_command_is_listed_with_its_summary():
    listed = dict(line.split(": ", 1) for line in navvi("help").stdout.splitlines() if re.match(r"[a-z]+: ", line))
    assert sorted([*listed, "help"]) == COMMANDS and all(summary.endswith(".") for summary in listed.values())
    assert navvi("--help").stdout == navvi("help").stdout


def test_every_function_of_the_commands_is_short():
    for path in (ROOT / "navvi_cli").rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text())):
            if isinstance(node, ast.FunctionDef):
                assert node.end_lineno - node.lineno <= 40, node.name
    for path in (ROOT / "navvi_cli").rglob("*.bash"):
        for name, body in re.findall(r"^(\w+)\(\) \{.*\n((?:.*\n)*?)^\}", path.read_text(), re.M):
            assert body.count("\n") <= 40, name


def test_the_manual_holds_every_help(tmp_path):
    plain = navvi("man").stdout
    page = navvi("man", "--write", str(tmp_path / "navvi.1"))
    assert page.returncode == 0 and "navvi.1" in page.stdout
    source = (tmp_path / "navvi.1").read_text()
    for command in COMMANDS:
        assert navvi(command, "--help").stdout in plain
        assert f".SH {command.upper()}\n" in source


@pytest.mark.parametrize("typed, word", [
    ("./navvi re", "replay "),
    ("./navvi run parti", "participant:="),
    ("./navvi run operator:=key", "keyboard "),
    ("./navvi build --as", "--asan "),
    ("./navvi world sh", "show "),
    ("./navvi world show trai", "training "),
    ("./navvi run world:=train", "training "),
    ("./navvi watch spee", "speech:="),
])
def test_the_tab_key_completes(typed, word):
    script = f"""source <("{ROOT}/navvi" completion); cd "{ROOT}"
      COMP_LINE={typed!r} COMP_POINT={len(typed)} COMP_TYPE=9; _python_argcomplete ./navvi; printf '%s\\n' "${{COMPREPLY[@]}}" """
    found = subprocess.run(["bash", "-c", script], capture_output=True, text=True, timeout=60)
    assert found.stdout == word + "\n", found.stderr


@pytest.mark.skipif(not shutil.which("zsh"), reason="zsh is not installed")
def test_zsh_takes_the_completion(tmp_path):
    script = f"source <('{ROOT}/navvi' completion zsh); print -- ${{_comps[./navvi]}}"
    found = subprocess.run(["zsh", "-f", "-c", script], capture_output=True, text=True, timeout=60, env=dict(DARK, HOME=str(tmp_path)))
    assert "_python_argcomplete" in found.stdout and not found.stderr, found.stderr


# --- what is said

@pytest.mark.parametrize("words, setting", [
    ("world check training", {"NO_COLOR": "1"}),
    ("world check training", {"ACCESSIBLE": "1"}),
    ("world list", {"TERM": "xterm-256color"}),
    ("parameters relay", {"TERM": "dumb"}),
    ("help", {"TERM": "dumb"}),
    ("man", {"TERM": "dumb"}),
    ("man", {"ACCESSIBLE": "1", "TERM": "xterm"}),
    ("setup", {"TERM": "dumb"}),
    ("fly", {"TERM": "dumb"}),
], ids=str)
def test_a_terminal_gets_no_control_characters(words, setting):
    text = on_a_terminal(words.split(), **setting)
    assert text and controls(text) == []


@pytest.mark.parametrize("words", [["help"], ["world", "check", "training"], ["parameters", "sim"], ["man"], ["setup"], ["fly"]], ids=" ".join)
def test_without_a_terminal_there_are_no_control_characters(words):
    result = navvi(*words, TERM="xterm-256color")
    assert controls(result.stdout + result.stderr) == []


@pytest.mark.parametrize("words, sentence", [
    (["setup"], "is installed"),
    (["build"], "the build is done"),
    (["man", "--write", "{}/navvi.1"], "the manual is in"),
    (["world", "show", "training", "-o", "{}/a.svg"], "the picture is in"),
], ids=lambda words: " ".join(words[:2]) if isinstance(words, list) else "")
def test_success_is_told_in_words(words, sentence, tmp_path):
    result = navvi(*[word.format(tmp_path) for word in words])
    assert result.returncode == 0, result.stderr
    assert sentence in result.stdout


@pytest.mark.parametrize("words", [["parameters", "sim"], ["world", "list"], ["world", "check", "training"],
                                   ["navmesh", str(ROOT / "navvi_ws/src/navvi_nav/maps/hall.yaml")]], ids=lambda words: words[0])
def test_a_table_comes_as_csv_too(words):
    result = navvi(*words, "--csv")
    rows = list(csv.reader(result.stdout.splitlines()))
    assert result.returncode == 0 and len(rows) > 4
    assert {len(row) for row in rows} == {len(rows[0])}, "each row has the cells of the header"


# --- what takes long

def test_long_output_goes_to_a_file():
    """That of a session does: test_ctrl_c_ends_a_session_soon_and_says_so."""
    for command in "build", "test":
        assert f"navvi_ws/{command}.log" in navvi(command, "--help").stdout


BASH = f"""set -euo pipefail
for part in "{ROOT}"/navvi_cli/shell/*.bash; do source "$part"; done
stopped_by_signals
"""


def bash(script, **more):
    return subprocess.Popen(["bash", "-c", BASH + script], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                            start_new_session=True, preexec_fn=heed_ctrl_c, **more)


def test_progress_comes_in_whole_lines_with_percent_and_time_so_far(tmp_path):
    """A stand-in for ninja that takes 24 s, watched by the clock."""
    work = 'slow() { for i in 1 2 3 4; do sleep 6; echo "[$i/4] Building"; done; }\n'
    process = bash(f'root=/ workspace=/\n{work} with_progress building "{tmp_path}/log" built_percent slow; say "the build is done."')
    begin, seen = time.monotonic(), []
    for line in process.stdout:
        seen.append((time.monotonic() - begin, line))
    assert process.wait() == 0
    assert re.fullmatch(r"navvi: building: 25 percent done, 1\d seconds so far.\n"
                        r"navvi: building: 75 percent done, 2\d seconds so far.\n"
                        r"navvi: the build is done.\n", "".join(line for _, line in seen))
    gaps = [after - before for (before, _), (after, _) in zip(seen, seen[1:])]
    assert 5 <= gaps[0] <= 30
    assert (tmp_path / "log").read_text().count("Building") == 4, "all that was said is in the log"


@pytest.mark.parametrize("text, percent", [
    ("dlstatus:1:50.0:Retrieving\n", "25"), ("dlstatus:1:99:x\npmstatus:dpkg:40.0:Installing\n", "70"), ("Reading\n", "0")])
def test_the_progress_of_apt_is_read(text, percent, tmp_path):
    (tmp_path / "log").write_text(text)
    assert bash(f'root=/ workspace=/\ninstalled_percent "{tmp_path}/log"').communicate()[0].strip() == percent


def test_a_command_that_fails_after_a_while_fails(tmp_path):
    process = bash(f'root=/ workspace=/\nslow() {{ sleep 1; return 7; }}; with_progress x "{tmp_path}/log" built_percent slow || echo "code $?"')
    assert process.communicate()[0] == "code 7\n"


def test_ctrl_c_ends_long_work_within_two_seconds_and_says_so(tmp_path):
    process = bash(f'root=/ workspace=/\nslow() {{ sleep {LONG} & sleep {LONG}; }}; with_progress x "{tmp_path}/log" built_percent slow')
    time.sleep(1)
    os.killpg(process.pid, signal.SIGINT)
    begin = time.monotonic()
    said = process.communicate(timeout=20)[0]
    assert time.monotonic() - begin < 2
    assert process.returncode == 130 and said.startswith("navvi: stopped by Ctrl-C")
    assert subprocess.run(["pgrep", "-fx", f"sleep {LONG}"]).returncode == 1, "nothing is left running"


def test_a_command_that_is_killed_leaves_no_work_behind(tmp_path):
    code = (f"import sys; sys.path.insert(0, {str(ROOT)!r}); from navvi_cli import workspace; "
            f"workspace.SHELL = {str(tmp_path / 'shell')!r}; workspace.shell('x')")
    (tmp_path / "shell").write_text(BASH.replace("set -euo", "#!/bin/bash\nset -euo") +
                                    f'root=/ workspace=/\nslow() {{ sleep {LONG}.5 & sleep {LONG}.5; }}; with_progress x "{tmp_path}/log" built_percent slow')
    (tmp_path / "shell").chmod(0o755)
    process = subprocess.Popen(["/usr/bin/python3", "-c", code], stderr=subprocess.DEVNULL)
    time.sleep(2)
    assert subprocess.run(["pgrep", "-fx", f"sleep {LONG}.5"], stdout=subprocess.DEVNULL).returncode == 0
    process.kill()
    process.wait()
    time.sleep(2)
    assert subprocess.run(["pgrep", "-fx", f"sleep {LONG}.5"]).returncode == 1, "something is left running"


def test_ctrl_c_ends_a_session_soon_and_says_so(session, tmp_path, record_property):
    begun = session("world:=training")
    begun.wait_until_begun()
    time.sleep(3)
    begun.end()
    begin = time.monotonic()
    text = begun.wait_until_ended(20)
    assert "navvi: stopped by Ctrl-C; what was recorded is kept." in text and "The goal was not reached: aborted" in text
    within(record_property, "session ended", time.monotonic() - begin, 6.0)  # some 2 s, most of it for closing the record whole
    assert controls(text) == []
    start_tells_what_to_press(begun.output)
    log = next(tmp_path.glob("session-*.log")).read_text()
    assert "started roslaunch server" in log and "NODES" in log and controls(log) == []
    assert "NODES" not in text


@pytest.mark.parametrize("after", [0.3, 0.8, 1.3, 2.0, 3.0])
def test_ctrl_c_while_a_session_starts_ends_it(after, session, record_property):
    begun = session("world:=training")
    begun.wait_until(lambda: "In a second terminal" in begun.text(), 60, "it tells what to do")
    time.sleep(after)
    begun.end()
    begin = time.monotonic()
    text = begun.wait_until_ended(30)
    within(record_property, "session ended", time.monotonic() - begin, 12.0)  # roslaunch waits 15 s for a node that has lost its signal
    assert "stopped by Ctrl-C" in text and "has begun" not in text.partition("stopped by Ctrl-C")[2]


def start_tells_what_to_press(lines):
    six = [line for line in lines if not line.startswith(("navvi: warning", "navvi: building:", "navvi: waiting for another build"))][:6]
    assert six[0].startswith("navvi: a session begins")
    assert [line.split(":")[0] for line in six[1:]] == ["To drive", "To hear more", "The record", "To stop", "In a second terminal"]


def test_nothing_asks_where_there_is_no_terminal():
    """No command reads what is typed; sudo asks only where there is a terminal."""
    for path in [ROOT / "navvi", *(ROOT / "navvi_cli").rglob("*.py"), *(ROOT / "navvi_cli").rglob("*.bash")]:
        text = path.read_text()
        assert not re.search(r"\binput\(|\bgetpass\b", text), path.name
        assert not re.search(r"\bread -[a-z]*p\b|\bselect \w+ in\b", text), path.name
        for line in text.splitlines():
            assert "sudo -v" not in line or "-t 0" in line, path.name


# --- what is said, felt and heard, and how it is asked for

CORES = [
    ("navvi_rviz", "SteadyBanner.does_not_flash_whatever_trembles"),
    ("navvi_feedback", "Buttons.act_once_however_long_they_are_held"),
    ("navvi_feedback", "Buttons.are_those_that_the_person_wants"),
    ("navvi_feedback", "MenuTest.leads_to_a_goal_by_short_presses_of_one_hand"),
    ("navvi_feedback", "Driven.by_the_hand_that_is_wanted"),
    ("navvi_feedback", "GuideTest.a_hit_is_felt_at_once_on_its_side_whatever_else_is_felt"),
]


@pytest.mark.parametrize("package, name", CORES, ids=[name for _, name in CORES])
def test_of_the_cores(package, name):
    program = ROOT / "navvi_ws/build" / package / f"{package}_tests"
    result = subprocess.run([str(program), f"--gtest_filter={name}"], capture_output=True, text=True, timeout=60)
    assert result.returncode == 0 and "[  PASSED  ] 1 test." in result.stdout, result.stdout[-2000:]


def test_each_sense_has_its_strength_and_its_switch():
    told = navvi("parameters", "feedback", "--csv")
    known = {row["parameter"] for row in csv.DictReader(told.stdout.splitlines())}
    assert {"speech", "speaker/volume", "haptics/enabled", "haptics/gain_left", "haptics/gain_right", "sounds/enabled"} <= known
    assert "lead" in known, "which switches the sound of a turn"
    for family in {name.split("/")[1] for name in known if name.startswith("sounds/") and name.count("/") == 2} - {"turn"}:
        assert {f"sounds/{family}/on", f"sounds/{family}/volume"} <= known, family


# What has words, by the names of patterns that are felt and of short sounds.
SAID = {
    "ready": "press_start", "begun": "trial_begins", "rerouted": "rerouted", "arrived": "arrived", "stuck": "stuck", "halt": "obstacle_stop", "stopped": "robot_stopped",
    "hit_obstacle": "collision", "hit_shelf": "collision",
    "turn": "direction", "turn_click": "direction", "turn_stop": "straight", "on_course": "straight", "beacon": "direction",
    "flow": "direction", "answer": "goal_info", "assisted": "assisted",
}


def test_what_is_felt_or_sounds_is_said_too():
    """And what is said is shown in the panel, and told by ./navvi watch."""
    import yaml
    source = ROOT / "navvi_ws/src/navvi_feedback"
    phrases = yaml.safe_load((source / "config/phrases/en.yaml").read_text())["phrases"]
    signals = (ROOT / "navvi_ws/src/navvi_types/include/navvi_types/signal.hpp").read_text()
    for kind in "Pattern", "Earcon":
        names = re.findall(r"^  (\w+),", re.search(rf"enum class {kind} .*?}};", signals, re.S)[0], re.M)
        assert len(names) > 5
        for name in names:
            near = re.fullmatch(r"(\w+?)_(near|close)", name)
            said = SAID.get(name) or (near and near[2])
            # "No sound" cannot be said: it is felt and shown; nor that words are missing. The others come only when somebody asks for them.
            assert said in phrases or name in ("no_sound", "sample", "unsaid"), name


# --- documents

@pytest.mark.parametrize("page", [*sorted(ROOT.glob("*.md")), *sorted((ROOT / "doc").glob("*.md")),
                                  *sorted((ROOT / "navvi_ws/src").glob("*/README.md"))], ids=lambda page: str(page.relative_to(ROOT)))
def test_documents_have_headings_alt_texts_and_table_headers(page):
    text = re.sub(r"^(?: {4}.*|```(?:.*\n)*?```)$", "", page.read_text(), flags=re.M)
    levels = [len(mark) for mark in re.findall(r"^(#+) ", text, re.M)]
    assert levels[0] == 1 and levels.count(1) == 1
    assert all(after <= before + 1 for before, after in zip(levels, levels[1:])), "no level of heading is left out"
    assert all(len(alt) > 15 for alt in re.findall(r"!\[([^\]]*)\]", text)), "each picture is told in words"
    lines = text.splitlines()
    for at, line in enumerate(lines):
        if line.startswith("|") and (at == 0 or not lines[at - 1].startswith("|")):
            assert re.fullmatch(r"\|(?:\s*:?-+:?\s*\|)+", lines[at + 1]), f"the table at {line!r} has no header"
