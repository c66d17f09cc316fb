"""The panel in RViz on a small screen, with the largest letters."""
import pytest

from panel_test import BUTTONS, MENU, Desk, eventually, say

pytestmark = pytest.mark.accessibility
WIDE, HIGH = 1280, 720  # px


@pytest.fixture(scope="module")
def desk(master):
    import rospy
    from navvi_msgs.msg import Cue
    with Desk(master, "large", size=f"{WIDE}x{HIGH}") as desk:
        desk.cues = rospy.Publisher("/navvi/cues", Cue, queue_size=10)
        eventually(desk.cues.get_num_connections, 120)
        yield desk


@pytest.mark.parametrize("language, begin", [("en", "Start"), ("es", "Empezar")])
def test_all_of_the_panel_is_on_the_screen_and_leaves_most_of_it_to_the_picture(desk, language, begin):
    import rospkg
    import rospy
    from navvi_msgs.msg import Cue

    def extents(widget):
        return widget.queryComponent().getExtents(desk.registry.DESKTOP_COORDS)
    rospy.set_param("/navvi/phrases", rospkg.RosPack().get_path("navvi_feedback") + f"/config/phrases/{language}.yaml")
    eventually(lambda: any(widget.name == begin for widget in desk.panel))
    say(desk, "volume, 50 percent", "setting", Cue.QUEUED)
    eventually(lambda: desk.has(desk.widget("menu"), "SHOWING"))
    window = extents(desk.window())
    shown = [extents(widget) for widget in desk.panel if desk.has(widget, "SHOWING")]
    say(desk, "menu closed", "menu_closed", Cue.QUEUED)
    assert window.width <= WIDE and window.height <= HIGH
    assert min(part.y for part in shown) - window.y >= 0.6 * window.height, "the picture has the larger part"
    assert len(shown) >= len(BUTTONS) + len(MENU) + 6, "the menu leaves the other buttons"
    for part in shown:
        assert part.x >= 0 and part.x + part.width <= WIDE and part.y + part.height <= HIGH
        assert part.width > 20 and part.height > 15
