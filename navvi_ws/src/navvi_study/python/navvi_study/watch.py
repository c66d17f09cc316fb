"""Tells a session in plain lines: one that runs (by ROS_MASTER_URI), or, with a trial's folder, a recorded one.

usage: watch.py WORDS_PER_MINUTE SPEECH [TRIAL_FOLDER]
WORDS_PER_MINUTE: no line comes before the last one can have been read at this pace; 0 for no pause. SPEECH: true or false;
by speech-dispatcher, then no line comes before the last one was spoken. Exit code 0; 2 if there is nothing to watch.
"""
import itertools
import math
import os
import pathlib
import sys
import threading
import time
from collections import namedtuple
from multiprocessing.pool import ThreadPool

from navvi_msgs.msg import Contact, Cue, DriveState, Guidance, TrialEvent, TrialState

Line = namedtuple("Line", "kind rank text")  # of rank 0 nothing is left out

TOPICS = {"/navvi/guidance": Guidance, "/navvi/cues": Cue, "/navvi/contacts": Contact, "/navvi/drive_state": DriveState,
          "/navvi/events": TrialEvent, "/navvi/trial_state": TrialState}

STATES = {
    Guidance.NO_GOAL: "No goal is set",
    Guidance.FOLLOWING: "Follow the path",
    Guidance.ARRIVED: "The goal is reached",
    Guidance.GOAL_REFUSED: "The goal is refused",
    Guidance.NO_ROUTE: "There is no route to the goal",
    Guidance.OFF_MESH: "The robot stands where no path can begin",
    Guidance.NO_MAP: "There is no map yet",
    Guidance.POSE_STALE: "The position is lost",
    Guidance.MAP_STALE: "The map is too old",
    Guidance.BLOCKED: "Wait, the way is blocked",
    Guidance.MAKE_ROOM: "Make room",
}
STOPS = {
    DriveState.COMMAND_LOST: "no command came from the stick",
    DriveState.COMMAND_INVALID: "the commands were not valid",
    DriveState.DRIVER_CHANGED: "the commands came by another connection",
    DriveState.CLOCK_JUMPED: "the time jumped",
    DriveState.EMERGENCY_STOP: "the emergency stop was pressed, release it",
}
WAITING = {TrialState.PREPARING: "A trial is being prepared", TrialState.CHOOSE_GOAL: "The trial waits for a goal",
           TrialState.READY: "The trial waits until its person presses start"}
SENSES = {Cue.SPEECH: "Said", Cue.RUMBLE: "Felt"}
SUPERSEDED = ("state", "distance", "wheels")  # of lines that wait only the newest counts
AGAIN = 2.0  # s, after which a cue that comes again is told again
LASTING = ("rumble", "flow")  # what is felt of near things, and what leads, all the time


def plain(word):
    return word.replace("_", " ")


def side_of(robot, point):
    """From where the robot stands and looks: ahead, left, right or behind."""
    yaw = 2.0 * math.atan2(robot.orientation.z, robot.orientation.w)
    angle = math.atan2(point.y - robot.position.y, point.x - robot.position.x) - yaw
    quarter = round(angle / (math.pi / 2.0)) % 4
    return ["ahead", "on the left", "behind", "on the right"][quarter]


def hour_of(angle):
    """Clockwise seen from above, rad."""
    return round(angle / (math.pi / 6.0)) % 12 or 12


class Teller:
    """Makes lines of messages; one that says nothing new is no line."""
    QUIET = 8.0  # s without a line, after which the distance is told again

    def __init__(self):
        self.start = None  # s, ROS time
        self.state, self.distance = None, math.inf
        self.told = {}     # the last text of each kind, and its stamp
        self.last = -math.inf

    def lines(self, message):
        """The lines that a message is worth, at its own time."""
        stamp = message.header.stamp.to_sec()
        if self.start is None or getattr(message, "type", "") == "TRIAL_START":
            self.start = stamp
        tell = {Guidance: self.guidance, Cue: self.cue, Contact: self.contact, DriveState: self.drive, TrialEvent: self.event,
                TrialState: self.trial}
        for kind, rank, text in next(tell[kind] for kind in tell if type(message)._type == kind._type)(message, stamp):
            before, at = self.told.get(kind, ("", 0.0))
            if before == text and (type(message)._type != Cue._type or stamp - at < AGAIN):
                continue
            self.told[kind] = text, stamp
            self.last = stamp
            yield Line(kind, rank, f"{text}. {max(0.0, stamp - self.start):.0f} s.")

    def guidance(self, message, stamp):
        """What the guide wants changes, or the goal came nearer while nothing else was to tell."""
        shown = message.state in (Guidance.FOLLOWING, Guidance.BLOCKED, Guidance.MAKE_ROOM)
        short = getattr(message, "ends_short", False)  # older records lack it
        left = f"{message.goal_distance:.0f} m to {'where the map ends' if short else 'go'}"
        to_go = f", {left}" if shown else ""
        if message.state != self.state:
            waited = self.state in (Guidance.BLOCKED, Guidance.MAKE_ROOM) and message.state == Guidance.FOLLOWING
            self.state, self.distance = message.state, message.goal_distance
            self.told.pop("distance", None)
            by = f", {plain(message.blocked_by)}" if message.blocked_by else ""
            text = "The way is free, wait until you are led on" if waited else STATES.get(message.state, f"State {message.state}")
            yield "state", 1, text + by + to_go
        elif shown and stamp - self.last >= self.QUIET and abs(self.distance - message.goal_distance) >= 1.0:
            self.distance = message.goal_distance
            corner = "the goal" if message.waypoint_is_goal else "the next corner"
            yield "distance", 3, (f"{left}, {corner} in {message.waypoint_distance:.0f} m"
                                  f" at {hour_of(message.waypoint_angle)} o'clock")

    def cue(self, message, _):
        if message.stage != Cue.STARTED or message.kind in LASTING:
            return
        sense = SENSES.get(message.modality, "Played")
        safety = message.priority == Cue.IMPORTANT
        side = "" if message.text or message.left == message.right else f", on the {'left' if message.left > message.right else 'right'}"
        yield sense, 1 if safety else 2, f"{sense}: {message.text or plain(message.kind)}{side}"

    def contact(self, message, _):
        yield "contact", 0, (f"Hit: {plain(message.thing_class)} {side_of(message.robot, message.point)}, at {message.speed:.1f} m/s, "
                             f"contact {message.seq}")

    def drive(self, message, _):
        if message.state == DriveState.STOPPED:
            yield "wheels", 0, f"The robot is stopped: {STOPS.get(message.reason, 'for safety')}; let go of the stick"
        elif message.state == DriveState.RUNNING and "wheels" in self.told:
            yield "wheels", 1, "The robot can be driven"

    def trial(self, message, _):
        if message.state in WAITING:
            yield "trial", 0, WAITING[message.state]

    def event(self, message, _):
        fields = dict(pair.split("=", 1) for pair in message.fields.split(";") if "=" in pair)
        if message.type == "TRIAL_START":
            yield "trial", 0, f"The trial begins: world {fields.get('world')}, seed {fields.get('seed')}, operator {fields.get('operator')}"
        elif message.type == "TRIAL_END":
            yield "trial", 0, f"The trial has ended: {fields.get('result')}, {plain(fields.get('reason', ''))}"
        elif message.type in ("DEVICE_LOST", "DEVICE_BACK"):
            yield "device", 0, f"The {fields.get('device')} {'is lost' if message.type == 'DEVICE_LOST' else 'is back'}"


class Pacer:
    """Keeps lines until they can be read: of state, distance and wheels only the newest; of others, but for what keeps the person safe, so many, the weightier
    first."""
    MOST = 4

    def __init__(self, words_per_minute, may_leave_out=True):
        self.words_per_minute, self.most = words_per_minute, self.MOST if may_leave_out else math.inf
        self.waiting, self.left_out, self.free_at = [], 0, -math.inf

    def reading_time(self, text):
        return max(0.7, 60.0 * len(text.split()) / self.words_per_minute) if self.words_per_minute else 0.0

    def offer(self, line):
        if self.most != math.inf:
            if line.kind in SUPERSEDED:
                self.waiting = [other for other in self.waiting if other.kind != line.kind]
            if len(self.waiting) >= self.most:
                least = max(self.waiting, key=lambda other: other.rank)  # the oldest of the least weight
                if least.rank > 1:
                    self.waiting.remove(least)
                    self.left_out += 1
        self.waiting.append(line)

    def next(self, now):
        """The text to show now; None while the last one is still being read, or if there is none."""
        if not self.waiting or now < self.free_at:
            return None
        line = min(self.waiting, key=lambda other: other.rank) if self.most != math.inf else self.waiting[0]
        self.waiting.remove(line)
        text = line.text + (f" {self.left_out} line{'s' * (self.left_out > 1)} left out." if self.left_out else "")
        self.left_out = 0
        self.free_at = now + self.reading_time(text)
        return text


class Voice:
    """speech-dispatcher. One that ends while it speaks never says that it is through; for one that ends or halts before it answers, its client
    waits for ever, so that runs in a thread."""
    LONGEST = 20.0  # s, of a line, and of the start
    ANSWER = 5.0    # s, to take a line

    def __init__(self):
        import speechd
        self.thread = ThreadPool(1)
        self.client = self.thread.apply_async(speechd.SSIPClient, ["navvi-watch"]).get(self.LONGEST)
        self.ends = (speechd.CallbackType.END, speechd.CallbackType.CANCEL)
        self.silent, self.began = threading.Event(), 0.0
        self.silent.set()

    def free(self):
        lost = not self.client._conn._communication_thread.is_alive()
        return self.silent.is_set() or lost or time.monotonic() - self.began > self.LONGEST

    def say(self, text):
        self.silent.clear()
        self.began = time.monotonic()
        end = {"callback": lambda *_, **__: self.silent.set(), "event_types": self.ends}
        self.thread.apply_async(self.client.speak, [text], end).get(self.ANSWER)

    def close(self):
        while not self.free():
            time.sleep(0.05)
        self.client.close()


class Screen:
    def __init__(self, speech):
        self.voice = Voice() if speech else None

    def free(self):
        return self.voice is None or self.voice.free()

    def show(self, text):
        print(text, flush=True)
        try:
            if self.voice:
                self.voice.say(text)
        except Exception:  # of many kinds
            self.voice = None
            print("speech-dispatcher does not answer; the lines go on without speech.", flush=True)

    def close(self):
        if self.voice:
            self.voice.close()


class DamagedBag(Exception):
    """From where on it cannot be read: "at all", "to its end"."""


def messages_of(bag):
    """Its messages but those on what is before a trial. Damaged bytes end in errors of many kinds, each of which means that."""
    import rosbag
    began = False
    try:
        with rosbag.Bag(str(bag)) as file:
            for _, message, _ in file.read_messages([topic for topic in TOPICS if topic != "/navvi/trial_state"]):
                began = True
                yield message
    except GeneratorExit:
        raise
    except Exception as problem:
        raise DamagedBag("to its end" if began else "at all") from problem


def watch_recorded(folder, pacer, screen):
    teller, ended = Teller(), False
    begun = itertools.dropwhile(lambda message: getattr(message, "type", "") != "TRIAL_START", messages_of(folder / "trial.bag"))
    first = next(begun, None)
    if first is None:
        screen.show("This bag lacks the beginning of the trial.")
    for message in messages_of(folder / "trial.bag") if first is None else itertools.chain([first], begun):
        for line in teller.lines(message) if not ended or message._type == Cue._type else ():
            pacer.offer(line)
            while pacer.waiting:
                show_next(pacer, screen)
        ended = ended or getattr(message, "type", "") == "TRIAL_END"


def show_next(pacer, screen):
    text = pacer.next(time.monotonic()) if screen.free() else None
    if text:
        screen.show(text)
    else:
        time.sleep(0.05)


def watch_live(pacer, screen):
    import rosgraph
    import rospy
    teller, lock = Teller(), threading.Lock()

    def take(message):
        with lock:
            for line in teller.lines(message):
                pacer.offer(line)
    rospy.init_node("watch", anonymous=True, disable_signals=True)
    for topic, kind in TOPICS.items():
        rospy.Subscriber(topic, kind, take, queue_size=1000)
    print("Watching the session; Ctrl-C ends that, and the session goes on.", flush=True)
    asked = time.monotonic()
    while True:
        with lock:
            text = pacer.next(time.monotonic()) if screen.free() else None
        if text:
            screen.show(text)
        time.sleep(0.05)
        if time.monotonic() - asked > 1.0:
            asked = time.monotonic()
            if not pacer.waiting and not rosgraph.is_master_online():
                return


def main():
    words_per_minute, speech = float(sys.argv[1]), sys.argv[2] == "true"
    folder = pathlib.Path(sys.argv[3]) if len(sys.argv) > 3 else None
    try:
        screen = Screen(speech)
    except Exception as problem:  # of many kinds, all of them: there is no speech-dispatcher
        print(f"navvi: speech-dispatcher cannot be used: {str(problem) or 'it does not answer'}. speech:=false shows the lines alone.", file=sys.stderr)
        return 2
    pacer = Pacer(words_per_minute, may_leave_out=folder is None)
    status = 0
    try:
        if folder:
            watch_recorded(folder, pacer, screen)
        else:
            watch_live(pacer, screen)
        screen.close()
        print("The trial's record ends here." if folder else "The session has ended.", flush=True)
    except KeyboardInterrupt:
        print("Watching was stopped by Ctrl-C.", flush=True)
        os._exit(130)
    except BrokenPipeError:  # who reads it has seen enough
        pass
    except DamagedBag as damage:
        screen.close()
        print(f"navvi: {folder / 'trial.bag'} is damaged and cannot be read {damage}. \"rosbag reindex\" may mend one that was cut off.",
              file=sys.stderr)
        status = 2
    sys.stdout.flush()
    os._exit(status)  # threads of rospy would keep it


if __name__ == "__main__":
    sys.exit(main())
