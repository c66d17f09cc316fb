"""The panel in RViz: as a screen reader meets it, by keys, and how large its letters are."""
import functools
import os
import pathlib
import subprocess
import tempfile
import time

import numpy
import pytest

from picture_test import KINDS, THINGS, Picture, luminance

pytestmark = pytest.mark.accessibility

BUTTONS = {"Start": "F5", "End trial": "F8", "Repeat": "R", "Goal": "G", "Around": "A", "Chase": "1", "Top": "2", "Forward": "3",
           "Tools": "F2", "Settings": "F3"}
MENU = {"Down": "page down", "Up": "page up", "Choose": "enter", "Back": "back space"}
SIGHT = (10, 40, 1910, 775)  # px, above the panel
LEAST = 26  # px, of capital letters on a screen of 1080 rows


def eventually(condition, seconds=60):
    """What the condition gives at last; what is not there yet may fail."""
    deadline = time.monotonic() + seconds
    while True:
        try:
            if found := condition():
                return found
        except Exception as error:
            if time.monotonic() > deadline:
                raise error
        assert time.monotonic() < deadline, "it did not come true"
        time.sleep(0.2)


class Desk(Picture):
    """RViz under a window manager, with a session bus on which screen readers find programs. At first it has nothing to draw, for speed."""
    filled = False

    def furnish(self):
        self.folder = tempfile.TemporaryDirectory()  # where the accessibility bus has its socket
        self.env["XDG_RUNTIME_DIR"] = self.folder.name
        read, write = os.pipe()
        self.start("dbus-daemon", "--session", "--nofork", f"--print-address={write}", pass_fds=[write])
        os.close(write)
        with os.fdopen(read) as pipe:
            self.env["DBUS_SESSION_BUS_ADDRESS"] = pipe.readline().strip()
        self.start("openbox")
        os.environ.update(self.env)
        import pyatspi
        pyatspi.setTimeout(30000, 60000)  # ms; a loaded machine draws a picture a second, and answers between two
        self.registry = pyatspi

    @staticmethod
    def parts(whole):
        return [whole.getChildAtIndex(i) for i in range(whole.childCount)]

    def window(self):
        def window():
            program = next(program for program in self.parts(self.registry.Registry.getDesktop(0)) if program.name == "rviz")
            return next(window for window in self.parts(program) if window.name.endswith("RViz"))
        return eventually(window)

    @functools.cached_property
    def panel(self):
        """All widgets of the panel, shown or not. They last as long as RViz; each question to it waits for the next picture."""
        def ends(part):
            return sum(map(ends, self.parts(part)), []) if part.getRoleName() in ("filler", "layered pane") else [part]

        def widgets():
            dock = next(part for part in self.parts(self.window()) if part.name == "Guide")
            found = sum(map(ends, self.parts(dock)), [])
            return found if len(found) > len(BUTTONS) + len(MENU) + 6 else None
        return eventually(widgets)

    @functools.cached_property
    def named(self):
        return {word: widget for widget in self.panel for word in (widget.name, widget.description)}

    def widget(self, word):
        """By name or, where the name is what it shows, by description."""
        return self.named[word]

    def has(self, widget, state):
        return widget.getState().contains(getattr(self.registry, "STATE_" + state))

    def press(self, *keys):
        subprocess.run(["xdotool", "key", *keys], env=self.env, check=True, timeout=20)

    def area(self, word):
        """px, of a widget on the screen: left, upper, right, lower."""
        box = self.widget(word).queryComponent().getExtents(self.registry.DESKTOP_COORDS)
        return box.x, box.y, box.x + box.width, box.y + box.height

    def pixels(self, sight=SIGHT):
        time.sleep(1)
        return numpy.asarray(self.shot(pathlib.Path(self.folder.name, "shot.png"), sight), dtype=int)

    def plate(self, text, place):
        """Words at a place, besides all else that the guide shows."""
        label = self.marker("goal", 9, self.Marker.TEXT_VIEW_FACING, at=place)
        label.text = text
        self.topics["/navvi/markers"].publish([label, *self.scene()["/navvi/markers"]])


def differ(one, other, by=30):
    return abs(one - other).max(axis=2) > by


@pytest.fixture(scope="module")
def desk(master):
    import rospy
    from navvi_msgs.msg import Cue, TrialRequest, TrialState
    from std_msgs.msg import String
    with Desk(master, "high_contrast") as desk:
        desk.asked, desk.requests = [], []  # two topics: which of them comes first is chance
        subscribers = [rospy.Subscriber("/navvi/ask", String, lambda msg: desk.asked.append(msg.data)),
                       rospy.Subscriber("/navvi/trial_request", TrialRequest, lambda msg: desk.requests.append(msg.request))]
        desk.cues = rospy.Publisher("/navvi/cues", Cue, queue_size=10)
        desk.orders = rospy.Publisher("/navvi/order", Cue, queue_size=10, latch=True)
        desk.state = rospy.Publisher("/navvi/trial_state", TrialState, queue_size=1, latch=True)
        eventually(lambda: all(link.get_num_connections() for link in [*subscribers, desk.cues, desk.orders, desk.state]), 120)
        eventually(lambda: desk.has(desk.window(), "ACTIVE"))
        yield desk


def say(desk, text, kind="direction", stage=1):  # started
    from navvi_msgs.msg import Cue
    desk.cues.publish(Cue(stage=stage, modality=Cue.SPEECH, kind=kind, text=text))


def order(desk, text="", kind="press_start"):
    from navvi_msgs.msg import Cue
    desk.orders.publish(Cue(stage=Cue.STARTED if text else Cue.ENDED, modality=Cue.SPEECH, kind=kind, text=text))


def set_state(desk, state):
    from navvi_msgs.msg import TrialState
    desk.state.publish(TrialState(state=getattr(TrialState, state)))


def test_a_screen_reader_meets_each_part_by_role_and_name(desk):
    panel = desk.panel
    buttons = {widget.name: widget.description for widget in panel if widget.getRoleName() == "push button"}
    assert buttons == {name: f"Key {key}" for name, key in {**BUTTONS, **MENU}.items()}
    labels = [widget.description for widget in panel if widget.getRoleName() == "label"]
    assert {"state", "instruction", "distance", "speed", "time", "menu"} <= set(labels)
    assert desk.widget("Vision").getRoleName() == "combo box"
    for widget in panel:
        assert widget.name or widget.description, "a part has no name"
        assert widget.getRoleName() == "label" or desk.has(widget, "FOCUSABLE"), widget.name


def test_a_screen_reader_reads_what_was_said_and_what_the_trial_waits_for(desk):
    set_state(desk, "READY")
    say(desk, "settings of ada", "settings_of")
    order(desk, "press start to begin")
    eventually(lambda: desk.widget("instruction").name == "settings of ada")
    eventually(lambda: desk.widget("state").name == "press start to begin")
    set_state(desk, "RUNNING")
    order(desk)
    eventually(lambda: desk.widget("state").name == "drive")


def test_the_panel_speaks_the_language_of_the_session_and_names_its_keys(desk):
    import rospkg
    import rospy
    from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
    diagnostics = rospy.Publisher("/diagnostics", DiagnosticArray, queue_size=1, latch=True)

    def sit_at(language, source):
        rospy.set_param("/navvi/phrases", rospkg.RosPack().get_path("navvi_feedback") + f"/config/phrases/{language}.yaml")
        diagnostics.publish(DiagnosticArray(status=[DiagnosticStatus(name="navvi/pad", values=[KeyValue("input", source)])]))
    button, choose = desk.widget("Start"), desk.widget("Choose")
    try:
        sit_at("es", "keyboard")
        eventually(lambda: (button.name, button.description) == ("Empezar", "Tecla intro"))
        sit_at("es", "pad")
        eventually(lambda: (button.name, button.description) == ("Empezar", "Tecla F5"))
        eventually(lambda: (choose.name, choose.description) == ("Elegir", "Tecla intro"))
    finally:
        sit_at("en", "pad")
        eventually(lambda: (button.name, button.description) == ("Start", "Key F5"))


def test_a_screen_reader_presses_a_button(desk):
    desk.asked.clear()
    assert desk.widget("Around").queryAction().doAction(0)
    eventually(lambda: desk.asked == ["around"])


def test_the_menu_is_shown_and_driven_by_keys_and_by_a_screen_reader(desk):
    from navvi_msgs.msg import Cue
    desk.asked.clear()
    desk.press("F3")
    eventually(lambda: desk.asked == ["settings"])
    say(desk, "volume, 50 percent", "setting", Cue.QUEUED)
    eventually(lambda: desk.widget("menu").name == "volume, 50 percent")
    eventually(lambda: desk.has(desk.widget("Down"), "SHOWING"))
    assert all(desk.has(desk.widget(name), "SHOWING") for name in BUTTONS), "the menu leaves the other buttons"
    desk.asked.clear()
    desk.press("Next", "Prior", "Return", "BackSpace")
    eventually(lambda: desk.asked == ["next", "previous", "choose", "back"])
    assert desk.widget("Down").queryAction().doAction(0)
    eventually(lambda: desk.asked[4:] == ["next"])
    say(desk, "menu closed", "menu_closed", Cue.QUEUED)
    eventually(lambda: not desk.has(desk.widget("Down"), "SHOWING"))
    desk.press("BackSpace", "r")
    eventually(lambda: desk.asked[5:] == ["repeat"])


def test_keys_ask_begin_and_end(desk):
    from navvi_msgs.msg import TrialRequest
    desk.asked.clear()
    desk.press("r", "g", "a", "F5", "F8")
    eventually(lambda: (desk.asked, desk.requests) == (["repeat", "goal", "around", "end"], [TrialRequest.BEGIN]))


def test_a_key_that_is_held_asks_once(desk):
    desk.asked.clear()
    subprocess.run(["xdotool", "keydown", "r", "sleep", "2", "keyup", "r", "key", "g"], env=desk.env, check=True, timeout=60)
    eventually(lambda: desk.asked[-1:] == ["goal"])
    assert desk.asked == ["repeat", "goal"]


def test_the_tab_key_goes_through_all_that_can_be_pressed(desk):
    waiting = [desk.widget(name) for name in BUTTONS]
    for _ in range(40):
        desk.press("Tab")
        time.sleep(0.3)
        waiting = [widget for widget in waiting if not desk.has(widget, "FOCUSED")]
        if not waiting:
            return
    raise AssertionError([widget.name for widget in waiting])


def test_a_key_shows_and_hides_what_else_rviz_has(desk):
    def bar():
        return next(part for part in desk.parts(desk.window()) if part.getRoleName() == "menu bar")
    assert not desk.has(bar(), "SHOWING"), "nothing but picture and panel at first"
    desk.press("F2")
    eventually(lambda: desk.has(bar(), "SHOWING"))
    desk.press("F2")
    eventually(lambda: not desk.has(bar(), "SHOWING"))


def test_keys_choose_the_view(desk):
    sight = (10, 40, 1910, 800)
    desk.show(THINGS)
    shots = []
    for key in ("3", "2", "1", "2"):
        desk.press(key)
        shots.append(desk.pixels(sight))
    shares = [[differ(a, b).mean() for a in shots] for b in shots]
    print(numpy.round(shares, 3))
    assert shares[1][3] < 0.01, "the same key shows the same view"
    assert min(shares[0][1], shares[0][2], shares[1][2]) > 0.05, "each key shows its own"
    desk.press("1", "1", "2", "3", "2", "2")  # faster than pictures are drawn
    assert differ(desk.pixels(sight), shots[1]).mean() < 0.01, "RViz lives, and shows the last"
    desk.press("1")


STUMBLED_OVER = [*KINDS["movers"], "goal", "pedestal"]


@pytest.mark.parametrize("hidden, least, places, view", [
    (["robot"], 500, [(-0.2, 0, 0)], "1"), (["path"], 5000, [(7.4, -0.8, 0)], "1"), (["path"], 5000, [(7.4, -0.8, 0)], "2"),
    (STUMBLED_OVER, 2000, [(10.5, -2.6, 0), (6.0, -3.2, 0), (5.0, 0.2, 0)], "1"), (STUMBLED_OVER, 2000, [(10.5, -2.6, 0), (6.0, -3.2, 0), (5.0, 0.2, 0)], "2"),
], ids=["robot", "path", "path_from_above", "what_moves_or_is_stumbled_over", "what_moves_or_is_stumbled_over_from_above"])
def test_no_plate_lies_over(desk, hidden, least, places, view):
    """\\param hidden  found by taking it away \\param least  px of it"""
    set_state(desk, "RUNNING")
    desk.press(view)
    desk.show([thing for thing in THINGS if thing not in hidden])
    without = desk.pixels()
    desk.show(THINGS)
    bare = desk.pixels()
    # Of the path its fill alone.
    things = abs(bare - [209, 115, 255]).max(axis=2) < 12 if hidden == ["path"] else differ(bare, without, 60)
    for place in places:
        desk.plate("in 7 m, 10 o'clock", place)
        changed = differ(desk.pixels(), bare)
        assert things.sum() > least and changed.sum() > 2000, "things and plate are there"
        assert (changed & things).sum() == 0, place
    desk.show(THINGS)
    desk.press("1")


@pytest.mark.parametrize("view, x", [("1", 30.0), ("3", -4.0)])
def test_who_the_banner_warns_of_is_pointed_to(desk, view, x):
    from geometry_msgs.msg import Vector3
    set_state(desk, "RUNNING")
    desk.press(view)
    desk.show(THINGS)
    desk.move([])
    order(desk, "wait, forklift in the way", "blocked")
    bare = desk.pixels()
    desk.move([("forklift", x, -4.0, Vector3(2.4, 1.0, 2.1)), ("worker", 2.0, 0.0, Vector3(0.5, 0.5, 1.8))])
    time.sleep(7 if view == "1" else 0)  # the view goes back until it sees them, or as far as it does
    pointed = desk.pixels()
    order(desk)
    desk.show(THINGS)
    time.sleep(5)
    assert differ(pointed, bare).sum() > 5000
    white = (pointed.min(axis=2) > 250) & (bare.max(axis=2) < 250)
    assert white.sum() > 3000, "the name stands on a bright plate"
    desk.press("1")


# --- how large letters are

def glyph(image, number=0):
    """The height in px of one letter, which are counted from the left by the gaps between them."""
    lum = luminance(image)
    ink = lum > 0.5 if numpy.median(lum) < 0.5 else lum < 0.5
    edges = numpy.flatnonzero(numpy.diff(numpy.r_[False, ink.any(axis=0), False]))
    first, last = edges[2 * number], edges[2 * number + 1]
    rows = numpy.flatnonzero(ink[:, first:last].any(axis=1))
    return rows[-1] - rows[0] + 1


def inside(box, margin):
    return box[0] + margin, box[1] + margin, box[2] - margin, box[3] - margin


def heights(desk, folder):
    """px, of capital letters in the panel and on a plate, and of small ones without strokes up or down in the banner."""
    from PIL import ImageChops
    sight = (10, 40, 1910, 700)
    desk.show(THINGS)
    say(desk, "HERE", "settings_of")
    set_state(desk, "RUNNING")
    eventually(lambda: desk.widget("instruction").name == "HERE")
    bare = desk.shot(folder / "bare.png", sight)
    found = {}
    for word in ("instruction", "Start", "Goal", "Top", "Tools"):
        found[word] = glyph(desk.shot(folder / "panel.png", inside(desk.area(word), 8)))
    for name, show, hide, letter in [
            ("plate", lambda: desk.plate("GOAL", (6, 0, 0.5)), lambda: desk.show(THINGS), 0),
            ("banner", lambda: order(desk, "press start to begin"), lambda: order(desk), 1)]:
        show()
        time.sleep(1)
        shown = desk.shot(folder / f"{name}.png", sight)
        box = ImageChops.difference(shown, bare).convert("L").point(lambda v: 255 if v > 40 else 0).getbbox()
        found[name] = glyph(shown.crop(inside(box, (box[3] - box[1]) // 8)), letter)
        hide()
        time.sleep(1)
    return found


def choose(desk, vision):
    desk.press("alt+v")
    eventually(lambda: desk.has(desk.widget("Vision"), "FOCUSED"))
    desk.press(*vision.lower()[:3])
    eventually(lambda: desk.widget("Vision").name == vision)


def test_letters_are_large_and_twice_as_large_for_who_wants_that(desk, tmp_path):
    set_state(desk, "RUNNING")
    plain = heights(desk, tmp_path)
    print("high_contrast", plain)
    assert min(plain.values()) >= LEAST
    choose(desk, "Large")
    large = heights(desk, tmp_path)
    print("large", large)
    assert min(large.values()) >= LEAST
    assert all(large[part] >= 2 * LEAST for part in ("instruction", "plate", "banner"))
    assert min(large.values()) >= 1.3 * LEAST, "buttons, too"
