#!/usr/bin/env python3
"""A person for tests who learns by ear and hand, in a process of its own: `pupil.py glossary`, `glossary_begins`, `tutorial` or `calibrate`, with a pad as
joy_node gives it, or after these the word `keys` with keys by xdotool. Hears the cues and feels the motors, and knows nothing else. Prints what is heard and pressed."""
import sys
import time

import rospy
from navvi_msgs.msg import Cue
from sensor_msgs.msg import JoyFeedbackArray

from hands import Hands

# What is done about each word of the guide.
OBEYED = {"wait": [("wait", [((0.0, 0.0), 0.5)]), ("go_on", [((0.0, 0.8), 1.5)])],
          "back_away": [("back_away", [((0.0, -0.8), 1.0)])],
          "make_room": [("make_room", [((0.6, 0.0), "turn_stop"), ((0.0, 0.0), 0.7), ((0.0, 0.8), 1.5)])]}


class Pupil(Hands):
    def __init__(self, keys):
        self.motors, self.last, self.sound, self.silent_since, self.speaking = (0.0, 0.0), "", "", 0.0, False
        self.sides, self.flow, self.pulse, self.pulsed = (0.0, 0.0), (0.0, 0.0), (0.0, 0.0), 0.0
        self.kinds, self.felt, self.signals = [], set(), 0
        super().__init__(keys)
        rospy.Subscriber("/joy/set_feedback", JoyFeedbackArray, self.feel, tcp_nodelay=True)

    def hear(self, cue):
        if cue.modality == Cue.RUMBLE and cue.kind:
            self.felt.add(cue.kind)
        self.signals += cue.stage == Cue.STARTED and cue.modality != Cue.SPEECH
        if cue.stage == Cue.STARTED and cue.modality == Cue.SPEECH:
            self.tell(cue.text)
            self.last, self.speaking, self.signals = cue.kind, True, 0
            self.kinds.append(cue.kind)
        elif cue.kind == "flow":
            self.flow = (cue.left, cue.right)
            self.kinds.append(cue.kind)
        elif cue.stage == Cue.STARTED and cue.modality == Cue.SOUND:
            if cue.kind != self.sound:
                self.tell(f"({cue.kind})")
            self.sound, self.sides = cue.kind, (cue.left, cue.right)
            self.kinds.append(cue.kind)
        elif cue.modality == Cue.SPEECH and cue.stage in (Cue.ENDED, Cue.CUT):
            self.speaking, self.silent_since = False, time.monotonic()

    def feel(self, message):
        self.motors = tuple(motor.intensity for motor in message.array[:2])
        if max(self.motors) > 0.0:
            self.pulse, self.pulsed = self.motors, time.monotonic()

    def listening(self):
        """All is told."""
        return self.last and not self.speaking and time.monotonic() - self.silent_since > 0.5

    def until(self, condition, seconds, what):
        super().until(condition, seconds, f"{what}; last heard: {self.last}")

    def push(self, x, y):
        self.tell(f"[stick {x} {y}]")
        self.steer(x, y)

    def follow(self, step):
        """To where a sound that lasts, or pulses, lead, until they have ended for a while."""
        def shown():
            if step == "by_hand":
                return self.pulse if time.monotonic() - self.pulsed < 1.2 else (0.0, 0.0)
            return self.flow
        self.until(lambda: max(shown()) > 0.0, 20, "something leads")
        last = time.monotonic()
        while time.monotonic() - last < 1.5 and not rospy.is_shutdown():
            left, right = shown()
            leads = max(left, right) > 0.0
            last = time.monotonic() if leads else last
            lean = (left - right) / (left + right) if leads else 0.0
            self.steer(0.4 * lean if step == "by_hand" else lean, 0.6 if leads and abs(lean) < 0.9 else 0.0)
            time.sleep(0.05)

    def glossary(self, signals=99):
        """To the end, or ends it after so many."""
        while "glossary_end" not in self.kinds:
            self.until(self.listening, 60, "it is silent")
            turns = self.last.startswith(("glossary_near", "glossary_sound_turn"))
            # Of words the signal is the next phrase.
            self.until(lambda: turns or self.signals or not self.last.startswith("glossary"), 10, "the signal is given")
            time.sleep(3.2 if turns else 0.1)
            self.until(self.listening, 60, "it is silent")
            signals -= 1
            before = self.last
            self.press("next" if signals > 0 else "end")
            self.until(lambda: self.last != before or self.speaking, 10, "something is told")

    def glossary_begins(self):
        self.glossary(2)

    def tutorial(self):
        late = True
        while self.last not in ("tutorial_well", "tutorial_done"):
            self.until(self.listening, 90, "a step is told")
            step = self.last.replace("tutorial_", "")
            self.sound = ""
            if step in ("well", "done"):
                break
            if step in ("good", "practice", "buttons", "keys") or step.startswith(("wrong", "said")):
                time.sleep(0.05)
                continue
            if step == "goal":
                self.to_the_goal()
            elif step.startswith("press_"):
                self.press(step.replace("press_", ""))
            elif step.startswith("near_"):
                self.until(lambda: max(self.motors) > 0.2 or self.sound, 10, "something is felt or sounds")
                time.sleep(0.3)
                left, right = self.sides if self.keys else self.motors
                self.push(1.0 if left > 2 * right else -1.0 if right > 2 * left else 0.0, 1.0 if max(left, right) < 2 * min(left, right) else 0.0)
                time.sleep(0.5)
            elif step in ("by_sound", "by_hand"):
                self.follow(step)
            elif step in OBEYED:
                self.obey(*OBEYED[step])
                continue
            elif step.startswith("turn_"):
                self.push(-0.6 if step == "turn_right" else 0.6, 0.0)
                self.until(lambda: self.sound == "turn_stop", 20, "the turn is to end")
                time.sleep(3.5 if late else 0.2)  # the robot crawls beyond the corner
                late = False
            else:
                self.push(0.0, 0.8)
                wanted = {"ahead": "tutorial_enough", "halt": "tutorial_stop"}.get(step)
                self.until(lambda: not wanted or self.last == wanted, 20, f"{wanted} is said")
                time.sleep(0.3 if wanted else 1.0)
            self.push(0.0, 0.0)
            self.until(lambda: self.last != f"tutorial_{step}", 30, f"something is told after {step}")

    def obey(self, *words):
        """Stands until each word is heard, and then makes its moves: axes of the stick, and for how long, or until what sound."""
        for word, moves in words:
            if word == "wait":
                self.push(0.0, 0.8)
            self.until(lambda: self.last == f"tutorial_said_{word}", 20, f"{word} is said")
            time.sleep(0.3)
            self.sound = ""
            for axes, end in moves:
                self.push(*axes)
                if isinstance(end, str):
                    self.until(lambda: self.sound == end, 20, f"{end} sounds")
                    time.sleep(0.2)
                else:
                    time.sleep(end)
            self.push(0.0, 0.0)
        self.until(lambda: not self.last.startswith("tutorial_said"), 30, "something is told after that")

    def to_the_goal(self):
        let_go = self.follow_operator()
        try:
            self.press("start")
            self.until(lambda: "arrived" in self.kinds, 200, "the goal is reached")
        finally:
            let_go()

    def calibrate(self):
        """Feels 0.1 on the left, 0.2 on the right, likes 0.5, and lets go after 0.3 s."""
        felt = False
        while "calibrate_done" not in self.kinds:
            left, right = self.motors
            feels = left > 0.1 or right > 0.2
            if not self.listening():
                pass
            elif self.last in ("calibrate_left", "calibrate_right") and feels and not felt:
                time.sleep(0.3)
                self.press("repeat")
            elif self.last == "calibrate_comfort" and feels and not felt:
                self.press("next" if left > 0.51 else "start")
            elif self.last == "calibrate_confirm":
                self.press("start")
                self.until(lambda: "calibrate_done" in self.kinds, 10, "the values are saved")
            elif self.last in ("calibrate_halt", "calibrate_once_more", "calibrate_late", "calibrate_early"):
                self.sound = ""
                self.push(0.0, 1.0)
                self.until(lambda: self.sound == "turn_stop", 10, "the signal comes")
                time.sleep(0.3)
                before = len(self.kinds)
                self.push(0.0, 0.0)
                self.until(lambda: len(self.kinds) > before, 10, "something is told")
            felt = feels
            time.sleep(0.01)


if __name__ == "__main__":
    rospy.init_node("pupil", disable_rostime=True)
    pupil = Pupil(sys.argv[2:] == ["keys"])
    getattr(pupil, sys.argv[1])()
    print(sorted(set(pupil.kinds) | pupil.felt), flush=True)
