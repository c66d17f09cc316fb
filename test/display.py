import os
import subprocess


class Display:
    """A virtual screen, so that the picture can be looked at."""

    def __init__(self, size="1280x900"):
        self.size, self.name = size, None
        self.start()

    def start(self):
        """Also again after close(), by the same name."""
        read, write = os.pipe()
        # -noreset: as on a desktop, what one program leaves at the root window stays when it goes.
        # -arinterval: a key that is held repeats each 2 ms, so that no repeat can pass for a press by luck.
        self.process = subprocess.Popen(["Xvfb", *([self.name] if self.name else []), "-noreset", "-arinterval", "2", "-displayfd", str(write),
                                         "-screen", "0", f"{self.size}x24", "+extension", "GLX"], pass_fds=[write],
                                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as pipe:
            self.name = ":" + pipe.readline().strip()

    def shot(self, path):
        subprocess.run(["import", "-window", "root", str(path)], check=True, timeout=30,
                       env=dict(os.environ, DISPLAY=self.name))

    def close(self):
        self.process.terminate()
        self.process.wait()
