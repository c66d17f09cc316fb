"""Run many simulated trials, each a row of a table.

Each world, seed, person and condition makes a trial. A batch that was killed
goes on when it is called again with the same words. At its end DIR holds
trials.csv, a row a trial, with the same bytes for every --jobs and --shard, and
trials.json, what each column means. doc/batch.md tells more.

A person is able, typical, struggling or drawn: in each world another one, or
those with your seeds, such as drawn:1-20. A condition is default, sounds_off, touch_off, words_off, words_alone, attractive,
brief, sighted (the hand led by eyes), or a name of your own:
slow=feedback/drive/max_forward:=0.5+nav/replan/period:=3

Exit codes
0: done. 1: some failed, are not done, or changed. 2: a wrong argument, or a
full disk.

Examples
./navvi batch --worlds=busy --seeds=1-20 --people=able,typical --out=busy
./navvi batch --people=drawn:1-20 --conditions=default,words_alone --out=drawn
"""
import concurrent.futures
import contextlib
import csv
import fcntl
import io
import json
import os
import re
import subprocess
import sys
import time
from pathlib import Path
from typing import NamedTuple

from navvi_cli.say import aside, fail
from navvi_cli.worlds import check_name

PEOPLE = ("able", "typical", "struggling", "drawn")
CONDITIONS = {
    "default": [],
    "sounds_off": ["feedback/sounds/enabled:=false"],
    "touch_off": ["feedback/haptics/enabled:=false"],
    "words_off": ["speech:=false"],
    "words_alone": ["feedback/sounds/enabled:=false", "feedback/haptics/enabled:=false"],
    "attractive": ["feedback/haptics/steer:=attractive", "person/feeling/touch:=attractive"],
    # What leads by ear would only slow it down.
    "sighted": ["driver:=sighted", "feedback/sounds/enabled:=false", "feedback/haptics/enabled:=false"],
    "brief": ["feedback/cues/wording/verbosity:=brief"],
}
MOST_TRIALS = 1000000
HEAD = ("trial", "world", "seed", "person", "person_seed", "condition", "contacts", "spl", "per_100m")
# What each column means; of a person's and a condition's, the command's help and doc/people.md tell more.
UNITS = {
    "trial": "number of the trial in the batch, from 0", "world": "name or file", "seed": "of the world", "person": "type",
    "person_seed": "of the person", "condition": "name", "contacts": "number of contacts", "spl":
    "shortest over driven way where the goal was reached, else 0", "result": "reached, timeout, gave_up or refused",
    "per_100m": "contacts per 100 m driven", "over_sighted": "time over that of the same hand led by eyes, where both reached the goal",
    "led_turns": "number of turns on the spot", "residual": "deg, what they left, median", "residual_90": "deg, which a tenth of them exceed",
    "cue_to_action": "s, median, from a cue that asks for a turn to the turn", "least_gap": "m, to anything", "motors":
    "share of the time in which a motor turns", "time": "s since the goal was set", "driven": "m", "shortest": "m, of the first path", "reroutes": "number",
    "turns": "1/min, changes of the announced hour", "flips": "number", "reversed": "number", "misled": "number",
    "cues": "1/min, sentences", "words": "1/min", "talk": "share of the time", "repeats": "number", "at_odds": "number", "waits": "number",
    "hasty": "number", "speechless": "number of pushes in vain without a word", "following": "s", "blocked": "s", "make_room": "s",
    "no_route": "s", "off_mesh": "s", "other": "s", "still": "s, the longest stay within 0.3 m", "still_at": "s", "hits":
    "contacts by class", "passed": "number", "missed": "number", "ghosts": "number", "lag": "s", "late": "number", "warned":
    "s felt/told before each contact with a mover", "why": "what was about at the end of the longest stay",
}


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
    found = re.fullmatch(r"(\d+)(?:-(\d+))?", text)
    if not found or int(found[2] or found[1]) < int(found[1]):
        fail(f"{option} has \"{text}\"; allowed are a number, or two such as 1-20.", 2)
    return range(int(found[1]), int(found[2] or found[1]) + 1)


def person_of(text):
    name, _, seeds = text.partition(":")
    if name not in PEOPLE:
        fail(f"--people has \"{text}\"; allowed are: {' '.join(PEOPLE)}, each with seeds if wanted, such as drawn:1-20.", 2)
    return [(name, seed) for seed in (span(seeds, "--people") if seeds else [None])]


def condition_of(text):
    name, equals, words = text.partition("=")
    if equals:
        return name, tuple(words.split("+"))
    if name not in CONDITIONS:
        fail(f"--conditions has \"{text}\"; allowed are: {' '.join(CONDITIONS)}, or NAME=PART/NAME:=VALUE+...", 2)
    return name, tuple(CONDITIONS[name])


def trials_of(args):
    if "\n" in args.worlds + args.people + args.conditions:
        fail("--worlds, --people or --conditions has a line break; allowed are names without one.", 2)
    people = [each for text in args.people.split(",") for each in person_of(text)]
    conditions = [condition_of(text) for text in args.conditions.split(",")]
    cells = [(world, seed, person, seed if person_seed is None else person_seed, *condition) for world in args.worlds.split(",")
             for seed in span(args.seeds, "--seeds") for person, person_seed in people for condition in conditions]
    if len(cells) > MOST_TRIALS:
        fail(f"these make {len(cells)} trials; allowed are {MOST_TRIALS}.", 2)
    return [Trial(number, *cell) for number, cell in enumerate(cells)]


def shard_of(text):
    found = re.fullmatch(r"(\d+)/(\d+)", text)
    if not found or not 1 <= int(found[1]) <= int(found[2]):
        fail(f"--shard has \"{text}\"; allowed is K/N with K from 1 to N, such as 1/4.", 2)
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
                fail(f"{path} is being written by another process; one shard is run once at a time.", 2)
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


def number_of(line):
    return int(line.partition(",")[0])


def done_in(folder):
    """The rows of all shards, by number."""
    rows = {}
    for path in sorted(folder.glob("rows-*.csv")):
        for line in read(path).split("\n")[:-1]:
            rows.setdefault(number_of(line), line + "\n")
    return rows


def replace(path, text):
    """As a whole, and on the disk."""
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
    row = dict(zip(titles, cells))
    contacts = sum(int(word) for word in row["hits"].split() if word.isdigit())
    driven, shortest = float(row["driven"]), float(row["shortest"])
    spl = shortest / max(driven, shortest) if row["result"] == "reached" and shortest > 0.0 else 0.0
    head = (trial.number, trial.world, trial.seed, trial.person, trial.person_seed, trial.condition, contacts, f"{spl:.3f}",
            f"{100.0 * contacts / driven if driven > 0.0 else 0.0:.2f}")
    return head, {name: value for name, value in row.items() if name not in ("world", "seed")}


def simulate(program, trial, args):
    """(trial, titles, line); without a line where it failed, and then the reason in place of the titles."""
    result = subprocess.run([program, *trial.words(args.limit), f"--cache={args.cache}"], capture_output=True, text=True, errors="surrogateescape", check=False)
    table = list(csv.reader(io.StringIO(result.stdout)))
    if result.returncode or len(table) != 2:
        return trial, (result.stderr.strip().splitlines() or [f"exit code {result.returncode}"])[-1], None
    head, row = row_of(trial, *table)
    titles = [*HEAD, *row]
    return trial, titles, line_of([*head, *row.values()])


def same_batch(folder, args, trials):
    """Keeps what the batch is, and refuses another one in its folder."""
    mine = {"worlds": args.worlds, "seeds": args.seeds, "people": args.people, "conditions": args.conditions, "limit": args.limit,
            "trials": len(trials)}
    file = folder / "batch.json"
    if not file.exists():
        replace(file, json.dumps(mine, indent=1) + "\n")
    elif json.loads(read(file)) != mine:
        fail(f"{folder} holds another batch, {file} names it; choose another --out.", 2)


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
    """The lines with one cell more, which compares a trial with that of the same hand led by eyes."""
    rows = [dict(zip(names, cells)) for cells in csv.reader(lines)]

    def key(row):
        return tuple(row[name] for name in ("world", "seed", "person", "person_seed"))
    sighted = {key(row): float(row["time"]) for row in rows if row["condition"] == "sighted" and row["result"] == "reached"}
    for line, row in zip(lines, rows):
        least = sighted.get(key(row), 0.0)
        compared = least > 0.0 and row["result"] == "reached"
        yield line.rstrip("\n") + "," + (f"{float(row['time']) / least:.3f}" if compared else "") + "\n"


def finish(folder, trials):
    """Writes the table once every row is there. \\return how many are missing"""
    rows = done_in(folder)
    missing = sum(1 for trial in trials if trial.number not in rows)
    titles = folder / "titles.csv"
    if not missing:
        names = next(csv.reader([read(titles)]))
        lines = [rows[trial.number] for trial in trials]
        all_names = [*names, "over_sighted"]
        replace(folder / "trials.json", json.dumps({name: UNITS.get(name, "") for name in all_names}, indent=1) + "\n")
        replace(folder / "trials.csv", line_of(all_names) + "".join(beside_sighted(names, lines)))
    return missing


def require_conditions(program, trials):
    """Refuses, once and before any trial, what the program would refuse in each."""
    for trial in {(trial.person, trial.condition): trial for trial in trials}.values():
        checked = subprocess.run([program, "--check", *trial.words(1)], capture_output=True, text=True, check=False)
        if checked.returncode:
            fail(f"condition {trial.condition}, person {trial.person}: {checked.stderr.strip().removeprefix('navvi: ')}", 2)


def run_batch(program, args):
    trials = trials_of(args)
    shard, shards = shard_of(args.shard)
    require_conditions(program, trials)
    folder = Path(args.out)
    folder.mkdir(parents=True, exist_ok=True)
    same_batch(folder, args, trials)
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
    missing = finish(folder, trials)
    if missing:
        aside(f"{missing} trials are missing, of this shard {failed} that failed; the table is written when all are there.")
        return 1
    aside(f"{len(trials)} trials are in {folder / 'trials.csv'}.")
    return 0


def arguments(parser):
    parser.add_argument("--worlds", default="busy", metavar="NAME,...", help="names or files of worlds. Default: busy.")
    parser.add_argument("--seeds", default="1-10", metavar="1-10", help="of the worlds.")
    parser.add_argument("--people", default="typical", metavar="TYPE[:SEEDS],...", help="who drives. Default: typical.")
    parser.add_argument("--conditions", default="default", metavar="NAME,...", help="what is played. Default: default.")
    parser.add_argument("--limit", type=int, default=600, metavar="S", help="s of a trial. Default: 600.")
    parser.add_argument("--jobs", type=int, default=1, metavar="N", help="trials at a time. Default: 1.")
    parser.add_argument("--cache", type=int, default=512, metavar="MB", help="of worlds that are kept for other trials. Default: 512.")
    parser.add_argument("--shard", default="1/1", metavar="K/N", help="the part of the trials to run.")
    parser.add_argument("--tell", type=float, default=10.0, metavar="S", help="s between two lines of progress. Default: 10.")
    parser.add_argument("--out", required=True, metavar="DIR", help="folder of the tables.")


def run(args):
    from navvi_cli.workspace import enter, tool
    for world in args.worlds.split(","):
        check_name(world)
    trials_of(args), shard_of(args.shard)  # before anything is built
    program = tool("navvi_study", "trials_bench")
    enter()
    return run_batch(program, args)
