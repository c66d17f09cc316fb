#!/usr/bin/env python3
"""A joy driver's stick for tests, in a process of its own: `stick.py push`, `kill`, `halt`, `pause` or `intrude`.

push   neutral, then full forward, until the robot drives at 0.3 m/s; prints its fastest speed in m/s.
kill   likewise to 0.8 m/s, then kills feedback_node with SIGKILL and goes on pushing; prints the time in s until the last
       stage held the wheels at zero, the time until the robot stood still, and the fastest speed in the 5 s after that.
halt   likewise, then halts feedback_node for 3 s; prints the kinds of what it says until it tells what became of the wheels.
pause  likewise, then halts sim_node for 2 s, in which commands pile up; prints the fastest speed from 0.5 s to 3 s after it lives again.
intrude  a neutral stick while this process itself commands full speed to /cmd_vel, at 1 kHz; prints the fastest speed within 3 s, the
       fastest with the stick pushed while it goes on, and the node that drive_state names.
"""
import os
import signal
import sys
import time
import xmlrpc.client

import rosgraph
import rospy
from geometry_msgs.msg import Twist, Vector3
from nav_msgs.msg import Odometry
from navvi_msgs.msg import Cue, DriveState
from sensor_msgs.msg import Joy


class Stick:
    def __init__(self):
        rospy.init_node("stick", disable_rostime=True)
        self.speed, self.stopped, self.intruder = 0.0, None, ""
        rospy.Subscriber("/odom", Odometry, lambda msg: setattr(self, "speed", msg.twist.twist.linear.x), tcp_nodelay=True)
        rospy.Subscriber("/navvi/drive_state", DriveState, self.note_stop, tcp_nodelay=True)
        self.joy = rospy.Publisher("/joy", Joy, queue_size=1)

    def note_stop(self, msg):
        self.intruder = msg.intruder
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
        for _ in range(10):  # the nodes may still be on their way
            self.hold(0.0, lambda: False, 1.0)
            if self.hold(1.0, lambda: self.speed >= speed, 3.0):
                return

    @staticmethod
    def pid(node):
        return xmlrpc.client.ServerProxy(rosgraph.Master("/stick").lookupNode(node)).getPid("/stick")[2]

    def fastest(self, forward, seconds):
        speeds = [0.0]
        self.hold(forward, lambda: speeds.append(abs(self.speed)), seconds)
        return max(speeds)

    def pause(self):
        pid = self.pid("/sim_node")
        os.kill(pid, signal.SIGSTOP)
        self.hold(1.0, lambda: False, 2.0)
        os.kill(pid, signal.SIGCONT)
        self.hold(1.0, lambda: False, 0.5)
        return (self.fastest(1.0, 2.5),)

    def intrude(self):
        self.hold(0.0, lambda: False, 1.0)
        commands = rospy.Publisher("/cmd_vel", Twist, queue_size=1000)
        command = Twist(linear=Vector3(x=1.0))
        flood = rospy.Timer(rospy.Duration(0.001), lambda _: commands.publish(command))
        alone = self.fastest(0.0, 3.0)
        driven = self.fastest(1.0, 3.0)
        flood.shutdown()
        return alone, driven, self.intruder

    def halt(self):
        pid, said = self.pid("/feedback_node"), []
        os.kill(pid, signal.SIGSTOP)
        self.hold(1.0, lambda: False, 3.0)
        rospy.Subscriber("/navvi/cues", Cue, lambda cue: cue.modality == Cue.SPEECH and cue.stage == Cue.QUEUED and said.append(cue.kind))
        os.kill(pid, signal.SIGCONT)
        self.hold(1.0, lambda: "robot_stopped" in said or "release_stick" in said, 20.0)
        return tuple(said)

    def kill(self):
        pid = self.pid("/feedback_node")
        self.stopped = None
        killed = time.monotonic()
        os.kill(pid, signal.SIGKILL)
        self.hold(1.0, lambda: self.stopped is not None and abs(self.speed) < 1e-3, 5.0)
        still = time.monotonic()
        return self.stopped - killed, still - killed, self.fastest(1.0, 5.0)


if __name__ == "__main__":
    what = sys.argv[1]
    stick = Stick()
    stick.push(0.8 if what in ("kill", "halt", "pause") else 0.3)
    pushed = stick.speed
    print(pushed, *{"push": tuple, "kill": stick.kill, "halt": stick.halt, "pause": stick.pause, "intrude": stick.intrude}[what]())
