"""Whole sessions by hand and ear: three goals by pad alone, and by keys alone. Nothing is looked at: what is pressed depends on what
is said, and the simulated operator drives by ear."""
import pathlib
import subprocess

import pytest

from live_session_test import Display

ROOT = pathlib.Path(__file__).resolve().parent.parent


@pytest.fixture
def layout(tmp_path):
    path = tmp_path / "hall.yaml"
    path.write_text("name: hall\npreset: easy\nlayout: {length: 11, width: 13, rows: 1, blocks: 1, bays: 1, docks: 1, aisle: 3.2, staged: 0, "
                    "forklifts: 0, pallet_robots: 0, walking_workers: 0, standing_workers: 0}\n")
    return path


def session(master, folder, layout, operator, **more):
    launch = subprocess.Popen(["roslaunch", str(ROOT / "launch/live.launch"), f"operator:={operator}", f"world:={layout}", "once:=false",
                               "speech:=false", "feedback_parameters:={listener: topic}", "rviz:=false", "sim_parameters:={scenario: {min_route: 4, max_route: 7}}", f"out:={folder}", "limit:=300"],
                              env=dict(master, **more), stdout=open(folder / "log", "w"), stderr=subprocess.STDOUT)
    person = subprocess.Popen(["/usr/bin/python3", str(ROOT / "test/person.py"), operator], env=dict(master, **more), text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    try:
        told, error = person.communicate(timeout=600)
        assert person.returncode == 0, told[-6000:] + error[-2000:]
    finally:
        person.kill()
        launch.terminate()
        launch.wait(30)
    print(told)
    results = [path.read_text().splitlines()[1] for path in sorted(folder.glob("trial-*/summary.csv"))]
    assert sum("goal_reached" in result for result in results) == 3, results


def test_three_goals_by_pad_alone(master, tmp_path, layout):
    env = {key: value for key, value in master.items() if key not in ("DISPLAY", "WAYLAND_DISPLAY")}
    session(env, tmp_path, layout, "auto")


def test_three_goals_by_keys_alone(master, tmp_path, layout):
    display = Display()
    manager = subprocess.Popen(["openbox"], env=dict(master, DISPLAY=display.name), stderr=subprocess.DEVNULL)
    try:
        session(master, tmp_path, layout, "keyboard", DISPLAY=display.name)
    finally:
        manager.terminate()
        manager.wait(10)
        display.close()
