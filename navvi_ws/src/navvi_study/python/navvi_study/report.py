"""The study's report: one HTML file that needs nothing else, for eyes and for screen readers."""
import base64
import collections
import math
import statistics
from pathlib import Path

import jinja2

from . import figures, overview, preregistration, table, verify, ways
from .analysis import Analysis
from .measures import MEASURES, REACHED, RESAMPLES, number
from .questionnaire import DECLINED
from .session import why_nothing
from .steps import KINDS
from .study import write_safely

BLIND = "The report is blinded: letters stand for the conditions, by a drawn key in blinding.json, and no table of cues tells them."
TEMPLATES = Path(__file__).resolve().parent / "templates"


def write(study, progress, rehearsed, picture=lambda world, seed, driven: b""):
    """Returns the file."""
    path = study.folder / ("report-blind.html" if study.letters else "report.html")
    write_safely(path, page(study, progress, rehearsed, picture))
    return path


def page(study, progress, rehearsed, picture=lambda world, seed, driven: b""):
    """\\param picture  the SVG of a world and seed with driven ways; empty where it cannot be drawn"""
    analysis, plan = Analysis(study, progress), progress.plan
    command = f"./navvi study {'rehearse' if rehearsed else 'report'} {Path(plan.file).name}{' --blind' if study.letters else ''}"
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(TEMPLATES), autoescape=True, trim_blocks=True, undefined=jinja2.StrictUndefined)
    environment.tests["number_like"] = lambda cell: number(str(cell).split(" ")[0]) is not None
    environment.globals["filled"] = filled
    primary, secondary = analysis.confirmatory()
    found = ways.records(study, progress)
    asked = [name for name in analysis.asked() if not analysis.alike(name)]
    parts = {name: measure_part(analysis, name, command) for name in asked}
    of_outcomes = [primary.measure, *[one.measure for one in secondary]]
    return environment.get_template("report.html.j2").render(
        plan=plan, rehearsed=rehearsed, opening=opening(progress), who=who(progress, primary), flow=flow(progress, primary), people=people(progress),
        trials=trials(progress), legs=legs(study, progress), besides=besides(progress), excluded=excluded(progress), resamples=RESAMPLES,
        primary=answer(analysis, primary, False), secondary=[answer(analysis, one, True) for one in secondary], parts=parts,
        outcomes=of_outcomes, conditions=[BLIND] if study.letters else overview.conditions(plan), models=preregistration.MODELS.values(), alike=[alike(analysis, name) for name in analysis.asked() if name not in (*asked, *of_outcomes)],
        questionnaires=answered(study, progress), maps=maps(found, plan, picture, command), cues=[] if study.letters else cues(found, plan),  # a condition without touch has no pulses
        exploratory=[contrast_row(analysis, one) for one in analysis.exploratory()], quality=quality(study, progress),
        changes=[] if study.letters else [f"{row['utc']}, {row['reason']}: {change}" for row in progress.freezes for change in row["changes"]], command=command)


def filled(head, rows):
    """Head and rows without the columns in which no row has a value; the first stays."""
    kept = [at for at in range(len(head)) if at == 0 or any(row[at] not in ("n/a", "") for row in rows)]
    return [[row[at] for at in kept] for row in (head, *rows)]


def opening(progress):
    frozen = progress.freezes[0] if progress.freezes else None
    if not frozen:
        return "The plan is not frozen: nothing here is confirmatory."
    versions = ", ".join(dict.fromkeys(row["version"] for row in progress.freezes))
    drawn = ""
    if progress.plan.order == "drawn":
        drawn = (f" Orders were drawn by the seed {progress.plan.seed}, whose SHA-256 is in the journal since then." if progress.over else
                 " Orders are drawn by a seed that is printed here once nobody is left to begin.")
    begun = [attempt.seq for _, attempt in driven(progress, "trial")]
    blind = "".join(f" Conditions were letters until {row['utc'][:10]}, when the blinded report had the SHA-256 {row['report']}; "
                    + (f"not all participants were through, for the reason \"{row['reason']}\"; " if row.get("reason") else "")
                    + f"trials after that: {sum(seq > row['seq'] for seq in begun)}." for row in progress.analyses)
    return f"The plan was frozen on {frozen['utc'][:10]} as {frozen['plan'][:12]}, with NavVI {versions}.{drawn}{blind}"


FLOW = {
    "planned": lambda progress, person: True,
    "enrolled": lambda progress, person: person.begun and (person.attempts or not person.refused),
    "completed": lambda progress, person: progress.complete(person),
    "withdrawn": lambda progress, person: bool(person.withdrawn),
    "without consent": lambda progress, person: person.refused,
    "excluded": lambda progress, person: bool(person.excluded),
}


def flow(progress, primary):
    """A row a group, and one for all: how many of each state of FLOW, and how many are analysed in the primary outcome."""
    analysed = set(() if primary.differences is None else primary.differences.index)
    rows = []
    for group in progress.plan.groups:
        members = [progress.people[name] for name in group.participants]
        rows.append([group.name, *[sum(bool(state(progress, one)) for one in members) for state in FLOW.values()], len(analysed & set(group.participants))])
    return rows if len(rows) == 1 else rows + [["all", *map(sum, zip(*[row[1:] for row in rows]))]]


def who(progress, primary):
    """The flow in a sentence."""
    count = dict(zip([*FLOW, "analysed"], flow(progress, primary)[-1][1:]))
    parts = [f"{count[state]} {state}" for state in count if count[state] or state in ("enrolled", "excluded", "analysed")]
    return f"Participants: {', '.join(parts)} in the primary outcome."


def people(progress):
    return [f"{person.name} {why_nothing(progress, person)}" for person in progress.people.values()
            if person.withdrawn or person.excluded or person.refused]


def trials(progress):
    """A row a condition: what came of its trials."""
    rows = collections.defaultdict(lambda: [0] * 6, {condition.name: [0] * 6 for condition in progress.plan.conditions})
    for person, attempt in driven(progress, "trial"):
        kind = 4 if person.excluded else 3 if attempt.dropped_out else 4 if not attempt.counts else 1 if attempt.result == "reached" else 2
        for at in (0, kind):
            rows[attempt.condition][at] += 1
    for person in progress.kept:
        for step in progress.missing(person):
            rows[step.condition][5] += 1
    return [[name, *counts] for name, counts in rows.items()]


def legs(study, progress):
    """A row a condition and place of a job: how often it was driven to and reached, and the mean time."""
    found = collections.defaultdict(list)
    for row in table.trials(study, progress):
        if "leg" in row and row["counts"] == "yes":
            found[row["condition"], int(row["leg"]), row["place"], row["do"]].append(row)
    return [[f"{condition}: {leg}. {place}, {do}", len(rows), sum(row["result"] == "reached" for row in rows), shown(statistics.mean(float(row["elapsed_s"]) for row in rows))]
            for (condition, leg, place, do), rows in sorted(found.items())]


def driven(progress, kind):
    """(person, attempt) of each trial of that kind of step, of those who have not withdrawn their data."""
    return [(person, attempt) for person in progress.kept for attempt in person.attempts if attempt.phase == kind and attempt.trial]


def besides(progress):
    counts = [(len(driven(progress, kind.kind)), kind.besides) for kind in KINDS if kind.besides]
    return ", ".join(f"{count} {words}" for count, words in counts if count)


def excluded(progress):
    return [[f"{person.name}/{attempt.trial}", attempt.step, attempt.excluded, attempt.excluded_by,
             "yes" if any(other.trial and other.replaces == attempt.trial for other in person.attempts) else "no"]
            for person in progress.kept for attempt in person.attempts if attempt.excluded]


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
    return "< 0.001" if p < 0.001 else f"= {p:.3f}"


def answer(analysis, one, holm):
    """A confirmatory outcome in words."""
    told = {"measure": one.measure, "label": MEASURES[one.measure].label}
    if one.participants and analysis.alike(one.measure):
        return {**told, "sentence": alike(analysis, one.measure), "test": "", "note": ""}
    return {**told, "sentence": sentence(analysis, one), "test": tested(one, holm), "note": one.note}


def sentence(analysis, one):
    """The difference and its interval, without a sign: "participants took 38 s less than in words [29, 46]; less in 20 of 20 pairs"."""
    measure, scale = MEASURES[one.measure], 100 if MEASURES[one.measure].kind == "share" else 1
    if one.difference is None:
        return f"{measure.label}, {compared(one)}: {one.note}."
    if abs(one.difference) < 1e-9:
        return f"{measure.label}: {one.first} and {one.second} have the same mean over {one.participants} participants."

    def size(value):
        return f"{scale * abs(value):.{digits}f}"
    # Two digits that matter, of the difference or of a tenth of its interval's half width; the interval has the same decimals.
    widest = abs(one.difference) if one.low is None else max(abs(one.difference), (one.high - one.low) / 20)
    digits = max(0, 1 - math.floor(math.log10(scale * widest)))
    sign = 1 if one.difference > 0 else -1
    more = measure.more[sign > 0]
    told = measure.sentence.format(amount=size(one.difference), more=more, unit=analysis.unit(one.measure))
    interval = ""
    if one.low is not None and one.low * one.high >= 0:
        interval = " [{}, {}]".format(*map(size, sorted((one.low, one.high), key=abs)))
    elif one.low is not None:
        near, far = (one.low, one.high) if sign > 0 else (one.high, one.low)
        interval = f" [from {size(near)} {measure.more[int(near > 0)]} to {size(far)} {more}]"
    tied = int((one.differences == 0).sum())
    return (f"In condition {one.first}, {told} than in {one.second}{interval}; {more} in {one.agreeing} of {one.participants} pairs"
            + (f", alike in {tied}." if tied else "."))


def tested(one, holm):
    """Model, effect and p; empty where nothing was tested."""
    if one.p is None:
        return ""
    words = one.model[0].upper() + one.model[1:]
    if one.estimate is not None:
        words += f": {effect(one)}"
    words += f"; p {probability(one.p)}" + (f", after Holm's correction p {probability(one.corrected)}" if holm else "")
    if one.within:
        words += f". The two are {'' if one.corrected < 0.05 else 'not shown to be '}equivalent within {shown(one.within)}, the plan's smallest effect of interest"
    return words + "."


def effect(one):
    if one.estimate is None:
        return "n/a"
    return f"{one.effect} {shown(one.estimate)} ({'90 % interval ' if one.within else ''}{shown(one.estimate_low)} to {shown(one.estimate_high)})"


def contrast_row(analysis, one):
    measure = MEASURES[one.measure]
    return [f"{measure.label}, {analysis.unit(one.measure)}" + (f", of {measure.of}" if measure.of == REACHED else ""), compared(one), one.participants,
            with_interval(one.difference, one.low, one.high), effect(one), "n/a" if one.p is None else probability(one.p).removeprefix("= "),
            "n/a" if one.corrected is None else probability(one.corrected).removeprefix("= ")]


def compared(one):
    return f"{one.first} minus {one.second}"


def alike(analysis, name):
    values = analysis.values(name)["value"]
    return f"{MEASURES[name].label}: {shown(values.iloc[0])} in each of {len(values)} {'questionnaires' if MEASURES[name].questionnaire else 'trials'}."


def measure_part(analysis, name, command):
    """What the template shows of a measure."""
    measure, rows = MEASURES[name], analysis.by_condition(name)
    censored, left_out = measure.kind == "time", analysis.prorated(name)
    return {
        "name": name, "label": measure.label, "unit": f"{analysis.unit(name)}, of {measure.of}", "censored": censored, "command": f"{command} --only {name}",
        "svg": base64.b64encode(figures.by_condition(analysis, name).encode()).decode(),
        "alt": alt(analysis, name, rows), "caption": "A dot is a participant's mean, a line joins one participant's, a square is the mean with its 95 % interval"
        + (", times that were not reached at their limit." if censored else "."),
        "prorated": f"{left_out} of {len(analysis.values(name))} scores are prorated: one item was declined, and the mean is that of the others." if left_out else "",
        "rows": [[f"{row['group']}, {row['condition']}", row["participants"], row["trials"], with_interval(row["mean"], row["low"], row["high"]),
                  shown(row["sd"]), shown(row["median"])] + ([row["unfinished"]] if censored else []) for row in rows]}


def conditions_of(found, plan):
    """Names of the plan's conditions, then of those that were driven and that it has no more."""
    return list(dict.fromkeys([*(condition.name for condition in plan.conditions), *(row["condition"] for row, _ in found)]))


def maps(found, plan, picture, command):
    """A map a world, with the ways of all its trials."""
    conditions, parts = conditions_of(found, plan), []
    for (world, seed), driven in ways.by_world(found).items():
        at = {name: number % len(ways.DASHES) for number, name in enumerate(conditions)}
        drawn = picture(world, seed, [(figures.COLOURS[at[name]], ways.DASHES[at[name]], way) for name, way in driven])
        rows = [[name, len(lengths), shown(statistics.mean(lengths)), shown(min(lengths)), shown(max(lengths))] for name in conditions
                if (lengths := [ways.length(way) for condition, way in driven if condition == name])]
        words = "; ".join(f"{row[0]}: {row[1]} ways, {row[2]} m on average" for row in rows)
        world = Path(world).name
        parts.append({"world": f"{world} {seed}", "svg": base64.b64encode(drawn).decode(), "rows": rows, "command": command,
                      "caption": "Ways that were driven, a point a second; conditions in the order of the table are full, dashed, dotted and so on, each in its colour.",
                      "alt": f"The map of world {world}, seed {seed}, with the ways that were driven in it. {words}. The table below has their lengths."})
    return parts


def cues(found, plan):
    """Rows of the table of cues a minute; none where no trial has a journal."""
    return [[condition, trials, *[shown(count / minutes if minutes else None) for count in counts]]
            for condition, (trials, minutes, counts) in ways.cues_by_condition(found, conditions_of(found, plan)).items()]


def alt(analysis, name, rows):
    """The plot in words."""
    parts = [f"{row['group']}, {row['condition']}: {with_interval(row['mean'], row['low'], row['high'])}" for row in rows]
    return (f"{MEASURES[name].label}, {analysis.unit(name)}, mean by group and condition, in brackets its 95 % interval. " + ". ".join(parts)
            + ". The table below has the same.")


def answered(study, progress):
    """A table for each questionnaire: a row an item, a column a condition."""
    given = collections.defaultdict(list)
    for row in table.answers(study, progress):
        if not progress.people[row["participant"]].excluded:
            given[row["questionnaire"], row["item"], row["condition"]].append(row)
    parts = []
    for asked in progress.plan.asked:
        here = {condition for name, _, condition in given if name == asked.name}
        planned = [condition.name for condition in progress.plan.conditions]
        conditions = sorted(here, key=lambda name: (name == "n/a", planned.index(name) if name in planned else len(planned), name))
        if conditions:
            rows = [[item.ask, *[answers_in_words(item, given[asked.name, item.name, condition]) for condition in conditions]] for item in asked.items]
            parts.append({"title": asked.title, "conditions": [name if name != "n/a" else "Answer" for name in conditions], "rows": rows})
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
    practice = [row for person in progress.kept for row in person.done.values() if "mastered" in row]
    versions = collections.Counter(row.get("version", "n/a") for row in rows)
    bags = collections.Counter(row.get("bag", "n/a") for row in rows)
    return [["trials", len(rows)], ["messages missed", shown(total("missed_messages"))], ["safe stops", shown(total("safe_stop_count"))],
            ["bags", ", ".join(f"{state} {count}" for state, count in bags.items()) or "none"],
            ["versions of NavVI", ", ".join(f"{version} {count}" for version, count in versions.items()) or "none"],
            ["trials whose tables changed since they ended", verify.changed(study, progress)],
            ["trials that the exclusions of now judge otherwise than those when they ended", len(overview.judged_otherwise(study, progress))],
            ["rows that the journal has lost", " ".join(overview.losses(progress)) or "none"],
            ["lines of notes and answers that cannot be read", sum(len(study.unread(name)) for name in progress.people)],
            ["interventions", shown(total("interventions"))], ["marks and notes", shown(total("marks"))],
            ["practice without its criterion", f"{sum(not row['mastered'] for row in practice)} of {len(practice)}"]]
