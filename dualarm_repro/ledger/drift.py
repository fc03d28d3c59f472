"""Where two outcomes of the same computation differ."""

from __future__ import annotations

import math
from typing import Any

from .printed import leaves

#: Bits are not promised across processors; six digits are.
RELATIVE = 1e-6
ABSOLUTE = 1e-9


def differences(expected: Any, found: Any) -> list[str]:
    """Where two outcomes differ: numbers beyond 1e-6 relative, anything else at all."""
    left, right = dict(leaves(expected)), dict(leaves(found))
    lines = []
    for path in sorted(left.keys() | right.keys(), key=str):
        a, b = left.get(path, "absent"), right.get(path, "absent")
        if not _same(a, b):
            lines.append(f"{'.'.join(map(str, path))}: reference {a!r}, found {b!r}")
    return lines


def _same(a: Any, b: Any) -> bool:
    numbers = all(isinstance(x, int | float) and not isinstance(x, bool) for x in (a, b))
    if numbers and (isinstance(a, float) or isinstance(b, float)):
        return math.isclose(a, b, rel_tol=RELATIVE, abs_tol=ABSOLUTE)
    return type(a) is type(b) and a == b
