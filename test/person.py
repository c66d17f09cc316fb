#!/usr/bin/env python3
"""A person for tests, in a process of its own: `person.py auto` with a pad as joy_node gives it, `person.py keyboard` with keys by xdotool,
`person.py panel` with those and the panel's in RViz, `person.py job PLACE` with keys through a job, that place first. The first two drive to three goals: the task's, one that it chooses from the spoken menu by name, and the one before that. It hears the cues, and the
hand of the simulated operator, which hears them too, holds the stick. Prints what is heard and pressed."""
import subprocess
import sys
import time

import rospy
from navvi_msgs.msg import Cue
from std_msgs.msg import String

from hands import Hands


class Person(Hands):
    def __init__(self, keys):
        self.heard, self.known = [], 0
        super().__init__(keys)
        self.let_go = self.follow_operator()

    def hear(self, cue):
        if cue.modality == Cue.SPEECH and cue.stage == Cue.STARTED:
            self.tell(cue.text)
            self.heard.append((cue.kind, cue.text))

    def press(self, name):
        """A short press, and what is said to it."""
        before = len(self.heard)
        super().press(name)
        time.sleep(0.15)
        self.until(lambda: len(self.heard) > before, 3, f"{name} is answered")
        return self.heard[before][1]

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


class AtWork(Person):
    """Drives to four places of a job, the one that is named first, and confirms what is done at each."""

    def run(self):
        asks = ("press_start", "press_enter", "press_pick", "press_drop", "press_scan")
        self.wait_for(asks, 60)
        self.choose(sys.argv[2])
        for _ in range(4):
            self.press("start")
            self.wait_for(("arrived",), 200)
            self.wait_for(asks, 60)
        Hands.press(self, "start")


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
        self.tell(f"[{key}]")
        before = len(self.heard)
        self.tap(key)
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
    rospy.init_node("person", disable_rostime=True)
    person = {"panel": AtThePanel, "job": AtWork}.get(sys.argv[1], Person)(sys.argv[1] != "auto")
    try:
        person.run()
    finally:
        person.let_go()
