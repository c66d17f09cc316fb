"""`./navvi watch`: a session in plain lines, on a terminal and through speech-dispatcher."""
import itertools
import os
import pty
import re
import shutil
import signal
import subprocess
import sys
import time

import pytest
import rosbag
import rospy
from navvi_msgs.msg import Contact, Cue, DriveState, Guidance, TrialEvent, TrialState

from sessions import DARK, ROOT, Command, Programs, eventually, navvi, rows_of, sourced
from navvi_study import watch

pytestmark = pytest.mark.accessibility


def at(seconds, message):
    message.header.stamp = rospy.Time.from_sec(seconds)
    return message


def guidance(seconds, state, distance=20.0, **more):
    return at(seconds, Guidance(state=state, goal_distance=distance, waypoint_distance=5.0, waypoint_angle=1.05, **more))


def said(seconds, text, **more):
    return at(seconds, Cue(stage=Cue.STARTED, modality=Cue.SPEECH, kind="k", text=text, **more))


def contact(seconds, seq, x, y):
    message = at(seconds, Contact(seq=seq, thing_class="pallet_robot", speed=0.41))
    message.point.x, message.point.y, message.robot.orientation.w = x, y, 1.0
    return message


SESSION = [
    ("/navvi/cues", said(98, "welcome")),
    ("/navvi/trial_state", at(99.6, TrialState(state=TrialState.READY))),
    ("/navvi/events", at(100, TrialEvent(type="TRIAL_START", fields="world=busy;seed=3;operator=pad"))),
    ("/navvi/guidance", guidance(100.2, Guidance.FOLLOWING)),
    ("/navvi/guidance", guidance(100.4, Guidance.FOLLOWING)),
    ("/navvi/cues", said(101, "drive straight, 5 meters")),
    ("/navvi/cues", said(102, "drive straight, 5 meters")),
    ("/navvi/cues", at(103, Cue(stage=Cue.STARTED, modality=Cue.RUMBLE, kind="rumble", left=0.5))),
    ("/navvi/cues", at(104, Cue(stage=Cue.STARTED, modality=Cue.RUMBLE, kind="hit_hard", left=1.0))),
    ("/navvi/contacts", contact(104.1, 1, 0.1, 0.6)),
    ("/navvi/drive_state", at(105, DriveState(state=DriveState.STOPPED, reason=DriveState.COMMAND_LOST))),
    ("/navvi/guidance", guidance(120, Guidance.FOLLOWING, 12.0)),
    ("/navvi/guidance", guidance(121, Guidance.BLOCKED, 12.0, blocked_by="forklift")),
    ("/navvi/guidance", guidance(125, Guidance.FOLLOWING, 9.0, ends_short=True)),
    ("/navvi/trial_state", at(129.9, TrialState(state=TrialState.PREPARING))),
    ("/navvi/events", at(130, TrialEvent(type="TRIAL_END", fields="result=aborted;reason=stopped_by_signal"))),
    ("/navvi/trial_state", at(130.1, TrialState(state=TrialState.PREPARING))),
    ("/navvi/guidance", guidance(131, Guidance.FOLLOWING, 40.0)),
    ("/navvi/cues", said(132, "the trial is over")),
]
LINES = [
    "The trial begins: world busy, seed 3, operator pad. 0 s.",
    "Follow the path, 20 m to go. 0 s.",
    "Said: drive straight, 5 meters. 1 s.",
    "Felt: hit hard, on the left. 4 s.",
    "Hit: pallet robot on the left, at 0.4 m/s, contact 1. 4 s.",
    "The robot is stopped: no command came from the stick; let go of the stick. 5 s.",
    "12 m to go, the next corner in 5 m at 2 o'clock. 20 s.",
    "Wait, the way is blocked, forklift, 12 m to go. 21 s.",
    "The way is free, wait until you are led on, 9 m to where the map ends. 25 s.",
    "The trial has ended: aborted, stopped by signal. 30 s.",
    "Said: the trial is over. 32 s.",
]


def test_nothing_that_the_guide_knows_is_told_in_the_picture_alone():
    """Every state of guidance, of the wheels and of the trial that asks something of the person has its sentence."""
    def constants(message, first, last):
        names = [name for name in vars(message) if name.isupper()]
        return {getattr(message, name) for name in names[names.index(first):names.index(last) + 1]}
    assert set(watch.STATES) == constants(Guidance, "NO_GOAL", "MAKE_ROOM")
    assert set(watch.STOPS) == constants(DriveState, "COMMAND_LOST", "EMERGENCY_STOP")
    assert set(watch.WAITING) == constants(TrialState, "PREPARING", "READY")


@pytest.fixture
def trial(tmp_path):
    with rosbag.Bag(str(tmp_path / "trial.bag"), "w") as bag:
        for topic, message in SESSION:
            bag.write(topic, message, message.header.stamp)
    return tmp_path


def watched(*words, **variables):
    """Exit code and text."""
    watching = Command("watch", *words, **variables)
    text = watching.wait_until_ended()
    return watching.process.returncode, text


def test_a_recorded_trial_is_told_in_lines_of_which_each_says_something_new(trial):
    code, text = watched(trial, "pace:=0")
    lines = [line for line in text.splitlines() if not line.startswith(("navvi: building", "navvi: waiting for another build"))]
    assert code == 0
    assert lines == [*LINES, "The trial's record ends here."]
    assert all(re.fullmatch(r"[ -~]+", line) for line in lines)


def test_of_a_bag_that_lost_its_beginning_the_rest_is_told(tmp_path):
    with rosbag.Bag(str(tmp_path / "trial.bag"), "w") as bag:
        for topic, message in SESSION[4:6]:
            bag.write(topic, message, message.header.stamp)
    lines = watched(tmp_path, "pace:=0")[1].splitlines()
    assert lines[-4:] == ["This bag lacks the beginning of the trial.", "Follow the path, 20 m to go. 0 s.", "Said: drive straight, 5 meters. 1 s.",
                          "The trial's record ends here."]


@pytest.fixture(scope="module")
def record(tmp_path_factory):
    """The folder of a whole trial."""
    out = tmp_path_factory.mktemp("record")
    done = sourced(ROOT / "navvi_ws/devel/lib/navvi_study/trials_bench", "--world=training", "--seeds=1", "--records=all", f"--out={out}")
    assert done.returncode == 0, done.stderr
    return out / "trial-training-1"


@pytest.mark.parametrize("damage", [
    lambda data: data[:len(data) // 2], lambda data: data[:-10], lambda data: data[:100], lambda data: b"",
    lambda data: data[:-300] + bytes(300), lambda data: data[:4117] + bytes(200) + data[4317:],
], ids=["half", "tail", "head", "empty", "zeros_at_the_end", "zeros_within"])
def test_R2_a_damaged_bag_ends_in_a_sentence(damage, record, tmp_path):
    bag = shutil.copytree(record, tmp_path / "trial") / "trial.bag"
    bag.write_bytes(damage(bag.read_bytes()))
    result = subprocess.run([sys.executable, watch.__file__, "0", "false", str(bag.parent)], capture_output=True, text=True, timeout=60)
    assert result.returncode == 2, result.stdout + result.stderr
    assert len(result.stderr.splitlines()) == 1 and f"{bag} is damaged and cannot be read" in result.stderr, result.stderr
    result = navvi("replay", bag.parent, "rviz:=false", "speech:=false")
    assert result.returncode == 2, result.stdout + result.stderr
    assert "Nothing can be counted again from the bag" in result.stderr and "this trial cannot be replayed" in result.stderr, result.stderr


def lines_of(*words):
    """(s, text) of each line that is not the command's own."""
    watching = Command("watch", *words)
    watching.wait_until_ended()
    return [(at, line) for at, line in zip(watching.times, watching.output) if not line.startswith("navvi:")]


def test_no_line_comes_before_the_last_one_can_have_been_read(trial):
    times = lines_of(trial, "pace:=600")
    for (before, line), (after, _) in zip(times, times[1:-1]):
        assert after - before > 0.9 * max(0.7, 0.1 * len(line.split())), line


def test_a_record_comes_at_once_where_no_terminal_reads_it_and_by_and_by_in_one(trial):
    times = [at for at, _ in lines_of(trial)][:len(LINES)]
    assert len(times) == len(LINES)
    assert times[-1] - times[0] < 0.1 * 0.7 * len(LINES), "no line comes sooner than 0.7 s after the last one where they are paced"

    terminal, its_end = pty.openpty()
    with Programs(DARK) as programs, os.fdopen(terminal) as lines:
        programs.start(ROOT / "navvi", "watch", trial, stdout=its_end, stderr=its_end)
        times = [time.monotonic() for _ in itertools.islice((line for line in lines if not line.startswith("navvi:")), 3)]
        os.close(its_end)
    assert times[-1] - times[0] > 0.9 * 2 * 0.7


def test_who_reads_the_beginning_alone_gets_no_error(trial):
    result = subprocess.run(["bash", "-c", f"'{ROOT}/navvi' watch '{trial}' pace:=0 | head -n 1"], capture_output=True, text=True, timeout=300)
    assert result.stdout == LINES[0] + "\n" and "Error" not in result.stderr


def test_of_much_at_once_the_newest_state_and_what_weighs_most_is_shown_and_the_rest_counted():
    pacer = watch.Pacer(180)
    pacer.offer(watch.Line("Said", 2, "first"))
    assert pacer.next(0.0) == "first"
    for number in range(5):
        pacer.offer(watch.Line("Said", 2, f"cue {number}"))
        pacer.offer(watch.Line("state", 1, f"state {number}"))
    pacer.offer(watch.Line("contact", 0, "hit"))
    assert pacer.next(0.1) is None, "the first is still being read"
    shown, now = [], 1.0
    while pacer.waiting:
        shown.append(pacer.next(now))
        now += 10.0
    assert shown == ["hit 3 lines left out.", "state 4", "cue 3", "cue 4"]


def test_no_word_that_keeps_the_person_safe_is_left_out_and_of_the_wheels_the_newest_stands():
    pacer = watch.Pacer(180)
    pacer.offer(watch.Line("wheels", 0, "stopped"))
    for number in range(6):
        pacer.offer(watch.Line("Said", 1, f"wait {number}"))
    pacer.offer(watch.Line("wheels", 1, "can be driven"))
    assert [line.text for line in pacer.waiting] == [*(f"wait {number}" for number in range(6)), "can be driven"]


def test_of_an_emergency_stop_what_is_told_holds_until_the_wheels_are_free():
    teller = watch.Teller()
    stopped, runs = DriveState(state=DriveState.STOPPED, reason=DriveState.EMERGENCY_STOP), DriveState(state=DriveState.RUNNING)
    told = [line.text for time, state in ((1, stopped), (2, stopped), (9, runs)) for line in teller.lines(at(time, state))]
    assert told == ["The robot is stopped: the emergency stop was pressed, release it; let go of the stick. 0 s.", "The robot can be driven. 8 s."]


def test_a_pattern_that_is_felt_again_is_told_again_and_of_a_sound_its_side():
    teller = watch.Teller()
    halt = Cue(stage=Cue.STARTED, modality=Cue.RUMBLE, kind="halt", left=0.5, right=0.5)
    tick = Cue(stage=Cue.STARTED, modality=Cue.SOUND, kind="turn", left=0.9, right=0.1)
    told = [line.text for time, cue in ((1, halt), (1.5, halt), (9, halt), (10, tick)) for line in teller.lines(at(time, cue))]
    assert told == ["Felt: halt. 0 s.", "Felt: halt. 8 s.", "Played: turn, on the left. 9 s."]


@pytest.fixture
def spoken(tmp_path):
    """A speech-dispatcher of the test's own, whose synthesizer takes half a second and writes down what it was given."""
    home = tmp_path / "speech"
    (home / "modules").mkdir(parents=True)
    (home / "speechd.conf").write_text('AudioOutputMethod "libao"\nAddModule "file" "sd_generic" "file.conf"\nDefaultModule file\n')
    (home / "modules/file.conf").write_text(
        f"GenericExecuteSynth \"printf '%s ' \\'$DATA\\' >> {home}/spoken; date +%s.%N >> {home}/times; sleep 0.5\"\n"
        'GenericLanguage "en" "en" "utf-8"\nAddVoice "en" "MALE1" "en"\n')
    with Programs(None) as programs:
        programs.start("speech-dispatcher", "-s", "-c", "unix_socket", "-S", home / "socket", "-C", home, "-L", home, "-P", home / "pid", "-t", "0")
        assert eventually((home / "socket").exists, 10), "speech-dispatcher did not start"
        yield home


def test_each_line_is_spoken_and_the_next_waits_until_it_was(trial, spoken):
    code, text = watched(trial, "pace:=0", "speech:=true", SPEECHD_ADDRESS=f"unix_socket:{spoken}/socket")
    assert code == 0, text
    assert " ".join((spoken / "spoken").read_text().split()) == " ".join(LINES)
    times = [float(line) for line in (spoken / "times").read_text().split()]
    assert all(after - before > 0.45 for before, after in zip(times, times[1:]))


@pytest.mark.parametrize("how", [signal.SIGKILL, signal.SIGSTOP])
def test_lines_go_on_without_speech_where_speech_dispatcher_ends_or_halts(how, trial, spoken):
    watching = Command("watch", trial, "pace:=0", "speech:=true", SPEECHD_ADDRESS=f"unix_socket:{spoken}/socket", SPEECHD_CMD="/nonexistent")
    assert eventually((spoken / "spoken").exists, 60)
    process = int((spoken / "pid/speech-dispatcher.pid" if (spoken / "pid").is_dir() else spoken / "pid").read_text())
    os.kill(process, how)
    try:
        lines = watching.wait_until_ended(60).splitlines()
    finally:
        os.kill(process, signal.SIGCONT)
    assert [line for line in lines if line in LINES] == LINES and lines[-1] == "The trial's record ends here."
    assert lines.count("speech-dispatcher does not answer; the lines go on without speech.") == 1, lines


def test_without_speech_dispatcher_that_is_said(trial, tmp_path):
    code, text = watched(trial, "speech:=true", SPEECHD_ADDRESS=f"unix_socket:{tmp_path}/none", SPEECHD_CMD="/nonexistent")
    assert code == 2 and "speech-dispatcher cannot be used" in text and "speech:=false" in text


def test_a_running_session_is_found_and_told_to_its_end(session, tmp_path):
    # Where watch looks for sessions; another may run beside the test.
    session("world:=training", "limit:=25", TMPDIR=str(tmp_path)).wait_until_begun()
    text = watched(TMPDIR=str(tmp_path))[1]
    assert "Follow the path" in text and "Said: " in text, text
    assert "The trial has ended: timeout" in text and text.endswith("The session has ended.\n"), text
    assert [*tmp_path.glob("session-*/**/roslaunch-*.log")], "the logs of ROS lie with the record"


def test_in_a_session_for_its_voice_words_lead_and_nothing_sounds(session, tmp_path):
    line = re.search(r"^\./navvi run (.*)", navvi("watch", "--help").stdout.replace("\\\n", ""), re.M)[1]
    words = line.replace("speech:=false ", "").split()  # without which the simulated person hears nothing
    session("world:=training", "limit:=25", *words).wait_until_ended()
    [journal] = tmp_path.glob("trial-*/journal.csv")
    cues = [row["fields"] for row in rows_of(journal) if row["type"] == "CUE"]
    assert [cue for cue in cues if "modality=speech" in cue] and not [cue for cue in cues if "modality=sound" in cue]


def test_where_no_session_runs_that_is_said(tmp_path):
    code, text = watched(TMPDIR=str(tmp_path))
    assert code == 2 and "no session runs on this machine" in text
