#!/usr/bin/env python3
"""Holds the stick neutral, then forward, as a joy driver would; prints the fastest speed of the robot, in m/s."""
import time

import rospy
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Joy

rospy.init_node("push_stick", disable_rostime=True)
speeds = [0.0]
rospy.Subscriber("/odom", Odometry, lambda msg: speeds.append(msg.twist.twist.linear.x))
stick = rospy.Publisher("/joy", Joy, queue_size=1)
begin = time.monotonic()
while time.monotonic() - begin < 4.5 and max(speeds) < 0.3:
    stick.publish(Joy(axes=[0.0, 0.0 if time.monotonic() - begin < 2.5 else 1.0], buttons=[0, 0]))
    time.sleep(0.02)
print(max(speeds))
