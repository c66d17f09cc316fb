"""A robot that stands in a room of 8 m x 6 m, whose lidar's driver, odometry and mapper have the habits of real ones.

usage: fake_robot.py KEY=VALUE..., with the keys of HABITS"""
import itertools
import math
import sys
import threading

import rospy
from geometry_msgs.msg import TransformStamped, Twist
from nav_msgs.msg import OccupancyGrid, Odometry
from sensor_msgs.msg import LaserScan
from tf2_msgs.msg import TFMessage

RAYS, HALF_X, HALF_Y = 360, 4.0, 3.0
HABITS = {"scan_hz": 10.0, "odom_hz": 50.0, "sweep": 0.0,  # s, from the first ray to the last
          "stamp": "first",  # ray's, or sent
          "deliver": 0.0,  # s, from the last ray to the message
          "lag": 0.0,  # s, by which odometry is old
          "none": "inf", "range_max": 10.0, "sees": 100.0,  # m, farther it measures nothing
          "frame": "laser",
          "place_hz": 0.0, "jump": 0.0,  # m, of a localizer at each of its corrections, to and fro; 0 Hz: map -> odom is fixed
          "map_hz": 0.0, "map_yaw": 0.0, "map_w": 1.0}  # of the origin's quaternion, where it is not turned
NO_RETURN = {"inf": math.inf, "nan": math.nan, "zero": 0.0, "over": 11.0}


def transform(parent, child, z, stamp, x=0.0):
    out = TransformStamped(child_frame_id=child)
    out.header.frame_id, out.header.stamp = parent, stamp
    out.transform.translation.x, out.transform.translation.z, out.transform.rotation.w = x, z, 1.0
    return out


def scan_of(habits, now):
    scan = LaserScan(angle_increment=2 * math.pi / RAYS, range_min=0.1, range_max=habits["range_max"])
    scan.header.frame_id = habits["frame"]
    scan.header.stamp = now - rospy.Duration(habits["sweep"] if habits["stamp"] == "first" else 0.0)
    scan.time_increment = habits["sweep"] / (RAYS - 1)
    for ray in range(RAYS):
        x, y = (abs(turn(ray * scan.angle_increment)) for turn in (math.cos, math.sin))
        met = min(HALF_X / max(x, 1e-9), HALF_Y / max(y, 1e-9))
        scan.ranges.append(met if met < min(scan.range_max, habits["sees"]) else NO_RETURN[habits["none"]])
    return scan


def map_of(habits, now):
    grid = OccupancyGrid()
    grid.header.frame_id, grid.header.stamp = "map", now
    grid.info.resolution, grid.info.width, grid.info.height = 0.1, 82, 62
    yaw = habits["map_yaw"]
    middle = (4.1, 3.1)  # of the grid, which is the robot's place
    grid.info.origin.position.x = -(math.cos(yaw) * middle[0] - math.sin(yaw) * middle[1])
    grid.info.origin.position.y = -(math.sin(yaw) * middle[0] + math.cos(yaw) * middle[1])
    grid.info.origin.orientation.z, grid.info.origin.orientation.w = math.sin(yaw / 2), habits["map_w"] * math.cos(yaw / 2)
    grid.data = [100 if x in (0, 81) or y in (0, 61) else 0 for y in range(62) for x in range(82)]
    return grid


def main(words):
    habits = dict(HABITS)
    for key, value in (word.split("=", 1) for word in words):
        habits[key] = type(habits[key])(value)
    rospy.init_node("fake_robot")
    scans, odometry = rospy.Publisher("/scan", LaserScan, queue_size=1), rospy.Publisher("/odom", Odometry, queue_size=1)
    maps = rospy.Publisher("/map", OccupancyGrid, queue_size=1, latch=True)
    moving = rospy.Publisher("/tf", TFMessage, queue_size=5)
    rospy.Subscriber("/cmd_vel", Twist, lambda _: None)
    fixed = rospy.Publisher("/tf_static", TFMessage, queue_size=1, latch=True)
    lidar, sides = transform("base_link", "laser", 0.2, rospy.Time.now()), itertools.cycle((0.0, habits["jump"]))
    fixed.publish([lidar] if habits["place_hz"] else [transform("map", "odom", 0.0, rospy.Time.now()), lidar])
    if habits["place_hz"]:
        rospy.Timer(rospy.Duration(1 / habits["place_hz"]), lambda _: moving.publish(
            [transform("map", "odom", 0.0, rospy.Time.now(), next(sides))]))
    if habits["map_hz"]:
        rospy.Timer(rospy.Duration(1 / habits["map_hz"]), lambda _: maps.publish(map_of(habits, rospy.Time.now())))

    def measure(_):
        threading.Timer(habits["deliver"], scans.publish, [scan_of(habits, rospy.Time.now())]).start()

    def move(_):
        stamp = rospy.Time.now() - rospy.Duration(habits["lag"])
        moving.publish([transform("odom", "base_link", 0.0, stamp)])
        told = Odometry(child_frame_id="base_link")
        told.header.stamp, told.header.frame_id, told.pose.pose.orientation.w = stamp, "odom", 1.0
        odometry.publish(told)

    rospy.Timer(rospy.Duration(1 / habits["odom_hz"]), move)
    rospy.Timer(rospy.Duration(1 / habits["scan_hz"]), measure)
    rospy.spin()


if __name__ == "__main__":
    main(sys.argv[1:])
