"""Rows of doc/faults.md that need a whole session: programs are killed, and what is left is looked at from outside."""
import csv
import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import tempfile
import threading
import time

import pytest

ROOT = pathlib.Path(__file__).resolve().parent.parent
WORLD = ROOT / "navvi_ws/src/navvi_sim/worlds/small_room.world"


class Run:
    """`./navvi run` with a simulated person, and the processes that belong to it."""

    def __init__(self, folder, *words):
        self.folder, self.output, self.uri = folder, [], ""
        env = {key: value for key, value in os.environ.items() if key not in ("DISPLAY", "WAYLAND_DISPLAY")}
        self.process = subprocess.Popen([str(ROOT / "navvi"), "run", "operator:=simulated", "rviz:=false", f"world:={WORLD}", "seed:=3",
                                         f"out:={folder}", *words], env=env, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                        start_new_session=True)
        self.reader = threading.Thread(target=self.read, daemon=True)
        self.reader.start()

    def read(self):
        for line in self.process.stdout:
            self.output.append(line)
            self.uri = "".join(re.findall(r"ROS_MASTER_URI=(http:[\w.:/]+)", line)) or self.uri

    def text(self):
        return "".join(self.output)

    def wait_for(self, condition, seconds, what):
        deadline = time.monotonic() + seconds
        while not condition():
            assert time.monotonic() < deadline, f"in {seconds} s it did not come true that {what}:\n{self.text()[-4000:]}"
            time.sleep(0.05)

    def begin(self):
        self.wait_for(lambda: "has begun" in self.text(), 300, "a trial begins")
        time.sleep(2.0)

    def processes(self):
        """Number and command line of each that was started with this session's master."""
        found = {}
        for folder in pathlib.Path("/proc").glob("[0-9]*"):
            try:
                if f"ROS_MASTER_URI={self.uri}".encode() in (folder / "environ").read_bytes().split(b"\0"):
                    found[int(folder.name)] = (folder / "cmdline").read_bytes().replace(b"\0", b" ").decode()
            except OSError:  # just ended, or another user's
                pass
        return {number: line for number, line in found.items() if line}

    def kill(self, program, how=signal.SIGKILL):
        os.kill(next(number for number, line in self.processes().items() if program in line.split(" __name:=")[0]), how)

    def summary(self):
        with open(next(self.folder.glob("trial-*/summary.csv")), newline="") as file:
            return next(csv.DictReader(file))

    def close(self):
        if self.process.poll() is None:
            os.killpg(self.process.pid, signal.SIGINT)
        self.process.wait(30)


@pytest.fixture
def run(tmp_path):
    session = Run(tmp_path)
    yield session
    session.close()


def test_L5_where_roslaunch_is_killed_nothing_lives_on_and_the_record_is_whole(run):
    run.begin()
    assert any("rosmaster" in line for line in run.processes().values())
    run.kill("/roslaunch")
    run.wait_for(lambda: not run.processes(), 20, "all programs of the session have ended")
    run.process.wait(30)
    assert run.summary()["result"] == "aborted" and run.summary()["bag"] == "ok", run.summary()
    with socket.socket() as probe:
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        probe.bind(("127.0.0.1", int(run.uri.strip("/").rsplit(":", 1)[1])))


@pytest.mark.parametrize("program, reason", [("navvi_sim/sim_node", "simulator_lost"), ("/rosmaster", "master_lost")],
                         ids=["S1_simulator", "M1_master"])
def test_a_crash_is_not_recorded_as_a_stop_by_hand(run, program, reason):
    run.begin()
    run.kill(program)
    run.process.wait(40)
    assert (run.summary()["result"], run.summary()["reason"]) == ("aborted", reason), run.text()[-2000:]
    assert run.summary()["bag"] == "ok"


def test_a_stop_by_hand_is_recorded_as_one(run):
    run.begin()
    os.killpg(run.process.pid, signal.SIGINT)
    run.process.wait(40)
    assert (run.summary()["result"], run.summary()["reason"]) == ("aborted", "stopped_by_signal"), run.text()[-2000:]


def test_A1_a_guide_that_does_not_stay_alive_ends_the_session_before_any_trial(master, tmp_path):
    begun = time.monotonic()
    launch = subprocess.run(["roslaunch", str(ROOT / "launch/live.launch"), "operator:=topic", f"world:={WORLD}", "rviz:=false",
                             "feedback_parameters:={nope: 1}", f"out:={tmp_path}"],
                            env=master, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=120)
    assert time.monotonic() - begun < 60
    assert "feedback_node has ended 5 times within 60 s, so the session ends." in launch.stdout
    assert "No trial yet: waiting for a report of feedback_node" in launch.stdout
    assert not list(tmp_path.glob("trial-*/summary.csv"))


def ports(folder, *how):
    """The ports that a session would take, as user `how`; the first line is printed while the lock is held."""
    script = (f"set -euo pipefail; fail() {{ echo \"$1\"; exit 2; }}; source {ROOT}/commands/parts/session.bash; devel={folder}; "
              "loopback_network 2>/dev/null; unset LD_PRELOAD; echo $ROS_MASTER_URI; read -r _")
    return subprocess.Popen([*how, "bash", "-c", script], env=dict(os.environ, TMPDIR=str(folder)), text=True,
                            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)


def port_of(process):
    return int(process.stdout.readline().rsplit(":", 1)[1])


def release(process):
    process.communicate("\n")


@pytest.fixture
def everybodys_folder():
    folder = pathlib.Path(tempfile.mkdtemp())
    folder.chmod(0o1777)
    yield folder
    shutil.rmtree(folder)


def test_a_session_never_takes_a_port_that_is_locked_or_listened_on_by_anybody(everybodys_folder):
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
        listener.bind(("127.0.0.1", port))
        listener.listen()
        third = ports(everybodys_folder)
        assert port_of(third) > port, "nobody has the lock, and somebody listens"
        release(third)
    (everybodys_folder / f"navvi-port-{port}.lock").unlink()
    (everybodys_folder / f"navvi-port-{port}.lock").symlink_to("/nonexistent/lock")
    fourth = ports(everybodys_folder)
    assert port_of(fourth) > port, "the lock cannot be opened"
    release(fourth)
