"""A master of its own for each session, on the loopback interface or at an address of this machine; or that of a robot elsewhere.

The lock of a port keeps a second session that starts now from it until this one's master listens there, and `watch` finds running
sessions by it. It is one file for all users of the machine, locked through a descriptor that only reads: the file may be another
user's. A port whose lock cannot be opened, or on which anything listens, is not ours. The end of a session removes its file.
"""
import atexit
import fcntl
import os
import re
import shlex
import socket
import subprocess
import urllib.parse
import xmlrpc.client
from pathlib import Path

from .places import DEVEL
from .say import aside, fail

PORTS = range(11311, 11411)
LOOPBACK = "libnavvi_loopback.so"
GIVEN = os.environ.get("ROS_MASTER_URI")  # by the user; later also by the workspace's own set-up


def lock_file(port):
    return Path(os.environ.get("TMPDIR") or "/tmp") / f"navvi-port-{port}.lock"


def lock(path):
    """The descriptor of the lock; None where somebody has it, or it cannot be opened."""
    try:
        descriptor = os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK)
    except OSError:
        return None
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        os.close(descriptor)
        return None
    return descriptor


def listeners(port):
    """What ss prints of those that listen on a port, with the user (-e)."""
    try:
        return subprocess.run(["ss", "-ltnHe", f"sport = :{port}"], check=True, text=True, stdout=subprocess.PIPE).stdout
    except (OSError, subprocess.CalledProcessError):
        fail(f"ss of iproute2 cannot say whether port {port} is free, and without that no session starts; \"apt install iproute2\" installs it.", 2)


def claim(port):
    """The descriptor of the port's lock; None where the port is another's."""
    path, mask = lock_file(port), os.umask(0o022)  # all users may read it
    try:
        os.close(os.open(path, os.O_RDONLY | os.O_CREAT | os.O_EXCL, 0o644))
    except OSError:  # it is there, perhaps as another user's
        pass
    finally:
        os.umask(mask)
    descriptor = lock(path)
    if descriptor is not None and (listeners(port) or not is_at(path, descriptor)):
        remove(path, descriptor)
        os.close(descriptor)
        return None
    return descriptor


def is_at(path, descriptor):
    """Whether the open file is still the one of that name: the end of another session may have removed it since it was opened."""
    try:
        return os.path.samestat(os.lstat(path), os.fstat(descriptor))
    except OSError:
        return False


def remove(path, descriptor):
    """Removes the lock that this process holds; another user's file stays."""
    if is_at(path, descriptor):
        try:
            path.unlink()
        except OSError:
            pass


class Network:
    """Holds a port as long as this process, and those that get `descriptor`, live."""

    def __init__(self, address="127.0.0.1"):
        self.claim()
        self.uri, self.address = f"http://{address}:{self.port}", address
        # ROS's own setup files set port 11311 of localhost where nothing is set.
        if GIVEN and not re.fullmatch(rf"http://(localhost:11311|(localhost|127\.0\.0\.1):{self.port})/?", GIVEN):
            aside(f"ROS_MASTER_URI={GIVEN} is not used: a session has a master of its own, here {self.uri}; \"roslaunch navvi live.launch\" "
                  "uses yours.")
        self.enter()

    def claim(self):
        for self.port in PORTS:
            self.descriptor = claim(self.port)
            if self.descriptor is not None:
                break
        else:
            fail(f"no port from {PORTS[0]} to {PORTS[-1]} is free for a master; end sessions that are not needed, \"ss -ltnp\" lists them.")
        atexit.register(remove, lock_file(self.port), self.descriptor)
        self.locks = [self.descriptor]

    def enter(self):
        os.environ.update(ROS_IP=self.address, ROS_MASTER_URI=self.uri)
        os.environ.pop("ROS_HOSTNAME", None)

    @staticmethod
    def preload():
        """Nodes would also open a port on every interface, which this library prevents: they listen at ROS_IP alone. It also ends
        rosmaster, rosout and RViz with roslaunch. Libraries that the user preloads stay. It is named without its folder, which is in
        LD_LIBRARY_PATH: the loader splits LD_PRELOAD at blanks. What it does not find it passes over, so a first program is asked."""
        names = ":".join(filter(None, [LOOPBACK, os.environ.get("LD_PRELOAD")]))
        loaded = subprocess.run(["cat", "/proc/self/maps"], env=dict(os.environ, LD_PRELOAD=names), stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        if LOOPBACK.encode() not in loaded.stdout:
            fail(f"{LOOPBACK} cannot be loaded, and without it anybody in the network reaches this session; it is needed in {DEVEL / 'lib'}, "
                 "and a path without \":\" and \";\".", 2)
        return names

    def second_terminal(self):
        setup = DEVEL / "setup.bash"
        near = os.path.relpath(setup) if Path.cwd() in setup.parents else setup
        return f"{f'source {shlex.quote(str(near))}; ' if setup.exists() else ''}export ROS_MASTER_URI={self.uri} ROS_IP={self.address}"


class FarNetwork(Network):
    """The master of a robot's side on another machine, HOST or HOST:PORT, from the address of this machine that leads there."""
    PATIENCE = 5.0  # s

    def __init__(self, robot):
        host, _, port = robot.partition(":")
        port = int(port or PORTS[0])
        uri = f"http://{host}:{port}"
        try:
            with socket.create_connection((host, port), self.PATIENCE) as link:
                self.address = link.getsockname()[0]
            self.master = xmlrpc.client.ServerProxy(uri)
            publishers, subscribers, _ = self.master.getSystemState("/navvi")[2]
            self.tells_contacts = "/navvi/contacts" in dict(publishers)
            self.nodes = {node for names in subscribers for node in names[1]}
        except (OSError, xmlrpc.client.Error, xmlrpc.client.expat.ExpatError) as problem:
            fail(f"no ROS master answers at {host}, port {port}: {problem}; on the robot's machine, \"./navvi robot start address:=...\" "
                 "starts one and prints where.", 2)
        if not self.nodes & {"/relay_node", "/sim_node"}:
            fail(f"the ROS master at {host}, port {port} knows no robot's side; \"./navvi robot start\" starts it there.", 2)
        if taken := sorted(filter(self.may_run, self.nodes & {"/feedback_node", "/trial_node"})):
            fail(f"somebody drives this robot already: {' and '.join(taken)} run; one person at a time is allowed. If nobody does, as after a "
                 "connection that was cut, \"rosnode cleanup\" on the robot's machine lets the next one in.", 2)
        self.claim()
        from .near_master import NearMaster  # needs ROS
        self.near = NearMaster(uri, (self.address, self.port))
        self.uri = self.near.uri
        self.enter()

    def may_run(self, node):
        """Whether it cannot be known that nothing is left of it but its name, as after a connection that was cut; the next of that name gets it."""
        at = urllib.parse.urlsplit(str(self.master.lookupNode("/navvi", node)[2]))
        try:
            socket.create_connection((at.hostname, at.port), self.PATIENCE).close()
        except (OSError, ValueError) as problem:
            return not isinstance(problem, ConnectionRefusedError)
        return True

    def clock(self):
        """The topic with the robot's time, that of a simulator or of a real robot."""
        return "/clock" if self.master.getParam("/navvi", "/use_sim_time")[2] is True else "/navvi/clock"


def address_of(port):
    """At which its master listens; on all of them or on none yet, that of this machine alone."""
    found = re.search(rf"([\d.]+):{port}\s", listeners(port))
    return found[1] if found and found[1] != "0.0.0.0" else "127.0.0.1"


def is_ours(port):
    """Nobody listens while a session begins; ss names no user where that is root."""
    listener = listeners(port)
    user = re.search(r"uid:(\d+)", listener)
    return not listener or int(user.group(1) if user else 0) == os.getuid()


def running_sessions():
    """The ports of this user's sessions. A lock that cannot be opened is nothing that could be watched."""
    ports = []
    for path in sorted(lock_file("*").parent.glob(lock_file("*").name)):
        descriptor = lock(path)
        port = path.stem.rpartition("-")[2]
        if descriptor is not None:
            os.close(descriptor)
        elif os.access(path, os.R_OK) and port.isdigit() and is_ours(int(port)):
            ports.append(int(port))
    return ports
