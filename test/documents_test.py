"""Each command line of README.md and doc/*.md, taken from the files themselves, in a fresh shell.

What measures, needs a person's devices or another machine is parsed alone; what runs until it is stopped ends at its ready line.
"""
import os
import re
import shlex
import shutil
import signal
import subprocess
import time

import pytest

import fake_robot
from display import Display
from sessions import ROOT
from navvi_cli.arguments import LaunchFile, words_for
from navvi_cli.main import parser_of
from navvi_cli.say import Failure
from navvi_people import batch

PAGES = [ROOT / "README.md", *sorted((ROOT / "doc").glob("*.md"))]
ELSEWHERE = ("git clone", "cd navvi", "podman", "apt ", "sudo ", "parallel ")  # other machines, and the system itself
LAUNCHES = {"run": "live.launch", "tutorial": "live.launch", "glossary": "lesson.launch", "calibrate": "lesson.launch"}
READY = {"./navvi run": "a session begins in some seconds", "roslaunch": "No trial yet: waiting for"}
# What a document leaves to its reader, as it is here.
GIVEN = {"MAP.bt": "my_map.bt", "X,Y": "1,-9", "COMMAND": "run", "ROW": "L5"}


def blocks(text):
    """The lines of code in a row, each with those that it goes on in."""
    text = re.sub(r"^```(\w*)\n(.*?)^```$", lambda code: re.sub("^", "    ", code[2], flags=re.M) if code[1] in ("", "bash") else "", text,
                  flags=re.M | re.S)
    text = text.replace("\\\n", " ")
    for block in re.findall(r"(?:^ {4}.*\n)+", text, re.M):
        lines = [line.strip() for line in block.splitlines()]
        yield [line for line in lines if is_command(line)]


def is_command(line):
    word = line.split(" ")[0] if line else ""
    return word in ("./navvi", "source", "for", "cd") or bool(re.fullmatch(r"[a-z]+", word) and shutil.which(word) and " " in line)


def found():
    """(page, the sources before it in its block, command)"""
    for page in PAGES:
        text = page.read_text()
        for lines in blocks(text):
            before = [line for line in lines if line.startswith("source ")]
            for line in lines:
                yield page.name, before if line.startswith("ros") else [], re.sub(r"\s+#.*", "", line)
        for span in re.findall(r"`(\./navvi [^`]+|ros[a-z]+ [^`]+)`", re.sub(r"^ {4}.*$", "", text, flags=re.M)):
            yield page.name, None, re.sub(r"\s+", " ", span)


FOUND = list(dict.fromkeys((page, tuple(before) if before is not None else None, line) for page, before, line in found()))
# Heading and lines of each script of the page of first hours; what needs a person's hands is left out.
HOURS = re.findall(r"^## (.*)\n((?:(?!## ).*\n)*)", (ROOT / "doc/hours.md").read_text(), re.M)
HANDS = r"navvi (tutorial|calibrate)|operator:=(pad|keyboard)|person:="
LINES = [each for each in FOUND if not each[2].startswith(ELSEWHERE)]


def runs(before, line):
    """Whether it does something here, beside being parsed."""
    return before is not None and " robot:=" not in line and line.startswith(("./navvi run", "./navvi world", "./navvi navmesh", "./navvi study check", "roslaunch", "source"))


@pytest.fixture(scope="module")
def papers(tmp_path_factory):
    """A folder with what the documents speak of, as far as it is only named."""
    folder = tmp_path_factory.mktemp("desk")
    for name in "navvi", "navvi_ws":
        (folder / name).symlink_to(ROOT / name)
    worlds = ROOT / "navvi_ws/src/navvi_sim/worlds"
    shutil.copy(worlds / "cross_dock.yaml", folder / "my_layout.yaml")
    (folder / "my_models").mkdir()
    for name in "my.world", "my_map.bt", "my_robot.bag":
        (folder / name).touch()
    (folder / "round.yaml").write_text("- {name: packing table, x: -23.9, y: 2.8, do: pick}\n")
    (folder / "study").mkdir()
    for plan in "plan.yaml", "study/plan.yaml":
        shutil.copy(ROOT / "navvi_ws/src/navvi_study/studies/example_plan.yaml", folder / plan)
    trial = folder / "trials/TRIAL"
    trial.mkdir(parents=True)
    for name in "trial.bag", "summary.csv", "journal.csv":
        (trial / name).touch()
    return folder


@pytest.fixture(scope="module")
def desk(papers):
    """With a world and a map, too."""
    (papers / "my.world").write_text(re.search(r"^```xml\n(.*?)^```", (ROOT / "doc/worlds.md").read_text(), re.M | re.S)[1])
    subprocess.run(["./navvi", "world", "check", "warehouse", "-o", "my_map.bt"], cwd=papers, check=True, stdout=subprocess.DEVNULL)
    write_bag(papers / "my_robot.bag")
    return papers


def write_bag(path):
    """Of a robot that stands in a room for 30 s."""
    import rosbag
    import rospy
    from nav_msgs.msg import Odometry
    from tf2_msgs.msg import TFMessage
    with rosbag.Bag(str(path), "w") as bag:
        for tick in range(300):
            now = rospy.Time.from_sec(1000 + tick / 10)
            odometry = Odometry(child_frame_id="base_link")
            odometry.header.frame_id, odometry.header.stamp, odometry.pose.pose.orientation.w = "odom", now, 1.0
            frames = [fake_robot.transform(*each, now) for each in (("map", "odom", 0.0), ("odom", "base_link", 0.0), ("base_link", "laser", 0.2))]
            for topic, message in ("/tf", TFMessage(frames)), ("/odom", odometry), ("/scan", fake_robot.scan_of(fake_robot.HABITS, now)):
                bag.write(topic, message, now)


def test_the_documents_are_read():
    assert len(LINES) > 60
    assert sum(runs(before, line) for _, before, line in LINES) > 20
    assert ("README.md", ("source navvi_ws/devel/setup.bash",),
            "roslaunch navvi robot.launch wheels:=/my_robot/cmd_vel rehearse:=true") in LINES
    assert any(line.startswith("git clone") for _, _, line in FOUND) and any(line.startswith("podman") for _, _, line in FOUND) is False


@pytest.mark.parametrize("page, before, line", LINES, ids=lambda value: value if isinstance(value, str) else "")
def test_a_command_is_taken(page, before, line, papers, monkeypatch):
    monkeypatch.chdir(papers)
    assert subprocess.run(["bash", "-n", "-c", line], stderr=subprocess.PIPE).returncode == 0, page
    for command in re.findall(r"\./navvi ([a-z].*?)(?:;|$)", line):
        for name, value in GIVEN.items():
            command = command.replace(name, value)
        words = shlex.split(command)
        if not re.search(r"[A-Z]{3,}|\.\.\.|[$*]", command.replace("TRIAL", "")):  # else what stands there is for its reader to fill in
            if "--help" in words:
                continue
            try:
                args = parser_of(words[0]).parse_args(words)
            except Failure as refused:  # within a sentence a command may be named without all that it needs
                assert before is None and refused.sentence.startswith("missing: "), refused.sentence
                continue
            if words[0] in LAUNCHES:
                far = any(word.startswith("robot:=") for word in args.words)
                taken = [word for word in args.words if not word.startswith("robot:=") and (words[0] == "run" or not word.startswith("out:="))]
                words_for(LaunchFile("person.launch" if far else LAUNCHES[words[0]]), taken)
            if words[0] == "batch":
                assert batch.trials_of(args) and batch.shard_of(args.shard)
    for name, words in re.findall(r"^roslaunch navvi (\w+\.launch)(.*)", line):
        known = set(re.findall(r'<arg name="(\w+)"', (ROOT / "launch" / name).read_text()))
        assert {word.partition(":=")[0] for word in shlex.split(words.removesuffix("&"))} <= known, page


@pytest.mark.parametrize("page, before, line", [each for each in LINES if runs(*each[1:]) and each[0] != "hours.md"], ids=lambda value: value if isinstance(value, str) else "")
def test_a_command_runs_in_a_fresh_shell(page, before, line, desk):
    if re.search(r"operator:=(pad|keyboard)", line):
        pytest.skip("it needs a person's devices")
    for name, value in GIVEN.items():
        line = line.replace(name, value)
    display = Display() if line.startswith("roslaunch") else None
    env = {"HOME": str(desk), "PATH": "/usr/bin:/bin", "TERM": "dumb", "ROS_MASTER_URI": "http://127.0.0.1:11499", "ROS_IP": "127.0.0.1"}
    # Other flags than those of this build would build all anew, under the other tests.
    env.update({name: os.environ[name] for name in ("NAVVI_WARNINGS_ARE_ERRORS",) if name in os.environ})
    if display:
        env.update(DISPLAY=display.name, LIBGL_ALWAYS_SOFTWARE="1")
        line = f"exec {line} --port=11499"
    else:
        del env["ROS_MASTER_URI"], env["ROS_IP"]
    process = subprocess.Popen(["bash", "--noprofile", "--norc", "-c", "\n".join([*before, line])], cwd=desk, env=env, text=True, start_new_session=True,
                               stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    ready = next((text for start, text in READY.items() if line.removeprefix("exec ").startswith(start)), None)
    said = ""
    try:
        deadline = time.monotonic() + 120
        for text in process.stdout:
            said += text
            assert time.monotonic() < deadline, said
            if ready and ready in text:
                break
        assert not ready or ready in said, said
        assert not re.search(r"Cannot locate|do not exist|Traceback|has died", said), said
    finally:
        if ready:
            os.killpg(process.pid, signal.SIGINT)
        rest = process.communicate(timeout=40)[0]
        if display:
            display.close()
    assert ready or process.returncode == 0, said + rest


@pytest.mark.parametrize("hour, text", HOURS, ids=[hour for hour, _ in HOURS])
def test_a_first_hour_runs_as_a_script(hour, text, desk):
    lines = [line.strip() for line in text.splitlines() if line.startswith("    ") and not re.search(HANDS, line)]
    script = "\n".join(lines).replace("roscore", "roscore -p 11499")
    display = Display()
    env = {"HOME": str(desk), "PATH": "/usr/bin:/bin", "TERM": "dumb", "ROS_MASTER_URI": "http://127.0.0.1:11499", "ROS_IP": "127.0.0.1",
           "DISPLAY": display.name, "LIBGL_ALWAYS_SOFTWARE": "1", **{name: os.environ[name] for name in ("NAVVI_WARNINGS_ARE_ERRORS",) if name in os.environ}}
    process = subprocess.Popen(["bash", "--noprofile", "--norc", "-e", "-m", "-c", script], cwd=desk, env=env, text=True, start_new_session=True,
                               stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    try:
        said = process.communicate(timeout=1200)[0]
    finally:
        for group in subprocess.run(["ps", "-o", "pgid=", "-s", str(process.pid)], capture_output=True, text=True).stdout.split():
            os.killpg(int(group), signal.SIGKILL)
        display.close()
    assert process.returncode == 0 and lines and not re.search(r"Cannot locate|do not exist|Traceback|exit code -?[1-9]", said), said[-6000:]
