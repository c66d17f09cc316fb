#!/usr/bin/env python3
"""A joy driver's stick for tests, in a process of its own: `stick.py push`, `kill`, `halt`, `unguided`, `pause`, `crash`, `intrude`, `forge`,
`twin`, `clock`, `garbage`, `lose`, or `churn`.

push   neutral, then full forward, until the robot drives at 0.3 m/s; prints its fastest speed in m/s.
kill   likewise to 0.8 m/s, then kills feedback_node with SIGKILL and goes on pushing; prints the time in s until the last
       stage held the wheels at zero, the time until the robot stood still, the fastest speed in the 5 s after that, the time until commands came
       again, and the kinds of what is said.
halt   likewise, then halts feedback_node for 3 s; prints when, in s of the monotonic clock, the time in s until the wheels were held, the fastest
       speed in the 3 s after it lives again, and the kinds of what it says until it tells what became of the wheels.
unguided  HOW: once a path leads, pushes to 0.3 m/s, kills nav_node, or halts it for 1.5 s, as HOW says, `killed` or `halted`, and goes on pushing;
       prints the slowest speed until guidance came again, the time in s until that is said to be lost, and that from its end until it came.
pause  likewise, then halts sim_node for 2 s, in which commands pile up; prints the time in s until that is said, and the fastest speed from 0.5 s
       to 3 s after it lives again.
crash  kills sim_node with SIGKILL in a trial, with the stick pushed; prints the time in s until it is said to be lost.
intrude  a neutral stick while this process itself commands full speed to /navvi/command, at 1 kHz; prints the fastest speed within 3 s, the
       fastest with the stick pushed while it goes on, the simulation's pace meanwhile as a share of that before, the commands a second, and the
       node that drive_state names.
forge  this process commands a turn to /navvi/command under the name of feedback_node while the stick is pushed; prints the fastest motion, in m/s or
       rad/s, from 0.6 s after its first command for 3 s, the node that drive_state names, and the fastest speed once it is over and the stick
       was neutral.
twin   a second node of the name /feedback_node commands full speed; prints the fastest speed from 0.6 s after its first command for 3 s.
clock  publishes another time to /clock in a trial, with the stick pushed; prints the time in s until the wheels were held, and the fastest
       speed in the 3 s after that.
garbage  sends what is no message to each port of each node, with the stick pushed half way; prints how many times, the slowest speed meanwhile,
       and by how many MB any node has grown.
lose   LETTER PAD: as kill, by the pad in memory at the socket PAD; then it is lost as the letter says (virtual_pad.cpp), its stick held. Prints
       the time in s until the wheels were commanded to zero, and until the robot stood still.
churn  TIMES PAD: by the pad in memory, drives and at a random moment unplugs it and plugs it in again, or each fifth time kills feedback_node, the
       stick held all the time, then for 2 s of the next one. Prints how often it drove, how often feedback_node ended by itself, and the fastest
       speed of a stick that was not neutral since.
"""
import os
import pathlib
import random
import signal
import socket
import struct
import subprocess
import sys
import time
import xmlrpc.client

import rosgraph
import rospy
from geometry_msgs.msg import Twist, TwistStamped, Vector3
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Clock
from navvi_msgs.msg import Cue, DriveState, Guidance, TrialState
from sensor_msgs.msg import Joy

from sessions import eventually


class Stick:
    def __init__(self):
        rospy.init_node("stick", disable_rostime=True)
        self.speed, self.turn, self.place, self.stopped, self.intruder, self.wanted, self.stamp = 0.0, 0.0, 0.0, None, "", 0.0, rospy.Time()
        rospy.Subscriber("/odom", Odometry, self.note_motion, tcp_nodelay=True)
        rospy.Subscriber("/navvi/command", TwistStamped, lambda msg: setattr(self, "wanted", msg.twist.linear.x), tcp_nodelay=True)
        rospy.Subscriber("/navvi/drive_state", DriveState, self.note_stop, tcp_nodelay=True)
        self.joy = rospy.Publisher("/joy", Joy, queue_size=1)
        self.link = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)

    def note_motion(self, msg):
        self.speed, self.turn, self.stamp = msg.twist.twist.linear.x, msg.twist.twist.angular.z, msg.header.stamp
        self.place = msg.pose.pose.position.x

    def note_stop(self, msg):
        self.intruder = msg.intruder
        if msg.state == DriveState.STOPPED:
            self.stopped = self.stopped or time.monotonic()

    def hold(self, forward, until, seconds):
        """Holds the stick until the condition is met or the time is over; returns whether it was met."""
        deadline = time.monotonic() + seconds
        while time.monotonic() < deadline:
            if what in ("lose", "churn"):
                self.to_pad(b"b", struct.pack("4f", 0.0, forward, 0.0, float(forward == 0.0 and what == "lose")))  # Start begins the trial
            else:
                self.joy.publish(Joy(axes=[0.0, forward], buttons=[0, 0]))
            if until():
                return True
            time.sleep(0.01)
        return False

    def push(self, speed, forward=1.0):
        """Returns whether it drove."""
        for _ in range(10):  # the nodes may still be on their way
            self.hold(0.0, lambda: False, 1.0)
            if self.hold(forward, lambda: forward * self.speed >= speed, 3.0):
                return True
        return False

    def push_in_trial(self):
        trial = []
        rospy.Subscriber("/navvi/trial_state", TrialState, lambda msg: trial.append(msg.state))
        self.hold(0.0, lambda: trial[-1:] == [TrialState.RUNNING], 60.0)
        self.push(0.3)

    def to_pad(self, *datagrams):
        for datagram in datagrams:
            try:
                self.link.sendto(datagram, sys.argv[3])
            except OSError:
                pass  # it is not plugged in yet

    def lose(self):
        lost, times = time.monotonic(), []
        self.to_pad(sys.argv[2].encode())
        for done in (lambda: self.wanted == 0.0, lambda: abs(self.speed) < 1e-3):
            eventually(done, 5.0)
            times.append(time.monotonic() - lost)
        return times

    def churn(self):
        draw, begin, drove, ended, moved = random.Random(1), self.place, 0, 0, 0.0
        commands = self.times("/navvi/command", TwistStamped)
        for count in range(1, int(sys.argv[2]) + 1):
            forward = 1.0 if self.place < begin + 1.5 else -1.0
            drove += self.push(0.1, forward)
            pid = self.pid("/feedback_node")
            self.hold(forward, lambda: False, draw.uniform(0.0, 0.5))
            killed = count % 5 == 0
            if killed:
                os.kill(pid, signal.SIGKILL)
            else:
                self.to_pad(b"u")
                self.hold(forward, lambda: False, draw.uniform(0.0, 0.3))
                self.to_pad(b"p")
            self.hold(forward, lambda: False, 1.0)  # until it stands
            commands.clear()
            if killed:  # until the next guide commands
                self.hold(forward, lambda: commands, 20.0)
            moved = max(moved, self.fastest(forward, 2.0 if killed else draw.uniform(0.2, 1.5)))
            ended += not killed and self.pid("/feedback_node") != pid
        return drove, ended, moved

    def command(self, **twist):
        """With the robot's time."""
        command = TwistStamped(twist=Twist(**twist))
        command.header.stamp = self.stamp
        return command

    @staticmethod
    def pid(node):
        return xmlrpc.client.ServerProxy(rosgraph.Master("/stick").lookupNode(node)).getPid("/stick")[2]

    def fastest(self, forward, seconds):
        speeds = [0.0]
        self.hold(forward, lambda: speeds.append(max(abs(self.speed), abs(self.turn))), seconds)
        return max(speeds)

    def crash(self):
        pid, told = self.pid("/sim_node"), self.times("/navvi/cues", Cue, lambda cue: cue.kind == "simulator_lost")
        self.push_in_trial()
        killed = time.monotonic()
        os.kill(pid, signal.SIGKILL)
        self.hold(1.0, lambda: told, 10.0)
        return (since(killed, told),)

    def pause(self):
        pid, told = self.pid("/sim_node"), self.times("/navvi/cues", Cue, lambda cue: cue.kind == "simulator_lost")
        self.hold(1.0, lambda: False, 0.5)
        halted = time.monotonic()
        os.kill(pid, signal.SIGSTOP)
        self.hold(1.0, lambda: False, 2.0)
        os.kill(pid, signal.SIGCONT)
        self.hold(1.0, lambda: False, 0.5)
        return told[0] - halted, self.fastest(1.0, 2.5)

    def intrude(self):
        times = [(self.stamp.to_sec(), time.monotonic())]

        def pace():
            times.append((self.stamp.to_sec(), time.monotonic()))
            (sim, wall), (sim_now, wall_now) = times[-2:]
            return (sim_now - sim) / (wall_now - wall)
        self.hold(0.0, lambda: False, 3.0)
        usual = pace()
        commands = rospy.Publisher("/navvi/command", TwistStamped, queue_size=1000)
        begin, sent = time.monotonic(), []

        def publish(_):
            for _ in range(min(20, int(1000 * (time.monotonic() - begin)) - len(sent))):
                commands.publish(self.command(linear=Vector3(x=1.0)))
                sent.append(time.monotonic())
        flood = rospy.Timer(rospy.Duration(0.001), publish)
        alone = self.fastest(0.0, 3.0)
        driven = self.fastest(1.0, 3.0)
        flood.shutdown()
        rate = len(sent) / (time.monotonic() - begin)
        self.hold(1.0, lambda: False, 0.2)  # what came is read
        return alone, driven, pace() / usual, rate, self.intruder

    def forge(self):
        commands = rospy.Publisher("/navvi/command", TwistStamped, queue_size=1, headers={"callerid": "/feedback_node"})
        self.hold(1.0, lambda: commands.get_num_connections() > 0, 10.0)
        forging = rospy.Timer(rospy.Duration(0.02), lambda _: commands.publish(self.command(angular=Vector3(z=1.0))))
        self.hold(1.0, lambda: False, 0.6)
        forged = self.fastest(1.0, 3.0)
        forging.shutdown()
        commands.unregister()
        self.hold(0.0, lambda: False, 1.0)
        return forged, self.intruder, self.fastest(1.0, 3.0)

    def twin(self):
        twin = subprocess.Popen([sys.executable, "-c", TWIN], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.hold(1.0, lambda: self.wanted == 1.0, 20.0)
        begun = self.wanted == 1.0  # feedback_node itself asks for 0.9 m/s at most
        self.hold(1.0, lambda: False, 0.6)
        fastest = self.fastest(1.0, 3.0)
        twin.kill()
        return (fastest if begun else "the twin did not begin",)

    def clock(self):
        self.push_in_trial()
        clock = rospy.Publisher("/clock", Clock, queue_size=1)
        takers = {"/sim_node", "/trial_node"}
        self.hold(1.0, lambda: takers <= {link.endpoint_id for link in clock.impl.connections}, 20.0)
        self.stopped = None
        jumped = time.monotonic()
        clock.publish(Clock(clock=rospy.Time(1)))
        self.hold(1.0, lambda: self.stopped is not None, 5.0)
        self.hold(1.0, lambda: False, 0.5)
        return self.stopped - jumped, self.fastest(1.0, 3.0)

    def garbage(self):
        nodes = {node: xmlrpc.client.ServerProxy(rosgraph.Master("/stick").lookupNode(node)) for node in NODES}
        pids = {node: proxy.getPid("/stick")[2] for node, proxy in nodes.items()}
        before = {node: memory(pid) for node, pid in pids.items()}
        slowest, grown = [], []

        def watch():
            slowest.append(self.speed)
            grown.append(max(memory(pid) - before[node] for node, pid in pids.items()))
        open_ones = []
        for pid in pids.values():
            for port in ports(pid):
                for payload in GARBAGE:
                    link = socket.create_connection(("127.0.0.1", port), timeout=2)
                    link.settimeout(0.1)
                    open_ones.append(link)
                    try:
                        link.sendall(payload)
                    except OSError:
                        pass  # dropped already
                    self.hold(0.55, lambda: False, 0.02)
                    watch()
        self.hold(0.55, watch, 3.0)
        return len(open_ones), min(slowest), max(grown)

    def halt(self):
        pid, self.stopped = self.pid("/feedback_node"), None
        halted = time.monotonic()
        os.kill(pid, signal.SIGSTOP)
        self.hold(1.0, lambda: self.stopped is not None, 3.0)
        held = self.stopped - halted
        self.hold(1.0, lambda: False, 3.0 - held)
        said = self.said()
        os.kill(pid, signal.SIGCONT)
        fastest = self.fastest(1.0, 3.0)
        self.hold(1.0, lambda: "robot_stopped" in said or "release_stick" in said, 17.0)
        return halted, held, fastest, *said

    def said(self):
        """Kinds, of what is to be spoken from now on."""
        kinds = []
        rospy.Subscriber("/navvi/cues", Cue, lambda cue: cue.modality == Cue.SPEECH and cue.stage == Cue.QUEUED and kinds.append(cue.kind))
        return kinds

    @staticmethod
    def times(topic, kind, wanted=lambda _: True):
        """When each wanted message came from now on, in s of the monotonic clock."""
        came = []
        rospy.Subscriber(topic, kind, lambda msg: wanted(msg) and came.append(time.monotonic()))
        return came

    def unguided(self):
        pid, said = self.pid("/nav_node"), self.times("/navvi/cues", Cue, lambda cue: cue.kind == "guidance_lost")
        guided, leads = self.times("/navvi/guidance", Guidance), self.times("/navvi/guidance", Guidance, lambda msg: msg.state == Guidance.FOLLOWING)
        self.hold(0.0, lambda: leads, 60.0)
        self.push(0.3)
        over = lost = time.monotonic()
        speeds, halted = [], sys.argv[2] == "halted"
        os.kill(pid, signal.SIGSTOP if halted else signal.SIGKILL)
        if halted:
            self.hold(1.0, lambda: speeds.append(self.speed), 1.5)
            over = time.monotonic()
            os.kill(pid, signal.SIGCONT)
        self.hold(1.0, lambda: speeds.append(self.speed) or since(over + BEFORE, guided) < NEVER, 10.0)
        return min(speeds), since(lost, said), since(over + BEFORE, guided) + BEFORE

    def kill(self):
        pid, said, commands = self.pid("/feedback_node"), self.said(), self.times("/navvi/command", TwistStamped)
        self.stopped = None
        killed = time.monotonic()
        os.kill(pid, signal.SIGKILL)
        self.hold(1.0, lambda: self.stopped is not None and abs(self.speed) < 1e-3, 5.0)
        still = time.monotonic()
        said.clear()
        return self.stopped - killed, still - killed, self.fastest(1.0, 5.0), since(killed + BEFORE, commands) + BEFORE, *said


BEFORE = 0.3  # s, in which messages of a program that was killed may still come
NEVER = 99.0  # s


def since(begin, times):
    """s until the first of the times after it."""
    return next((at - begin for at in times if at > begin), NEVER)


NODES = ("/sim_node", "/nav_node", "/feedback_node", "/trial_node")
TWIN = """
import rospy
from geometry_msgs.msg import TwistStamped
from rosgraph_msgs.msg import Clock
rospy.init_node("feedback_node", disable_rostime=True)
commands = rospy.Publisher("/navvi/command", TwistStamped, queue_size=1)
command = TwistStamped()
command.twist.linear.x = 1.0
rospy.Subscriber("/clock", Clock, lambda msg: setattr(command.header, "stamp", msg.clock))
while not rospy.is_shutdown():
    commands.publish(command)
    rospy.sleep(0.02)
"""
FIELD = b"callerid=/garbage"
GARBAGE = (
    struct.pack("<I", 10**9),                                               # a header of 1 GB that never comes
    struct.pack("<I", 10**9) + b"x" * 100000,
    struct.pack("<I", 0xffffffff) + b"x" * 1000,
    struct.pack("<I", 200) + struct.pack("<I", len(FIELD)) + FIELD,         # half a header
    struct.pack("<I", 4 + 10) + struct.pack("<I", 10**9) + b"callerid=/",   # a field of 1 GB in a header of 14 bytes
    struct.pack("<I", 4 + len(FIELD)) + struct.pack("<I", len(FIELD)) + FIELD,
    struct.pack("<I", 8) + struct.pack("<I", 4) + b"\x00\xff=\n",
    b"POST / HTTP/1.1\r\nContent-Length: 2000000000\r\n\r\n<methodCall>",
    bytes(range(256)) * 40,
)


def memory(pid):
    """MB"""
    status = pathlib.Path(f"/proc/{pid}/status").read_text()
    return int(status.split("VmRSS:")[1].split()[0]) / 1024


def ports(pid):
    """Those that the process listens on."""
    sockets = set()
    for link in pathlib.Path(f"/proc/{pid}/fd").iterdir():
        try:
            sockets.add(os.readlink(link))
        except OSError:
            pass  # closed meanwhile
    rows = [row.split() for row in pathlib.Path("/proc/net/tcp").read_text().splitlines()[1:]]
    return [int(row[1].split(":")[1], 16) for row in rows if row[3] == "0A" and f"socket:[{row[9]}]" in sockets]


if __name__ == "__main__":
    what = sys.argv[1]
    stick = Stick()
    stick.push(0.8 if what in ("kill", "halt", "pause", "lose") else 0.3)
    pushed = stick.speed
    print(pushed, *(tuple() if what == "push" else getattr(stick, what)()))
