"""What the pictures of worlds and meshes show, without a program that describes them."""
import numpy as np
import pytest

from navvi_cli import maps

CORNERS = np.array([[x, y, z] for z in (-.5, .5) for y in (-.5, .5) for x in (-.5, .5)])


def box(look, centre, size, yaw=0.0):
    turn = np.array([[np.cos(yaw), -np.sin(yaw), 0], [np.sin(yaw), np.cos(yaw), 0], [0, 0, 1]])
    return {"class": look, "points": (CORNERS * size @ turn.T + centre).tolist(), "triangles": []}


def mesh(look, points, triangles):
    return {"class": look, "points": points, "triangles": triangles}


def thing(look, *shapes, route=(), at=(0, 0), yaw=0.0):
    return {"class": look, "at": list(at), "yaw": yaw, "shapes": list(shapes), "route": list(route), "loop": True}


def world(*things, name="hall", start=(1, 2, 0.5), goal=(4, 2)):
    return {"world": name, "floor z m": 0.0, "headroom m": 0.8, "start x m, y m, yaw rad": list(start), "goal x m, y m": list(goal), "things": list(things)}


def seen(shape, *more, look="other"):
    return maps.outlines_of(thing(look, shape, *more), 0.0, 0.8)


def words(figure):
    axes, = figure.axes
    return [text.get_text() for text in [*axes.texts, *axes.get_legend().get_texts(), axes.title, *(axes._left_title,)]]


def size(figure):
    axes, = figure.axes
    return [np.ptp(axes.get_xlim()), np.ptp(axes.get_ylim())]


def test_a_box_is_drawn_as_it_lies_in_the_colour_of_its_class():
    outline, = seen(box("box", (3, 0, 0.5), (2, 1, 1), yaw=np.pi / 2))
    assert np.allclose(sorted(outline.rings[0].tolist()), [[2.5, -1], [2.5, 1], [3.5, -1], [3.5, 1]])
    strokes = [*outline.strokes(20.0)]
    assert strokes[0][1:3] == maps.PAINTS["box"] and len(strokes) == 2, "its tape"
    (path, fill, *_), = [*seen(box("shelf", (0, 0, 1), (1, 1, 2)))[0].strokes(20.0)]
    assert fill == maps.PAINTS["shelf"][0] and path.contains_point((0.4, 0.4)) and not path.contains_point((0.6, 0.0))


def test_what_is_driven_over_looks_like_floor_and_what_rises_from_a_floor_like_a_wall():
    assert seen(box("other", (0, 0, 0.01), (1, 1, 0.02)))[0].look == "floor"
    assert [one.look for one in seen(box("floor", (0, 0, -0.05), (9, 9, 0.1)), box("floor", (0, 4, 1), (9, 0.2, 2)))] == ["floor", "wall"]


def test_what_hangs_is_dashed_unless_it_stands_on_a_board_below():
    roof, = seen(box("other", (0, 0, 5), (9, 9, 0.1)))
    (_, fill, _, _, dashes), = roof.strokes(20.0)
    assert roof.hangs and fill == "none" and dashes != "solid"
    rack = seen(box("shelf", (0, 0, 0.2), (2, 1, 0.4)), box("shelf", (0, 0, 1.5), (2, 1.2, 0.1)))
    assert [one.hangs for one in rack] == [False], "the upper board hides the lower one"


def test_a_mesh_is_cut_at_headroom():
    points = [(0, 0, 0), (4, 0, 0), (0, 4, 0), (0, 0, 3), (4, 0, 3), (0, 4, 3)]  # a floor, half a wall, a roof
    for x, y in ((2, 1), (2.2, 1), (2.1, 1.2)):  # and a post
        points += [(x, y, 0), (x, y, 2)]
    post = [side for a, b in ((6, 8), (8, 10), (10, 6)) for side in ((a, b, b + 1), (a, b + 1, a + 1))]
    low, body, high = seen(mesh("other", points, [(0, 1, 2), (0, 1, 4), (3, 4, 5), *post]))
    assert (low.look, body.look, high.hangs) == ("floor", "other", True)
    assert len(body.solid) == 1 and len(body.rings) == 0, "the post is filled, its sides are lines"
    assert sorted(map(tuple, np.round(body.solid[0][:-1], 3)))[0] == (2, 1)
    assert np.allclose(high.rings[0], [(0, 0), (4, 0), (0, 4)])


def test_a_hole_in_a_mesh_stays_open():
    outer, inner = [np.array([(-s, -s), (s, -s), (s, s), (-s, s)], float) for s in (2, 1)]
    for rings in ([outer, inner], [inner, outer[::-1]]):
        assert sorted(maps.area(ring) for ring in maps.turned(rings)) == [-4, 16], "it runs the other way round"


def test_sections_join_to_rings_and_lines():
    rings, lines = maps.chained([[(0, 0), (1, 0)], [(1, 1), (1, 0)], [(1, 1), (0, 0)], [(5, 0), (6, 0)], [(6, 0), (7, 0)]])
    assert len(rings) == 1 and len(rings[0]) == 4 and len(lines) == 1 and len(lines[0]) == 3


def test_a_picture_names_the_world_its_classes_start_goal_and_way():
    hall = world(thing("floor", box("floor", (0, 0, -0.5), (20, 10, 1))), thing("shelf", box("shelf", (0, 3, 1), (4, 1, 2))),
                 thing("wall", box("other", (0, 5, 1), (2, 0.1, 2))),
                 thing("forklift", box("forklift", (5, 0, 1), (2, 1, 2)), route=[[5, 0, 0], [5, 3, 2.5]], at=(5, 0)))
    found = words(maps.world(hall, "seed 1", {"path": [[1, 2], [2, 3], [4, 2]], "turns": [[2, 3]]}))
    for word in ("hall", "seed 1", "start", "goal", "shelf (1)", "forklift (1, 1 moving)", "dock door", "route, and a stop", "guide path, and a turn"):
        assert word in found, found
    assert "guide path, and a turn" not in words(maps.world(hall, "seed 1")), "no way leads there"


def test_the_picture_is_not_shrunk_by_a_thing_that_lies_far_from_all_others():
    near = [thing("box", box("box", (i % 8 - 4, i // 8 - 4, 0.5), (0.3, 0.3, 1))) for i in range(40)]
    ground = thing("floor", box("floor", (0, 0, -0.5), (300, 300, 1)))
    far = thing("box", box("box", (125, 0, 0.5), (1, 1, 1)))
    small, large = maps.world(world(ground, *near), "a"), maps.world(world(ground, *near, far), "a")
    assert size(small) == size(large) and "a; one thing lies beyond the picture" in words(large)
    whole = maps.world(world(ground, *near, far, goal=(125, 2)), "a")
    assert size(whole)[0] > 120 and "a" in words(whole)


def test_pictures_are_the_same_each_time_and_no_name_breaks_them(tmp_path):
    for name in ("a.svg", "b.svg"):
        maps.save(maps.world(world(name="</svg><script>&\x01"), "$x^$"), tmp_path / name)
    text = (tmp_path / "a.svg").read_text()
    assert text == (tmp_path / "b.svg").read_text() and text.count("</svg>") == 1 and "<script>" not in text


@pytest.mark.parametrize("path", [[], [[0.1, 0.1], [0.5, 0.1]]], ids=["mesh", "path"])
def test_a_mesh_is_drawn_over_its_floor(path, tmp_path):
    found = {"ground": ["..#", ".. "], "origin m": [0, 0], "cell m": 0.5, "mesh": [[0, [[0, 0], [1, 0], [1, 1], [0, 1]]]], "path": path, "turns": []}
    figure = maps.mesh(found, [[0.5, 0.5, 0.2]])
    maps.save(figure, tmp_path / "a.png")
    assert (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")
    assert {"floor", "obstacle", "mesh, its parts in shades", "moving thing", "0, 0"} <= set(words(figure))
    assert ("guide path, and a turn" in words(figure)) == bool(path)
    assert figure.axes[0].images[0].get_array().shape[:2] == (2, 3)
