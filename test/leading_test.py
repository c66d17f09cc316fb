"""Sessions led by other ways than words: by the motors alone, without any sound, and by a sound that lasts."""
import pathlib
import socket
import struct
import threading

import rosbag

from sessions import ROOT, Programs, eventually, summary

HALL = ["world:=busy", "seed:=9601", "limit:=150"]


def led(begun):
    """(summary, journal, kinds of the patterns that were felt) of a simulated person's trial."""
    begun.wait_until_ended(400)
    trial = next(begun.folder.glob("trial-*"), None)
    assert trial, begun.text()[-4000:]
    # A pattern stands apart from the pulses before it, so that of the arrival may begin when the record is over.
    with rosbag.Bag(str(trial / "trial.bag")) as bag:
        felt = {cue.kind for _, cue, _ in bag.read_messages("/navvi/cues") if cue.modality == cue.RUMBLE}
    return summary(begun.folder), (trial / "journal.csv").read_text(encoding="utf-8"), felt


def test_a_deafblind_person_reaches_the_goal_by_the_motors_alone(session):
    result, _, felt = led(session(*HALL, "operator/person/type:=deafblind", "feedback/lead:=hand", "speech:=false"))
    assert result["result"] == "reached" and result["safe_stop_count"] == "0", result
    assert result["cues_spoken"] == "0" and result["sounds_played"] in ("0", "n/a"), result
    assert {"begun", "arrived"} <= felt


def carry(path, over):
    """Carries the stick of operator_node to the virtual pad, and what its motors do back, as `/hand` and `/felt`."""
    import rospy
    from sensor_msgs.msg import Joy, JoyFeedback, JoyFeedbackArray
    rospy.init_node("hands", anonymous=True, disable_signals=True, disable_rostime=True)
    felt = rospy.Publisher("/felt", JoyFeedbackArray, queue_size=100)
    with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as link:
        link.bind(path + ".motors")
        link.settimeout(0.2)

        def push(hand):
            try:
                link.sendto(struct.pack("4f", *hand.axes[:2], hand.buttons[0], hand.buttons[6]), path)
            except OSError:
                pass  # the pad is not plugged in yet
        hand = rospy.Subscriber("/hand", Joy, push, tcp_nodelay=True)
        while not over.is_set():
            try:
                forces = struct.unpack("2f", link.recv(64))
            except socket.timeout:
                continue
            felt.publish([JoyFeedback(type=JoyFeedback.TYPE_RUMBLE, id=motor, intensity=force) for motor, force in enumerate(forces)])
        hand.unregister()


def test_all_that_a_deafblind_person_gets_is_the_rumble_of_a_pad(master, tmp_path, monkeypatch, plugged):
    pad, over = plugged["VIRTUAL_PAD"], threading.Event()
    for name in ("ROS_MASTER_URI", "ROS_IP"):
        monkeypatch.setenv(name, master[name])
    with Programs(master, tmp_path / "log") as parts:
        session = parts.start("roslaunch", ROOT / "launch/live.launch", *HALL, "operator:=pad", "rviz:=false", "speech:=false", "once:=true",
                              "feedback_parameters:={lead: hand}", f"out:={tmp_path}",
                              env={**master, **plugged, "ALSOFT_DRIVERS": "null"})
        carrying = threading.Thread(target=carry, args=(pad, over))
        carrying.start()
        try:
            assert eventually(pathlib.Path(pad).exists)  # the person's clock is the simulator's
            parts.start("rosrun", "navvi_people", "operator_node", "_person/type:=deafblind", "_person/lead:=hand", "joy:=/hand", "joy/set_feedback:=/felt",
                        "navvi/cues:=/nothing")
            session.wait(300)
        finally:
            over.set()
            carrying.join()
    result = summary(tmp_path)
    assert (result["result"], result["operator"], result["safe_stop_count"]) == ("reached", "pad", "0"), result
    assert result["cues_spoken"] == "0" and result["sounds_played"] in ("0", "n/a"), result


def test_a_person_is_led_by_a_sound_that_lasts_without_an_order_to_turn(session):
    result, journal, _ = led(session(*HALL, "operator/person/type:=typical", "feedback/lead:=flow"))
    assert result["result"] == "reached" and result["safe_stop_count"] == "0", result
    # Ticks that end a turn would mean that the sound was given up.
    assert not any(f"kind={order};" in journal for order in ("turn_now", "straight_then", "go_on", "turn_stop")), journal[-2000:]
