"""How firmly a verdict holds when the assumptions are not what we took them to be."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from scipy.stats import binomtest, qmc

from ..errors import InputError
from .evaluation import evaluate
from .registry import Registry
from .schema import Assumption
from .sensitivity import Flip, Robustness

SEED = 20200344
_SCAN = 8  # steps from the nominal value to each end of a range before bisection
_BISECTIONS = 12
#: In place of a verdict where the computation refuses the values drawn.
NOT_COMPUTABLE = "not-computable"


def robustness(
    registry: Registry, item_id: str, samples: int | None = None, seed: int = SEED
) -> Robustness | None:
    """Sample the assumptions of an item over their plausible values and judge it each time.

    Scrambled Sobol points over the ranges and choices of the item's assumptions; then, one
    assumption at a time, a scan outwards from the nominal value and bisection for the flip. Values
    with which nothing can be computed do not keep the verdict.

    A checker that brings a stored study gives that instead, unless ``samples`` is asked for.

    Returns None for an item that is not attempted or rests on no assumption that can vary.

    Raises
    ------
    InputError
        ``samples`` is not positive.
    """
    checker = registry.checkers.get(item_id)
    if samples is not None and samples < 1:
        raise InputError("sensitivity", "samples", samples, "a positive number")
    if checker is None:
        registry.item(item_id)
        return None
    if checker.robust is not None and samples is None:
        return checker.robust()
    count = checker.samples if samples is None else samples
    varied = {
        key: registry.paper_of(item_id).assumptions[key]
        for key in registry.item(item_id).assumptions
        if _varies(registry.paper_of(item_id).assumptions[key])
    }
    if not varied or not count:
        return None

    nominal = evaluate(registry, item_id).verdict

    def verdict(changes: Mapping[str, Any]) -> str:
        try:
            return evaluate(registry, item_id, changes).verdict
        except InputError:  # e.g. an arm out of reach
            return NOT_COMPUTABLE

    engine = qmc.Sobol(len(varied), scramble=True, rng=np.random.default_rng(seed))
    points = engine.random_base2(max(0, (count - 1).bit_length()))[:count]
    kept = sum(
        verdict({k: _value(a, u) for (k, a), u in zip(varied.items(), point, strict=True)})
        == nominal
        for point in points
    )
    interval = binomtest(kept, count).proportion_ci(method="wilson")
    flips = [
        flip for key, a in varied.items() if (flip := _smallest_flip(key, a, verdict, nominal))
    ]
    return Robustness(
        holds=kept / count,
        samples=count,
        interval=(float(interval.low), float(interval.high)),
        varied=tuple(varied),
        flip=min(flips, key=lambda flip: flip.change, default=None),
    )


def _varies(assumption: Assumption) -> bool:
    return assumption.range is not None or len(assumption.choices or []) > 1


def _value(assumption: Assumption, share: float) -> Any:
    """The plausible value at a share in [0, 1) of the range or of the choices."""
    if assumption.range is not None:
        low, high = assumption.range
        return float(low + share * (high - low))
    return assumption.choices[int(share * len(assumption.choices))]


def _smallest_flip(
    key: str, assumption: Assumption, verdict: Callable[[Mapping[str, Any]], str], nominal: str
) -> Flip | None:
    if assumption.range is None:
        for choice in assumption.choices:
            if choice != assumption.value and (found := verdict({key: choice})) != nominal:
                return Flip(key, assumption.value, choice, 1.0, str(found))
        return None
    flips = []
    for end in assumption.range:
        kept = assumption.value
        for value in np.linspace(assumption.value, end, _SCAN + 1)[1:]:
            if verdict({key: float(value)}) != nominal:
                lost = _bisect(key, kept, float(value), verdict, nominal)
                flips.append(lost)
                break
            kept = float(value)
    if not flips:
        return None
    width = assumption.range[1] - assumption.range[0]
    value = min(flips, key=lambda flip: abs(flip - assumption.value))
    change = abs(value - assumption.value) / width
    return Flip(key, assumption.value, value, change, str(verdict({key: value})))


def _bisect(
    key: str,
    kept: float,
    lost: float,
    verdict: Callable[[Mapping[str, Any]], str],
    nominal: str,
) -> float:
    """The value nearest to ``kept`` found for which the verdict is lost."""
    for _ in range(_BISECTIONS):
        middle = 0.5 * (kept + lost)
        if verdict({key: middle}) == nominal:
            kept = middle
        else:
            lost = middle
    return lost
