import os
import socket
import subprocess

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
    with sessions.Programs(env) as programs:
        programs.start("rosmaster", "--core", "-p", port)
        assert sessions.eventually(lambda: socket.socket().connect_ex(("127.0.0.1", port)) == 0, 20), "the master did not start"
        yield env


@pytest.fixture
def desktop(master):
    """The environment of a display with a window manager, drawn without a graphics card."""
    display = Display()
    try:
        with sessions.Programs(dict(master, DISPLAY=display.name, LIBGL_ALWAYS_SOFTWARE="1")) as programs:
            programs.start("openbox")
            yield programs.env
    finally:
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


@pytest.fixture
def plugged(tmp_path):
    """The environment of programs that find a game controller in memory, virtual_pad.cpp."""
    library, flags = tmp_path / "pad.so", subprocess.check_output(["pkg-config", "--cflags", "sdl2"], text=True).split()
    source = sessions.ROOT / "test/virtual_pad.cpp"
    subprocess.run(["g++", "-std=c++17", "-shared", "-fPIC", *flags, "-o", library, source, "-ldl", "-pthread"], check=True)
    return {"LD_PRELOAD": str(library), "VIRTUAL_PAD": str(tmp_path / "pad")}
