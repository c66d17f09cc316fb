#!/usr/bin/env python3
"""A person for tests, in a process of its own: `person.py auto` with a pad as joy_node gives it, `person.py keyboard` with keys by xdotool,
`person.py panel` with those and the panel's in RViz. The first two drive to three goals: the task's, one that it chooses from the spoken menu by name, and the one before that. It hears the cues, and the
hand of the simulated operator, which hears them too, holds the stick. Prints what is heard and pressed."""
import subprocess
import sys
import time

import rospy
from navvi_msgs.msg import Cue
from sensor_msgs.msg import Joy
from std_msgs.msg import String

BUTTONS = {"start": 6, "previous": 11, "next": 12, "back": 13, "choose": 14}
KEYS = {"start": "Return", "previous": "Prior", "next": "Next", "back": "BackSpace", "choose": "Return"}


class Person:
    def __init__(self, keyboard):
        rospy.init_node("person", disable_rostime=True)
        self.keyboard, self.heard, self.known, self.down, self.held = keyboard, [], 0, None, set()
        self.begun = time.monotonic()
        self.joy = rospy.Publisher("/joy", Joy, queue_size=1)
        rospy.Subscriber("/navvi/cues", Cue, self.hear, tcp_nodelay=True)
        self.operator = subprocess.Popen(["rosrun", "navvi_people", "operator_node", "joy:=hand", "__name:=operator_node"])
        rospy.Subscriber("/hand", Joy, self.steer, queue_size=1, tcp_nodelay=True)

    def hear(self, cue):
        if cue.modality == Cue.SPEECH and cue.stage == Cue.STARTED:
            print(f"{time.monotonic() - self.begun:6.1f}  {cue.text}", flush=True)
            self.heard.append((cue.kind, cue.text))

    def steer(self, hand):
        if not self.keyboard:
            buttons = [0] * 15
            if self.down:
                buttons[BUTTONS[self.down]] = 1
            self.joy.publish(Joy(axes=hand.axes, buttons=buttons))
            return
        left, forward = hand.axes
        wanted = {key for key, on in (("Left", left > 0.3), ("Right", left < -0.3), ("Up", forward > 0.3), ("Down", forward < -0.3)) if on}
        if wanted and abs(left) < 0.7 and wanted - {"Up"}:
            wanted.add("Shift")
        words = [word for key in self.held - wanted for word in ("keyup", key)] + [word for key in wanted - self.held for word in ("keydown", key)]
        self.held = wanted
        if words:
            subprocess.run(["xdotool", *words], check=True, timeout=10)

    def press(self, name):
        """A short press, and what is said to it."""
        before = len(self.heard)
        print(f"{time.monotonic() - self.begun:6.1f}  [{name}]", flush=True)
        if self.keyboard:
            subprocess.run(["xdotool", "keydown", KEYS[name], "sleep", "0.15", "keyup", KEYS[name]], check=True, timeout=10)
        else:
            self.down = name
            time.sleep(0.15)
            self.down = None
        time.sleep(0.15)
        self.until(lambda: len(self.heard) > before, 3, f"{name} is answered")
        return self.heard[before][1]

    def until(self, condition, seconds, what):
        deadline = time.monotonic() + seconds
        while not condition():
            if time.monotonic() > deadline:
                sys.exit(f"in {seconds} s it did not come true that {what}; last heard: {self.heard[-5:]}")
            time.sleep(0.02)

    def wait_for(self, kinds, seconds):
        """Until one of them is said, after what was waited for before."""
        self.until(lambda: any(kind in kinds for kind, _ in self.heard[self.known:]), seconds, f"{kinds} is said")
        self.known = len(self.heard)

    def choose(self, place):
        said = self.press("next")
        for _ in range(5):
            if said == "goals":
                break
            said = self.press("next")
        said = self.press("choose")
        for _ in range(20):
            if said == place:
                break
            said = self.press("next")
        before = len(self.heard)
        said = self.press("choose")
        assert self.heard[before][0] == "goal_chosen" and said.endswith(place), said

    def drive(self):
        self.wait_for(("press_start", "press_enter"), 60)
        self.press("start")
        self.wait_for(("arrived",), 200)

    def run(self):
        self.drive()
        for place in ("cross aisle 1", "the previous goal"):
            self.wait_for(("choose_goal",), 30)
            self.choose(place)
            self.drive()


WAY = ("trial_begins", "start", "start_distance", "direction", "straight", "straight_then", "slight", "turn_now", "turn_ahead")


class AtThePanel(Person):
    """Begins, asks and ends by the panel's keys, and drives by the others, all in RViz's window."""

    def window(self, *how):
        """Selects it, as often as it takes."""
        def xdotool(*words):
            return subprocess.run(["xdotool", *words], stdout=subprocess.PIPE, text=True, timeout=60).stdout.split()
        found = xdotool("search", "--sync", "--onlyvisible", *how)
        def selected():
            xdotool("windowactivate", found[0])
            time.sleep(0.3)
            return xdotool("getwindowfocus")[:1] == found[:1] or xdotool("getactivewindow")[:1] == found[:1]
        self.until(selected, 60, f"{how} is selected")

    def panel(self, key, kinds):
        """Presses it, and waits for the answer."""
        print(f"{time.monotonic() - self.begun:6.1f}  [{key}]", flush=True)
        before = len(self.heard)
        subprocess.run(["xdotool", "keydown", key, "sleep", "0.15", "keyup", key], check=True, timeout=10)
        self.until(lambda: any(kind in kinds for kind, _ in self.heard[before:]), 60, f"{key} is answered")

    def change_a_setting(self):
        """The first one, which the panel's key opens, to its next value; then the menu is closed."""
        self.panel("F3", ("setting",))
        before = len(self.heard)
        for key in "choose", "next", "back", "back", "back":
            self.press(key)
        self.until(lambda: {"setting_open", "setting_changed", "menu_closed"} <= {kind for kind, _ in self.heard[before:]}, 20, "the setting is changed")

    def run(self):
        asked = rospy.Subscriber("/navvi/ask", String)
        self.until(asked.get_num_connections, 120, "the panel is there")
        self.wait_for(("press_start", "press_enter"), 60)
        self.window("--name", "RViz$")
        time.sleep(1)
        self.panel("F5", WAY)
        self.panel("g", ("goal_info", "goal_info_distance"))
        self.panel("r", WAY)
        self.change_a_setting()
        self.wait_for(("arrived",), 200)
        self.wait_for(("choose_goal",), 30)
        self.choose("cross aisle 1")
        self.wait_for(("press_start", "press_enter"), 30)
        self.panel("F5", WAY)
        self.panel("F8", ("menu_end_sure",))
        self.panel("F8", ("trial_over",))


if __name__ == "__main__":
    person = AtThePanel(True) if sys.argv[1] == "panel" else Person(sys.argv[1] == "keyboard")
    try:
        person.run()
    finally:
        person.operator.terminate()
