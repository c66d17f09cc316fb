"""What `study check` and `study status` print: plain lines, for a screen reader as well."""
from .schedule import minutes_of, order_of, orders_of, steps_of
from .session import WHOLE, why_nothing
from .steps import kind_of


def schedule(plan):
    """The whole study, before anything starts."""
    lines = [f"{plan.title}: study {plan.study}, {counted(len(plan.participants), 'participant')} in "
             f"{counted(len(plan.groups), 'group')}, {counted(plan.sessions, 'session')} each.",
             f"Primary outcome: {question(plan.primary)}. Everything is kept in {plan.folder}.", ""]
    lines += [*conditions(plan), *broken_off(plan)]
    lines += [f"Worlds: {counted(len(plan.sets), 'set')} of {len(plan.sets[0])}, {len(plan.reserve)} in reserve; {plan.limit:g} s at most in each.", ""]
    for group in plan.groups:
        lines.append(f"Group {group.name}:")
        if plan.order == "drawn":
            orders = "; ".join(", ".join(group.conditions[at] for at in order) for order in orders_of(plan, group))
            lines.append(f"  The order of each participant is drawn by \"study freeze\", and not printed before it is due; it is one of: {orders}.")
        for name in group.participants if plan.order != "drawn" else ():
            shown = "; ".join(f"{condition} in {', '.join(map(str, worlds))}" for condition, worlds in order_of(plan, name))
            lines.append(f"  {name}: {' and '.join(f'{minutes:.0f}' for minutes in minutes_of(plan, name))} min. {shown}.")
    lines += ["", f"What {'a participant may do' if plan.order == 'drawn' else f'{plan.participants[0]} does'}:"]
    for step in steps_of(plan, plan.participants[0]):
        minutes = f", about {round(step.minutes, 1):g} min" if step.minutes else ""
        lines.append(f"  {step.name}: {step}" + (f", {step.world}" if step.world else "") + minutes)
    lines += ["", *balance(plan)]
    hours = sum(sum(minutes_of(plan, name)) for name in plan.participants) / 60
    lines.append(f"All together {hours:.1f} hours.")
    return lines


def conditions(plan):
    lines = []
    for condition in plan.conditions:
        switched = [f"{'no ' if not getattr(condition, name) else ''}{name}" for name in ("touch", "speech", "sounds", "picture")]
        lines.append(f"Condition {condition.name}: {', '.join(switched)}, profile {condition.profile}"
                     + "".join(f", {name} {value}" for name, value in condition.parameters) + ".")
    return lines


def broken_off(plan):
    """What happens to trials that do not end at goal or limit."""
    lines = ["A trial that the person or the experimenter ends is a drop-out: not reached (of a job, the legs before keep their results), in no other "
             "measure, and nothing takes its place.",
             "A trial that breaks off by itself (aborted, refused, invalid) does not count, and a world of the reserve takes its place."]
    return lines + [f"The same holds where {rule.column} is {' or '.join(rule.one_of) if rule.one_of else f'above {rule.above:g}'}: {rule.reason}." for rule in plan.exclusions]


def balance(plan):
    """A sentence a group: whether as many take part as its orders need."""
    lines = []
    words = {"williams": "balanced for order and first-order carry-over", "listed": "in the order of the plan, alike for all",
             "drawn": "balanced for order and first-order carry-over, and allotted by a drawn seed in blocks of as many participants"}[plan.order]
    for group in plan.groups:
        orders = len(orders_of(plan, group))
        left = len(group.participants) % orders
        lines.append(f"Group {group.name}: {counted(orders, 'order')}, {words}." if not left else
                     f"Group {group.name}: {orders} orders and {len(group.participants)} participants; balanced would be {len(group.participants) + orders - left}.")
    return lines


def question(one):
    from .measures import MEASURES
    return f"{MEASURES[one.measure].label.lower()}, {one.first} minus {one.second}, of {MEASURES[one.measure].of}"


def status(study, progress):
    """A line a participant, one a trial that does not count, and how many are through."""
    plan = progress.plan
    lines = []
    for person in progress.people.values():
        trials = [step for step in person.steps if step.counts]
        driven = sum(any(attempt.counts for attempt in person.of(step)) for step in trials)
        step = progress.next(person)
        concealed = plan.order == "drawn" and not person.begun
        what = f"next is {step.name}{'' if concealed else f', {step}'}" if step else why_nothing(progress, person)[:-1]
        lines.append(f"{person.name}: {driven} of {len(trials)} trials; {'has not begun; ' if not person.begun else ''}{what}.")
        for attempt in person.attempts if person in progress.kept else ():
            if attempt.dropped_out:
                lines.append(f"  {person.name}/{attempt.trial} is a {attempt.excluded}.")
            elif attempt.excluded:
                lines.append(f"  {person.name}/{attempt.trial} does not count: {attempt.excluded}, by {attempt.excluded_by}.")
            elif not attempt.ended:
                lines.append(f"  {attempt.step} is running, or was broken off; \"study next\" goes on.")
        lines += [f"  {sentence}" for sentence in study.unread(person.name)]
        if missing := progress.missing(person):
            lines.append(f"  without a trial that counts: {', '.join(step.name for step in missing)}.")
    complete = sum(progress.complete(person) for person in progress.people.values())
    begun = sum(person.begun for person in progress.people.values())
    frozen = f"frozen {counted(len(progress.freezes), 'time')}" if progress.freezes else "not frozen"
    lines.append(f"{plan.study}: {begun} of {len(plan.participants)} have begun, {complete} have completed; the plan is {frozen}.")
    return lines


def judged_otherwise(study, progress):
    """A sentence for each trial, but practice, that the plan's exclusions judge otherwise than those when it ended."""
    lines = []
    for person, attempt in ((person, one) for person in progress.kept if not person.excluded for one in person.attempts if kind_of(one).drop_out):
        name = f"{person.name}/{attempt.trial}"
        reason = study.plan.reason_against([study.summary(person.name, attempt, leg, strict=False) for leg in attempt.legs])
        if attempt.counts and reason:
            lines.append(f"{name} counts, and by the plan of now it does not: ./navvi study exclude {study.plan.file} {name} --reason \"{reason}\"")
        elif attempt.excluded_by == "rule" and attempt.result in WHOLE and not reason:
            lines.append(f"{name} does not count, and by the plan of now it would: {attempt.excluded}.")
    return lines


def losses(progress):
    """A sentence for each loss of rows that was accepted."""
    return [f"The journal lost rows, accepted on {row['utc'][:10]} for the reason \"{row['reason']}\": {', '.join(row['lost'])}."
            for row in progress.losses]


def counted(number, noun):
    return f"{number} {noun}{'' if number == 1 else 's'}"
