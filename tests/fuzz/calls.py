"""Calls of the public entries with one or two arguments replaced by hostile values."""

from functools import cache

import numpy as np
from entries import entries
from hostile import carries_nan, hostile
from outcome import holds_nan, judged

#: Entries whose call takes long: the fraction of the others' cases that they get.
SLOW = {
    "control.integrate_network": 0.03,
    "arms.load_arm": 0.3,
    "control.simulate_primal_dual": 0.3,
}


#: Calls in which NaN has a meaning: a robot without a path, or what follows from it.
MEANT = ("welding.Separation.", "welding.Placement.", "welding.Objective.", "welding.inverse")


@cache
def known():
    """The entries by name."""
    return {one.name: one for one in entries()}


@cache
def usual(name):
    """Whether the answer to the valid arguments holds NaN, which then means something."""
    entry = known()[name]
    if name.startswith(MEANT) or name.endswith((".from_dh", ".mirrored")):
        return True
    return holds_nan(entry.function(**entry.arguments()))


def call(name, seed):
    """Judge one call: outcome, defect and what was replaced."""
    entry, rng = known()[name], np.random.default_rng([seed, *name.encode()])
    arguments = entry.arguments()
    names = list(arguments)
    count = 1 if rng.random() < 0.8 else 2
    for parameter in rng.choice(names, size=min(count, len(names)), replace=False):
        arguments[parameter] = hostile(arguments[parameter], rng)
        spoilt = parameter
    allowed = usual(name)
    kind, what = judged(
        lambda: entry.function(**arguments), carries_nan(arguments), nan_allowed=allowed
    )
    return kind, what, f"{spoilt}={_short(arguments[spoilt])}"


def _short(value):
    try:
        text = " ".join(repr(value).split())
    except Exception:
        text = type(value).__name__
    return text[:70]
