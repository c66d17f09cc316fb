"""Hear and feel each signal with its meaning, before it is needed.

What is felt on the pad, the short sounds, the words to stop and the hours of
the clock, one after another: first the meaning is spoken, then the signal is
given, by what gives it in a session. What is switched off is left out.
On the pad, arrow down goes on, arrow up goes back, the lower button gives it
again, select ends it; on the keyboard page down, page up, space, F8.
In a session, the spoken menu has it while no trial runs.

Exit codes
0: it was ended, or all was given. 1: it broke off. 2: a wrong argument, or
neither a pad nor a display for the keyboard.

Example
./navvi glossary feedback/language:=es
"""
from navvi_cli.lessons import give, lesson_arguments


def arguments(parser):
    lesson_arguments(parser, "whose settings are used.")


def run(args):
    give("glossary", args.words)
