"""The keyboard as a stick, under a window manager, with keys pressed as a person presses them."""
import csv
import pathlib
import subprocess
import time

import pytest

from display import Display

ROOT = pathlib.Path(__file__).resolve().parent.parent

# How xdotool finds a window, and a word of its title.
KEYS = ("--class", "feedback_node", "NavVI")
PICTURE = ("--name", "RViz$", "RViz")
OTHER = ("--name", "Event Tester", "Event Tester")  # xev's, in the part of RViz


class Keys:
    """A screen with a window manager, feedback_node on the keyboard, and what it publishes."""

    def __init__(self, master, folder):
        self.display = Display()
        self.env = dict(master, DISPLAY=self.display.name, PYTHONUNBUFFERED="1")
        self.folder = folder
        self.processes = [self.start("openbox")]
        echoes = {topic: self.start("rostopic", "echo", "-p", topic, output=folder / name)
                  for name, topic in (("commands", "/cmd_vel"), ("cues", "/navvi/cues"))}
        self.processes.extend(echoes.values())
        self.processes.append(self.start("rosrun", "navvi_feedback", "feedback_node", "_input:=keyboard", "_speech:=false", "_listener:=topic"))
        for topic, echo in echoes.items():
            # By name: those of the test before may still be on the master's list.
            ends = "* /feedback_node ", f"* /rostopic_{echo.pid}_"
            assert eventually(lambda: all(end in self.command_line("rostopic", "info", topic) for end in ends), 120), f"nobody listens to {topic}"

    def start(self, *words, output="/dev/null"):
        with open(output, "w") as file:
            return subprocess.Popen(words, env=self.env, stdout=file, stderr=subprocess.DEVNULL)

    def command_line(self, *words):
        return subprocess.run(words, env=self.env, capture_output=True, text=True, timeout=60).stdout.strip()

    def xdotool(self, *words):
        return self.command_line("xdotool", *words)

    def window(self, window):
        """Its number."""
        found = []
        def search():
            found[:] = self.xdotool("search", "--onlyvisible", *window[:2]).split()
            return found
        assert eventually(search, 60), f"there is no window {window}"
        return found[0]

    def has_focus(self, window):
        return window[2] in self.xdotool("getwindowfocus", "getwindowname")

    def select(self, window, seconds=15):
        """As often as it takes: a window that is busy with its start may miss one."""
        def activate():
            self.xdotool("windowactivate", self.window(window))
            return eventually(lambda: self.has_focus(window), 1)
        assert eventually(activate, seconds), f"{window} does not get the focus"

    def rows(self, name):
        with open(self.folder / name) as file:
            return list(csv.DictReader(file))

    def command(self, field="linear.x"):
        """m/s or rad/s, of the last command."""
        rows = self.rows("commands")
        return float(rows[-1][f"field.{field}"]) if rows else 0.0

    def stands(self, seconds):
        """Whether no command moves the robot for so long."""
        before = len(self.rows("commands"))
        time.sleep(seconds)
        return all(float(row["field.linear.x"]) == float(row["field.angular.z"]) == 0.0 for row in self.rows("commands")[before:])

    def said(self, kind):
        return any(row["field.kind"] == kind for row in self.rows("cues"))

    def run_trial(self):
        self.processes.append(self.start("rostopic", "pub", "-l", "/navvi/trial_state", "navvi_msgs/TrialState", "{state: 4}"))
        assert eventually(lambda: "Publishers: None" not in self.command_line("rostopic", "info", "/navvi/trial_state"), 60)

    def color(self):
        """Red, green and blue in the middle of the keyboard's window."""
        picture = subprocess.run(["import", "-window", self.window(KEYS), "-crop", "1x1+300+40", "-depth", "8", "rgb:-"],
                                 env=self.env, capture_output=True, timeout=20)
        return tuple(picture.stdout[:3])

    def close(self):
        for process in reversed(self.processes):
            process.terminate()
            process.wait(20)
        self.display.close()


def eventually(condition, seconds=15):
    deadline = time.monotonic() + seconds
    while time.monotonic() < deadline:
        if condition():
            return True
        time.sleep(0.05)
    return False


@pytest.fixture
def keys(master, tmp_path):
    keys = Keys(master, tmp_path)
    yield keys
    keys.close()


def test_keys_drive_only_where_they_are_meant(keys):
    keys.window(KEYS)
    # A window that opens later, as RViz does, keeps neither the focus nor the top, until a key was used.
    keys.processes.append(keys.start("xev"))
    keys.window(OTHER)
    time.sleep(1)
    assert eventually(lambda: keys.has_focus(KEYS))
    assert eventually(lambda: keys.color()[1] > keys.color()[0]), "green: the keys drive"
    time.sleep(1)  # neutral

    keys.xdotool("keydown", "Up")
    assert eventually(lambda: keys.command() > 0.8)
    keys.xdotool("keyup", "Up")
    assert eventually(lambda: keys.command() == 0.0)
    keys.xdotool("keydown", "Shift", "keydown", "Left")
    assert eventually(lambda: keys.command("angular.z") > 0.1)
    time.sleep(1)
    assert keys.command("angular.z") < 0.5, "Shift is for fine turns"
    keys.xdotool("keyup", "Left", "keyup", "Shift")

    # The focus is lost with a key held: the robot stops, and the person is told.
    keys.xdotool("keydown", "Up")
    assert eventually(lambda: keys.command() > 0.8)
    keys.select(OTHER)
    assert eventually(lambda: keys.command() == 0.0)
    assert eventually(lambda: keys.said("keyboard_lost"))
    assert eventually(lambda: keys.color()[0] > keys.color()[1]), "red: the keys do not drive"
    time.sleep(2)
    assert keys.has_focus(OTHER), "the person's choice of a window stands"

    # It returns with the key still held: nothing moves before the key was released.
    keys.select(KEYS)
    assert keys.stands(2)
    keys.xdotool("keyup", "Up")
    time.sleep(1)
    keys.xdotool("keydown", "Up")
    assert eventually(lambda: keys.command() > 0.8)
    keys.xdotool("keyup", "Up")


def test_keys_typed_into_the_picture_drive_too(keys):
    keys.window(KEYS)
    keys.env["LIBGL_ALWAYS_SOFTWARE"] = "1"
    keys.processes.append(keys.start("/usr/bin/rviz", "-d", str(ROOT / "rviz/navvi.rviz")))
    keys.processes.append(keys.start("xev"))
    keys.window(OTHER)
    assert eventually(lambda: keys.xdotool("search", "--onlyvisible", *PICTURE[:2]), 120)
    # Until its panel knows who listens, the small window asks for the focus again and again.
    assert eventually(lambda: keys.command_line("rostopic", "info", "/navvi/keys").count("(http") == 2, 120)
    def keeps_focus():
        keys.select(PICTURE, 120)
        time.sleep(3)  # neutral
        return keys.has_focus(PICTURE)
    assert eventually(keeps_focus, 120), "the small window takes the focus from the picture"
    keys.xdotool("keydown", "Up")
    assert eventually(lambda: keys.command() > 0.8)
    keys.xdotool("keyup", "Up")
    assert eventually(lambda: keys.command() == 0.0)
    keys.xdotool("keydown", "Shift", "keydown", "Left")
    assert eventually(lambda: keys.command("angular.z") > 0.1)
    time.sleep(1)
    assert keys.command("angular.z") < 0.5, "Shift is for fine turns"
    keys.xdotool("keyup", "Left", "keyup", "Shift")
    keys.xdotool("key", "a")
    assert eventually(lambda: keys.said("around_nothing"))

    # From the picture to the small window with a key held: neutral is asked for.
    keys.xdotool("keydown", "Up")
    assert eventually(lambda: keys.command() > 0.8)
    keys.select(KEYS)
    assert eventually(lambda: keys.command() == 0.0)
    assert keys.stands(2)
    keys.xdotool("keyup", "Up")
    keys.select(PICTURE)
    time.sleep(2)

    # The focus is lost, and returns, with a key held.
    keys.xdotool("keydown", "Up")
    assert eventually(lambda: keys.command() > 0.8)
    keys.select(OTHER)
    assert eventually(lambda: keys.command() == 0.0)
    assert eventually(lambda: keys.said("keyboard_lost"))
    keys.select(PICTURE)
    assert keys.stands(2)
    keys.xdotool("keyup", "Up")
    time.sleep(1)
    keys.xdotool("keydown", "Up")
    assert eventually(lambda: keys.command() > 0.8)
    keys.xdotool("keyup", "Up")

    # To close the picture in a trial asks first.
    keys.run_trial()
    time.sleep(2)
    keys.xdotool("key", "alt+F4")
    assert eventually(lambda: keys.said("menu_end_sure"))
    assert keys.has_focus(PICTURE)


def test_closing_the_small_window_asks_whether_the_trial_is_to_end(keys):
    keys.processes.append(keys.start("rostopic", "echo", "-p", "/navvi/trial_request", output=keys.folder / "requests"))
    keys.window(KEYS)
    assert eventually(lambda: keys.has_focus(KEYS))
    keys.xdotool("key", "alt+F4")
    assert eventually(lambda: keys.said("no_trial"))
    keys.run_trial()
    time.sleep(2)
    keys.xdotool("key", "alt+F4")
    assert eventually(lambda: keys.said("menu_end_sure"))
    time.sleep(0.3)
    assert not keys.rows("requests")
    keys.xdotool("key", "alt+F4")
    assert eventually(lambda: keys.rows("requests"))
    assert keys.has_focus(KEYS), "the window stays, and its keys with it"
