"""How a trial is driven and a questionnaire asked: live by ./navvi, or without ROS by simulated people."""
import os
import select
import signal
import subprocess
import time
import zlib

from . import questionnaire
from .errors import StudyError
from .journal import utc_now
from .study import write_safely

DESK = "Enter after each. m: mark; n TEXT: note; i TEXT: you intervened; p: pause after this step; a: end the trial now."
LONGEST = 1 << 16  # bytes of a line that is typed
# Parameters of trials_bench: it has no voice, and so no other language; no frames, and no scans.
REHEARSED = ("sim/", "person/", "trial/", *(f"{node}/{part}" for node, parts in {
    "feedback": ("buttons/", "cues/", "drive/", "haptics/", "lead", "link/", "sounds/"),
    "nav": ("alpha", "carve_", "guidance", "map_timeout", "mesh", "most_cylinders", "replan", "search", "smoothing", "stand_off"),
    "perception": ("map/", "robot_radius", "tracks", "wall")}.items() for part in parts))


def learnt_before(summaries):
    """What the guide has learnt of a person's stops in the last trial that tells, for the next one."""
    words = {}
    for summary in summaries:
        for name in ("stopping_delay", "stopping_spread"):
            value = summary.get(f"{name}_s", "n/a")
            if value != "n/a":
                words[f"feedback/sounds/turn/{name}"] = value
    return words


class LiveRunner:
    """By ./navvi, with the experimenter's lines from this terminal."""

    def __init__(self, study, navvi, close_trials, typed=False):
        self.study, self.navvi, self.close_trials, self.typed = study, str(navvi), str(close_trials), typed
        self.asks = "the experimenter" if typed else "nobody" if study.plan.operator == "simulated" else "the voice"  # questionnaires
        self.paused = False  # by the experimenter: nothing begins until a line comes
        self.lines = Lines()

    def trial(self, participant, step, attempt, folder, lock):
        """Returns when the session has ended, in whatever way."""
        words = [f"{name}:={value}" for name, value in self.arguments(participant, step, attempt, folder).items()]
        self.lines.drop()
        print("navvi: " + DESK)
        self._run(["run", *words], participant, lock, lambda row: self.study.note(participant, attempt, row))

    def arguments(self, participant, step, attempt, folder):
        """Of ./navvi run."""
        plan = self.study.plan
        simulated = plan.operator == "simulated"
        words = {**plan.condition(step.condition).arguments(), "operator": plan.operator, "participant": participant, "person": participant,
                 "world": str(plan.world_file(attempt) or attempt.world), "seed": attempt.seed, "limit": f"{step.limit or plan.limit:g}", "once": "true",
                 "out": folder, "feedback/locked": "true", "trial/locked": "true", **self._learnt(participant, attempt)}
        if plan.lsl:
            words["lsl"] = "true"
        if places := plan.places(attempt):  # a start is drawn for it, as in a rehearsal
            words["goal"] = "{:g},{:g}".format(*places[0])
        if simulated:
            words.update(rviz="false", **person_of(participant, "operator/person/"))
        else:
            words["speech"] = "true"
        return {**words, **plan.beside(attempt), **place_of(plan, participant, step, attempt)}

    def _learnt(self, participant, attempt):
        plan = self.study.plan
        if plan.learning == "frozen":
            return {"feedback/sounds/turn/learn": "false"}
        if plan.learning == "reset":
            return {}
        return learnt_before([self.study.summary(participant, other)
                              for other in self.study.progress().person(participant).attempts if other.trial])

    def ask(self, participant, step, items, answered, lock):
        """Asks the items. answered(ITEM, ANSWER, SECONDS) keeps each at once; without SECONDS where nobody took the time."""
        if self.typed:
            ask_in_terminal(step.asks, items, answered, self.lines.next)
        elif self.study.plan.operator == "simulated":
            step.simulate(participant, items, answered)
        else:
            self._ask_by_voice(participant, step, items, answered, lock)

    def _ask_by_voice(self, participant, step, items, answered, lock):
        about = step.asks_of(self.study.progress().person(participant))
        script = self.study.home(participant) / (f"{step.name}-a{about.number}.yaml" if about else f"{step.name}.yaml")
        record = script.with_suffix(".csv")
        if left := keep_answers(record, items, answered):  # what was answered before a crash is not asked again
            write_safely(script, questionnaire.script(left, step.asks.title, step.asks.intro))
            self._run(["questionnaire", f"feedback/questions:={script}", f"feedback/record:={record}", f"person:={participant}",
                       f"operator:={self.study.plan.operator}", f"out:={self.study.home(participant)}"], participant, lock)
            keep_answers(record, left, answered)

    def pause(self):
        """Waits for the experimenter where a pause was asked for."""
        if self.paused:
            self.lines.drop()
            print("navvi: paused; Enter goes on.", flush=True)
            self.lines.next()
        self.paused = False

    def command(self, words, participant, lock):
        """A command of ./navvi that needs a person. Returns its exit code; None where the person is simulated."""
        return None if self.study.plan.operator == "simulated" else self._run(words, participant, lock)

    def close(self, folder):
        """Puts the trials of a session in order that was killed."""
        if folder.exists():
            subprocess.run([self.close_trials, str(folder)], check=False)

    def _run(self, words, participant, lock, note=None):
        env = dict(os.environ, NAVVI_PEOPLE=str(self.study.home(participant) / "settings"), NAVVI_LOCKS=str(lock))
        # A group of its own: Ctrl-C goes to all of the session, and what it leaves is recorded here.
        process = subprocess.Popen([self.navvi, *map(str, words)], env=env, stdin=subprocess.DEVNULL, pass_fds=(lock,), process_group=0)
        desk = Desk(process, note, self.lines)
        before = signal.signal(signal.SIGINT, desk.interrupt)
        try:
            while process.poll() is None:
                desk.listen(0.2)
            self.paused = self.paused or desk.paused
            return process.returncode
        finally:
            signal.signal(signal.SIGINT, before)


class Lines:
    """What is typed: lines end at "\\n" alone, and bytes that are not UTF-8 are replaced."""

    def __init__(self, file=0):
        self.file, self.rest, self.open = file, b"", True

    def next(self, seconds=None):
        """A line without its end; None where none has come within so many seconds, or none will."""
        while not self._whole():
            if not self._read(seconds):
                return None
        if not self.rest:
            return None
        line, _, self.rest = self.rest.partition(b"\n")
        return line.decode(errors="replace").strip()

    def drop(self, seconds=0.0):
        """Reads for so many seconds while nothing takes what is typed, also all that was typed before."""
        end, most = time.monotonic() + seconds, LONGEST
        while True:
            left, held = max(0.0, end - time.monotonic()), len(self.rest)
            came = self._read(left)
            most -= len(self.rest) - held if left == 0.0 else 0
            while self.rest and self._whole():
                if line := self.next():
                    print(f"navvi: \"{line[:40]}\" was typed while no trial runs, and nothing is written.", flush=True)
            if left == 0.0 and (not came or most <= 0):  # a terminal gives a line a read; of what does not cease to come no more is read
                return

    def _whole(self):
        """Whether a line is read, or no more will be."""
        return not self.open or b"\n" in self.rest or len(self.rest) >= LONGEST

    def _read(self, seconds):
        """Whether anything came within so many seconds, be it the end."""
        came = bool(select.select([self.file] if self.open else [], [], [], seconds)[0])
        if came:
            read = os.read(self.file, LONGEST)
            self.open = bool(read)
            self.rest += read
        return came


class Desk:
    """The experimenter's lines while a session runs."""

    def __init__(self, process, note, lines=None):
        self.process, self.note, self.lines, self.paused, self.told, self.interrupted = process, note, lines, False, False, False

    def interrupt(self, *_):
        """Ctrl-C; within listen(), as a handler of signals must not write."""
        self.interrupted = True

    def listen(self, seconds):
        if self.interrupted:
            self.interrupted = False
            self.obey("a")
        elif self.note is None:
            self.lines.drop(seconds)
        elif not (self.lines.open or self.lines.rest):
            time.sleep(seconds)
        elif line := self.lines.next(seconds):
            self.obey(line)

    def obey(self, line):
        key, _, words = line.partition(" ")
        kinds = {"m": "mark", "n": "note", "i": "intervention", "p": "pause", "a": "abort"}
        if not line:
            return
        if key not in kinds or (key in "n" and not words):
            print(f"navvi: \"{line[:40]}\" is not understood, and nothing is written." + ("" if self.told else " " + DESK), flush=True)
            self.told = True
            return
        try:
            if self.note:
                self.note({"utc": utc_now(), "mono_ns": time.monotonic_ns(), "type": kinds[key], "text": words})
                print(f"navvi: the {kinds[key]} is written{', and the trial stops' if key == 'a' else ''}.", flush=True)
        except Exception as problem:  # whatever it is, the session keeps its desk
            print(f"navvi: the {kinds[key]} is NOT written: {problem}", flush=True)
        self.paused = self.paused or key == "p"
        if key == "a":
            os.killpg(self.process.pid, signal.SIGINT)


class LoopRunner:
    """Simulated people without ROS, many times faster than real time. It proves the pipeline, nothing about people."""

    asks = "nobody"

    def __init__(self, study, trials_bench, version):
        self.study, self.program, self.version = study, str(trials_bench), version

    def trial(self, participant, step, attempt, folder, lock):
        plan = self.study.plan
        words = plan.condition(step.condition).arguments()
        command = [self.program, f"--world={plan.world_file(attempt) or attempt.world}", f"--seeds={attempt.seed}", f"--limit={step.limit or plan.limit:.0f}",
                   f"--profile={words.pop('profile')}", "--records=all"]
        words.update(person_of(participant, "person/"), **place_of(plan, participant, step, attempt))
        words.update({"trial/participant": participant, "trial/version": self.version})
        command += [f"{name}:={value}" for name, value in words.items() if name.startswith(REHEARSED)]
        legs = plan.legs(attempt)
        for number, leg in enumerate(legs, 1):
            out = folder / f"leg-{number:02d}" if len(legs) > 1 else folder
            result = subprocess.run([*command, *leg, f"--out={out}"], capture_output=True, text=True, errors="replace", check=False, pass_fds=(lock,))
            if result.returncode != 0:
                raise StudyError(f"{participant}, {step}: {(result.stderr or result.stdout).strip()}")
            for trial in out.glob("trial-*") if len(legs) > 1 else ():  # they have one name
                trial.rename(folder / f"{trial.name}-{out.name}")

    def ask(self, participant, step, items, answered, lock):
        step.simulate(participant, items, answered)

    def command(self, words, participant, lock):
        return None

    def close(self, folder):
        pass


def place_of(plan, participant, step, attempt):
    """Where a trial stands in the study, as parameters of trial_node."""
    about = {"name": plan.study, "plan": plan.hash()[:12], "group": plan.group_of(participant).name, "condition": step.condition, "order": step.order,
             "session": step.session, "phase": step.kind, "repeat": step.repeat, "attempt": attempt.number, "replaces": attempt.replaces or "none"}
    return {f"trial/study/{name}": value for name, value in about.items()}


def keep_answers(record, items, answered):
    """What the lesson has written, which goes with that. Returns the items without an answer."""
    answers = {row["item"]: row for row in questionnaire.read_answers(record)}
    for item in items:
        if row := answers.get(item.name):
            answered(item, row["answer"], row.get("seconds", "n/a"))
    record.unlink(missing_ok=True)
    return [item for item in items if item.name not in answers]


def ask_in_terminal(asks, items, answered, read):
    """The experimenter reads aloud and types. An answer counts once the next one is typed, and the last at once; until then b corrects it."""
    print(f"navvi: {asks.title}. {asks.intro}. For each, type the answer, r to read it again, b for the one before, d for rather not say.")
    given, at, kept = {}, 0, 0
    while at < len(items):
        item = items[at]
        print(f"{item.ask}? Allowed: {allowed_words(item)}" + (f"; now {given[item.name]}" if item.name in given else ""))
        word = read()
        if word is None:
            return
        if word == "b":
            at = max(kept, at - 1)
        elif word == "d" or word in item.values():
            given[item.name] = questionnaire.DECLINED if word == "d" else word
            at += 1
            while kept < (at if at == len(items) else at - 1):
                answered(items[kept], given[items[kept].name])
                kept += 1
        elif word != "r":
            print(f"navvi: \"{word[:40]}\" is not allowed here.")


def allowed_words(item):
    if item.point:
        return "whole degrees from straight ahead, 90 on the left, -90 on the right, 180 behind"
    if item.choices:
        return ", ".join(item.choices)
    step = "" if item.step == 1 else f" in steps of {item.step:g}"
    return f"{item.low:g}, {item.least}, to {item.high:g}, {item.most}{step}"


def person_of(participant, part):
    """A simulated person, drawn by the code. \\param part  what its parameters stand below"""
    return {part + "type": "drawn", part + "seed": str(zlib.crc32(participant.encode()) % 1_000_000)}
