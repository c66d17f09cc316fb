"""Records of real robots, which others published: where they are, what they lack, and how they are played into robot.launch.

usage: robot_bags.py FOLDER [NAME...]: fetches those that FOLDER lacks, compares their hashes, converts those of ROS 2 (rosbags of PyPI), of a
Velodyne's packets and of a single cloud, and says which are there. `NAVVI_BAGS=FOLDER ./navvi test robot_bags` plays them.
"""
import hashlib
import json
import math
import os
import pathlib
import struct
import subprocess
import sys
import time
import urllib.request
from collections import namedtuple

from sessions import Programs, eventually

FOLDER = pathlib.Path(os.environ.get("NAVVI_BAGS", pathlib.Path.home() / ".cache/navvi/bags"))
TOPICS = ["/scan", "/odom", "/tf", "/tf_static"]  # of a bag of ROS 2

SECONDS, PACE = 15.0, 0.5  # of each that are played, and how fast: others may use the machine, and ages are judged by the bag's clock

# source: owner/repository@commit; fixed: "PARENT CHILD X Z", or with the quaternion after it, of each transform that the bag lacks; words: of
# robot.launch; pace: slower for short ones; convert: of a file that ROS 1 cannot play, (file, bag) -> None.
Bag = namedtuple("Bag", "name source path sha256 licence robot fixed words pace convert", defaults=[PACE, None])


def ros2(file, bag):
    """What a database of ROS 2 holds."""
    subprocess.run(["python3", "-m", "rosbags.convert", "--src", file, "--dst", bag, "--include-topic", *TOPICS], check=True)


def velodyne(file, bag):
    """Clouds of a VLP-16 of the packets in a database of ROS 2, laid out as by velodyne_pointcloud."""
    import sqlite3
    import rosbag
    import rospy
    from sensor_msgs.msg import PointCloud2, PointField
    steep = [math.radians(degrees) for degrees in (-15, 1, -13, 3, -11, 5, -9, 7, -7, 9, -5, 11, -3, 13, -1, 15)]
    fields = [PointField(name, at, kind, 1) for name, at, kind in (("x", 0, 7), ("y", 4, 7), ("z", 8, 7), ("intensity", 12, 7), ("ring", 16, 4), ("time", 18, 7))]
    with rosbag.Bag(str(bag), "w", compression="lz4") as out:
        for data, in sqlite3.connect(str(file)).execute("SELECT data FROM messages ORDER BY timestamp"):
            seconds, nanoseconds, letters = struct.unpack_from("<IiI", data, 4)
            at, points = 4 + (12 + letters + 3) // 4 * 4, []
            for packet in range(struct.unpack_from("<I", data, at)[0]):
                begin = at + 4 + packet * 1216 + 8  # a stamp, 1206 bytes, and 2 that fill up
                for block in range(begin, begin + 1200, 100):
                    turn = -math.radians(struct.unpack_from("<H", data, block + 2)[0] / 100)
                    for ray in range(32):
                        distance, bright = struct.unpack_from("<HB", data, block + 4 + 3 * ray)
                        flat, height = 0.002 * distance * math.cos(steep[ray % 16]), 0.002 * distance * math.sin(steep[ray % 16])
                        if distance:
                            points.append(struct.pack("<4fHf", flat * math.cos(turn), flat * math.sin(turn), height, bright, ray % 16, 0.0))
            cloud = PointCloud2(width=len(points), height=1, fields=fields, point_step=22, row_step=22 * len(points), data=b"".join(points), is_dense=True)
            cloud.header.frame_id, cloud.header.stamp = data[16:16 + letters - 1].decode(), rospy.Time(seconds, nanoseconds)
            out.write("/velodyne_points", cloud, cloud.header.stamp)


def still(file, bag):
    """A cloud that came once, as a camera at 5 Hz sends it that looks at the same for 2 s."""
    import rosbag
    import rospy
    with rosbag.Bag(str(file)) as source, rosbag.Bag(str(bag), "w", compression="lz4") as out:
        topic, cloud, _ = next(source.read_messages())
        for i in range(10):
            cloud.header.stamp = rospy.Time.from_sec(1000.0 + 0.2 * i)
            out.write(topic, cloud, cloud.header.stamp + rospy.Duration(0.05))


BASE = ["map odom 0 0", "odom base_link 0 0"]
NEATO = ["radius:=0.2", "perception_parameters:={no_return: free}"]
DATMO, OLIN = "kostaskonkk/datmo@25aaf8a3a376f6fd886715178a93e8d2df8b2214", "lhwitten/comprobo_warmup@bc5d3eb5625cc11d341474ce4750230a5f4171ca"
LEGS = "angusleigh/leg_tracker@e6cbb2bba218e0684714a08972a7bdfa99118e3c"
BAGS = [
    Bag("neato_wall", OLIN, "warmup_project/warmup_project/bags/wall_bag/wall_bag_0.db3",
        "7068afa5ee8aeed5e6b6aaab2222d3cafdedd05f884b55cb2082dca38b1daa9a", "none stated", "Neato, LDS, ROS 2",
        ["map odom 0 0"], NEATO),
    Bag("neato_person", OLIN, "warmup_project/warmup_project/bags/person_bag/person_bag_0.db3",
        "b3f74aedd1e20fc65c182fdeff0748bb33526eeed623a911646910cf14c67399", "none stated", "Neato, LDS, ROS 2",
        ["map odom 0 0"], NEATO),
    Bag("turtlebot4", "Moampane/robot_localization@3862738e6082efb4f33ec90385e5559d20a2d1e7", "bags/macfirst_floor_take_2/macfirst_floor_take_2_0.db3",
        "9cc922b4a9cf1f1760111269afad51759ea712b7f36e743a3566c6d42d8df2e9", "none stated", "TurtleBot 4, RPLidar A1, ROS 2",
        ["map odom 0 0"], ["radius:=0.2"]),
    Bag("cars_overtake", DATMO, "examples/overtakes.bag",
        "fbd89a42e1902786acd9e90b9168855cf04216e654ab690140d657ac1efbe235", "BSD", "cars of 1:10, RPLidar",
        [*BASE, "base_link laser 0.1 0.2"], ["radius:=0.2"]),
    Bag("cars_parallel", DATMO, "examples/parallel.bag",
        "281c0205c9d14e0f5ed7561e445674baf53371571c69732576e2533d98df6600", "BSD", "cars of 1:10, RPLidar",
        [*BASE, "base_link laser 0.1 0.2"], ["radius:=0.2"]),
    Bag("two_cars", DATMO, "examples/two_robots.bag",
        "3844dc4e68348e2d42b863fd909308d4a2195728128020924c9e672623fda4cf", "BSD", "cars of 1:10, RPLidar",
        BASE, ["radius:=0.2"]),
    Bag("matcher", "CCNYRoboticsLab/scan_tools@219c31965ff904c59072389d1873a21bcb433e81", "laser_scan_matcher/demo/demo.bag",
        "3b845caa131c4f7e9def4094e8a25c4d4e382a40d65fa127f0400d82b3d935ce", "BSD", "Hokuyo URG in the hand",
        [*BASE, "base_link laser 0 0.3"], []),
    Bag("legs", LEGS, "rosbags/demos/demo_stationary_simple_environment.bag",
        "3f3a4132452fc25afcdb9c4d2f610c1babb05ebbe491297da1460cbf5b58e3db", "BSD", "Hokuyo URG that stands, people",
        [*BASE, "base_link laser 0 0.3"], []),
    Bag("neato_drive", "yycho0108/comprobo_warmup_project@b5f5e2da294c11ac755c2e9404122217960a581c", "warmup_project/bags/test_drive.bag",
        "c4f418dd0995b8af57908a2fc6c4efda87768414951c30fd7a9547f51c70dd56", "none stated", "Neato XV-11, LDS",
        ["map odom 0 0"], NEATO),
    Bag("spider", "spiderkiller13/obstacle_detector@9f637df0413c3b5758e9fa856dd37df95b680206", "rosbag/test.bag",
        "e67b1d8a0bfb386c9f08997844acc8af79c90229f978c54e494c14b723585f5d", "BSD", "depth cameras, merged to a scan",
        [], ["scan:=/zed/scan_merged"]),
    Bag("two_scanners", "tysik/obstacle_detector@bd59d405b2284f05c46f7b99cb9cb4247934e2ff", "resources/scans_demo.bag",
        "7cda65e31651605e7b3aa094b19d617a4c6b5fd5391f46601b3b0a09d97f6d30", "BSD", "two Hokuyos, front and back",
        [*BASE, "base_link front_scanner 0.2 0.2", "base_link rear_scanner -0.2 0.2"],
        ["scan:=/front_scan,/rear_scan", "radius:=0.3"]),
    Bag("sick", "SICKAG/sick_scan_xd@2d4796699158762cfee78ece05bf8d7c2ceb68d0", "doc/combination_rms_1xxx_lms_1xx/rms_1xxx_lms_1xx_movement_off.bag",
        "462fd36cbe466a6545587f55f402dc60a9c6c4cf8e2ab5d83df834bfff356e56", "Apache-2.0", "SICK LMS1xx",
        [*BASE, "base_link cloud 0 0.3"], ["scan:=/sick_lms_1xx/scan", "perception_parameters:={no_return: free}"], 0.25),
    Bag("vlp16", "tier4/nebula@606ac41f1f136333915f0114736f2f828e9d2789",
        "src/nebula_velodyne/nebula_velodyne/test_resources/decoder_ground_truth/vlp16/1673400471837873222/1673400471837873222_0.db3",
        "0f0c1f5e8a5818bdf0eb50ec787dbefeaa0bfbfbdeeb50211ef00baab79244ff", "Apache-2.0", "3-D lidar, Velodyne VLP-16",
        [*BASE, "base_link velodyne 0 0.6"], ["scan:=", "points:=/velodyne_points"], 0.05, velodyne),
    Bag("depth_camera", "moveit/moveit_tutorials@19130b1487b3794f4a93848c9cdc0cac5e8c4c6d", "doc/perception_pipeline/bags/perception_tutorial.bag",
        "158d992607f52d9af9ecdccb9246accb53d42786ff02aa4a0e8abefde39c2e99", "BSD", "depth camera, one cloud of 640 x 480",
        [*BASE, "base_link camera_rgb_optical_frame 0 0.6 -0.5 0.5 -0.5 0.5"], ["scan:=", "points:=/camera/depth_registered/points"], 0.25, still),
]
FRAMES = """
import sys, time, rospy
from geometry_msgs.msg import Quaternion, TransformStamped
from tf2_msgs.msg import TFMessage
rospy.init_node("fixed_frames", disable_rostime=True)
frames = []
for words in sys.argv[1:]:
    parent, child, *numbers = words.split()
    x, z, *turn = map(float, numbers)
    frame = TransformStamped(child_frame_id=child)
    frame.header.frame_id = parent
    frame.transform.translation.x, frame.transform.translation.z = x, z
    frame.transform.rotation = Quaternion(*(turn or [0.0, 0.0, 0.0, 1.0]))
    frames.append(frame)
publisher = rospy.Publisher("/tf_static", TFMessage, queue_size=1, latch=True)
publisher.publish(TFMessage(frames))
rospy.spin()
"""
# Until the end of its input; a scan or cloud is used where obstacles of its stamp come.
COUNT = """
import json, sys, time, rospy
from navvi_msgs.msg import Cue, Obstacles, Proximity
from sensor_msgs.msg import LaserScan, PointCloud2
rospy.init_node("count")
scans, used, near, said = set(), set(), [], []
kind = PointCloud2 if sys.argv[1] == "points" else LaserScan
subscribers = [rospy.Subscriber(topic, kind, lambda scan: scans.add(scan.header.stamp.to_nsec())) for topic in sys.argv[2:]]
subscribers += [rospy.Subscriber("/navvi/obstacles", Obstacles, lambda message: used.add(message.header.stamp.to_nsec())),
                rospy.Subscriber("/navvi/proximity", Proximity, lambda _: near.append(time.monotonic())),
                rospy.Subscriber("/navvi/cues", Cue, lambda cue: said.append(cue.text) if cue.text and cue.stage == 1 else None)]
sys.stdin.read()
placed = [stamp for stamp in scans if used and min(used) <= stamp <= max(used)]
print(json.dumps({"scans": len(scans), "share": len(used & scans) / max(1, len(placed)), "seconds": near[-1] - near[0] if near else 0.0,
                  "near": len(near), "hole": max([b - a for a, b in zip(near, near[1:])], default=0.0), "said": sorted(set(said))}))
"""


def fetch(bag, folder):
    """The file of a bag, of the folder where it is there; None where it cannot be had."""
    file = folder / (bag.name + pathlib.Path(bag.path).suffix)
    if not file.exists():
        url = f"https://raw.githubusercontent.com/{bag.source.replace('@', '/')}/{bag.path}"
        try:
            with urllib.request.urlopen(url, timeout=60) as page:
                file.write_bytes(page.read())
        except OSError as problem:
            print(f"{bag.name}: {url} cannot be fetched: {problem}", file=sys.stderr)
    if not file.exists():
        return None
    assert hashlib.sha256(file.read_bytes()).hexdigest() == bag.sha256, f"{file} has another hash than {bag.sha256}: remove it"
    return converted(file, bag.convert or ros2) if bag.convert or file.suffix != ".bag" else file


def converted(file, convert):
    """The bag of ROS 1 that is made of the file; None where that cannot be."""
    made = file.with_name(f"{file.stem}.played.bag")
    if not made.exists():
        try:
            convert(file, made)
        except subprocess.CalledProcessError as problem:
            made.unlink(missing_ok=True)
            print(f"{file.name} is not converted (\"pip install rosbags\" brings the converter): {problem}", file=sys.stderr)
            return None
    return made


def play(bag, file, env, out):
    """What came of it in `robot.launch rehearse:=true`, as COUNT prints it."""
    named = [word for word in bag.words if word.startswith(("scan:=", "points:="))] or ["scan:=/scan"]
    kind, scans = named[-1].split(":=")[0], named[-1].split(":=")[1].split(",")
    with Programs(env, out / f"{bag.name}.log") as programs:
        programs.run("rosparam", "set", "use_sim_time", "true").check_returncode()
        programs.launch("robot.launch", "rehearse:=true", "input:=topic", "speech:=false", "rviz:=false", "feedback_parameters:={listener: topic}", f"out:={out}",
                        *bag.words)
        programs.start("/usr/bin/python3", "-c", FRAMES, *bag.fixed)
        count = programs.start("/usr/bin/python3", "-c", COUNT, kind, *scans, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        assert eventually(lambda: "/perception_node" in programs.run("rostopic", "info", scans[0]).stdout), f"perception_node did not start, see {programs.log}"
        time.sleep(3.0)
        programs.run("rosbag", "play", "-q", "--clock", "-u", SECONDS, "-r", bag.pace, file, seconds=120).check_returncode()
        return json.loads(count.communicate("", timeout=20)[0])


def row(bag, found):
    rate = found["near"] / found["seconds"] if found["seconds"] else 0.0
    words = "; ".join(f"\"{text}\"" for text in found["said"]) or "nothing"
    return f"| {bag.name} | {bag.robot} | {found['scans']} | {100 * found['share']:.0f} % | {rate:.1f} | {found['hole']:.2f} s | {words} |"


if __name__ == "__main__":
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for one in BAGS:
        if not sys.argv[2:] or one.name in sys.argv[2:]:
            print(f"{one.name}: {fetch(one, folder) or 'is not here'}")
