"""A person's settings: changed while driving, heard and felt at once, kept in their file, true in the records of trials to come."""
import os
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest
import rospy
import yaml
from navvi_msgs.msg import Cue
from sensor_msgs.msg import Joy

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "navvi_ws/src/navvi_study/python"))
from navvi_study import questionnaire  # noqa: E402

SELECT, START, UP, DOWN, LEFT, RIGHT = 4, 6, 11, 12, 13, 14


class Session:
    """feedback_node, the pad of another driver with its arrow pad, and what is heard and felt."""

    def __init__(self, env, *words):
        self.said, self.answers, self.felt, self.down, self.stick, self.over = [], [], [], None, [0, 0], False
        self.joy = rospy.Publisher("/joy", Joy, queue_size=1)
        self.cues = rospy.Subscriber("/navvi/cues", Cue, self.hear)
        self.node = subprocess.Popen(["rosrun", "navvi_feedback", "feedback_node", "_input:=topic", "_speech:=false", "_listener:=topic", *words], env=env)
        self.hand = threading.Thread(target=self.hold)
        self.hand.start()
        self.until(lambda: self.joy.get_num_connections() > 0 and self.cues.get_num_connections() > 0)
        time.sleep(0.5)  # hands off, as it sees them first: what is down from the beginning was not pressed

    def hear(self, cue):
        if cue.stage == Cue.STARTED:
            (self.said if cue.modality == Cue.SPEECH else self.felt).append(cue.text or cue.kind)
            if cue.kind.startswith("menu_") or cue.kind in ("setting", "setting_open", "setting_changed"):
                self.answers.append(cue.text)

    def hold(self):
        while not self.over:
            self.joy.publish(Joy(axes=self.stick, buttons=[int(i == self.down) for i in range(15)]))
            time.sleep(0.02)

    def until(self, condition):
        deadline = time.monotonic() + 20
        while not condition():
            assert time.monotonic() < deadline, self.said[-5:]
            time.sleep(0.02)

    def press(self, *buttons):
        """Short presses. Returns what the menu says to the last, whatever else is said."""
        for button in buttons:
            before = len(self.answers)
            self.down = button
            time.sleep(0.1)
            self.down = None
            self.until(lambda: len(self.answers) > before)
            time.sleep(0.1)
        return self.answers[before]

    def close(self):
        self.over = True
        self.hand.join()
        self.node.terminate()
        self.node.wait(20)
        self.cues.unregister()
        self.joy.unregister()


@pytest.fixture(scope="module")
def env(master):
    os.environ.update(ROS_MASTER_URI=master["ROS_MASTER_URI"], ROS_IP=master["ROS_IP"])
    rospy.init_node("person_test", disable_rostime=True, disable_signals=True)
    return master


@pytest.fixture
def session(env, tmp_path):
    sessions = []

    def begin(*words):
        for old in sessions:
            old.close()
        sessions[:] = [Session(dict(env, NAVVI_PEOPLE=str(tmp_path)), *words)]
        return sessions[0]

    yield begin
    sessions[0].close()
    rospy.delete_param("/feedback_node")


def saved(folder):
    path = folder / "anna.yaml"
    return yaml.safe_load(path.read_text()) if path.exists() else {}


def test_settings_are_changed_by_the_pad_and_kept(session, tmp_path):
    pad = session("_person:=anna")
    pad.until(lambda: "settings of anna" in pad.said)
    assert pad.press(DOWN) == "settings"
    assert pad.press(RIGHT) == "speech rate, 220"
    assert pad.press(RIGHT) == "speech rate, 220, up for more, down for less"
    assert pad.press(UP) == "speech rate 240"
    pad.until(lambda: saved(tmp_path) == {"speaker": {"rate": 240}})
    assert pad.press(LEFT, DOWN, DOWN) == "strength of vibration, 100 percent"
    assert pad.press(RIGHT, DOWN) == "strength of vibration 90 percent"
    pad.until(lambda: "sample" in pad.felt)
    assert pad.press(LEFT, DOWN) == "amount of speech, normal"
    assert pad.press(RIGHT, UP) == "amount of speech full"
    pad.until(lambda: saved(tmp_path) == {"speaker": {"rate": 240}, "haptics": {"strength": 0.9}, "cues": {"wording": {"verbosity": "full"}}})
    assert not any("for this session only" in said for said in pad.said)
    # What trials to come name in their record, and what the node takes if it must be started anew.
    assert rospy.get_param("/feedback_node/speaker/rate") == "240"
    pad = session("_person:=anna")
    assert pad.press(DOWN, RIGHT) == "speech rate, 240"


def test_who_has_no_file_is_told_that_settings_are_not_kept(session, tmp_path):
    pad = session()
    assert pad.press(DOWN, RIGHT, RIGHT, DOWN) == "speech rate 200"
    pad.until(lambda: any("for this session only" in said for said in pad.said))
    assert list(tmp_path.iterdir()) == []


def test_a_setting_that_cannot_be_written_is_said_and_holds(session, tmp_path):
    (tmp_path / "people").write_text("a file where a folder should be")
    (tmp_path / "people").rename(tmp_path / "anna.yaml")
    pad = session("_person:=anna")
    assert pad.press(DOWN, RIGHT, RIGHT, DOWN) == "speech rate 200"
    pad.until(lambda: "the settings cannot be saved" in pad.said)
    assert (tmp_path / "anna.yaml").read_text() == "a file where a folder should be"


def test_a_questionnaire_is_answered_by_the_pad_and_each_answer_is_saved_at_once(session, tmp_path):
    questions, record = tmp_path / "asked.yaml", tmp_path / "answers.csv"
    questions.write_text("items:\n"
                         "  - {name: hard, ask: How hard was it, values: [\"0\", \"50\", \"100\"], spoken: [\"0, easy\", \"50\", \"100, hard\"]}\n"
                         "  - {name: again, ask: Would you drive again, values: [\"no\", \"yes\"], spoken: [\"no\", \"yes\"]}\n")
    pad = session("_lesson:=questionnaire", f"_questions:={questions}", f"_record:={record}")

    def tap(button, heard):
        pad.down = button
        time.sleep(0.1)
        pad.down = None
        pad.until(lambda: pad.said[-1:] == [heard])
        time.sleep(0.1)

    def answers():
        return [line.split(",")[:2] for line in record.read_text().splitlines()[1:]] if record.exists() else []
    pad.until(lambda: pad.said[-1:] == ["How hard was it"])
    tap(UP, "50")
    tap(UP, "100, hard")
    tap(START, "Would you drive again")
    pad.until(lambda: answers() == [["hard", "100"]])
    tap(LEFT, "100, hard")
    tap(DOWN, "50")
    tap(START, "Would you drive again")
    pad.until(lambda: answers() == [["hard", "50"]])
    tap(SELECT, "arrow left to go back")
    assert answers() == [["hard", "50"], ["again", "declined"]]
    tap(START, "thank you")
    assert pad.node.wait(20) == 0


def test_a_direction_is_pointed_at_with_the_stick_in_a_file_as_a_study_writes_it(session, tmp_path):
    asked, record = tmp_path / "asked.yaml", tmp_path / "answers.csv"
    probe = questionnaire.load(questionnaire.SHIPPED / "probe.yaml")
    asked.write_text(questionnaire.script(probe.items, probe.title, probe.intro))
    pad = session("_lesson:=questionnaire", f"_questions:={asked}", f"_record:={record}")
    pad.until(lambda: pad.said[-1:] == [probe.items[0].ask])
    time.sleep(3.0)  # also the words
    pad.stick = [1.0, 0.0]
    pad.until(lambda: pad.said[-1:] == ["9 o'clock"])
    pad.stick = [0, 0]
    time.sleep(0.2)
    pad.down = START
    pad.until(lambda: pad.said[-1:] == [probe.items[1].ask])
    pad.down = None
    pad.until(record.exists)
    [row] = questionnaire.read_answers(record)
    assert (row["item"], row["answer"]) == ("goal", "90") and row["answer"] in probe.items[0].values()
    assert 0.5 < float(row["seconds"]) < 10
