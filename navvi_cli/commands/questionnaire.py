"""Ask questions by voice, and take answers by stick and buttons.

Arrow up and down, or the stick, find the answer, start confirms it, the left
arrow goes back, the lower button repeats, select is for "rather not say"; on
the keyboard page up, page down, enter, back space, space, F8. A direction is
asked for with "point: true" and answered by the stick. Each answer is saved at
once. A study asks its questionnaires by this.

Exit codes
0: it has ended. 1: it broke off. 2: a wrong argument, or neither a pad nor a
display for the keyboard.

Example
./navvi questionnaire feedback/questions:=asked.yaml feedback/record:=told.csv
"""
from navvi_cli.lessons import give, lesson_arguments


def arguments(parser):
    lesson_arguments(parser, "whose settings are used.")


def run(args):
    give("questionnaire", args.words, "feedback/questions:=",
         "which questions? feedback/questions:=FILE is needed: a YAML file with the key items, a list of questions, each with name, ask, values "
         "and spoken, or with name, ask and point: true.")
