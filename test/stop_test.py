"""What happens to the wheels when the person's side dies at full speed."""
import pathlib
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parent.parent
WORLD = ROOT / "navvi_ws/src/navvi_sim/worlds/small_room.world"


@pytest.fixture
def session(master, tmp_path):
    launch = subprocess.Popen(["roslaunch", str(ROOT / "launch/live.launch"), "operator:=topic", f"world:={WORLD}",
                               "start:=-3.2,0.4,0", "goal:=3,0.4", "speech:=false", "feedback_parameters:={listener: topic}",
                               "rviz:=false", f"out:={tmp_path}"],
                              env=master, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    yield master
    launch.terminate()
    launch.wait(30)


def run_stick(session, what):
    stick = subprocess.run(["/usr/bin/python3", str(ROOT / "test/stick.py"), what], env=session, capture_output=True,
                           text=True, timeout=60)
    assert stick.returncode == 0, stick.stderr
    return stick.stdout.split()


def test_only_the_guide_drives(session):
    pushed, alone, driven, intruder = run_stick(session, "intrude")
    assert float(pushed) >= 0.3
    assert float(alone) < 1e-3, "another node has moved the robot"
    assert float(driven) >= 0.3, "another node has taken the robot away from the person"
    assert intruder == "/stick"


def test_commands_that_piled_up_while_the_simulator_was_halted_do_not_move_the_robot(session):
    pushed, afterwards = map(float, run_stick(session, "pause"))
    assert pushed >= 0.8
    assert afterwards < 1e-3, "the stick was never neutral"


def test_a_guide_that_was_halted_calls_nobody_else_lost(session):
    speed, *said = run_stick(session, "halt")
    assert float(speed) >= 0.8
    assert {"robot_stopped", "release_stick"} & set(said), said
    assert not {"simulator_lost", "guidance_lost", "proximity_lost"} & set(said), said


def test_a_killed_feedback_node_stops_the_robot_and_its_successor_does_not_start_it(session):
    speed, held, still, afterwards = map(float, run_stick(session, "kill"))
    print(f"at {speed:.2f} m/s: wheels held after {1000 * held:.0f} ms, still after {1000 * still:.0f} ms")
    assert speed >= 0.8
    # The bound is 250 ms on an idle machine, and twice that on a loaded one.
    assert held < 0.5 and still < 0.5
    assert afterwards < 1e-3, "the stick was never neutral"
