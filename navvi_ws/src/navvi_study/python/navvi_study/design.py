"""Orders and rotations, without names: rows of indices; and what is drawn by words."""
import hashlib
import random


def drawn(*words):
    """A source of numbers of its own for these words, the same on every machine."""
    return random.Random(hashlib.sha256("/".join(map(str, words)).encode()).hexdigest())


def williams(conditions):
    """Orders of 0 to conditions - 1, balanced for first-order carry-over: each condition stands at each place equally often, and right
    after each other one equally often. As many rows as conditions where these are even, twice as many where odd
    (E. J. Williams, Australian Journal of Scientific Research 2, 1949)."""
    first = [0]
    for step in range(1, conditions):
        first.append((step + 1) // 2 if step % 2 else conditions - step // 2)
    rows = [[(entry + row) % conditions for entry in first] for row in range(conditions)]
    return rows if conditions % 2 == 0 else rows + [row[::-1] for row in rows]


def allotted(seed, group, index, orders):
    """The place that is drawn for the participant: in blocks of as many participants as orders, so that each block has each order once."""
    block, within = divmod(index, orders)
    places = list(range(orders))
    drawn(seed, group, block).shuffle(places)
    return block * orders + places[within]


def set_of(participant, condition, sets, orders):
    """Which set of worlds a participant meets under a condition. By participant it goes round the Latin square, and one further with
    each round of the orders, so that no set stays tied to a place in the order.
    \\param participant  from 0, in the group"""
    return (participant + participant // orders + condition) % sets
