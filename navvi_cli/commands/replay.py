"""Show, speak and rumble a recorded trial again.

First the summary is counted again from the bag, and whether they agree is
printed. --at=collision:2 begins 5 s before the second collision; any type of
the journal can be named so, in small letters, or a time such as --at=73. In a
terminal, p and Enter pauses and goes on, s and Enter goes on for a second.

Exit codes
0: replayed. 1: bag and summary differ. 2: a wrong argument, no such trial, or
a damaged bag.

Examples
./navvi replay trials/trial-20260101T120000Z skip:=30
./navvi replay trials/trial-20260101T120000Z --at=collision:2
"""
import os
import re
import sys
import threading
import time

from navvi_cli.arguments import LaunchFile, add_trial, add_words, words_for
from navvi_cli.network import Network
from navvi_cli.places import program
from navvi_cli.say import fail, say
from navvi_cli.session import Launch, resolve_rviz
from navvi_cli.trials import conditions, times
from navvi_cli.workspace import build, enter, show

CHOICES = {"speech": ["true", "false"]}
BEFORE = 5.0  # s, that a replay begins before the event it is asked for
KEYS = "p and Enter: pause, or go on; s and Enter: go on for a second"


def arguments(parser):
    add_trial(parser)
    parser.add_argument("--at", metavar="EVENT:N", help="begin 5 s before that event, such as collision:2, or at a time in s.")
    add_words(parser, "replay.launch", choices=CHOICES)


def run(args):
    launch_file = LaunchFile("replay.launch")
    words = words_for(launch_file, args.words, CHOICES)
    if args.at and "skip" in words:
        fail("--at and skip:= both say where to begin; one of them is allowed.", 2)
    onset = moment(args.trial, args.at) if args.at else None
    resolve_rviz(words)
    settings = recorded(args.trial)
    words.update({"speech": words.get("speech", "true"), "bag": args.trial / "trial.bag", **{**settings, **words}})
    build("session", "scene_player", "count_trial", "cue_player", *(["navvi_rviz"] if words["rviz"] == "true" else []))
    enter()
    status = show(program("navvi_study", "count_trial"), "bag", args.trial)
    if status > 1:
        fail("this trial cannot be replayed; see above. rosbag reindex may mend a bag that was cut off.", 2)
    if onset is not None:
        words["skip"] = f"{skip_of(args.trial, onset):.2f}"
    if float(words.get("skip", 0)) >= (length := length_of(args.trial)):
        fail(f"skip:={words['skip']} leaves nothing to replay; the bag has {length:.0f} s.", 2)
    network = Network()
    say(f"replaying {args.trial}; Ctrl-C stops it. For ROS tools, in a second terminal: {network.second_terminal()}")
    log = args.trial / "replay.log" if os.access(args.trial, os.W_OK) else "/dev/null"
    launch = Launch(launch_file, words, log, network)
    if sys.stdin and sys.stdin.isatty():
        say(KEYS + ".")
        threading.Thread(target=Keys(float(words.get("rate", 1))).read, args=(sys.stdin,), daemon=True).start()
    if not launch.run() and not launch.interrupted:
        fail(f"the replay broke off; the log {log} says why. {launch.log.fatal}".strip())
    if status:
        fail("the bag and the summary of this trial do not agree, as printed at the start.")
    say("the replay has ended.")


def moment(trial, at):
    """s since the trial began, of the event that `at` names, or the time it is."""
    onsets = times(trial)
    if "TRIAL_START" not in onsets:
        fail(f"--at needs the beginning of the trial (TRIAL_START), and {trial / 'journal.csv'} lacks it; allowed is skip:= in its place.", 2)
    if re.fullmatch(r"[0-9]+(\.[0-9]+)?", at):
        return float(at)
    name, _, number = at.partition(":")
    kind = name.upper().replace("-", "_")
    if kind not in onsets or not re.fullmatch(r"([1-9][0-9]*)?", number):
        known = ", ".join(sorted(name.lower() for name in onsets))
        fail(f"--at is \"{at}\"; allowed are a time in s, and a type of this trial's journal, with its number, such as collision:2: {known}.", 2)
    found = onsets[kind]
    if int(number or 1) > len(found):
        fail(f"--at is \"{at}\", and this trial has {len(found)} of these; allowed is {name}:1 to {name}:{len(found)}.", 2)
    return max(0.0, found[int(number or 1) - 1] - BEFORE)


def skip_of(trial, onset):
    """s after the first message of the bag, which was recorded some time before the trial began."""
    import rosbag
    start = times(trial, since_start=False)["TRIAL_START"][0]
    with rosbag.Bag(str(trial / "trial.bag")) as bag:
        return max(0.0, start + onset - bag.get_start_time())


def length_of(trial):
    """s."""
    import rosbag
    with rosbag.Bag(str(trial / "trial.bag")) as bag:
        return bag.get_end_time() - bag.get_start_time()


class Keys:
    """Pause and step of the player, by lines of the terminal."""

    def __init__(self, rate, pause=None):
        self.second, self.paused = 1.0 / rate, False
        self.pause = pause or self._call

    def read(self, lines):
        for line in lines:
            self.obey(line.strip())

    def obey(self, key):
        if key == "p":
            if self.pause(not self.paused):
                self.paused = not self.paused
                say("the replay is paused." if self.paused else "the replay goes on.")
        elif key == "s":
            self.paused = not self.pause(False) and self.paused
            time.sleep(self.second)
            if self.pause(True):
                self.paused = True
                say("a second on; the replay is paused.")
        elif key:
            say(KEYS + ".")

    @staticmethod
    def _call(paused):
        """Whether the player did so."""
        import rospy
        from std_srvs.srv import SetBool
        try:
            rospy.ServiceProxy("/player/pause_playback", SetBool)(paused)
        except (rospy.ServiceException, rospy.ROSException, OSError) as problem:
            say(f"the player does not answer: {problem}.")
            return False
        return True


def recorded(trial):
    """The voice and the mesh of the record, as parameters of cue_player and nav_node; what older records lack is left to them."""
    fields = conditions(trial)
    settings = fields["settings"]
    speaker = {name: settings.get(f"feedback/speaker/{name}", "") for name in ("rate", "pitch", "volume")}
    if fields.get("voice", "unknown") != "unknown":
        speaker["voice"] = fields["voice"]
    # Zones are in the bag; their file may have changed.
    mesh = {name[len("nav/mesh/"):]: value for name, value in settings.items() if name.startswith("nav/mesh/") and name != "nav/mesh/zones"}
    return {"speaker": yaml(speaker), "mesh": yaml(mesh)}


def yaml(values):
    """Of a record's values only plain words and numbers are handed to roslaunch."""
    return "{" + ", ".join(f"{name}: {value}" for name, value in values.items() if re.fullmatch(r"[A-Za-z0-9/_+.-]+", value)) + "}"
