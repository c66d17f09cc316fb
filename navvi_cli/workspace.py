"""What is built, and how it gets there: the shell's functions build, the programs are run from here."""
import functools
import os
import signal
import subprocess

from .places import DEVEL, SHELL, WORKSPACE, program
from .say import Failure, fail


# Before a command: it is ended with this process, also where that is killed and can end none itself.
END_WITH_US = ["setpriv", "--pdeathsig", "TERM"]


def shell(function, *words):
    """Runs a function of the folder shell. It prints how far it is and why it failed, answers Ctrl-C, and ends with this process. What it
    installs and builds is of everybody's to read."""
    process = subprocess.Popen([*END_WITH_US, str(SHELL), function, *map(str, words)], umask=0o022)
    while True:
        try:
            status = process.wait()
            break
        except KeyboardInterrupt:
            process.send_signal(signal.SIGINT)
    if status:
        raise Failure(None, status)


def build(*targets):
    """Nothing is asked, locked or printed where the targets are up to date."""
    if WORKSPACE:
        shell("build_workspace", *targets)


@functools.lru_cache(maxsize=None)
def newest_source():
    """When a source file was last changed, in ns."""
    return max(os.stat(os.path.join(folder, name)).st_mtime_ns
               for folder, _, names in os.walk(WORKSPACE / "src") for name in [*names, "."])


def is_current(*programs):
    """Whether they are there and newer than all sources; where not, only the build system knows."""
    if not WORKSPACE:
        return True
    return all(path.exists() and path.stat().st_mtime_ns > newest_source() for path in programs)


def tool(package, name):
    """A program that needs nothing but itself, built where it has to be."""
    path = program(package, name)
    if not is_current(path):
        build(name)
    return path


def show(path, *words):
    """Runs a program that prints its answer; its exit code."""
    status = subprocess.run([str(path), *map(str, words)]).returncode
    if status < 0:
        fail(f"{path.name} broke off by signal {-status}; such an error is worth a report.", 1)
    return status


def enter():
    """Takes over the environment of the built workspace, in which ROS finds its packages."""
    lines = subprocess.run([str(SHELL), "environment", str(DEVEL)], stdout=subprocess.PIPE, check=True).stdout.decode().split("\0")
    os.environ.update(line.split("=", 1) for line in lines if "=" in line)
