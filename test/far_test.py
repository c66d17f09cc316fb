"""A person here, a robot there, and between them a network that delays, cuts and loses packets (far.py). The robot is the simulator."""
import contextlib
import json
import os
import re
import signal
import subprocess
import threading
import time

import pytest

import far
from clock import Clock
from conftest import free_port
from sessions import ROOT, WORLD, eventually, summary, within

pytestmark = pytest.mark.skipif(not far.is_possible(), reason="network namespaces and TUN devices need the rights of root")

# On the robot's machine: a line for each change of the wheels' state, and with each odometry the speed.
OBSERVER = """
import json, sys, time
import rospy
from nav_msgs.msg import Odometry
from navvi_msgs.msg import DriveState, LinkState
rospy.init_node("far_observer", anonymous=True, disable_rostime=True)
def tell(**values):
    sys.stdout.write(json.dumps(dict(values, at=time.monotonic())) + "\\n"); sys.stdout.flush()
rospy.Subscriber("/navvi/drive_state", DriveState, lambda msg: tell(state=msg.state), tcp_nodelay=True)
rospy.Subscriber("/odom", Odometry, lambda msg: tell(speed=msg.twist.twist.linear.x), tcp_nodelay=True)
rospy.Subscriber("/navvi/link", LinkState, lambda msg: tell(round_trip=msg.round_trip, late=msg.late))
rospy.spin()
"""
# On the person's machine: a stick that is pushed while the word on its input says so. It prints what is said.
STICK = """
import sys, threading, time
import rospy
from sensor_msgs.msg import Joy
from navvi_msgs.msg import Cue
rospy.init_node("stick", anonymous=True, disable_rostime=True)
joy, push = rospy.Publisher("/joy", Joy, queue_size=1, tcp_nodelay=True), [0.0]
def listen():
    for line in sys.stdin: push[0] = float(line)
threading.Thread(target=listen, daemon=True).start()
rospy.Subscriber("/navvi/cues", Cue, lambda cue: cue.modality == Cue.SPEECH and cue.stage == Cue.QUEUED and print(cue.text, flush=True))
while not rospy.is_shutdown():
    joy.publish(Joy(axes=[0.0, push[0]], buttons=[0, 0]))
    time.sleep(0.02)
"""


class Session:
    def __init__(self, folder):
        self.folder, self.wire, self.processes = folder, far.Wire(), []
        self.env = dict(os.environ, HOME=str(folder), ROS_LOG_DIR=str(folder))
        self.begin_robot()
        assert eventually(lambda: self.asks("rosnode", "ping", "-c1", "/nav_node"), 300)

    def begin_robot(self):
        self.start(self.wire.robot, "./navvi", "robot", "start", f"address:={far.ROBOT}", f"world:={WORLD}", "seed:=3",
                   output=self.folder / "robot.txt")
        # Another session of this machine may hold the first port.
        self.at = eventually(lambda: re.search(r"run robot:=(\S+)", (self.folder / "robot.txt").read_text()), 60)[1]
        self.env["ROS_MASTER_URI"] = f"http://{self.at}"

    def start(self, side, *words, output=None, **more):
        (tmp := self.folder / side.address).mkdir(exist_ok=True)
        env = dict(self.env, ROS_IP=side.address, TMPDIR=str(tmp))
        to = open(output, "w") if output else more.pop("stdout", subprocess.DEVNULL)
        process = subprocess.Popen([*side.enter, *words], env=env, cwd=ROOT, stdout=to, stderr=subprocess.STDOUT if output else None, **more)
        self.processes.append(process)
        return process

    def asks(self, *words):
        return subprocess.run([*self.wire.robot.enter, *words], env=dict(self.env, ROS_IP=far.ROBOT), capture_output=True).returncode == 0

    def drive(self, *words, **variables):
        """The simulated person's session; what it prints."""
        try:
            run = subprocess.run([*self.wire.person.enter, "./navvi", "run", f"robot:={self.at}", "operator:=simulated", "rviz:=false", "limit:=120",
                                  f"out:={self.folder}", *words], env=dict(self.env, **variables), cwd=ROOT, capture_output=True, text=True, timeout=400)
        except subprocess.TimeoutExpired as late:
            logs = "".join(log.read_text()[-3000:] for log in self.folder.glob("session-*.log"))
            raise AssertionError(f"it did not end within 400 s: {(late.stdout or b'').decode()[-3000:]}\n{logs}") from None
        return run.stdout + run.stderr

    def close(self):
        for process in reversed(self.processes):
            process.send_signal(signal.SIGTERM)
        for process in self.processes:
            process.wait(60)
        self.wire.close()


class RobotOfItsOwn(Session):
    """A master, drivers and wheels of a robot, here the simulator's, which knows nothing of the person; the robot's side joins them."""

    def begin_robot(self):
        self.env["ROS_MASTER_URI"] = f"http://{far.ROBOT}:11311"
        self.start(self.wire.robot, "rosmaster", "--core", "-p", "11311")
        assert eventually(lambda: self.asks("rosparam", "set", "use_sim_time", "true"), 60)
        self.start(self.wire.robot, "rosrun", "navvi_sim", "sim_node", f"_world:={WORLD}", "_seed:=3", "odom:=/robot/odom",
                   *(f"navvi/{name}:=/robot/{name}" for name in ("command", "drive_state", "link")))
        self.start(self.wire.robot, "/usr/bin/python3", str(ROOT / "test/wheels.py"))
        self.start(self.wire.robot, "roslaunch", str(ROOT / "launch/robot_side.launch"), "far:=true", "sensors:=false", "odom:=/robot/odom",
                   "wheels:=/robot/cmd_vel", output=self.folder / "robot.txt")
        # Of two roslaunch without it, the later one ends.
        assert eventually(lambda: self.asks("rosparam", "get", "/run_id"), 60)


@pytest.fixture
def session(tmp_path):
    session = Session(tmp_path)
    yield session
    session.close()


@pytest.mark.parametrize("delay", [0.02, 0.2, 1.0])
def test_a_simulated_person_reaches_the_goal_of_a_robot_on_another_machine(session, delay):
    session.wire.delay = delay
    said = session.drive()
    assert "The goal was reached" in said, said
    result = summary(session.folder)
    assert 2 * delay <= float(result["round_trip"]) < 2 * delay + 0.3
    log = next(session.folder.glob("session-*.log")).read_text()
    assert "[connection_slow]" in log or delay < 0.15, "on a busy machine a command may be late on a fast one, too"
    trial = next(session.folder.glob("trial-*"))
    assert result["bag"] == "ok" and (trial / "trial.bag").stat().st_size > 1e5, sorted(trial.iterdir())
    assert not (trial / "trial.bag.txt").exists() and not list((session.folder / ".navvi/bags").iterdir()), "it was fetched from there"
    assert subprocess.run(["rosbag", "check", str(trial / "trial.bag")], capture_output=True).returncode == 0


def test_a_simulated_person_reaches_the_goal_of_a_real_robots_side_on_another_machine(tmp_path):
    with contextlib.closing(RobotOfItsOwn(tmp_path)) as session:
        session.wire.delay = 0.02
        person = session.start(session.wire.person, "roslaunch", str(ROOT / "launch/person.launch"), "clock:=/clock", "odom:=/robot/odom",
                               "operator:=simulated", "speech:=auto", "rviz:=false", "limit:=120", "patience:=300", f"out:={tmp_path}",
                               "trial_parameters:={record: robot}", output=tmp_path / "person.txt")
        code = person.wait(400)
        assert code == 0 and [*tmp_path.glob("trial-*/summary.csv")], (tmp_path / "person.txt").read_text()[-3000:]
    result = summary(tmp_path)
    assert (result["result"], result["bag"]) == ("reached", "ok"), result
    assert 0.04 <= float(result["round_trip"]) < 0.34


def test_a_session_can_be_watched_on_both_machines(session):
    run = session.start(session.wire.person, "./navvi", "run", f"robot:={session.at}", "operator:=simulated", "rviz:=false", "limit:=120",
                        f"out:={session.folder}", output=session.folder / "person.txt")
    assert eventually(lambda: [*session.folder.glob("trial-*")], 200), (session.folder / "person.txt").read_text()
    told = {side: session.folder / f"watched-{side.address}.txt" for side in (session.wire.person, session.wire.robot)}
    watches = {side: session.start(side, "./navvi", "watch", "pace:=0", output=output) for side, output in told.items()}
    for side, output in told.items():
        assert eventually(lambda: "Said: " in output.read_text(), 60), output.read_text()
        sockets = subprocess.check_output([*side.enter, "ss", "-ltnpH"], text=True).splitlines()
        listening = {line.split()[3].rpartition(":")[0] for line in sockets if f"pid={watches[side].pid}," in line}
        assert listening == {side.address}, "all others of the network reach what listens elsewhere"
    assert run.wait(200) == 0
    for output in told.values():
        assert eventually(lambda: "The trial has ended: reached" in output.read_text(), 20), output.read_text()
        assert "Said: " in output.read_text()


def test_a_clock_of_the_person_that_is_wrong_is_set_and_drifts_changes_nothing(session, tmp_path):
    session.wire.delay = 0.1
    clock = Clock(tmp_path, ahead=10.0)
    drift = clock.drift(0.01)  # a hundred times what a bad clock does

    def go_back():
        if eventually(lambda: list(session.folder.glob("trial-*/journal.csv")), 200):
            time.sleep(8.0)
            clock.set(clock.ahead - 12.0)
    setting = threading.Thread(target=go_back)
    setting.start()
    said = session.drive(**clock.env)
    assert not setting.is_alive(), "the clock was set while the person drove"
    drift.set()
    result = summary(session.folder)
    assert "The goal was reached" in said and result["safe_stop_count"] == "0", said
    assert 0.2 <= float(result["round_trip"]) < 0.5, result


def test_C10_a_cut_stops_the_wheels_and_no_command_of_before_moves_them_after_it(session, record_property):
    wire, lines = session.wire, []
    session.start(wire.person, "roslaunch", str(ROOT / "launch/person.launch"), "operator:=topic", "rviz:=false", "speech:=false",
                  "clock:=/clock", "press_to_start:=false", f"out:={session.folder}", "feedback_parameters:={listener: topic}")
    observer = session.start(wire.robot, "/usr/bin/python3", "-c", OBSERVER, stdout=open(session.folder / "seen", "w"))
    stick = session.start(wire.person, "/usr/bin/python3", "-c", STICK, stdin=subprocess.PIPE, stdout=open(session.folder / "said", "w"), text=True)

    def push(value):
        stick.stdin.write(f"{value}\n")
        stick.stdin.flush()

    def seen(name):
        lines[:] = [json.loads(line) for line in (session.folder / "seen").read_text().splitlines() if line.endswith("}")]
        return [(line["at"], line[name]) for line in lines if name in line]

    def lost():
        return (session.folder / "said").read_text().count("connection lost\n")

    assert observer.poll() is None
    assert eventually(lambda: seen("speed"), 60)
    for delay, cut, forward in ((0.05, 0.6, 1.0), (0.2, 3.0, -1.0), (0.05, 8.0, 1.0)):
        wire.delay = delay
        push(0.0)
        assert eventually(lambda: seen("state")[-1][1] == 1, 60)  # running
        push(forward)
        assert eventually(lambda: abs(seen("speed")[-1][1]) > 0.1, 20)
        before = lost()
        wire.cut, at = True, time.monotonic()
        assert eventually(lambda: seen("state")[-1][1] == 2, 2)
        stopped = next(when for when, state in seen("state") if when > at and state == 2)
        within(record_property, "wheels held", stopped - at, 0.25)  # what is under way is lost, too
        time.sleep(cut)
        assert lost() > before or cut < 1.0
        wire.cut = False
        time.sleep(4.0)
        still = [abs(speed) for when, speed in seen("speed") if when > stopped + 1.0]
        assert max(still) < 0.02, "the stick is held since before the cut"
        assert seen("round_trip")[-1][0] > stopped + cut, "the connection is back"


def test_a_robot_that_is_not_there_ends_in_a_sentence():
    port = free_port()
    run = subprocess.run(["./navvi", "run", f"robot:=127.0.0.1:{port}", "operator:=simulated", "rviz:=false"], cwd=ROOT, capture_output=True,
                         text=True, timeout=600)
    assert run.returncode == 2 and re.search("no ROS master answers at 127.0.0.1, port " + str(port), run.stderr), run.stderr
