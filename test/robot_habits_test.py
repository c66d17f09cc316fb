"""launch/robot.launch with a robot whose drivers have the habits of real ones."""
import pytest

from sessions import ROOT, Programs

RATE = 20.0  # Hz, of /navvi/proximity

# Name, habits of fake_robot.py, and whether obstacles are sensed.
HABITS = [
    ("no sweep", "", True),
    ("a Hokuyo", "sweep=0.07", True),
    ("an RPLidar", "scan_hz=5.5 sweep=0.18 odom_hz=20", True),
    ("a serial lidar", "sweep=0.1 deliver=0.02 odom_hz=20", True),
    ("slow delivery", "scan_hz=5 sweep=0.2 deliver=0.2 odom_hz=20", True),
    ("odometry that comes late", "sweep=0.05 lag=0.02", True),
    ("odometry at 5 Hz", "scan_hz=5 sweep=0.2 odom_hz=5 stamp=sent", True),
    ("a Neato", "scan_hz=5 sweep=0.2 stamp=sent odom_hz=7 range_max=3.5 none=zero", True),
    ("40 Hz", "scan_hz=40 sweep=0.025", True),
    ("a frame with a slash", "frame=/laser sweep=0.05", True),
    ("a map each second", "map_hz=1", True),
    ("a turned map", "map_hz=1 map_yaw=0.3", True),
    ("a map without a quaternion", "map_hz=1 map_w=0", True),
    ("a localizer that corrects itself seldom", "place_hz=0.25 jump=0.3", True),
    # The map has no wall within 2 m of the robot, but within 10 m.
    ("an open hall, +inf", "map_hz=1 sees=0 range_max=2.5", True),
    ("an open hall, 0", "map_hz=1 sees=0 range_max=2.5 none=zero", False),
    ("a blind lidar, +inf", "map_hz=1 sees=0", False),
]
COUNT = """
import sys, time, rospy
from navvi_msgs.msg import Proximity
rospy.init_node("count", anonymous=True)
came = []
rospy.Subscriber("/navvi/proximity", Proximity, lambda _: came.append(1))
time.sleep(float(sys.argv[1]))
came.clear()
time.sleep(float(sys.argv[2]))
print(len(came) / float(sys.argv[2]))
"""


@pytest.fixture(scope="module")
def session(master, tmp_path_factory):
    with Programs(master) as session:
        session.launch("robot.launch", "rehearse:=true", "input:=topic", "speech:=false", "rviz:=false", f"out:={tmp_path_factory.mktemp('trials')}")
        yield session


@pytest.mark.parametrize("habits, sensed", [pytest.param(*habit[1:], id=habit[0]) for habit in HABITS])
def test_H1_obstacles_are_sensed_by_drivers_of_such_habits(session, habits, sensed):
    with Programs(session.env) as robot:
        robot.start("/usr/bin/python3", ROOT / "test/fake_robot.py", *habits.split())
        rate = float(robot.person("-c", COUNT, "5", "3"))
    assert (rate > 0.6 * RATE) if sensed else (rate == 0.0), f"{rate} a second"
