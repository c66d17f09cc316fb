"""What `study next` does: the next thing of one participant, from whatever state the last one left."""
import time

from .errors import StudyError
from .plan import BROKEN_OFF
from .study import read_summary


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
            return step if getattr(self, "_" + step.kind)(progress, person, step, lock) else None

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
            self._end(name, attempt)

    def _trial(self, progress, person, step, lock):
        world = progress.world_for(person, step)
        before = person.of(step)
        replaces = next((attempt.trial for attempt in reversed(before) if attempt.trial), "")
        number = len(before) + 1
        folder = self.study.attempt_folder(person.name, step.name, number)
        self.study.journal.append("begin", participant=person.name, step=step.name, attempt=number, world=world.world, seed=world.seed, replaces=replaces)
        attempt = self.study.progress().person(person.name).open
        self.runner.trial(person.name, step, attempt, folder, lock)
        return self._end(person.name, attempt)

    def _practice(self, progress, person, step, lock):
        went_on = self._trial(progress, person, step, lock)
        progress = self.study.progress()
        mastered = progress.mastered(progress.person(person.name), step)
        if mastered is not None:
            self._done(person.name, step, mastered=mastered)
            self.say(f"navvi: {person.name}: the practice is over; its criterion was {'met' if mastered else 'not met'}.")
        return went_on

    def _probe(self, progress, person, step, lock):
        """A trial that stops, and what is asked about it at once. One that does not count is driven again, as long as a world is left."""
        if not any(attempt.counts for attempt in person.of(step)):
            if progress.given_up(person, step):
                self._done(person.name, step)
                return True
            if not self._trial(progress, person, step, lock):
                return False
            if not any(attempt.counts for attempt in self.study.progress().person(person.name).of(step)):
                return True
        return self._questionnaire(progress, person, step, lock)

    def _end(self, name, attempt):
        """Writes what came of an attempt. Returns whether a trial began."""
        folder = self.study.attempt_folder(name, attempt.step, attempt.number)
        trials = sorted(path for path in folder.glob("trial-*") if (path / "summary.csv").is_file())
        row = read_summary(trials[-1]) if trials else {}
        began = bool(row) and row.get("started_utc", "n/a") != "n/a"
        collisions = [row.get(f"{what}_collision_count", "n/a") for what in ("shelf", "obstacle")]
        self.study.journal.append(
            "end", participant=name, step=attempt.step, attempt=attempt.number, trial=trials[-1].name if began else "",
            result=row.get("result", "none") if began else "none", collisions=sum(map(float, collisions)) if all(map(_is_number, collisions)) else None)
        if not began:
            self.say("navvi: no trial began; the same comes again with the next \"study next\".")
            return False
        self.say(f"navvi: {name}: {row['result']}, {row['elapsed_s']} s; the record is in {trials[-1]}.")
        self._apply_rules(name, attempt, trials[-1].name, row)
        return True

    def _apply_rules(self, name, attempt, trial, row):
        if who := self._dropped_out(name, attempt, row):
            self.study.journal.append("exclude", participant=name, step=attempt.step, attempt=attempt.number, trial=trial,
                                      reason=f"drop-out: ended by the {who}", rule=True, replace=False, drop_out=True)
            self.say(f"navvi: {name}: a drop-out, ended by the {who}; nothing takes its place. If that had nothing to do with the person or the condition: "
                     f"./navvi study exclude {self.study.plan.file} {name}/{trial} --reason TEXT; then a world of the reserve does.")
            return
        for rule in (*self.study.plan.exclusions, *BROKEN_OFF):
            if rule.meets(row):
                self.study.journal.append("exclude", participant=name, step=attempt.step, attempt=attempt.number, trial=trial,
                                          reason=rule.reason, rule=True, replace=True)
                self.say(f"navvi: {name}: the trial does not count: {rule.reason}.")
                return

    def _dropped_out(self, name, attempt, row):
        """Who ended a trial before goal and limit; empty where nobody did, and in practice, which goes on."""
        if row["result"] != "aborted" or attempt.step.endswith("practice"):
            return ""
        ended = any((note["step"], note["attempt"], note["type"]) == (attempt.step, attempt.number, "abort") for note in self.study.notes(name))
        return "person" if row.get("reason") == "ended_by_person" else "experimenter" if ended else ""

    def _questionnaire(self, progress, person, step, lock):
        if step.asks.scope and not self.study.agreed(person.name, step.asks.scope):
            self.say(f"navvi: {person.name}: {step} is left out; the consent has no yes to \"{step.asks.scope}\".")
            self._done(person.name, step, asked=False)
            return True
        if self._ask(person.name, step, lock) is None:
            return False
        self._done(person.name, step)
        return True

    def _ask(self, name, step, lock):
        """What is left of the step's items. Returns all answers; None where the person broke it off."""
        known = self.study.answers_of(name, step)
        left = [item for item in step.asks.items if item.name not in known]
        if left:
            self.runner.ask(name, step, left, lambda *given: self.study.add_answer(name, step, *given), lock)
            known = self.study.answers_of(name, step)
        if all(item.name in known for item in step.asks.items):
            return known
        self.say(f"navvi: {name}: {step} was broken off; the next \"study next\" goes on with it.")
        return None

    def _consent(self, progress, person, step, lock):
        answers = self._ask(person.name, step, lock)
        if answers is None:
            return False
        given = all(answers[item.name] == item.required for item in step.asks.items if item.required)
        self._done(person.name, step, given=given, asked=self.runner.asks)
        self.say(f"navvi: {person.name}: consent is {'given' if given else 'not given'}" + (", by an answer that was drawn: nobody was asked." if self.runner.asks == "nobody" else "."))
        return given

    def _calibrate(self, progress, person, step, lock):
        self.runner.calibrate(person.name, lock)
        self._done(person.name, step)
        return True

    def _break(self, progress, person, step, lock):
        if self.wait:
            self.say(f"navvi: {person.name}: a break of {step.minutes:g} minutes; Ctrl-C ends it early.")
            try:
                time.sleep(60 * step.minutes)
            except KeyboardInterrupt:
                self.say("navvi: the break was ended early.")
        self._done(person.name, step)
        return True

    def _session_end(self, progress, person, step, lock):
        self._done(person.name, step)
        return True

    def _done(self, name, step, **fields):
        self.study.journal.append("done", participant=name, step=step.name, **fields)


def why_nothing(progress, person):
    if person.withdrawn:
        return "has withdrawn."
    if person.excluded:
        return f"is excluded: {person.excluded}."
    if person.refused:
        return "has not given consent."
    return "has done everything."


def _is_number(cell):
    try:
        float(cell)
        return True
    except ValueError:
        return False
