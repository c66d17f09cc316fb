"""Check whether a robot provides what robot.launch needs.

In ten seconds, with the master of ROS_MASTER_URI, and without moving anything:
a line each for scans and clouds, odometry, transforms, map, footprint, stick
and wheels, and for emergency stop, bumper and battery where they are named,
with what was found, what is needed and what to do. The arguments are those of
robot.launch; parameters are given as perception/no_return:=free.

Exit codes
0: all is well, or worth a look. 1: something is wrong or missing. 2: a wrong
argument, or no master answers.

Example
./navvi robot check scan:=/front/scan,/rear/scan wheels:=/my_robot/cmd_vel
"""
from navvi_cli import robot, robot_check
from navvi_cli.arguments import LaunchFile, add_words, words_for
from navvi_cli.parser import add_actions
from navvi_cli.say import tell

SECONDS = 10.0


def arguments(parser):
    add_actions(parser, check=Check)


class Check:
    """Print a line for each part that robot.launch needs."""

    def arguments(parser):
        add_words(parser, "robot.launch")

    def run(args):
        launch = LaunchFile("robot.launch")
        given = words_for(launch, args.words)
        words = {name: default for name, (default, _) in launch.arguments.items()} | given
        words |= dict(word.split(":=", 1) for word in given.parameters)
        checked = robot.Robot(words, given)
        robot.listen(checked, SECONDS)
        lines = robot_check.lines(checked)
        for line in lines:
            tell(str(line))
        return int(any(line.verdict == robot_check.WRONG for line in lines))
