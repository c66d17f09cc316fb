"""Three goals by pad alone, without a display."""
import pytest

from by_hand import session

pytestmark = pytest.mark.accessibility


def test_three_goals_by_pad_alone(master, tmp_path):
    env = {key: value for key, value in master.items() if key not in ("DISPLAY", "WAYLAND_DISPLAY")}
    session(env, tmp_path, "auto", ["goal_reached"] * 3, "rviz:=false")
