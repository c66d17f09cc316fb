"""Judges what came of a robot: a line for each part that robot.launch needs (doc/robot.md, "Requirements")."""
import math
from collections import namedtuple

from .robot import BATTERY, BOOL, CLOUD, GRID, JOY, ODOMETRY, SCAN, TWIST, flat, inverse, matrix_of, resolved

WELL, LOOK, WRONG = "well", "look", "wrong"
AHEAD, OLD, LATE = 0.2, 1.0, 0.3  # s: perception_node drops beyond the first two, a stick is slow beyond the last
SLACK = 0.9                       # of a rate: some seconds hold a message more or less
NEEDED = {"scan": f"{SCAN} at 5 Hz or more, in a frame of TF", "points": f"{CLOUD} at 5 Hz or more, in a frame of TF",
          "odom": f"{ODOMETRY} at 10 Hz or more, in odom_frame", "tf": "map_frame, odom_frame and base_frame in one tree",
          "map": f"{GRID} in map_frame, optional", "footprint": "one radius about base_frame that holds all of the robot",
          "stick": f"a pad here, or with input:=topic {JOY} on /joy", "wheels": f"a node that takes {TWIST}, and no other that gives it",
          "emergency_stop": f"{BOOL}, optional", "bumper": f"{BOOL}, optional", "battery": f"{BATTERY}, optional"}
OPTIONAL = {"emergency_stop": BOOL, "bumper": BOOL, "battery": BATTERY}  # often silent until something changes


class Line(namedtuple("Line", "part verdict found todo", defaults=[""])):
    def __str__(self):
        return f"{self.part}: {self.verdict}. Found: {self.found}. Needed: {NEEDED[self.part]}." + (f" To do: {self.todo}." if self.todo else "")


def lines(robot):
    return [*sensors(robot), odometry(robot), transforms(robot), prior_map(robot), footprint(robot), stick(robot), wheels(robot),
            *(optional(robot, part, robot.words[part]) for part in OPTIONAL if robot.words[part])]


def silent(robot, part, name, kind):
    """Why no message of a topic came."""
    has = robot.kinds.get(name) if robot.publishers.get(name) else None
    others = sorted(other for other, of in robot.kinds.items() if of == kind and other != name and robot.publishers.get(other))
    instead = f"{part}:={others[0]}" if others and part != "stick" else ""
    if has == kind:
        return Line(part, WRONG, f"{name} has a publisher, and no message came",
                    "look at its driver; where that is on another computer, at ROS_IP or ROS_HOSTNAME there")
    return Line(part, WRONG, f"{name} is a {has}" if has else f"nothing publishes {name}", instead or f"start what publishes {kind} there")


def clock_fault(times):
    if len(times.ages) < len(times.came):
        return "its driver has to stamp its messages"
    if not -AHEAD <= times.age <= OLD:
        return f"keep the clocks of all computers together, or find the delay: at most {OLD:.0f} s old and {AHEAD} s ahead is allowed"
    return ""


def said(name, times):
    return f"{name}, {times.rate:.1f} Hz, age {times.age:.2f} s"


def rate_fault(times, least):
    return f"{least:.0f} Hz are needed: look at its driver and the network" if times.rate < SLACK * least else ""


def sensors(robot):
    """One topic with ranges is enough: one that nobody names or publishes is no fault beside another."""
    named = [(part, name) for part in ("scan", "points") for name in robot.names(part)]
    present = [(part, name) for part, name in named if part in robot.given or robot.publishers.get(name)]
    return [sensor(robot, *one) for one in present or named]


def sensor(robot, part, name):
    topic, base, free = robot.topic(name), robot.words["base_frame"], robot.words.get("perception/no_return") == "free"
    if not topic:
        return silent(robot, part, name, CLOUD if part == "points" else SCAN)
    pose, held, total = robot.frames.pose(topic.frame, base), topic.returns, sum(topic.returns.values())
    found = f"{said(name, topic.times)}, frame {topic.frame}" + (f" {pose[2][3]:.2f} m above {base}" if pose else "")
    found += f", sweep {(len(topic.last.ranges) - 1) * topic.last.time_increment:.2f} s, rays " if part == "scan" else ", points "
    found += ", ".join(f"{what} {100 * count / total:.0f} %" for what, count in held.most_common()) or "none"
    todo = clock_fault(topic.times) or rate_fault(topic.times, 5.0)
    if not todo and not pose:
        todo = f"no transform joins {topic.frame} and {base}: publish the sensor's place, such as by static_transform_publisher"
    if not todo and not free and not held["measured"] + held["+inf"]:
        todo = "nothing was measured: uncover the sensor, or, where its driver means by it that nothing is near, perception/no_return:=free"
    if todo:
        return Line(part, WRONG, found, todo)
    lost = total - held["measured"] - held["+inf"] - held["below range_min"]
    if part == "scan" and not free and not held["+inf"] and lost > 0.05 * total:
        return Line(part, LOOK, found, "in the open all rays are such, and sensing is lost, unless perception/no_return:=free (doc/robot.md, table of drivers)")
    return Line(part, WELL, found)


def odometry(robot):
    name, frame = resolved(robot.words["odom"]), robot.words["odom_frame"]
    topic = robot.topic(name)
    if not topic:
        return silent(robot, "odom", name, ODOMETRY)
    todo = clock_fault(topic.times) or rate_fault(topic.times, 10.0) or (f"odom_frame:={topic.frame}" if topic.frame != frame else "")
    return Line("odom", WRONG if todo else WELL, f"{said(name, topic.times)}, frame {topic.frame}", todo)


def transforms(robot):
    frames, names, found = robot.frames, [robot.words[f"{name}_frame"] for name in ("map", "odom", "base")], []
    todo = [f"{child} has several parents ({', '.join(f'{parent} by {node}' for parent, node in sorted(parents.items()))}), and one is allowed"
            for child, parents in sorted(frames.parents.items()) if len(parents) > 1]
    makers = "a localizer such as amcl, or without a map static_transform_publisher", "the driver of the wheels"
    for parent, child, maker, least in zip(names, names[1:], makers, (0.0, 5.0)):
        up = frames.up(child)
        if parent not in up:
            todo.append(f"{parent} -> {child} is missing: it comes from {maker}")
            continue
        moving = [frames.edges[name] for name in up[:up.index(parent)] if not frames.edges[name].fixed]
        slowest = min((edge.times for edge in moving), key=lambda times: times.rate, default=None)
        found.append(said(f"{parent} -> {child}", slowest) if slowest else f"{parent} -> {child}, fixed")
        for edge in moving:
            nodes = sorted(edge.publishers)
            several = f"it comes from {' and '.join(nodes)}, and one is allowed" if len(nodes) > 1 else ""
            # Localizers stamp ahead, and hold their place for as long as they see no reason to move it.
            fault = several or (clock_fault(edge.times) if least else "") or rate_fault(edge.times, least)
            todo += [f"{parent} -> {child}: {fault}"] if fault else []
    return Line("tf", WRONG if todo else WELL, "; ".join(found) or "no part of it", "; ".join(todo))


def prior_map(robot):
    name, frame = resolved(robot.words["map"]), robot.words["map_frame"]
    topic = robot.topic(name)
    if not topic and robot.publishers.get(name):
        return silent(robot, "map", name, GRID)._replace(verdict=LOOK)
    if not topic:
        return Line("map", LOOK, f"nothing publishes {name}", "without a map only seen floor is floor, and a goal beyond it has to be chosen twice")
    info = topic.last.info
    found = f"{name}, {info.width} x {info.height} cells of {info.resolution:.2f} m, frame {topic.frame}"
    if topic.frame != frame:
        return Line("map", WRONG, found, f"map_frame:={topic.frame}")
    share = on_walls(robot, topic.last)
    if share is None:
        return Line("map", WELL, found)
    found += f", {100 * share:.0f} % of the scans lie on its walls"
    return Line("map", WELL, found) if share > 0.5 else Line("map", LOOK, found, "where the robot's place is right, most of a scan does: tell the localizer "
                                                             "the place, or take the map of this floor")


def on_walls(robot, grid, within=0.2):
    """The share of what scans measured that is occupied, or so near to it, in m; None where there is none."""
    side, origin = grid.info.resolution, inverse(matrix_of(grid.info.origin.orientation, grid.info.origin.position))
    reach, on = math.ceil(within / side), []
    for point in robot.scan_points(robot.words["map_frame"]):
        column, row = (int(value // side) for value in flat(origin, *point))
        on.append(any(grid.data[j * grid.info.width + i] >= 65 for j in range(max(row - reach, 0), min(row + reach + 1, grid.info.height))
                      for i in range(max(column - reach, 0), min(column + reach + 1, grid.info.width))))
    return sum(on) / len(on) if on else None


def footprint(robot):
    seen, body = robot.radii.values()
    gaps = sorted(math.hypot(x, y) for x, y in robot.scan_points(robot.words["base_frame"]))
    own = sum(gap <= seen for gap in gaps)
    found = f"radius {seen:.2f} m" + (f", {own} points of the scans within it, which are left out as the robot's own" if own else "")
    found += f", the next at {gaps[own]:.2f} m" if own < len(gaps) else ""
    if seen != body:
        return Line("footprint", WRONG, f"{found}, but for paths {body:.2f} m", "give both by radius:=")
    for name, reach in robot.reaches.items():
        if reach > body:
            return Line("footprint", WRONG, f"{found}, but the polygon of {name} reaches {reach:.2f} m", f"give radius:={math.ceil(100 * reach) / 100}")
    if own < len(gaps) and gaps[own] < seen + 0.1:
        return Line("footprint", LOOK, found, "if that is a part of the robot, give a larger radius:=")
    return Line("footprint", WELL, found)


def stick(robot):
    source = robot.words["input"]
    if source != "topic":
        if robot.has_pad and source != "keyboard":
            return Line("stick", WELL, "a pad at this computer")
        return Line("stick", WRONG if source == "pad" else LOOK, "no pad at this computer" if source != "keyboard" else "the keyboard",
                    "attach a pad" if source == "pad" else "the keyboard drives, and its window needs a display")
    topic = robot.topic("/joy")
    if not topic and robot.publishers.get("/joy"):
        return Line("stick", LOOK, "/joy is silent", "push the stick, or let its driver repeat, such as joy_node with autorepeat_rate:=20")
    if not topic:
        return silent(robot, "stick", "/joy", JOY)
    fault = clock_fault(topic.times) if topic.times.ages else ""
    if not fault and abs(topic.times.age) > LATE:
        fault = f"more than {LATE} s late the robot is slow: find the delay"
    return Line("stick", WRONG if fault else WELL, f"{said('/joy', topic.times)}, {len(topic.last.axes)} axes, {len(topic.last.buttons)} buttons", fault)


def wheels(robot):
    name = resolved(robot.words["wheels"])
    takers, others = robot.takers.get(name, []), [node for node in robot.publishers.get(name, []) if node != "/relay_node"]
    if robot.kinds.get(name, TWIST) != TWIST:
        return Line("wheels", WRONG, f"{name} is a {robot.kinds[name]}", "its driver has to take Twist")
    if not takers:
        return Line("wheels", WRONG, f"nothing takes {name}", "start the driver of the wheels, or give its topic by wheels:=")
    found = f"{name}, taken by {', '.join(takers)}"
    if others:
        return Line("wheels", WRONG, f"{found}, published by {', '.join(others)}", "end these: relay_node alone may move the wheels")
    return Line("wheels", WELL, found)


def optional(robot, part, name):
    name = resolved(name)
    nodes = robot.publishers.get(name)
    if not nodes or robot.kinds.get(name) != OPTIONAL[part]:
        return silent(robot, part, name, OPTIONAL[part])
    return Line(part, WELL, f"{name}, published by {', '.join(nodes)}")
