"""How firmly a verdict holds when the assumptions are not what we took them to be.

Every item that rests on assumptions has a stored study. Its cells are draws of all assumptions over
their plausible values; changes of one assumption at a time, with the smallest one that flips the
verdict; and, where the item asks for it, climbs towards a choice under which print is met.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from ..errors import InputError
from .comparison import Comparison, comparisons
from .drift import differences
from .evaluation import Evaluation, evaluate
from .files import through_json, to_json
from .printed import replaced
from .registry import Registry
from .rules import Role
from .schema import Assumption, Item
from .study import Study

SEED = 20200344
#: In place of a verdict where the computation refuses the values drawn.
NOT_COMPUTABLE = "not-computable"
#: Steps from the nominal value to each end of a range before bisection.
_SCAN = 2
_BISECTIONS = 6
#: Other draws at which a change of one assumption is tried if it moves nothing at the nominal ones.
_BASES = 6
#: Relative change by which a number without a declared range is probed.
_PROBE = 0.01
#: Relative change of all drawn numbers that no well-conditioned outcome notices.
_NUDGE = 1e-10
#: Relative difference of two misses that is none: round-off must not choose the way of a climb.
_TIE = 1e-9


def study_of(registry: Registry, item_id: str, samples: int | None = None) -> Study | None:
    """The stored study of an item; None for an item that rests on no assumption.

    Parameters
    ----------
    samples
        Draws, if not the number that the checker asks for.

    Raises
    ------
    InputError
        ``samples`` is not positive.
    """
    if samples is not None and samples < 1:
        raise InputError("robustness", "samples", samples, "a positive number")
    item, checker = registry.look(item_id), registry.checker(item_id)
    if checker is None or not item.assumptions:
        return None
    entries = {key: registry.paper_of(item_id).assumptions[key] for key in item.assumptions}
    draws = samples or checker.samples
    return Study(
        name=f"robustness/{item_id}",
        title=f"How firmly the verdict on {item_id} holds",
        cells=partial(_cells, item, entries, draws),
        compute=partial(_cell, item_id, registry.reopen),
        seed=SEED,
        settings={
            "draws": draws,
            "search": item.search.model_dump() if item.search else None,
            "assumptions": {
                key: {"value": a.value, "range": a.range, "choices": a.choices}
                for key, a in entries.items()
            },
        },
        nested=("judged", "values"),
        compared=tuple(_below("judged", comparisons(item, checker.rules))),
        knife_edge="delicate",
        also=roots_of(registry, item_id),
        registry=registry,
    )


def roots_of(registry: Registry, item_id: str) -> tuple[str, ...]:
    """Modules that the verdict on an item depends on: its checker's, and those that judge."""
    from .closure import module_of

    checker = registry.checker(item_id)
    own = (module_of(checker.compute),) if checker else ()
    return (*own, *(f"dualarm_repro.ledger.{name}" for name in ("rules", "verdict", "printed")))


def varied(entries: Mapping[str, Assumption]) -> dict[str, Assumption]:
    """The assumptions for which another plausible value is declared."""
    return {key: entry for key, entry in entries.items() if entry.varies}


def judged(evaluation: Evaluation) -> dict[str, Any]:
    """What the rules look at, where they look, and the verdict."""
    evidence = evaluation.evidence
    found: dict[str, Any] = {"verdict": str(evaluation.verdict)}
    for rule in evaluation.rules:
        found = replaced(found, tuple(rule.key.split(".")), rule.found(evidence))
    return through_json(found)


def miss(evaluation: Evaluation) -> float:
    """How far the item is from meeting print: the largest miss of a rule, 0 where all hold."""
    evidence = evaluation.evidence
    return max(
        (
            rule.miss(evidence)
            for rule in evaluation.rules
            if rule.role in (Role.SUPPORTS, Role.ADOPTS)
        ),
        default=0.0,
    )


def _cells(item: Item, entries: Mapping[str, Assumption], draws: int) -> list[dict[str, Any]]:
    from scipy.stats import qmc

    choice = varied(entries)
    cells: list[dict[str, Any]] = []
    if choice:
        engine = qmc.Sobol(len(choice), scramble=True, rng=np.random.default_rng(SEED))
        points = engine.random_base2(max(0, (draws - 1).bit_length()))[:draws]
        cells += [{"kind": "draw", "assumption": "", "at": point.tolist()} for point in points]
    cells += [{"kind": "change", "assumption": key, "at": []} for key in entries]
    if item.search and choice:
        cells += [
            {"kind": "search", "assumption": "", "at": [k]} for k in range(item.search.starts)
        ]
    return cells


def _cell(
    item_id: str,
    reopen: Callable[[], Registry],
    settings: Mapping[str, Any],
    rng: np.random.Generator,
) -> dict[str, Any]:
    registry = reopen()
    item = registry.look(item_id)
    entries = {key: registry.paper_of(item_id).assumptions[key] for key in item.assumptions}
    at = partial(_outcome, registry, item_id)
    checker = registry.checker(item_id)
    declared = comparisons(item, checker.rules if checker else ())
    row: dict[str, Any] = dict.fromkeys(
        ("verdict", "met", "miss", "judged", "values", "error", "delicate", "moves", "change",
         "evaluations")
    )  # fmt: skip
    if settings["kind"] == "draw":
        choice = varied(entries)
        values = {k: a.at(u) for (k, a), u in zip(choice.items(), settings["at"], strict=True)}
        found = at(values)
        delicate = _moved(found, at(_nudged(values, choice)), declared)
        return row | found | {"values": to_json(values, indent=None), "delicate": delicate}
    if settings["kind"] == "search" and item.search:
        return row | _climb(at, varied(entries), item.search.evaluations, rng)
    return row | _change(at, settings["assumption"], entries, declared, rng)


def _outcome(registry: Registry, item_id: str, values: Mapping[str, Any]) -> dict[str, Any]:
    try:
        evaluation = evaluate(registry, item_id, values)
    except InputError as error:
        refused = {"verdict": NOT_COMPUTABLE, "met": False, "miss": None, "judged": "{}"}
        return refused | {"error": str(error)}
    missed = miss(evaluation)
    return {
        "verdict": str(evaluation.verdict),
        "met": evaluation.verdict.meets_print,
        "miss": missed if np.isfinite(missed) else None,
        "judged": to_json(judged(evaluation), indent=None),
    }


def _change(
    at: Callable[[Mapping[str, Any]], dict[str, Any]],
    key: str,
    entries: Mapping[str, Assumption],
    declared: list[Comparison],
    rng: np.random.Generator,
) -> dict[str, Any]:
    """What a change of one assumption does: whether anything judged moves, and the flip."""
    assumption, nominal = entries[key], at({})
    found: dict[str, Any] = {"moves": "nothing"}
    if assumption.varies:
        found |= _flip(at, key, assumption, nominal)
    bases = [{}, *({k: a.at(rng.random()) for k, a in varied(entries).items()}
                   for _ in range(_BASES))]  # fmt: skip
    for number, base in enumerate(bases):
        before = at(base) if base else nominal
        for value in _others(assumption, base.get(key, assumption.value)):
            if _moved(before, at({**base, key: value}), declared):
                return found | {"moves": f"draw {number}" if number else "the nominal values"}
    return found


def _others(assumption: Assumption, now: Any) -> list[Any]:
    """Other values to try: ends and quarters of a range, choices, or numbers slightly changed."""
    if assumption.range is not None:
        return [assumption.at(share) for share in (0.0, 1.0, 0.25, 0.75)]
    if assumption.choices is not None:
        return [choice for choice in assumption.choices or () if choice != now]
    probed = _probed(assumption.value)
    return [] if probed == assumption.value else [probed]


def _probed(value: Any) -> Any:
    """The same value with every number in it changed by one per cent (a zero by 0.01)."""
    if isinstance(value, dict):
        return {key: _probed(part) for key, part in value.items()}
    if isinstance(value, list):
        return [_probed(part) for part in value]
    if isinstance(value, bool) or not isinstance(value, int | float):
        return value
    return value * (1.0 + _PROBE) if value else _PROBE


def _moved(before: Mapping[str, Any], after: Mapping[str, Any], declared: list[Comparison]) -> bool:
    """Whether anything that is judged differs; a residual does not while it keeps its bound."""
    left, right = ({"obtained": json.loads(one["judged"])} for one in (before, after))
    return bool(differences(left, right, declared))


def _nudged(values: Mapping[str, Any], choice: Mapping[str, Assumption]) -> dict[str, Any]:
    """The same values, each number changed by next to nothing towards the middle of its range."""
    found = dict(values)
    for key, assumption in choice.items():
        if assumption.range is not None:
            low, high = assumption.range
            found[key] += np.sign(low + high - 2 * found[key]) * _NUDGE * (high - low)
            found[key] = float(found[key])
    return found


def _below(column: str, declared: list[Comparison]) -> list[Comparison]:
    return [replace(way, path=f"{column}.{way.path}") for way in declared]


def _flip(
    at: Callable[[Mapping[str, Any]], dict[str, Any]],
    key: str,
    assumption: Assumption,
    nominal: Mapping[str, Any],
) -> dict[str, Any]:
    """The smallest change of one assumption, all others kept, that changes the verdict.

    ``change`` is the distance from the nominal value as a share of the range, 1 for a choice.
    """

    def kept(value: Any) -> bool:
        return bool(at({key: value})["verdict"] == nominal["verdict"])

    found: list[tuple[float, Any]] = []
    if assumption.range is None:
        others = [choice for choice in assumption.choices or () if choice != assumption.value]
        found = [(1.0, choice) for choice in others if not kept(choice)][:1]
    else:
        nominal_share = assumption.share_of(assumption.value)
        for end in (0.0, 1.0):
            inside = nominal_share
            for share in np.linspace(inside, end, _SCAN + 1)[1:] if end != inside else ():
                if not kept(assumption.at(share)):
                    lost = _bisect(lambda s: kept(assumption.at(s)), inside, float(share))
                    found.append((abs(lost - nominal_share), assumption.at(lost)))
                    break
                inside = float(share)
    if not found:
        return {}
    change, value = min(found, key=lambda flip: flip[0])
    return at({key: value}) | {"change": change, "values": to_json({key: value}, indent=None)}


def _bisect(kept: Callable[[Any], bool], inside: float, outside: float) -> float:
    for _ in range(_BISECTIONS):
        middle = 0.5 * (inside + outside)
        if kept(middle):
            inside = middle
        else:
            outside = middle
    return outside


def _climb(
    at: Callable[[Mapping[str, Any]], dict[str, Any]],
    choice: Mapping[str, Assumption],
    evaluations: int,
    rng: np.random.Generator,
) -> dict[str, Any]:
    """A random start, then changes of some assumptions that shrink as they stop to help."""
    shares = rng.random(len(choice))
    names, width, count = list(choice), 0.5, 0
    best: dict[str, Any] | None = None
    while count < evaluations:
        trial = shares.copy()
        if best is not None:
            moved = rng.random(len(trial)) < max(0.3, 1.0 / len(trial))
            moved[rng.integers(len(trial))] = True
            trial[moved] = np.mod(trial[moved] + width * rng.normal(size=moved.sum()), 1.0)
        values = {k: choice[k].at(min(u, 1.0 - 1e-12)) for k, u in zip(names, trial, strict=True)}
        found, count = at(values), count + 1
        if best is not None and _order(found) > _order(best):
            width = max(0.9 * width, 0.01)
            continue
        best, shares = found | {"values": to_json(values, indent=None)}, trial
        if best["met"]:
            break
    return (best or {}) | {"evaluations": count}


def _order(found: Mapping[str, Any]) -> float:
    return np.inf if found["miss"] is None else found["miss"]
