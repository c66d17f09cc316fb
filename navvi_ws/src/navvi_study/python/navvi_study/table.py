"""The study as tables: trials.csv with a row an attempt, answers.csv with a row an answer, and a JSON file that describes each column."""
import csv
import io
import json
import subprocess

from .measures import DROP_OUT
from .record import Record
from .steps import KINDS, kind_of
from .study import write_safely

# Set by the study; the others are those of each trial's summary.csv.
COLUMNS = {
    "participant": "code of the plan", "group": "of the participant", "session": "from 1", "order": "place of the condition, from 1; 0 in practice before all",
    "condition": "see the plan", "phase": "practice, trial or probe", "repeat": "of the trial in its condition, from 1; 0 in practice",
    "attempt": "from 1; more where a trial was replaced", "counts": "yes; drop-out where the person or the experimenter ended it; no where the trial is excluded, or is practice or a probe",
    "excluded": "the reason, or n/a", "excluded_by": "rule, or the user who excluded it", "replaces": "the trial in whose place it stands",
    "leg": "of a job, from 1", "place": "of the job, where the leg leads", "do": "what is done there: drive, pick, drop or scan",
    "marks": "marks and notes of the experimenter", "interventions": "of the experimenter",
}
NOT_OURS = {"participant", "group", "condition", "order", "session", "phase", "repeat", "attempt", "replaces"}
# Of each row of events.csv, before what the trial's own events.csv holds.
WHOSE = ("participant", "group", "session", "order", "condition", "phase", "repeat", "attempt", "counts", "trial")
EVENTS = {
    "onset_s": "since the trial began, simulated time", "duration_s": "simulated time; n/a where it is not known",
    "trial_type": "what happened, as doc/record.md lists it; mark, note, intervention, pause and abort are the experimenter's, by key",
    "wall_clock_utc": "ISO 8601", "obstacle_position": "left, right or center", "elapsed_s": "simulated time, when the goal is reached",
    "robot_x_m": "of the robot in map", "robot_y_m": "of the robot in map", "goal_x_m": "of the goal in map", "goal_y_m": "of the goal in map",
    "thing_class": "of what came near or was hit", "thing": "its name", "spoken": "words of a cue",
    "detail": "kind of a cue, or reason, state, device, result, what assistance does, how late commands come, node of an intruder, name of a "
              "parameter, or the experimenter's words",
}
ANSWERS = {
    "answer": "as given, or declined; pointed directions in whole degrees, counter-clockwise from straight ahead",
    "seconds": "from the question to the answer; of pointing, from the end of the question's words to the push; n/a where the experimenter typed",
    **{name: words for kind in KINDS for name, (words, _) in kind.columns.items()},
}
UNITS = {"onset_s": "s", "duration_s": "s", "elapsed_s": "s", "robot_x_m": "m", "robot_y_m": "m", "goal_x_m": "m", "goal_y_m": "m", "seconds": "s",
         **{name: unit for kind in KINDS for name, (_, unit) in kind.columns.items()}}


def figures(count_trial):
    """name, unit, meaning and source of each column that a trial's summary has."""
    return json.loads(subprocess.run([str(count_trial), "figures"], capture_output=True, text=True, check=True).stdout)


def trials(study, progress, strict=True):
    """Rows by column name; every attempt in which a trial began, of those who have not withdrawn their data.
    \\param strict  as of Study.summary()"""
    rows = []
    for person in progress.people.values():
        notes, described_by = study.notes(person.name), about(study, person)
        for attempt in person.attempts:
            if not attempt.trial or person.withdrawn == "delete":
                continue
            places = progress.plan.places(attempt)
            mine = [note for note in notes if (note["step"], note["attempt"]) == (attempt.step, attempt.number)]
            whole = {"participant": person.name, "group": progress.plan.group_of(person.name).name, "session": attempt.session,
                   "order": attempt.order, "condition": attempt.condition, "phase": attempt.phase, "repeat": attempt.repeat,
                   "attempt": attempt.number, "counts": _counts(person, attempt),
                   **described_by, "excluded": person.excluded or attempt.excluded or "n/a", "excluded_by": attempt.excluded_by or "n/a",
                   "replaces": attempt.replaces or "n/a", "marks": len([note for note in mine if note["type"] in ("mark", "note")]),
                     "interventions": len([note for note in mine if note["type"] == "intervention"])}
            for at, trial in enumerate(attempt.legs):
                row = whole if at == 0 else {**whole, "marks": 0, "interventions": 0}  # of all legs, in the first
                summary = study.summary(person.name, attempt, trial, strict)
                row = {**row, **{name: cell for name, cell in summary.items() if name not in NOT_OURS}, "trial": trial}
                if attempt.job:  # places as its record names them; those of a rehearsal have only the plan's
                    start = Record(study.attempt_folder(person.name, attempt.step, attempt.number) / trial).first("TRIAL_START")
                    place, task = places[at][2:] if len(attempt.legs) <= len(places) else ("n/a", "n/a")  # with more nobody knows which led where
                    told = start.fields if start else {}
                    row.update(leg=at + 1, place=told.get("job_name", place), do=told.get("job_task", task))
                rows.append({name: str(cell) for name, cell in row.items()})
    return rows


def about(study, person):
    """What the person answered at the begin, by column: person_ITEM, "n/a" where it was not asked."""
    given = {(row["questionnaire"], row["item"]): row["answer"] for row in study.answers(person.name)} if study.plan.steps["at_begin"] else {}
    return {f"person_{item.name}": given.get((one.name, item.name), "n/a") for one in study.plan.steps["at_begin"] for item in one.items}


def _counts(person, attempt):
    if person.excluded or not kind_of(attempt).counts:
        return "no"
    return "yes" if attempt.counts else DROP_OUT if attempt.dropped_out else "no"


def events(study, progress):
    """Rows by column name: what happened in each trial of trials(), with what the experimenter marked."""
    rows = []
    for row in trials(study, progress):
        whose = {name: row[name] for name in WHOSE}
        for event in events_of(study, row["participant"], attempt_of(progress, row), row["trial"]):
            rows.append({**whose, **{name: cell for name, cell in event.items() if name not in WHOSE}})
    return rows


def events_of(study, participant, attempt, trial, words=True):
    """Of one trial, in the order of their onsets.
    \\param words  with the experimenter's own"""
    records = {leg: Record(study.attempt_folder(participant, attempt.step, attempt.number) / leg) for leg in attempt.legs}
    begun = {leg: start.mono_ns for leg, one in records.items() if (start := one.first("TRIAL_START"))}
    record = records[trial]
    found = record.events()
    for note in study.notes(participant):
        mine = (note["step"], note["attempt"]) == (attempt.step, attempt.number)
        before = [leg for leg in begun if begun[leg] <= note["mono_ns"]] or [*begun][:1]  # of a job it is of the leg that began last
        if mine and before[-1:] == [trial] and (onset := record.onset_of(note["mono_ns"])) is not None:
            found.append({"onset_s": f"{onset:.3f}", "duration_s": "0", "wall_clock_utc": note["utc"], "trial_type": note["type"],
                          "detail": words and note["text"] or "n/a"})
    return sorted(found, key=lambda event: float(event["onset_s"]))


def attempt_of(progress, row):
    """The attempt that a row of trials() is about."""
    place = [row[name] for name in ("phase", "condition", "repeat", "attempt")]
    return next(one for one in progress.people[row["participant"]].attempts
                if row["trial"] in one.legs and [one.phase, one.condition, str(one.repeat), str(one.number)] == place)


def answers(study, progress):
    """Rows by column name. Answers of a probe are those about its trial that counts, and have what was true besides: truth, and error_deg or
    correct."""
    rows = []
    for person in progress.people.values():
        if person.withdrawn == "delete":
            continue
        for row in study.answers(person.name):
            step = person.step(row["step"])
            if not step or step.holds(person, row):
                rows.append({"participant": person.name, "group": progress.plan.group_of(person.name).name,
                             **{name: str(cell) for name, cell in row.items()}, **(step.truth(study, person, row) if step else {})})
    return rows


def scores(study, progress):
    """Of each questionnaire that was answered: rows with participant, condition, order, questionnaire, score and whether that is prorated."""
    given = {}
    for row in answers(study, progress):
        given.setdefault((row["participant"], row["step"]), []).append(row)
    asked = {one.name: one for one in progress.plan.asked}
    rows = []
    for (participant, _), items in given.items():
        first = items[0]
        if first["questionnaire"] not in asked or progress.people[participant].excluded:
            continue
        one, answered = asked[first["questionnaire"]], {row["item"]: row["answer"] for row in items}
        score = one.scored(answered, {row["item"]: row.get("error_deg", "n/a") for row in items})
        rows.append({"participant": participant, "group": first["group"], "condition": first["condition"], "order": first["order"],
                     "questionnaire": one.measured, "score": score, "prorated": score is not None and one.prorated(answered)})
    return rows


def write(study, progress, known):
    """\\param known  of figures()
    Returns the files that were written."""
    files, known = [], known + [{"name": f"person_{item.name}", "meaning": item.ask} for one in study.plan.steps["at_begin"] for item in one.items]
    for name, rows in (("trials", trials(study, progress)), ("answers", answers(study, progress)), ("events", events(study, progress))):
        columns = list(dict.fromkeys(column for row in rows for column in row)) or list(WHOSE)
        for path, content in ((study.folder / f"{name}.csv", as_csv(columns, rows)), (study.folder / f"{name}.json", described(columns, known))):
            write_safely(path, content)
            files.append(path)
    return files


def as_csv(columns, rows):
    text = io.StringIO()
    writer = csv.DictWriter(text, columns, restval="n/a", lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return text.getvalue()


def described(columns, known):
    """A column's meaning, unit and source, in the form of BIDS."""
    figure = {one["name"]: one for one in known}
    entries = {}
    for column in columns:
        one = figure.get(column, {})
        entry = {"Description": COLUMNS.get(column) or EVENTS.get(column) or ANSWERS.get(column) or one.get("meaning") or column.replace("_", " ")}
        if unit := UNITS.get(column) or one.get("unit"):
            entry["Units"] = unit
        if one.get("source"):
            entry["Source"] = one["source"]
        entries[column] = entry
    return json.dumps(entries, indent=1) + "\n"
