"""What glossary and calibrate share: feedback_node alone, until it ends."""
import os
import tempfile
import time
from pathlib import Path

from .arguments import LaunchFile, Words, add_words, words_for
from .network import Network
from .places import program
from .say import fail, say
from .session import Launch, check_operator, check_parameters, has_display, has_pad, prepare

NOT_KEPT = "The results of the lesson are not kept"  # as feedback_node logs
CHOICES = {"operator": ["auto", "pad", "keyboard"], "speech": ["true", "false"]}


def lesson_arguments(parser, person):
    add_words(parser, "lesson.launch", f"person:=NAME: {person}", "out:=FOLDER: keeps the log there, and what was measured.", "feedback/NAME:=VALUE: any parameter of feedback_node.", choices=CHOICES)


def give(lesson, given, needed="", sentence=""):
    """\\param needed  begin of a word without which the sentence refuses it
    Returns the exit code."""
    if needed and not any(word.startswith(needed) for word in given):
        fail(sentence, 2)
    launch_file = LaunchFile("lesson.launch")
    out = Words([word for word in given if word.startswith("out:=")], ["out"]).get("out")
    out = Path(os.path.abspath(out)) if out else None
    kept = out and out / f"{lesson}-{time.strftime('%Y%m%dT%H%M%SZ', time.gmtime())}"
    record = [f"feedback/record:={kept}.csv"] if kept and lesson == "calibrate" and "feedback/record:=" not in " ".join(given) else []
    words = words_for(launch_file, [word for word in given if not word.startswith("out:=")] + record, CHOICES)
    words.update({"lesson": lesson, "speech": words.get("speech", "true"), "profile": words.get("profile", "default")})
    if words.setdefault("operator", "auto") == "auto":
        words["operator"] = "pad" if has_pad() else "keyboard"
        if not has_pad() and not has_display():
            fail("there is neither a game controller nor a display for the keyboard; a lesson needs one of them, such as a pad at USB.", 2)
    check_operator(words, "operator:=keyboard needs")
    prepare(words, ["feedback_node", "navvi_loopback"], [program("navvi_feedback", "feedback_node")], check_parameters)
    network = Network()
    with tempfile.TemporaryDirectory() as folder:
        if out:
            make(out)
        check_record(words)
        log = Path(f"{kept}.log") if kept else Path(folder) / "lesson.log"
        say(f"{lesson} begins in some seconds, with the {words['operator']}; what to press is spoken. Ctrl-C in this terminal ends it, too.")
        launch = Launch(launch_file, words, log, network)
        if not launch.run() and not launch.interrupted:
            fail(f"it broke off: {launch.log.fatal or log.read_text(errors='replace')[-500:]}")
        if NOT_KEPT in log.read_text(errors="replace"):
            fail("what was measured could not be written, as said above; it is needed once more, in a place that can be, such as out:=/tmp.")
        if kept:
            say(f"the log is {log}{f', what was measured {kept}.csv' if Path(f'{kept}.csv').exists() else ''}.")
    return 130 if launch.interrupted else 0


def check_record(words):
    """Before a person has spent minutes."""
    for path in (word.partition(":=")[2] for word in words.parameters if word.startswith("feedback/record:=/")):
        if os.path.isdir(path) or not os.access(os.path.dirname(path), os.W_OK):
            fail(f"feedback/record:={path} cannot be written; a file in a folder that can be is needed.", 2)


def make(folder):
    try:
        folder.mkdir(0o700, parents=True, exist_ok=True)
    except OSError as error:
        fail(f"out:={folder} cannot be made: {error.strerror}; a folder that can be written is needed.", 2)
