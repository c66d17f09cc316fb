"""What a person reads: plain lines, without colour, and none is written over."""
import sys


class Failure(Exception):
    """Ends the command. The sentence says what is wrong, where, and what is allowed; None where that was printed already."""

    def __init__(self, sentence, code=1):
        super().__init__(sentence)
        self.sentence, self.code = sentence, code


def fail(sentence, code=1):
    raise Failure(sentence, code)


def say(sentence):
    print(f"navvi: {sentence}", flush=True)


def aside(sentence):
    """What is not the command's result."""
    print(f"navvi: {sentence}", file=sys.stderr, flush=True)
