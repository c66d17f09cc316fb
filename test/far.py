"""Two machines and a network between them: a network namespace each, joined by a wire that delays, loses and cuts IP packets.

As each side runs its own processes, with the wire's addresses, all of ROS's connections go by it: those of the master, too. It needs the
rights of root, or of a user namespace that has them.
"""
import ctypes
import fcntl
import heapq
import os
import random
import select
import struct
import subprocess
import threading
import time

ROBOT, PERSON = "10.9.0.1", "10.9.0.2"
QUEUE = 64 * 1024  # bytes that wait for a narrow wire; what comes beyond is lost, as in a router
LIBC = ctypes.CDLL(None, use_errno=True)


def is_possible():
    return subprocess.run(["unshare", "-n", "ip", "tuntap", "add", "dev", "try", "mode", "tun"], capture_output=True).returncode == 0


class Side:
    """A machine, as a namespace that lives as long as a process."""

    def __init__(self, own, other):
        self.address = own
        self.holder = subprocess.Popen(["unshare", "-n", "sleep", "infinity"])
        while os.readlink(f"/proc/{self.holder.pid}/ns/net") == os.readlink("/proc/self/ns/net"):
            time.sleep(0.01)
        self.tun = self.device()
        for words in (["link", "set", "lo", "up"], ["addr", "add", own, "peer", other, "dev", "wire"], ["link", "set", "wire", "up"]):
            subprocess.run([*self.enter, "ip", *words], check=True)

    @property
    def enter(self):
        """Words before a command that is to run there."""
        return ["nsenter", "-t", str(self.holder.pid), "-n"]

    def device(self):
        """A network device of that namespace, whose packets this process reads and writes."""
        with open("/proc/self/ns/net") as here, open(f"/proc/{self.holder.pid}/ns/net") as there:
            LIBC.setns(there.fileno(), 0)
            try:
                tun = os.open("/dev/net/tun", os.O_RDWR | os.O_NONBLOCK)
                fcntl.ioctl(tun, 0x400454CA, struct.pack("16sH22x", b"wire", 0x1001))  # TUNSETIFF: IFF_TUN, IFF_NO_PI
            finally:
                LIBC.setns(here.fileno(), 0)
        return tun

    def close(self):
        os.close(self.tun)
        self.holder.kill()
        self.holder.wait()


class Wire(threading.Thread):
    """One way by itself: `delay` and `jitter` in s, `loss` as a share, `rate` in bytes/s, 0: any; `cut`: nothing passes."""

    def __init__(self):
        super().__init__(daemon=True)
        self.delay = self.jitter = self.loss = self.rate = 0.0
        self.cut = self.over = False
        self.robot, self.person = Side(ROBOT, PERSON), Side(PERSON, ROBOT)
        self.random = random.Random(1)
        self.start()

    def run(self):
        to = {self.robot.tun: self.person.tun, self.person.tun: self.robot.tun}
        free, waiting, number = dict.fromkeys(to, 0.0), [], 0
        while not self.over:
            left = max(0.0, waiting[0][0] - time.monotonic()) if waiting else 0.05
            for tun in select.select(list(to), [], [], min(left, 0.05))[0]:
                packet, now = os.read(tun, 65536), time.monotonic()
                queued = (free[tun] - now) * self.rate
                if self.cut or self.random.random() < self.loss or queued > QUEUE:
                    continue
                free[tun] = max(now, free[tun]) + (len(packet) / self.rate if self.rate else 0.0)
                due = free[tun] + self.delay + (self.random.expovariate(1.0 / self.jitter) if self.jitter else 0.0)
                heapq.heappush(waiting, (due, number := number + 1, to[tun], packet))
            while waiting and waiting[0][0] <= time.monotonic():
                _, _, tun, packet = heapq.heappop(waiting)
                if not self.cut:
                    os.write(tun, packet)

    def close(self):
        self.over = True
        self.join()
        for side in (self.robot, self.person):
            side.close()
