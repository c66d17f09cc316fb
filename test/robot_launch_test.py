"""launch/robot.launch with a robot that NavVI has never met: here the simulator, which knows nothing of the person's side."""
import json
import os
import re

import pytest
import yaml
from navvi_msgs.msg import TrialState

from conftest import free_port
from sessions import ROOT, WORLD, Programs, eventually, roslaunch, summary

PLACES = {"packing table": (0.5, 0.5), "gate 4": (-0.5, 0.25)}
# Parameters of the last person's session, on a master that outlives it.
LEFT = {"/feedback_node/drive/stick": "right", "/trial_node/locked": "true", "/trial_node/study/condition": "other", "/nav_node/mesh/climb": "0.3",
        "/relay_node/max_linear": "0.1", "/perception_node/cloud_rate": "5"}
# Presses buttons of the menu, by nothing but the words that follow each press: until a goal is chosen, or a place is remembered.
BY_EAR = """
import json, queue, sys
import rospy
from geometry_msgs.msg import PoseStamped
from navvi_msgs.msg import Cue
from std_msgs.msg import String

rospy.init_node("by_ear", disable_rostime=True)
cues, goals, heard, told = queue.Queue(), queue.Queue(), [], set()
rospy.Subscriber("/navvi/cues", Cue, cues.put)
rospy.Subscriber("/move_base_simple/goal", PoseStamped, goals.put)
buttons = rospy.Publisher("/navvi/ask", String, queue_size=10)
while not buttons.get_num_connections():
    rospy.sleep(0.1)

def press(button):
    buttons.publish(button)
    while True:
        cue = cues.get(timeout=20)
        if cue.kind.startswith(("menu_", "goal_sure", "goal_chosen", "place_")) and cue.id not in told:
            told.add(cue.id)
            heard.append(cue.text)
            return cue

if sys.argv[1] == "remember":
    while press("previous").kind != "menu_remember":
        pass
    press("choose")
    print(json.dumps({"heard": heard}))
    sys.exit()
while press("next").kind != "menu_goals":
    pass
cue = press("choose")
while cue.text != sys.argv[1]:
    cue = press("next")
while press("choose").kind != "goal_chosen":
    pass
while True:  # another program may go on sending its own
    goal = goals.get(timeout=20)
    if goal._connection_header["callerid"] == "/feedback_node":
        break
place = goal.pose.position
print(json.dumps({"goal": [goal.header.frame_id, place.x, place.y], "heard": heard}))
"""


def places_file(folder):
    path = folder / "places.yaml"
    path.write_text("".join(f"- {{name: {name}, x: {x}, y: {y}}}\n" for name, (x, y) in PLACES.items()))
    return path


class Robot(Programs):
    def __init__(self, master, folder, *more):
        super().__init__(master)
        self.folder, self.places = folder, places_file(folder)
        self.run("rosparam", "set", "use_sim_time", "true")
        for name, value in LEFT.items():
            self.run("rosparam", "set", name, value)
        self.start("rosrun", "navvi_sim", "sim_node", "navvi/command:=/robot/command", "odom:=/robot/odom", f"_world:={WORLD}")
        self.start("/usr/bin/python3", ROOT / "test/wheels.py")
        self.guide = self.launch("robot.launch", "wheels:=/robot/cmd_vel", "odom:=/robot/odom", "input:=topic", "speech:=false", "rviz:=false",
                                 f"out:={folder}", f"places:={self.places}", "feedback_parameters:={listener: topic}", *more)

    def field(self, topic, name):
        """A number of the topic's next message."""
        text = self.run("rostopic", "echo", "-n1", f"{topic}/{name}").stdout
        found = re.search(r"-?\d+(\.\d+)?(e-?\d+)?", text)
        return float(found.group()) if found else None

    def send_goal(self):
        x, y = (self.field("/navvi/scenario", f"goal/{axis}") for axis in "xy")
        goal = f"{{header: {{frame_id: map}}, pose: {{position: {{x: {x}, y: {y}}}, orientation: {{w: 1.0}}}}}}"
        self.start("rostopic", "pub", "-r", "1", "/move_base_simple/goal", "geometry_msgs/PoseStamped", goal)


def test_a_session_ends_with_its_job_and_leaves_nobody_at_a_stick_that_is_held(master, tmp_path):
    with Robot(master, tmp_path, f"jobs:={places_file(tmp_path)}", "limit:=1") as robot:
        robot.guide.wait(120)
    assert len([*tmp_path.glob("trial-*/summary.csv")]) == len(PLACES)


@pytest.fixture(scope="module")
def robot(master, tmp_path_factory):
    with Robot(master, tmp_path_factory.mktemp("trials")) as robot:
        yield robot


def test_the_next_session_has_no_parameter_of_the_last_one(robot):
    assert eventually(lambda: robot.field("/navvi/guidance", "state") is not None, 120)
    names = robot.run("rosparam", "list").stdout.split()
    assert "/trial_node/out" in names and "/nav_node/mesh/robot_height" in names
    assert sorted(LEFT.keys() & set(names)) == []


def test_a_goal_from_outside_is_followed(robot):
    robot.send_goal()
    assert eventually(lambda: robot.field("/navvi/guidance", "state") == 1)


def test_the_stick_moves_the_robot_through_the_relay(robot):
    assert float(robot.person("stick.py", "push", "/odom:=/robot/odom")) >= 0.3


def test_a_place_of_the_file_becomes_the_goal_by_buttons_and_ears_alone(robot):
    found = json.loads(robot.person("-c", BY_EAR, "gate 4"))
    assert found["goal"] == ["map", *PLACES["gate 4"]], found
    assert found["heard"][-1] == "you are heading for gate 4"


def test_the_robots_place_is_remembered_by_buttons_and_ears_and_another_by_a_click(robot):
    assert json.loads(robot.person("-c", BY_EAR, "remember"))["heard"][-1] == "saved as place 1"
    at = [robot.field("/robot/odom", f"pose/pose/position/{axis}") for axis in "xy"]
    click = "{header: {frame_id: map}, point: {x: 0.25, y: -0.5, z: 0.1}}"
    robot.run("rostopic", "pub", "-1", "/clicked_point", "geometry_msgs/PointStamped", click)
    assert eventually(lambda: "place 2" in robot.places.read_text()), robot.places.read_text()
    places = {place["name"]: (place["x"], place["y"]) for place in yaml.safe_load(robot.places.read_text())}
    assert places.pop("place 2") == (0.25, -0.5)
    assert places.pop("place 1") == pytest.approx(at, abs=0.05)
    assert places == PLACES


def test_M2_a_relay_whose_name_is_taken_ends_the_trial_and_the_session(robot):
    assert eventually(lambda: robot.field("/navvi/trial_state", "state") == TrialState.RUNNING)
    robot.start("/usr/bin/python3", "-c", "import rospy; rospy.init_node('relay_node'); rospy.spin()")
    robot.guide.wait(40)
    assert (summary(robot.folder)["result"], summary(robot.folder)["reason"]) == ("aborted", "name_taken")


def test_M1_the_robots_own_master_that_is_killed_ends_trial_and_session(tmp_path):
    port = free_port()
    env = dict(os.environ, ROS_MASTER_URI=f"http://127.0.0.1:{port}", ROS_IP="127.0.0.1")
    with Programs(env) as own:
        master = own.start("rosmaster", "--core", "-p", port)
        assert eventually(lambda: own.run("rosnode", "list").returncode == 0, 20)
        with Robot(env, tmp_path) as robot:
            assert eventually(lambda: robot.field("/navvi/guidance", "state") is not None, 120)
            robot.send_goal()
            assert eventually(lambda: robot.field("/navvi/trial_state", "state") == TrialState.RUNNING)
            master.kill()
            robot.guide.wait(40)
            assert (summary(tmp_path)["result"], summary(tmp_path)["reason"]) == ("aborted", "master_lost")


def test_the_robots_frames_and_radius_reach_who_reads_them():
    words = yaml.safe_load(roslaunch("--dump-params", "robot.launch", "map_frame:=tb3/map", "odom_frame:=tb3/odom", "base_frame:=tb3/base_footprint", "radius:=0.2",
                                     "height:=1.3", "emergency_stop:=/estop", "nav_parameters:={mesh: {robot_radius: 0.25}}"))
    assert words.items() >= {
        "/nav_node/map_frame": "tb3/map", "/perception_node/map_frame": "tb3/map", "/nav_node/base_frame": "tb3/base_footprint",
        "/perception_node/base_frame": "tb3/base_footprint", "/perception_node/robot_radius": 0.2, "/nav_node/mesh/robot_height": 1.3,
        "/relay_node/emergency_stop": "/estop", "/feedback_node/emergency_stop": "/estop", "/nav_node/mesh/robot_radius": 0.25,
        **{f"/{node}_node/odom_frame": "tb3/odom" for node in ("trial", "nav", "perception", "feedback")}}.items()


@pytest.mark.parametrize("words, contacts", [
    ("robot.launch", "unknown"), ("robot.launch sensors:=false", "unknown"), ("robot.launch bumper:=/bumper", "counted"),
    ("robot.launch bumper:=/bumper sensors:=false", "unknown"),
    ("person.launch clock:=/navvi/clock", "unknown"), ("person.launch clock:=/navvi/clock contacts:=counted", "counted"),
    ("person.launch clock:=/clock", "counted"), ("live.launch", "counted")])
def test_contacts_are_counted_only_where_something_tells_of_them(words, contacts):
    assert yaml.safe_load(roslaunch("--dump-params", *words.split()))["/trial_node/contacts"] == contacts


def test_a_rehearsal_reaches_no_wheels():
    words = roslaunch("--args relay_node", "robot.launch", "rehearse:=true", "wheels:=/robot/cmd_vel")
    assert " cmd_vel:=/navvi/rehearsed_cmd_vel" in words and ":=/robot/cmd_vel" not in words
