"""Print a session in lines: state, what is said and felt, distance, hits.

For a terminal, a braille display or a screen reader. Without TRIAL it is the
session that runs on this machine (./navvi run in another terminal); with a
trial's folder, that record. Each line says something new and ends with the
seconds since the trial began (or since watching began).

For the voice of speech:=true alone, start the session as in the last example;
then words lead. In a running session the newest state and distance replace
those that wait, contacts and stops come first, and if much comes at once the
least important lines are left out; how many is said.

Exit codes
0: the session or the record ended. 2: a wrong argument, or nothing to watch.
130: Ctrl-C; the session goes on.

Examples
./navvi watch
./navvi watch trials/trial-20260101T120000Z > trial.txt
./navvi run speech:=false feedback/listener:=topic \\
feedback/sounds/enabled:=false
"""
import os
import sys

from navvi_cli.arguments import Words, completions, trial_in, trials_that_hold
from navvi_cli.network import Network, address_of, listeners, running_sessions
from navvi_cli.places import DEVEL, share
from navvi_cli.say import fail
from navvi_cli.workspace import build, enter, is_current

CHOICES = {"speech": ["true", "false"]}
HELP = ["TRIAL: the folder of a trial, such as trials/trial-20260101T120000Z.",
        "speech:=true: each line is also spoken, by speech-dispatcher, and the next one waits until it was.",
        "pace:=180: no line comes before the last one can have been read at so many words a minute; 0: no pause, as by default for a "
        "record where no terminal reads the lines.",
        "port:=11312: of several sessions, the one with this port."]


def arguments(parser):
    words = parser.add_argument("words", nargs="*", default=[], metavar="TRIAL|name:=value")
    words.completer = lambda prefix, **_: [*completions(prefix, ["pace", "port", "speech"], CHOICES), *trials_that_hold("trial.bag")]
    parser.more_help = lambda: HELP


def run(args):
    given = list(args.words)
    trial = trial_in(given.pop(0)) if given and ":=" not in given[0] else None
    words = Words(given, ["pace", "port", "speech"], choices=CHOICES)
    port = None if trial else port_of_session(words.get("port"))
    if not is_current(DEVEL / "lib/python3/dist-packages/navvi_msgs/msg/__init__.py"):
        build("navvi_msgs_generate_messages_py", "navvi_loopback")
    enter()
    if port:
        address = address_of(port)
        os.environ.update(ROS_MASTER_URI=f"http://{address}:{port}", ROS_IP=address)
        os.environ.pop("ROS_HOSTNAME", None)
        if not address.startswith("127."):  # where rospy listens there alone by itself
            os.environ["LD_PRELOAD"] = Network.preload()
    program = str(share("navvi_study") / "python" / "navvi_study" / "watch.py")
    slow = not trial or sys.stdout.isatty() or words.get("speech") == "true"
    os.execv(sys.executable, [sys.executable, program, words.get("pace", "180" if slow else "0"), words.get("speech", "false"), *([str(trial)] if trial else [])])


def port_of_session(wanted):
    ports = running_sessions()
    if wanted:
        if int(wanted) not in ports and not listeners(wanted):
            allowed = " ".join(f"port:={port}" for port in ports)
            fail(f"no session runs at port:={wanted}; {f'allowed are: {allowed}' if ports else 'start one, such as with ./navvi run'}.", 2)
        return wanted
    if not ports:
        fail("no session runs on this machine; start one with \"./navvi run\", or name a trial's folder, such as trials/trial-20260101T120000Z.", 2)
    if len(ports) > 1:
        fail(f"several sessions run; one of these is allowed: {' '.join(f'port:={port}' for port in ports)}", 2)
    return ports[0]
