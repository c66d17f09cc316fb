"""The glossary, the tutorial and the calibration, by ear and hand alone: what is pressed depends on what is said, sounds and is felt."""
import re
import subprocess

import pytest
import yaml

import hearing
from sessions import DARK, ROOT, Programs, rows_of, sound

pytestmark = pytest.mark.accessibility
PHRASES = ROOT / "navvi_ws/src/navvi_feedback/config/phrases/en.yaml"


def give(env, folder, lesson, launch, *words, **more):
    """What the person heard and pressed, line by line, and the kinds of it."""
    # Of the last test's parameters the master of this module would keep what is not given now.
    subprocess.run(["rosparam", "delete", "/feedback_node"], env=env, stderr=subprocess.DEVNULL)
    with Programs(dict(env, **more), folder / "log") as programs:
        session = programs.launch(launch, f"lesson:={lesson.split('_')[0]}", *words)
        told = programs.person("pupil.py", lesson, *(["keys"] if "DISPLAY" in env else []), seconds=600)
        session.wait(60)
    print(told)
    lines = told.splitlines()
    return lines[:-1], lines[-1]


@pytest.fixture
def env(master):
    return {key: value for key, value in master.items() if key in DARK or key.startswith("ROS_")}


def test_the_glossary_is_understood_and_ended_at_will(env, tmp_path):
    _, kinds = give(env, tmp_path, "glossary_begins", "lesson.launch", "operator:=topic", **sound(tmp_path))
    assert "'glossary_end'" in kinds
    begin = tmp_path / "begin.wav"
    subprocess.run(["sox", "--ignore-length", str(tmp_path / "sound.wav"), str(begin), "trim", "0", "20"], check=True)
    heard = " ".join(" ".join(words) for _, words in hearing.transcribe(begin, told=True))
    for words in "here is each signal", "to hear this one again", "on the left":
        assert words in heard, heard


def test_the_glossary_is_given_in_spanish_by_keys_and_without_motors(desktop, tmp_path):
    lines, kinds = give(desktop, tmp_path, "glossary_begins", "lesson.launch", "operator:=keyboard",
                        "feedback_parameters:={language: es, listener: topic}", "speech:=false")
    assert "'glossary_no_motors'" in kinds and "'glossary_end'" in kinds and "'glossary_near_left'" not in kinds
    spanish = yaml.safe_load(PHRASES.with_name("es.yaml").read_text())["lessons"]
    assert lines[-1].endswith(spanish["glossary_end"]), lines
    assert any("página abajo para la siguiente" in line for line in lines), "the keys are named"


def test_the_glossary_is_given_from_the_first_signal_to_the_last(env, tmp_path):
    _, kinds = give(env, tmp_path, "glossary", "lesson.launch", "operator:=topic", "feedback_parameters:={speaker: {rate: 449}}", **sound(tmp_path))
    texts = yaml.safe_load(PHRASES.read_text())["lessons"]
    missing = [key for key in texts if key.startswith("glossary_") and not key.endswith("_keys") and f"'{key}'" not in kinds]
    # Off in a session unless wanted; there are motors.
    assert sorted(missing) == ["glossary_no_motors", "glossary_sound_beacon"]
    for signal in "turn", "turn_stop", "worker_close", "hit_shelf", "stuck", "rerouted", "obstacle_stop", "make_room", "go_on":
        assert f"'{signal}'" in kinds


@pytest.mark.parametrize("hands", ["auto", "keyboard"])
def test_the_tutorial_is_passed_by_doing_and_practises_what_went_wrong(request, env, tmp_path, hands):
    record = tmp_path / "tutorial.csv"
    env = env if hands == "auto" else request.getfixturevalue("desktop")
    lines, kinds = give(env, tmp_path, "tutorial", "live.launch", f"operator:={hands}", "world:=training", "start:=-6.5,-5,1.57", "goal:=0.2,-1",
                        "speech:=false", "rviz:=false", f"out:={tmp_path}", "once:=false", "limit:=300",
                        f"feedback_parameters:={{listener: topic, record: {record}}}")
    rows = [row for row in rows_of(record) if row["step"] != "by_sound"]  # which is taught where there is a sound device
    assert [row["passed"] for row in rows] == ["yes"] * 16
    tries = {row["step"]: int(row["tries"]) for row in rows[:-1]}
    assert tries["turn_right"] > 1 and tries["ahead"] == 1
    assert (rows[-1]["step"], rows[-1]["practice"]) == ("turn_right", "yes")
    assert "tutorial_wrong_too_far" in kinds and "tutorial_done" in kinds
    for word in "wait", "go_on", "back_away", "make_room":
        assert f"'tutorial_said_{word}'" in kinds
    summaries = [path.read_text() for path in tmp_path.glob("trial-*/summary.csv")]
    assert len(summaries) == 1 and "goal_reached" in summaries[0]
    # Words of the guide stand back, but for those to the goal.
    said = [re.sub(r"^ *[0-9.]+ +", "", line) for line in lines]
    assert not {"press start to begin", "choose a goal", "welcome, waiting for a goal"} & set(said)


def test_a_calibration_is_saved_for_the_person_and_the_pad(env, tmp_path):
    give(env, tmp_path, "calibrate", "lesson.launch", "operator:=topic", "feedback_parameters:={listener: topic, person: anna}", "speech:=false",
         NAVVI_PEOPLE=str(tmp_path))
    saved = yaml.safe_load((tmp_path / "anna.yaml").read_text())
    name, left, right, gain = saved["haptics"]["pads"][0].split()
    assert 0.08 < float(left) < 0.17 and 0.16 < float(right) < 0.33 and 0.4 < float(gain) < 0.56
    assert 0.35 < saved["sounds"]["turn"]["stopping_delay"] < 0.9


def test_a_calibration_by_keys_finds_how_early_a_turn_is_to_end(desktop, tmp_path):
    _, kinds = give(desktop, tmp_path, "calibrate", "lesson.launch", "operator:=keyboard", "feedback_parameters:={listener: topic, person: anna}", "speech:=false",
                    NAVVI_PEOPLE=str(tmp_path))
    assert "'calibrate_no_motors'" in kinds and "'tutorial_keys'" in kinds
    saved = yaml.safe_load((tmp_path / "anna.yaml").read_text())
    assert "haptics" not in saved and 0.35 < saved["sounds"]["turn"]["stopping_delay"] < 0.9
