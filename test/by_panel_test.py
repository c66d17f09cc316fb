"""A goal by the keys of the panel in RViz and the driving keys."""
import pytest

from by_hand import session

pytestmark = pytest.mark.accessibility


def test_a_goal_by_panel_and_keys_alone(desktop, tmp_path):
    session(desktop, tmp_path, "panel", ["goal_reached", "aborted"], "rviz:=true")
