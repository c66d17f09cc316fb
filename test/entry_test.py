"""The entry script, the launch files, the views and the parameter files, as they ship."""
import fcntl
import os
import pathlib
import re
import shutil
import subprocess
import xml.etree.ElementTree as ElementTree

import pytest
import yaml

from sessions import ROOT, navvi, roslaunch, summary
from navvi_cli.arguments import LaunchFile, words_for
from navvi_cli.session import check_parameters

SIMULATED = ["operator:=simulated", "rviz:=false"]


def sentences(result):
    """What was said beside the result, but for how far a build is, or another test's."""
    return [line for line in result.stderr.splitlines() if not line.startswith(("navvi: building:", "navvi: waiting for another build"))]


def test_a_python_without_its_library_ends_in_a_sentence():
    """As of python3-minimal alone, where apt cannot help."""
    hidden = "; ".join(f"mount -t tmpfs none {path}" for path in pathlib.Path("/usr/lib").glob("python3*/xml"))
    without = ["unshare", "--map-root-user", "--mount", "sh", "-e", "-c", f"{hidden}; exec \"$@\"", "sh"]
    if subprocess.run([*without, "true"], capture_output=True).returncode:
        pytest.skip("no mount namespace is allowed here")
    result = subprocess.run([*without, str(ROOT / "navvi"), "help"], capture_output=True, text=True, timeout=60)
    assert (result.returncode, result.stderr) == (1, "navvi: Python lacks its library; \"apt install python3\" installs it.\n"), result


def test_nothing_is_compiled_among_the_sources(tmp_path):
    """The build would count as out of date, and who may not write there could run nothing."""
    shutil.copy(ROOT / "navvi", tmp_path)
    for path in ROOT / "navvi_cli", *(ROOT / "navvi_ws/src").glob("*/python"):
        shutil.copytree(path, tmp_path / path.relative_to(ROOT), ignore=shutil.ignore_patterns("__pycache__"))
    env = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
    done = subprocess.run([tmp_path / "navvi", "show", "/nonexistent"], env=env, capture_output=True, text=True, timeout=60)
    assert done.returncode == 2 and "holds no summary.csv" in done.stderr, done
    assert not list(tmp_path.rglob("__pycache__"))


def test_shell_scripts_are_clean():
    subprocess.run(["shellcheck", ROOT / ".ci" / "run", ROOT / "navvi"], check=True)
    whole = "".join(path.read_text() for path in [*sorted((ROOT / "navvi_cli/shell").glob("*.bash")), ROOT / "navvi_cli/shell/run"])
    subprocess.run(["shellcheck", "--shell=bash", "-"], input=whole, text=True, check=True)


@pytest.mark.parametrize("words, sentence", [
    (["fly"], "is not a sub-command"),
    (["run", "fast"], "arguments look like name:=value"),
    (["run", "operator:=robot"], "allowed are: auto pad keyboard simulated"),
    (["run", "operator:=simulated", "rviz:=true"], "needs a display"),
    (["run", "operator:=keyboard"], "needs a display"),
    (["run", *SIMULATED, "speech:=false"], "the simulated person drives by what it hears"),
    (["run", *SIMULATED, "vision:=x-ray"], "allowed are: high_contrast"),
    (["run", *SIMULATED, "once:=maybe"], "allowed are: true false"),
    (["run", *SIMULATED, "world:=office"], "no world and no file has the name \"office\"; allowed are: training"),
    (["run", *SIMULATED, "world:=training", "start:=here"], "of the form x,y,yaw"),
    (["run", *SIMULATED, "wheels/size:=1"], "those of feedback nav operator perception sim trial can be given"),
    (["run", *SIMULATED, "feedback/haptics/enabld:=1"], "the key \"haptics/enabld\" is unknown"),
    (["run", *SIMULATED, "feedback/speaker/rate:=fast"], "speaker/rate"),
    (["run", *SIMULATED, "nav/mesh/robot_height:=0.5"], "less than 0.8 m, the height of the simulated robot"),
    (["run", *SIMULATED, "sim/seed:=7"], "\"sim/seed\" would have no effect; allowed is seed:=7."),
    (["run", *SIMULATED, "trial/version:=2"], "\"trial/version\" cannot be given: the session itself sets it;"),
    (["run", *SIMULATED, "models:=/nonexistent"], "models:=/nonexistent is not a folder"),
    (["run", *SIMULATED, "out:=/proc/none"], "cannot be made"),
    (["check"], "missing: TRIAL"),
    (["setup", "now"], "allowed is: ./navvi setup"),
    (["build", "--fast"], "[--asan] [--odr]"),
    (["parameters", "--xml"], "allowed is: ./navvi parameters [FILTER] [--csv]"),
    (["parameters", "nope"], "and parts of: cue_player feedback_node"),
    (["world"], "missing: ACTION"),
    (["world", "lst"], "allowed are: list check show"),
    (["world", "show"], "missing: NAME|FILE"),
    (["bench", "foo"], "allowed are parts of: build/build_bench nav/nav_bench"),
    (["test", "quick", "a", "b"], "unexpected argument"),
    (["test", "no_such_" + "word"], "no test's name contains \"no_such_word\""),
    (["bench", "trials", "--world=/"], "\"/\" is a folder; allowed are: training"),
    (["run", "foo:=bar"], "participant person places profile robot rviz"),
    (["run", *SIMULATED, "world:=" + 300 * "x"], "no world and no file has the name"),
    (["run", *SIMULATED, "models:=" + 300 * "x"], "is not a folder"),
    (["bench", "trials", "--world=nope"], "no world and no file has the name \"nope\""),
    (["batch", "--worlds=nope", "--out=/nonexistent"], "no world and no file has the name \"nope\""),
    *((["batch", "--out=/nonexistent", f"--{option}={value}"], f"--{option} is \"{value}\"; allowed are whole numbers from {least} to")
      for option, least, values in (("jobs", 1, ("0", "-2", "1.5")), ("limit", 1, ("-1", "nan")), ("cache", 0, ("-5", "x"))) for value in values),
    (["batch", "--out=/nonexistent", "--tell=nan"], "--tell is \"nan\"; allowed are numbers from 0 to 86400."),
    (["batch", "--out=/nonexistent", "--seeds=1-999999999999"], "--seeds has"),
    (["batch", "--out=/nonexistent", "--people=drawn:1-1000000", "--seeds=1-2"], "these make 2000000 trials"),
    (["test", "hours", "nan"], "the time in hours is \"nan\"; allowed are"),
    (["completion", "fish"], "allowed are: bash zsh"),
    (["navmesh"], "missing: MAP"),
    (["man", "-x"], "\"-x\" is not taken here"),
    (["run", "operator:=pad"], "needs a game controller"),
    (["show"], "missing: TRIAL"),
    (["show", "/nonexistent"], "holds no summary.csv"),
    (["watch", "port:=1"], "no session runs at port:=1"),
    (["watch", "a/b/c"], "holds no trial.bag"),
    (["robot", "check", "wheel:=/a"], "\"wheel\" is unknown"),
    (["robot", "check", "radius:=20cm"], "radius:=20cm is not allowed; allowed are numbers above 0."),
    (["robot", "check", "perception/no_return:=fre"], "perception_node refuses this: "),
    (["robot", "check", "perception/foo:=1"], "the key \"foo\" is unknown"),
    *((["robot", action, "safety/foo:=1"], "relay_node refuses this: the arguments: the key \"foo\" is unknown") for action in ("start", "check")),
    (["robot", "start", "safety/emergency_stop:=/stop"], "\"safety/emergency_stop\" would have no effect; allowed is emergency_stop:=/stop."),
    (["replay"], "missing: TRIAL"),
    (["calibrate"], "person:=NAME is needed"),
    (["glossary", "world:=busy"], "\"world\" is unknown"),
    (["glossary", "operator:=pad"], "none is connected"),
    (["glossary", "out:=-x"], "such as ./-x."),
    (["tutorial", "lesson:=none"], "given twice"),
    (["tutorial"], "the tutorial needs a person"),
    (["replay", "/nonexistent"], "holds no trial.bag"),
    (["check", "-x"], "missing: TRIAL"),
    (["check", "none/at/all"], "holds no trial.bag"),
])
@pytest.mark.accessibility
def test_P2_a_wrong_word_is_refused_with_a_sentence(words, sentence):
    result = navvi(*words)
    assert result.returncode == 2
    [said] = sentences(result)
    assert said.startswith("navvi: ") and sentence in said
    assert re.search(r"allowed|known (are|here)|lists|such as|look like|can be given|needs? none|needed|do\.", said), "what to do"
    assert "ROS_MASTER_URI" not in result.stdout, "a session was started"


@pytest.mark.parametrize("words, code", [(["world", "check", "training"], 0), (["check", "{}"], 2), (["watch", "{}"], 2), (["world", "list"], 0)],
                         ids=lambda words: " ".join(words) if isinstance(words, list) else "")
def test_what_needs_no_build_waits_for_none(words, code, tmp_path):
    (tmp_path / "trial.bag").write_text("no bag")
    with open(ROOT / "navvi_ws/.lock", "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        result = navvi(*[word.format(tmp_path) for word in words])
    assert result.returncode == code and "waiting" not in result.stderr and len(result.stdout + result.stderr) > 20


@pytest.mark.parametrize("text, sentence", [
    ("speaker:\n  rate: 900\n", ", line 2: \"speaker/rate\" is 900; allowed is 80 to 449 words/min."),
    ("speaker: {rate: 1\n", "this is not YAML"),
    ("input: pad\n", "the key \"input\" is unknown"),
    ("lesson: glossary\n", "the key \"lesson\" is unknown"),
])
def test_a_person_s_wrong_settings_are_refused_before_anything_starts(text, sentence, tmp_path):
    (tmp_path / "anna.yaml").write_text(text)
    result = navvi("run", *SIMULATED, "person:=anna", NAVVI_PEOPLE=str(tmp_path))
    assert result.returncode == 2
    assert str(tmp_path / "anna.yaml") in result.stderr and sentence in result.stderr
    assert len(sentences(result)) == 1
    assert "ROS_MASTER_URI" not in result.stdout, "a session was started"


def test_a_person_s_settings_are_used_in_a_session_and_named_in_its_record(tmp_path):
    (tmp_path / "anna.yaml").write_text("speaker: {rate: 300}\ncues: {wording: {units: feet, verbosity: full}}\n")
    result = navvi("run", *SIMULATED, "world:=training", "person:=anna", "feedback/cues/wording/units:=meters", f"out:={tmp_path}/out", "limit:=1",
                   NAVVI_PEOPLE=str(tmp_path))
    journal = next((tmp_path / "out").glob("trial-*/journal.csv")).read_text()
    settings = next(word for word in journal.replace("%3d", "=").split(";") if word.startswith("settings=")).split(" ")
    for word in "feedback/speaker/rate=300", "feedback/cues/wording/units=meters", "feedback/cues/wording/verbosity=full", "feedback/person=anna":
        assert word in settings, result.stderr
    assert summary(tmp_path / "out")["parameters"] == "feedback/person=anna feedback/cues/wording/units=meters"


@pytest.fixture
def map_file(tmp_path):
    """A room as map_server stores it."""
    (tmp_path / "room.pgm").write_bytes(b"P5 60 60 255\n" + bytes(254 if 5 < i % 60 < 55 and 5 < i // 60 < 55 else 0 for i in range(3600)))
    (tmp_path / "room.yaml").write_text("image: room.pgm\nresolution: 0.1\norigin: [0, 0, 0]\nnegate: 0\n"
                                        "occupied_thresh: 0.65\nfree_thresh: 0.196\n")
    return str(tmp_path / "room.yaml")


@pytest.mark.parametrize("picture", ["room.png", "room.ppm"])
def test_a_map_is_read_whatever_its_picture_is(picture, map_file, tmp_path):
    Image = pytest.importorskip("PIL.Image")
    plain = navvi("navmesh", map_file, "--csv").stdout
    Image.open(tmp_path / "room.pgm").convert("RGB").save(tmp_path / picture)
    other = tmp_path / "other.yaml"
    other.write_text(pathlib.Path(map_file).read_text().replace("room.pgm", picture))
    rows = [[line for line in text.splitlines() if " ms," not in line] for text in (plain, navvi("navmesh", str(other), "--csv").stdout)]
    assert len(rows[0]) > 8 and rows[0] == rows[1]
    (tmp_path / picture).write_bytes(b"\x89PNG or not")
    broken = navvi("navmesh", str(other))
    assert broken.returncode == 2 and len(sentences(broken)) == 1 and f"{picture}: the picture cannot be read" in broken.stderr


@pytest.mark.parametrize("command", [["world", "show", "training"], ["navmesh", None]], ids=lambda words: words[0])
def test_a_picture_is_what_its_ending_says(command, map_file, tmp_path):
    command = [word or map_file for word in command]
    result = navvi(*command, "-o", str(tmp_path / "a.png"))
    assert result.returncode == 0, result.stderr
    assert (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")
    for name, sentence in [("a.gif", ".svg and .png are allowed"), ("none/a.png", "cannot be drawn: No such file or directory")]:
        result = navvi(*command, "-o", str(tmp_path / name))
        assert result.returncode == 2
        assert sentence in result.stderr and len(sentences(result)) == 1


def test_a_world_is_shown_with_the_path_that_a_person_is_led_along(tmp_path):
    result = navvi("world", "show", "busy", "seed:=7", "-o", str(tmp_path / "a.svg"))
    assert result.returncode == 0, result.stderr
    assert "guide path, and a turn" in (tmp_path / "a.svg").read_text()


def box(name, size, pose):
    return (f'<model name="{name}"><static>1</static><pose>{pose} 0 0 0</pose><link name="l"><collision name="c">'
            f'<geometry><box><size>{size}</size></box></geometry></collision></link></model>')


@pytest.fixture
def door_world(tmp_path):
    """Two rooms with a door of 0.9 m, and a closed cell in one of them."""
    cell = "".join(box(f"wall_{i}", size, pose) for i, (size, pose) in enumerate([
        ("3 .2 2", "5 3.4 1"), ("3 .2 2", "5 6.6 1"), ("0.2 3.4 2", "3.5 5 1"), ("0.2 3.4 2", "6.5 5 1")]))
    (tmp_path / "door.world").write_text(
        '<sdf version="1.6"><world name="w">' + box("floor", "20 20 .1", "0 0 -.05") + cell
        + box("wall_a", ".2 9.55 2", "0 5.225 1") + box("wall_b", ".2 9.55 2", "0 -5.225 1") + "</world></sdf>")
    return str(tmp_path / "door.world")


@pytest.mark.parametrize("goal, code, sentence", [
    ("5,0", 0, "shortest way 10.0 m"),
    ("0,5", 2, "the goal is within the robot's radius of an obstacle"),
    ("5,5", 2, "no floor joins the goal with the robot"),
    ("30,0", 2, "the map shows no floor at the goal"),
])
def test_the_verdict_on_a_world_is_the_one_of_navigation(goal, code, sentence, door_world):
    result = navvi("world", "check", door_world, "start:=-5,0,0", f"goal:={goal}")
    assert result.returncode == code, result.stderr
    assert sentence in result.stdout + result.stderr
    if code:
        result = navvi("run", *SIMULATED, f"world:={door_world}", "start:=-5,0,0", f"goal:={goal}")
        assert result.returncode == code and sentence in result.stderr
        assert "ROS_MASTER_URI" not in result.stdout, "a session was started"


@pytest.mark.parametrize("path", sorted((ROOT / "launch").glob("*.launch")), ids=lambda path: path.name)
def test_each_launch_file_resolves_to_nodes_that_exist(path):
    needed = [f"{arg.get('name')}:=/nonexistent" for arg in ElementTree.parse(path).getroot().iter("arg")
              if arg.get("default") is None and arg.get("value") is None]
    roslaunch("--nodes", path.name, *needed)
    for node in ElementTree.parse(path).getroot().iter("node"):
        found = subprocess.run(["catkin_find", "--libexec", node.get("pkg"), node.get("type")],
                               capture_output=True, text=True, timeout=60)
        installed = pathlib.Path(f"/usr/lib/{node.get('pkg')}/{node.get('type')}")
        assert found.stdout.strip() or installed.exists() or node.get("pkg") == "rviz", node.get("type")


def test_only_the_simulated_robot_is_held_to_one_level():
    def climb(name, *words):
        return yaml.safe_load(roslaunch("--dump-params", name, "rviz:=false", *words)).get("/nav_node/mesh/climb")
    assert climb("live.launch", "profile:=paper") == 0.0
    assert climb("live.launch", "nav_parameters:={mesh: {climb: 0.1}}") == 0.1
    assert climb("robot.launch") is None


def test_P2_a_parameter_that_is_taken_is_in_force():
    """Of those that the session sets, such as sim/seed, ./navvi refuses what a <param> would win over."""
    given = {"sim": "wait_for_robot: false", "trial": "press_to_start: false, patience: 5.0, contacts: unknown, require: [speech]"}
    values = yaml.safe_load(roslaunch("--dump-params", "live.launch", "rviz:=false", *(f"{part}_parameters:={{{words}}}" for part, words in given.items())))
    for part, words in given.items():
        for name, value in yaml.safe_load(f"{{{words}}}").items():
            assert values[f"/{part}_node/{name}"] == value, name


@pytest.mark.parametrize("launch, more", [("robot.launch", ["rviz:=false"]), ("robot_side.launch", [])])
def test_P2_what_is_set_of_the_last_stage_before_the_wheels_reaches_it(launch, more):
    words = words_for(LaunchFile(launch), ["safety/assistance:=stop", "safety/max_linear:=0.3"])
    check_parameters(words)
    values = yaml.safe_load(roslaunch("--dump-params", launch, *more, f"safety_parameters:={words['safety_parameters']}"))
    assert (values["/relay_node/assistance"], values["/relay_node/max_linear"]) == ("stop", 0.3)


@pytest.mark.parametrize("path", sorted((ROOT / "rviz").glob("*.rviz")), ids=lambda path: path.name)
def test_each_view_file_offers_chase_top_and_forward(path):
    views = yaml.safe_load(path.read_text())["Visualization Manager"]["Views"]["Saved"]
    assert {view["Name"] for view in views} >= {"Chase", "Top", "Forward"}


NODES = [("navvi_sim", "sim_node"), ("navvi_nav", "nav_node"), ("navvi_feedback", "feedback_node"), ("navvi_perception", "perception_node"),
         ("navvi_safety", "relay_node"), ("navvi_study", "trial_node"), ("navvi_people", "operator_node")]


@pytest.mark.parametrize("package, node", NODES, ids=lambda word: word)
def test_P2_a_node_refuses_an_unknown_parameter_and_starts_nothing(package, node, master):
    result = subprocess.run(["rosrun", package, node, "_no_such_key:=1"], capture_output=True, text=True, timeout=30,
                            env=master)
    assert result.returncode == 2
    assert "the key \"no_such_key\" is unknown" in result.stdout + result.stderr
