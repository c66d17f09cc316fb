"""Reads a plan from its YAML file, and finds everything that is wrong with the file alone."""
from pathlib import Path

from . import checked, measures, questionnaire
from .checked import code, flag, list_of, number, numbered, one_of, text, whole
from .errors import StudyError
from .plan import OWN, SWITCHES, WORLD_FILES, Condition, Group, Pause, Plan, Practice, Probes, Question, Rule, World, shown


def load(path):
    """The plan in the file. Raises StudyError."""
    root = checked.load(path)
    folder = Path(path).absolute().parent
    conditions = tuple(_condition(name, part) for name, part in root.sections("conditions"))
    if len(conditions) < 1:
        raise StudyError(f"{path}: the key \"conditions\" is missing or empty.")
    worlds = root.section("worlds", required=True)
    sets = tuple(tuple(_worlds(part, folder)) for _, part in worlds.sections("sets"))
    reserve = tuple(_worlds(worlds.section("reserve", required=True), folder))
    worlds.done()
    questions = root.section("questionnaires")
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
        practice=_practice(root.section("practice"), folder), probes=_probes(root.section("probes"), folder), pause=_pause(root.section("break")),
        calibrate=root.take("calibrate", flag, False), lsl=root.take("lsl", flag, False),
        consent=questionnaire.find(root.take("consent", text), folder) if "consent" in root else None,
        at_begin=_questionnaires(folder, questions, "at_begin"), after_condition=_questionnaires(folder, questions, "after_condition"), at_end=_questionnaires(folder, questions, "at_end"),
        primary=_question(outcomes.section("primary", required=True), conditions),
        secondary=tuple(_question(part, conditions) for part in outcomes.items("secondary", [])),
        exposure=outcomes.take("exposure", one_of(*measures.EXPOSURES), "trial"),
        exclusions=tuple(_rule(part) for part in root.items("exclusions", [])),
        stop_after=stop.take("completed", whole(1, 10000), 0),
        minutes=_minutes(root.section("minutes")))
    for part in (questions, outcomes, stop, root):
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


def _worlds(part, folder):
    """`{world: NAME, seeds: [...]}`; a file is looked for beside the plan."""
    world = part.take("world", text)
    if world.endswith(WORLD_FILES) and not (folder / world).is_file():
        raise part.error("world", f"is \"{world}\", and {folder / world} is not a file; allowed are files beside the plan, and names of ./navvi world list")
    worlds = [World(world, seed) for seed in part.take("seeds", numbered(whole(0, 2**31 - 1)))]
    part.done()
    return worlds


def _practice(part, folder):
    if not part.values:
        return None
    practice = Practice(
        before=part.take("before", one_of("study", "session", "condition"), "study"), in_a_row=part.take("in_a_row", whole(1, 20), 1),
        collisions=part.take("collisions_at_most", whole(0, 1000), 0), most=part.take("most", whole(1, 50), 5),
        worlds=tuple(_worlds(part.section("worlds", required=True), folder)))
    part.done()
    if practice.in_a_row > practice.most:
        raise part.error("in_a_row", f"is more than \"most\", which is {practice.most}; at most that is allowed")
    return practice


def _probes(part, folder):
    if not part.values:
        return None
    after = part.take("after", list_of(number(1, 86400)))
    if len(after) != 2 or after[0] > after[1]:
        raise part.error("after", "is not a pair; allowed are the earliest and the latest second, such as [20, 60]")
    probes = Probes(*after, tuple(_worlds(part.section("worlds", required=True), folder)), questionnaire.find(part.take("ask", text, "probe"), folder))
    part.done()
    return probes


def _pause(part):
    if not part.values:
        return None
    pause = Pause(part.take("after", whole(1, 20), 1), part.take("minutes", number(0, 600)))
    part.done()
    return pause


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
    within = part.take("equivalent_within", number(1e-6, 1e6), 0.0)
    part.done()
    return Question(measure, *pair, trials, within)


def _questionnaires(folder, part, key):
    return tuple(questionnaire.find(name, folder) for name in part.take(key, list_of(text), []))


def _minutes(part):
    """What a session's parts take, for the schedule."""
    given = {"trial": None, "practice": None, "probe": None, "questionnaire": 3.0, "consent": 5.0, "calibrate": 6.0, "between": 1.0}
    minutes = {name: part.take(name, number(0, 600), usual) for name, usual in given.items()}
    part.done()
    return minutes


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
        if plan.probes and len(group.conditions) > len(plan.probes.worlds):
            raise root.error("probes", f"has {len(plan.probes.worlds)} worlds, and group {group.name} has {len(group.conditions)} conditions; allowed are as many worlds or more")
        if plan.sessions > len(group.conditions):
            raise root.error("sessions", f"is {plan.sessions}, and group {group.name} has {len(group.conditions)} conditions; allowed is a condition a session or more")
        seen = {}
        for name in group.conditions:
            same = seen.setdefault(tuple(sorted(plan.condition(name).arguments().items())), name)
            if same != name:
                raise root.error("conditions", f"has {same} and {name}, which are alike; allowed are conditions that differ")
    for key, asked in (("consent", [plan.consent] if plan.consent else []), ("questionnaires", [*plan.at_begin, *plan.after_condition, *plan.at_end])):
        if any(item.probes for one in asked for item in one.items):
            raise root.error(key, "asks about a trial that stopped; allowed are such items below the plan's key \"probes\"")
    agreed = [item.name for item in plan.consent.items if "yes" in item.choices] if plan.consent else []
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
