"""The parts of the command by themselves: arguments, launch files, the lock of a port, what a session prints, and its end."""
import contextlib
import csv
import os
import re
import socket
import subprocess
import sys
import time
import types

import pytest

from conftest import free_port
from sessions import ROOT, eventually
from navvi_cli import arguments, lessons, network, parser, session, trials, worlds
from navvi_cli.commands import bench, calibrate, check, replay, robot, run, show, tutorial
from navvi_cli.main import command_names, parser_of
from navvi_cli.say import Failure, fail


def refusal(work, code=2):
    with pytest.raises(Failure) as found:
        work()
    assert found.value.code == code
    return found.value.sentence


# --- programs

def test_a_program_that_works_for_long_is_said_to_be_at_work(monkeypatch, tmp_path):
    said, program = [], tmp_path / "program"
    program.write_text(f"#!/bin/sh\nread line < {tmp_path / 'pipe'}\necho '{{\"a\": 1}}'")
    program.chmod(0o755)
    os.mkfifo(tmp_path / "pipe")

    def hear(sentence):
        said.append(sentence)
        (tmp_path / "pipe").write_text("end\n")

    monkeypatch.setattr(worlds, "aside", hear)
    assert worlds.answer(program)[1] == {"a": 1} and said == ["still at work; a large world takes minutes."]


def test_the_robots_side_hands_on_absolute_paths_of_a_world(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(robot, "prepare", lambda words, *more: given.update(words) or fail(None))
    (tmp_path / "models").mkdir()
    for name in "hall.sdf", "classes.yaml":
        (tmp_path / name).touch()
    given = {}
    with pytest.raises(Failure):
        robot.Start.run(types.SimpleNamespace(words=["world:=hall.sdf", "models:=models", "classes:=classes.yaml"]))
    assert [str(given[name]) for name in ("world", "models", "classes")] == [str(tmp_path / name) for name in ("hall.sdf", "models", "classes.yaml")]


# --- arguments

class Draw:
    """Draw it.

    How it is drawn.

    Exit codes
    0: drawn.
    """

    def arguments(parser):
        parser.add_argument("-o", metavar="FILE", help="the picture.")
        parser.add_argument("--from", metavar="X,Y", help="the start.")
        parser.add_argument("words", nargs="*", default=[], metavar="name:=value")

    def run(args):
        return args


@pytest.fixture
def command():
    found = parser.Parser(prog="./navvi thing", text="Thing.\n")
    parser.add_actions(found, draw=Draw)
    return found


def test_options_may_stand_anywhere_and_values_may_begin_with_a_minus(command):
    args = command.parse_args(["draw", "a:=1", "--from", "-1,-2", "b:=2", "-o", "-x.svg", "c:=3"])
    assert (getattr(args, "from"), args.o, args.words) == ("-1,-2", "-x.svg", ["a:=1", "b:=2", "c:=3"])
    assert args.run(args) is args


@pytest.mark.parametrize("words, sentence", [
    ([], "missing: ACTION; allowed is: ./navvi thing draw ..."),
    (["drow"], "\"drow\" is not allowed here; allowed are: draw"),
    (["draw", "--to", "1"], "\"--to\" is not taken here; allowed is: ./navvi thing draw [-o FILE] [--from X,Y] [name:=value ...]"),
    (["draw", "-o"], "argument -o: expected one argument; allowed is: ./navvi thing draw [-o FILE] [--from X,Y] [name:=value ...]"),
])
def test_a_wrong_argument_is_refused_with_what_is_allowed(command, words, sentence):
    assert refusal(lambda: command.parse_args(words)) == sentence


def test_a_missing_option_is_named_with_its_values_and_without_brackets():
    from navvi_cli.commands import study
    found = parser.Parser(prog="./navvi study", text="Study.\n")
    study.arguments(found)
    assert refusal(lambda: found.parse_args(["withdraw", "plan.yaml", "sub-04"])) == (
        "missing: --data; allowed is: ./navvi study withdraw PLAN PARTICIPANT --data delete|keep")


def test_usage_names_the_values_of_an_option_and_breaks_between_words():
    from navvi_cli.commands import batch, study
    helps = {}
    for command in batch, study:
        found = parser.Parser(prog="./navvi", text=command.__doc__)
        command.arguments(found)
        helps[command] = found.format_help()
    assert "--records all|failed|none: " in helps[batch] and re.search(r"^\./navvi [a-z|]+\|\n[a-z|]+ \.\.\.$", helps[study], re.M)


@pytest.mark.parametrize("problem, sentence", [
    (OSError(28, "No space left on device", "/some/rows.csv"), "/some/rows.csv cannot be used: No space left on device."),
    (ModuleNotFoundError("No module named 'PIL.Image'", name="PIL.Image"),
     "this needs the package python3-pil; \"sudo apt install python3-pil\" installs it."),
    (UnicodeDecodeError("utf-8", b"caf\xe9", 3, 4, "unexpected end of data"),
     "what was given is not in UTF-8, as is needed: 'utf-8' codec can't decode byte 0xe9 in position 3: unexpected end of data."),
], ids=lambda given: type(given).__name__)
def test_what_no_command_foresees_is_a_sentence_with_exit_code_2(problem, sentence, capsys, monkeypatch):
    from navvi_cli import main

    def broken(words):
        raise problem
    monkeypatch.setattr(main, "run", broken)
    monkeypatch.setattr(main.signal, "signal", lambda *given: None)
    monkeypatch.setattr(main.sys, "stdin", None)
    monkeypatch.setattr(main.sys, "stdout", types.SimpleNamespace(reconfigure=lambda **given: None, flush=lambda: None))
    assert main.main([]) == 2 and capsys.readouterr().err == f"navvi: {sentence}\n"


@pytest.mark.parametrize("text", [b"- {name: caf\xe9, x: 1, y: 2}\n", b"- {name: a, x: 1\n"], ids=["latin_1", "no_yaml"])
def test_a_job_that_cannot_be_read_is_named(text, tmp_path):
    (tmp_path / "job.yaml").write_bytes(text)
    assert f"{tmp_path}/job.yaml cannot be read; YAML in UTF-8 is allowed" in refusal(lambda: run.job_of({"jobs": tmp_path / "job.yaml"}))


def test_help_is_usage_summary_text_arguments_and_exit_codes(command, capsys):
    with pytest.raises(SystemExit) as end:
        command.parse_args(["draw", "--help"])
    assert end.value.code == 0
    assert capsys.readouterr().out == ("./navvi thing draw [-o FILE] [--from X,Y] [name:=value ...]\nDraw it.\n\nHow it is drawn.\n\n"
                                       "-o FILE: the picture.\n--from X,Y: the start.\n\nExit codes\n0: drawn.\n")


def test_no_command_imports_ros_or_starts_a_program_to_parse_its_arguments():
    code = ("import sys, subprocess; sys.path.insert(0, sys.argv[1]); subprocess.Popen = None\n"
            "from navvi_cli.main import command_names, parser_of\n"
            "parser_of(*command_names())\n"
            "assert not {'rospy', 'roslaunch', 'rosbag', 'argcomplete', 'yaml'} & set(sys.modules)")
    subprocess.run(["/usr/bin/python3", "-c", code, str(ROOT)], check=True)
    assert {"run", "world", "show", "version"} <= set(parser_of(*command_names()).commands)


# --- launch files

LAUNCH = """<launch>
  <arg name="seed" default="1" doc="draws"/>
  <arg name="view"
       doc="of
  RViz" default="$(eval 1)"/>
  <!-- <arg name="gone" default="" doc="a comment"/> -->
  <arg name="inner" default="not for a person"/>
  <arg name="sim_parameters" default="{}" doc="parameters"/>
  <arg name="version" default="n/a" doc="set by the command"/>
  <node name="sim_node" pkg="p" type="t"><param name="seed" value="$(arg seed)"/><param name="mode" value="1"/></node>
  <include file="$(dirname)/other.launch"/>
</launch>"""


@pytest.fixture
def launch_file(tmp_path, monkeypatch):
    (tmp_path / "a.launch").write_text(LAUNCH)
    (tmp_path / "other.launch").write_text("<launch><group><node name='nav_node' pkg='p' type='t'><param name='map' value=''/></node></group></launch>")
    monkeypatch.setattr(arguments, "LAUNCH", tmp_path)
    return arguments.LaunchFile("a.launch")


def test_the_arguments_of_a_launch_file_are_those_with_a_meaning_for_a_person(launch_file):
    assert list(launch_file.arguments) == ["seed", "view"]
    assert launch_file.parts == ["sim"]
    assert launch_file.fixed == {"sim/seed", "sim/mode", "nav/map"}
    assert launch_file.help()[1:] == ["seed:=1: draws", "view: of RViz"]


def test_words_become_values_and_parameters(launch_file):
    words = arguments.words_for(launch_file, ["seed:=7", "sim/rate:=2", "sim/a/b:=c:=d"])
    assert words == {"seed": "7"} and words.parameters == ["sim/rate:=2", "sim/a/b:=c:=d"]
    assert words.parameters_of("sim") == ["rate:=2", "a/b:=c:=d"]


def test_a_file_is_that_of_the_folder_in_which_the_command_is_given(tmp_path, monkeypatch):
    """Nodes run in another."""
    monkeypatch.chdir(tmp_path)
    given = ["feedback/questions:=a.yaml", "feedback/record:=/b.csv", "feedback/phrases:=", "perception/prior:=c/d.bt", "nav/mesh/zones:=./e.yaml",
             "trial/record:=none", "feedback/language:=es"]
    assert arguments.words_for(arguments.LaunchFile("live.launch"), given).parameters == [
        f"feedback/questions:={tmp_path}/a.yaml", "feedback/record:=/b.csv", "feedback/phrases:=", f"perception/prior:={tmp_path}/c/d.bt",
        f"nav/mesh/zones:={tmp_path}/e.yaml", "trial/record:=none", "feedback/language:=es"]
    assert arguments.words_for(arguments.LaunchFile("lesson.launch"), given[:1]).parameters == [f"feedback/questions:={tmp_path}/a.yaml"]


def test_each_parameter_that_names_a_file_is_known_as_one():
    """By the meaning that the sources give it. The session itself sets the others."""
    texts = [path.read_text() for path in (ROOT / "navvi_ws/src").glob("navvi_*/src/*/*.cpp")
             if re.search("node_config|nav_mesh|perception_node", path.name)]
    meant = [one for text in texts for one in re.findall(r'"(\w+)", (?:navvi_config::)?Any\{\}, "",\s+"([^"]*)', text)]
    named = {name for name, meaning in meant if re.search(r"\bfile\b", meaning)}
    assert named - {"job", "places", "world", "classes", "person"} == {name.rpartition("/")[2] for name in arguments.FILES}


@pytest.mark.parametrize("word, sentence", [
    ("fast", "arguments look like name:=value"), ("gone:=1", "\"gone\" is unknown; known are: seed view"), ("inner:=1", "is unknown"),
    ("version:=1", "is unknown"), ("sim_parameters:={}", "is unknown"), ("seed:=$(env HOME)", "holds \"$(\""), ("seed:=-1", "whole numbers from 0 to 2147483647"),
    ("seed:=2147483648", "whole numbers from 0 to 2147483647"),
    ("view:=wide", "allowed are: chase top forward"), ("nav/x:=1", "those of sim can be given"), ("sim/seed:=1", "allowed is seed:=1"),
    ("sim/mode:=1", "the session itself sets it"), ("seed:=1 seed:=2", "given twice"), ("person:=a person:=b", "given twice"),
    ("see[d]:=1", "\"see[d]\" is unknown"),
])
def test_a_wrong_word_is_refused(launch_file, word, sentence):
    assert sentence in refusal(lambda: arguments.words_for(launch_file, word.split(" ")))


@pytest.mark.parametrize("word, good", [
    ("start:=-6.5,-5,1.57", True), ("start:=1,2", False), ("start:=", True), ("goal:=0.2,-1", True), ("goal:=1e1,.5", True), ("goal:=1", False),
    ("limit:=30", True), ("limit:=-1", False), ("participant:=sub-01", True), ("participant:=Ann Smith", False), ("person:=anna", True),
    ("person:=", False), ("person:=../x", False), ("seed:=1.5", False),
    ("radius:=20cm", False), ("radius:=0.2", True), ("radius:=0", False), ("height:=1,2", False), ("height:=1.2", True),
    ("seed:=99999999999", False), ("rate:=0", False), ("rate:=0.5", True), ("seed:=1\n", False), ("out:=-x", False), ("out:=./-x", True), ("out:=a/-x", True),
])
def test_the_form_of_a_value_is_checked(word, good):
    launch = {"rate": "replay.launch", "radius": "robot.launch", "height": "robot.launch"}.get(word.partition(":=")[0], "live.launch")
    check = lambda: arguments.words_for(arguments.LaunchFile(launch), [word])  # noqa: E731
    assert check() is not None if good else "allowed are" in refusal(check)


def test_each_form_and_choice_is_of_an_argument_that_there_is():
    known = {name for path in (ROOT / "launch").glob("*.launch") for name in arguments.LaunchFile(path.name).arguments}
    assert set(arguments.CHOICES) <= known
    assert set(arguments.FORMS) <= known | {"address", "pace", "person", "port", "robot"}


# --- the lock of a port

@pytest.fixture
def locks(tmp_path, monkeypatch):
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    return free_port()


def test_a_port_is_claimed_once_and_free_again_after_its_descriptor_is_closed(locks):
    descriptor = network.claim(locks)
    assert network.claim(locks) is None
    assert network.running_sessions() == [locks], "nobody listens while a session begins"
    os.close(descriptor)
    assert network.running_sessions() == []
    os.close(network.claim(locks))


def test_the_lock_is_for_all_users_to_read_and_is_opened_for_reading_alone(locks):
    before = os.umask(0o077)
    try:
        descriptor = network.claim(locks)
    finally:
        os.umask(before)
    assert os.stat(network.lock_file(locks)).st_mode & 0o777 == 0o644
    with pytest.raises(OSError):
        os.write(descriptor, b"x")
    os.close(descriptor)
    network.lock_file(locks).chmod(0o444)
    os.close(network.claim(locks))


@pytest.mark.parametrize("plant", [lambda path: path.symlink_to("/nonexistent/lock"), lambda path: path.symlink_to("/etc/hostname")])
def test_a_port_whose_lock_is_a_link_is_not_ours(locks, plant):
    plant(network.lock_file(locks))
    assert network.claim(locks) is None


def test_a_port_on_which_anybody_listens_is_not_ours(locks):
    with socket.socket() as listener:
        listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listener.bind(("127.0.0.1", locks))
        listener.listen()
        assert network.claim(locks) is None
    os.close(network.claim(locks))


@pytest.mark.parametrize("name, loaded", [("a b", True), ("a:b", False), ("none", False)])
def test_what_keeps_nodes_to_the_loopback_interface_is_loaded_from_any_folder_or_nothing_starts(name, loaded, tmp_path, monkeypatch):
    if name != "none":
        (tmp_path / name).mkdir()
        (tmp_path / name / "lib").symlink_to(network.DEVEL / "lib")
    monkeypatch.setattr(network, "DEVEL", tmp_path / name)
    monkeypatch.setenv("LD_LIBRARY_PATH", f"{tmp_path}/{name}/lib")
    monkeypatch.delenv("LD_PRELOAD", raising=False)
    if not loaded:
        said = refusal(network.Network.preload)
        assert f"it is needed in {tmp_path}/{name}/lib, and a path without" in said
        return
    maps = subprocess.check_output(["/usr/bin/python3", "-c", "print(open('/proc/self/maps').read())"], text=True,
                                   env=dict(os.environ, LD_PRELOAD=network.Network.preload()))
    assert "libnavvi_loopback.so" in maps


# --- what a session prints

@pytest.mark.parametrize("line, shown", [
    ("[ INFO] [1.0]: Trial t has begun: goal at 1, 2.", "navvi: Trial t has begun: goal at 1, 2."),
    ("[ INFO] [1.0]: Found: stopping_delay 0.3.", "navvi: found: stopping_delay 0.3."),
    ("\x1b[33m[ WARN] [1.0]: slow\x1b[0m", "navvi: warning: slow"),
    ("[ERROR] [1.0, 2.0]: bad", "navvi: error: bad"),
    ("\x1b]2;title\x07[ INFO] [1.0]: noise", ""),
    ("REQUIRED process [trial_node-5] has died!", ""),
    ("process has finished cleanly", "navvi: the session has ended."),
    ("process has died [pid 7, exit code -11, cmd /lib/trial_node _out:=/tmp __name:=trial_node __log:=a.log].",
     "navvi: error: trial_node has ended with exit code -11."),
    ("REQUIRED process [sim_node-5] has died!", "navvi: sim_node has ended, and the session with it."),
    ("[nav_node-2] process has died [pid 7, exit code -11, cmd x].", "navvi: warning: nav_node has ended with exit code -11."),
    ("[nav_node-2] restarting process", "navvi: nav_node is started anew."),
    ("RLException: no such file", "navvi: error: no such file"),
])
def test_of_all_that_is_printed_a_person_reads_what_matters(line, shown, tmp_path, capfd):
    log = session.Log(tmp_path / "log")
    log.take(line + "\n")
    assert capfd.readouterr().out == (shown + "\n" if shown else "")
    assert "\x1b" not in (tmp_path / "log").read_text() and log.file.tell() > 0


def test_a_full_disk_ends_the_log_and_not_the_session(capfd):
    log = session.Log("/dev/full")
    for line in "[ WARN] [1.0]: one", "[ WARN] [1.0]: two":
        log.take(line + "\n")
    assert capfd.readouterr().out == ("navvi: warning: the log cannot be written any more: No space left on device.\n"
                                      "navvi: warning: one\nnavvi: warning: two\n")


def test_a_terminal_without_utf_8_ends_no_session(tmp_path):
    code = "import sys; sys.path.insert(0, sys.argv[1])\nfrom navvi_cli.session import Log\nLog(sys.argv[2]).take('caf\\ufffd \\u2192\\n')"
    done = subprocess.run([sys.executable, "-X", "utf8=0", "-c", code, ROOT, tmp_path / "log"], env=dict(os.environ, LC_ALL="C", PYTHONCOERCECLOCALE="0"),
                          capture_output=True, check=False)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "log").read_bytes().decode() == "caf\ufffd \u2192\n"


@pytest.mark.parametrize("line, crashed", [
    ("process has died [pid 7, exit code -9, cmd sim_node].\n", True), ("process has finished cleanly\n", False),
    ("[rviz-9] process has died [pid 7, exit code -9, cmd rviz].\n", False),
    ("[FATAL] [1.0]: nav_node has ended 5 times within 60 s, so the session ends. Its own words\n", True),
    ("[FATAL] [1.0]: There is not enough memory for what came; this node ends.\n", False)])
def test_a_crash_that_ends_a_session_is_known_though_roslaunch_ends_with_0(line, crashed, tmp_path):
    log = session.Log(tmp_path / "log")
    log.take(line)
    assert log.crashed == crashed


def test_a_master_of_the_environment_that_is_not_used_is_named(locks, monkeypatch, capsys):
    monkeypatch.setattr(network, "PORTS", [locks])
    for name in "ROS_MASTER_URI", "ROS_IP", "ROS_HOSTNAME":  # which are set back afterwards
        monkeypatch.setenv(name, "")
    for given, said in ("http://robot:11311", True), (f"http://localhost:{locks}/", False), ("http://localhost:11311", False), (None, False):
        monkeypatch.setattr(network, "GIVEN", given)
        os.close(network.Network().descriptor)
        assert (f"ROS_MASTER_URI={given} is not used" in capsys.readouterr().err) == said


@pytest.mark.parametrize("near", [True, False])
def test_the_line_for_a_second_terminal_leads_to_a_folder_with_a_blank(near, tmp_path, monkeypatch):
    (tmp_path / "a b").mkdir()
    (tmp_path / "a b/setup.bash").write_text("export SOURCED=yes\n")
    monkeypatch.setattr(network, "DEVEL", tmp_path / "a b")
    monkeypatch.chdir(tmp_path if near else "/")
    line = network.Network.second_terminal(types.SimpleNamespace(uri="http://127.0.0.1:11311", address="127.0.0.1"))
    assert subprocess.check_output(["bash", "-c", f"{line}; echo $SOURCED $ROS_IP"], text=True) == "yes 127.0.0.1\n"


def test_what_ended_a_session_is_remembered(tmp_path):
    log = session.Log(tmp_path / "log")
    for line in "[FATAL] [1.0]: there is no map", "[ INFO] [2.0]: bye":
        log.take(line + "\n")
    assert log.fatal == "there is no map"


def test_what_nodes_log_lies_beside_the_sessions_log(tmp_path, monkeypatch):
    """There it is deleted with all else of a person."""
    (tmp_path / "roslaunch").write_text("#!/bin/sh\necho logs in $ROS_LOG_DIR\n")
    (tmp_path / "roslaunch").chmod(0o755)
    monkeypatch.setattr(session, "SHELL", tmp_path / "run")
    nothing = types.SimpleNamespace(path="a.launch", preload=lambda: "", locks=[])
    assert session.Launch(nothing, {}, tmp_path / "session-1.log", nothing).run()
    assert (tmp_path / "session-1.log").read_text() == f"logs in {tmp_path}/session-1\n"


def test_S1_a_persons_session_ends_some_seconds_after_its_simulator_and_says_so(tmp_path, monkeypatch, capfd):
    """In which the guide says that it is lost, and trial_node ends the trial by its own rule; nothing would start it anew."""
    rules = (ROOT / "navvi_ws/src/navvi_study/src/trial/trial_flow.cpp").read_text()
    assert session.LAST_WORDS > float(re.search(r"kSimulatorLost = ([\d.]+);", rules)[1])
    (tmp_path / "roslaunch").write_text("#!/usr/bin/python3\nimport signal, sys, time\nsignal.signal(signal.SIGINT, lambda *_: sys.exit(0))\n"
                                        "print('[sim_node-2] process has died [pid 7, exit code -9, cmd x].', flush=True)\ntime.sleep(60)\n")
    (tmp_path / "roslaunch").chmod(0o755)
    monkeypatch.setattr(session, "SHELL", tmp_path / "run")
    monkeypatch.setattr(session, "LAST_WORDS", 1)
    nothing = types.SimpleNamespace(path="a.launch", preload=lambda: "", locks=[])
    launch, begin = session.Launch(nothing, {}, tmp_path / "session-1.log", nothing), time.monotonic()
    assert not launch.run() and not launch.interrupted, "a crash, and no stop by hand"
    assert 0.9 < time.monotonic() - begin < 30.0
    assert capfd.readouterr().out == ("navvi: warning: sim_node has ended with exit code -9.\n"
                                      "navvi: the simulator has ended, and the session ends in 1 s.\n")


def lesson_of(monkeypatch, launch, logged=""):
    """Stands in for all but the words of a lesson, which come in the list that this returns."""
    given = []

    def begin(_, words, log, __):
        log.write_text(logged)
        given.append(words)
        return launch
    for name, stand_in in ("has_pad", lambda: True), ("check_operator", lambda *_: None), ("prepare", lambda *_: None), ("Network", lambda: None), \
            ("Launch", begin):
        monkeypatch.setattr(lessons, name, stand_in)
    return given


def test_a_lesson_whose_table_cannot_be_written_has_not_succeeded(tmp_path, monkeypatch):
    sources = (ROOT / "navvi_ws/src/navvi_feedback/src/node/settings.cpp").read_text()
    assert lessons.NOT_KEPT in sources
    launch = types.SimpleNamespace(run=lambda: True, interrupted=False)
    given = lesson_of(monkeypatch, launch, f"[ERROR] [1.0]: {lessons.NOT_KEPT}: cannot write /x: No space left on device.\n")
    args = types.SimpleNamespace(words=["person:=anna", f"out:={tmp_path}"])
    assert "could not be written, as said above" in refusal(lambda: calibrate.run(args), 1) and given
    (tmp_path / "folder").mkdir()
    for path in "none/told.csv", "folder":
        args.words = ["person:=anna", f"feedback/record:={tmp_path}/{path}"]
        assert f"feedback/record:={tmp_path}/{path} cannot be written" in refusal(lambda: calibrate.run(args))
    assert len(given) == 1, "before it begins"


@pytest.mark.parametrize("interrupted, code", [(True, 130), (False, 0)])
def test_a_calibration_that_was_stopped_is_not_told_as_done(interrupted, code, tmp_path, monkeypatch):
    given = lesson_of(monkeypatch, types.SimpleNamespace(run=lambda: True, interrupted=interrupted))
    for words, record in ([], [f"feedback/record:={tmp_path}/calibrate-"]), (["feedback/record:=/tmp/own.csv"], ["feedback/record:=/tmp/own.csv"]):
        assert (calibrate.run(types.SimpleNamespace(words=["person:=anna", f"out:={tmp_path}", *words])) or 0) == code
        kept = [word for word in given[-1].parameters if "record" in word]
        assert len(kept) == len(record) and kept[0].startswith(record[0])


@pytest.mark.parametrize("tells, contacts, patience", [(False, "unknown", []), (True, "counted", ["patience:=30"])])
def test_a_session_of_a_robot_elsewhere_keeps_its_exit_code_whatever_stops_its_goodbye(tells, contacts, patience, tmp_path, monkeypatch):
    def finish(seconds):
        if seconds > 3.0:
            raise KeyboardInterrupt
    driven = []
    monkeypatch.setattr(run, "FarNetwork", lambda _: types.SimpleNamespace(clock=lambda: "/navvi/clock", tells_contacts=tells,
                                                                           near=types.SimpleNamespace(finish=finish)))
    monkeypatch.setattr(run, "prepare", lambda *_: None)
    monkeypatch.setattr(run, "drive", lambda _, words, *__: driven.append(words) or 0)
    given = ["robot:=r", "operator:=simulated", "rviz:=false", f"out:={tmp_path}"]
    assert run.far_session([*given, *patience]) == 0
    assert driven[0]["contacts"] == contacts, "which its master says"
    assert driven[0]["patience"] == ("30" if patience else "900") and driven[0]["clock"] == "/navvi/clock"
    assert "\"clock\" is unknown" in refusal(lambda: run.far_session([*given, "clock:=/clock"])), "the command itself sets it"
    assert "\"far\" is unknown" in refusal(lambda: arguments.words_for(arguments.LaunchFile("robot_side.launch"), ["far:=false"]))


@pytest.mark.parametrize("words, port, drivers, unheard", [([], 11311, True, False), ([], 11312, True, True), (["world:=busy"], 11312, False, False)])
def test_a_robots_side_says_how_its_drivers_join_and_which_it_does_not_hear(words, port, drivers, unheard, tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("HOME", str(tmp_path))
    for name, stand_in in ("prepare", lambda words, *_: words.update(parameters="", version="")), ("check_world", lambda _: None), \
            ("Network", lambda _: types.SimpleNamespace(port=port, second_terminal=lambda: "export LINE")), \
            ("Launch", lambda *_: types.SimpleNamespace(run=lambda: True, interrupted=False)):
        monkeypatch.setattr(robot, name, stand_in)
    assert robot.Start.run(types.SimpleNamespace(words=words)) == 0
    told = capsys.readouterr()
    assert ("the drivers of the robot" in told.out) == drivers and "export LINE" in told.out
    assert ("port 11311 are not heard" in told.err) == unheard


# --- the end of a session, and what its record says

ROW = {"trial": "trial-1", "world": "busy", "seed": "3", "result": "reached", "reason": "goal_reached", "elapsed_s": "28.550", "path_length_m": "31.2",
       "shelf_collision_count": "1", "obstacle_collision_count": "0", "safe_stop_count": "0", "cues_spoken": "4", "bag": "ok",
       **{f"figure_{number}": "1" for number in range(40)}}


def test_a_record_of_a_batch_is_found_by_its_number(tmp_path):
    for name in "trial-busy-1", "trial-busy-2":
        with pytest.raises(Failure) if name.endswith("2") else contextlib.nullcontext():
            (tmp_path / name).mkdir()
            (tmp_path / name / "trial.bag").write_text("")
            assert arguments.trial_in(str(tmp_path)) == tmp_path / name
    (tmp_path / "trial.bag").write_text("")
    assert arguments.trial_in(str(tmp_path)) == tmp_path


def test_of_two_records_the_only_one_with_a_bag_is_not_taken_for_the_one_that_was_meant(tmp_path):
    for name in "trial-1", "trial-2":
        (tmp_path / name).mkdir()
    (tmp_path / "trial-1/trial.bag").write_text("")
    with pytest.raises(Failure):
        arguments.trial_in(str(tmp_path))


@pytest.fixture
def trial(tmp_path):
    def write(**more):
        with open(tmp_path / "summary.csv", "w", newline="") as file:
            table = csv.DictWriter(file, ROW)
            table.writeheader()
            table.writerow({**ROW, **more})
        return tmp_path
    return write


@pytest.mark.parametrize("more, code, last", [
    ({}, 0, "The goal was reached in 28.550 s, with 1 collision with shelves and 0 with obstacles."),
    ({"shelf_collision_count": "unknown"}, 0, "The goal was reached in 28.550 s; contacts are unknown, as nothing told of them."),
    ({"result": "aborted", "reason": "stopped_by_signal", "bag": "missing"}, 1, "The goal was not reached: aborted, stopped by signal."),
])
def test_a_session_ends_in_at_most_eight_lines_with_its_result_last(trial, more, code, last, capsys):
    assert trials.report(trial(**more)) == code
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) <= 6 and lines[-1] == last
    assert any("show" in line and str(trial()) in line for line in lines)
    assert ("bag: missing" in lines) == ("bag" in more)


@pytest.mark.parametrize("damage", [
    lambda data: data[:2 * len(data) // 3], lambda data: data[:-1], lambda data: b"", lambda data: data.replace(b"reached", b"\xff\xfe"),
    lambda data: data.replace(b"result", b"reslut"), lambda data: data + data], ids=["cut", "no_end", "empty", "bytes", "title", "twice"])
def test_a_damaged_summary_is_named(damage, trial):
    path = trial() / "summary.csv"
    path.write_bytes(damage(path.read_bytes()))
    assert f"{path} is damaged" in refusal(lambda: trials.summary(path.parent))


@pytest.mark.parametrize("last, reason, repeated, counted, code", [
    ("TRIAL_END", "goal_reached", 0, 0, 0), ("TRIAL_END", "goal_reached", 0, 1, 1), ("TRIAL_END", "goal_reached", 1, 0, 1),
    ("PROGRESS", "no_end", 0, 0, 0),
    ("PROGRESS", "goal_reached", 0, 2, "has no end")])
def test_check_and_show_hold_the_journal_against_the_summary(last, reason, repeated, counted, code, trial, monkeypatch):
    args = types.SimpleNamespace(trial=journal_of(trial(reason=reason), (100.0, "TRIAL_START"), (110.0, last)), csv=False)
    monkeypatch.setattr(check, "tool", lambda package, name: name)
    monkeypatch.setattr(check, "show", lambda name, *words: {"check_trial": repeated, "count_trial": counted}[name])
    if code == "has no end":
        assert code in refusal(lambda: check.run(args), 1) and code in refusal(lambda: show.run(args), 1)
    else:
        assert check.run(args) == code and not show.run(args)


def test_the_last_trial_of_the_session_is_its_end_also_where_another_session_writes_beside_it(trial, monkeypatch, capsys):
    monkeypatch.setattr("navvi_cli.workspace.show", lambda *words: 0)
    out = trial().parent / "out"
    for number in "123":
        (out / f"trial-{number}").mkdir(parents=True)
        (out / f"trial-{number}/summary.csv").write_bytes((trial(seed=number) / "summary.csv").read_bytes())
    log = session.Log(out / "log")
    for name in "trial-1", "trial-2", "trial-4":
        log.take(f"\x1b[0m[ INFO] [1700000000.5, 12.5]: Trial {name} has begun: goal at 1.00, 2.00.\x1b[0m\n")
    assert run.report(out, log.begun, ".") == 0
    assert "trial-2" in capsys.readouterr().out
    for why in (".", "; the log LOG says why. There is no map."):
        assert refusal(lambda: run.report(out, [], why), 1) == f"the session ended without a trial{why}"


def test_the_table_of_a_tutorial_is_kept_with_its_own_trial(tmp_path):
    for name in "trial-1", "trial-2":
        (tmp_path / name).mkdir()
        (tmp_path / name / "summary.csv").touch()
    tutorial.keep("step,tries,seconds,passed,practice\nlet_go,1,3.6,yes,no\n", tmp_path, ["trial-1"])
    assert [path.parent.name for path in tmp_path.glob("*/tutorial.csv")] == ["trial-1"]


@pytest.mark.parametrize("name", bench.benchmarks())
def test_each_benchmark_is_run_by_the_name_that_a_refusal_lists(name, monkeypatch):
    ran = []
    for word in "shell", "build", "enter":
        monkeypatch.setattr(bench, word, lambda *_: None)
    monkeypatch.setattr(bench, "show", lambda path, *_: ran.append(path.stem) or 0)
    assert bench.run(types.SimpleNamespace(filter=name, words=["DIR"])) == 0 and ran == [name.partition("/")[2]]


def test_a_replay_has_the_voice_and_the_mesh_of_the_record_and_nothing_else(tmp_path):
    settings = "feedback/speaker/rate%3d220 nav/mesh/climb%3d0.1 nav/mesh/x%3d$(eval) nav/mesh/zones%3d/home/me/zones.yaml sim/seed%3d3"
    (tmp_path / "journal.csv").write_text(f"t,1,0,0,NODE,a=b,00000000\nt,2,0,0,TRIAL_START,world=busy;voice=en-us;settings={settings},00000000\n")
    assert replay.recorded(tmp_path) == {"speaker": "{rate: 220, voice: en-us}", "mesh": "{climb: 0.1}"}
    assert replay.recorded(tmp_path / "none") == {"speaker": "{}", "mesh": "{}"}


def journal_of(folder, *rows):
    folder.mkdir(exist_ok=True)
    (folder / "journal.csv").write_text("".join(f"t,{seq},{int(time * 1e9)},0,{kind},a=b,00000000\n" for seq, (time, kind) in enumerate(rows, 1)))
    return folder


def test_a_replay_begins_some_seconds_before_the_event_that_is_named(tmp_path):
    trial = journal_of(tmp_path / "t", (100.0, "TRIAL_START"), (110.0, "COLLISION"), (102.0, "CUE"), (131.5, "COLLISION"))
    assert replay.moment(trial, "collision:2") == 26.5 and replay.moment(trial, "collision") == 5.0
    assert replay.moment(trial, "cue:1") == 0.0 and replay.moment(trial, "73.5") == 73.5
    for wrong, sentence in {"collision:3": "has 2 of these", "colision": "collision, cue, trial_start", "collision:0": "allowed are", "-3": "allowed are"}.items():
        assert sentence in refusal(lambda: replay.moment(trial, wrong))
    assert "lacks it" in refusal(lambda: replay.moment(journal_of(tmp_path / "cut", (110.0, "COLLISION")), "3"))


def test_a_replay_is_paused_and_stepped_by_keys(capsys):
    calls, answers = [], True
    keys = replay.Keys(1000.0, lambda pause: calls.append(pause) or answers)
    keys.read(["p\n", "p\n", "s\n", "p\n", "\n", "what\n"])
    assert calls == [True, False, False, True, False]
    assert "is paused" in capsys.readouterr().out
    answers = False
    keys.read(["p\n", "s\n"])
    assert not keys.paused and capsys.readouterr().out == "", "of what the player did not do nothing is said"


def test_points_and_tables_are_for_programs(capsys):
    worlds.table(["what", "value"], {"6 \"x\"": 1, "start": [1.5, 2, 0], "path": [[1.0, 2.0], [3, 4]], "none": []}.items())
    assert list(csv.reader(capsys.readouterr().out.splitlines())) == [
        ["what", "value"], ["6 \"x\"", "1"], ["start", "1.5,2,0"], ["path", "1.0,2.0 3,4"], ["none", ""]]


def launch_of(name, *words):
    """What roslaunch makes of a launch file."""
    import roslaunch.config
    os.environ.setdefault("ROS_MASTER_URI", "http://127.0.0.1:1")
    return roslaunch.config.load_config_default([(str(ROOT / "launch" / name), list(words))], 11311, verbose=False)


@pytest.mark.parametrize("name, word", [("live.launch", "operator:=simulated"), ("robot.launch", "rviz:=false"), ("replay.launch", "bag:=/b"),
                                        ("lesson.launch", "speech:=false")])
def test_each_node_with_parameters_begins_without_those_of_a_last_session(name, word):
    config = launch_of(name, word)
    nodes = {f"{node.namespace}{node.name}/" for node in config.nodes if node.name.endswith(("_node", "cue_player"))}
    assert nodes and nodes == set(config.clear_params)


def test_paths_with_blanks_and_apostrophes_reach_the_player_whole(tmp_path):
    import roslaunch.node_args
    bag = tmp_path / "Anna's trial/trial.bag"
    config = launch_of("replay.launch", f"bag:={bag}")
    for node in config.nodes:
        if node.name in ("player", "scene_player"):
            assert str(bag) in roslaunch.node_args.create_local_process_args(node, config.machines[""]), node.name


# --- what the shell does

def test_a_stop_ends_what_runs_as_root_too(tmp_path):
    """Of another user's processes only sudo can end it."""
    (tmp_path / "sudo").write_text(f"#!/bin/sh\nprintf '%s\\n' \"$*\" >> {tmp_path}/calls\nshift\nexec \"$@\"\n")
    (tmp_path / "sudo").chmod(0o755)
    script = (f"set -euo pipefail; PATH={tmp_path}:$PATH; source {ROOT}/navvi_cli/shell/say.bash; stopped_by_signals; percent() {{ echo 0; }}\n"
              f"install() {{ local as_root=(sudo -n); with_progress installing {tmp_path}/log percent sh -c 'echo begun; sleep 60'; }}\ninstall\n")
    with subprocess.Popen(["bash", "-c", script], stderr=subprocess.DEVNULL) as shell:
        assert eventually(lambda: (tmp_path / "log").exists() and (tmp_path / "log").read_text(), 20)
        shell.terminate()
        assert shell.wait(20) == 130
    assert re.fullmatch(r"-n .*kill -TERM -- -\d+\n", (tmp_path / "calls").read_text())


@pytest.mark.parametrize("end, code", [("true", 0), ("kill -9 $$", 1)])
def test_a_run_of_the_tests_that_was_killed_has_not_passed(end, code, tmp_path):
    """Though the results of the run before are there."""
    passed = "<testsuite><testcase name='a'/></testsuite>"
    for path, text in {"ws/build/test_results.xml": passed, "test/find_tests.py": "", "test/count_results.py": (ROOT / "test/count_results.py").read_text(),
                       "bin/ctest": "#!/bin/sh\necho Total Tests: 1\n",
                       "test/run_tests.py": f"import os, sys\nopen(os.path.dirname(sys.argv[1]) + '/test_results/a.xml', 'w').write(\"{passed}\")\n"
                                            f"if '{end}' == 'true': open(sys.argv[1], 'w').write(\"{passed}\")\nelse: os.kill(os.getpid(), 9)\n"}.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text)
    (tmp_path / "bin/ctest").chmod(0o755)
    script = (f"set -euo pipefail; PATH={tmp_path}/bin:$PATH root={tmp_path} workspace={tmp_path}/ws; source {ROOT}/navvi_cli/shell/say.bash\n"
              f"source {ROOT}/navvi_cli/shell/tests.bash; install_packages() {{ true; }}; build_workspace() {{ true; }}; tests quick\n")
    done = subprocess.run(["bash", "-c", script], capture_output=True, text=True)
    assert done.returncode == code, done.stdout + done.stderr


def test_F6_a_picture_that_crashes_is_started_anew_five_times(tmp_path):
    for name, text in ("rviz", f"echo begun >>{tmp_path}/log; kill -SEGV $$"), ("sleep", ""):
        (tmp_path / name).write_text(f"#!/bin/sh\n{text}\n")
        (tmp_path / name).chmod(0o755)
    env = {"PATH": f"{tmp_path}:{os.environ['PATH']}"}
    done = subprocess.run([ROOT / "navvi_ws/src/navvi_rviz/scripts/readable", tmp_path / "rviz"], env=env, capture_output=True, text=True, timeout=60)
    assert (tmp_path / "log").read_text().count("begun") == 1 + 5
    assert done.returncode == 128 + 11 and done.stderr.count("the program rviz was ended by signal 11.") == 6, done.stderr


@pytest.mark.parametrize("steps, answer", [(0, "up to date"), (1, "to build"), (20000, "to build")])
def test_however_much_is_to_build_it_is_seen(steps, answer, tmp_path):
    (tmp_path / "ninja").write_text(f"#!/bin/sh\nfor i in $(seq {steps}); do echo \"[$i/{steps}] Building CXX object x$i.o\"; done\n"
                                    "echo '[1/1] genmsg_check_deps_x'\n")
    (tmp_path / "ninja").chmod(0o755)
    script = (f"set -euo pipefail; source {ROOT}/navvi_cli/shell/workspace.bash; is_configured() {{ true; }}; PATH={tmp_path}:$PATH; "
              "if is_built x y; then echo up to date; else echo to build; fi")
    assert subprocess.check_output(["bash", "-c", script], text=True) == answer + "\n"


def test_the_version_needs_no_git(monkeypatch):
    from navvi_cli import version
    monkeypatch.setenv("PATH", "/nonexistent")
    assert "+" not in version.version()

