import os
import socket
import subprocess
import time

import pytest

import sessions
from display import Display


def pytest_configure(config):
    config.addinivalue_line("markers", "accessibility: a line of the checklist; `./navvi test accessibility` runs them all")


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


@pytest.fixture(scope="module")
def master():
    """The environment of a ROS master of this module's own."""
    port = free_port()
    env = dict(os.environ, ROS_MASTER_URI=f"http://127.0.0.1:{port}", ROS_IP="127.0.0.1")
    process = subprocess.Popen(["rosmaster", "--core", "-p", str(port)], env=env, stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL)
    deadline = time.monotonic() + 20
    while True:
        try:
            socket.create_connection(("127.0.0.1", port), timeout=1).close()
            break
        except OSError:
            assert process.poll() is None and time.monotonic() < deadline, "the master did not start"
            time.sleep(0.1)
    yield env
    process.terminate()
    process.wait()


@pytest.fixture
def desktop(master):
    """The environment of a display with a window manager, drawn without a graphics card."""
    display = Display()
    env = dict(master, DISPLAY=display.name, LIBGL_ALWAYS_SOFTWARE="1")
    windows = subprocess.Popen(["openbox"], env=env, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        yield env
    finally:
        windows.terminate()
        windows.wait()
        display.close()


@pytest.fixture
def session(tmp_path):
    """session(WORDS, of the environment VARIABLES) begins `./navvi run`; it ends with the test."""
    begun = []

    def begin(*words, **variables):
        begun.append(sessions.Session(tmp_path, *words, **variables))
        return begun[-1]
    yield begin
    for one in begun:
        one.__exit__()
