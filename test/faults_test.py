"""Rows of doc/faults.md that need a whole session: programs are killed, and what is left is looked at from outside."""
import contextlib
import datetime
import os
import pathlib
import re
import shutil
import signal
import socket
import struct
import subprocess
import tempfile
import time

import pytest

from clock import Clock
from display import Display
from sessions import ROOT, WORLD, Programs, Session, eventually, rows_of, sound, summary, within


@pytest.fixture
def run(session):
    """A trial that has begun: run(words and environment)."""
    def begin(*words, **variables):
        begun = session(f"world:={WORLD}", "seed:=3", *words, **variables)
        begun.wait_until_begun()
        begun.sleep(2.0)
        return begun
    return begin


def test_L5_where_roslaunch_is_killed_nothing_lives_on_and_the_record_is_whole(run, record_property):
    begun = run()
    assert any("rosmaster" in line for line in begun.of_it().values())
    begun.kill("/roslaunch")
    within(record_property, "trial ended", end_of(begun), 2.0)
    begun.wait_until(lambda: not begun.of_it(), 20, "all programs of the session have ended")
    begun.wait_until_ended(30)
    assert ended(begun, "bag") == ("aborted", "launcher_lost", "ok")
    with socket.socket() as probe:
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        probe.bind(("127.0.0.1", int(begun.uri.strip("/").rsplit(":", 1)[1])))


@pytest.mark.parametrize("program, reason, bound", [("navvi_sim/sim_node", "simulator_lost", 2.0), ("/rosmaster", "master_lost", 5.0)],
                         ids=["S1_simulator", "M1_master"])
def test_a_crash_is_not_recorded_as_a_stop_by_hand(run, program, reason, bound, record_property):
    begun = run()
    begun.kill(program)
    within(record_property, "trial ended", end_of(begun), bound)
    begun.wait_until_ended(40)
    assert ended(begun, "bag") == ("aborted", reason, "ok"), begun.text()[-2000:]


def test_L5_where_the_command_is_killed_the_session_ends_with_it_and_the_record_is_whole(run):
    begun = run()
    begun.process.kill()
    begun.wait_until(lambda: not begun.of_it(), 30, "all programs of the session have ended")
    assert ended(begun, "bag")[::2] == ("aborted", "ok")


def end_of(begun):
    """s until its trial's end is in the journal."""
    begin = time.monotonic()
    begun.wait_until(lambda: any("TRIAL_END" in path.read_text() for path in begun.folder.glob("trial-*/journal.csv")), 30, "the trial has ended")
    return time.monotonic() - begin


def ended(begun, *more):
    """Result and reason of its trial, and further columns."""
    return tuple(summary(begun.folder)[name] for name in ("result", "reason", *more))


HEAR = "import rospy, navvi_msgs.msg as msg; rospy.init_node('ear', disable_rostime=True); " \
       "rospy.Subscriber('/navvi/cues', msg.Cue, lambda cue: print(cue.kind, flush=True)); rospy.spin()"


@pytest.fixture
def small_disk(tmp_path):
    disk = tmp_path / "disk"
    disk.mkdir()
    if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=80m", "none", disk], capture_output=True).returncode:
        pytest.skip("no file system may be mounted here")
    yield disk
    subprocess.run(["umount", "-l", disk], check=True)


def test_L1_a_disk_that_fills_in_a_trial_is_announced_and_the_record_is_whole(small_disk, tmp_path, record_property):
    with Session(small_disk, f"world:={WORLD}", "seed:=3", "speech:=true", **sound(tmp_path)) as begun:
        begun.wait_until_begun()
        with Programs(dict(os.environ, ROS_MASTER_URI=begun.uri, ROS_IP="127.0.0.1"), tmp_path / "heard") as ear:
            ear.start("/usr/bin/python3", "-c", HEAR)
            begun.wait_until(lambda: ear.log.read_text(), 30, "cues are heard")
            begun.sleep(2.0)
            with contextlib.suppress(OSError), open(small_disk / "film", "wb", buffering=0) as film:
                while True:
                    film.write(bytes(1 << 20))
            full = time.monotonic()
            begun.wait_until(lambda: "trial_disk_full" in ear.log.read_text(), 20, "it is announced")
            within(record_property, "announced", time.monotonic() - full, 1.0)
        begun.wait_until_ended(60)
        assert ended(begun) == ("invalid", "disk_full"), begun.text()[-2000:]
        folder = next(small_disk.glob("trial-*"))
        rows = rows_of(folder / "journal.csv")
        assert [int(row["seq"]) for row in rows] == list(range(1, len(rows) + 1))
        assert "TRIAL_END" in [row["type"] for row in rows] and rows_of(folder / "events.csv")


@pytest.mark.parametrize("how", [signal.SIGKILL, signal.SIGSTOP], ids=["killed", "halted"])
def test_R1_a_recorder_that_dies_or_is_halted_is_recorded_and_the_trial_goes_on(how, run, record_property):
    begun = run()
    journal = next(begun.folder.glob("trial-*/journal.csv"))
    begun.kill("/rosbag/record", how)
    lost = time.monotonic()
    begun.wait_until(lambda: "BAG_LOST" in journal.read_text(), 20, "the loss is recorded")
    within(record_property, "recorded", time.monotonic() - lost, 3.0)
    begun.wait_until_ended(240)
    assert ended(begun, "bag") == ("reached", "goal_reached", "bad"), begun.text()[-2000:]
    assert "state=bad" in journal.read_text()


@contextlib.contextmanager
def twin_of(begun, node):
    """Another program by the name of one of the session's nodes."""
    program = subprocess.Popen(["/usr/bin/python3", "-c", f"import rospy; rospy.init_node('{node}'); rospy.spin()"],
                               env=dict(os.environ, ROS_MASTER_URI=begun.uri, ROS_IP="127.0.0.1"))
    try:
        yield program
    finally:
        program.kill()
        program.wait()


@pytest.mark.parametrize("node, words", [("trial_node", []), ("sim_node", []), ("perception_node", ["sensing:=lidar"])])
def test_M2_a_second_node_of_a_name_ends_the_session_with_its_record_whole(node, words, run):
    begun = run(*words)
    with twin_of(begun, node):
        begun.wait_until_ended(40)
    assert begun.process.returncode == 1
    assert ended(begun) == ("aborted", "name_taken"), begun.text()[-2000:]
    assert f"error: Another node has taken the name /{node}, so this one ends." in begun.text()
    assert list(begun.folder.glob("trial-*/events.csv"))


@pytest.mark.parametrize("node", ["nav_node", "feedback_node"])
def test_M2_a_guide_whose_name_is_taken_comes_back_and_leads_on(node, run):
    begun = run()
    with twin_of(begun, node) as twin:
        begun.wait_until(lambda: twin.poll() is not None, 20, "the name is the guide's again")
    said = begun.wait_until_ended(180)
    assert f"error: Another node has taken the name /{node}, so this one ends." in said
    assert f"warning: {node} has ended with exit code 3.\n" in said and f"navvi: {node} is started anew.\n" in said, said[-2000:]
    assert ended(begun)[0] == "reached", said[-2000:]


def test_a_master_that_takes_longer_than_10_s_to_start_is_waited_for(tmp_path):
    slow = tmp_path / "rosmaster"
    slow.write_text('#!/bin/sh\nsleep 12\nexec /usr/bin/rosmaster "$@"\n')
    slow.chmod(0o755)
    (tmp_path / "one.launch").write_text('<launch><node name="one" pkg="rostopic" type="rostopic" args="list" required="true"/></launch>')
    words = [str(ROOT / "navvi_cli/shell/roslaunch"), "-p", "11399", str(tmp_path / "one.launch")]
    env = dict(os.environ, PATH=f"{tmp_path}:{os.environ['PATH']}", ROS_MASTER_URI="http://127.0.0.1:11399", ROS_IP="127.0.0.1")
    ended = subprocess.run(words, env=env, text=True, timeout=90, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    assert "process[one-2]: started" in ended.stdout, ended.stdout


def test_F6_a_killed_rviz_comes_back_and_ends_by_no_signal(run, tmp_path):
    display = Display("1920x1080")
    try:
        begun = run("limit:=300", "rviz:=true", DISPLAY=display.name, LIBGL_ALWAYS_SOFTWARE="1")

        def pictures():
            return [number for number, line in begun.of_it().items() if line.startswith("/usr/lib/rviz/rviz ")]
        begun.wait_until(pictures, 30, "RViz runs")
        killed = pictures()[0]
        time.sleep(5.0)
        os.kill(killed, signal.SIGKILL)
        begun.wait_until(lambda: pictures() and pictures() != [killed], 30, "RViz runs again")
        begun.wait_until(lambda: "warning: the program rviz was ended by signal 9." in begun.text(), 10, "the warning is printed")
        begun.wait_until(lambda: "[picture_back] the picture is back" in next(tmp_path.glob("session-*.log")).read_text(), 30, "the person is told")
        time.sleep(15.0)  # it draws the scene
        begun.end()
        assert begun.wait_until_ended(40).count("was ended by signal") == 1, begun.text()[-2000:]
    finally:
        display.close()


def test_a_stop_by_hand_is_recorded_as_one(run):
    begun = run()
    begun.end()
    begun.wait_until_ended(40)
    assert ended(begun) == ("aborted", "stopped_by_signal"), begun.text()[-2000:]


def driven(folder):
    """m that the robot has driven in the trial, by its journal."""
    rows = "".join(journal.read_text() for journal in folder.glob("trial-*/journal.csv"))
    return max(map(float, re.findall(r",PROGRESS,.*path_length=([0-9.]+)", rows)), default=0.0)


def test_S5_a_clock_that_is_set_by_an_hour_and_back_changes_no_motion_and_no_row(session, tmp_path):
    clock = Clock(tmp_path)
    begun = session(f"world:={WORLD}", "seed:=3", **clock.env)
    times = []
    for metres, hours in ((0.5, 1), (2.5, -1)):
        begun.wait_until(lambda: driven(tmp_path) > metres, 120, f"the robot has driven {metres} m")
        clock.set(3600.0 * hours)
        times.append(time.monotonic())
    begun.wait_until_ended(60)
    folder, result = next(tmp_path.glob("trial-*")), summary(tmp_path)
    rows = rows_of(folder / "journal.csv")
    stops = [row for row in rows if row["type"] == "SAFE_STOP" and any(-0.1 < float(row["mono_ns"]) * 1e-9 - at < 5.0 for at in times)]
    assert not stops, "a busy machine stops the wheels at other times, too"
    assert (result["result"], result["bag"], result["missed_messages"]) == ("reached", "ok", "0"), result
    assert [int(row["seq"]) for row in rows] == list(range(1, len(rows) + 1))
    calendar = [datetime.datetime.fromisoformat(text) for row in rows for text in re.findall("calendar=([0-9T:-]+)", row["fields"])]
    assert max(calendar) - min(calendar) > datetime.timedelta(hours=1.9), "the clock of trial_node was not set"
    onsets = [float(row["onset_s"]) for row in rows_of(folder / "events.csv")]
    assert onsets == sorted(onsets)


def launched(master, *words):
    """What roslaunch prints until it ends."""
    done = subprocess.run(["roslaunch", *map(str, words)], env=master, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=120)
    subprocess.run(["rosparam", "delete", "/"], env=master)  # later tests have the same master
    return done.stdout


def test_A1_a_program_that_does_not_stay_alive_ends_the_session(master, tmp_path, record_property):
    (tmp_path / "short.launch").write_text("<launch><node name='short' pkg='navvi_nav' type='nav_node' output='screen' respawn='true' "
                                           "launch-prefix='$(find navvi_safety)/scripts/respawned false'/></launch>")
    begun = time.monotonic()
    assert "short has ended 5 times within 60 s, so the session ends." in launched(master, tmp_path / "short.launch")
    within(record_property, "session ended", time.monotonic() - begun, 60.0)


def test_A1_an_argument_that_a_launch_file_lacks_ends_the_session(master, tmp_path):
    said = launched(master, "navvi", "robot.launch", "input:=topic", "rviz:=false", "rehersal:=true", f"out:={tmp_path}")
    assert "robot.launch has no argument \"rehersal\", so the session ends. Allowed is what" in said


@pytest.mark.parametrize("part", ["nav", "feedback", "trial"])
def test_A1_a_node_that_rejects_a_parameter_ends_the_session_before_any_trial(part, master, tmp_path):
    said = launched(master, ROOT / "launch/robot.launch", "input:=topic", "rviz:=false", f"{part}_parameters:={{nope: 1}}", f"out:={tmp_path}")
    assert said.count("\"nope\" is unknown") == 1, said
    assert "It is rejected, so the session ends." in said
    assert not list(tmp_path.glob("trial-*/summary.csv"))


def ports(folder, *how):
    """The ports that a session would take, as user `how`; the first line is printed while the lock is held."""
    script = "from navvi_cli.network import Network; print(Network().uri, flush=True); input()"
    return subprocess.Popen([*how, "/usr/bin/python3", "-c", script], cwd=ROOT, env=dict(os.environ, TMPDIR=str(folder)), text=True,
                            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)


def port_of(process):
    return int(process.stdout.readline().rsplit(":", 1)[1])


def release(process):
    process.communicate("\n")


NODES = [("navvi_sim", "sim_node"), ("navvi_nav", "nav_node"), ("navvi_feedback", "feedback_node"), ("navvi_study", "trial_node"),
         ("navvi_perception", "perception_node"), ("navvi_safety", "relay_node")]


def node(package, name, env, *words, before=""):
    program = subprocess.check_output(["catkin_find", "--first-only", "--libexec", package, name], text=True, env=env).strip()
    return subprocess.Popen(["bash", "-c", f"{before} exec {program} \"$@\"", "bash", *words], env=env, stdout=subprocess.PIPE,
                            stderr=subprocess.STDOUT, text=True)


@pytest.mark.parametrize("files", [8, 16, 40, 200])
@pytest.mark.parametrize("package, name", NODES, ids=lambda word: word)
def test_A3_a_node_that_may_open_few_files_ends_with_a_sentence(package, name, files, master):
    process = node(package, name, master, before=f"ulimit -n {files};")
    said = process.communicate(timeout=30)[0]
    assert process.returncode == 2, said
    assert f"Only {files} files may be open at once; allowed is 256 or more" in said


def test_A3_a_node_raises_a_limit_that_it_may_raise(master):
    process = node("navvi_nav", "nav_node", master, before="ulimit -Sn 16;")
    time.sleep(3)
    limits = pathlib.Path(f"/proc/{process.pid}/limits").read_text()
    process.send_signal(signal.SIGINT)
    said = process.communicate(timeout=30)[0]
    assert re.search(r"Max open files +256 ", limits), said


def too_much(name):
    """A topic of a node, and the largest message on it that says nothing wrong: some 20 MB and more in memory."""
    from geometry_msgs.msg import PoseStamped, TransformStamped
    from nav_msgs.msg import OccupancyGrid, Path
    from tf2_msgs.msg import TFMessage
    if name == "nav_node":
        grid = OccupancyGrid(data=[0] * 16_000_000)
        grid.header.frame_id, grid.info.width, grid.info.height, grid.info.resolution, grid.info.origin.orientation.w = "map", 4000, 4000, 0.05, 1.0
        return "/map", grid
    if name == "feedback_node":
        pose = PoseStamped()
        pose.pose.orientation.w = 1.0
        return "/navvi/path", Path(poses=[pose] * 100_000)
    transform = TransformStamped(child_frame_id="a_frame_that_nobody_has_ever_heard_of_before")
    transform.header.frame_id, transform.transform.rotation.w = "another_frame_that_nobody_has_ever_heard_of", 1.0
    return "/tf", TFMessage(transforms=[transform] * 150_000)


@pytest.mark.parametrize("megabytes", [12, 40])
@pytest.mark.parametrize("package, name", NODES[1:4], ids=lambda word: word)
def test_A2_a_node_without_memory_for_a_message_ends_with_a_sentence_or_goes_on(package, name, megabytes, master, tmp_path):
    """It is started anew then; what must not be is an end by a signal, in which nothing is said or kept."""
    import rospy
    process = node(package, name, master, *{"feedback_node": ["_input:=topic", "_speech:=false"], "trial_node": [f"_out:={tmp_path}"]}.get(name, []))
    try:
        os.environ.update(ROS_MASTER_URI=master["ROS_MASTER_URI"], ROS_IP="127.0.0.1")
        rospy.init_node("too_much", anonymous=True, disable_signals=True, disable_rostime=True)
        topic, message = too_much(name)
        publisher = rospy.Publisher(topic, type(message), queue_size=1, latch=True)
        assert eventually(publisher.get_num_connections, 20) and process.poll() is None
        time.sleep(1.0)
        used = int(re.search(r"VmSize:\s+(\d+)", pathlib.Path(f"/proc/{process.pid}/status").read_text()).group(1))
        subprocess.run(["prlimit", f"--pid={process.pid}", f"--as={(used << 10) + (megabytes << 20)}"], check=True)
        publisher.publish(message)
        time.sleep(5.0)
        ended = process.poll()
        if ended is None:
            process.send_signal(signal.SIGINT)
        said = process.communicate(timeout=30)[0]
        assert ended in (None, 3), said
        assert megabytes > 12 or "std::bad_alloc" in said, "it did not run out of memory"
        assert ended is None or "There is not enough memory for what came; this node ends." in said
    finally:
        if process.poll() is None:
            process.kill()


def test_A2_an_array_that_is_said_to_be_endless_takes_no_memory(master):
    """roscpp makes an array as long as a message says before it looks for its content."""
    import rospy
    from sensor_msgs.msg import Joy

    class Lie(Joy):
        def serialize(self, buffer):
            buffer.write(struct.pack("<IIIII", 0, 0, 0, 0, 0x7fffffff))  # 8 GB of axes
    process = node("navvi_feedback", "feedback_node", master, "_input:=topic", "_speech:=false")
    try:
        os.environ.update(ROS_MASTER_URI=master["ROS_MASTER_URI"], ROS_IP="127.0.0.1")
        rospy.init_node("too_much", anonymous=True, disable_signals=True, disable_rostime=True)
        publisher = rospy.Publisher("/joy", Lie, queue_size=1, latch=True)
        assert eventually(publisher.get_num_connections, 20)
        publisher.publish(Lie())
        time.sleep(3.0)
        assert process.poll() is None
        peak = int(re.search(r"VmHWM:\s+(\d+)", pathlib.Path(f"/proc/{process.pid}/status").read_text()).group(1))
        assert peak < 1 << 20, f"{peak} kB"
    finally:
        process.kill()


@pytest.fixture
def everybodys_folder():
    folder = pathlib.Path(tempfile.mkdtemp())
    folder.chmod(0o1777)
    yield folder
    shutil.rmtree(folder)


def test_M5_a_session_never_takes_a_port_that_is_locked_or_listened_on_by_anybody(everybodys_folder):
    first = ports(everybodys_folder)
    port = port_of(first)
    second = ports(everybodys_folder)
    assert port_of(second) > port, "of the same user, before a master listens"
    release(second)
    if os.getuid() == 0:
        other = ports(everybodys_folder, "setpriv", "--reuid=65534", "--clear-groups")
        assert port_of(other) > port, "of another user"
        release(other)
    release(first)
    with socket.socket() as listener:
        listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)  # a session may just have ended there
        listener.bind(("127.0.0.1", port))
        listener.listen()
        third = ports(everybodys_folder)
        assert port_of(third) > port, "nobody has the lock, and somebody listens"
        release(third)
    assert not list(everybodys_folder.iterdir()), "a lock stayed"
    (everybodys_folder / f"navvi-port-{port}.lock").symlink_to("/nonexistent/lock")
    fourth = ports(everybodys_folder)
    assert port_of(fourth) > port, "the lock cannot be opened"
    release(fourth)
