"""A batch: worlds, seeds, people and conditions, a trial each, a row a trial. No row is lost or doubled, whatever is killed."""
import concurrent.futures
import contextlib
import csv
import fcntl
import hashlib
import io
import json
import os
import re
import subprocess
import sys
import time
from pathlib import Path
from typing import NamedTuple

PEOPLE = ("able", "typical", "struggling", "drawn", "deafblind", "noise")
CONDITIONS = {
    "default": [],
    "sounds_off": ["feedback/sounds/enabled:=false"],
    "touch_off": ["feedback/haptics/enabled:=false"],
    "words_off": ["speech:=false"],
    "words_alone": ["feedback/sounds/enabled:=false", "feedback/haptics/enabled:=false"],
    "flow": ["feedback/lead:=flow"],
    "hand": ["feedback/lead:=hand"],
    # By the hand alone: nothing is said or sounds.
    "hand_alone": ["feedback/lead:=hand", "feedback/sounds/enabled:=false", "speech:=false"],
    # What leads by ear would only slow it down.
    "sighted": ["driver:=sighted", "feedback/sounds/enabled:=false", "feedback/haptics/enabled:=false"],
    "brief": ["feedback/cues/wording/verbosity:=brief"],
}
MOST_TRIALS = 1000000
HEAD = {"trial": "number in the batch, from 0", "world": "name or file", "seed": "of the world", "person": "type", "person_seed": "of the person",
        "condition": "name"}
COMPARED = ("over_sighted", "time over the sighted reference, where both reached the goal")


class BatchError(Exception):
    """A sentence for the user. \\param code  exit code"""

    def __init__(self, sentence, code=2):
        super().__init__(sentence)
        self.code = code


def aside(sentence):
    print(f"navvi: {sentence}", file=sys.stderr, flush=True)


class Trial(NamedTuple):
    number: int
    world: str
    seed: int
    person: str
    person_seed: int
    condition: str
    parameters: tuple

    def words(self, limit):
        return [f"--world={self.world}", f"--seeds={self.seed}", f"--limit={limit}", "--csv", f"person/type:={self.person}",
                f"person/seed:={self.person_seed}", *self.parameters]


def span(text, option):
    found = re.fullmatch(r"(\d{1,9})(?:-(\d{1,9}))?", text)
    if not found or not 0 <= int(found[2] or found[1]) - int(found[1]) < MOST_TRIALS:
        raise BatchError(f"{option} has \"{text}\"; allowed are a number of at most nine digits, or two such as 1-20, and {MOST_TRIALS} seeds at most.")
    return range(int(found[1]), int(found[2] or found[1]) + 1)


def person_of(text):
    name, _, seeds = text.partition(":")
    if name not in PEOPLE:
        raise BatchError(f"--people has \"{text}\"; allowed are: {' '.join(PEOPLE)}, each with seeds if wanted, such as drawn:1-20.")
    return [(name, seed) for seed in (span(seeds, "--people") if seeds else [None])]


def condition_of(text):
    name, equals, words = text.partition("=")
    if equals:
        for word in words.split("+"):
            if not re.fullmatch(r"(sim|nav|feedback|person|perception)/[a-z0-9_/]+:=.*|(speech|driver):=[a-z]+", word):
                raise BatchError(f"--conditions has \"{word}\" in {name}; allowed is PART/NAME:=VALUE, PART one of sim, nav, feedback, person and "
                                 "perception, or speech:=false.")
        return name, tuple(words.split("+"))
    if name not in CONDITIONS:
        raise BatchError(f"--conditions has \"{text}\"; allowed are: {' '.join(CONDITIONS)}, or NAME=PART/NAME:=VALUE+...")
    return name, tuple(CONDITIONS[name])


def trials_of(args):
    if "\n" in args.worlds + args.people + args.conditions:
        raise BatchError("--worlds, --people or --conditions has a line break; allowed are names without one.")
    people = [each for text in args.people.split(",") for each in person_of(text)]
    conditions = [condition_of(text) for text in args.conditions.split(",")]
    worlds, seeds = args.worlds.split(","), span(args.seeds, "--seeds")
    count = len(worlds) * len(seeds) * len(people) * len(conditions)
    if count > MOST_TRIALS:
        raise BatchError(f"these make {count} trials; allowed are {MOST_TRIALS}.")
    cells = [(world, seed, person, seed if person_seed is None else person_seed, *condition) for world in worlds
             for seed in seeds for person, person_seed in people for condition in conditions]
    return [Trial(number, *cell) for number, cell in enumerate(cells)]


def shard_of(text):
    found = re.fullmatch(r"(\d+)/(\d+)", text)
    if not found or not 1 <= int(found[1]) <= int(found[2]):
        raise BatchError(f"--shard has \"{text}\"; allowed is K/N with K from 1 to N, such as 1/4.")
    return int(found[1]), int(found[2])


def locked(file):
    """Whether this process has the file for itself."""
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    return True


class Rows:
    """The rows of a shard: whole lines, each on the disk before the next begins. What a kill has torn is cut off."""

    def __init__(self, path):
        self.path = path
        self.file = os.open(path, os.O_RDWR | os.O_CREAT, 0o644)
        # A batch that was killed while it began a trial leaves the lock to that trial's process until its program runs.
        end = time.monotonic() + 2.0
        while not locked(self.file):
            if time.monotonic() > end:
                raise BatchError(f"{path} is being written by another process; one shard is run once at a time.")
            time.sleep(0.05)
        whole = read(path).rpartition("\n")[0]
        os.ftruncate(self.file, len(bytes_of(whole)) + 1 if whole else 0)
        os.lseek(self.file, 0, os.SEEK_END)

    def append(self, line):
        data = bytes_of(line)
        with naming(self.path):
            while data:
                data = data[os.write(self.file, data):]
            os.fsync(self.file)

    def close(self):
        os.close(self.file)


@contextlib.contextmanager
def naming(path):
    """A full disk names the file."""
    try:
        yield
    except OSError as problem:
        problem.filename = problem.filename or str(path)
        raise


def read(path):
    """Bytes that are not UTF-8, as in the name of a world's file, stay what they are."""
    return Path(path).read_bytes().decode(errors="surrogateescape")


def bytes_of(text):
    return text.encode(errors="surrogateescape")


def number_of(line, path):
    try:
        return int(line.partition(",")[0])
    except ValueError:
        raise BatchError(f"{path} has a line that begins with {line[:20]!r}; allowed is the number of a trial. Take the line out: its trial is "
                         "run again.") from None


def done_in(folder):
    """The rows of all shards, by number."""
    rows = {}
    for path in sorted(folder.glob("rows-*.csv")):
        for line in read(path).split("\n")[:-1]:
            rows.setdefault(number_of(line, path), line + "\n")
    return rows


def replace(path, text):
    """As a whole: a loss of power leaves the old bytes or the new ones."""
    part = path.with_name(f".{path.name}.{os.getpid()}")
    with naming(path), open(part, "wb") as file:
        file.write(bytes_of(text))
        file.flush()
        os.fsync(file.fileno())
    os.replace(part, path)


def line_of(values):
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerow(values)
    return text.getvalue()


def row_of(trial, titles, cells):
    """Titles and cells of the trial's row."""
    row = {name: cell for name, cell in zip(titles, cells) if name not in HEAD}
    return [*HEAD, *row], [*trial[:len(HEAD)], *row.values()]


def simulate(program, trial, args):
    """(trial, titles, line); without a line where it failed, and then the reason in place of the titles."""
    words = [*trial.words(args.limit), f"--cache={args.cache}", f"--records={args.records}", f"--out={Path(args.out) / 'records' / str(trial.number)}"]
    result = subprocess.run([program, *words], capture_output=True, text=True, errors="surrogateescape", check=False)
    table = list(csv.reader(io.StringIO(result.stdout)))
    if result.returncode or len(table) != 2:
        return trial, (result.stderr.strip().splitlines() or [f"exit code {result.returncode}"])[-1], None
    titles, cells = row_of(trial, *table)
    return trial, titles, line_of(cells)


def sums_of(trials):
    """SHA-256 of each file that is a world, or that a parameter names, such as zones."""
    names = {name for trial in trials for name in (trial.world, *(word.partition(":=")[2] for word in trial.parameters))}
    return {name: hashlib.sha256(Path(name).read_bytes()).hexdigest() for name in sorted(filter(os.path.isfile, names))}


def same_batch(folder, args, trials, version):
    """Keeps what the batch is, and refuses another one in its folder: rows of before would stand for what is no more."""
    mine = {"worlds": args.worlds, "seeds": args.seeds, "people": args.people, "conditions": args.conditions, "limit": args.limit,
            "trials": len(trials), "version": version, "files": sums_of(trials)}
    file = folder / "batch.json"
    if not file.exists():
        return replace(file, json.dumps(mine, indent=1) + "\n")
    kept = json.loads(read(file))
    changed = [key for key in mine if kept.get(key, mine[key]) != mine[key]]  # those of before have neither version nor files
    if changed == ["files"]:
        changed = sorted(name for name in {**mine["files"], **kept["files"]} if mine["files"].get(name) != kept["files"].get(name))
    if changed:
        raise BatchError(f"{folder} holds another batch, as {file} tells: changed since it began: {', '.join(changed)}; choose another --out.")


def time_left(seconds):
    return f"{seconds:.0f} s" if seconds < 120 else f"{seconds / 60:.0f} min"


def run_all(program, trials, args, rows):
    """Appends a row a trial. \\return the titles, and how many trials failed"""
    titles, failed, finished, since, told = None, 0, 0, time.monotonic(), 0.0
    pool = concurrent.futures.ThreadPoolExecutor(args.jobs)
    try:
        for answer in concurrent.futures.as_completed([pool.submit(simulate, program, trial, args) for trial in trials]):
            trial, said, line = answer.result()
            finished += 1
            if line is None:
                failed += 1
                aside(f"trial {trial.number} failed ({trial.world}, seed {trial.seed}, {trial.person}, {trial.condition}): {said}")
            else:
                titles = said
                rows.append(line)
            now = time.monotonic()
            if now - told > args.tell or finished == len(trials):
                told = now
                left = (now - since) / finished * (len(trials) - finished)
                print(f"{finished} of {len(trials)} trials, {time_left(left)} left", file=sys.stderr, flush=True)
    finally:
        # After Ctrl-C or a full disk no trial is begun whose row nobody would write.
        pool.shutdown(cancel_futures=True)
    return titles, failed


def beside_sighted(names, lines):
    """The lines with one cell more, which compares a trial with that of the sighted reference."""
    rows = [dict(zip(names, cells)) for cells in csv.reader(lines)]

    def key(row):
        return tuple(row[name] for name in ("world", "seed", "person", "person_seed"))
    sighted = {key(row): float(row["elapsed_s"]) for row in rows if row["condition"] == "sighted" and row["result"] == "reached"}
    for line, row in zip(lines, rows):
        least = sighted.get(key(row), 0.0)
        compared = least > 0.0 and row["result"] == "reached"
        yield line.rstrip("\n") + "," + (f"{float(row['elapsed_s']) / least:.3f}" if compared else "") + "\n"


def described(names, figures):
    """Meaning, unit and source of each column. \\param figures  as count_trial prints them"""
    known = {one["name"]: {"Description": one["meaning"], "Units": one["unit"], "Source": one["source"]} for one in figures}
    entries = {**{name: known.get(name, {}) for name in names}, **{name: {"Description": words} for name, words in (*HEAD.items(), COMPARED)}}
    return {name: {key: words for key, words in entries[name].items() if words} for name in [*names, COMPARED[0]]}


def finish(folder, trials, figures):
    """Writes the table once every row is there. \\return how many are missing"""
    rows = done_in(folder)
    missing = sum(1 for trial in trials if trial.number not in rows)
    titles = folder / "titles.csv"
    if not missing:
        names = next(csv.reader([read(titles)]))
        lines = [rows[trial.number] for trial in trials]
        replace(folder / "trials.json", json.dumps(described(names, figures), indent=1) + "\n")
        replace(folder / "trials.csv", line_of([*names, COMPARED[0]]) + "".join(beside_sighted(names, lines)))
    return missing


def require_conditions(program, trials):
    """Refuses, once and before any trial, what the program would refuse in each."""
    for trial in {(trial.person, trial.condition): trial for trial in trials}.values():
        checked = subprocess.run([program, "--check", *trial.words(1)], capture_output=True, text=True, check=False)
        if checked.returncode:
            raise BatchError(f"condition {trial.condition}, person {trial.person}: {checked.stderr.strip().removeprefix('navvi: ')}")


def run_batch(program, figures, args, version):
    """\\param program  plays a trial \\param figures  what the columns of its row mean \\param version  of the product
    Returns the exit code."""
    trials = trials_of(args)
    shard, shards = shard_of(args.shard)
    require_conditions(program, trials)
    folder = Path(args.out)
    folder.mkdir(parents=True, exist_ok=True)
    same_batch(folder, args, trials, version)
    rows = Rows(folder / f"rows-{shard}-of-{shards}.csv")
    try:
        done = done_in(folder)
        todo = [trial for trial in trials if trial.number % shards == shard - 1 and trial.number not in done]
        # Of a batch that is done for this shard, one trial tells the titles, should they be lost.
        titles, failed = run_all(program, todo, args, rows)
        if titles:
            replace(folder / "titles.csv", line_of(titles))
        elif not (folder / "titles.csv").exists() and done:
            replace(folder / "titles.csv", line_of(simulate(program, trials[0], args)[1]))
    finally:
        rows.close()
    missing = finish(folder, trials, figures)
    if missing:
        aside(f"trials that are missing: {missing}, of this shard {failed} that failed; the table is written when all are there.")
        return 1
    aside(f"{folder / 'trials.csv'} holds {len(trials)} trial{'s' * (len(trials) != 1)}.")
    return 0
