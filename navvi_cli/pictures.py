"""Tools draw SVG; librsvg makes the PNG that a person may want."""
import os
import subprocess
import tempfile
from pathlib import Path

from .say import fail, say


def picture(word):
    """The argument type of a picture's file."""
    if Path(word).suffix not in (".svg", ".png"):
        fail(f"\"{word}\" is not a picture; .svg and .png are allowed.", 2)
    return Path(word)


def draw(path, run, *words):
    """Lets run(...) draw by a tool with -o; its exit code."""
    if path is None:
        return run(*words)
    if path.suffix == ".svg":
        status = run(*words, "-o", path)
    else:
        with tempfile.NamedTemporaryFile(suffix=".svg") as svg:
            status = run(*words, "-o", svg.name)
            if os.stat(svg.name).st_size:
                drawn = subprocess.run(["rsvg-convert", "-o", str(path), svg.name], stderr=subprocess.PIPE, text=True)
                if drawn.returncode:
                    why = drawn.stderr.strip().splitlines()[-1:] or ["rsvg-convert ended with an error"]
                    fail(f"the picture \"{path}\" cannot be drawn: {why[0]}. A picture in .svg needs no rsvg-convert.", 2)
    if status == 0:
        say(f"the picture is in {path}.")
    return status
