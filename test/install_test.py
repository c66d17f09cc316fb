"""What is installed runs without its sources, and is a package of Debian that lintian takes; catkin_lint takes the packages of ROS."""
import os
import subprocess

import pytest

from sessions import ROOT, sourced


def output(*words, timeout=600, **more):
    done = subprocess.run(words, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=timeout, **more)
    assert done.returncode == 0, done.stdout
    return done.stdout


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    """The install space, elsewhere than it was meant for."""
    folder = tmp_path_factory.mktemp("installed")
    output("cmake", "--install", ROOT / "navvi_ws/build", "--strip", env=dict(os.environ, DESTDIR=str(folder)))
    return folder / str(ROOT / "navvi_ws/install").lstrip("/")


def run(folder, home, *words):
    """In another folder, with an environment that knows nothing of the workspace."""
    env = {"HOME": str(home), "TMPDIR": str(home), "PATH": "/usr/bin:/bin:/usr/sbin:/sbin"}
    return sourced(*words, setup=folder / "setup.bash", cwd=home, env=env, capture_output=False, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)


def test_a_session_by_the_installed_command_reaches_its_goal(installed, tmp_path):
    result = run(installed, tmp_path, "navvi", "run", "operator:=simulated", "world:=training", "rviz:=false", "speech:=auto")
    assert result.returncode == 0 and "The goal was reached" in result.stdout, result.stdout
    assert len(list(tmp_path.glob(".navvi/trials/trial-*/summary.csv"))) == 1
    assert "./navvi" not in result.stdout
    assert "./navvi" not in run(installed, tmp_path, "navvi", "man").stdout
    assert run(installed, tmp_path, "navvi", "version").stdout == output(ROOT / "navvi", "version")


def test_the_launch_files_are_found_by_their_package(installed, tmp_path):
    result = run(installed, tmp_path, "roslaunch", "navvi", "live.launch", "operator:=simulated", "--nodes")
    assert result.returncode == 0 and "/sim_node" in result.stdout, result.stdout


def test_what_builds_is_not_installed(installed, tmp_path):
    for command in "build", "test", "setup", "bench", "deb":
        result = run(installed, tmp_path, "navvi", command)
        assert result.returncode == 2 and "is not a sub-command" in result.stdout


def test_no_installed_text_names_the_sources(installed):
    texts = [path for path in installed.glob("share/**/*") if path.is_file() and not {"cmake", "__pycache__"} & set(path.parts)]
    assert len(texts) > 50
    assert [path for path in texts if str(ROOT).encode() in path.read_bytes()] == []


def test_catkin_lint_finds_nothing():
    """What it takes for wrong by mistake is named, with the reason, in .catkin_lint."""
    source = ROOT / "navvi_ws/src"
    output("catkin_lint", "-W2", "--strict", "--offline", source, env=dict(os.environ, ROS_PACKAGE_PATH=str(source)))


def test_the_package_of_debian_is_one_that_lintian_takes(tmp_path):
    output(ROOT / "navvi", "deb", tmp_path, timeout=900)
    package = next(tmp_path.glob("navvi_*.deb"))
    output("lintian", "--fail-on", "error", package)
    names = output("dpkg-deb", "-c", package)
    for name in "./usr/bin/navvi ", "./usr/share/man/man1/navvi.1.gz", "./usr/lib/udev/rules.d/60-navvi-pads.rules", "./usr/lib/navvi_nav/nav_node":
        assert name in names
    assert all(line.split(None, 5)[5].startswith(("./usr", "./etc")) or line.endswith(" ./") for line in names.splitlines())
    needed, recommended = (output("dpkg-deb", "-f", package, field).replace(",", " ").split() for field in ("Depends", "Recommends"))
    assert "rviz" in recommended and "speech-dispatcher" in recommended and "python3-roslaunch" in needed
    assert not [name for name in needed if name.startswith(("rviz", "librviz", "libqt", "libogre", "speech-dispatcher"))], "a session without a picture runs"
