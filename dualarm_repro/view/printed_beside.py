"""What is printed beside what is obtained, row by row, for the terminal."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

from .wording import short


class Row(NamedTuple):
    """One line of a comparison.

    Attributes
    ----------
    what
        Name of the printed value, or what a rule looks at.
    printed
        In its printed words and digits, or what a rule expects.
    obtained
        Empty where no obtained value goes by the same name.
    outcome
        Of the rule; empty for a value that stands for itself.
    """

    what: str
    printed: str
    obtained: str
    outcome: str = ""


def printed_rows(made: dict[str, Any]) -> list[Row]:
    """Everything the document prints, with the obtained value of the same name where one is."""
    return list(_rows(made["printed"], made["obtained"], ()))


def check_rows(made: dict[str, Any]) -> list[Row]:
    """Each rule: what it expects, what it found, and how it ended."""
    return [
        Row(check["label"], yes_no(check["expected"]), yes_no(check["obtained"]), check["outcome"])
        for check in made["checks"]
    ]


def yes_no(value: Any) -> str:
    """A value on one line, true and false as words."""
    return {"True": "yes", "False": "no", "true": "yes", "false": "no"}.get(
        text := short(value), text
    )


def _rows(printed: Any, obtained: Any, path: tuple[str, ...]) -> Iterator[Row]:
    if printed is None:
        return
    if isinstance(printed, dict):
        for key, part in printed.items():
            yield from _rows(part, _below(obtained, key), (*path, key))
    elif isinstance(printed, list) and any(isinstance(part, dict | list) for part in printed):
        for number, part in enumerate(printed):
            yield from _rows(part, _below(obtained, number), (*path, str(number + 1)))
    else:
        flat = ", ".join(printed) if isinstance(printed, list) else printed
        same = not (obtained is None or isinstance(obtained, dict))
        yield Row(", ".join(_words(path)), flat, yes_no(obtained).strip("()") if same else "")


def _below(obtained: Any, key: str | int) -> Any:
    if isinstance(obtained, dict):
        return obtained.get(key)
    if isinstance(obtained, list) and isinstance(key, int) and key < len(obtained):
        return obtained[key]
    return None


def _words(path: tuple[str, ...]) -> tuple[str, ...]:
    return tuple(key.replace("_", " ") for key in path) or ("value",)
