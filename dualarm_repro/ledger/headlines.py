"""Numbers that the book states, as ``data/headlines.yaml`` lists them.

A headline names an item, the path of a number in what it obtains, and how many digits are stated.
The digits are those of the reference results or, where the document prints the number, its own.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from decimal import Decimal
from pathlib import Path
from typing import Annotated, Any

from pydantic import Field

from ..datafiles import StrictModel, Text, data_path, read_yaml
from ..errors import DataFileError
from .reference import read_reference
from .schema import load_paper

_FILE = "headlines.yaml"


class Headline(StrictModel):
    """One number of the book."""

    text: Text = Field(description="what the number says")
    item: Text = Field(description="id of the item that obtains it")
    path: list[str | int] = Field(min_length=1, description="keys down to the number")
    digits: Annotated[int, Field(ge=1, le=6)] = Field(default=4, description="significant")
    printed: bool = Field(default=False, description="the digits are those the document prints")


class HeadlineFile(StrictModel):
    """Content of ``data/headlines.yaml``."""

    headlines: list[Headline] = Field(min_length=1)


@dataclass(frozen=True)
class Statement:
    """A number as it is stated: ``reported`` is a text, so that its digits are kept."""

    text: str
    item: str
    path: tuple[str | int, ...]
    reported: str

    @property
    def pointer(self) -> str:
        """JSON pointer of the number, from what the item obtained."""
        return "".join(f"/{pointer_part(part)}" for part in self.path)


def headlines(path: Path | None = None) -> list[Headline]:
    """The numbers that are stated.

    Raises
    ------
    DataFileError
        With the first offending field, its value and what was expected.
    """
    path = path or data_path(_FILE)
    return HeadlineFile.checked(path, read_yaml(path)).headlines


def statements(path: Path | None = None) -> list[Statement]:
    """The headlines with the digits of the reference results.

    Raises
    ------
    DataFileError
        An item or path that the reference results do not have, or a value that is no number.
    """
    path, found = path or data_path(_FILE), []
    for k, headline in enumerate(headlines(path)):
        paper = headline.item.partition(".")[0]
        obtained = read_reference(paper).get(headline.item, {}).get("obtained")
        value = _at(obtained, headline.path)
        if isinstance(value, bool) or not isinstance(value, int | float):
            expected = "the path of a number in the reference results"
            raise DataFileError(path, f"headlines.{k}", _name(headline), expected)
        digits = rounded(value, headline.digits)
        if headline.printed:
            digits = _at(_printed(headline.item), headline.path)
            if not isinstance(digits, str):
                expected = "a value that is printed under the same path"
                raise DataFileError(path, f"headlines.{k}", _name(headline), expected)
        found.append(Statement(headline.text, headline.item, tuple(headline.path), digits))
    return found


def rounded(value: float, digits: int) -> str:
    """A number to so many significant digits, as plain decimal text; integers are kept whole."""
    if isinstance(value, int):
        return str(value)
    return format(Decimal(f"{value:.{digits - 1}e}"), "f")


def _printed(item: str) -> Any:
    """What the document prints for an item."""
    paper, _, key = item.partition(".")
    return load_paper(data_path("papers", f"{paper}.yaml")).items[key].printed


def _at(value: Any, path: Iterable[str | int]) -> Any:
    """What is found going down the keys of ``path``, or nothing."""
    try:
        for part in path:
            value = value[part]
    except (KeyError, IndexError, TypeError):
        return None
    return value


def _name(headline: Headline) -> str:
    return f"{headline.item}: {'.'.join(map(str, headline.path))}"


def pointer_part(part: str | int) -> str:
    """A key as part of a JSON pointer."""
    return str(part).replace("~", "~0").replace("/", "~1")
