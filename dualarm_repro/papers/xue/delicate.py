"""Columns of the studies of `xue` that hang on the last digits of a descent.

A descent that runs along a crease of the potential, or halts on one, amplifies round-off: another
processor may end such a run elsewhere. In 128 arrangements computed twice, with other machine code,
two differed: a gradient by 2e-6 of itself, a path by 1.5e-6 and a distance by 7e-6 m.
"""

from __future__ import annotations

from ...ledger.comparison import Comparison

_REASON = "a descent along a crease amplifies round-off"
_COUNTS = ("missed", "trapped", "stationary", "held", "used", "rescued")

DESCENTS = (
    Comparison("*_gradient", _REASON, absolute=0.05),
    Comparison("*_steps_*", _REASON, relative=0.05),
    Comparison("*_length", _REASON, relative=1e-3),
    Comparison("*_path", _REASON, relative=1e-3),
    Comparison("cores_*", _REASON, absolute=1e-3),
    Comparison("flanges_apart", _REASON, absolute=1e-3),
    Comparison("slave_*", _REASON, absolute=1e-3),
    *(Comparison(f"*_{name}", "one run may end on the other side", absolute=1) for name in _COUNTS),
)
MINIMA = tuple(
    Comparison(name, "one descent may end on the other side", absolute=1)
    for name in ("minima", "elsewhere")
)
