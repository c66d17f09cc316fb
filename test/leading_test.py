"""Sessions led by other ways than words: by the motors alone, without any sound, and by a sound that lasts."""
import csv
import pathlib
import socket
import struct
import subprocess
import threading
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent


def session(folder, *words):
    """(summary, journal, kinds of the patterns that were felt) of a simulated person's trial."""
    import rosbag
    run = subprocess.run([str(ROOT / "navvi"), "run", "operator:=simulated", "rviz:=false", "world:=busy", "seed:=9601", "limit:=150",
                          f"out:={folder}", *words], text=True, capture_output=True, timeout=400, check=False)
    trial = next(folder.glob("trial-*"), None)
    assert trial, run.stdout[-3000:] + run.stderr[-1000:]
    with open(trial / "summary.csv", newline="") as file:
        summary = next(csv.DictReader(file))
    # A pattern stands apart from the pulses before it, so that of the arrival may begin when the record is over.
    with rosbag.Bag(str(trial / "trial.bag")) as bag:
        felt = {cue.kind for _, cue, _ in bag.read_messages("/navvi/cues") if cue.modality == cue.RUMBLE}
    return summary, (trial / "journal.csv").read_text(encoding="utf-8"), felt


def test_a_deafblind_person_reaches_the_goal_by_the_motors_alone(tmp_path):
    summary, _, felt = session(tmp_path, "operator/person/type:=deafblind", "feedback/lead:=hand", "speech:=false")
    assert summary["result"] == "reached" and summary["safe_stop_count"] == "0", summary
    assert summary["cues_spoken"] == "0" and summary["sounds_played"] in ("0", "n/a"), summary
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


def test_all_that_a_deafblind_person_gets_is_the_rumble_of_a_pad(master, tmp_path, monkeypatch):
    library, pad, over = tmp_path / "pad.so", str(tmp_path / "pad"), threading.Event()
    flags = subprocess.check_output(["pkg-config", "--cflags", "sdl2"], text=True).split()
    subprocess.run(["g++", "-std=c++17", "-shared", "-fPIC", *flags, "-o", str(library), str(ROOT / "test/virtual_pad.cpp"), "-ldl", "-pthread"], check=True)
    for name in ("ROS_MASTER_URI", "ROS_IP"):
        if name in master:
            monkeypatch.setenv(name, master[name])
    env = {**master, "LD_PRELOAD": str(library), "VIRTUAL_PAD": pad, "ALSOFT_DRIVERS": "null"}
    with open(tmp_path / "log", "w") as log:
        launch = subprocess.Popen(["roslaunch", str(ROOT / "launch/live.launch"), "operator:=pad", "rviz:=false", "world:=busy", "seed:=9601", "limit:=150",
                                   "speech:=false", "once:=true", "feedback_parameters:={lead: hand}", f"out:={tmp_path}"], env=env, stdout=log, stderr=log)
        carrying = threading.Thread(target=carry, args=(pad, over))
        carrying.start()
        while launch.poll() is None and not pathlib.Path(pad).exists():
            time.sleep(0.1)  # the person's clock is the simulator's
        person = subprocess.Popen(["rosrun", "navvi_people", "operator_node", "_person/type:=deafblind", "_person/lead:=hand", "joy:=/hand",
                                   "joy/set_feedback:=/felt", "navvi/cues:=/nothing"], env=master, stdout=log, stderr=log)
        try:
            launch.wait(300)
        finally:
            over.set()
            person.terminate()
            launch.terminate()
            launch.wait(30)
            carrying.join()
    trial = next(tmp_path.glob("trial-*"), None)
    assert trial, (tmp_path / "log").read_text()[-3000:]
    with open(trial / "summary.csv", newline="") as file:
        summary = next(csv.DictReader(file))
    assert (summary["result"], summary["operator"], summary["safe_stop_count"]) == ("reached", "pad", "0"), summary
    assert summary["cues_spoken"] == "0" and summary["sounds_played"] in ("0", "n/a"), summary


def test_a_person_is_led_by_a_sound_that_lasts_without_an_order_to_turn(tmp_path):
    summary, journal, _ = session(tmp_path, "operator/person/type:=typical", "feedback/lead:=flow")
    assert summary["result"] == "reached" and summary["safe_stop_count"] == "0", summary
    # Ticks that end a turn would mean that the sound was given up.
    assert not any(f"kind={order};" in journal for order in ("turn_now", "straight_then", "go_on", "turn_stop")), journal[-2000:]
