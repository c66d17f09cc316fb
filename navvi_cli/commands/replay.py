"""Show, speak and rumble a recorded trial again.

First the summary is counted again from the bag, and whether they agree is
printed.

Exit codes
0: replayed. 1: bag and summary differ, or the bag is damaged. 2: a wrong
argument, or no such trial.

Example
./navvi replay trials/trial-20260101T120000Z skip:=30
"""
import os
import re

from navvi_cli.arguments import LaunchFile, add_trial, add_words, words_for
from navvi_cli.network import Network
from navvi_cli.places import program
from navvi_cli.say import fail, say
from navvi_cli.session import Launch, resolve_rviz
from navvi_cli.trials import conditions
from navvi_cli.workspace import build, enter, show

CHOICES = {"speech": ["true", "false"]}


def arguments(parser):
    add_trial(parser)
    add_words(parser, "replay.launch", choices=CHOICES)


def run(args):
    launch_file = LaunchFile("replay.launch")
    words = words_for(launch_file, args.words, CHOICES)
    resolve_rviz(words)
    settings = recorded(args.trial)
    words.update({"speech": words.get("speech", "true"), "bag": args.trial / "trial.bag", **{**settings, **words}})
    build("session", "scene_player", "summary_from_bag", "cue_player", *(["navvi_rviz"] if words["rviz"] == "true" else []))
    enter()
    status = show(program("navvi_study", "summary_from_bag"), args.trial)
    if status > 1:
        fail("this trial cannot be replayed; see above. rosbag reindex may mend a bag that was cut off.")
    network = Network()
    say(f"replaying {args.trial}; Ctrl-C stops it. For ROS tools, in a second terminal: {network.second_terminal()}")
    log = args.trial / "replay.log" if os.access(args.trial, os.W_OK) else "/dev/null"
    launch = Launch(launch_file, words, log, network)
    if not launch.run() and not launch.interrupted:
        fail(f"the replay broke off; the log {log} says why. {launch.log.fatal}".strip())
    if status:
        fail("the bag and the summary of this trial do not agree, as printed at the start.")
    say("the replay has ended.")


def recorded(trial):
    """The voice and the mesh of the record, as parameters of cue_player and nav_node; what older records lack is left to them."""
    fields = conditions(trial)
    settings = fields["settings"]
    speaker = {name: settings.get(f"feedback/speaker/{name}", "") for name in ("rate", "pitch", "volume")}
    if fields.get("voice", "unknown") != "unknown":
        speaker["voice"] = fields["voice"]
    mesh = {name[len("nav/mesh/"):]: value for name, value in settings.items() if name.startswith("nav/mesh/")}
    return {"speaker": yaml(speaker), "mesh": yaml(mesh)}


def yaml(values):
    """Of a record's values only plain words and numbers are handed to roslaunch."""
    return "{" + ", ".join(f"{name}: {value}" for name, value in values.items() if re.fullmatch(r"[A-Za-z0-9/_+.-]+", value)) + "}"
