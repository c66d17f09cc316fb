"""A person's settings: changed while driving, heard and felt at once, kept in their file, true in the records of trials to come."""
import os
import subprocess
import time

import pytest
import rospy
import yaml
from navvi_msgs.msg import Cue

from hands import Hands
from navvi_study import questionnaire
from sessions import eventually

SELECT, START, UP, DOWN, LEFT, RIGHT = "end", "start", "previous", "next", "back", "choose"


class Session(Hands):
    """feedback_node, the pad of another driver with its arrow pad, and what is heard and felt."""

    def __init__(self, env, *words):
        self.said, self.answers, self.felt = [], [], []
        super().__init__()
        self.node = subprocess.Popen(["rosrun", "navvi_feedback", "feedback_node", "_input:=topic", "_speech:=false", "_listener:=topic", *words], env=env)
        self.wait(lambda: self.joy.get_num_connections() > 0 and self.cues.get_num_connections() > 0)
        time.sleep(0.5)  # hands off, as it sees them first: what is down from the beginning was not pressed

    def hear(self, cue):
        if cue.stage == Cue.STARTED:
            (self.said if cue.modality == Cue.SPEECH else self.felt).append(cue.text or cue.kind)
            if cue.kind.startswith("menu_") or cue.kind in ("setting", "setting_open", "setting_changed"):
                self.answers.append(cue.text)

    def wait(self, condition):
        assert eventually(condition, 20), self.said[-5:]

    def press(self, *buttons):
        """Short presses. Returns what the menu says to the last, whatever else is said."""
        for button in buttons:
            before = len(self.answers)
            super().press(button)
            self.wait(lambda: len(self.answers) > before)
            time.sleep(0.1)
        return self.answers[before]

    def tap(self, button, heard):
        super().press(button)
        self.wait(lambda: self.said[-1:] == [heard])
        time.sleep(0.1)

    def close(self):
        self.over = True
        self.holding.join()
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
    pad.wait(lambda: "settings of anna" in pad.said)
    assert pad.press(DOWN) == "settings"
    assert pad.press(RIGHT) == "speech rate, 220"
    assert pad.press(RIGHT) == "speech rate, 220, up for more, down for less"
    assert pad.press(UP) == "speech rate 240"
    pad.wait(lambda: saved(tmp_path) == {"speaker": {"rate": 240}})
    assert pad.press(LEFT, DOWN, DOWN) == "strength of vibration, 100 percent"
    assert pad.press(RIGHT, DOWN) == "strength of vibration 90 percent"
    pad.wait(lambda: "sample" in pad.felt)
    assert pad.press(LEFT, DOWN) == "amount of speech, normal"
    assert pad.press(RIGHT, UP) == "amount of speech full"
    pad.wait(lambda: saved(tmp_path) == {"speaker": {"rate": 240}, "haptics": {"strength": 0.9}, "cues": {"wording": {"verbosity": "full"}}})
    assert not any("for this session only" in said for said in pad.said)
    # What trials to come name in their record, and what the node takes if it must be started anew.
    assert rospy.get_param("/feedback_node/speaker/rate") == "240"
    pad = session("_person:=anna")
    assert pad.press(DOWN, RIGHT) == "speech rate, 240"


def test_who_has_no_file_is_told_that_settings_are_not_kept(session, tmp_path):
    pad = session()
    assert pad.press(DOWN, RIGHT, RIGHT, DOWN) == "speech rate 200"
    pad.wait(lambda: any("for this session only" in said for said in pad.said))
    assert list(tmp_path.iterdir()) == []


def test_a_setting_that_cannot_be_written_is_said_and_holds(session, tmp_path):
    (tmp_path / "people").write_text("a file where a folder should be")
    (tmp_path / "people").rename(tmp_path / "anna.yaml")
    pad = session("_person:=anna")
    assert pad.press(DOWN, RIGHT, RIGHT, DOWN) == "speech rate 200"
    pad.wait(lambda: "the settings cannot be saved" in pad.said)
    assert (tmp_path / "anna.yaml").read_text() == "a file where a folder should be"


def test_a_questionnaire_is_answered_by_the_pad_and_each_answer_is_saved_at_once(session, tmp_path):
    questions, record = tmp_path / "asked.yaml", tmp_path / "answers.csv"
    questions.write_text("items:\n"
                         "  - {name: hard, ask: How hard was it, values: [\"0\", \"50\", \"100\"], spoken: [\"0, easy\", \"50\", \"100, hard\"]}\n"
                         "  - {name: again, ask: Would you drive again, values: [\"no\", \"yes\"], spoken: [\"no\", \"yes\"]}\n")
    pad = session("_lesson:=questionnaire", f"_questions:={questions}", f"_record:={record}")

    def answers():
        return [line.split(",")[:2] for line in record.read_text().splitlines()[1:]] if record.exists() else []
    pad.wait(lambda: pad.said[-1:] == ["How hard was it"])
    pad.tap(UP, "50")
    pad.tap(UP, "100, hard")
    pad.tap(START, "Would you drive again")
    pad.wait(lambda: answers() == [["hard", "100"]])
    pad.tap(LEFT, "100, hard")
    pad.tap(DOWN, "50")
    pad.tap(START, "Would you drive again")
    pad.wait(lambda: answers() == [["hard", "50"]])
    pad.tap(SELECT, "arrow left to go back")
    assert answers() == [["hard", "50"], ["again", "declined"]]
    pad.tap(START, "thank you")
    assert pad.node.wait(20) == 0


def test_a_direction_is_pointed_at_with_the_stick_in_a_file_as_a_study_writes_it(session, tmp_path):
    asked, record = tmp_path / "asked.yaml", tmp_path / "answers.csv"
    probe = questionnaire.load(questionnaire.SHIPPED / "probe.yaml")
    asked.write_text(questionnaire.script(probe.items, probe.title, probe.intro))
    pad = session("_lesson:=questionnaire", f"_questions:={asked}", f"_record:={record}")
    pad.wait(lambda: pad.said[-1:] == [probe.items[0].ask])
    time.sleep(3.0)  # also the words
    pad.steer(1.0, 0.0)
    pad.wait(lambda: pad.said[-1:] == ["9 o'clock"])
    pad.steer(0.0, 0.0)
    time.sleep(0.2)
    pad.down = START
    pad.wait(lambda: pad.said[-1:] == [probe.items[1].ask])
    pad.down = None
    pad.wait(record.exists)
    [row] = questionnaire.read_answers(record)
    assert (row["item"], row["answer"]) == ("goal", "90") and row["answer"] in probe.items[0].values()
    assert 0.5 < float(row["seconds"]) < 10
