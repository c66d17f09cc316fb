"""What each participant does, in order: a pure function of the plan."""
from dataclasses import dataclass

from .design import allotted, drawn, set_of, williams

# What a step is, and the column `phase` of its trial.
KINDS = ("consent", "calibrate", "practice", "trial", "probe", "questionnaire", "break", "session_end")


@dataclass(frozen=True)
class Step:
    name: str  # unique for the participant: s1-c2-trial-1
    kind: str
    session: int
    condition: str = "n/a"
    order: int = 0  # place of the condition, from 1; 0 where there is none
    repeat: int = 0  # of the trial in the condition, from 1
    world: object = None  # a World, of a trial
    asks: object = None  # a Questionnaire
    minutes: float = 0.0
    limit: float = None  # s, after which a probe stops its trial; that of the plan where there is none

    def __str__(self):
        words = {"consent": "consent", "calibrate": "calibration", "practice": "practice", "session_end": f"the end of session {self.session}",
                 "trial": f"trial {self.repeat} in {self.condition}", "probe": f"a probe in {self.condition}",
                 "break": f"a break of {self.minutes:g} min"}
        return words.get(self.kind) or f"the questionnaire {self.asks.name}"


def order_of(plan, participant):
    """The conditions of the participant in their order, and the set of worlds of each."""
    group = plan.group_of(participant)
    index, orders = group.participants.index(participant), orders_of(plan, group)
    if plan.order == "drawn" and plan.seed:
        index = allotted(plan.seed, group.name, index, len(orders))
    return [(group.conditions[at], plan.sets[set_of(index, at, len(plan.sets), len(orders))]) for at in orders[index % len(orders)]]


def orders_of(plan, group):
    size = len(group.conditions)
    return [list(range(size))] if plan.order == "listed" else williams(size)


def steps_of(plan, participant):
    """All that the participant does."""
    conditions = order_of(plan, participant)
    shares = [len(conditions) * session // plan.sessions for session in range(plan.sessions + 1)]
    steps, before = [], plan.practice.before if plan.practice else None
    for session in range(1, plan.sessions + 1):
        def add(name, kind, session=session, **more):
            steps.append(Step(f"s{session}-{name}", kind, session, minutes=more.pop("minutes", _minutes(plan, kind)), **more))
        if plan.consent:
            add("consent", "consent", asks=plan.consent)
        for asks in plan.at_begin if session == 1 else ():
            add(asks.name, "questionnaire", asks=asks)
        if plan.calibrate and session == 1:
            add("calibrate", "calibrate")
        if before == "session" or (before == "study" and session == 1):
            add("practice", "practice", condition=conditions[shares[session - 1]][0])
        for order in range(shares[session - 1] + 1, shares[session] + 1):
            condition, worlds = conditions[order - 1]
            given = {"condition": condition, "order": order}
            if before == "condition":
                add(f"c{order}-practice", "practice", **given)
            for repeat, world in enumerate(worlds, 1):
                add(f"c{order}-trial-{repeat}", "trial", repeat=repeat, world=world, **given)
            if plan.probes:
                add(f"c{order}-probe", "probe", repeat=1, world=plan.probes.worlds[order - 1], asks=plan.probes.asks,
                    limit=_stop(plan.probes, participant, order), **given)
            for asks in plan.after_condition:
                add(f"c{order}-{asks.name}", "questionnaire", asks=asks, **given)
            if plan.pause and order < shares[session] and (order - shares[session - 1]) % plan.pause.after == 0:
                add(f"c{order}-break", "break", minutes=plan.pause.minutes)
        if session == plan.sessions:
            for asks in plan.at_end:
                add(asks.name, "questionnaire", asks=asks)
        add("end", "session_end", minutes=0.0)
    return steps


def _minutes(plan, kind):
    """A guess for the schedule; a trial by half of its limit where the plan says nothing."""
    given = plan.minutes.get(kind)
    if given is not None:
        return given
    trial = plan.minutes["trial"] if plan.minutes.get("trial") is not None else plan.limit / 120
    probe = plan.probes.latest / 60 + 0.3 * len(plan.probes.asks.items) if plan.probes else 0
    return {"trial": trial, "practice": trial * (plan.practice.in_a_row if plan.practice else 0), "probe": probe}.get(kind, 0.0)


def _stop(probes, participant, order):
    """Whole seconds, drawn for the participant and the place of the condition, so that nobody can tell when it comes."""
    return float(round(drawn(participant, "probe", order).uniform(probes.earliest, probes.latest)))


def minutes_of(plan, participant):
    """By session."""
    steps = steps_of(plan, participant)
    between = plan.minutes["between"]
    return [sum(step.minutes + (between if step.kind in ("trial", "practice", "probe") else 0.0) for step in steps if step.session == session)
            for session in range(1, plan.sessions + 1)]
