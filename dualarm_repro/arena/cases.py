"""All cases of the arena, from JSON-able settings."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from .benchmark_cases import benchmark_case, problems
from .case import Case
from .document_cases import DOCUMENTS, document_case
from .random_cases import GRADES, PAIRS, near_case, random_case

DOCUMENT, RANDOM, NEAR, BENCHMARK = "document", "random", "near contact", "one Panda"
KINDS = (DOCUMENT, RANDOM, NEAR, BENCHMARK)
#: Tasks of each pair and grade, tasks near contact of each pair and end, problems of each set.
RANDOM_TASKS, NEAR_TASKS, PROBLEMS = 3, 2, 1


def case_settings() -> list[dict[str, Any]]:
    """Settings of every case: ``kind``, ``group`` within it, ``subject`` and ``number``."""
    made = [_settings(DOCUMENT, name, name, 0) for name in DOCUMENTS]
    made += [
        _settings(RANDOM, grade, pair, seed)
        for grade in GRADES
        for pair in PAIRS
        for seed in range(RANDOM_TASKS)
    ]
    made += [
        _settings(NEAR, end, pair, seed)
        for end in ("start", "goal")
        for pair in PAIRS
        for seed in range(NEAR_TASKS)
    ]
    made += [
        _settings(BENCHMARK, one["set"], "panda", one["number"])
        for one in problems()
        if one["number"] <= PROBLEMS
    ]
    return made


def case_of(settings: Mapping[str, Any]) -> Case:
    """The case that settings describe."""
    group, subject, number = (settings[key] for key in ("group", "subject", "number"))
    match settings["kind"]:
        case "document":
            return document_case(subject)
        case "random":
            return random_case(subject, group, number)
        case "near contact":
            return near_case(subject, group, number)
        case _:
            return benchmark_case(group, number)


def cells(methods: tuple[str, ...]) -> list[dict[str, Any]]:
    """A cell for every case and method."""
    return [{**one, "method": name} for one in case_settings() for name in methods]


def _settings(kind: str, group: str, subject: str, number: int) -> dict[str, Any]:
    return {"kind": kind, "group": group, "subject": subject, "number": number}
