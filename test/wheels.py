"""The base of a robot that is driven by geometry_msgs/Twist: hands /robot/cmd_vel over to a simulator as its /robot/command."""
import rospy
from geometry_msgs.msg import Twist, TwistStamped

rospy.init_node("base", disable_signals=True)
commands = rospy.Publisher("/robot/command", TwistStamped, queue_size=1, tcp_nodelay=True)


def hand_over(twist):
    command = TwistStamped(twist=twist)
    command.header.stamp = rospy.Time.now()
    commands.publish(command)


rospy.Subscriber("/robot/cmd_vel", Twist, hand_over, queue_size=1, tcp_nodelay=True)
rospy.spin()
