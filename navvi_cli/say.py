"""What a person reads: plain lines, without colour, and none is written over."""
import sys

from .places import NAVVI


class Failure(Exception):
    """Ends the command. The sentence says what is wrong, where, and what is allowed; None where that was printed already."""

    def __init__(self, sentence, code=1):
        super().__init__(sentence)
        self.sentence, self.code = sentence, code


def fail(sentence, code=1):
    raise Failure(sentence, code)


def tell(line, file=None):
    """Prints a line, in which the command is named as a person types it here."""
    print(line.replace("./navvi", NAVVI), file=file, flush=True)


def say(sentence):
    tell(f"navvi: {sentence}")


def aside(sentence):
    """What is not the command's result."""
    tell(f"navvi: {sentence}", sys.stderr)
