"""What glossary and calibrate share: feedback_node alone, until it ends."""
import tempfile
from pathlib import Path

from .arguments import LaunchFile, add_words, words_for
from .network import Network
from .places import program
from .say import fail, say
from .session import Launch, check_operator, check_parameters, has_display, has_pad, prepare

CHOICES = {"operator": ["auto", "pad", "keyboard"], "speech": ["true", "false"]}


def lesson_arguments(parser, person):
    add_words(parser, "lesson.launch", f"person:=NAME: {person}", "feedback/NAME:=VALUE: any parameter of feedback_node.", choices=CHOICES)


def give(lesson, given):
    launch_file = LaunchFile("lesson.launch")
    words = words_for(launch_file, given, CHOICES)
    words.update({"lesson": lesson, "speech": words.get("speech", "true"), "profile": words.get("profile", "default")})
    if words.setdefault("operator", "auto") == "auto":
        words["operator"] = "pad" if has_pad() else "keyboard"
        if not has_pad() and not has_display():
            fail("there is neither a game controller nor a display for the keyboard; a lesson needs one of them, such as a pad at USB.", 2)
    check_operator(words, "operator:=keyboard needs")
    prepare(words, ["feedback_node", "navvi_loopback"], [program("navvi_feedback", "feedback_node")], check_parameters)
    network = Network()
    with tempfile.TemporaryDirectory() as folder:
        log = Path(folder) / "log"
        say(f"{lesson} begins in some seconds, with the {words['operator']}; what to press is spoken. Ctrl-C in this terminal ends it, too.")
        launch = Launch(launch_file, words, log, network)
        if not launch.run() and not launch.interrupted:
            fail(f"it broke off: {launch.log.fatal or log.read_text()[-500:]}")
