"""A person's ears and hands in a process with rospy: hears the cues, holds the stick and presses buttons, of a pad as joy_node gives it or
keys by xdotool."""
import subprocess
import sys
import threading
import time

import rospy
from navvi_msgs.msg import Cue
from sensor_msgs.msg import Joy

KEYS = {"repeat": "space", "around": "a", "where": "w", "end": "F8", "help": "h", "start": "Return", "previous": "Prior", "next": "Next", "back": "BackSpace", "choose": "Return"}
BUTTONS = {"repeat": 0, "around": 2, "where": 3, "end": 4, "help": 5, "start": 6, "previous": 11, "next": 12, "back": 13, "choose": 14}


class Hands:
    def __init__(self, keys=False):
        self.keys, self.begun, self.over = keys, time.monotonic(), False
        self.axes, self.down, self.held = [0.0, 0.0], None, set()
        self.cues = rospy.Subscriber("/navvi/cues", Cue, self.hear, tcp_nodelay=True)
        if not keys:
            self.joy = rospy.Publisher("/joy", Joy, queue_size=1)
            self.holding = threading.Thread(target=self.hold, daemon=True)
            self.holding.start()

    def hear(self, cue):
        """Of each cue."""

    def tell(self, text):
        print(f"{time.monotonic() - self.begun:6.1f}  {text}", flush=True)

    def hold(self):
        while not self.over and not rospy.is_shutdown():
            self.joy.publish(Joy(axes=self.axes, buttons=[int(at == BUTTONS.get(self.down)) for at in range(15)]))
            time.sleep(0.02)

    def steer(self, left, forward):
        """Holds the stick so from now on."""
        if not self.keys:
            self.axes = [left, forward]
            return
        wanted = {key for key, on in (("Left", left > 0.3), ("Right", left < -0.3), ("Up", forward > 0.3), ("Down", forward < -0.3)) if on}
        if 0.3 < abs(left) < 0.7:
            wanted.add("Shift")
        words = [word for key in self.held - wanted for word in ("keyup", key)] + [word for key in wanted - self.held for word in ("keydown", key)]
        self.held = wanted
        if words:
            subprocess.run(["xdotool", *words], check=True, timeout=10)

    def press(self, name):
        """A short press."""
        self.tell(f"[{name}]")
        if self.keys:
            self.tap(KEYS[name])
            return
        self.down = name
        time.sleep(0.12)
        self.down = None

    @staticmethod
    def tap(key):
        subprocess.run(["xdotool", "keydown", key, "sleep", "0.12", "keyup", key], check=True, timeout=10)

    def until(self, condition, seconds, what):
        deadline = time.monotonic() + seconds
        while not condition() and not rospy.is_shutdown():
            if time.monotonic() > deadline:
                sys.exit(f"in {seconds} s it did not come true that {what}")
            time.sleep(0.01)

    def follow_operator(self):
        """The stick is held by the hand of the simulated operator, which hears the cues too, until what this returns is called."""
        operator = subprocess.Popen(["rosrun", "navvi_people", "operator_node", "joy:=hand", "__name:=operator_node"])
        follows = [True]
        hand = rospy.Subscriber("/hand", Joy, lambda hand: follows and self.steer(*hand.axes), queue_size=1, tcp_nodelay=True)

        def let_go():
            follows.clear()
            operator.terminate()
            hand.unregister()
            self.steer(0.0, 0.0)
        return let_go
