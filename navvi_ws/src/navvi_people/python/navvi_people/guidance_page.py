"""doc/guidance.md: runs its batches, or what is missing of them, and writes the page with its plots."""
import datetime
import json
import re
import subprocess
import sys
from pathlib import Path

from . import guidance_plots as plots, guidance_tables as tables

NAVVI = Path(__file__).resolve().parents[5] / "navvi"
THREE = "--people=" + ",".join(tables.TYPES)
CLOSING = "--conditions=sighted,default,flow,hand_alone"
NOISE = "person/hearing/noise:=0.5"
WORSE = "person/worse:=1.5"
ALONE = "feedback/lead:=hand+feedback/sounds/enabled:=false+speech:=false"
# No seed of these was used for tuning.
BATCHES = {
    "closing": ["--seeds=92001-92200", THREE, "--conditions=sighted,words=feedback/lead:=words,default,flow,hand_alone"],
    "worlds": ["--worlds=narrow,warehouse", "--seeds=92001-92030", THREE, CLOSING],
    "noise": ["--seeds=104001-104600", THREE, f"--conditions=noise_numb={NOISE}+feedback/haptics/enabled:=false,noise_hand={NOISE}+feedback/lead:=hand"],
    "worse": ["--seeds=92401-92600", THREE, f"--conditions=sighted,flow_worse=feedback/lead:=flow+{WORSE},hand_worse={ALONE}+{WORSE}"],
    "drawn": ["--seeds=92001-92005", "--people=drawn:1-20", CLOSING],
    "choices": ["--seeds=92401-92440", THREE,
                "--conditions=default,sounds_off,touch_off,no_stop=feedback/cues/near/stop_moving:=0+feedback/cues/near/stop_standing:=0,"
                "beacon=feedback/sounds/beacon/on:=true,brief,flow,hand,early_words=feedback/cues/route/turn_ahead:=10"],
}
CHOICES = """`sounds_off`: no short sounds; `touch_off`: no motors; `no_stop`: no "stop" before obstacles; `beacon`: a beacon at the next way-point
besides, which no simulated person steers by; `brief`: brief words; `flow`, `hand`: those ways of leading; `early_words`:
turns are announced from 10 m on instead of 6 m."""


def run(folder, name, jobs):
    """\\return the exit code; 0: DIR/NAME holds the whole batch"""
    words = [NAVVI, "batch", "--limit=600", f"--jobs={jobs}", "--tell=60", *BATCHES[name], f"--out={folder / name}"]
    return subprocess.run(words, check=False).returncode


def effects(folder, measures):
    """Published effects, a column a type. \\param measures  those that the folder does not hold are measured"""
    rows = {}
    for person in tables.TYPES:
        file = folder / f"people-{person}.md"
        if measures and not file.exists():
            result = subprocess.run([NAVVI, "bench", "people", person], stdout=subprocess.PIPE, text=True, check=True)
            file.write_text(result.stdout, encoding="utf-8")
        text = file.read_text(encoding="utf-8") if file.exists() else ""
        for effect, source, published, here, agrees in re.findall(r"^\| (.+) \| (.+) \| (.+) \| (-?[\d.]+ \[.+\]) \| (.+) \|$", text, re.M):
            rows.setdefault((effect, source, published), []).append(f"{here} {agrees}")
    return [*tables.head("effect", "source", "published", *tables.TYPES), *(tables.line(*effect, *cells) for effect, cells in rows.items())]


def command(folder):
    """That has made the batch."""
    known = json.loads((folder / "batch.json").read_text(encoding="utf-8"))
    words = [f"--{name}={known[name]}" for name in ("worlds", "seeds", "people", "conditions", "limit")]
    return "    ./navvi batch " + " ".join(words) + f" --out={folder.name}"


def section(title, *parts):
    return [f"## {title}", *(line for part in parts for line in ([part, ""] if isinstance(part, str) else [*part, ""]))]


def parts(folder, found):
    closing = found["closing"]
    out = [*section("Goals", tables.goals(closing)),
           *section("Closing table", command(folder / "closing"), tables.guidance(closing),
                    "![Contacts, time and SPL with intervals, by condition; a mark a person](guidance.svg)")]
    if "drawn" in found:
        out += section("Drawn persons", "Persons whose traits are drawn.", command(folder / "drawn"), tables.guidance(found["drawn"]))
    if "worlds" in found:
        out += section("Other worlds", "Likewise in `narrow` and `warehouse`.", command(folder / "worlds"),
                       [row for row in tables.guidance(found["worlds"]) if " | sighted | " not in row])
    if "noise" in found:
        out += section("Touch in noise", "People who hear one sentence or sound in two.", command(folder / "noise"), tables.noise(found["noise"]))
    if "worse" in found:
        out += section("Slower people", "People whose delays, errors and misses are 1.5 times those of their type.", command(folder / "worse"),
                       tables.worse(found["worse"]))
    if "choices" in found:
        out += section("Design choices", CHOICES, command(folder / "choices"), tables.flips(found["choices"]),
                       "![Changes beside the default with intervals, by design choice; a mark a person](guidance_choices.svg)")
    return out + section("Failures", "In `default` of the closing table. `./navvi batch WORDS --limit=600 --records=all --out=again` records the first of a class.", tables.failures(closing))


def page(folder, found, known, notes, day):
    return "\n".join([
        "# Guidance, person by person",
        "No person has driven yet: these are [simulated people](people.md). `./navvi bench guidance TRIALS -o doc/guidance.md` makes this page but for the",
        "notes, and runs what its batches in the folder TRIALS lack; `--as-is` runs nothing.",
        f"Measured on {day} in world `busy`, on seeds that no tuning saw but for five traces (Notes), limit 600 s. Intervals hold 95 % (bootstrap); changes are beside",
        "`default` (ticks) over the same worlds. In each world another person of the type drives, the same in all conditions. `sighted` is the",
        "reference: the same hand, led by eyes; `flow` is a steady sound, `hand_alone` the motors without any sound.", "",
        *parts(folder, found), *section("Published effects", "`./navvi bench people TYPE`; 200 persons turn, 40 drive; intervals hold 95 % (jackknife over persons).", known), notes])


def make(folder, file, jobs, as_is):
    """\\param as_is  nothing is run"""
    if not as_is and any([run(folder, name, jobs) for name in BATCHES]):
        print("navvi: a batch of the page is not finished; the same command goes on.", file=sys.stderr)
        return 1
    found = {name: tables.read(folder / name) for name in BATCHES if (folder / name / "trials.csv").is_file()}
    if "closing" not in found:
        print(f"navvi: {folder} has no closing/trials.csv, which the page begins with; without --as-is it is made.", file=sys.stderr)
        return 2
    known = effects(folder, not as_is)
    # What a person has written of the figures stays.
    before = file.read_text(encoding="utf-8") if file.exists() else ""
    notes = "## Notes" + before.partition("## Notes")[2] if "## Notes" in before else "## Notes\n"
    day = datetime.date.fromtimestamp((folder / "closing/trials.csv").stat().st_mtime).isoformat()
    file.write_text(page(folder, found, known, notes, day), encoding="utf-8")
    conditions = tables.ordered(found["closing"], "condition")
    file.with_name("guidance.svg").write_text(plots.drawn("Guidance, person by person", plots.means(found["closing"], conditions)), encoding="utf-8")
    if "choices" in found:
        file.with_name("guidance_choices.svg").write_text(plots.drawn("Design choices", plots.changes(found["choices"])), encoding="utf-8")
    return 0
