"""./navvi robot check: what it says of robots whose messages are made up here, and of one that runs."""
import math
import socket
import subprocess
import time

import pytest
from nav_msgs.msg import OccupancyGrid, Odometry
from sensor_msgs.msg import Joy, LaserScan, PointCloud2, PointField
from tf2_msgs.msg import TFMessage

import rospy

import fake_robot
from navvi_cli import robot, robot_check
from navvi_cli.arguments import LaunchFile
from conftest import free_port
from sessions import ROOT, Programs, eventually

RAYS, NOW = 360, 1000.0


def stamped(message, frame, age=0.05, now=NOW):
    message.header.frame_id, message.header.stamp = frame, rospy.Time(now - age)
    return message


def transform(parent, child, x=0.0, z=0.0, age=0.05, now=NOW):
    return TFMessage([fake_robot.transform(parent, child, z, rospy.Time(now - age), x)])


def scan(value=lambda ray: 3.0, **more):
    return LaserScan(angle_increment=2 * math.pi / RAYS, range_min=0.1, range_max=10.0, ranges=[value(ray) for ray in range(RAYS)], **more)


def grid(yaw=0.0):
    out = stamped(OccupancyGrid(), "map")
    out.info.resolution, out.info.width, out.info.height = 0.1, 80, 80
    out.info.origin.position.x = out.info.origin.position.y = -4.0
    out.info.origin.orientation.w = 1.0
    out.data = [100 if abs(math.hypot(i - 39.5, j - 39.5) - 30) < 1 else 0 for j in range(80) for i in range(80)]
    return out


class Fake(robot.Robot):
    """A robot in the middle of a round room of 3 m, all of which is well unless a test spoils it."""

    def __init__(self, **words):
        launch = LaunchFile("robot.launch")
        super().__init__({name: default for name, (default, _) in launch.arguments.items()} | {"input": "topic"} | words, words)
        self.scan, self.scan_hz, self.scan_age, self.odom_frame, self.odom_hz, self.joy_age = scan(), 10.0, 0.05, "odom", 50.0, 0.05
        self.scan_frame, self.lidar, self.place, self.map = "laser", "base_link", ("amcl", "map"), grid()
        self.takers = {"/cmd_vel": ["/base"]}

    def send(self, name, kind, node, rate, message_at, seconds=2.0):
        self.kinds[name] = kind
        self.publishers.setdefault(name, []).append(node)
        for i in range(int(rate * seconds)):
            self.take(name, kind, message_at(NOW + i / rate), NOW + i / rate)

    def lines(self):
        self.send("/scan", robot.SCAN, "/lidar", self.scan_hz, lambda now: stamped(self.scan, self.scan_frame, self.scan_age, now))
        self.send("/odom", robot.ODOMETRY, "/base", self.odom_hz, lambda now: stamped(Odometry(), self.odom_frame, 0.02, now))
        self.send("/joy", robot.JOY, "/joy_node", 20.0, lambda now: stamped(Joy(axes=[0] * 6, buttons=[0] * 11), "", self.joy_age, now))
        if self.map:
            self.send("/map", robot.GRID, "/map_server", 1.0, lambda now: self.map)
        for i in range(20):
            now = NOW + 0.1 * i
            self.frames.take(transform("odom", "base_link", now=now), "/base", False, now)
            if self.place:
                self.frames.take(transform(self.place[1], "odom", age=-0.1, now=now), self.place[0], False, now)
        if self.lidar:
            self.frames.take(transform(self.lidar, "laser", x=0.1, z=0.2), "/fixed", True, NOW)
        return {line.part: line for line in robot_check.lines(self)}


def verdicts(lines):
    return {part: line.verdict for part, line in lines.items()}


def test_a_good_robot_is_well_in_each_line():
    lines = Fake().lines()
    assert set(verdicts(lines).values()) == {"well"}
    assert list(lines) == ["scan", "odom", "tf", "map", "footprint", "stick", "wheels"], "a cloud is not missed beside a scan"
    assert str(lines["scan"]) == ("scan: well. Found: /scan, 10.0 Hz, age 0.05 s, frame laser 0.20 m above base_link, sweep 0.00 s, rays measured 100 %. "
                                  "Needed: sensor_msgs/LaserScan at 5 Hz or more, in a frame of TF.")
    assert "100 % of the scans lie on its walls" in lines["map"].found and "the next at 2.90 m" in lines["footprint"].found


def spoiled(**what):
    def spoil(fake):
        for name, value in what.items():
            setattr(fake, name, value)
    return spoil


def second_parent(fake):
    fake.frames.take(transform("camera", "laser"), "/urdf", True, NOW)


def second_driver(fake):
    fake.publishers["/cmd_vel"] = ["/relay_node", "/teleop"]


def wrong_type(fake):
    fake.kinds["/odom2"], fake.publishers["/odom2"] = robot.ODOMETRY, ["/ekf"]
    fake.words["odom"] = "odometry"


@pytest.mark.parametrize("spoil, part, verdict, sentence", [
    (spoiled(scan_hz=3.0), "scan", "wrong", "5 Hz are needed"),
    (spoiled(scan_age=-3.0), "scan", "wrong", "clocks of all computers together"),
    (spoiled(scan_age=NOW), "scan", "wrong", "has to stamp"),
    (spoiled(lidar=None), "scan", "wrong", "no transform joins laser and base_link"),
    (spoiled(scan=scan(lambda ray: 0.0)), "scan", "wrong", "nothing was measured"),
    (spoiled(scan=scan(lambda ray: 3.0 if ray % 2 else math.nan)), "scan", "look", "no_return:=free"),
    (spoiled(scan=scan(lambda ray: 3.0 if ray % 2 else math.inf)), "scan", "well", ""),
    (spoiled(scan_frame="/laser"), "scan", "well", ""),
    (spoiled(odom_hz=4.0), "odom", "wrong", "10 Hz are needed"),
    (spoiled(odom_frame="tb3/odom"), "odom", "wrong", "odom_frame:=tb3/odom"),
    (wrong_type, "odom", "wrong", "odom:=/odom"),
    (spoiled(place=None), "tf", "wrong", "map -> odom is missing: it comes from a localizer"),
    (second_parent, "tf", "wrong", "laser has several parents (base_link by /fixed, camera by /urdf)"),
    (spoiled(map=None), "map", "look", "only seen floor is floor"),
    (spoiled(scan=scan(lambda ray: 2.0)), "map", "look", "tell the localizer"),
    (spoiled(scan=scan(lambda ray: 0.2 if ray < 5 else 3.0)), "footprint", "well", ""),
    (spoiled(scan=scan(lambda ray: 0.5 if 175 < ray < 185 else 3.0)), "footprint", "look", "larger radius"),
    (spoiled(radii={"perception/robot_radius": 0.2, "nav/mesh/robot_radius": 0.35}), "footprint", "wrong", "radius:="),
    (spoiled(reaches={"/move_base/local_costmap/footprint": robot.reach_of("[[0.4, 0.3], [-0.4, 0.3], [-0.4, -0.3], [0.4, -0.3]]")}), "footprint", "wrong", "radius:=0.5"),
    (spoiled(reaches={"/a/footprint": robot.reach_of([[0.1, 0.1], [-0.1, 0.0]]), "/b/footprint": robot.reach_of("round")}), "footprint", "well", ""),
    (spoiled(joy_age=0.6), "stick", "wrong", "the robot is slow"),
    (spoiled(joy_age=3.0), "stick", "wrong", "clocks"),
    (spoiled(takers={}), "wheels", "wrong", "wheels:="),
    (second_driver, "wheels", "wrong", "end these"),
])
def test_a_line_says_what_is_wrong_and_what_to_do(spoil, part, verdict, sentence):
    fake = Fake()
    spoil(fake)
    line = fake.lines()[part]
    assert line.verdict == verdict and sentence in line.todo, line


@pytest.mark.parametrize("nodes, kind, verdict, sentence", [
    (["/base"], "std_msgs/Bool", "well", "/estop, published by /base"),
    ([], "std_msgs/Bool", "wrong", "nothing publishes /estop"),
    (["/base"], "std_msgs/Int8", "wrong", "/estop is a std_msgs/Int8"),
])
def test_an_emergency_stop_that_is_named_has_to_be_there(nodes, kind, verdict, sentence):
    fake = Fake(emergency_stop="estop")
    fake.kinds["/estop"], fake.publishers["/estop"] = kind, nodes
    line = fake.lines()["emergency_stop"]
    assert line.verdict == verdict and sentence in line.found, line


def test_without_any_range_both_topics_are_named():
    lines = robot_check.lines(Fake())
    assert [(line.part, line.verdict) for line in lines[:2]] == [("scan", "wrong"), ("points", "wrong")]
    assert "nothing publishes /scan" in lines[0].found


def test_each_of_several_scans_has_a_line_and_a_missing_one_is_wrong():
    fake = Fake(scan="/scan,/rear/scan")
    fake.lines()
    found = [line for line in robot_check.lines(fake) if line.part == "scan"]
    assert [line.verdict for line in found] == ["well", "wrong"] and "/rear/scan" in found[1].found


@pytest.mark.parametrize("row_step", [0, 16 * 4])
def test_a_cloud_is_read_whatever_its_row_step_says(row_step):
    import struct
    fields = [PointField(name, 4 * i, PointField.FLOAT32, 1) for i, name in enumerate("xyz")]
    points = [(1.0, 2.0, 3.0), (math.nan,) * 3, (4.0, 5.0, 6.0), (7.0, 8.0, 9.0)]
    cloud = PointCloud2(width=2, height=2, point_step=16, row_step=row_step, fields=fields)
    rows = [b"".join(struct.pack("<3f", *point) + b"\0" * 4 for point in points[i:i + 2]) for i in (0, 2)]
    cloud.data = b"".join(row.ljust(max(row_step, 32), b"\0") for row in rows)
    found = list(robot.points_of(cloud))
    assert found[0] == points[0] and found[2:] == points[2:] and math.isnan(found[1][0])


def check(master, *words):
    return subprocess.run([str(ROOT / "navvi"), "robot", "check", *words], env=master, capture_output=True, text=True, timeout=120)


@pytest.mark.parametrize("habits, words, code, sentence", [
    ("map_hz=1", [], 0, "footprint: well."),
    ("map_hz=1", ["scan:=/scan,/rear/scan"], 1, "scan: wrong. Found: nothing publishes /rear/scan."),
    ("map_hz=1 scan_hz=2", ["scan:=/scan"], 1, "scan: wrong. Found: /scan, 2.0 Hz"),
])
def test_a_robot_that_runs_is_checked(master, habits, words, code, sentence):
    with Programs(master) as programs:
        programs.start("/usr/bin/python3", ROOT / "test/fake_robot.py", *habits.split())
        result = check(master, "input:=keyboard", *words)
    assert result.returncode == code and "odom: well." in result.stdout and sentence in result.stdout, result.stdout + result.stderr


def test_without_a_master_it_says_so(master):
    result = check(dict(master, ROS_MASTER_URI="http://127.0.0.1:9"))
    assert result.returncode == 2 and "no ROS master answers at http://127.0.0.1:9" in result.stderr


def test_a_master_that_ends_meanwhile_ends_it_in_a_sentence(master):
    port = free_port()
    env = dict(master, ROS_MASTER_URI=f"http://127.0.0.1:{port}")
    with Programs(env) as programs:
        programs.start("rosmaster", "--core", "-p", port)
        assert eventually(lambda: socket.socket().connect_ex(("127.0.0.1", port)) == 0, 20)
        checking = subprocess.Popen([str(ROOT / "navvi"), "robot", "check"], env=env, stderr=subprocess.PIPE, text=True)
        time.sleep(5.0)
    said = checking.communicate(timeout=60)[1]
    assert checking.returncode == 2 and "ended meanwhile" in said, said
