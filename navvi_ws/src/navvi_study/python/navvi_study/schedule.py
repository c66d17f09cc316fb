"""What each participant does, in order: a pure function of the plan."""
import itertools

from .design import allotted, set_of, williams
from .steps import ORDER
from .steps.step import Place

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
    conditions, places = order_of(plan, participant), []
    shares = [len(conditions) * session // plan.sessions for session in range(plan.sessions + 1)]
    for session, (first, last) in enumerate(itertools.pairwise(shares), 1):
        where = plan, participant, session, tuple(name for name, _ in conditions[first:last])
        places += [Place(*where, "begin"), *[Place(*where, "condition", *conditions[order - 1], order) for order in range(first + 1, last + 1)], Place(*where, "end")]
    return [step for place in places for kind in ORDER[place.at] for step in kind.planned(place)]


def minutes_of(plan, participant):
    """By session."""
    steps, between = steps_of(plan, participant), plan.minutes["between"]
    return [sum(step.minutes + (between if step.drives else 0.0) for step in steps if step.session == session) for session in range(1, plan.sessions + 1)]
