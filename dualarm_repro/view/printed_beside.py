"""What is printed beside what is obtained, row by row, for the terminal."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

from .lines import beside
from .wording import obtained_line, short

#: Way to a value from the top of what is printed or obtained.
Path = tuple[str, ...]


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
    """Everything the document prints, with the obtained value of the same name where one is.

    A name of several words is the same in any order: what print calls ``improved, trapped`` may be
    obtained as ``trapped, improved``. What is worded by hand takes precedence.
    """
    told = beside(made)
    return [
        Row(_name(path), text, told.get(".".join(path), found))
        for path, text, found in _rows(made["printed"], made["obtained"], ())
    ]


def in_words(made: dict[str, Any]) -> str | None:
    """What is obtained in words, where a printed value has none beside it."""
    if made["obtained"] is None or all(row.obtained for row in printed_rows(made)):
        return None
    return obtained_line(made) or None


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


def _rows(printed: Any, obtained: Any, path: Path) -> Iterator[tuple[Path, str, str]]:
    """Way, printed text and obtained text of every printed value."""
    if printed is None:
        return
    shuffled = _in_any_order(obtained) if not path and isinstance(printed, dict) else {}
    if isinstance(printed, dict):
        for key, part in printed.items():
            for deeper, text, found in _rows(part, _below(obtained, key), (*path, key)):
                yield deeper, text, found or shuffled.get(frozenset(deeper), "")
    elif isinstance(printed, list) and any(isinstance(part, dict | list) for part in printed):
        for number, part in enumerate(printed):
            yield from _rows(part, _below(obtained, number), (*path, str(number + 1)))
    else:
        flat = ", ".join(printed) if isinstance(printed, list) else printed
        same = not (obtained is None or isinstance(obtained, dict))
        yield path, flat, yes_no(obtained).strip("()") if same else ""


def _in_any_order(obtained: Any, path: Path = ()) -> dict[frozenset[str], str]:
    """Obtained values by the words of their way."""
    found: dict[frozenset[str], str] = {}
    for key, part in obtained.items() if isinstance(obtained, dict) else ():
        deeper = (*path, key)
        if isinstance(part, dict):
            found |= _in_any_order(part, deeper)
        else:
            found[frozenset(deeper)] = yes_no(part).strip("()")
    return found


def _below(obtained: Any, key: str | int) -> Any:
    if isinstance(obtained, dict):
        return obtained.get(key)
    if isinstance(obtained, list) and isinstance(key, int) and key < len(obtained):
        return obtained[key]
    return None


def _name(path: Path) -> str:
    return ", ".join(key.replace("_", " ") for key in path) or "value"
