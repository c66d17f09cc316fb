"""One whole session as a person starts it, watched from outside, and what it leaves behind."""
import datetime
import difflib
import os
import pty
import re
import shutil
import signal
import socket
import subprocess
import time
from pathlib import Path

import pytest
import rosbag
import rosgraph
import rospy
from geometry_msgs.msg import TwistStamped
from navvi_msgs.msg import Cue
from octomap_msgs.msg import Octomap

import hearing
from display import Display
from sessions import DARK, ROOT, WORLD, Command, Programs, Session, eventually, navvi, rows_of, sound, summary
from navvi_cli.network import Network

TOPICS = {
    "/clock", "/tf", "/tf_static", "/odom", "/octomap_binary", "/occupied_cells_vis_array", "/navvi/scene",
    "/navvi/obstacles", "/navvi/proximity", "/navvi/contacts", "/move_base_simple/goal", "/navvi/path",
    "/navvi/guidance", "/navvi/navmesh", "/joy", "/joy/set_feedback", "/navvi/command", "/navvi/cues", "/navvi/markers",
    "/navvi/events", "/diagnostics",
}
BAGGED = TOPICS - {"/clock", "/occupied_cells_vis_array", "/navvi/navmesh"}
MOST_BYTES = 55_000  # of a bag, for each simulated second: 0.2 GB an hour
PICTURE = ["/navvi/scene", "/navvi/scene_moving", "/navvi/navmesh", "/navvi/markers", "/navvi/path"]


class Watched(Session):
    """A session, and everything that was seen while it ran."""

    def __init__(self, folder, *words):
        self.display, self.heard, self.command, self.octomap = Display(), [], 0.0, None
        super().__init__(folder, *words, DISPLAY=self.display.name, LIBGL_ALWAYS_SOFTWARE="1", **sound(folder))
        self.wait_until_ready()

    def watch(self):
        os.environ["ROS_MASTER_URI"], os.environ["ROS_IP"] = self.uri, "127.0.0.1"
        rospy.init_node("outside_observer", anonymous=True, disable_signals=True, disable_rostime=True)
        rospy.Subscriber("/navvi/cues", Cue, self.heard.append)
        rospy.Subscriber("/navvi/command", TwistStamped, lambda msg: setattr(self, "command", msg.twist.linear.x))
        rospy.Subscriber("/octomap_binary", Octomap, lambda msg: setattr(self, "octomap", msg))

    def topics(self):
        return {name for name, _ in rosgraph.Master("/observer", self.uri).getTopicTypes()}

    def listening(self):
        """(command line, socket) of this session's programs alone: other tests run beside it."""
        sockets = subprocess.check_output(["ss", "-ltnpH"], text=True).splitlines()
        return [(command, line) for number, command in self.of_it().items() for line in sockets if f"pid={number}," in line]

    def __exit__(self, *given):
        super().__exit__(*given)
        self.display.close()


@pytest.fixture(scope="module")
def session(tmp_path_factory):
    with Watched(tmp_path_factory.mktemp("session"), f"world:={WORLD}", "seed:=3", "rviz:=true", "speech:=true", "limit:=240", "participant:=sub-01",
                 "feedback/drive/expo:=0.2", "nav/replan/hold_time:=5", "feedback/speaker/pitch:=55") as session:
        session.watch()
        session.wait_until(lambda: "/navvi/events" in session.topics() and session.command > 0, 90, "the robot is driven")
        session.seen_topics, session.sockets = session.topics(), session.listening()
        time.sleep(2)
        session.picture = session.folder / "picture.png"
        session.display.shot(session.picture)
        session.wait_until_ended()
        yield session


@pytest.fixture(scope="module")
def trial(session):
    folders = [path.parent for path in session.folder.rglob("summary.csv")]
    assert len(folders) == 1
    return folders[0]


def test_the_goal_is_reached_and_the_exit_code_says_so(session, trial):
    assert session.process.returncode == 0, session.text()[-3000:]
    assert summary(trial.parent)["result"] == "reached"
    assert "navvi: the session has ended." in session.text()
    assert not re.search("died|cleanly|={20}", session.text())
    assert summary(trial.parent)["participant"] == "sub-01"
    assert summary(trial.parent)["parameters"] == "feedback/drive/expo=0.2 nav/replan/hold_time=5 feedback/speaker/pitch=55"
    assert re.fullmatch(r"\d+\.\d+\.\d+(\+[0-9a-f]+(-dirty)?)?", summary(trial.parent)["version"])


def test_topics_have_the_names_of_the_picture(session):
    assert TOPICS <= session.seen_topics


def test_M3_nothing_listens_beyond_the_loopback_interface(session):
    for name in "rosmaster", "roslaunch", "rosout", "sim_node", "nav_node", "feedback_node", "trial_node", "rviz":
        assert any(name in command for command, _ in session.sockets), name
    for command, line in session.sockets:
        assert line.split()[3].startswith(("127.0.0.1:", "[::1]:")), (command, line)


SOCKETS = """
import os, socket
def place(family, kind, address, ip=None):
    if ip:
        os.environ["ROS_IP"] = ip
    try:
        with socket.socket(family, kind) as one:
            one.bind((address, 0))
            return one.getsockname()[0]
    except OSError:
        return "none"
v4, v6, tcp, udp = socket.AF_INET, socket.AF_INET6, socket.SOCK_STREAM, socket.SOCK_DGRAM
print(place(v4, tcp, ""), place(v4, udp, ""), place(v4, tcp, "", "127.0.0.5"), place(v4, tcp, "127.0.0.7", "127.0.0.5"), place(v6, tcp, "::"))
one = socket.socket(v4, tcp)
try:
    six = socket.socket(v6, tcp)
except OSError:
    six = one
print(one.getsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY), one.getsockopt(socket.IPPROTO_TCP, 25),
      six.getsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY), one.getsockopt(socket.IPPROTO_TCP, socket.TCP_CONGESTION, 5).decode())
with socket.socket(socket.AF_UNIX) as local:
    local.bind("\\0" + 40 * "n")
    print(len(local.getsockname()))
"""


def test_M3_a_socket_for_all_interfaces_is_the_loopback_s_or_that_of_ROS_IP_and_sends_at_once():
    env = dict(os.environ, LD_PRELOAD=Network.preload())
    env.pop("ROS_IP", None)
    found = subprocess.check_output(["/usr/bin/python3", "-c", SOCKETS], text=True, env=env)
    with socket.socket() as usual:
        control = usual.getsockopt(socket.IPPROTO_TCP, socket.TCP_CONGESTION, 5).decode()
    if "cubic" in Path("/proc/sys/net/ipv4/tcp_available_congestion_control").read_text():
        control = "cubic"
    six = "::1"
    try:
        socket.create_server(("::1", 0), family=socket.AF_INET6).close()
    except OSError:  # a container without IPv6
        six = "none"
    assert found == f"127.0.0.1 127.0.0.1 127.0.0.5 127.0.0.7 {six}\n1 8192 1 {control}\n41\n"


def test_an_outsider_reads_the_octomap_by_its_public_md5(session):
    assert session.octomap._md5sum == "9a45536b45c5e409cd49f04bb2d9999f"
    assert session.octomap.binary and session.octomap.id == "OcTree" and len(session.octomap.data) > 100


def test_the_bag_holds_the_topics_and_agrees_with_the_summary(trial):
    info = subprocess.check_output(["rosbag", "info", "-y", "-k", "topics", str(trial / "trial.bag")], text=True)
    bagged = set(re.findall(r"topic: (\S+)", info))
    assert BAGGED - {"/navvi/contacts"} <= bagged
    assert "/navvi/navmesh" not in bagged, "a replay makes it anew"
    subprocess.run(["rosrun", "navvi_study", "count_trial", "bag", str(trial)], check=True, timeout=120)


def places_shown(trial, scenes):
    """Of the robot in each scene, with that of its odometry at the time."""
    with rosbag.Bag(str(trial / "trial.bag")) as bag:
        places = {message.header.stamp: message.pose.pose.position for _, message, _ in bag.read_messages(["/odom"])}
    robots = [marker for scene in scenes for marker in scene.markers if (marker.ns, marker.id) == ("robot", 0)]
    return [(robot.pose.position, places[robot.header.stamp]) for robot in robots if robot.header.stamp in places]


def test_a_plain_replay_shows_the_robot_and_what_moves_twice_a_second(trial):
    """`rosbag play` with our RViz, without the nodes that make the picture anew."""
    with rosbag.Bag(str(trial / "trial.bag")) as bag:
        seconds = bag.get_end_time() - bag.get_start_time()
        scenes = [scene for _, scene, _ in bag.read_messages(["/navvi/scene_moving"])]
        assert any(True for _ in bag.read_messages(["/navvi/scene"]))
    assert 1.5 * seconds < len(scenes) < 2.5 * seconds + 2
    shown = places_shown(trial, scenes)
    assert len(shown) > seconds and all(abs(at.x - was.x) < 0.01 and abs(at.y - was.y) < 0.01 for at, was in shown)


def test_an_hour_of_a_session_is_less_than_a_fifth_of_a_gigabyte(trial):
    with rosbag.Bag(str(trial / "trial.bag")) as bag:
        seconds = bag.get_end_time() - bag.get_start_time()
        assert bag.size < MOST_BYTES * seconds, (bag.size, seconds)


def test_a_cue_of_a_node_that_woke_after_the_end_is_not_counted(trial, tmp_path):
    for name in "summary.csv", "trial.bag":
        shutil.copy(trial / name, tmp_path)
    with rosbag.Bag(str(tmp_path / "trial.bag"), "a") as bag:
        said = [cue for _, cue, _ in bag.read_messages("/navvi/cues") if cue.modality == cue.SPEECH and cue.stage == cue.STARTED]
        cue = said[len(said) // 2]  # of the trial's midst
        cue.id += 100000
        bag.write("/navvi/cues", cue, rospy.Time(bag.get_end_time() + 1.0))
    subprocess.run(["rosrun", "navvi_study", "count_trial", "bag", str(tmp_path)], check=True, timeout=120)


def test_S1_a_cue_that_came_after_the_end_while_the_clock_stood_is_not_counted(trial, tmp_path):
    for name in "summary.csv", "trial.bag":
        shutil.copy(trial / name, tmp_path)
    with rosbag.Bag(str(tmp_path / "trial.bag"), "a") as bag:
        end = next((event, at) for _, event, at in bag.read_messages("/navvi/events") if event.type == "TRIAL_END")
        cue = next(cue for _, cue, _ in bag.read_messages("/navvi/cues") if cue.modality == cue.SPEECH and cue.stage == cue.STARTED)
        cue.id, cue.header.stamp = 100000, end[0].header.stamp
        bag.write("/navvi/cues", cue, end[1])
    subprocess.run(["rosrun", "navvi_study", "count_trial", "bag", str(tmp_path)], check=True, timeout=120)


def test_R3_a_bag_that_differs_as_it_lacks_messages_says_so(trial, tmp_path):
    (tmp_path / "summary.csv").write_bytes((trial / "summary.csv").read_bytes())
    with rosbag.Bag(str(trial / "trial.bag")) as bag, rosbag.Bag(str(tmp_path / "trial.bag"), "w") as other:
        for topic, message, stamp in bag.read_messages():
            if topic != "/odom" or not 4.0 < stamp.to_sec() - bag.get_start_time() < 8.0:
                other.write(topic, message, stamp)
    result = subprocess.run(["rosrun", "navvi_study", "count_trial", "bag", str(tmp_path)], text=True, capture_output=True, timeout=120)
    assert result.returncode == 1 and re.search(r"the bag lacks (3|4)\d\d messages of odometry", result.stdout), result.stdout + result.stderr


def test_a_bag_of_another_version_is_named_as_one(trial, tmp_path):
    (tmp_path / "summary.csv").write_bytes((trial / "summary.csv").read_bytes())
    with rosbag.Bag(str(trial / "trial.bag")) as bag, rosbag.Bag(str(tmp_path / "trial.bag"), "w") as other:
        for topic, message, stamp, header in bag.read_messages(["/navvi/events", "/navvi/guidance"], raw=True, return_connection_header=True):
            if topic == "/navvi/guidance":
                header = dict(header, md5sum=32 * b"0")
                message = (*message[:2], 32 * "0", *message[3:])
            other.write(topic, message, stamp, raw=True, connection_header=header)
    result = subprocess.run(["rosrun", "navvi_study", "count_trial", "bag", str(tmp_path)], text=True, capture_output=True, timeout=60)
    assert result.returncode == 2, result.stdout + result.stderr
    assert "by a NavVI with another navvi_msgs/Guidance" in result.stderr


def check(trial):
    return subprocess.run(["rosrun", "navvi_study", "check_trial", str(trial)], text=True, capture_output=True, timeout=120)


def test_S6_the_record_repeats_the_simulation_bit_for_bit(trial, tmp_path):
    result = check(trial)
    assert result.returncode == 0 and result.stdout.startswith("equal"), result.stdout + result.stderr
    # One command that was the least bit different does not go unnoticed, and what may be the cause is named.
    (tmp_path / "summary.csv").write_bytes(re.sub(rb"GCC [\d.]+", b"GCC 1", (trial / "summary.csv").read_bytes()))
    with rosbag.Bag(str(trial / "trial.bag")) as bag, rosbag.Bag(str(tmp_path / "trial.bag"), "w") as other:
        for topic, message, stamp in bag.read_messages(["/navvi/scenario", "/navvi/applied_commands", "/navvi/state_hash"]):
            if topic == "/navvi/applied_commands" and message.first > 100:
                message.commands[-1].angular += 1e-9
            other.write(topic, message, stamp)
    result = check(tmp_path)
    assert result.returncode == 1 and "differ" in result.stdout, result.stdout + result.stderr
    assert re.match(r"It was recorded with another compiler: GCC 1; here it is GCC \d+\..*\.\nThey differ", result.stdout), result.stdout


def test_the_events_are_in_order_and_name_participant_trial_and_place(trial):
    rows = rows_of(trial / "events.csv")
    assert rows and list(rows[0])[:2] == ["onset_s", "duration_s"]
    assert {row["participant"] for row in rows} == {"sub-01"} and {row["trial"] for row in rows} == {trial.name}
    stamps = [datetime.datetime.fromisoformat(row["wall_clock_utc"].replace("Z", "+00:00")) for row in rows]
    assert stamps == sorted(stamps)
    assert any(row["trial_type"] == "cue" and "goal" in row["spoken"] for row in rows)
    assert all(row["robot_x_m"] != "n/a" for row in rows if row["trial_type"] not in ("trial end", "bag closed"))


def test_no_spoken_cue_was_cut_by_a_lesser_one(session):
    """An answer to the person, which is a message, cuts its equals, too: who hears nothing for long asks."""
    speech = [cue for cue in session.heard if cue.modality == Cue.SPEECH]
    assert any(cue.kind == "arrived" for cue in speech if cue.stage == Cue.ENDED)
    for index, cue in enumerate(speech):
        if cue.stage == Cue.CUT:
            assert cue.priority < Cue.IMPORTANT, cue.text
            after = next((other for other in speech[index + 1:] if other.stage == Cue.STARTED), None)
            assert after is None or after.priority > cue.priority or after.priority == Cue.MESSAGE, (cue.text, after.text)


def test_what_was_said_can_be_heard(session):
    """The recording, transcribed, holds the words of the cues in their order. Numbers are left out: to the recogniser,
    fifteen and fifty are the same, and it mishears what the sound of the arrival covers, a quarter of so short a way."""
    numbers = {"point", *hearing.ONES, *hearing.TENS}
    ended = {cue.id for cue in session.heard if cue.stage == Cue.ENDED}
    said = [word for cue in session.heard if cue.stage == Cue.STARTED and cue.modality == Cue.SPEECH and cue.id in ended
            for word in hearing.words_of(cue.text) if word not in numbers]
    heard = [word for _, words in hearing.transcribe(session.folder / "sound.wav") for word in words if word not in numbers]
    common = sum(block.size for block in difflib.SequenceMatcher(None, said, heard, autojunk=False).get_matching_blocks())
    assert said and common > 0.5 * len(said), f"said: {' '.join(said)}; heard: {' '.join(heard)}"


def test_the_picture_shows_path_goal_boxes_and_robot(session):
    """Each colour that carries a meaning covers a fair share of the screen."""
    pixels = subprocess.check_output(["convert", str(session.picture), "-depth", "8", "rgb:-"])
    count = {"path": 0, "boxes": 0}
    for at in range(0, len(pixels), 3 * 7):
        red, green, blue = pixels[at:at + 3]
        count["path"] += red > 140 and blue > 180 and green < 0.65 * red
        count["boxes"] += red > 90 and green > 0.75 * red and blue < 0.35 * red
    assert count["path"] > 100 and count["boxes"] > 100, count


def test_a_recorded_trial_plays_again(session, trial, tmp_path):
    seen = tmp_path / "seen.bag"
    with Command("replay", trial, "rate:=4", "rviz:=false", ALSOFT_DRIVERS="null") as replay:
        replay.wait_until_ready()
        watcher = replay.start("/usr/lib/rosbag/record", "-q", "-O", seen, *PICTURE, env=dict(DARK, ROS_MASTER_URI=replay.uri, ROS_IP="127.0.0.1"))
        said = replay.wait_until_ended(180)
        watcher.send_signal(signal.SIGINT)
        watcher.wait(20)
    assert replay.process.returncode == 0, said[-2000:]
    assert "The voice is en, at 220 words a minute and pitch 55." in (trial / "replay.log").read_text()
    beyond = navvi("replay", trial, "rviz:=false", "skip:=9999")
    assert beyond.returncode == 2 and "skip:=9999 leaves nothing to replay; the bag has" in beyond.stderr, beyond.stderr
    # The whole picture, and in it the robot where it was.
    with rosbag.Bag(str(seen)) as bag:
        assert {topic for topic, _, _ in bag.read_messages()} == set(PICTURE)
        scenes = [scene for _, scene, _ in bag.read_messages(["/navvi/scene_moving"])]
    shown = places_shown(trial, scenes)
    assert len(shown) > 10
    assert all((at.x, at.y) == (was.x, was.y) for at, was in shown)


def test_a_replay_in_a_terminal_pauses_and_goes_on_by_a_key(trial, tmp_path):
    terminal, its_end = pty.openpty()
    said = tmp_path / "said"

    def press():
        """What comes of p and Enter."""
        def told():
            return re.findall("is paused|goes on|does not answer", said.read_text())
        before = told()
        os.write(terminal, b"p\n")
        return "".join(eventually(lambda: told()[len(before):], 20))
    with Programs(dict(DARK, ALSOFT_DRIVERS="null"), said) as programs:
        programs.start(ROOT / "navvi", "replay", trial, "rate:=0.5", "rviz:=false", stdin=its_end)
        assert eventually(lambda: said.exists() and "p and Enter" in said.read_text(), 300)
        assert eventually(lambda: time.sleep(0.5) or press() == "is paused", 60), said.read_text()
        assert press() == "goes on", said.read_text()
    os.close(its_end)
    os.close(terminal)
