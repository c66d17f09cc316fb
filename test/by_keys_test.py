"""Three goals by keys alone, in the small window."""
import pytest

from by_hand import session

pytestmark = pytest.mark.accessibility


def test_three_goals_by_keys_alone(desktop, tmp_path):
    session(desktop, tmp_path, "keyboard", ["goal_reached"] * 3, "rviz:=false")
