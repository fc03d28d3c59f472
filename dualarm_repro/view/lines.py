"""Lines at the head of a card that are worded by hand: templates filled with the item's numbers."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

import yaml

from .sentences import fill

_FILE = Path(__file__).with_name("lines.yaml")


def line(made: Mapping[str, Any], which: str) -> str | None:
    """The worded line ``printed`` or ``obtained`` of an item, or None where none is worded.

    Raises
    ------
    LedgerError
        The template names a value that the record does not have.
    """
    text = _worded().get(made["id"], {}).get(which)
    if text is None or (which == "obtained" and not made["obtained"]):
        return None
    if which == "obtained" and "{" not in text and not all(c["holds"] for c in made["checks"]):
        return None
    return _filled(made, text)


def beside(made: Mapping[str, Any]) -> dict[str, str]:
    """What stands beside a printed value by its way, e.g. ``improved.mean_time``, where no obtained
    value goes by the same name.

    Raises
    ------
    LedgerError
        A template names a value that the record does not have.
    """
    if not made["obtained"]:
        return {}
    texts = _worded().get(made.get("id", ""), {}).get("beside", {})
    return {way: _filled(made, text) for way, text in texts.items()}


def _filled(made: Mapping[str, Any], text: str) -> str:
    return fill(
        text,
        f"{_FILE.name}, {made['id']}",
        printed=made["printed"],
        obtained=made["obtained"],
        robustness=made["robustness"],
    )


@cache
def _worded() -> dict[str, dict[str, Any]]:
    loaded: dict[str, dict[str, Any]] = yaml.safe_load(_FILE.read_text(encoding="utf-8"))
    return loaded
