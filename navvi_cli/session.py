"""What run, replay and the lessons share: who drives, what is built, roslaunch, and what is shown of it."""
import glob
import os
import re
import shutil
import signal
import subprocess

from .arguments import PART_OF
from .places import DEVEL, SHELL, WORKSPACE, program, share
from .say import fail
from .version import version
from .workspace import END_WITH_US, build, enter, is_current

CONTROLS = re.compile(r"\x1b\[[0-9;]*m|\x1b\][^\x07]*\x07|[\r\x07]")
# Of all that roslaunch and the nodes print, a person reads warnings, errors, which trial begins and ends, and which node ended.
# roslaunch frames the end of a required node as a death, also where it has done its work.
SHOWN = [(re.compile(pattern), text) for pattern, text in [
    (r"^\[ *FATAL\] \[[^]]*\]: (.*)", r"error: \1"),
    (r"^\[ *ERROR\] \[[^]]*\]: (.*)", r"error: \1"),
    (r"^\[ *WARN\] \[[^]]*\]: (.*)", r"warning: \1"),
    (r"^\[ *INFO\] \[[^]]*\]: ((?:Trial [^ ]* has begun|Trial ended).*)", r"\1"),
    (r"^\[ *INFO\] \[[^]]*\]: Found: (.*)", r"found: \1"),
    (r"^process has finished cleanly", "the session has ended."),
    (r"^process has died .*exit code ([-0-9]+),.* __name:=(\w+).*", r"error: \2 has ended with exit code \1."),
    (r".*REQUIRED process \[(?!trial_node)([a-z_]*)[^]]*\] has died!.*", r"\1 has ended, and the session with it."),
    (r"^\[([a-z_]*)-[0-9]*\] process has died \[.*exit code ([-0-9]*).*", r"warning: \1 has ended with exit code \2."),
    (r"^\[([a-z_]*)-[0-9]*\] restarting process", r"\1 is started anew."),
    (r"^RLException: (.*)", r"error: \1"),
]]
FATAL = re.compile(r"FATAL|RLException")
BEGUN = re.compile(r": Trial (trial-\S+) has begun:")
# What ends a session before its time, after which roslaunch itself ends with 0: a required program, or one that does not stay alive.
CRASH = re.compile(r"^process has died|.*so the session ends\.|^RLException")
# roslaunch would end all at once with a simulator that is required. A person's is not: they first hear that it is lost.
SIMULATOR_LOST = re.compile(r"^\[sim_node-\d+\] process has ")
LAST_WORDS = 6  # s, for that; before them trial_node ends a trial by its own rule


def has_display():
    return bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))


def has_pad():
    if glob.glob("/dev/input/js*") or glob.glob("/dev/input/by-id/*-event-joystick"):
        return True
    for path in glob.glob("/sys/class/hidraw/*/device/uevent"):
        with open(path, errors="replace") as file:
            if re.search(r"HID_ID=.*054C.*0CE6", file.read(), re.I):
                return True
    return False


def check_operator(words, also):
    """Refuses a pad or keys that are not there; `also` names what is left."""
    if words["operator"] == "pad" and not has_pad():
        fail(f"operator:=pad needs a game controller, and none is connected; {also} none.", 2)
    if words["operator"] == "keyboard" and "feedback/lead:=hand" in words.parameters:
        fail("feedback/lead:=hand leads by the motors of a pad, and a keyboard has none; allowed with keys are words, ticks and flow.", 2)
    if words["operator"] == "keyboard" and not has_display():
        fail("operator:=keyboard needs a display, and DISPLAY is not set; operator:=simulated of \"./navvi run\" needs none.", 2)


def has_rviz():
    """A build in the sources installs it; the package of Debian recommends it."""
    return bool(WORKSPACE or shutil.which("rviz"))


def resolve_rviz(words):
    if words.setdefault("rviz", "auto") == "auto":
        words["rviz"] = "true" if has_display() and has_rviz() else "false"
    elif words["rviz"] == "true" and not has_display():
        fail("rviz:=true needs a display, and DISPLAY is not set; rviz:=false needs none.", 2)
    elif words["rviz"] == "true" and not has_rviz():
        fail("rviz:=true needs the package rviz; \"sudo apt install rviz\" installs it, and rviz:=false needs none.", 2)


def nodes_of(words):
    """The program of each part that has parameters."""
    called = {part: name for name, part in PART_OF.items()}
    names = {part: f"{called.get(part, part)}_node" for part in sorted({word.partition("/")[0] for word in words.parameters})}
    return {part: next((DEVEL / "lib").glob(f"navvi_*/{name}"), program("navvi", name)) for part, name in names.items()}


def accepted(node, parameters):
    """Parameters as YAML, if the node takes them."""
    packages = dict(os.environ, ROS_PACKAGE_PATH=str(share("")))  # of the phrases
    checked = subprocess.run([str(node), "--parameters", *parameters], env=packages, text=True, errors="replace", capture_output=True)
    if checked.returncode:
        fail(f"{node.name} refuses this: {checked.stderr.strip()}", 2)
    return checked.stdout.strip()


def check_parameters(words):
    """Lets each node check its own, and hands them to the launch file as YAML."""
    if words.get("zones"):
        words.parameters.append(f"nav/mesh/zones:={os.path.abspath(words.pop('zones'))}")
    for part, node in nodes_of(words).items():
        words[f"{part}_parameters"] = accepted(node, words.parameters_of(part))
    words["parameters"] = " ".join(words.parameters).replace(":=", "=")  # roslaunch ignores a value with := in it
    words["version"] = version()


def prepare(words, targets, programs, check):
    """Checks words by the programs that know them, before anything is built where these are up to date; then builds."""
    programs = [*programs, *nodes_of(words).values()]
    early = is_current(*programs)
    if early:
        check(words)
    build(*targets)
    enter()
    if not early:
        check(words)


def write(sentence):
    """As say(), also for signal handlers; a session goes on where nobody reads any more."""
    try:
        os.write(1, f"navvi: {sentence}\n".encode())
    except OSError:
        pass


class Log:
    """Everything goes to the file, what a person reads to the screen, too. The last sentence that ended a session is `fatal`, and it has
    `crashed` where a program did that. Its trials are `begun`, by name."""

    def __init__(self, path):
        self.fatal, self.crashed, self.stopping, self.begun = "", False, False, []
        try:
            self.file = open(path, "w", encoding="utf-8", errors="replace")
        except OSError as problem:
            fail(f"the log {path} cannot be written: {problem.strerror}; a place that can be is needed, such as out:=/tmp.", 2)

    def take(self, line):
        line = CONTROLS.sub("", line)
        try:
            self.file.write(line)
            self.file.flush()
        except OSError as problem:  # the session goes on; its record is not in this file
            self.file = open(os.devnull, "w")
            write(f"warning: the log cannot be written any more: {problem.strerror}.")
        self.begun += BEGUN.findall(line)
        if FATAL.search(line):
            self.fatal = line.rpartition("]: ")[2].strip()
        self.crashed = self.crashed or bool(CRASH.match(line))
        for pattern, text in SHOWN:
            if pattern.match(line) and not (self.stopping and line.startswith("RLException")):  # of nodes that Ctrl-C left unstarted
                write(pattern.sub(text, line.rstrip("\n")))


class Launch:
    """A roslaunch that runs to its end, whatever ends it."""

    def __init__(self, launch_file, words, log, network):
        os.umask(0o077)  # what a session leaves is its owner's alone
        self.interrupted, self.log = False, Log(log)
        env = dict(os.environ, ROSCONSOLE_STDOUT_LINE_BUFFERED="1", PYTHONUNBUFFERED="1", LD_PRELOAD=network.preload())
        if str(log) != os.devnull:  # beside it: what nodes log tells of the person
            env["ROS_LOG_DIR"] = str(log).removesuffix(".log")
        # Programs end with the roslaunch that has this number, however it ends (launcher.hpp). It holds the port's lock, too, and
        # those of whoever began this session and may be gone before it.
        locks = [*network.locks, *map(int, os.environ.get("NAVVI_LOCKS", "").split())]
        self.process = subprocess.Popen([*END_WITH_US, "sh", "-c", "export NAVVI_LAUNCHER=$$; exec \"$@\"", "sh", str(SHELL.with_name("roslaunch")),
                                         str(launch_file.path), *(f"{name}:={value}" for name, value in words.items())], env=env, pass_fds=locks,
                                        stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)  # rosbag play takes keys

    def run(self):
        """Whether roslaunch ended in order. A terminal sends Ctrl-C to roslaunch, too; other signals are handed on."""
        before = {number: signal.signal(number, self.stop) for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
                  if signal.getsignal(number) != signal.SIG_IGN}
        before[signal.SIGPIPE] = signal.signal(signal.SIGPIPE, signal.SIG_IGN)
        before[signal.SIGALRM] = signal.signal(signal.SIGALRM, self.stop)
        for line in self.process.stdout:
            line = CONTROLS.sub("", line.decode(errors="replace"))
            self.log.take(line)
            if SIMULATOR_LOST.match(line) and not self.log.stopping:
                write(f"the simulator has ended, and the session ends in {LAST_WORDS} s.")
                self.log.crashed = True
                signal.alarm(LAST_WORDS)
        status = self.process.wait()
        for number, handler in before.items():
            if number == signal.SIGALRM:  # the last one: no other sets the alarm again
                signal.alarm(0)
            signal.signal(number, handler)
        return status == 0 and not self.log.crashed

    def stop(self, number, _):
        """Again each second: while roslaunch starts, a signal can be lost; once it stops, it heeds no other."""
        if number == signal.SIGINT and not self.interrupted:
            write("stopped by Ctrl-C; what was recorded is kept.")
        self.interrupted = self.interrupted or number != signal.SIGALRM
        self.log.stopping = True
        self.process.send_signal(signal.SIGINT if number == signal.SIGALRM else number)
        signal.alarm(1)
