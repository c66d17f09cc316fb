"""The study's report: one HTML file that needs nothing else, for eyes and for screen readers."""
import base64
import collections
import statistics
from pathlib import Path

import jinja2

from . import figures, table, ways
from .analysis import RESAMPLES, Analysis
from .measures import MEASURES, REACHED, number
from .overview import question, why_nothing
from .questionnaire import DECLINED
from .study import write_safely

TEMPLATES = Path(__file__).resolve().parent / "templates"


def write(study, progress, rehearsed, picture=lambda world, seed, driven: b""):
    """Returns the file."""
    path = study.folder / "report.html"
    write_safely(path, page(study, progress, rehearsed, picture))
    return path


def page(study, progress, rehearsed, picture=lambda world, seed, driven: b""):
    """\\param picture  the SVG of a world and seed with driven ways; empty where it cannot be drawn"""
    analysis = Analysis(study, progress)
    command = f"./navvi study {'rehearse' if rehearsed else 'report'} {Path(progress.plan.file).name}"
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(TEMPLATES), autoescape=True, trim_blocks=True, undefined=jinja2.StrictUndefined)
    environment.tests["number_like"] = lambda cell: number(str(cell).split(" ")[0]) is not None
    primary, secondary = analysis.confirmatory()
    found = ways.records(study, progress)
    return environment.get_template("report.html.j2").render(
        plan=progress.plan, rehearsed=rehearsed, opening=opening(progress), flow=flow(progress), people=people(progress), trials=trials(progress),
        excluded=excluded(progress), resamples=RESAMPLES, primary=contrast_row(primary), secondary=list(map(contrast_row, secondary)),
        figures=[measure_part(analysis, name, command) for name in analysis.asked()], questionnaires=answered(study, progress),
        maps=maps(found, progress.plan, picture, command), lines=time_lines(found, progress.plan, command),
        exploratory=list(map(contrast_row, analysis.exploratory())), quality=quality(study, progress),
        changes=[f"{row['utc']}, {row['reason']}: {change}" for row in progress.freezes for change in row["changes"]], command=command)


def opening(progress):
    frozen = progress.freezes[0] if progress.freezes else None
    if not frozen:
        return "The plan is not frozen: nothing here is confirmatory."
    versions = ", ".join(dict.fromkeys(row["version"] for row in progress.freezes))
    return (f"The plan was frozen on {frozen['utc'][:10]} as {frozen['plan'][:12]}, with NavVI {versions}. "
            f"Primary outcome: {question(progress.plan.primary)}.")


def flow(progress):
    rows = []
    for group in progress.plan.groups:
        members = [progress.people[name] for name in group.participants]
        rows.append([group.name, len(members), sum(one.begun for one in members), sum(progress.complete(one) for one in members),
                     sum(bool(one.withdrawn) for one in members), sum(one.refused for one in members), sum(bool(one.excluded) for one in members)])
    return rows + [["all", *map(sum, zip(*[row[1:] for row in rows]))]]


def people(progress):
    return [f"{person.name} {why_nothing(progress, person)}" for person in progress.people.values()
            if person.withdrawn or person.excluded or person.refused]


def trials(progress):
    kinds = {(person.name, step.name): step.kind for person in progress.people.values() for step in person.steps}
    driven = [(person, attempt) for person in progress.people.values() for attempt in person.attempts if attempt.trial]
    practice, probes = (sum(kinds[person.name, attempt.step] == kind for person, attempt in driven) for kind in ("practice", "probe"))
    counted = sum(attempt.counts and not person.excluded and kinds[person.name, attempt.step] == "trial" for person, attempt in driven)
    missing = sum(len(progress.missing(person)) for person in progress.people.values())
    dropped = sum(attempt.dropped_out and not person.excluded and kinds[person.name, attempt.step] == "trial" for person, attempt in driven)
    rows = [["driven", len(driven)], ["practice", practice], ["probes", probes], ["counted", counted], ["drop-outs", dropped],
            ["excluded", len(driven) - practice - probes - counted - dropped], ["without replacement", missing]]
    results = collections.Counter(attempt.result for person, attempt in driven if attempt.counts and kinds[person.name, attempt.step] == "trial")
    return rows + [[f"counted, {result}", count] for result, count in sorted(results.items())]


def excluded(progress):
    return [[f"{person.name}/{attempt.trial}", attempt.step, attempt.excluded, attempt.excluded_by,
             "yes" if any(other.trial and other.replaces == attempt.trial for other in person.attempts) else "no"]
            for person in progress.people.values() for attempt in person.attempts if attempt.excluded]


def shown(value):
    """Three digits that matter."""
    if value is None or value != value:
        return "n/a"
    if isinstance(value, int):
        return str(value)
    return f"{value:.0f}" if abs(value) >= 100 else f"{value:.3g}"


def with_interval(value, low, high):
    return shown(value) + ("" if low is None else f" ({shown(low)} to {shown(high)})")


def probability(p):
    return "n/a" if p is None else "< 0.001" if p < 0.001 else f"{p:.3f}"


def contrast_row(one):
    effect = f"{one.effect} {with_interval(one.estimate, one.estimate_low, one.estimate_high)}" if one.estimate is not None else "n/a"
    measure = MEASURES[one.measure]
    return [measure.label + (f", of {measure.of}" if measure.of == REACHED else ""), compared(one), one.participants, with_interval(one.difference, one.low, one.high),
            one.model or "n/a", effect, probability(one.p), probability(one.corrected), one.note]


def compared(one):
    return f"{one.second} minus {one.first}"


def measure_part(analysis, name, command):
    """What the template shows of a measure."""
    measure, rows = MEASURES[name], analysis.by_condition(name)
    first = [group.conditions[0] for group in analysis.plan.groups]
    pairs = [pair for pair in analysis.pairs(name) if set(first) & set(pair)]
    contrasts = [one for one in (analysis.contrast(name, *pair) for pair in pairs) if one.participants]
    censored = measure.kind == "time"
    return {
        "name": name, "label": measure.label, "unit": f"{measure.unit}, of {measure.of}", "censored": censored, "command": f"{command} --only {name}",
        "svg": base64.b64encode(figures.by_condition(analysis, name).encode()).decode(),
        "alt": alt(measure, rows), "caption": "A dot is a participant's mean, a line joins one participant's, a square is the mean with its 95 % interval"
        + (", times that were not reached at their limit." if censored else "."),
        "rows": [[f"{row['group']}, {row['condition']}", row["participants"], row["trials"], with_interval(row["mean"], row["low"], row["high"]),
                  shown(row["sd"]), shown(row["median"]), shown(row["least"]), shown(row["most"])] + ([row["unfinished"]] if censored else []) for row in rows],
        "pairs": [[compared(one), one.participants, with_interval(one.difference, one.low, one.high)] for one in contrasts]}


def maps(found, plan, picture, command):
    """A map a world, with the ways of all its trials."""
    conditions, parts = [condition.name for condition in plan.conditions], []
    for (world, seed), driven in ways.by_world(found).items():
        at = {name: number % len(ways.DASHES) for number, name in enumerate(conditions)}
        drawn = picture(world, seed, [(figures.COLOURS[at[name]], ways.DASHES[at[name]], way) for name, way in driven])
        rows = [[name, len(lengths), shown(statistics.mean(lengths)), shown(min(lengths)), shown(max(lengths))] for name in conditions
                if (lengths := [ways.length(way) for condition, way in driven if condition == name])]
        words = "; ".join(f"{row[0]}: {row[1]} ways, {row[2]} m on average" for row in rows)
        world = Path(world).name
        parts.append({"world": f"{world} {seed}", "svg": base64.b64encode(drawn).decode(), "rows": rows, "command": command,
                      "alt": f"The map of world {world}, seed {seed}, with the ways that were driven in it. {words}. The table below has their lengths."})
    return parts


def time_lines(found, plan, command):
    """One figure, and a table of cues a minute; None where no trial has a journal."""
    cues = ways.cues_by_condition(found, [condition.name for condition in plan.conditions])
    if not cues:
        return None
    rows = [[condition, len(trials), *[shown(sum(one == modality for trial in trials for _, one in trial) / minutes if minutes else None)
                                       for modality in ways.MODALITIES]] for condition, (trials, minutes) in cues.items()]
    words = ". ".join(f"{row[0]}: {row[2]} sentences, {row[3]} sounds and {row[4]} felt patterns a minute" for row in rows)
    return {"svg": base64.b64encode(figures.time_lines(cues).encode()).decode(), "rows": rows, "command": command,
            "alt": f"When something was said, played or felt, a line a trial, by condition. {words}. The table below has the same."}


def alt(measure, rows):
    """The plot in words."""
    parts = [f"{row['group']}, {row['condition']}: {with_interval(row['mean'], row['low'], row['high'])}" for row in rows]
    return f"{measure.label}, {measure.unit}, mean by group and condition, in brackets its 95 % interval. " + ". ".join(parts) + ". The table below has all values."


def answered(study, progress):
    """A table for each questionnaire: a row an item, a column a condition."""
    given = collections.defaultdict(list)
    for row in table.answers(study, progress):
        if not progress.people[row["participant"]].excluded:
            given[row["questionnaire"], row["item"], row["condition"]].append(row)
    parts = []
    for asked in progress.plan.asked:
        conditions = list(dict.fromkeys(condition for name, _, condition in given if name == asked.name))
        if conditions:
            rows = [[item.ask, *[answers_in_words(item, given[asked.name, item.name, condition]) for condition in conditions]] for item in asked.items]
            parts.append({"title": asked.title, "conditions": [name if name != "n/a" else "all" for name in conditions], "rows": rows})
    return parts


def answers_in_words(item, rows):
    said = [row["answer"] for row in rows if row["answer"] != DECLINED]
    if item.point:
        errors = [abs(error) for row in rows if (error := number(row["error_deg"])) is not None]
        words = f"{shown(statistics.mean(errors))} degrees off" if errors else "n/a"
    elif item.beside:
        words = f"{sum(row['correct'] == 'yes' for row in rows)} of {sum(row['correct'] != 'n/a' for row in rows)} right"
    elif item.choices:
        words = ", ".join(f"{choice} {count}" for choice, count in collections.Counter(said).most_common())
    else:
        words = shown(statistics.mean(map(float, said))) if said else "n/a"
    return f"{words} ({len(said)}, {len(rows) - len(said)})"


def quality(study, progress):
    rows = [row for row in table.trials(study, progress) if row["phase"] == "trial"]

    def total(column):
        return sum(number(row.get(column)) or 0 for row in rows)
    practice = [row for person in progress.people.values() for row in person.done.values() if "mastered" in row]
    versions = collections.Counter(row.get("version", "n/a") for row in rows)
    bags = collections.Counter(row.get("bag", "n/a") for row in rows)
    return [["trials", len(rows)], ["messages missed", shown(total("missed_messages"))], ["safe stops", shown(total("safe_stop_count"))],
            ["bags", ", ".join(f"{state} {count}" for state, count in bags.items()) or "none"],
            ["versions of NavVI", ", ".join(f"{version} {count}" for version, count in versions.items()) or "none"],
            ["lines of notes and answers that cannot be read", sum(len(study.unread(name)) for name in progress.people)],
            ["interventions", shown(total("interventions"))], ["marks and notes", shown(total("marks"))],
            ["practice without its criterion", f"{sum(not row['mastered'] for row in practice)} of {len(practice)}"]]
