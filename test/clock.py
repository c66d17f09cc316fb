"""A computer's calendar clock as tests set it, for the programs that are started with its environment (set_clock.cpp)."""
import struct
import subprocess
import threading

from sessions import ROOT


class Clock:
    def __init__(self, folder, ahead=0.0):
        library, self.path = folder / "set_clock.so", folder / "clock"
        subprocess.run(["g++", "-std=c++17", "-shared", "-fPIC", "-O1", "-o", str(library), str(ROOT / "test/set_clock.cpp"), "-ldl"], check=True)
        self.env = {"LD_PRELOAD": str(library), "SET_CLOCK": str(self.path)}
        self.path.write_bytes(bytes(8))
        self.set(ahead)

    def set(self, ahead):
        """\\param ahead  of the true time, in s"""
        self.ahead = ahead
        with open(self.path, "r+b") as file:  # the programs have it mapped
            file.write(struct.pack("=q", round(1e9 * ahead)))

    def drift(self, rate):
        """From now on, in s a second, until `stop` of what it gives is set."""
        stop = threading.Event()

        def go_on():
            while not stop.wait(0.05):
                self.set(self.ahead + 0.05 * rate)
        threading.Thread(target=go_on, daemon=True).start()
        return stop
