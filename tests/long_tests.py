"""Long tests, and the short ones that try the same."""

from collections import defaultdict

import pytest

#: Name of each collected test with the words of its mark ``long``, None if it has none.
COLLECTED = pytest.StashKey[list[tuple[str, dict[str, str] | None]]]()


def long_where(dear, values):
    """Parameters of a test, or tuples of several; those that are dear are tried in the long form
    only."""
    return [
        pytest.param(
            *(one if isinstance(one, tuple) else (one,)),
            marks=[pytest.mark.long] if dear(one) else [],
        )
        for one in values
    ]


def without_short_form(collected):
    """Long tests that nothing short stands for.

    A parameter of a test may be long where others are not. Else the mark names the test of the same
    file that tries it in short, ``long(short="test_name")``, or says why none can,
    ``long(reason="...")``.
    """
    tests = defaultdict(list)
    for name, mark in collected:
        tests[name.partition("[")[0]].append(mark)
    brief = {name for name, marks in tests.items() if None in marks}
    missing = set()
    for name, marks in tests.items():
        for mark in marks:
            if mark is None or name in brief or mark.get("reason"):
                continue
            beside = f"{name.partition('::')[0]}::{mark.get('short')}"
            if beside not in brief:
                missing.add(name)
    return sorted(missing)
