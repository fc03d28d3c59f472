"""The rules that judged an item, each as one sentence: what it looks at, what it found, what was
needed."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from .badge import percent
from .numbers import beside, number, words

#: What a rule came to, as a sign that needs no colour.
SIGN = {"holds": "✓", "fails": "✗", "open": "?"}
_UNIT = re.compile(r"\s*\[([A-Za-z][\w^/ ]*)\]")
_READS_ON = re.compile(r"\b(by|to|at most|at least|against|differ by)$")
_LIMIT = re.compile(r"(at most|at least) (\S+)$")
_POPULATION = re.compile(r"(at least|at most) (\S+) of the population; fails (below|above) (\S+),")
_INTERVAL = re.compile(r"interval above (\S+); fails below")
_PRINTED = re.compile(r"printed (.+?)(?: within (\S+) \((.+)\))?$")
#: A value this small beside a bound this small is zero in the arithmetic of the computation.
_SMALL, _BOUND = 1e-9, 1e-5


def rule_sentence(check: Mapping[str, Any]) -> str:
    """A check of a record as a sentence."""
    label, unit = split_unit(check["label"])
    found, expected = check["obtained"], str(check["expected"])
    if expected.endswith(": no original in the source at hand"):
        return _ended(f"There is no original to compare with: {label}")
    if isinstance(found, bool):
        answer = words(found)
        if check["role"] == "contradicts" and check["outcome"] == "holds":
            return f"{_upper(label)}: {answer}, by which print contradicts itself."
        needed = words(expected == "True")
        return f"{_upper(label)}: {answer}" + ("." if answer == needed else f", not {needed}.")
    value = _value(check, unit)
    text = f"{_upper(label)} {value}" if _READS_ON.search(label) else f"{_upper(label)}: {value}"
    return _ended(text + _needed(expected, found, unit))


def finding(check: Mapping[str, Any]) -> str:
    """The same without what was needed, for the line at the head of a card."""
    label, unit = split_unit(check["label"])
    if str(check["expected"]).endswith(": no original in the source at hand"):
        return label
    value = _value(check, unit)
    if value.endswith(")") and value.startswith("zero"):
        value = value.partition(" (")[0]
    return f"{label} {value}" if _READS_ON.search(label) else f"{label}: {value}"


def split_unit(label: str) -> tuple[str, str]:
    """The label of a rule without the unit in brackets, and that unit."""
    found = _UNIT.search(label)
    if not found:
        return label, ""
    return (label[: found.start()] + label[found.end() :]).rstrip(","), found[1]


def compared_with_print(check: Mapping[str, Any]) -> bool:
    """Whether a rule compares with printed digits."""
    return str(check["expected"]).startswith("printed ")


def _value(check: Mapping[str, Any], unit: str) -> str:
    found, expected = check["obtained"], str(check["expected"])
    if isinstance(found, float) and (match := _PRINTED.match(expected)):
        return f"{beside(found, match[1])} {unit}".rstrip()
    limit = _LIMIT.match(expected)
    if isinstance(found, float) and limit and limit[1] == "at most":
        if abs(found) <= _SMALL and 0 < float(limit[2]) <= _BOUND:
            return "zero" if found == 0 else f"zero up to round-off ({words(found, unit)})"
    if isinstance(found, int) and not isinstance(found, bool) and found == 0 and limit:
        return "none"
    return words(found, unit)


def _needed(expected: str, found: Any, unit: str) -> str:
    after = f" {unit}" if unit else ""
    if match := _PRINTED.match(expected):
        wider = f" to within {number(float(match[2]))} ({match[3]})" if match[2] else ""
        return f"; print has {match[1]}{wider}"
    if match := _POPULATION.match(expected):
        limit, edge = percent(float(match[2])), percent(float(match[4]))
        if limit == edge:
            return f"; {match[1]} {limit} of all cases is needed, by the whole interval"
        return f"; {match[1]} {limit} of all cases is needed, and {match[3]} {edge} it fails"
    if match := _INTERVAL.match(expected):
        edge = number(float(match[1]))
        return f"; the whole interval has to lie above {edge}, and below it fails"
    if match := _LIMIT.match(expected):
        bound = float(match[2])
        if bound == 0 and match[1] == "at most":
            return "" if found == 0 else "; none is allowed" if isinstance(found, int) else (
                "; it must not exceed zero"
            )  # fmt: skip
        word = "allowed" if match[1] == "at most" else "needed"
        if isinstance(found, int) and bound.is_integer():
            return f"; {match[1]} {int(bound)} is {word}"
        return f"; {match[1]} {number(bound)}{after} is {word}"
    if match := re.match(r"between (\S+) and (\S+)$", expected):
        return f"; it has to lie between {number(float(match[1]))} and {number(float(match[2]))}"
    if expected in (str(found), words(found)) or words(found) == expected:
        return ""
    return f"; {expected} is needed"


def _upper(text: str) -> str:
    return text[:1].upper() + text[1:] if text[1:2].islower() or text[1:2] == " " else text


def _ended(text: str) -> str:
    return text if text.endswith(".") else f"{text}."
