"""Path, goal and near things over the picture of a robot's own camera."""
import threading
import time

import numpy
import pytest

from picture_test import Picture

pytestmark = pytest.mark.accessibility
BESIDE = (970, 60, 1910, 600)  # px, of the screen


class Camera(Picture):
    """A camera that sees grey, 1 m above the floor, ahead and 0.35 rad down."""
    filled = False  # as on a robot: no warehouse is known
    words = ["camera:=/robot/camera/image_raw"]

    def furnish(self):
        import rospy
        from fake_robot import transform
        from sensor_msgs.msg import CameraInfo, Image
        from tf2_msgs.msg import TFMessage
        image, info = Image(width=320, height=240, encoding="mono8", step=320, data=bytes([90]) * 320 * 240), CameraInfo(width=320, height=240)
        info.K = [280, 0, 160, 0, 280, 120, 0, 0, 1]
        info.P = [280, 0, 160, 0, 0, 280, 120, 0, 0, 0, 1, 0]
        info.R = [1, 0, 0, 0, 1, 0, 0, 0, 1]
        frame = transform("base_link", "camera", 1.0, rospy.Time())
        q = frame.transform.rotation
        cosine, sine = 0.5 * numpy.cos(0.175), 0.5 * numpy.sin(0.175)
        q.w, q.x, q.y, q.z = cosine - sine, -cosine - sine, cosine + sine, sine - cosine
        images = rospy.Publisher("/robot/camera/image_raw", Image, queue_size=1)
        infos = rospy.Publisher("/robot/camera/camera_info", CameraInfo, queue_size=1)
        frames = rospy.Publisher("/tf", TFMessage, queue_size=1)
        self.sees = True

        def show():
            while self.sees:
                for message in image, info, frame:
                    message.header.stamp = rospy.Time.now()
                image.header.frame_id = info.header.frame_id = "camera"
                frames.publish(TFMessage([frame]))
                infos.publish(info)
                images.publish(image)
                time.sleep(0.1)
        self.thread = threading.Thread(target=show)
        self.thread.start()

    def __exit__(self, *given):
        self.sees = False
        self.thread.join()
        super().__exit__(*given)


def test_the_path_and_the_goal_lie_over_the_robots_own_picture(master, tmp_path):
    with Camera(master, "high_contrast") as camera:
        guide = camera.scene()["/navvi/markers"]
        camera.topics["/navvi/markers"].publish(guide)
        time.sleep(8)
        with_path = numpy.asarray(camera.shot(tmp_path / "with.png", BESIDE), dtype=int)
        for marker in guide[:2]:
            marker.action = camera.Marker.DELETE
        camera.topics["/navvi/markers"].publish(guide)
        time.sleep(2)
        without = numpy.asarray(camera.shot(tmp_path / "without.png", BESIDE), dtype=int)
    changed = abs(with_path - without).max(axis=2) > 60
    grey = (abs(without - without.mean(axis=2, keepdims=True)).max(axis=2) < 3) & (abs(without.mean(axis=2) - 90) < 25)
    assert grey.sum() > 100000, "the camera's picture is there"
    assert changed.sum() > 2000, "and the path over it"
