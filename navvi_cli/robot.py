"""What comes of a robot's topics and transforms. Only `listen` needs ROS."""
import ast
import math
import os
import signal
import statistics
import struct
import time
from collections import Counter, namedtuple

from .say import fail
from .session import has_pad

SCAN, CLOUD, ODOMETRY = "sensor_msgs/LaserScan", "sensor_msgs/PointCloud2", "nav_msgs/Odometry"
GRID, JOY, TWIST = "nav_msgs/OccupancyGrid", "sensor_msgs/Joy", "geometry_msgs/Twist"
BOOL, BATTERY = "std_msgs/Bool", "sensor_msgs/BatteryState"
RADII = {"perception/robot_radius": "/perception_node/robot_radius", "nav/mesh/robot_radius": "/nav_node/mesh/robot_radius"}


class Times:
    """When messages came and what their stamps were, in s of ROS time."""

    def __init__(self):
        self.came, self.ages = [], []

    def take(self, now, stamp):
        self.came.append(now)
        if stamp:
            self.ages.append(now - stamp)

    @property
    def rate(self):
        span = self.came[-1] - self.came[0] if self.came else 0.0
        return (len(self.came) - 1) / span if span > 0.0 else 0.0

    @property
    def age(self):
        return statistics.median(self.ages) if self.ages else 0.0


class Topic:
    """Its last message, and what rays or points of all of them held."""

    def __init__(self, kind):
        self.kind, self.last, self.times, self.returns = kind, None, Times(), Counter()

    def take(self, message, now):
        self.last = message
        self.times.take(now, message.header.stamp.to_sec())
        if self.kind == SCAN:
            self.returns.update(return_of(value, message) for value in message.ranges)
        elif self.kind == CLOUD:
            self.returns.update("measured" if all(map(math.isfinite, point)) else "not finite" for point in points_of(message))

    @property
    def frame(self):
        return self.last.header.frame_id.lstrip("/")


def return_of(value, scan):
    if math.isnan(value):
        return "NaN"
    if math.isinf(value):
        return "+inf"
    if value >= scan.range_max:
        return "range_max and more"
    return "measured" if value >= max(scan.range_min, 1e-6) else "0" if value == 0.0 else "below range_min"


def points_of(cloud, most=2000):
    """x, y and z of `most` of its points, evenly spread."""
    fields = {field.name: (field.offset, {7: "f", 8: "d"}.get(field.datatype)) for field in cloud.fields}
    if not all(fields.get(axis, (0, None))[1] for axis in "xyz"):
        return
    count, packed, order = cloud.width * cloud.height, cloud.width * cloud.point_step, ">" if cloud.is_bigendian else "<"
    row = packed if len(cloud.data) == packed * cloud.height else cloud.row_step
    for i in range(0, count, count // most + 1):
        at = i // cloud.width * row + i % cloud.width * cloud.point_step
        yield tuple(struct.unpack_from(order + kind, cloud.data, at + offset)[0] for offset, kind in map(fields.get, "xyz"))


class Frames:
    """The tree of /tf and /tf_static; `edges` and `parents` go by child."""
    Edge = namedtuple("Edge", "parent fixed times publishers matrix")

    def __init__(self):
        self.edges, self.parents = {}, {}

    def take(self, message, publisher, fixed, now):
        for one in message.transforms:
            parent, child = one.header.frame_id.lstrip("/"), one.child_frame_id.lstrip("/")
            self.parents.setdefault(child, {})[parent] = publisher
            before = self.edges.get(child)
            times, publishers = (before.times, before.publishers) if before else (Times(), set())
            times.take(now, one.header.stamp.to_sec())
            publishers.add(publisher)
            self.edges[child] = self.Edge(parent, fixed, times, publishers, matrix_of(one.transform.rotation, one.transform.translation))

    def up(self, frame):
        """The frame and those above it."""
        names = [frame]
        while names[-1] in self.edges and self.edges[names[-1]].parent not in names:
            names.append(self.edges[names[-1]].parent)
        return names

    def pose(self, frame, parent):
        """The matrix from `frame` to `parent`; None where nothing joins them."""
        if self.up(frame)[-1] != self.up(parent)[-1]:
            return None
        return product(inverse(self.in_root(parent)), self.in_root(frame))

    def in_root(self, frame):
        out = [[float(row == column) for column in range(4)] for row in range(4)]
        for name in reversed(self.up(frame)[:-1]):
            out = product(out, self.edges[name].matrix)
        return out


def matrix_of(rotation, at):
    x, y, z, w = rotation.x, rotation.y, rotation.z, rotation.w
    return [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), at.x],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), at.y],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y), at.z], [0.0, 0.0, 0.0, 1.0]]


def product(a, b):
    return [[sum(a[row][k] * b[k][column] for k in range(4)) for column in range(4)] for row in range(4)]


def inverse(matrix):
    """Of a rotation and a translation."""
    back = [[matrix[column][row] for column in range(3)] for row in range(3)]
    return [[*row, -sum(row[k] * matrix[k][3] for k in range(3))] for row in back] + [[0.0, 0.0, 0.0, 1.0]]


def flat(matrix, x, y):
    return matrix[0][0] * x + matrix[0][1] * y + matrix[0][3], matrix[1][0] * x + matrix[1][1] * y + matrix[1][3]


def reach_of(footprint):
    """m, from base_frame to the farthest corner; 0 for what is no polygon. A list, or a text that holds one, as costmap_2d takes it."""
    try:
        corners = ast.literal_eval(footprint) if isinstance(footprint, str) else footprint
        return max(math.hypot(*corner) for corner in corners)
    except (SyntaxError, TypeError, ValueError):
        return 0.0


class Robot:
    """What came of it, and `words`: robot.launch's arguments, with their defaults where they are not `given`."""

    def __init__(self, words, given=()):
        self.words, self.given = words, given
        self.topics, self.frames = {}, Frames()
        self.kinds, self.publishers, self.takers = {}, {}, {}  # by topic
        self.radii = {name: float(words.get(name, words["radius"])) for name in RADII}
        self.reaches = {}  # m: of the polygons that a costmap has as footprint, by parameter
        self.has_pad = False

    def names(self, part):
        return [resolved(name) for name in self.words[part].split(",") if name.strip()]

    def topic(self, name):
        """None where no message came."""
        return self.topics.get(name)

    def wanted(self):
        """The topics to be heard, with their types."""
        kinds = {"scan": SCAN, "points": CLOUD, "odom": ODOMETRY, "map": GRID}
        return {"/joy": JOY} | {name: kind for part, kind in kinds.items() for name in self.names(part)}

    def take(self, name, kind, message, now):
        self.topics.setdefault(name, Topic(kind)).take(message, now)

    def scan_points(self, frame):
        """x and y in `frame`, in m, of what the last scans measured."""
        for name in self.names("scan"):
            topic = self.topic(name)
            pose = topic and self.frames.pose(topic.frame, frame)
            for ray, value in enumerate(topic.last.ranges if pose else []):
                if return_of(value, topic.last) == "measured":
                    angle = topic.last.angle_min + ray * topic.last.angle_increment
                    yield flat(pose, value * math.cos(angle), value * math.sin(angle))


def resolved(name):
    return "/" + name.strip().lstrip("/")


def listen(robot, seconds):
    """Fills it from a master for so long."""
    import rosgraph
    import rospy
    import roslib.message
    from tf2_msgs.msg import TFMessage
    os.environ.setdefault("ROS_MASTER_URI", "http://localhost:11311")
    master = rosgraph.Master("/robot_check")
    if not master.is_online():
        fail(f"no ROS master answers at {os.environ['ROS_MASTER_URI']}; start the robot's drivers, or set ROS_MASTER_URI as they have it.", 2)
    signal.signal(signal.SIGPIPE, signal.SIG_IGN)  # a master or a driver may end meanwhile
    rospy.init_node("robot_check", argv=[], anonymous=True, disable_signals=True)  # a word such as scan:=/front would rename /scan
    for name, kind in robot.wanted().items():
        rospy.Subscriber(name, roslib.message.get_message_class(kind),
                         lambda message, of=(name, kind): robot.take(*of, message, rospy.get_time()), queue_size=50)
    for name, fixed in (("/tf", False), ("/tf_static", True)):
        rospy.Subscriber(name, TFMessage, lambda message, fixed=fixed: robot.frames.take(
            message, message._connection_header["callerid"], fixed, rospy.get_time()), queue_size=200)
    time.sleep(seconds)
    if not master.is_online():
        fail(f"the ROS master at {os.environ['ROS_MASTER_URI']} ended meanwhile; one that runs for {seconds} s is needed.", 2)
    publishers, takers, _ = master.getSystemState()
    own = rospy.get_name()
    robot.kinds = {name: kind for name, kind in master.getTopicTypes() if kind != "*"}
    robot.publishers = dict(publishers)
    robot.takers = {name: [node for node in nodes if node != own] for name, nodes in takers}
    for name, parameter in RADII.items():
        if rospy.has_param(parameter):
            robot.radii[name] = float(rospy.get_param(parameter))
    robot.reaches = {name: reach_of(rospy.get_param(name)) for name in rospy.get_param_names() if name.endswith("/footprint")}
    robot.has_pad = has_pad()
