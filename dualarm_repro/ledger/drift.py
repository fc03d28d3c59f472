"""Where two outcomes of the same computation differ."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from .comparison import Comparison, is_number
from .printed import leaves

#: Bits are not promised across processors; six digits are.
RELATIVE = 1e-6
ABSOLUTE = 1e-9


def differences(expected: Any, found: Any, declared: Sequence[Comparison] = ()) -> list[str]:
    """Where two outcomes differ: numbers beyond 1e-6 relative, anything else at all.

    Parameters
    ----------
    declared
        Values below ``obtained`` that are compared in another way: with a bound, or with a
        tolerance that has a reason.
    """
    left, right = dict(leaves(expected)), dict(leaves(found))
    lines = []
    for path in sorted(left.keys() | right.keys(), key=str):
        a, b = left.get(path, "absent"), right.get(path, "absent")
        covering = [way for way in declared if path[:1] == ("obtained",) and way.covers(path[1:])]
        if not _same(a, b) and not any(way.same(a, b) for way in covering):
            line = f"{'.'.join(map(str, path))}: reference {a!r}, found {b!r}"
            lines.append("; ".join([line, *(f"compared {way.how}" for way in covering)]))
    return lines


def _same(a: Any, b: Any) -> bool:
    if is_number(a) and is_number(b) and (isinstance(a, float) or isinstance(b, float)):
        return math.isclose(a, b, rel_tol=RELATIVE, abs_tol=ABSOLUTE)
    return type(a) is type(b) and a == b
