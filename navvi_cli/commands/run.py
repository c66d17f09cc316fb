"""Run a session: a person drives the robot to the goal, and it is recorded.

Without arguments the pad drives if there is one, else the keyboard, else a
simulated person. It begins with six lines that tell what to press, where the
record goes and how to stop (Ctrl-C), and ends with how it went.

Exit codes
0: the goal was reached, of a job each place. 1: it was not, or a program of
the session crashed. 2: a wrong argument, nothing started.
"""
import importlib.util
import os
import re
import time
from contextlib import suppress
from pathlib import Path

from navvi_cli import trials, workspace
from navvi_cli.arguments import LaunchFile, Words, add_words, words_for
from navvi_cli.network import FarNetwork, Network
from navvi_cli.places import TRIALS, config_of, program
from navvi_cli.say import fail, say, tell
from navvi_cli.session import Launch, accepted, check_operator, check_parameters, has_display, has_pad, prepare, resolve_rviz
from navvi_cli.worlds import Verdict, check_world

FEEDBACK = program("navvi_feedback", "feedback_node")
PLACES = ("places", "jobs")  # arguments that name such a file
PERSON = ["robot:=HOST: drive what \"./navvi robot start\" runs on another machine.",
          "person:=NAME: whose settings are used, from ~/.navvi/people/NAME.yaml, and kept there when they are changed in the menu; a new name "
          "begins a new file.",
          "PART/NAME:=VALUE: any parameter of a node, such as feedback/speaker/rate:=300; \"./navvi parameters feedback\" lists them."]
DRIVE = {
    "pad": "press start; then the left stick of the pad drives, up for forward.",
    "keyboard": "press enter; then the arrow keys drive, with Shift slowly, while NavVI's small window or the picture (not of paper) has the focus.",
    "simulated": "nothing to do; a simulated person drives.",
}
ASK = {
    "pad": "the lower button repeats the direction, the right one tells the goal, the left one what is near.",
    "keyboard": "space repeats the direction, G tells the goal, A what is near.",
    "simulated": "what it hears is in the log below, and in \"./navvi watch\".",
}


def arguments(parser):
    add_words(parser, "live.launch", *PERSON)


def run(args):
    return session(args.words)


def session(given, begun=None):
    """\\param begun  takes the names of its trials"""
    if any(word.startswith("robot:=") for word in given):
        return far_session(given)
    launch_file = LaunchFile("live.launch")
    words = words_for(launch_file, given)
    complete(words)
    check(words)
    targets = ["session", *(["navvi_rviz"] if words["rviz"] == "true" else [])]
    checkers = [program("navvi_sim", "world_tool"), program("navvi_nav", "navmesh_tool"), *([FEEDBACK] if any(map(words.get, PLACES)) else [])]
    prepare(words, targets, checkers, check_by_programs)
    return drive(launch_file, words, Network(), f"world {words['world']}, seed {words.get('seed', 1)}", begun)


def drive(launch_file, words, network, where, begun=None):
    places = len(job_of(words))  # a place that is remembered meanwhile is added to the file
    log = words["out"] / f"session-{time.strftime('%Y%m%dT%H%M%SZ', time.gmtime())}-{network.port}.log"
    announce(words, log, network, where)
    launch = Launch(launch_file, words, log, network)
    whole = launch.run() or launch.interrupted
    if begun is not None:
        begun += launch.log.begun
    why = "." if launch.interrupted else f"; the log {log} says why. {launch.log.fatal}".rstrip()
    return report(words["out"], launch.log.begun, why, places) or int(not whole)


def far_session(given):
    """The person's side alone: the robot's is on another machine."""
    where = Words([word for word in given if word.startswith("robot:=")], ["robot"])["robot"]
    launch_file = LaunchFile("person.launch")
    words = words_for(launch_file, [word for word in given if not word.startswith("robot:=")])
    complete(words, ())
    check(words)
    if not any(word.startswith("trial/record:=") for word in words.parameters):
        words.parameters.append("trial/record:=robot")
    prepare(words, ["session", *(["navvi_rviz"] if words["rviz"] == "true" else [])], [FEEDBACK], check_lists)
    network = FarNetwork(where)
    words.setdefault("patience", "900")  # over a slow connection nodes take their time to meet
    words["clock"] = network.clock()
    words.setdefault("contacts", "counted" if network.tells_contacts else "unknown")  # without a bumper
    try:
        return drive(launch_file, words, network, f"the robot at {where}")
    finally:
        with suppress(KeyboardInterrupt):
            if not network.near.finish(3.0):
                say("the robot's machine is told that this session has ended; Ctrl-C does not wait for that.")
                network.near.finish(60.0)


HERE = {"sensing": "truth", "world": "warehouse"}


def complete(words, here=HERE):
    """What an argument is if it is not given."""
    if words.setdefault("operator", "auto") == "auto":
        words["operator"] = "pad" if has_pad() else "keyboard" if has_display() else "simulated"
    check_operator(words, "operator:=keyboard and operator:=simulated need")
    if words["operator"] == "simulated":
        words.setdefault("once", "true")
        words.setdefault("limit", "600")
    resolve_rviz(words)
    for name, value in {"speech": "auto", "profile": "default", "once": "false", "lesson": "none", "out": str(TRIALS), **dict(here)}.items():
        words.setdefault(name, value)


def check(words):
    """What can be refused without a program."""
    for height in (word.partition(":=")[2] for word in words.parameters if word.startswith("nav/mesh/robot_height:=")):
        if re.fullmatch(r"0\.[0-7]\d*", height):
            fail("nav/mesh/robot_height is less than 0.8 m, the height of the simulated robot; allowed is that or more.", 2)
    if words["operator"] == "simulated" and words["lesson"] != "none":
        fail("the tutorial needs a person: a game controller, or a display for the keyboard, such as with operator:=keyboard.", 2)
    if words["operator"] == "simulated" and words["speech"] == "false" and "feedback/lead:=hand" not in words.parameters:
        fail("the simulated person drives by what it hears, and with speech:=false that is nothing; leave speech out, lead by the motors "
             "(feedback/lead:=hand), or drive yourself, such as with operator:=keyboard.", 2)
    if words.get("lsl") == "true" and importlib.util.find_spec("pylsl") is None:
        fail("lsl:=true needs the Python package pylsl, which Debian lacks; \"/usr/bin/python3 -m pip install --user --break-system-packages "
             "pylsl\" installs it.", 2)
    words["out"] = Path(os.path.abspath(words["out"]))
    try:
        words["out"].mkdir(0o700, parents=True, exist_ok=True)
    except OSError as problem:
        fail(f"the folder {words['out']} cannot be made: {problem.strerror}; out:=FOLDER names another, such as out:=/tmp/trials.", 2)
    if "world" in words:
        check_world(words)
    for name in filter(words.get, PLACES):
        words[name] = Path(words[name]).resolve()


def job_of(words):
    """The places of the job; none without one."""
    import yaml
    try:
        return words.get("jobs") and yaml.safe_load(words["jobs"].read_text(encoding="utf-8")) or []
    except (UnicodeError, yaml.YAMLError):
        fail(f"{words['jobs']} cannot be read; YAML in UTF-8 is allowed, which most editors offer when they save.", 2)


def check_lists(words):
    check_parameters(words)
    let_motors_rest(words)
    for name in filter(words.get, PLACES):
        accepted(FEEDBACK, [f"places:={words[name]}"])
    if words.get("jobs") and not job_of(words):
        fail(f"{words['jobs']}: a job must have at least one place.", 2)


def let_motors_rest(words):
    """Where a condition or the person has those of a pad off, no trial waits for them, as person.launch else lets it."""
    import yaml
    haptics = yaml.safe_load(words.get("feedback_parameters", "{}")).get("haptics") or {}
    if words["operator"] == "pad" and haptics.get("enabled") is False:
        parameters = {"require": ["speech"] if words["speech"] == "true" else [], **yaml.safe_load(words.get("trial_parameters", "{}"))}
        words["trial_parameters"] = yaml.safe_dump(parameters, default_flow_style=True, width=1 << 20).strip()


def check_by_programs(words):
    """The nodes would refuse the same, but only when all have started."""
    check_lists(words)
    session = [f"{name}:={words[name]}" for name in ("models", "classes", "seed", "start", "goal") if name in words]
    Verdict(words["world"], [f"config:={config_of('navvi_sim', words['profile'])}", *session, *words.parameters_of("sim")],
            words.parameters_of("nav"), words["profile"], places=[(place["x"], place["y"]) for place in job_of(words)]).require()


def announce(words, log, network, where):
    """Six lines: what begins, what to press, where the record goes, how to stop."""
    operator = words["operator"]
    own_buttons = any(word.startswith("feedback/buttons/") for word in words.parameters)
    drive = "listen; each step of the tutorial is spoken." if words["lesson"] == "tutorial" else DRIVE[operator]
    ask = "as your feedback/buttons say." if own_buttons and operator == "pad" else ASK[operator]
    say(f"a session begins in some seconds: {where}, profile {words['profile']}, operator {operator}.")
    tell(f"To drive: {drive}\nTo hear more: {ask}\nThe record: a new folder in {words['out']}; the output of the programs: {log}\n"
         "To stop: Ctrl-C in this terminal.\n"
         f"In a second terminal: ./navvi watch prints it in lines; for ROS tools: {network.second_terminal()}")


def report(out, begun, why, places=0):
    """The end of a session, by the summary of its last trial. \\param begun  names of trials
    \\param why  there is none, as the end of a sentence \\param places  of its job"""
    workspace.show(program("navvi_study", "close_trials"), out)
    folders = trials.summed_up(begun, out)
    if not folders:
        fail(f"the session ended without a trial{why}")
    legs = {trials.conditions(folder).get("job_name"): folder for folder in folders}  # the last of each place of a job
    ends = [trials.summary(folder) for name, folder in legs.items() if name]
    missed = len(ends) < places or any(row["result"] != "reached" and row["reason"] != "goal_at_start" for row in ends)
    return trials.report(folders[-1]) or int(missed)
