"""Settings of every method, made with hostile values of their fields."""

from functools import cache

import numpy as np
from hostile import NOTHINGS, NUMBERS, WORDS, carries_nan
from outcome import judged
from valid import made

from dualarm_repro import control, planning
from dualarm_repro.settings import Settings


@cache
def known():
    """Every class of settings there is, by name; those of a document's ledger excepted."""
    found, waiting = {}, [Settings]
    while waiting:
        for one in waiting.pop().__subclasses__():
            waiting.append(one)
            found[one.__name__] = one
    return dict(sorted(found.items()))


@cache
def _examples():
    """Settings that are valid, by class."""
    chosen = made("settings")
    found = [chosen, *(part for _, part in chosen if isinstance(part, Settings))]
    found += [control.ControllerSettings(), control.NetworkSettings(), planning.PlannerSettings()]
    return {type(one).__name__: one for one in found}


def call(name, seed):
    """Judge settings with one or two fields replaced."""
    kind, rng = known()[name], np.random.default_rng([seed, *name.encode()])
    fields = list(kind.model_fields) or ["nope"]
    values = dict(_examples()[name]) if name in _examples() else {}
    if rng.random() < 0.1:
        fields = [*fields, "nope"]
    for field in rng.choice(fields, size=min(1 + int(rng.random() < 0.3), len(fields))):
        pool = (NOTHINGS, NUMBERS, NUMBERS, WORDS)[rng.integers(4)]
        values[str(field)] = pool[rng.integers(len(pool))]
    return (*judged(lambda: kind(**values), carries_nan(values)), repr(values)[:200])
