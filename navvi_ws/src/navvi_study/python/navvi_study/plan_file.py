"""Reads a plan from its YAML file, and finds everything that is wrong with the file alone."""
from pathlib import Path

from . import checked, measures
from .checked import code, flag, list_of, number, numbered, one_of, text, whole
from .errors import StudyError
from .plan import ALWAYS, OWN, SWITCHES, Condition, Group, Plan, Question, Rule, shown, worlds_of
from .schedule import steps_of
from .steps import KINDS


def load(path):
    """The plan in the file. Raises StudyError."""
    root = checked.load(path)
    folder = Path(path).absolute().parent
    conditions = tuple(_condition(name, part) for name, part in root.sections("conditions"))
    if len(conditions) < 1:
        raise StudyError(f"{path}: the key \"conditions\" is missing or empty.")
    worlds = root.section("worlds", required=True)
    sets = tuple(worlds_of(part, folder) for _, part in worlds.sections("sets"))
    reserve = worlds_of(worlds.section("reserve", required=True), folder)
    worlds.done()
    minutes = root.section("minutes")
    outcomes = root.section("outcomes", required=True)
    stop = root.section("stop")
    plan = Plan(
        file=str(path), study=root.take("study", code), title=root.take("title", text),
        operator=root.take("operator", one_of("auto", "pad", "keyboard", "simulated"), "auto"),
        learning=root.take("learning", one_of("reset", "frozen", "kept"), "reset"),
        limit=root.take("limit", number(1, 86400)), sessions=root.take("sessions", whole(1, 20), 1),
        order=root.take("order", one_of("williams", "drawn", "listed"), "williams"),
        groups=tuple(_group(name, part, conditions) for name, part in root.sections("groups")),
        conditions=conditions, sets=sets, reserve=reserve,
        lsl=root.take("lsl", flag, False), blind=root.take("blind", flag, False), steps={key: entry for kind in KINDS for key, entry in kind.read(root, folder).items()},
        primary=_question(outcomes.section("primary", required=True), conditions),
        secondary=tuple(_question(part, conditions) for part in outcomes.items("secondary", [])),
        exposure=outcomes.take("exposure", one_of(*measures.EXPOSURES), "trial"),
        exclusions=tuple(_rule(part) for part in root.items("exclusions", [])),
        stop_after=stop.take("completed", whole(1, 10000), 0),
        minutes={**{kind.kind: minutes.take(kind.kind, number(0, 600), kind.usual if kind.kind in ALWAYS else None) for kind in KINDS if kind.timed}, "between": minutes.take("between", number(0, 600), 1.0)})
    for part in (minutes, outcomes, stop, root):
        part.done()
    _check(root, plan)
    return plan


def _condition(name, part):
    name = _name(part, name)
    switches = {switch: part.take(switch, flag, True) for switch in (*SWITCHES, "picture")}
    profile = part.take("profile", one_of("default", "paper"), "default")
    parameters = []
    below = part.section("parameters")
    for key in below.values:
        value = below.take(key, checked.anything)
        if "/" not in key or isinstance(value, dict):
            raise below.error(key, "is not a parameter of a node; allowed are those of ./navvi parameters, such as feedback/haptics/strength: 0.5")
        taken = {name for switch, names in SWITCHES.items() for name in names}
        if key in taken | OWN:
            raise below.error(key, "is set by the study itself; allowed here are the switches " + ", ".join(SWITCHES) + ", and other parameters")
        parameters.append((key, shown(value)))
    part.done()
    return Condition(name=name, profile=profile, parameters=tuple(parameters), **switches)


def _group(name, part, conditions):
    name = _name(part, name)
    names = [condition.name for condition in conditions]
    group = Group(name, tuple(part.take("participants", numbered(code))), tuple(part.take("conditions", list_of(one_of(*names)), names)))
    if len(set(group.conditions)) < len(group.conditions):
        raise part.error("conditions", "has a condition twice; once is allowed")
    part.done()
    return group


def _rule(part):
    allowed = part.take("is", list_of(text), None)
    above = part.take("above", number(-1e9, 1e9), None)
    if (allowed is None) == (above is None):
        raise StudyError(f"{part.file}: \"{part.path}\" needs one of the keys \"is\" and \"above\".")
    rule = Rule(part.take("column", text), part.take("reason", text), tuple(allowed or ()), above)
    part.done()
    return rule


def _question(part, conditions):
    names = [condition.name for condition in conditions]
    measure = part.take("measure", one_of(*measures.MEASURES))
    pair = part.take("conditions", list_of(one_of(*names)))
    if len(pair) != 2 or pair[0] == pair[1]:
        raise part.error("conditions", f"has {len(pair)} entries or one twice; allowed are two conditions")
    trials, defined = part.take("trials", one_of("reached"), ""), measures.MEASURES[measure].of
    if trials and defined != measures.REACHED:
        raise part.error("trials", f"is {trials}, and {measure} is defined for {defined}; allowed is to leave it out")
    if part.path == "outcomes/primary" and defined == measures.REACHED and not trials:
        whole = ", ".join(name for name, one in measures.MEASURES.items() if one.of != measures.REACHED)
        raise part.error("measure", f"is {measure}, which is defined for {defined} alone; allowed are \"trials: reached\" beside it, by which "
                         f"the plan leaves the others out, and the measures {whole}")
    within, effect, sd = (part.take(key, number(1e-6, 1e6), 0.0) for key in ("equivalent_within", "effect", "sd"))
    part.done()
    if (sd or effect) and not (sd and bool(within) != bool(effect)):
        raise StudyError(f"{part.file}: \"{part.path}\" needs \"sd\" with one of the keys \"effect\" and \"equivalent_within\" for a sample size.")
    return Question(measure, *pair, trials, within, effect, sd)


def _name(part, name):
    try:
        return code(name)
    except ValueError as allowed:
        raise StudyError(f"{part.file}: \"{part.path}\" is named \"{name}\"; allowed is {allowed}.") from None


def _check(root, plan):
    """What is wrong between parts of the plan."""
    twice = _first_twice(plan.participants)
    if not plan.groups:
        raise StudyError(f"{plan.file}: the key \"groups\" is missing or empty.")
    if twice:
        raise root.error("groups", f"plans {twice} twice; once is allowed")
    sizes = {len(worlds) for worlds in plan.sets}
    if len(sizes) != 1:
        raise root.error("worlds", "has sets of different sizes, or none; allowed are sets with the same number of worlds")
    if twice := _first_twice(plan.worlds):
        raise root.error("worlds", f"has {twice} twice, and nobody may meet a world twice; allowed are other seeds")
    for group in plan.groups:
        if len(group.conditions) > len(plan.sets):
            raise root.error("worlds", f"has {len(plan.sets)} sets, and group {group.name} has {len(group.conditions)} conditions; allowed are as many sets or more")
        if plan.sessions > len(group.conditions):
            raise root.error("sessions", f"is {plan.sessions}, and group {group.name} has {len(group.conditions)} conditions; allowed is a condition a session or more")
        seen = {}
        for name in group.conditions:
            same = seen.setdefault(tuple(sorted(plan.condition(name).arguments().items())), name)
            if same != name:
                raise root.error("conditions", f"has {same} and {name}, which are alike; allowed are conditions that differ")
    for kind in KINDS:
        kind.check(root, plan)
    if twice := _first_twice([step.name for step in steps_of(plan, plan.participants[0])]):
        raise root.error("questionnaires", f"has the step {twice} twice; allowed is a questionnaire once after a condition, "
                         "and once at the begin or the end of a session")
    consent = plan.steps["consent"]
    for key, asked in (("consent", [consent] if consent else []), ("questionnaires", [one for key in ("at_begin", "after_condition", "at_end") for one in plan.steps[key]])):
        if any(item.probes for one in asked for item in one.items):
            raise root.error(key, "asks about a trial that stopped; allowed are such items below the plan's key \"probes\"")
    agreed = [item.name for item in consent.items if "yes" in item.choices] if consent else []
    for one in plan.asked:
        if one.scope and one.scope not in agreed:
            raise root.error("questionnaires", f"has {one.name}, which needs \"yes\" to the item {one.scope} of the consent; the consent's items with a yes are: "
                             + (", ".join(agreed) or "none"))
    for question in (plan.primary, *plan.secondary):
        if not any({question.first, question.second} <= set(group.conditions) for group in plan.groups):
            raise root.error("outcomes", f"compares {question.first} and {question.second}, which no group has both; allowed are two conditions of a group")
        asked = measures.MEASURES[question.measure].questionnaire
        if asked and asked not in [one.measured for one in plan.asked]:
            raise root.error("outcomes", f"has the measure {question.measure}, and the plan does not ask {asked}; allowed is a questionnaire of the plan")


def _first_twice(entries):
    seen = set()
    for entry in entries:
        if entry in seen:
            return entry
        seen.add(entry)
    return None
