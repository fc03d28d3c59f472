"""An item at other values of its assumptions than those declared: computed, compared, not kept."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from difflib import get_close_matches
from math import isfinite
from typing import Any
from warnings import catch_warnings, simplefilter

from ..errors import DualArmError, InputError
from .evaluation import Evaluation, evaluate
from .files import through_json
from .record import record
from .registry import Registry
from .rules import Evidence
from .schema import Assumption

#: Source that the errors name.
_SOURCE = "run"
_OPTION = "--set"
#: Where a record speaks of all declared choices, one at other values says nothing.
_OF_ALL_CHOICES: dict[str, Any] = {
    "decided_by": None, "witnesses": [], "search": None, "seek": None, "robustness": None,
    "draws": "none",
}  # fmt: skip


def read_changes(registry: Registry, item_id: str, settings: Sequence[str]) -> dict[str, Any]:
    """Values by assumption from texts ``assumption=value``, each of the kind that it declares.

    Raises
    ------
    InputError
        A text without ``=``, a name twice, an assumption that the item does not rest on, or a value
        that is of another kind than the declared one.
    """
    item, found = registry.item(item_id), {}
    known = (*item.assumptions, *item.context)
    for text in settings:
        name, sign, value = (part.strip() for part in text.partition("="))
        if not (name and sign and value):
            raise InputError(_SOURCE, _OPTION, text, "assumption=value")
        if name in found:
            raise InputError(_SOURCE, _OPTION, text, f"{name} once")
        if name not in known:
            near = get_close_matches(name, known, n=3, cutoff=0.4) or known[:3]
            such = f" such as {', '.join(near)}" if near else "; it has none"
            expected = f"an assumption of {item_id}{such} (see `dualarm show {item_id}`)"
            raise InputError(_SOURCE, _OPTION, text, expected)
        entry = registry.paper_of(item_id).assumptions[name]
        found[name] = read_value(entry, name, value)
    return found


def setting(name: str, value: Any) -> str:
    """``assumption=value`` as :func:`read_changes` reads it back."""
    return f"{name}={typed(value)}"


def typed(value: Any) -> str:
    """A value as somebody types it: a word as it is, anything else as JSON with all its digits."""
    return value if isinstance(value, str) else json.dumps(value, ensure_ascii=False)


def flipping(made: Mapping[str, Any]) -> str | None:
    """The setting that alone flips the outcome of a record; None without one of a single value."""
    flip = (made["robustness"] or {}).get("flip")
    if flip is None or isinstance(flip["value"], list | dict):
        return None
    return setting(flip["assumption"], flip["value"])


def read_value(entry: Assumption, name: str, text: str) -> Any:
    """A value of the kind that an assumption declares, from a text.

    A number may leave the plausible range, since that is a question, too; a word has to be one of
    the choices, since the computation knows no other.

    Raises
    ------
    InputError
        It is of another kind.
    """
    value = _parsed(text)
    if isinstance(entry.value, str):
        choices = entry.choices or [entry.value]
        if text in choices:
            return text
        raise InputError(_SOURCE, f"{_OPTION} {name}", text, f"one of {_listed(choices)}")
    whole = entry.range is None
    if not _alike(value, entry.value, whole):
        expected = _kind(entry.value, whole) + f" such as {json.dumps(entry.value)}"
        raise InputError(_SOURCE, f"{_OPTION} {name}", value, expected)
    return value


def evaluate_changed(
    registry: Registry, item_id: str, changes: Mapping[str, Any]
) -> tuple[dict[str, Any], Evaluation]:
    """The record of an item as it would be at other values, and the evaluation behind it.

    Beside the keys of a record it has ``changed``, the values with those of the ledger, and
    ``nominal``, what is obtained there. The verdict is that at these values alone. Nothing of it is
    kept.

    Raises
    ------
    InputError
        The computation refuses the values, or the item is not computed at all.
    """
    before = record(registry, item_id)
    if registry.checker(item_id) is None:
        raise InputError(
            _SOURCE, "item id", item_id, f"an item that is computed ({before['pending']})"
        )
    try:
        with catch_warnings():  # of values far off; what becomes of them is judged or refused
            simplefilter("ignore", RuntimeWarning)
            evaluation = evaluate(registry, item_id, changes)
            checks = evaluation.checks()
    except DualArmError:
        raise
    except Exception as error:  # a value of the right kind may still be one the method cannot take
        given = ", ".join(f"{name}={value}" for name, value in changes.items())
        expected = f"values that {item_id} can be computed with ({type(error).__name__}: {error})"
        raise InputError(_SOURCE, _OPTION, given, expected) from error
    entries, result = registry.paper_of(item_id).assumptions, evaluation.result
    made = {
        **before,
        **_OF_ALL_CHOICES,
        "changed": [_change(name, value, entries[name]) for name, value in changes.items()],
        "nominal": {
            "verdict": str(evaluation.verdict_on(_evidence(evaluation, before))),
            "checks": before["checks"],
            "obtained": before["obtained"],
        },
        "verdict": str(evaluation.verdict),
        "checks": checks,
        "obtained": result.obtained if result else None,
        "measured": result.measured if result else None,
        "caption": result.told() if result else None,
        "alt": result.alt if result else None,
    }
    for kind in ("assumptions", "context"):
        made[kind] = [
            {**entry, "value": changes.get(entry["id"], entry["value"])} for entry in before[kind]
        ]
    return through_json(made), evaluation


def _evidence(evaluation: Evaluation, before: Mapping[str, Any]) -> Evidence:
    now = evaluation.evidence
    return Evidence(before["obtained"], now.printed, now.thresholds)


def _change(name: str, value: Any, entry: Assumption) -> dict[str, Any]:
    return {
        "assumption": name,
        "statement": entry.statement,
        "value": value,
        "nominal": entry.value,
        "unit": entry.unit,
        "range": list(entry.range) if entry.range else None,
        "choices": entry.choices,
        "plausible": _plausible(value, entry),
    }


def _plausible(value: Any, entry: Assumption) -> bool:
    if entry.range is not None:
        return bool(entry.range[0] <= value <= entry.range[1])
    return value in (entry.choices or [entry.value])


def _parsed(text: str) -> Any:
    try:
        return json.loads(text)
    except (ValueError, RecursionError):
        return text


def _alike(value: Any, model: Any, whole: bool) -> bool:
    """Whether a value has the kind of another one: number, text, list of as many, same keys."""
    if isinstance(model, bool) or isinstance(value, bool):
        return isinstance(model, bool) and isinstance(value, bool)
    if isinstance(model, int | float):
        number = isinstance(value, int | float) and _finite(value)
        return number and not (whole and isinstance(model, int) and not isinstance(value, int))
    if isinstance(model, list):
        same = isinstance(value, list) and len(value) == len(model)
        return same and all(_alike(a, b, False) for a, b in zip(value, model, strict=True))
    if isinstance(model, dict):
        same = isinstance(value, dict) and value.keys() == model.keys()
        return same and all(_alike(value[key], model[key], False) for key in model)
    return type(value) is type(model)


def _finite(value: float) -> bool:
    try:
        return isfinite(value)
    except OverflowError:
        return False


def _kind(model: Any, whole: bool) -> str:
    if isinstance(model, bool):
        return "true or false"
    if isinstance(model, int | float):
        return "a whole number" if whole and isinstance(model, int) else "a finite number"
    if isinstance(model, list):
        return f"a list of {len(model)}"
    return f"a mapping of {', '.join(model)}" if isinstance(model, dict) else "a text"


def _listed(choices: Sequence[Any]) -> str:
    return ", ".join(map(str, choices))
