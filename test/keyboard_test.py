"""The keyboard as a stick, under a window manager, with keys pressed as a person presses them."""
import contextlib
import ctypes
import os
import pathlib
import signal
import subprocess
import time

import pytest

from display import Display
from sessions import ROOT, Programs, eventually, rows_of

# How xdotool finds a window, and a word of its title.
KEYS = ("--class", "key_window", "NavVI")
PICTURE = ("--name", "RViz$", "RViz")
OTHER = ("--name", "Event Tester", "Event Tester")  # xev's, in the part of RViz


class Keys(Programs):
    """A screen with a window manager, feedback_node on the keyboard, and what it publishes."""

    def __init__(self, master, folder):
        self.display = Display()
        super().__init__(dict(master, DISPLAY=self.display.name, PYTHONUNBUFFERED="1"))
        self.folder = folder
        self.start("openbox")
        echoes = {topic: self.echo(topic, name) for name, topic in (("commands", "/navvi/command"), ("cues", "/navvi/cues"))}
        self.node = self.start("rosrun", "navvi_feedback", "feedback_node", "_input:=keyboard", "_speech:=false", "_listener:=topic")
        for topic, echo in echoes.items():
            # By name: those of the test before may still be on the master's list.
            ends = "* /feedback_node ", f"* /rostopic_{echo.pid}_"
            assert eventually(lambda: all(end in self.command_line("rostopic", "info", topic) for end in ends), 120), f"nobody listens to {topic}"

    def echo(self, topic, name):
        with open(self.folder / name, "w") as file:
            return self.start("rostopic", "echo", "-p", topic, stdout=file)

    def command_line(self, *words):
        return self.run(*words, seconds=120).stdout.strip()

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

    def visible(self, window):
        return bool(self.xdotool("search", "--onlyvisible", *window[:2]).split())

    def tap(self, *keys):
        """Each for some 6 ms, as software types."""
        for key in keys:
            self.xdotool("key", key)
            time.sleep(0.1)

    def select(self, window, seconds=15):
        """As often as it takes: a window that is busy with its start may miss one."""
        def activate():
            self.xdotool("windowactivate", self.window(window))
            return eventually(lambda: self.has_focus(window), 1)
        assert eventually(activate, seconds), f"{window} does not get the focus"

    def rows(self, name):
        return rows_of(self.folder / name)

    def command(self, field="linear.x"):
        """m/s or rad/s, of the last command."""
        rows = self.rows("commands")
        return float(rows[-1][f"field.twist.{field}"]) if rows else 0.0

    def stands(self, seconds):
        """Whether no command moves the robot for so long."""
        before = len(self.rows("commands"))
        time.sleep(seconds)
        return all(float(row["field.twist.linear.x"]) == float(row["field.twist.angular.z"]) == 0.0 for row in self.rows("commands")[before:])

    def said(self, kind):
        return any(row["field.kind"] == kind for row in self.rows("cues"))

    def menu_steps(self):
        """What the menu has answered so far."""
        return sum(row["field.kind"].startswith("menu_") and row["field.stage"] == "0" for row in self.rows("cues"))

    def run_trial(self):
        self.start("rostopic", "pub", "-l", "/navvi/trial_state", "navvi_msgs/TrialState", "{state: 4}")
        assert eventually(lambda: "Publishers: None" not in self.command_line("rostopic", "info", "/navvi/trial_state"), 60)

    def drive(self):
        self.xdotool("keydown", "Up")
        assert eventually(lambda: self.command() > 0.8)

    def drive_and_turn(self):
        self.drive()
        self.xdotool("keyup", "Up")
        assert eventually(lambda: self.command() == 0.0)
        self.xdotool("keydown", "Shift", "keydown", "Left")
        assert eventually(lambda: self.command("angular.z") > 0.1)
        time.sleep(1)
        assert self.command("angular.z") < 0.5, "Shift is for fine turns"
        self.xdotool("keyup", "Left", "keyup", "Shift")

    def color(self):
        """Red, green and blue in the middle of the keyboard's window."""
        picture = subprocess.run(["import", "-window", self.window(KEYS), "-crop", "1x1+150+20", "-depth", "8", "rgb:-"],
                                 env=self.env, capture_output=True, timeout=20)
        return tuple(picture.stdout[:3])

    def __exit__(self, *given):
        super().__exit__(*given)
        self.display.close()


@contextlib.contextmanager
def frozen_window(process):
    """Its first thread, which draws, stands still meanwhile, and only that: as it waits for the display, where it holds no lock that others
    need."""
    trace = ctypes.CDLL(None, use_errno=True).ptrace
    trace.argtypes = [ctypes.c_long, ctypes.c_long, ctypes.c_void_p, ctypes.c_void_p]
    to_next_call, seize, interrupt, detach, all_threads = 24, 0x4206, 0x4207, 17, 0x40000000
    poll = "7"

    def waits():
        """Goes on to the next call of the system, with what was to be told to the thread."""
        signal_ = os.WSTOPSIG(os.waitpid(process.pid, all_threads)[1])
        if pathlib.Path(f"/proc/{process.pid}/syscall").read_text().split()[0] == poll:
            return True
        trace(to_next_call, process.pid, None, 0 if signal_ == signal.SIGTRAP else signal_)
        return False
    assert trace(seize, process.pid, None, None) == 0, os.strerror(ctypes.get_errno())
    try:
        trace(interrupt, process.pid, None, None)
        deadline = time.monotonic() + 20
        while not waits():
            assert time.monotonic() < deadline, "the window never waits"
        yield
    finally:
        trace(detach, process.pid, None, None)


@pytest.fixture
def keys(master, tmp_path):
    with Keys(master, tmp_path) as keys:
        yield keys


def test_keys_drive_only_where_they_are_meant(keys):
    keys.window(KEYS)
    # A window that opens later, as RViz does, keeps neither the focus nor the top, until a key was used.
    keys.start("xev")
    keys.window(OTHER)
    time.sleep(1)
    assert eventually(lambda: keys.has_focus(KEYS))
    assert eventually(lambda: keys.color()[1] > keys.color()[0]), "green: the keys drive"
    time.sleep(1)  # neutral

    keys.drive_and_turn()

    # The focus is lost with a key held: the robot stops, and the person is told.
    keys.drive()
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
    keys.drive()
    keys.xdotool("keyup", "Up")


def test_F6_keys_are_lost_with_the_display_and_return_with_it(keys):
    keys.window(KEYS)
    assert eventually(lambda: keys.has_focus(KEYS))
    time.sleep(1)  # neutral
    keys.drive()
    keys.display.close()
    assert eventually(lambda: keys.command() == 0.0, 0.5)
    assert eventually(lambda: keys.said("keyboard_lost"))
    assert keys.node.poll() is None, "the guide goes on"

    keys.display.start()
    keys.start("openbox")
    keys.window(KEYS)
    assert eventually(lambda: keys.has_focus(KEYS))
    time.sleep(1)
    keys.drive()
    assert keys.node.poll() is None


def test_keys_typed_into_the_picture_drive_too(keys):
    keys.window(KEYS)
    keys.env["LIBGL_ALWAYS_SOFTWARE"] = "1"
    rviz = keys.start("/usr/bin/rviz", "-d", ROOT / "rviz/navvi.rviz")
    keys.start("xev")
    keys.window(OTHER)
    assert eventually(lambda: keys.visible(PICTURE), 120)
    # Until its panel knows who listens, the small window asks for the focus again and again.
    assert eventually(lambda: not keys.visible(KEYS), 120), "the small window goes"
    assert eventually(lambda: keys.has_focus(PICTURE), 120), "the picture takes its place"
    time.sleep(3)  # neutral
    assert keys.has_focus(PICTURE)
    keys.drive_and_turn()
    keys.xdotool("key", "a")
    assert eventually(lambda: keys.said("proximity_lost"))

    # However long a frame takes.
    keys.drive()
    cues = len(keys.rows("cues"))
    with frozen_window(rviz):
        before = len(keys.rows("commands"))
        time.sleep(2)
        assert min(float(row["field.twist.linear.x"]) for row in keys.rows("commands")[before:]) > 0.8
        keys.xdotool("keyup", "Up")
        assert eventually(lambda: keys.command() == 0.0, 2)
        steps = keys.menu_steps()
        keys.tap(*["Next"] * 10)
        assert eventually(lambda: keys.menu_steps() == steps + 10, 2)
        keys.tap("Escape")
        assert eventually(lambda: keys.said("menu_closed"), 2)
    # A picture that stands still altogether has not lost its keys either; but the robot stands.
    keys.drive()
    rviz.send_signal(signal.SIGSTOP)
    time.sleep(0.6)
    rviz.send_signal(signal.SIGCONT)
    assert keys.command() == 0.0
    time.sleep(1)
    assert keys.command() == 0.0, "before the key was released"
    keys.xdotool("keyup", "Up")
    assert all(row["field.kind"] != "keyboard_lost" for row in keys.rows("cues")[cues:])
    time.sleep(1)

    # The focus is lost, and returns, with a key held.
    keys.drive()
    keys.select(OTHER)
    assert eventually(lambda: keys.command() == 0.0)
    assert eventually(lambda: keys.said("keyboard_lost"))
    assert not keys.visible(KEYS)
    keys.select(PICTURE)
    assert keys.stands(2)
    keys.xdotool("keyup", "Up")
    time.sleep(1)
    keys.drive()
    keys.xdotool("keyup", "Up")

    # To close the picture in a trial asks first.
    keys.run_trial()
    time.sleep(2)
    keys.xdotool("key", "alt+F4")
    assert eventually(lambda: keys.said("menu_end_sure"))
    assert keys.has_focus(PICTURE)

    # Without the picture the small window is back, and takes the focus.
    rviz.kill()
    assert eventually(lambda: keys.visible(KEYS) and keys.has_focus(KEYS))


def test_short_taps_count_and_a_key_that_was_down_before_does_not(keys):
    assert eventually(lambda: keys.has_focus(KEYS))
    keys.start("xev")
    keys.window(OTHER)
    time.sleep(1)
    keys.tap(*["Next"] * 20)
    assert eventually(lambda: keys.menu_steps() == 20, 3), keys.menu_steps()

    # It is down, and repeats, when the focus comes back.
    keys.select(OTHER)
    keys.xdotool("keydown", "Next")
    time.sleep(1)
    keys.select(KEYS)
    time.sleep(2)
    assert keys.menu_steps() == 20
    keys.xdotool("keyup", "Next")
    keys.tap("Next")
    assert eventually(lambda: keys.menu_steps() == 21, 3)


def test_escape_leaves_the_menu_and_only_f8_ends_the_trial(keys):
    keys.echo("/navvi/trial_request", "requests")
    assert eventually(lambda: keys.has_focus(KEYS))
    keys.run_trial()
    time.sleep(2)
    keys.tap("Next", "Escape", "Escape", "Escape")
    assert eventually(lambda: keys.said("menu_closed"))
    time.sleep(1)
    assert not keys.said("menu_end_sure")
    keys.tap("F8")
    assert eventually(lambda: keys.said("menu_end_sure"))
    time.sleep(0.3)
    assert not keys.rows("requests")
    keys.tap("F8")
    assert eventually(lambda: keys.rows("requests"))


def test_the_small_window_stays_in_a_corner(keys):
    found = dict(line.split("=") for line in keys.xdotool("getwindowgeometry", "--shell", keys.window(KEYS)).splitlines())
    left, top = int(found["X"]), int(found["Y"])
    right, bottom = left + int(found["WIDTH"]), top + int(found["HEIGHT"])
    assert left > 1280 / 2 and right <= 1280 and top >= 0 and bottom < 0.15 * 900, found


def test_closing_the_small_window_asks_whether_the_trial_is_to_end(keys):
    keys.echo("/navvi/trial_request", "requests")
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
