"""Pictures from above, m in map, x to the right and y up: of a world, and of a map with its navmesh."""
import math

import numpy as np
from matplotlib import patheffects, rc_context
from matplotlib.collections import PathCollection, PolyCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, Patch
from matplotlib.path import Path

from .say import fail

PAINTS = {  # fill and edge; hues as in the scene in RViz, on a light ground
    "floor": ("#f4f3ee", "#d8d6cc"), "shelf": ("#7d9bbd", "#34506f"), "wall": ("#4a4a4a", "#2b2b2b"), "box": ("#f2cf3b", "#8a7000"),
    "pedestal": ("#c08a55", "#6e4315"), "worker": ("#27b04b", "#0c5a20"), "forklift": ("#ff8a1f", "#8f4300"), "pallet_robot": ("#17b3b3", "#005f5f"),
    "other": ("#d3c8aa", "#6b6350")}
WAY = "#9b00d3"
GROUND = {" ": (0x8a, 0x8f, 0x98), ".": (0xf2, 0xf2, 0xee), "#": (0x30, 0x34, 0x3a)}
SHADES = ("#3fd0e0", "#7fe0a0", "#a0b8ff", "#e0d070", "#ffb0d0")  # of the parts of a mesh
DRIVEN_OVER = 0.05  # m above the floor
MARGIN = 2.0  # m, of floor around what stands
INCH = 100.0  # px


def save(figure, path):
    """Writes .svg or .png; the same picture gives the same bytes. \\param path  or a binary stream, which gets SVG"""
    kind = getattr(path, "suffix", ".svg")[1:]
    try:
        with rc_context({"svg.hashsalt": "navvi", "svg.fonttype": "none"}):
            figure.savefig(path, format=kind, dpi=INCH, metadata={"Date": None, "Creator": None} if kind == "svg" else None)
    except OSError as error:
        fail(f"the picture \"{path}\" cannot be drawn: {error.strerror}.", 2)


def canvas(low, high, scale):
    """A figure with axes in m. \\param scale  px a metre"""
    width, height = (high - low) * scale
    page = np.array([width + 370.0, max(height, 400.0) + 120.0])
    figure = Figure(page / INCH)
    axes = figure.add_axes([80.0 / page[0], (page[1] - height - 70.0) / page[1], width / page[0], height / page[1]])
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), xlabel="x, m", ylabel="y, m")
    return figure, axes


def legend(axes, handles):
    axes.legend(handles=handles, loc="upper left", bbox_to_anchor=(1.0, 1.0), frameon=False)


def dot(size, fill, edge=None, label=None, shape="o"):
    return dict(marker=shape, markersize=size, markerfacecolor=fill, markeredgecolor=edge or fill, markeredgewidth=1.8 if edge else 0, linestyle="none", label=label)


TURN, GOAL = dot(7, "#ffffff", WAY, "turn"), dot(14, "#ffffff", "#d00000", "goal")


# --- a world


class Outline:
    """What is seen of a shape: `rings` without holes, `solid` with them, `lines`; arrays of points."""

    def __init__(self, look, bottom, top, rings=(), solid=(), lines=(), box=None, hangs=False):
        self.look, self.bottom, self.top, self.hangs = look, bottom, top, hangs
        self.rings, self.solid, self.lines, self.box = rings, solid, lines, box
        points = np.vstack([*rings, *solid, *lines])
        self.low, self.high = points.min(axis=0), points.max(axis=0)

    def covers(self, other, share):
        """Whether it is a box that covers that share of the bounds of the other."""
        if self.box is None or self.hangs:
            return False
        common = np.clip(np.minimum(self.high, other.high) - np.maximum(self.low, other.low), 0.0, None)
        return common.prod() >= share * (other.high - other.low).prod() - 1e-9

    def strokes(self, scale):
        """(path, fill, edge, px wide, dashes) each."""
        fill, edge = PAINTS[self.look]

        def wide(metres):
            return min(max(metres * scale, 0.4), 2.0)
        if self.hangs:
            yield closed(self.rings), "none", edge, wide(0.04), (0, (4, 4))
            return
        if self.rings:
            yield closed(self.rings), fill, edge if len(self.rings) == 1 else "none", wide(0.04), "solid"
        if self.solid:
            yield closed(turned(self.solid)), fill, edge, wide(0.04), "solid"
        marks = list(self.lines)
        if self.box is not None and self.look in ("box", "pedestal", "other"):  # taped, with slats, and a door with leaves
            a, b, c, d = self.box
            marks = [(a + share * (b - a), d + share * (c - d)) for share in (0.25, 0.5, 0.75)] if self.look == "pedestal" else (
                [((a + d) / 2, (b + c) / 2)] if self.look == "box" else [((a + b) / 2, (c + d) / 2)])
        if marks:
            yield Path.make_compound_path(*map(Path, marks)), "none", edge, wide(0.08 if self.lines else 0.05), "solid"


def closed(rings):
    return Path.make_compound_path(*(Path(np.vstack([ring, ring[:1]]), closed=True) for ring in rings))


def area(ring):
    x, y = np.asarray(ring).T
    return (x @ np.roll(y, -1) - np.roll(x, -1) @ y) / 2


def turned(rings):
    """Holes the other way round than what is around them."""
    return [ring if (area(ring) > 0) == (sum(Path(other).contains_point(ring[0]) for other in rings if other is not ring) % 2 == 0) else ring[::-1]
            for ring in rings]


def hull(points):
    """The convex hull (Andrew, 1979)."""
    def half(points):
        chain = []
        for x, y in points:
            while len(chain) > 1 and (chain[-1][0] - chain[-2][0]) * (y - chain[-2][1]) <= (chain[-1][1] - chain[-2][1]) * (x - chain[-2][0]):
                chain.pop()
            chain.append((x, y))
        return chain[:-1]
    points = sorted(set(map(tuple, points)))
    return np.array(half(points) + half(points[::-1]) or points)


def below(corners, cut):
    """Of a triangle: the ring of what lies below the cut, and the ends of its section there."""
    ring, section = [], []
    for one, other in zip(corners, np.roll(corners, -1, axis=0)):
        if one[2] <= cut:
            ring.append(one[:2])
        if (one[2] <= cut) != (other[2] <= cut):
            low, high = (one, other) if one[2] <= cut else (other, one)  # so that neighbours find the same point
            ring.append((low + (cut - low[2]) / (high[2] - low[2]) * (high - low))[:2])
            section.append(tuple(ring[-1]))
    ring = np.array(ring)
    return ring[::-1] if area(ring) < 0 else ring, section


def chained(sections):
    """Sections joined at their ends: rings, and lines that do not close."""
    ends, rings, lines = {}, [], []
    for section in sections:
        for end in section:
            ends.setdefault(end, []).append(section)
    left = dict.fromkeys(map(id, sections))
    for section in sections:
        if id(section) not in left:
            continue
        chain = list(section)
        while section is not None:
            left.pop(id(section), None)
            section = next((one for one in ends[chain[-1]] if id(one) in left), None) if chain[-1] != chain[0] or len(chain) == 2 else None
            if section is not None:
                chain.append(section[1] if section[0] == chain[-1] else section[0])
        (rings if chain[-1] == chain[0] else lines).append(np.array(chain))
    return rings, lines


def mesh_outlines(points, triangles, look, floor, cut):
    """What of a mesh is driven over, what stands in the way, and what hangs."""
    corners = points[triangles]
    low, high = corners[:, :, 2].min(axis=1), corners[:, :, 2].max(axis=1)
    hangs, driven = low >= cut, (low < cut) & (high < floor + DRIVEN_OVER)
    for part, its_look in ((driven, "floor"), (~hangs & ~driven, look)):
        cuts = [below(triangle, cut) for triangle in corners[part]]
        rings, lines = [ring for ring, _ in cuts if area(ring) >= 1e-4], [ring for ring, _ in cuts if area(ring) < 1e-4]
        solid, open_lines = chained([section for _, section in cuts if len(set(section)) == 2])
        if cuts:
            yield Outline(its_look, low[part].min(), min(high[part].max(), cut), rings, solid, [*lines, *open_lines])
    if hangs.any():
        yield Outline(look, low[hangs].min(), high[hangs].max(), [hull(corners[hangs].reshape(-1, 3)[:, :2])], hangs=True)


def outlines_of(thing, floor, cut):
    """What is seen of a thing; what another of its shapes covers is left out."""
    found = []
    for shape in thing["shapes"]:
        points = np.array(shape["points"])
        look = "wall" if shape["class"] == "floor" else shape["class"]  # what rises from a floor is a wall
        if shape["triangles"]:
            found += mesh_outlines(points, np.array(shape["triangles"], int), look, floor, cut)
            continue
        bottom, top = points[:, 2].min(), points[:, 2].max()
        box = points[[0, 1, 3, 2], :2] if len(points) == 8 and np.allclose(points[:4, :2], points[4:, :2], atol=1e-3) else None
        found.append(Outline("floor" if top < floor + DRIVEN_OVER else look, bottom, top, [hull(points[:, :2]) if box is None else box],
                             box=box, hangs=bottom >= cut))
    for high in found:  # the upper boards of a rack stand on the lower ones
        high.hangs = high.hangs and not any(low.look != "floor" and low.covers(high, 0.5) for low in found)
    return [low for low in found if not any(high.bottom >= low.top - 1e-6 and high.covers(low, 1.0) for high in found)]


def shown_area(things, ground, needed):
    """Corners of all but the floor's margin and the few things without which the rest is drawn twice as large, and how many these are.
    \\param things  low and high corner each; `ground` and `needed`: points"""
    def around(boxes):
        points = [*(point for box in boxes for point in box), *needed]
        return np.min(points, axis=0), np.max(points, axis=0)

    def side(boxes):
        return np.subtract(*around(boxes)[::-1]).max()
    beyond = 0
    for _ in range(min(len(things) // 20, 8)):
        outer = [choose(range(len(things)), key=lambda at: things[at][corner][axis]) for axis in (0, 1) for corner, choose in ((0, min), (1, max))]
        rest = min((things[:at] + things[at + 1:] for at in outer), key=side)
        if 2.0 * side(rest) > side(things):
            break
        things, beyond = rest, beyond + 1
    low, high = around(things)
    low, high = np.minimum(low, (low + high) / 2 - 1.0), np.maximum(high, (low + high) / 2 + 1.0)
    if ground:
        low = np.minimum(low, np.maximum(low - MARGIN, np.min(ground, axis=0)))
        high = np.maximum(high, np.minimum(high + MARGIN, np.max(ground, axis=0)))
    return low, high, beyond


def draw_route(axes, thing):
    edge, stops = PAINTS[thing["class"]][1], np.array(thing["route"])
    line = stops if not thing["loop"] or len(stops) < 3 else np.vstack([stops, stops[:1]])
    axes.plot(line[:, 0], line[:, 1], color=edge, linewidth=1.0, dashes=(6, 4), alpha=0.8)
    axes.plot(*stops[stops[:, 2] > 0.0][:, :2].T, **dot(5, "#ffffff", edge, shape="D"))


def draw_ends(axes, start, goal):
    axes.plot(*goal, **GOAL)
    axes.plot(*goal, **dot(6, "#d00000"))
    axes.plot(*start[:2], **dot(14, "#ffffff", "#000000"))
    axes.plot(*start[:2], **dot(10, WAY, shape=(3, 0, math.degrees(start[2]) - 90.0)))
    for name, at in (("start", start), ("goal", goal)):
        fits = at[0] < axes.get_xlim()[1] - 0.1 * np.ptp(axes.get_xlim())
        axes.annotate(name, at[:2], (10 if fits else -10, 6), textcoords="offset points", ha="left" if fits else "right", weight="bold",
                      path_effects=[patheffects.withStroke(linewidth=3, foreground="#ffffff")])


class Seen:
    """What is drawn of a world: outlines of what stands and of what moves, and what must be in the picture."""

    def __init__(self, found):
        floor, cut = found["floor z m"], found["floor z m"] + found["headroom m"]
        self.standing, self.moving, bounds, ground, needed = [], [], [], [], [found["start x m, y m, yaw rad"][:2], found["goal x m, y m"]]
        for thing in found["things"]:
            outlines = outlines_of(thing, floor, cut)
            (self.moving if thing["route"] else self.standing).extend(outlines)
            ground += [corner for one in outlines if one.look == "floor" for corner in (one.low, one.high)]
            solid = [one for one in outlines if one.look != "floor"]
            if solid:
                bounds.append((np.min([one.low for one in solid], axis=0), np.max([one.high for one in solid], axis=0)))
            needed += [stop[:2] for stop in thing["route"]]
        self.low, self.high, self.beyond = shown_area(bounds, ground, needed)


def draw_outlines(axes, outlines, scale, layer):
    """From below, and what hangs at last."""
    strokes = [stroke for one in sorted(outlines, key=lambda one: (one.hangs, one.top)) for stroke in one.strokes(scale)]
    if strokes:
        paths, fills, edges, widths, dashes = zip(*strokes)
        axes.add_collection(PathCollection(paths, facecolors=fills, edgecolors=edges, linewidths=[0.72 * wide for wide in widths], linestyles=dashes,
                                           zorder=layer), autolim=False)


def draw_ways(axes, way, driven):
    if way:
        axes.plot(*np.transpose(way["path"]), color=WAY, linewidth=2.2, alpha=0.75, zorder=5)
        axes.plot(*np.reshape(way["turns"], (-1, 2)).T, zorder=5, **TURN)
    for colour, dashes, points in driven:  # white below, so that a way is seen on all that it crosses
        axes.plot(*np.transpose(points), color="#ffffff", linewidth=4.5, zorder=6)
        axes.plot(*np.transpose(points), color=colour, linewidth=2.2, linestyle=dashes, zorder=7)


def world(found, caption, way=None, driven=()):
    """A world cut at the robot's headroom: every thing in the colour of its class, what hangs above the cut dashed, routes with their stops, start
    and goal. \\param found  of world_tool with drawing:=true \\param way  path and turns that a person is led along, of navmesh_tool
    \\param driven  (colour, dashes, points) each, drawn over it"""
    seen, routes = Seen(found), [thing for thing in found["things"] if thing["route"]]
    scale = min(max(1500.0 / (seen.high - seen.low).max(), 4.0), 40.0)
    figure, axes = canvas(seen.low, seen.high, scale)
    far = {0: "", 1: "; one thing lies beyond the picture"}.get(seen.beyond, f"; {seen.beyond} things lie beyond the picture")
    axes.set_title("".join(filter(str.isprintable, found["world"])), loc="left", fontsize=16, pad=24, parse_math=False)
    axes.text(0.0, 1.0, caption + far, transform=axes.transAxes, va="bottom", parse_math=False)
    draw_outlines(axes, seen.standing, scale, 1)
    draw_outlines(axes, seen.moving, scale, 3)
    for thing in routes:
        draw_route(axes, thing)
        axes.plot(*thing["at"], zorder=4, **dot(max(5.0, 0.25 * scale), "#ffffff", PAINTS[thing["class"]][1], shape=(3, 0, math.degrees(thing["yaw"]) - 90.0)))
    draw_ways(axes, way, driven)
    draw_ends(axes, found["start x m, y m, yaw rad"], found["goal x m, y m"])
    legend(axes, [*class_entries(found), *([Line2D([], [], color="#8f4300", dashes=(6, 4), marker="D", markersize=5, markerfacecolor="#ffffff",
                                                   label="route, and a stop")] if routes else []),
                  Line2D([], [], **dot(10, WAY, shape=(3, 0, -90), label="start of the robot")), Line2D([], [], **GOAL),
                  *([Line2D([], [], **{**TURN, "linestyle": "-", "color": WAY, "label": "guide path, and a turn"})] if way else [])])
    return figure


def class_entries(found):
    """How many there are of each class, and doors of docks."""
    counts = {}
    for thing in found["things"]:
        counts.setdefault(thing["class"], []).append(bool(thing["route"]))
    for name, moving in sorted(counts.items(), key=lambda item: list(PAINTS).index(item[0])):
        if name != "floor":
            more = f", {sum(moving)} moving" if any(moving) else ""
            yield Patch(facecolor=PAINTS[name][0], edgecolor=PAINTS[name][1], label=f"{name.replace('_', ' ')} ({len(moving)}{more})")
    if any(thing["class"] == "wall" and [shape["class"] for shape in thing["shapes"]] == ["other"] for thing in found["things"]):
        yield Patch(facecolor=PAINTS["other"][0], edgecolor=PAINTS["other"][1], label="dock door")


# --- a map with its mesh

def mesh(found, cylinders):
    """Obstacles dark, floor light, the mesh with each component in a shade of its own, cylinders (x, y, radius), the path with its turns.
    \\param found  of navmesh_tool with drawing:=true"""
    signs = np.array([list(row.encode()) for row in found["ground"]], np.uint8)
    low = np.array(found["origin m"])
    high = low + np.array(signs.shape[::-1]) * found["cell m"]
    colours = np.zeros((256, 3), np.uint8)
    for sign, colour in GROUND.items():
        colours[ord(sign)] = colour
    figure, axes = canvas(low - 0.5, high + 0.5, min(20.0, 3000.0 / (high - low).max()))
    axes.set_facecolor([level / 255 for level in GROUND[" "]])
    axes.imshow(colours[signs], extent=(low[0], high[0], low[1], high[1]), origin="lower", interpolation="none", aspect="auto")
    axes.set(xlim=(low[0] - 0.5, high[0] + 0.5), ylim=(low[1] - 0.5, high[1] + 0.5))
    axes.add_collection(PolyCollection([corners for _, corners in found["mesh"]], facecolors=[SHADES[part % len(SHADES)] for part, _ in found["mesh"]],
                                       edgecolors="#05606b", linewidths=0.5), autolim=False)
    for x, y, radius in cylinders:
        axes.add_patch(Circle((x, y), radius, facecolor="#ff9a3c", edgecolor="#7a3d00", linewidth=0.8))
    entries = [Patch(facecolor=[level / 255 for level in GROUND[sign]], label=name) for sign, name in ((".", "floor"), ("#", "obstacle"))]
    entries += [Patch(facecolor=SHADES[0], edgecolor="#05606b", label="mesh, its parts in shades")] if found["mesh"] else []
    entries += [Patch(facecolor="#ff9a3c", edgecolor="#7a3d00", label="moving thing")] if cylinders else []
    if found.get("path"):
        axes.plot(*np.transpose(found["path"]), color=WAY, linewidth=3.5)
        axes.plot(*np.reshape(found["turns"], (-1, 2)).T, **TURN)
        for at, colour, name in ((found["path"][0], "#1fa340", "start"), (found["path"][-1], "#e01020", "goal")):
            axes.plot(*at, **dot(11, colour, "#ffffff"))
            entries.append(Line2D([], [], **dot(11, colour, label=name)))
        entries.append(Line2D([], [], **{**TURN, "linestyle": "-", "color": WAY, "label": "guide path, and a turn"}))
    axes.plot(0.0, 0.0, **dot(12, "#000000", "#000000", shape="+"))
    axes.annotate("0, 0", (0.0, 0.0), (4, 4), textcoords="offset points")
    legend(axes, entries)
    return figure
