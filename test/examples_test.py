"""Each program of examples/ runs, and prints what its first lines promise."""
import re

import pytest

from sessions import ROOT, sourced

LIB = ROOT / "navvi_ws/devel/lib/navvi_people"
EXAMPLES = sorted((ROOT / "examples").iterdir())


def printed(*command):
    done = sourced(*command, cwd=ROOT)
    assert done.returncode == 0, done.stderr
    return done.stdout.splitlines()


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.name)
def test_an_example_is_small(example):
    assert len(example.read_text().splitlines()) <= 40


def test_a_path_leads_from_start_to_goal():
    corners = [tuple(map(float, line.split())) for line in printed(LIB / "example_path", "training", 1)]
    assert len(corners) >= 2 and corners[0] == (-0.18, 0.58) and corners[-1] == (8.08, -0.93)


def test_steps_of_a_world_repeat():
    lines = printed(LIB / "example_step")
    assert len(lines) == 11 and re.fullmatch(r"state [0-9a-f]{16}", lines[-1])
    assert lines == printed(LIB / "example_step")


def test_a_cue_is_worded():
    assert printed(LIB / "example_cue") == ["turn to 3 o'clock now", "forklift on your left"]


def test_a_condition_changes_trials():
    lines = printed(ROOT / "examples/condition.py", "sim/robot/max_speed:=0.4")
    assert float(re.match(r"elapsed_s: \+([\d.]+) on the mean of 5 worlds", lines[0])[1]) > 5.0


def test_a_figure_counts_over_a_record(tmp_path):
    printed(ROOT / "navvi", "bench", "trials", "--world=training", "--seeds=1", "--records=all", f"--out={tmp_path}")
    assert 0.0 < float(printed(ROOT / "examples/figure.py", tmp_path / "trial-training-1")[0]) < 1.0
