"""Sessions for tests, in verbs: begin one, wait until something is true of it, let a person drive, press and hear, end it."""
import csv
import importlib.machinery
import importlib.util
import os
import pathlib
import re
import signal
import statistics
import subprocess
import sys
import threading
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT), *map(str, (ROOT / "navvi_ws/src").glob("*/python"))]  # what all tests import, as conftest.py reads this file first
sys.dont_write_bytecode = True  # as the command
WORLD = ROOT / "navvi_ws/src/navvi_sim/worlds/small_room.world"
DARK = {key: value for key, value in os.environ.items() if key not in ("DISPLAY", "WAYLAND_DISPLAY")}  # without a screen


def eventually(condition, seconds=60):
    """What the condition gives at last; empty where the time is over."""
    deadline = time.monotonic() + seconds
    while not (found := condition()) and time.monotonic() < deadline:
        time.sleep(0.02)
    return found


def crowd():
    """Threads that run or wait for a processor, but this one, for each processor: now, not in the last minute as the load has it."""
    running = []
    for _ in range(25):
        running.append(int(pathlib.Path("/proc/loadavg").read_text().split()[3].partition("/")[0]) - 1)
        time.sleep(0.02)
    return statistics.mean(running) / os.cpu_count()


def within(record_property, what, seconds, bound):
    """A bound of doc/faults.md on the wall clock in s, doubled where more runs than there are processors. `./navvi test faults` prints the time."""
    record_property(what, f"{1000 * seconds:.0f} of {1000 * bound:.0f} ms")
    if seconds > bound:
        beside = crowd()
        assert beside > 1.0 and seconds <= 2.0 * bound, f"{what}, beside {beside:.1f} a processor{': too busy to judge' if beside > 4.0 else ''}"


def script(path):
    """A program without an ending, as a module."""
    loader = importlib.machinery.SourceFileLoader(path.name, str(path))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(path.name, loader))
    loader.exec_module(module)
    return module


def rows_of(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def summary(folder):
    """Of the last trial that was recorded in the folder."""
    return rows_of(max(folder.glob("trial-*/summary.csv")))[0]


def navvi(*words, **variables):
    return subprocess.run([ROOT / "navvi", *map(str, words)], capture_output=True, text=True, stdin=subprocess.DEVNULL, timeout=120, env=dict(DARK, **variables))


def sourced(*words, setup=ROOT / "navvi_ws/devel/setup.bash", **more):
    """A program in a fresh shell that knows the workspace, or an install space."""
    return subprocess.run(["bash", "-c", f"source {setup} && exec \"$@\"", "bash", *map(str, words)],
                          **{"text": True, "stdin": subprocess.DEVNULL, "capture_output": True, "timeout": 300, **more})


def roslaunch(how, *words):
    """What it prints of a launch file of the repository without starting anything: `--nodes`, `--args NODE` or `--dump-params`."""
    words = [ROOT / "launch" / word if word.endswith(".launch") else word for word in [*how.split(), *map(str, words)]]
    done = subprocess.run(["roslaunch", *words], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr
    return done.stdout


def heed_ctrl_c():
    """Tests that run in the background inherit that SIGINT is ignored."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def sound(folder, driver="wave"):
    """The environment of a mixer that writes what is heard to sound.wav of the folder, or has no device at all (none)."""
    shipped = (ROOT / "navvi_ws/src/navvi_feedback/config/alsoft.conf").read_text()
    (folder / "alsoft").write_text(f"{shipped}drivers = {driver}\n[wave]\nfile = {folder}/sound.wav\n")
    return {"ALSOFT_CONF": str(folder / "alsoft")}


class Programs:
    """What runs in an environment, such as that of a master; all of it ends with `with`."""

    def __init__(self, env, log=os.devnull):
        self.env, self.log, self.processes = env, pathlib.Path(log), []

    def start(self, *words, **more):
        with open(self.log, "a") as log:
            process = subprocess.Popen(list(map(str, words)), **{"env": self.env, "stdout": log, "stderr": log, **more})
        self.processes.append(process)
        return process

    def launch(self, file, *words):
        return self.start("roslaunch", ROOT / "launch" / file, *words)

    def run(self, *words, seconds=60):
        return subprocess.run(list(map(str, words)), env=self.env, capture_output=True, text=True, timeout=seconds)

    def person(self, program, *words, seconds=120):
        """What it prints: a program of this folder, or `-c` with its text, that drives, presses and hears for a person."""
        try:
            done = self.run("/usr/bin/python3", program if program == "-c" else ROOT / "test" / program, *words, seconds=seconds)
        except subprocess.TimeoutExpired as late:
            raise AssertionError(f"{program} was not through within {seconds} s: {(late.stdout or b'').decode()[-6000:]}") from None
        assert done.returncode == 0, done.stdout[-6000:] + done.stderr[-2000:] + self.log.read_text()[-3000:]
        return done.stdout

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for process in reversed(self.processes):
            process.terminate()
        for process in self.processes:
            process.wait(30)


class Command(Programs):
    """`./navvi` with these words, what it prints, and the master that it names."""

    def __init__(self, *words, **variables):
        super().__init__(DARK | variables)
        self.output, self.times, self.uri = [], [], ""  # lines, and when each came
        self.process = self.start(ROOT / "navvi", *words, text=True, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                  start_new_session=True, preexec_fn=heed_ctrl_c)
        self.reader = threading.Thread(target=self.read, daemon=True)
        self.reader.start()

    def read(self):
        for line in self.process.stdout:
            self.times.append(time.monotonic())
            self.output.append(line)
            self.uri = "".join(re.findall(r"ROS_MASTER_URI=(http:[\w.:/]+)", line)) or self.uri

    def text(self):
        return "".join(self.output)

    def wait_until(self, condition, seconds, what):
        assert eventually(condition, seconds), f"in {seconds} s it did not come true that {what}:\n{self.text()[-4000:]}"

    def wait_until_ready(self):
        """Its master answers."""
        import rosgraph
        self.wait_until(lambda: self.uri and rosgraph.is_master_online(self.uri), 300, "the master answers")

    def wait_until_ended(self, seconds=300):
        """Returns what was said."""
        self.process.wait(seconds)
        self.reader.join(10)
        return self.text()

    def of_it(self):
        """Number and command line of each process that was started with this session's master."""
        found = {}
        for folder in pathlib.Path("/proc").glob("[0-9]*"):
            try:
                if f"ROS_MASTER_URI={self.uri}".encode() in (folder / "environ").read_bytes().split(b"\0"):
                    found[int(folder.name)] = (folder / "cmdline").read_bytes().replace(b"\0", b" ").decode()
            except OSError:  # just ended, or another user's
                pass
        return {number: line for number, line in found.items() if line}

    def kill(self, program, how=signal.SIGKILL):
        os.kill(next(number for number, line in self.of_it().items() if program in line.split(" __name:=")[0]), how)

    def end(self):
        """As Ctrl-C does."""
        if self.process.poll() is None:
            os.killpg(self.process.pid, signal.SIGINT)

    def __exit__(self, *given):
        self.end()
        try:
            self.process.wait(30)
        except subprocess.TimeoutExpired:
            os.killpg(self.process.pid, signal.SIGKILL)
            raise
        finally:
            super().__exit__(*given)


class Session(Command):
    """`./navvi run`, by the simulated person and without a picture where the words say nothing else."""

    def __init__(self, folder, *words, **variables):
        self.folder = folder
        given = {"operator": "simulated", "rviz": "false", "out": folder, **dict(map(str, word.split(":=", 1)) for word in words)}
        super().__init__("run", *(f"{name}:={value}" for name, value in given.items()), **variables)

    def wait_until_begun(self):
        self.wait_until(lambda: "has begun" in self.text(), 300, "a trial begins")

    def simulated(self):
        """s of the trial's own time."""
        times = [int(stamp) for journal in self.folder.glob("trial-*/journal.csv") for stamp in re.findall(r"^[^,\n]*,\d+,(\d+),", journal.read_text(), re.M)]
        return (times[-1] - times[0]) / 1e9 if times else 0.0

    def sleep(self, seconds):
        """In the trial's own time."""
        end = self.simulated() + seconds
        self.wait_until(lambda: self.simulated() >= end, 60, f"{seconds} s have been simulated")
