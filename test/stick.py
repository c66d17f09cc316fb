#!/usr/bin/env python3
"""A joy driver's stick for tests, in a process of its own: `stick.py push` or `stick.py kill`.

push   neutral, then full forward, until the robot drives at 0.3 m/s; prints its fastest speed in m/s.
kill   likewise to 0.8 m/s, then kills feedback_node with SIGKILL and goes on pushing; prints the time in s until the last
       stage held the wheels at zero, the time until the robot stood still, and the fastest speed in the 5 s after that.
"""
import os
import signal
import sys
import time
import xmlrpc.client

import rosgraph
import rospy
from nav_msgs.msg import Odometry
from navvi_msgs.msg import DriveState
from sensor_msgs.msg import Joy


class Stick:
    def __init__(self):
        rospy.init_node("stick", disable_rostime=True)
        self.speed, self.stopped = 0.0, None
        rospy.Subscriber("/odom", Odometry, lambda msg: setattr(self, "speed", msg.twist.twist.linear.x), tcp_nodelay=True)
        rospy.Subscriber("/navvi/drive_state", DriveState, self.note_stop, tcp_nodelay=True)
        self.joy = rospy.Publisher("/joy", Joy, queue_size=1)

    def note_stop(self, msg):
        if msg.state == DriveState.STOPPED:
            self.stopped = time.monotonic()

    def hold(self, forward, until, seconds):
        """Holds the stick until the condition is met or the time is over; returns whether it was met."""
        deadline = time.monotonic() + seconds
        while time.monotonic() < deadline:
            self.joy.publish(Joy(axes=[0.0, forward], buttons=[0, 0]))
            if until():
                return True
            time.sleep(0.01)
        return False

    def push(self, speed):
        self.hold(0.0, lambda: False, 2.5)
        self.hold(1.0, lambda: self.speed >= speed, 3.0)

    def kill(self):
        node = xmlrpc.client.ServerProxy(rosgraph.Master("/stick").lookupNode("/feedback_node"))
        pid = node.getPid("/stick")[2]
        self.stopped = None
        killed = time.monotonic()
        os.kill(pid, signal.SIGKILL)
        self.hold(1.0, lambda: self.stopped is not None and abs(self.speed) < 1e-3, 5.0)
        still = time.monotonic()
        fastest = [0.0]
        self.hold(1.0, lambda: fastest.append(abs(self.speed)), 5.0)
        return self.stopped - killed, still - killed, max(fastest)


if __name__ == "__main__":
    stick = Stick()
    stick.push(0.8 if sys.argv[1] == "kill" else 0.3)
    print(stick.speed, *(stick.kill() if sys.argv[1] == "kill" else ()))
