"""Whole sessions by hand and ear: three goals by pad alone, three by keys alone, and one by the panel's keys in RViz and the driving
keys. Nothing is looked at: what is pressed depends on what is said, and the simulated operator drives by ear."""
import pathlib
import subprocess

import pytest

from display import Display

pytestmark = pytest.mark.accessibility
ROOT = pathlib.Path(__file__).resolve().parent.parent


@pytest.fixture
def layout(tmp_path):
    path = tmp_path / "hall.yaml"
    path.write_text("name: hall\npreset: easy\nlayout: {length: 11, width: 13, rows: 1, blocks: 1, bays: 1, docks: 1, aisle: 3.2, staged: 0, "
                    "forklifts: 0, pallet_robots: 0, walking_workers: 0, standing_workers: 0}\n")
    return path


def session(env, folder, layout, person, results, *words):
    launch = subprocess.Popen(["roslaunch", str(ROOT / "launch/live.launch"), f"operator:={'auto' if person == 'auto' else 'keyboard'}", f"world:={layout}", "once:=false",
                               "speech:=false", "feedback_parameters:={listener: topic}", "sim_parameters:={scenario: {min_route: 4, max_route: 7}}", f"out:={folder}", "limit:=300", *words],
                              env=env, stdout=open(folder / "log", "w"), stderr=subprocess.STDOUT)
    person = subprocess.Popen(["/usr/bin/python3", str(ROOT / "test/person.py"), person], env=env, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    try:
        told, error = person.communicate(timeout=600)
        assert person.returncode == 0, told[-6000:] + error[-2000:]
    finally:
        person.kill()
        launch.terminate()
        launch.wait(30)
    print(told)
    found = [path.read_text().splitlines()[1] for path in sorted(folder.glob("trial-*/summary.csv"))]
    assert len(found) == len(results) and all(word in row for row, word in zip(found, results)), found


def test_three_goals_by_pad_alone(master, tmp_path, layout):
    env = {key: value for key, value in master.items() if key not in ("DISPLAY", "WAYLAND_DISPLAY")}
    session(env, tmp_path, layout, "auto", ["goal_reached"] * 3, "rviz:=false")


@pytest.fixture
def desktop(master):
    """The environment of a display with a window manager."""
    display = Display()
    env = dict(master, DISPLAY=display.name, LIBGL_ALWAYS_SOFTWARE="1")
    windows = subprocess.Popen(["openbox"], env=env, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        yield env
    finally:
        windows.terminate()
        windows.wait()
        display.close()


def test_three_goals_by_keys_alone(desktop, tmp_path, layout):
    session(desktop, tmp_path, layout, "keyboard", ["goal_reached"] * 3, "rviz:=false")


def test_a_goal_by_panel_and_keys_alone(desktop, tmp_path, layout):
    session(desktop, tmp_path, layout, "panel", ["goal_reached", "aborted"], "rviz:=true")
