"""Whether bag, journal and table tell the same of each trial."""
import subprocess

from . import table

EQUAL = "equal"


def verify(study, progress, from_journal, from_bag):
    """\\param from_journal, from_bag  the programs that count a trial's summary again
    Returns a sentence a trial, and how many trials do not agree."""
    sentences, bad = [], 0
    for row in table.trials(study, progress):
        attempt = table.attempt_of(progress, row)
        folder = study.attempt_folder(row["participant"], attempt.step, attempt.number) / attempt.trial
        found = {"journal": _journal(from_journal, folder), "bag": _bag(from_bag, folder, row), "table": _table(study, row, attempt)}
        wrong = {name: words for name, words in found.items() if words != EQUAL and not words.startswith("no ")}
        bad += bool(wrong)
        sentences.append(f"{row['participant']}/{row['trial']}: " + ", ".join(f"{name} {words}" for name, words in found.items()) + ".")
    return sentences, bad


def _journal(program, folder):
    if not (folder / "journal.csv").is_file():
        return "no journal, as in a rehearsal"
    result = subprocess.run([str(program), str(folder)], capture_output=True, text=True, check=False)
    return EQUAL if result.returncode == 0 else "differs: " + "; ".join((result.stderr or result.stdout).strip().splitlines()[-3:])


def _bag(program, folder, row):
    if not (folder / "trial.bag").is_file():
        recorded = row.get("bag", "n/a")
        return "is missing" if recorded == "ok" else "no bag" if recorded in ("n/a", "none") else f"no whole bag, recorded as {recorded}"
    result = subprocess.run([str(program), str(folder)], capture_output=True, text=True, check=False)
    return EQUAL if result.returncode == 0 else "differs: " + "; ".join((result.stderr or result.stdout).strip().splitlines()[:3])


def _table(study, row, attempt):
    """What stands in trials.csv now is what the summary holds."""
    summary = study.summary(row["participant"], attempt)
    wrong = [name for name, cell in summary.items() if name in row and name not in table.NOT_OURS and row[name] != cell]
    wrong += [name for name in ("condition", "group", "phase") if summary.get(name, "n/a") not in ("n/a", row[name])]
    return EQUAL if not wrong else "differs in " + ", ".join(wrong)
