"""What is installed runs without its sources, and is a package of Debian that lintian takes; catkin_lint takes the packages of ROS."""
import os
import pathlib
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parent.parent
BUILD = ROOT / "navvi_ws/build"


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    """The install space, elsewhere than it was meant for."""
    folder = tmp_path_factory.mktemp("installed")
    subprocess.run(["cmake", "--install", str(BUILD), "--strip"], env=dict(os.environ, DESTDIR=str(folder)), check=True,
                   stdout=subprocess.DEVNULL, timeout=300)
    return folder / str(ROOT / "navvi_ws/install").lstrip("/")


def run(folder, home, *words):
    """In another folder, with an environment that knows nothing of the workspace."""
    env = {"HOME": str(home), "TMPDIR": str(home), "PATH": "/usr/bin:/bin:/usr/sbin:/sbin"}
    return subprocess.run(["bash", "-c", f"source {folder}/setup.bash && exec \"$@\"", "bash", *words], cwd=home, env=env, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=300)


def test_a_session_by_the_installed_command_reaches_its_goal(installed, tmp_path):
    result = run(installed, tmp_path, "navvi", "run", "operator:=simulated", "world:=training", "rviz:=false", "speech:=auto")
    assert result.returncode == 0 and "The goal was reached" in result.stdout, result.stdout
    assert len(list(tmp_path.glob(".navvi/trials/trial-*/summary.csv"))) == 1
    assert "./navvi" not in result.stdout
    assert "./navvi" not in run(installed, tmp_path, "navvi", "man").stdout
    assert run(installed, tmp_path, "navvi", "version").stdout == subprocess.check_output([str(ROOT / "navvi"), "version"], text=True)


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
    result = subprocess.run(["catkin_lint", "-W2", "--strict", "--offline", str(source)], env=dict(os.environ, ROS_PACKAGE_PATH=str(source)),
                            text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=300)
    assert result.returncode == 0, result.stdout


def test_the_package_of_debian_is_one_that_lintian_takes(tmp_path):
    made = subprocess.run([str(ROOT / "navvi"), "deb", str(tmp_path)], text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=900)
    assert made.returncode == 0, made.stdout
    package = next(tmp_path.glob("navvi_*.deb"))
    result = subprocess.run(["lintian", "--fail-on", "error", str(package)], text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=600)
    assert result.returncode == 0, result.stdout
    names = subprocess.run(["dpkg-deb", "-c", str(package)], text=True, stdout=subprocess.PIPE, check=True).stdout
    for name in "./usr/bin/navvi ", "./usr/share/man/man1/navvi.1.gz", "./usr/lib/udev/rules.d/60-navvi-pads.rules", "./usr/lib/navvi_nav/nav_node":
        assert name in names
    assert all(line.split(None, 5)[5].startswith(("./usr", "./etc")) or line.endswith(" ./") for line in names.splitlines())
    needed, recommended = (subprocess.run(["dpkg-deb", "-f", str(package), field], text=True, stdout=subprocess.PIPE, check=True).stdout.replace(",", " ").split()
                           for field in ("Depends", "Recommends"))
    assert "rviz" in recommended and "speech-dispatcher" in recommended and "python3-roslaunch" in needed
    assert not [name for name in needed if name.startswith(("rviz", "librviz", "libqt", "libogre", "speech-dispatcher"))], "a session without a picture runs"
