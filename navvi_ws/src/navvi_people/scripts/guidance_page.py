"""doc/guidance.md: runs its batches, or what is missing of them, and writes the page with its plots."""
import datetime
import re
import subprocess
import sys
from pathlib import Path

import guidance_plots as plots
import guidance_tables as tables

NAVVI = Path(__file__).resolve().parents[4] / "navvi"
THREE = "--people=" + ",".join(tables.TYPES)
CLOSING = "--conditions=sighted,default,sounds_off,touch_off"
TRAITS = ("hearing/sound_reaction", "hearing/sound_spread", "hearing/missed_sounds", "hearing/word_reaction", "driving/noise", "feeling/delay")
# No seed of these was used for tuning.
BATCHES = {
    "closing": ["--seeds=92001-92400", THREE, CLOSING],
    "drawn": ["--seeds=92001-92005", "--people=drawn:1-20", CLOSING],
    "choices": ["--seeds=92401-92440", THREE,
                "--conditions=default,sounds_off,touch_off,no_stop=feedback/cues/near/stop_moving:=0+feedback/cues/near/stop_standing:=0,"
                "beacon=feedback/sounds/beacon/on:=true,brief,attractive,early_words=feedback/cues/route/turn_ahead:=10"],
    "moved": ["--seeds=92401-92420",
              "--people=typical," + ",".join(f"typical~{trait}{sign}1" for trait in TRAITS for sign in "+-"),
              "--conditions=default,sounds_off,touch_off"],
}
CHOICES = """`sounds_off`: no short sounds; `touch_off`: no motors; `no_stop`: no "stop" before obstacles; `beacon`: a beacon at the next way-point
besides, which no simulated person steers by; `brief`: brief words; `attractive`: the motors pull to the side to turn to; `early_words`:
turns are announced from 10 m on instead of 6 m."""


def batch(folder, name, jobs):
    """\\return the rows of one of BATCHES; None where it could not be finished"""
    words = [NAVVI, "batch", "--worlds=busy", "--limit=600", f"--jobs={jobs}", "--tell=60", *BATCHES[name], f"--out={folder / name}"]
    done = subprocess.run(words, check=False).returncode == 0
    return tables.read(folder / name) if done else None


def effects():
    """Published effects, a column a type; None where one of them could not be measured."""
    rows = {}
    for person in tables.TYPES:
        result = subprocess.run([NAVVI, "bench", "people", person], stdout=subprocess.PIPE, text=True, check=False)
        if result.returncode:
            return None
        for cells in re.findall(r"^\| (.+) \| (.+) \| (.+) \| (-?[\d.]+) \| (.+) \|$", result.stdout, re.M):
            rows.setdefault(cells[:3], []).append(f"{cells[3]} {cells[4]}")
    return [*tables.head("effect", "source", "published", *tables.TYPES), *(tables.line(*effect, *cells) for effect, cells in rows.items())]


def command(name):
    return "    ./navvi batch --worlds=busy --limit=600 " + " ".join(f"'{word}'" if "~" in word else word for word in BATCHES[name]) + f" --out={name}"


def section(title, *parts):
    return [f"## {title}", *(line for part in parts for line in ([part, ""] if isinstance(part, str) else [*part, ""]))]


def page(found, known, notes, day):
    closing = found["closing"]
    return "\n".join([
        "# Guidance, person by person",
        "Simulated people ([their traits](people.md)); nobody has driven yet. All of this page but the notes is made by",
        "`./navvi bench guidance TRIALS -o doc/guidance.md`, which runs the batches that it names, or what is missing of them.",
        f"Measured on {day} in world `busy`, on seeds that no tuning saw, limit 600 s. Intervals hold 95 % (bootstrap); changes are beside",
        "`default` over the same worlds. `sighted` is the same hand led by eyes, and `sounds_off` leaves words and touch.", "",
        *section("Goals", tables.goals(closing)),
        *section("Closing table", command("closing"), tables.guidance(closing),
                 "![Contacts, time and SPL with intervals, by condition; a mark a person](guidance.svg)"),
        *section("Drawn persons", "Twenty persons whose traits are drawn, each in five worlds.", command("drawn"), tables.guidance(found["drawn"])),
        *section("Design choices", CHOICES, command("choices"), tables.flips(found["choices"]),
                 "![Changes beside the default with intervals, by design choice; a mark a person](guidance_choices.svg)"),
        *section("One trait moved by a standard deviation", "Of the typical person.", command("moved"), tables.moved(found["moved"])[1:]),
        *section("Failures", "In `default` of the closing table.", tables.failures(closing)),
        *section("Published effects", "`./navvi bench people TYPE`; sessions are of 8 trials each.", known),
        notes])


def make(folder, file, jobs):
    found = {name: batch(folder, name, jobs) for name in BATCHES}
    known = effects()
    if known is None or any(rows is None for rows in found.values()):
        print("navvi: a part of the page could not be measured; the same command goes on.", file=sys.stderr)
        return 1
    # What a person has written of the figures stays.
    before = file.read_text(encoding="utf-8") if file.exists() else ""
    notes = "## Notes" + before.partition("## Notes")[2] if "## Notes" in before else "## Notes\n"
    day = datetime.date.fromtimestamp((folder / "closing/trials.csv").stat().st_mtime).isoformat()
    file.write_text(page(found, known, notes, day), encoding="utf-8")
    three = tables.ordered(found["closing"], "condition")
    file.with_name("guidance.svg").write_text(plots.drawn("Guidance, person by person", plots.means(found["closing"], three)), encoding="utf-8")
    file.with_name("guidance_choices.svg").write_text(plots.drawn("Design choices", plots.changes(found["choices"])), encoding="utf-8")
    return 0
