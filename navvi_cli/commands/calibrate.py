"""Find what a person feels of a pad, and how fast they let go.

By voice and buttons, in about three minutes: the weakest strength of each
motor that is felt, the strength that is comfortable, and the time from the
sound that ends a turn until the stick is let go (the median of five).
What was found is told, and saved if you confirm it (start, or enter). Select,
on the keyboard F8, ends it, and nothing is saved. Any other button, or 12 s of
silence, repeats the prompt; a release after more than 0.8 s is asked again.

What was found is saved in the person's settings as feedback/haptics/pads, for
each model of pad by itself, and feedback/sounds/turn/stopping_delay, and used
in each session with person:=NAME.

Exit codes
0: saved, or ended by the person. 1: it broke off. 2: a wrong argument, or
neither a pad nor a display for the keyboard.

Example
./navvi calibrate person:=anna
"""
from navvi_cli.lessons import give, lesson_arguments


def arguments(parser):
    lesson_arguments(parser, "whose settings are used, and where the values are saved.")


def run(args):
    return give("calibrate", args.words, "person:=", "whose settings are these? person:=NAME is needed, such as person:=anna.")
