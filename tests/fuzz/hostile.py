"""Values that a caller could pass by mistake, made from a valid one of the same parameter."""

import datetime
import fractions
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np


class Other:
    """An object of no use."""


class Subclass(np.ndarray):
    """An array of a class of the caller's own."""


NOTHINGS = (None, Other(), Other, object(), b"x", {}, [], (), set(), "", "nan", ...)
NUMBERS = (
    *(float("nan"), float("inf"), -float("inf"), 0, -0.0, -1, -1.0, 0.5, 2, 7, 1e-320, 1e-12),
    *(1e6, 1e12, 1e30, 1e308, -1e308, 10**9, 10**15, 10**400, -(10**400), True, False, "1", "x"),
    *(1j, np.float32(0.25), np.int64(3), np.float64("nan"), np.array(1.0), np.array([1.0])),
    *(fractions.Fraction(1, 3), datetime.timedelta(1), np.datetime64("2020-01-01"), [1.0]),
)
WORDS = ("", " ", "nope", "x" * 5000, "\0", "../x", "Ünïcode", "a\nb", "nan", "1", "{}", "%s")


def hostile(value, rng):
    """A bad, odd or merely unusual value in the place of a valid one."""
    if rng.random() < 0.12:
        return _one(NOTHINGS, rng)
    if isinstance(value, np.ndarray):
        return _array(value, rng)
    if isinstance(value, bool | int | float | np.number):
        return _one(NUMBERS, rng)
    if isinstance(value, str):
        return _one(WORDS, rng) if rng.random() < 0.6 else _one(NUMBERS, rng)
    if isinstance(value, Path):
        return _path(value, rng)
    if isinstance(value, Mapping):
        return _mapping(value, rng)
    if isinstance(value, Sequence):
        return _sequence(value, rng)
    if callable(value):
        return _function(value, rng)
    return _one((*NOTHINGS, *NUMBERS[:6], value.__class__, "name", [value], (value, value)), rng)


def _one(choices, rng):
    return choices[rng.integers(len(choices))]


def _array(value, rng):
    made = np.array(value)
    numeric = made.astype(float) if made.dtype.kind in "fiub" else np.zeros(made.shape)
    match rng.integers(20):
        case 0 | 1 | 2 | 3 if made.size:
            spoilt = numeric.copy()
            spoilt.flat[rng.integers(spoilt.size)] = _one(
                (np.nan, np.inf, -np.inf, 1e308, -1e308, 1e30, 1e18, 1e9, 1e-320, -1.0, 0.0), rng
            )
            return spoilt
        case 4:
            return numeric.astype(object)
        case 5:
            return numeric.astype(str)
        case 6:
            return numeric.astype(complex)
        case 7:
            return np.full(made.shape, "2020-01-01", dtype="datetime64[D]")
        case 8:
            return made[:-1] if made.ndim and len(made) else np.array([])
        case 9:
            return made[..., :-1] if made.ndim and made.shape[-1] else made[np.newaxis]
        case 10:
            return made[np.newaxis]
        case 11:
            return np.zeros((0, *made.shape[1:]))
        case 12:
            return made.T.copy() if made.ndim > 1 else made.reshape(-1, 1)
        case 13:
            return made.tolist()
        case 14:
            kept = made.copy()
            kept.flags.writeable = False
            return kept
        case 15 if made.ndim:
            return np.repeat(made, 2, axis=0)[::2]
        case 16:
            return made.copy().view(Subclass)
        case 17:
            return numeric.astype(np.float32)
        case 18:
            return np.zeros_like(numeric)
        case _:
            return _one(
                (
                    np.ma.array(numeric),
                    numeric.astype(bool),
                    3,
                    "array",
                    [[1], [1, 2]],
                    [10**400] * max(made.size, 1),
                    np.array(None),
                    iter([1.0]),
                ),
                rng,
            )


def _path(value, rng):
    here = value.parent
    return _one(
        (
            here,
            here / "missing.yaml",
            Path("\0"),
            Path(""),
            3,
            b"x",
            str(value),
            here / ("x" * 5000),
        ),
        rng,
    )


def _mapping(value, rng):
    if not value or rng.random() < 0.3:
        return _one(([], "x", {"nope": 1}, {3: 4}, {None: None}, {}, [("a", 1)]), rng)
    key = _one(list(value), rng)
    changed = dict(value)
    match rng.integers(3):
        case 0:
            del changed[key]
        case 1:
            changed["nope"] = changed[key]
        case _:
            changed[key] = hostile(changed[key], rng)
    return changed


def _sequence(value, rng):
    kind = tuple if isinstance(value, tuple) else list
    if not len(value) or rng.random() < 0.3:
        return _one(
            (kind(), [None], ["x"], "xyz", 3, iter(value), {1: 2}, kind([*value, *value])), rng
        )
    changed = list(value)
    place = rng.integers(len(changed))
    if rng.random() < 0.25:
        del changed[place]
    else:
        changed[place] = hostile(changed[place], rng)
    return kind(changed)


def _function(value, rng):
    def raises_nothing(*_, **__):
        return None

    def gives_nan(points, *_, **__):
        return np.full(len(points) if np.ndim(points) else 1, np.nan)

    def gives_text(*_, **__):
        return "x"

    def gives_too_few(*_, **__):
        return np.zeros(0)

    def gives_infinity(points, *_, **__):
        return np.full(len(points) if np.ndim(points) else 1, np.inf)

    return _one((raises_nothing, gives_nan, gives_text, gives_too_few, gives_infinity, 3, "f"), rng)


def carries_nan(value, depth=3):
    """Whether a NaN is among the arguments."""
    if isinstance(value, float | np.floating):
        return bool(np.isnan(value))
    if isinstance(value, np.ndarray):
        return value.dtype.kind in "fc" and bool(np.isnan(value).any())
    if depth and isinstance(value, Mapping):
        return any(carries_nan(one, depth - 1) for one in value.values())
    if depth and isinstance(value, list | tuple):
        return any(carries_nan(one, depth - 1) for one in value)
    return False
