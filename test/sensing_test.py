"""`./navvi run sensing:=robot`: the guide knows only what the robot's sensors show, and the record the truth."""
import re

import pytest

from sessions import roslaunch

LIVE = ("live.launch", "operator:=simulated", "rviz:=false")
TOLD = ("octomap_binary", "navvi/obstacles", "navvi/proximity", "navvi/contacts")


@pytest.mark.parametrize("node, told", [("nav_node", TOLD), ("feedback_node", TOLD[2:]), ("perception_node", TOLD)])
def test_who_guides_gets_what_is_seen_and_not_the_truth(node, told):
    words = roslaunch(f"--args {node}", *LIVE, "sensing:=robot")
    for topic in told:
        assert re.search(rf"\b{topic}:=/?navvi/seen/\w+", words), words


@pytest.mark.parametrize("node", ["sim_node", "trial_node"])
def test_the_record_is_of_the_truth(node):
    assert "navvi/seen" not in roslaunch(f"--args {node}", *LIVE, "sensing:=robot")


def test_the_record_names_what_guided_and_whose_place_of_the_robot_it_is():
    def recorded(*words):
        return re.search(r"^/trial_node/parameters: (.*)$", roslaunch("--dump-params", *LIVE, *words), re.M).group(1).strip("'")
    assert recorded("sensing:=lidar", "parameters:=a/b=1") == "sim/sensing=lidar place=simulator a/b=1"
    assert recorded() == ""


def test_the_truth_is_told_where_nothing_else_is_asked_for():
    assert "navvi/seen" not in roslaunch("--args nav_node", *LIVE)
    assert "perception_node" not in roslaunch("--nodes", *LIVE)


def test_a_session_by_the_robots_own_sensors_reaches_its_goal(session, tmp_path):
    done = session("world:=training", "sensing:=robot", "limit:=200")
    said = done.wait_until_ended(900)
    assert done.process.returncode == 0, said[-6000:]
    log = next(tmp_path.glob("session-*.log")).read_text()
    assert "A prior map of" in log
    assert "Map taken" in log
    assert "TF_REPEATED" not in log, "a line for each step of the simulator"
