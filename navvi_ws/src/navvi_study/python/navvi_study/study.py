"""A study on the disk: its plan, its journal, and the folders of its participants."""
import contextlib
import copy
import dataclasses
import fcntl
import hashlib
import json
import os
import secrets
import shutil
import signal
import string
import time
from pathlib import Path

from . import plan_file
from .errors import StudyError
from .journal import Journal, append_line, lines_of, read_lines, sync_folder, utc_now
from .plan import Group
from .progress import Progress, lettered
from .questionnaire import DECLINED
from .record import summary_of
from .schedule import steps_of

# What each line of a participant's files holds at least.
FIELDS = {
    "notes": {"step": str, "attempt": int, "utc": str, "mono_ns": int, "type": str, "text": str},
    "answers": {"step": str, "condition": str, "order": int, "session": int, "questionnaire": str, "item": str, "answer": str},
}


class Study:
    letters = {}  # in place of the names of conditions, where the study is blinded

    def __init__(self, plan, folder=None):
        self.folder = Path(folder or plan.folder)
        self.seed_file = self.folder / "allocation.seed"
        self.plan = dataclasses.replace(plan, seed=b"".join(lines_of(self.seed_file)).decode(errors="replace").strip())
        self.journal = Journal(self.folder / "journal.jsonl")
        self.finish_erasing()

    @classmethod
    def of(cls, file):
        return cls(plan_file.load(file))

    def progress(self):
        found = self._progress(self.plan)
        if found.freezes and found.freezes[-1].get("allocation", self._allocation()) != self._allocation():
            raise StudyError(f"{self.seed_file} is missing or changed since the plan was frozen, and nobody's order is known without it; restore it from a copy.")
        return found

    def _progress(self, plan):
        return Progress(plan, self.journal.rows() if self.journal.path.exists() else [], self.letters)

    def unrecorded(self):
        """A sentence by name for the last row, where the journal has lost it, and for each record on the disk without its row, unless that was
        accepted."""
        if not self.folder.exists():
            return {}
        frozen = {path: plan["hash"] for path in sorted(self.folder.glob("frozen*.json")) if (plan := _read_frozen(path))}
        attempts = [path for name in self.plan.participants for path in sorted(self.home(name).glob("*-a[0-9]*")) if path.is_dir()]
        progress = self.progress()  # after the files, to each of which there was a row before
        hashes = {row["plan"] for row in progress.freezes}
        begun = {self.attempt_folder(name, attempt.step, attempt.number) for name, person in progress.people.items() for attempt in person.attempts}
        paths = [path for path, plan in frozen.items() if plan not in hashes] + [path for path in attempts if path not in begun]
        accepted = {self.folder / name for row in progress.losses for name in row["lost"]}
        return {**({row: self.journal.lacks(row)} if (row := self.journal.lost()) else {}), **{
            str(path.relative_to(self.folder)): f"{path} has no row in {self.journal.path}, which has lost rows; restore the journal from a copy."
            for path in paths if path not in accepted}}

    def accept_loss(self, reason):
        """The study goes on without the rows that its journal has lost."""
        lost = self.unrecorded()
        if not lost:
            raise StudyError(f"{self.journal.path} has lost no row; there is nothing to accept.")
        self.journal.append("loss", reason=reason, lost=[*lost])

    def _allocation(self):
        """What the journal keeps of the seed, by which it can be verified once it is printed."""
        return hashlib.sha256(self.plan.seed.encode()).hexdigest()

    def home(self, participant):
        """All that is kept of a participant, besides the journal's rows with the code alone."""
        return self.folder / participant

    # What was planned when the study began.

    def frozen(self):
        """The values that were frozen last; None before."""
        freezes = self.progress().freezes
        if not freezes:
            return None
        for path in self.folder.glob("frozen*"):  # also one whose freeze broke off before it had its name
            values = _read_frozen(path)
            if values and values["hash"] == freezes[-1]["plan"]:
                return values["plan"]
        raise StudyError(f"{self.folder} lacks the file of the frozen plan, or it is damaged; restore it from a copy.")

    def freeze(self, version, reason):
        """Returns what has changed since the last time, a sentence each; None where nothing was frozen before."""
        before = self.frozen()
        changes = None if before is None else differences(before, self.plan.values())
        if changes == []:
            raise StudyError("nothing has changed since the plan was frozen.")
        if changes and not reason:
            raise StudyError("the plan was frozen before; a change needs --reason. It is:\n  " + "\n  ".join(changes))
        number = len(self.progress().freezes) + 1
        file = self.folder / ("frozen.json" if number == 1 else f"frozen-{number}.json")
        draw = self.plan.order == "drawn" and not self.plan.seed
        plan = dataclasses.replace(self.plan, seed=secrets.token_hex(16)) if draw else self.plan
        if moved := next(self._progress(plan).moved(), None):
            raise StudyError(f"{moved}; allowed is a plan in which trials that were driven stay where they are. New codes go to the end of a group.")
        if draw:
            self.plan = plan
            write_safely(self.seed_file, self.plan.seed + "\n")
        write_safely(file.with_suffix(".next"), json.dumps({"hash": self.plan.hash(), "plan": self.plan.values()}, indent=1) + "\n")
        self.journal.append("freeze", plan=self.plan.hash(), version=version, reason=reason or "", changes=changes or [],
                            **({"allocation": self._allocation()} if self.plan.order == "drawn" else {}))
        os.replace(file.with_suffix(".next"), file)  # a file of that name has a row
        return changes

    def require_frozen(self):
        before = self.frozen()
        if before is None:
            raise StudyError(f"the plan is not frozen; \"./navvi study freeze {self.plan.file}\" does it, once \"study check\" shows what you want.")
        if changes := differences(before, self.plan.values()):
            raise StudyError("the plan has changed since it was frozen; undo that, or freeze it again with --reason. Changed:\n  " + "\n  ".join(changes))

    def require_analysis(self):
        if self.concealed:
            raise StudyError("the plan says \"blind: true\", and tables name the conditions; \"./navvi study unblind\" freezes the analysis first.")

    @property
    def concealed(self):
        """Whether the plan asks for a blinded analysis, and that is not frozen yet."""
        return self.plan.blind and not self.progress().analyses

    def blinded(self):
        """The same study to an analyst: letters for the conditions, by a key that is drawn once and kept."""
        path, names = self.folder / "blinding.json", {condition.name for condition in self.plan.conditions}
        names.update(attempt.condition for person in self.progress().people.values() for attempt in person.attempts)
        letters = json.loads(path.read_bytes()) if path.exists() else {}
        if new := sorted(names - {"n/a", *letters}):  # all others keep theirs, also those that a plan drops
            free = sorted({*string.ascii_uppercase[:len(letters) + len(new)]} - {*letters.values()})
            letters.update(zip(new, secrets.SystemRandom().sample(free, len(new))))
            write_safely(path, json.dumps(letters) + "\n")

        def renamed(one):
            """What has conditions; of an outcome in the order of the letters, as that of the plan tells them."""
            if isinstance(one, Group):
                return dataclasses.replace(one, conditions=tuple(letters[name] for name in one.conditions))
            first, second = sorted((letters[one.first], letters[one.second]))
            return dataclasses.replace(one, first=first, second=second)
        other = copy.copy(self)
        other.letters = letters
        other.plan = dataclasses.replace(
            self.plan, groups=tuple(map(renamed, self.plan.groups)), primary=renamed(self.plan.primary), secondary=tuple(map(renamed, self.plan.secondary)),
            conditions=tuple(sorted((dataclasses.replace(one, name=letters[one.name]) for one in self.plan.conditions), key=lambda one: one.name)))
        return other

    # One participant's own.

    @contextlib.contextmanager
    def claimed(self, participant):
        """Nobody else goes on with the participant meanwhile. The session inherits the lock: one that outlives this program keeps it."""
        self.home(participant).mkdir(parents=True, exist_ok=True)
        lock = os.open(self._lock(participant), os.O_RDWR | os.O_CREAT, 0o600)
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            os.close(lock)
            running = ", ".join(f"{pid} ({name})" for pid, name in sorted(self.running(participant).items())) or "of another user"
            raise StudyError(f"something of {participant} is running still: process {running}; wait for its end, or end it: "
                             f"./navvi study stop {self.plan.file} {participant}") from None
        try:
            yield lock
        finally:
            os.close(lock)

    def running(self, participant):
        """Names by number of this user's other processes that hold the participant's lock."""
        found = {}
        with contextlib.suppress(OSError):  # no lock yet
            lock = os.stat(self._lock(participant))
            for pid in map(int, filter(str.isdigit, os.listdir("/proc"))):
                if pid != os.getpid() and any(os.path.samestat(lock, file) for file in _files_of(pid)):
                    found[pid] = b"".join(lines_of(f"/proc/{pid}/comm")).decode(errors="replace")
        return found

    def stop(self, participant, seconds=40.0):
        """Ends the session that a killed "study next" has left, or that another one leads, as Ctrl-C does. Returns its processes."""
        found = self.running(participant)
        # A session has a group of its own; the command that began it goes on, or is all there is.
        sessions = {pid: name for pid, name in found.items() if any(b"NAVVI_LOCKS=" in line for line in lines_of(f"/proc/{pid}/environ"))}
        ended = sessions or found
        with contextlib.suppress(ProcessLookupError):
            for group in {os.getpgid(pid) for pid in sessions} - {os.getpgrp()}:
                os.killpg(group, signal.SIGINT)
            for pid in [] if sessions else found:
                os.kill(pid, signal.SIGINT)
        end = time.monotonic() + seconds
        while left := [str(pid) for pid in self.running(participant) if pid in ended]:
            if time.monotonic() > end:
                raise StudyError(f"process {', '.join(left)} of {participant} did not end within {seconds:g} s; \"kill -9 {' '.join(left)}\" ends it.")
            time.sleep(0.1)
        return ended

    def _lock(self, participant):
        return self.folder / f".{participant}.lock"

    def add_answer(self, participant, step, about, item, answer, seconds="n/a"):
        """\\param about  the attempt whose trial the question is about; None where it is about none"""
        append_line(self.home(participant) / "answers.jsonl", {
            "step": step.name, "condition": step.condition, "order": step.order, "session": step.session, "questionnaire": step.asks.name,
            "item": item.name, "answer": answer, "seconds": seconds, "utc": utc_now(), "salt": secrets.token_hex(8),
            **({"attempt": about.number} if about else {})})

    def answers_of(self, participant, step):
        """By item's name."""
        person = self.progress().person(participant)
        return {row["item"]: row["answer"] for row in self.answers(participant) if row["step"] == step.name and step.holds(person, row)}

    def sum_of_answers(self, participant, step):
        """SHA-256 of the answers to a step, by its name. Without their salt, which is erased with them, nobody guesses the answers by it."""
        rows, _ = read_lines(self.home(participant) / "answers.jsonl", FIELDS["answers"])
        return hashlib.sha256(json.dumps([row for row in rows if row["step"] == step], sort_keys=True).encode()).hexdigest()

    def answers(self, participant):
        return [{**{name: cell for name, cell in row.items() if name != "salt"}, "condition": lettered(self.letters, row["condition"])}
                for row in self.lines(participant, "answers")[0]]

    def agreed(self, participant, item):
        """Whether the last answer to the item of the consent is yes."""
        consent = self.plan.steps["consent"]
        given = [row["answer"] for row in self.answers(participant) if consent and (row["questionnaire"], row["item"]) == (consent.name, item)]
        return given[-1:] == ["yes"]

    def note(self, participant, attempt, row):
        append_line(self.home(participant) / "notes.jsonl", {"step": attempt.step, "attempt": attempt.number, **row})

    def notes(self, participant):
        return self.lines(participant, "notes")[0]

    def lines(self, participant, kind):
        """Rows of the participant's notes or answers, and the numbers of the lines of the file that cannot be read, or whose item does not
        allow the answer."""
        asked = {step.asks for step in steps_of(self.plan, participant) if step.asks}
        items = {(one.name, item.name): item for one in asked for item in one.items}

        def allowed(row):
            item = items.get((row["questionnaire"], row["item"])) if kind == "answers" else None
            return not item or row["answer"] in (DECLINED, *item.values())
        return read_lines(self.home(participant) / f"{kind}.jsonl", FIELDS[kind], allowed)

    def unread(self, participant):
        """A sentence for each line of notes or answers that was passed over."""
        return [f"{self.home(participant) / kind}.jsonl:{number}: the line is damaged or unfinished{more}; it is passed over."
                for kind, more in (("notes", ""), ("answers", ", or its item does not allow the answer"))
                for number in self.lines(participant, kind)[1]]

    def attempt_folder(self, participant, step, number):
        return self.home(participant) / f"{step}-a{number}"

    def summary(self, participant, attempt, trial="", strict=True):
        """The summary of an attempt's trial, or of that leg of it. Raises StudyError where it is damaged; not so, and it is empty, where the
        trial is excluded, or without `strict`."""
        trial = trial or attempt.trial
        try:
            return summary_of(self.attempt_folder(participant, attempt.step, attempt.number) / trial) if trial else {}
        except StudyError as problem:
            if not strict or attempt.excluded and not attempt.dropped_out:
                return {}
            raise StudyError(f"{problem} Or go on without the trial: "
                             f"./navvi study exclude {self.plan.file} {participant}/{trial} --reason TEXT") from None

    def finish_erasing(self):
        """What was to be deleted is deleted, also after a crash amid that."""
        for person in self.progress().people.values():
            if person.withdrawn == "delete" and not person.erased:
                for path in (self.home(person.name), self.folder / "bids"):
                    delete(path, "the withdrawal asks for it")
                for name in ("trials.csv", "answers.csv", "events.csv", "report*.html", "*.svg"):
                    for path in (*self.folder.glob(name), *self.folder.glob(name + ".new")):  # of a crash
                        path.unlink(missing_ok=True)
                self.journal.append("erased", participant=person.name)


def _files_of(pid):
    """The open files of a process; none of another user's."""
    with contextlib.suppress(OSError):
        for name in os.listdir(f"/proc/{pid}/fd"):
            with contextlib.suppress(OSError):  # closed meanwhile
                yield os.stat(f"/proc/{pid}/fd/{name}")


def _read_frozen(path):
    """Hash and plan of what was frozen; None where the file is missing or damaged."""
    with contextlib.suppress(OSError, ValueError, LookupError, TypeError):
        values = json.loads(path.read_bytes())
        return {key: values[key] for key in ("hash", "plan")}


def delete(folder, why):
    """Raises StudyError where it is there still: a link, or of another user."""
    shutil.rmtree(folder, ignore_errors=True)
    if os.path.lexists(folder):
        raise StudyError(f"{folder} cannot be deleted, and {why}; delete it, with what it links to.")


def write_safely(path, content):
    """The old file or the new one, as a whole."""
    aside = path.with_name(path.name + ".new")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with open(aside, "w", encoding="utf-8", errors="replace", newline="") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        os.replace(aside, path)
        sync_folder(path.parent)
    except OSError as problem:
        raise StudyError(f"{path} cannot be written: {problem.strerror}; mend that and give the same command again.") from None


def differences(before, now, path=""):
    """A sentence for each value that differs."""
    if isinstance(before, dict) and isinstance(now, dict):
        lists = [differences(before.get(key), now.get(key), f"{path}/{key}" if path else key) for key in sorted({*before, *now})]
        return [sentence for sentences in lists for sentence in sentences]
    if isinstance(before, list) and isinstance(now, list) and len(before) == len(now):
        lists = [differences(one, other, f"{path}[{at}]") for at, (one, other) in enumerate(zip(before, now))]
        return [sentence for sentences in lists for sentence in sentences]
    return [] if before == now else [f"{path}: {json.dumps(before)} is now {json.dumps(now)}"]
