"""Exceptions: every message names the source, the field, the value and what was expected."""

from __future__ import annotations


class DualArmError(Exception):
    """Base of all errors to catch; the CLI turns it into one line and exit code 2."""


class InputError(DualArmError):
    """A value from outside is wrong.

    Attributes hold the four parts of the message: ``source`` (file or argument), ``field``,
    ``value`` and ``expected``.
    """

    def __init__(self, source: object, field: str, value: object, expected: str) -> None:
        # All four are arguments of the base class, so that workers can pickle the error.
        super().__init__(source, field, value, expected)
        self.source, self.field, self.value, self.expected = source, field, value, expected

    def __str__(self) -> str:
        return f"{self.source}: {self.field} = {shorten(self.value)}: expected {self.expected}"


class DataFileError(InputError):
    """A data file (YAML, URDF, Parquet) is missing, malformed or has a field of the wrong form."""


class UnknownNameError(InputError):
    """A robot, item, method or format of that name does not exist."""


class ConfigurationError(InputError):
    """A joint vector has the wrong shape or holds NaN or infinity."""


class OutputError(InputError):
    """A result cannot be written where it was asked for."""


class UnsupportedArmError(DualArmError):
    """The arm lacks the structure a method needs, e.g. a spherical wrist for closed-form IK."""


class LedgerError(DualArmError):
    """The ledger is incomplete or contradicts itself."""


def shorten(value: object, limit: int = 120) -> str:
    """``repr`` of a value on one line, cut to ``limit`` characters; numpy numbers as plain ones."""
    try:
        text = " ".join(repr(_plain(value)).split())
    except Exception:  # a list that holds itself, a number of too many digits, a broken __repr__
        text = f"a {type(value).__name__} that cannot be printed"
    return text if len(text) <= limit else text[: limit - 3] + "..."


def _plain(value: object) -> object:
    """Numpy numbers and arrays as plain ones; of many only as many as are printed."""
    if isinstance(value, dict):
        return {key: _plain(part) for key, part in value.items()}
    if isinstance(value, list | tuple):
        return type(value)(map(_plain, value)) if type(value) in (list, tuple) else value
    return value.tolist() if hasattr(value, "tolist") else value
