"""Whether the files of each trial are as they were, bag, journal and table tell the same of it, and hold each note and answer."""
import subprocess

from . import table
from .journal import sum_of
from .record import Record
from .study import FIELDS

EQUAL = "equal"
OPEN = "trial.bag.active"  # what a power cut leaves of a bag
RECOVERED = ("ended_without_a_word", "journal_damaged")  # reasons of a TRIAL_END that close_trials wrote


def verify(study, progress, count_trial):
    """\\param count_trial  the program that counts a trial's summary again
    Returns a sentence a trial, and how many trials do not agree."""
    sentences, bad = [], 0
    for row in table.trials(study, progress, strict=False):
        attempt = table.attempt_of(progress, row)
        folder = study.attempt_folder(row["participant"], attempt.step, attempt.number) / row["trial"]
        found = {"files": _files(folder, attempt.legs[row["trial"]]), "journal": _journal(count_trial, folder), "bag": _bag(count_trial, folder, row), "table": _table(study, row, attempt)}
        wrong = {name: words for name, words in found.items() if words != EQUAL and not words.startswith("no ")}
        bad += bool(wrong)
        sentences.append(f"{row['participant']}/{row['trial']}: " + ", ".join(f"{name} {words}" for name, words in found.items()) + ".")
    return sentences, bad


def changed(study, progress):
    """How many trials have a table, such as summary.csv, that is not as it was when they ended. Bags, which take long, are left to verify()."""
    found = 0
    for row in table.trials(study, progress, strict=False):
        attempt = table.attempt_of(progress, row)
        folder = study.attempt_folder(row["participant"], attempt.step, attempt.number) / row["trial"]
        found += _files(folder, {name: known for name, known in attempt.legs[row["trial"]].items() if name.endswith(".csv")}).startswith("differ")
    return found


def notes_and_answers(study, progress):
    """A sentence a participant, and one for each line that cannot be read and each step whose answers are not those that were given; then
    how many lines there are of each kind, and how many lines and steps these sentences name."""
    sentences, counts, lost = [], dict.fromkeys(FIELDS, 0), 0
    for name, person in progress.people.items():
        if not person.begun or person.withdrawn == "delete":
            continue
        found = {kind: study.lines(name, kind) for kind in FIELDS}
        for kind, (rows, skipped) in found.items():
            counts[kind] += len(rows) + len(skipped)
            lost += len(skipped)
        sentences.append(f"{name}: " + ", ".join(f"{kind} {len(rows)} of {len(rows) + len(skipped)}" for kind, (rows, skipped) in found.items()) + ".")
        changed = [step for step, row in person.done.items() if "answers" in row and row["answers"] != study.sum_of_answers(name, step)]
        lost += len(changed)
        sentences += study.unread(name)
        sentences += [f"{name} {step}: the answers are not those that were given, by their sum in the journal." for step in changed]
    return sentences, counts, lost


def _files(folder, sums):
    """They are as they were when the trial ended."""
    repaired = [OPEN] if (folder / "trial.bag").is_file() else []
    wrong = [name for name, known in sums.items() if name not in repaired and sum_of(folder / name) != known]
    return "differ: " + ", ".join(wrong) if wrong else EQUAL if sums else "no sums"


def _journal(program, folder):
    if not (folder / "journal.csv").is_file():
        return "no journal"
    result = subprocess.run([str(program), "journal", str(folder)], capture_output=True, errors="replace", check=False)
    return EQUAL if result.returncode == 0 else "differs: " + _clauses((result.stderr or result.stdout).splitlines()[-3:])


def _bag(program, folder, row):
    if (folder / OPEN).is_file():
        return f"was not closed: \"rosbag reindex {folder / OPEN}\" repairs it; then rename it trial.bag"
    if not (folder / "trial.bag").is_file():
        recorded = row.get("bag", "n/a")
        return "is missing" if recorded == "ok" else "no bag" if recorded in ("n/a", "none") else f"no whole bag, recorded as {recorded}"
    result = subprocess.run([str(program), "bag", str(folder)], capture_output=True, errors="replace", check=False)
    said, end = (result.stderr or result.stdout).strip(), Record(folder).first("TRIAL_END")
    if "the bag does not hold the trial's end" in said and end and end.fields.get("reason") in RECOVERED:
        return "no end, as the trial's record broke off"
    return EQUAL if result.returncode == 0 else "differs: " + _clauses(said.splitlines()[:3])


def _clauses(lines):
    """Of a sentence: without the ends of their own."""
    return "; ".join(line.strip().rstrip(".") for line in lines)


def _table(study, row, attempt):
    """What stands in trials.csv now is what the summary holds."""
    summary = study.summary(row["participant"], attempt, row["trial"], strict=False)
    if not summary:
        return "differs: summary.csv is missing or damaged"
    wrong = [name for name, cell in summary.items() if name in row and name not in table.NOT_OURS and row[name] != cell]
    wrong += [name for name in ("condition", "group", "phase") if summary.get(name, "n/a") not in ("n/a", row[name])]
    return EQUAL if not wrong else "differs in " + ", ".join(wrong)
