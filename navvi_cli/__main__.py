"""Starts the command from a checkout and from an install space; the script `navvi` beside this folder calls it."""
import sys
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parent.parent)

from navvi_cli.main import main  # noqa: E402  (found by the path above)

sys.exit(main(sys.argv[1:]))
