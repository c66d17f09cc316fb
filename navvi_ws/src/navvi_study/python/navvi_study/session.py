"""What `study next` does: the next thing of one participant, from whatever state the last one left."""
from .errors import StudyError
from .journal import sum_of
from .measures import number
from .record import summary_of
from .steps import kind_of

WHOLE = ("reached", "timeout")  # results of a leg after which a job goes on
DAMAGED = {"result": "invalid", "reason": "summary_damaged", "elapsed_s": "n/a"}  # in place of a summary


class Session:
    """\\param say  takes a line for the experimenter
    \\param wait  whether a break lasts as long as planned"""

    def __init__(self, study, runner, say=print, wait=True):
        self.study, self.runner, self.say, self.wait = study, runner, say, wait

    def next(self, name):
        """Does one step. Returns it, or None where nothing is left to do."""
        progress = self.study.progress()
        person = progress.person(name)
        with self.study.claimed(name) as lock:
            self.recover(name)
            progress = self.study.progress()
            person = progress.person(name)
            self.may_go_on(progress, person)
            step = progress.next(person)
            if step is None:
                self.say(f"navvi: {name}: {why_nothing(progress, person)}")
                return None
            self.say(f"navvi: {name}: {step}.")
            return step if step.run(self, progress, person, lock) else None

    def may_go_on(self, progress, person):
        plan = self.study.plan
        self.study.require_frozen()
        completed = sum(progress.complete(other) for other in progress.people.values())
        if plan.stop_after and completed >= plan.stop_after and not person.begun:
            raise StudyError(f"the study stops after {plan.stop_after} participants, and {completed} have completed it; {person.name} does not begin.")

    def recover(self, name):
        """An attempt that a crash left open is ended by what its folder holds."""
        attempt = self.study.progress().person(name).open
        if attempt:
            self.runner.close(self.study.attempt_folder(name, attempt.step, attempt.number))
            self.end(name, attempt)

    def end(self, name, attempt):
        """Writes what came of an attempt. Returns whether a trial began."""
        folder = self.study.attempt_folder(name, attempt.step, attempt.number)
        trials, places = sorted(path for path in folder.glob("trial-*") if (path / "summary.csv").is_file()), self.study.plan.places(attempt)
        legs = {path: row for path in (trials if places else trials[-1:]) if (row := _summary_of(path)).get("started_utc") != "n/a"}
        rows = [*legs.values()]
        if 0 < len(rows) < len(places) and rows[-1]["result"] in WHOLE:  # broken off between two places
            rows.append({**rows[-1], "result": "aborted", "reason": "n/a"})
        collisions = [number(row.get(f"{what}_collision_count")) for row in rows for what in ("shelf", "obstacle")]
        sums = {path.name: {file.name: sum_of(file) for file in sorted(path.iterdir()) if file.is_file()} for path in legs}
        trial = [*sums][-1] if sums else ""
        verdict = self._verdict(name, attempt, rows) if rows else {}
        self.study.journal.append(
            "end", participant=name, step=attempt.step, attempt=attempt.number, trial=trial, result=result_of(rows),
            collisions=None if None in collisions or not rows else sum(collisions), **verdict,
            **({"legs": sums} if places else {"sums": sums.get(trial, {})}))
        if not rows:
            self.say("navvi: no trial began; the same comes again with the next \"study next\".")
            return False
        for path, row in legs.items():
            self.say(f"navvi: {name}: {row['result']}, {row['elapsed_s']} s; the record is in {path}.")
        if verdict.get("drop_out"):
            self.say(f"navvi: {name}: a {verdict['excluded'].replace(':', ',')}; nothing takes its place. If that had nothing to do with the person "
                     f"or the condition: ./navvi study exclude {self.study.plan.file} {name}/{trial} --reason TEXT; then a world of the reserve does, if one is left.")
        elif verdict:
            self.say(f"navvi: {name}: the trial does not count: {verdict['excluded']}.")
        return True

    def _verdict(self, name, attempt, rows):
        """Why a trial does not count, as fields of its end: after a crash between two rows it would count."""
        if who := self._dropped_out(name, attempt, rows[-1]):
            return {"excluded": f"drop-out: ended by the {who}", "drop_out": True}
        reason = self.study.plan.reason_against(rows)
        return {"excluded": reason, "drop_out": False} if reason else {}

    def _dropped_out(self, name, attempt, row):
        """Who ended a trial before goal and limit; empty where nobody did, and in practice, which goes on."""
        if row["result"] != "aborted" or not kind_of(attempt).drop_out:
            return ""
        ended = any((note["step"], note["attempt"], note["type"]) == (attempt.step, attempt.number, "abort") for note in self.study.notes(name))
        # Any other reason is a fault of the machine; between two places of a job nobody knows one.
        return "person" if row["reason"] == "ended_by_person" else "experimenter" if ended and row["reason"] in ("stopped_by_signal", "n/a") else ""

    def done(self, name, step, **fields):
        """The step is over. Returns True."""
        sums = {"answers": self.study.sum_of_answers(name, step.name)} if step.asks else {}
        self.study.journal.append("done", participant=name, step=step.name, **fields, **sums)
        return True


def _summary_of(folder):
    """A trial whose summary is damaged, and could not be made again from its journal, was driven all the same."""
    try:
        return summary_of(folder)
    except StudyError:
        return DAMAGED


def result_of(rows):
    """Of a trial, by the summaries of its legs: what broke it off, else what was not reached."""
    results = [row["result"] for row in rows]
    return next((one for one in results if one not in WHOLE), next((one for one in results if one != "reached"), "reached")) if results else "none"


def why_nothing(progress, person):
    if person.withdrawn:
        return "has withdrawn."
    if person.excluded:
        return f"is excluded: {person.excluded}."
    if person.refused:
        return "has not given consent."
    return "has done everything."
