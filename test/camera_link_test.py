"""Pictures of a robot's camera over a connection."""
import os
import subprocess
import time

import numpy
import pytest

from sessions import ROOT, Programs, eventually, script

PROGRAM = ROOT / "navvi_ws/src/navvi_rviz/scripts/camera_link"


def test_pictures_give_way_to_commands_and_come_back_bit_by_bit():
    pace = script(PROGRAM).Pace()
    for _ in range(60):
        pace.hear(0.05, False)
    assert pace.rate == 15.0
    pace.hear(0.2, False)
    assert pace.rate == 7.5, "the round trip has grown by more than 0.1 s"
    pace.hear(0.05, True)
    assert pace.rate == 3.75, "commands come late"
    for _ in range(9):
        pace.hear(0.3, False)
    assert pace.rate == 1.0
    pace.hear(0.1, False)
    assert pace.rate == 1.5


def test_a_picture_comes_over_as_it_is_and_one_that_stands_is_darkened(master):
    os.environ.update(master)
    import rospy
    from sensor_msgs.msg import Image
    rospy.init_node("camera_link_test", disable_signals=True)
    camera, shown = rospy.Publisher("/cam/image", Image, queue_size=1), []
    rospy.Subscriber("/shown", Image, shown.append)
    red = numpy.zeros((48, 70, 3), numpy.uint8)  # whose rows have 6 bytes more than pixels
    red[:, :64, 2] = 200
    image = Image(width=64, height=48, encoding="bgr8", step=210, data=red.tobytes())
    image.header.frame_id = "camera"
    with Programs(master) as programs:
        programs.start(PROGRAM, "send", "image:=/cam/image", "image/compressed:=/cam/image/compressed")
        programs.start(PROGRAM, "receive", "image:=/shown", "image/compressed:=/cam/image/compressed")
        assert eventually(lambda: camera.publish(image) or len(shown) >= 3, 30), "no picture came"
        colours = numpy.frombuffer(shown[-1].data, numpy.uint8).reshape(48, 64, 3)
        assert shown[-1].header.frame_id == "camera" and abs(colours.mean(axis=(0, 1)) - (200, 0, 0)).max() < 4
        time.sleep(3.5)
        colours = numpy.frombuffer(shown[-1].data, numpy.uint8).reshape(48, 64, 3)
        assert colours[0].mean(axis=0)[0] == pytest.approx(80, abs=4), "dark at the border"
        assert (colours == 255).all(axis=2).sum() > 10, "its age in white"


def test_a_camera_of_this_machine_that_died_is_darkened(master):
    os.environ.update(master)
    import rospy
    from sensor_msgs.msg import Image
    rospy.init_node("camera_link_test", disable_signals=True)
    camera, shown = rospy.Publisher("/raw", Image, queue_size=1), []
    rospy.Subscriber("/watched", Image, shown.append)
    image = Image(width=64, height=48, encoding="mono8", step=64, data=bytes([200]) * 64 * 48)
    with Programs(master) as programs:
        programs.start(PROGRAM, "watch", "image/raw:=/raw", "image:=/watched")
        assert eventually(lambda: camera.publish(image) or len(shown) >= 3, 30), "no picture came"
        assert (shown[-1].encoding, shown[-1].data) == ("mono8", image.data), "as it is"
        assert eventually(lambda: shown[-1].encoding == "rgb8", 10)
        assert shown[-1].data[0] == pytest.approx(80, abs=4), "dark at the border"


def test_a_wrong_word_ends_in_a_sentence():
    run = subprocess.run([PROGRAM], capture_output=True, text=True)
    assert run.returncode == 1 and "allowed is" in run.stderr
