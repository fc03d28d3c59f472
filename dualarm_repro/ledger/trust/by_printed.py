"""Change what is printed: a formula to nonsense, a cell of a matrix, a digit that a rule judges."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ...errors import InputError
from ...tracking import touches
from ..drift import differences
from ..evaluation import Evaluation, evaluate
from ..printed import at, leaves, replaced
from ..registry import Registry
from ..robustness import judged
from ..rules import Outcome, Role, Rounds, Rule
from ..verdict import Verdict
from .counts import Tally
from .nonsense import agreeing, cells, formulas, moved, nonsense, other_cell, other_digit

_CONTRARY = (Verdict.INCONSISTENT, Verdict.NOT_REPRODUCED, Verdict.UNDECIDABLE)


def printed(registry: Registry, item_id: str) -> Tally:
    """Change the print of an item, one place at a time.

    A formula that becomes nonsense, and another cell of a matrix, must change the verdict or the
    outcome of a rule; where the document is found wrong already, a judged value. A digit that a
    rule compares with must change the outcome of that rule, three tolerances where one is allowed;
    a rule that fails must hold once the print agrees with what is obtained. What is computed from
    the print of the item itself is computed again, so that no value is compared with itself.
    """
    evaluation = evaluate(registry, item_id)
    if evaluation.checker is None or evaluation.item.printed is None:
        return Tally()
    reprint = _Reprint(registry, evaluation)
    unable = [f"{item_id}: nothing judges {line}" for line in _unjudged(reprint)]
    noticed = [*_wrong_formulas(reprint), *_wrong_digits(reprint, unable)]
    return Tally.of([(f"{item_id}: {line}", seen) for line, seen in noticed], unable)


@dataclass(frozen=True)
class _Reprint:
    """An evaluated item, and how it is judged under another print."""

    registry: Registry
    before: Evaluation

    @property
    def reads(self) -> bool:
        """Whether the computation itself reads the print of the item."""
        paper, _, key = self.before.item_id.partition(".")
        part = f"papers/{paper}.yaml#items.{key}.printed"
        return any(touches(name, part) for name in self.before.inputs)

    def judged(self, value: Any) -> Evaluation:
        """The item if it printed ``value``."""
        before = self.before
        if not self.reads:
            return replace(before, item=before.item.model_copy(update={"printed": value}))
        with self.registry.with_printed(before.item_id, value):
            return evaluate(self.registry, before.item_id)


def _wrong_formulas(reprint: _Reprint) -> Iterator[tuple[str, bool]]:
    value = reprint.before.item.printed
    for path, text in formulas(value):
        for other in nonsense(text):
            yield f"formula {text!r} -> {other!r}", _noticed(reprint, replaced(value, path, other))
    for path, text in cells(value):
        other = other_cell(text)
        place = ".".join(map(str, path))
        yield f"{place} {text!r} -> {other!r}", _noticed(reprint, replaced(value, path, other))


def _noticed(reprint: _Reprint, value: Any) -> bool:
    try:
        after = reprint.judged(value)
    except (ArithmeticError, AttributeError, IndexError, KeyError, TypeError, ValueError):
        return True  # refused, as nonsense may be
    except Exception as error:
        if type(error).__module__.startswith(("dualarm_repro", "sympy")):
            return True
        raise
    before = reprint.before
    if _outcomes(after) != _outcomes(before):
        return True
    return before.verdict in _CONTRARY and bool(differences(judged(before), judged(after)))


def _outcomes(evaluation: Evaluation) -> list[str]:
    evidence = evaluation.evidence
    found = [str(rule.outcome(evidence)) for rule in evaluation.rules]
    return [str(evaluation.verdict), *found]


def _wrong_digits(reprint: _Reprint, unable: list[str]) -> Iterator[tuple[str, bool]]:
    before = reprint.before
    for rule in before.rules:
        if (to := _place(rule)) is None:
            continue
        now, stem = rule.outcome(before.evidence), tuple(to.split("."))
        if now is not Outcome.HOLDS:
            if (mended := _mended(rule, to, before)) is None:
                unable.append(f"{before.item_id}: no print agrees with {rule.label}")
            else:
                value = replaced(before.item.printed, stem, mended)
                yield f"{rule.label}: print as obtained", _answers(reprint, rule, value) is not now
            continue
        for path, text in leaves(at(before.item.printed, to)):
            if (other := _other(rule, text)) is not None:
                value = replaced(before.item.printed, (*stem, *path), other)
                seen = _answers(reprint, rule, value) is not now or _follows(reprint, rule, value)
                yield f"{rule.label}: {text} -> {other}", seen


def _answers(reprint: _Reprint, rule: Rule, value: Any) -> Outcome | None:
    try:
        return rule.outcome(reprint.judged(value).evidence)
    except (InputError, ArithmeticError, ValueError):
        return None


def _follows(reprint: _Reprint, rule: Rule, value: Any) -> bool:
    """Whether a scenario that is fed with what is printed is fed with the other print as well."""
    if rule.role is not Role.ADOPTS or not reprint.reads:
        return False
    found = rule.found(reprint.judged(value).evidence)
    return bool(differences(rule.found(reprint.before.evidence), found))


def _other(rule: Rule, text: str) -> str | None:
    other = other_digit(text)
    if other is None or not isinstance(rule, Rounds) or rule.tolerance is None:
        return other
    return moved(text, 3.0 * rule.tolerance)


def _place(rule: Rule) -> str | None:
    """Where in print a rule looks, if it does."""
    return getattr(rule, "to", None)


def _mended(rule: Rule, to: str, before: Evaluation) -> Any:
    """What would have to be printed for a rule that fails to hold."""
    found, mended = rule.found(before.evidence), at(before.item.printed, to)
    if isinstance(found, np.ndarray | np.generic):
        found = found.tolist()
    values = dict(leaves(found))
    for path, _ in leaves(mended):
        if path not in values or (text := agreeing(values[path])) is None:
            return None
        mended = replaced(mended, path, text)
    return mended


def _unjudged(reprint: _Reprint) -> list[str]:
    """Printed numbers that no rule compares with and that the computation does not read."""
    if reprint.reads:
        return []
    places = (_place(rule) for rule in reprint.before.rules)
    judged_paths = [tuple(to.split(".")) for to in places if to is not None]
    found = []
    for path, text in leaves(reprint.before.item.printed):
        names = tuple(map(str, path))
        if "matrix" in names or other_digit(text) is None:
            continue
        if not any(names[: len(stem)] == stem for stem in judged_paths):
            found.append(f"{'.'.join(names)} {text}")
    return found
