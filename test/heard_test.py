"""The cues tell what can have been heard: by a sound device, or by whoever reads them."""
import contextlib
import os
import subprocess

import rospy
from navvi_msgs.msg import Cue, TrialState

from sessions import ROOT, Programs, eventually, sound

QUEUED, STARTED, DROPPED = "0", "1", "4"


def stages(master, folder, device, *words):
    """The stages of the words that feedback_node has when nothing comes from a robot for 10 s."""
    with Programs(dict(master, **sound(folder, device))) as programs:
        echo = programs.start("rostopic", "echo", "-p", "/navvi/cues", stdout=subprocess.PIPE, text=True)
        node = programs.start("rosrun", "navvi_feedback", "feedback_node", "_input:=topic", *words)
        with contextlib.suppress(subprocess.TimeoutExpired):
            node.wait(16)
        node.terminate()
        echo.terminate()
        said = echo.communicate()[0]
    lines = [line.split(",") for line in said.splitlines()]
    names = lines[0] if lines else []
    rows = [dict(zip(names, line)) for line in lines[1:]]
    return [row["field.stage"] for row in rows if row["field.modality"] == "0"]


def test_words_are_started_where_there_is_a_device(master, tmp_path):
    assert STARTED in stages(master, tmp_path, "wave")


def test_F1_words_without_a_device_were_dropped(master, tmp_path):
    found = stages(master, tmp_path, "none")
    assert set(found) == {QUEUED, DROPPED}


def test_there_are_no_words_where_sound_is_off(master, tmp_path):
    assert stages(master, tmp_path, "wave", "_speech:=false") == []


def test_who_reads_them_hears_without_a_device(master, tmp_path):
    assert STARTED in stages(master, tmp_path, "none", "_speech:=false", "_listener:=topic")


def test_who_drives_hears_that_the_session_ends(master, tmp_path):
    os.environ.update(ROS_MASTER_URI=master["ROS_MASTER_URI"], ROS_IP=master["ROS_IP"])
    rospy.init_node("heard_test", disable_rostime=True, disable_signals=True)
    said = []
    rospy.Subscriber("/navvi/cues", Cue, lambda cue: cue.modality == Cue.SPEECH and said.append((cue.kind, cue.stage)))
    trial = rospy.Publisher("/navvi/trial_state", TrialState, queue_size=1, latch=True)

    def until(kind, stage):
        assert eventually(lambda: (kind, stage) in said), said
    with Programs(dict(master, **sound(tmp_path))) as programs:
        programs.start("rosrun", "navvi_feedback", "feedback_node", "_input:=topic")
        trial.publish(TrialState(state=TrialState.READY))
        until("press_start", Cue.QUEUED)
        trial.publish(TrialState(state=TrialState.RUNNING))
        until("trial_begins", Cue.QUEUED)
    until("trial_over", Cue.ENDED)
    assert ("trial_over", Cue.STARTED) in said


def test_the_stopwatch_of_what_a_person_waits_for_sees_each_chain():
    bench = ROOT / "navvi_ws/src/navvi_study/bench/latency_bench"
    run = subprocess.run([bench, "--rounds=1"], capture_output=True, text=True, timeout=200)
    assert run.returncode == 0 and "never seen" not in run.stdout, run.stdout + run.stderr


def test_T2_a_guide_without_a_clock_reports_so(master, tmp_path):
    with Programs(master, tmp_path / "log") as programs:
        programs.run("rosparam", "set", "/use_sim_time", "true")
        programs.start("rosrun", "navvi_feedback", "feedback_node", "_input:=topic", "_speech:=false")
        assert eventually(lambda: "There is no /clock yet." in programs.log.read_text(), 10)
        programs.run("rosparam", "delete", "/use_sim_time")
