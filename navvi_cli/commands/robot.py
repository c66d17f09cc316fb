"""Start the robot's side for a person elsewhere, or check a robot.

"./navvi robot start" runs sensors, navigation and the last stage before the
wheels, with the arguments of robot_side.launch; with world:=NAME the simulator
is the robot (sim_side.launch). "./navvi run robot:=HOST" on another machine
drives it: doc/link.md. It listens on this machine alone unless address:= names
an address of it, such as that of a tunnel: ROS has no passwords.

"./navvi robot check" looks for ten seconds, with the master of ROS_MASTER_URI
and without moving anything: a line each for scans and clouds, odometry,
transforms, map, footprint, stick and wheels, and for emergency stop, bumper
and battery where they are named, with what was found, what is needed and what
to do. The arguments are those of robot.launch; parameters are given as
perception/no_return:=free.

Exit codes
0: all is well, or worth a look. 1: something is wrong or missing, or a program
crashed. 2: a wrong argument, or no master answers.

Examples
./navvi robot start address:=10.8.0.2 wheels:=/my_robot/cmd_vel
./navvi robot check scan:=/front/scan,/rear/scan wheels:=/my_robot/cmd_vel
"""
import time
from pathlib import Path

from navvi_cli import robot, robot_check
from navvi_cli.arguments import LaunchFile, add_words, words_for
from navvi_cli.network import PORTS, Network
from navvi_cli.parser import add_actions
from navvi_cli.places import program
from navvi_cli.say import aside, say, tell
from navvi_cli.session import Launch, accepted, check_parameters, nodes_of, prepare
from navvi_cli.workspace import build, is_current
from navvi_cli.worlds import check_world

SECONDS = 10.0


def arguments(parser):
    add_actions(parser, start=Start, check=Check)


class Start:
    """Run the robot's side, for a person on another machine."""

    def arguments(parser):
        add_words(parser, "robot_side.launch", "address:=ADDRESS of this machine, at which it listens; 127.0.0.1: on this machine alone.",
                  "world:=NAME: the simulator is the robot, with the arguments of sim_side.launch.")

    def run(args):
        simulated = any(word.startswith("world:=") for word in args.words)
        launch_file = LaunchFile("sim_side.launch" if simulated else "robot_side.launch")
        launch_file.arguments["address"] = ("127.0.0.1", "")
        words = words_for(launch_file, args.words)
        address = words.pop("address", "127.0.0.1")
        if simulated:
            check_world(words)
        prepare(words, ["session"], [program("navvi_nav", "nav_node")], check_parameters)
        network = Network(address)
        for name in ("parameters", "version"):
            del words[name]
        words["far"] = "true"
        log = Path.home() / ".navvi" / f"robot-{time.strftime('%Y%m%dT%H%M%SZ', time.gmtime())}.log"
        log.parent.mkdir(0o700, parents=True, exist_ok=True)
        say(f"the robot's side starts; Ctrl-C stops it. To drive, on the person's machine: ./navvi run robot:={address}:{network.port}")
        tell(f"The output of the programs: {log}\n"
             f"For {'' if simulated else 'the drivers of the robot and '}ROS tools, in a second terminal: {network.second_terminal()}")
        if not simulated and network.port != PORTS[0]:
            aside(f"drivers whose master listens on port {PORTS[0]} are not heard: start them in that second terminal, or this side at their master "
                  "with \"roslaunch navvi robot_side.launch far:=true\".")
        launch = Launch(launch_file, words, log, network)
        return int(not (launch.run() or launch.interrupted))


class Check:
    """Print a line for each part that robot.launch needs."""

    def arguments(parser):
        add_words(parser, "robot.launch")

    def run(args):
        launch = LaunchFile("robot.launch")
        given = words_for(launch, args.words)
        if not is_current(*nodes_of(given).values()):
            build(*(node.name for node in nodes_of(given).values()))
        for part, node in nodes_of(given).items():
            accepted(node, given.parameters_of(part))
        words = {name: default for name, (default, _) in launch.arguments.items()} | given
        words |= dict(word.split(":=", 1) for word in given.parameters)
        checked = robot.Robot(words, given)
        robot.listen(checked, SECONDS)
        lines = robot_check.lines(checked)
        for line in lines:
            tell(str(line))
        return int(any(line.verdict == robot_check.WRONG for line in lines))
