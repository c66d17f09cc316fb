"""What a person with little sight sees: contrast, measured on pictures of RViz with and without each thing."""
import itertools
import os
import subprocess
import time

import numpy
import pytest
import scipy.ndimage
from PIL import Image, ImageChops, ImageFilter

from display import Display
from sessions import Programs, eventually

pytestmark = pytest.mark.accessibility
VISIONS = ["high_contrast", "yellow_on_black", "large", "color_blind"]
# The least share of a thing's outline that stands out. Seen forward, boards and boxes are before some, and end there with edges of their own.
LEAST = {"chase": 0.97, "forward": 0.93}
KINDS = {"path": ["path"], "goal": ["goal"], "goods": ["box", "pedestal"], "movers": ["worker", "forklift", "pallet_robot", "robot"],
         "zones": ["zone"]}
THINGS = sum(KINDS.values(), [])
NEAR = 12  # px; a thing's own edge is within, or within twice that where all is drawn twice as wide


def luminance(image):
    """Relative luminance as WCAG 2 defines it, [0, 1]."""
    c = numpy.asarray(image.convert("RGB"), dtype=float) / 255.0
    c = numpy.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4)
    return c @ [0.2126, 0.7152, 0.0722]


def contrast(a, b):
    return (numpy.maximum(a, b) + 0.05) / (numpy.minimum(a, b) + 0.05)


def grey(lum):
    return Image.fromarray(numpy.uint8(numpy.round(255 * lum)))


def filled(mask):
    """With all that its outlines enclose, too."""
    return Image.fromarray(numpy.uint8(255 * scipy.ndimage.binary_fill_holes(numpy.asarray(mask) > 0)))


def edge_contrast(shown, without, near, solid):
    """Where a thing ends: the best contrast between what is behind it and the thing or its edge, per pixel.

    A solid thing may be as dark within its edges as what is behind it; only its outline counts.
    """
    mask = ImageChops.difference(shown, without).convert("L").point(lambda v: 255 if v > 24 else 0)
    mask = mask.filter(ImageFilter.MedianFilter(5))
    if solid:
        mask = filled(mask)
    inside = numpy.asarray(mask) > 0
    around = (numpy.asarray(mask.filter(ImageFilter.MaxFilter(5))) > 0) & ~inside
    lum, behind = luminance(shown), luminance(without)
    size = 2 * near + 1
    most = scipy.ndimage.maximum_filter(numpy.where(inside, lum, 0.0), size)
    least = scipy.ndimage.minimum_filter(numpy.where(inside, lum, 1.0), size)
    best = numpy.maximum(contrast(most, behind), contrast(least, behind))
    return best[around], inside


class Picture(Programs):
    """RViz with a hand-made scene on a virtual screen."""
    filled = True
    words = []  # for the launch file

    def __init__(self, env, vision, view="chase", size="1920x1080"):
        import rospy
        from fake_robot import transform
        from geometry_msgs.msg import Point
        from std_msgs.msg import ColorRGBA
        from tf2_msgs.msg import TFMessage
        from visualization_msgs.msg import Marker, MarkerArray
        from navvi_msgs.msg import Obstacles
        os.environ.update(env)
        rospy.init_node("picture", disable_signals=True)
        self.Marker, self.Point, self.Color = Marker, Point, ColorRGBA
        self.display = Display(size)
        super().__init__(dict(env, DISPLAY=self.display.name, LIBGL_ALWAYS_SOFTWARE="1"))
        self.furnish()
        frames = rospy.Publisher("/tf_static", TFMessage, queue_size=1, latch=True)
        frames.publish([transform(*edge, 0.0, rospy.Time()) for edge in (("map", "odom"), ("odom", "base_link"))])
        self.topics = {name: rospy.Publisher(name, MarkerArray, queue_size=10, latch=True)
                       for name in ("/navvi/scene", "/navvi/scene_moving", "/navvi/markers", "/navvi/zones")}
        self.frames = frames
        self.obstacles = rospy.Publisher("/navvi/obstacles", Obstacles, queue_size=1, latch=True)
        if self.filled:
            self.show(THINGS)
        self.launch("picture.launch", f"vision:={vision}", f"view:={view}", *self.words)

    def furnish(self):
        """What else runs on the screen before RViz."""

    def marker(self, ns, number, kind, points=(), scale=(1, 1, 1), at=(0, 0, 0), color=(0.5, 0.5, 0.5)):
        marker = self.Marker(ns=ns, id=number, type=kind)
        marker.header.frame_id = "map"
        marker.pose.orientation.w = 1.0
        marker.pose.position = self.Point(*at)
        marker.scale.x, marker.scale.y, marker.scale.z = scale
        marker.color = self.Color(*color, 1.0)
        marker.points = [self.Point(*point) for point in points]
        return marker

    def scene(self):
        """As the nodes send them: each thing before the floor, and before racks, a wall, boxes or the path."""
        M, marker = self.Marker, self.marker
        x, y = numpy.meshgrid(numpy.arange(-20, 30, 1.25), numpy.arange(-12, 13, 1.25))
        still = [marker("floor", 0, M.CUBE_LIST, [(a, b, -0.05) for a, b in zip(x.flat, y.flat)], (1.25, 1.25, 0.1))]
        for i, side in enumerate((-3.6, 2.2)):  # a rack to the right, and one across the way
            boards = [(3.0 + 1.25 * k, side, z) for k in range(5) for z in (0.1, 0.8, 1.5)] if i == 0 else \
                     [(9.0, side + 1.25 * k, z) for k in range(3) for z in (0.1, 0.8, 1.5)]
            still.append(marker("shelf", i, M.CUBE_LIST, boards, (1.25, 1.0, 0.05) if i == 0 else (1.0, 1.25, 0.05)))
        still.append(marker("wall", 0, M.CUBE_LIST, [(14.0, -12 + 1.25 * k, 0.5) for k in range(20)], (0.2, 1.25, 1.0)))
        still.append(marker("box", 0, M.CUBE_LIST, [(3.0, -3.6, 0.4), (5.5, -3.6, 1.1), (4.2, -1.6, 0.3), (9.0, 2.2, 1.1)], (0.6, 0.6, 0.55)))
        still.append(marker("pedestal", 0, M.CUBE_LIST, [(3.0, 2.2, 0.075), (8.2, 2.6, 0.075)], (0.9, 0.9, 0.15)))
        size = {"worker": (0.48, 0.48, 1.75), "forklift": (2.4, 1.0, 2.1), "pallet_robot": (0.9, 0.7, 0.87)}
        place = {"worker": [(5.0, 0.9), (8.3, 3.6)], "forklift": [(10.5, -1.6)], "pallet_robot": [(6.0, -2.4), (4.5, 3.5)]}
        moving = []
        for name, places in place.items():
            for i, (a, b) in enumerate(places):
                model = marker(name, i, M.MESH_RESOURCE, scale=size[name], at=(a, b, 0.5 * size[name][2]))
                model.mesh_resource, model.mesh_use_embedded_materials = f"package://navvi_sim/meshes/{name}.dae", True
                model.color = self.Color()
                moving.append(model)
        moving.append(marker("robot", 0, M.CYLINDER, scale=(0.6, 0.6, 0.35), at=(0, 0, 0.175)))
        nose = marker("robot", 1, M.TRIANGLE_LIST, [(0.45, 0, 0.37), (-0.18, 0.22, 0.37), (-0.18, -0.22, 0.37)])
        nose.colors = [nose.color]
        moving.append(nose)
        way = [(0, 0, 0.08), (4, 0, 0.08), (4.4, -0.8, 0.08), (7.4, -0.8, 0.08), (7.4, 3, 0.08), (11.5, 3, 0.08)]
        ring = [(11.5 + numpy.cos(a), 3 + numpy.sin(a), 0.08) for a in numpy.linspace(0, 2 * numpy.pi, 49)]
        guide = [marker("path", 0, M.LINE_STRIP, way, (0.38, 0, 0)), marker("path", 1, M.LINE_STRIP, way, (0.22, 0, 0)),
                 marker("goal", 0, M.CYLINDER, scale=(0.5, 0.5, 2.5), at=(11.5, 3, 1.25)),
                 marker("goal", 1, M.LINE_STRIP, ring, (0.15, 0, 0))]
        closed = [(x, y, 0.02) for x, y in ((2, 0.8), (3.4, 0.8), (3.4, 1.6), (2, 1.6), (2, 0.8))]
        slow = [(x, y, 0.02) for y in (-3.0, -2.2) for x in numpy.arange(1.25, 4.0, 0.5)]
        zones = [marker("zone", 0, M.LINE_STRIP, closed, (0.12, 0, 0)), marker("zone", 1, M.LINE_LIST, slow, (0.12, 0, 0))]
        return {"/navvi/zones": zones, "/navvi/scene": still, "/navvi/scene_moving": moving, "/navvi/markers": guide}

    def show(self, things):
        for topic, markers in self.scene().items():
            for marker in markers:
                if marker.ns in THINGS and marker.ns not in things:
                    marker.action = self.Marker.DELETE
            self.topics[topic].publish(markers)
        self.move([(m.ns, m.pose.position.x, m.pose.position.y, m.scale) for m in self.scene()["/navvi/scene_moving"]
                   if m.ns in things and m.ns != "robot"])

    def move(self, movers):
        """What moves, as the guide knows it: class, place in m, size in m."""
        import rospy
        from navvi_msgs.msg import Obstacle, Obstacles
        message = Obstacles()
        message.header.frame_id, message.header.stamp = "map", rospy.Time.now()
        for i, (kind, x, y, size) in enumerate(movers):
            mover = Obstacle(id=i, thing_class=kind, length=size.x, width=size.y, height=size.z, radius=float(numpy.hypot(size.x, size.y)) / 2)
            mover.pose.position, mover.pose.orientation.w = self.Point(x, y, 0), 1.0
            message.obstacles.append(mover)
        self.obstacles.publish(message)

    def shot(self, path, box):
        """What is in `box` (px) of the screen once it has come to rest."""
        last = None
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline:
            subprocess.run(["import", "-window", "root", str(path)], check=True, timeout=30, env=self.env)
            image = Image.open(path).convert("RGB").crop(box)
            if last is not None and numpy.asarray(image).max() > 200 and ImageChops.difference(image, last).getbbox() is None:
                return image
            last = image
            time.sleep(0.7)
        raise AssertionError("the picture does not come to rest")

    def __exit__(self, *given):
        super().__exit__(*given)
        self.display.close()


@pytest.fixture(scope="module", params=itertools.product(LEAST, VISIONS), ids="-".join)
def pictures(request, master, tmp_path_factory):
    """A picture with everything, and for each kind of thing one without it."""
    view, vision = request.param
    folder = tmp_path_factory.mktemp(vision)
    above_panel = (10, 10, 1910, 640 if vision == "large" else 770)
    with Picture(master, vision, view) as picture:
        window = ["xdotool", "search", "--onlyvisible", "--name", "RViz$"]  # not only RViz's splash
        assert eventually(lambda: subprocess.run(window, env=picture.env, stdout=subprocess.DEVNULL).returncode == 0, 120), "RViz does not open"
        time.sleep(5)
        everything = picture.shot(folder / "all.png", above_panel)
        without = {}
        for kind, things in KINDS.items():
            picture.show([thing for thing in THINGS if thing not in things])
            time.sleep(1)
            without[kind] = picture.shot(folder / f"without_{kind}.png", above_panel)
    return everything, without, view, vision


def test_each_thing_or_its_edge_stands_out_from_all_that_it_is_before(pictures):
    everything, without, view, vision = pictures
    weak = {}
    for thing in KINDS:
        best, inside = edge_contrast(everything, without[thing], NEAR * (2 if vision == "large" else 1), thing == "goods")
        assert inside.sum() > 1000, f"{thing} is not in the picture"
        passed = (best >= 4.5).mean()
        print(f"{view} {vision} {thing}: {best.min():.1f} least, {numpy.percentile(best, 3):.1f} for 97 %, median {numpy.median(best):.1f}")
        if passed < LEAST[view]:
            weak[thing] = round(float(passed), 3)
    assert not weak


def test_path_goal_and_mover_are_found_in_grey_and_as_by_20_200(pictures):
    everything, without, view, vision = pictures
    # 10 minutes of arc, at 60 cm from a screen of 24 inches with 1080 rows.
    blurred = grey(luminance(everything)).filter(ImageFilter.GaussianBlur(6))
    for thing in ("path", "goal", "movers"):
        other = grey(luminance(without[thing])).filter(ImageFilter.GaussianBlur(6))
        ratio = contrast(numpy.asarray(blurred) / 255, numpy.asarray(other) / 255)
        print(f"{view} {vision} {thing}: {(ratio >= 3).sum()} px of 3:1 or more")
        assert (ratio >= 3).sum() > 400, thing
