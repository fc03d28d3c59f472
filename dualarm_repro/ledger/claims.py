"""Numbers of the book as ``repro.yaml``, a manifest that the independent checker `claims` verifies.

``data/headlines.yaml`` names the numbers: an item, the path of the value in what was obtained, and
how many digits are stated. The digits are those of the reference results. `claims` then looks each
one up in a file pinned by its SHA-256: in ``data/results`` for the manifest in the root, in the
newly computed ``ledger.json`` for that of an export. A number is met when the value found rounds to
the digits stated.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from decimal import Decimal
from pathlib import Path
from typing import Annotated, Any

import yaml
from pydantic import Field, ValidationError

from ..datafiles import data_path, from_validation, read_yaml
from ..errors import DataFileError
from .reference import read_reference, reference_path
from .schema import Model, Text, load_paper

_HEAD = "# Written by `dualarm export` or `make metadata`; check with `claims verify repro.yaml`.\n"
_FILE = "headlines.yaml"


class Headline(Model):
    """One number of the book."""

    text: Text = Field(description="what the number says")
    item: Text = Field(description="id of the item that obtains it")
    path: list[str | int] = Field(min_length=1, description="keys down to the number")
    digits: Annotated[int, Field(ge=1, le=6)] = Field(default=4, description="significant")
    printed: bool = Field(default=False, description="the digits are those the document prints")


class HeadlineFile(Model):
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
        return "".join(f"/{_escape(part)}" for part in self.path)


def headlines(path: Path | None = None) -> list[Headline]:
    """The numbers that are stated.

    Raises
    ------
    DataFileError
        With the first offending field, its value and what was expected.
    """
    path = path or data_path(_FILE)
    try:
        return HeadlineFile.model_validate(read_yaml(path)).headlines
    except ValidationError as error:
        raise from_validation(path, error) from None


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


def manifest(
    stated: Iterable[Statement],
    artifacts: Mapping[str, tuple[str, str]],
    locate: Callable[[str], tuple[str, str]],
) -> str:
    """Text of a ``repro.yaml``.

    Parameters
    ----------
    stated
        Each becomes a claim with one number as evidence.
    artifacts
        Id of each file: its path from the manifest and its SHA-256.
    locate
        Item id to the id of the file that holds it and the JSON pointer of what was obtained.
    """
    claims = []
    for one in stated:
        artifact, base = locate(one.item)
        evidence = {
            "kind": "metric",
            "artifact": artifact,
            "name": ".".join(map(str, one.path)),
            "pointer": base + one.pointer,
            "reported": one.reported,
        }
        identifier = "_".join((one.item, *map(str, one.path)))
        claims.append({"id": identifier, "text": one.text, "evidence": [evidence]})
    files = [
        {"id": name, "path": path, "digest": {"algorithm": "sha256", "value": digest}}
        for name, (path, digest) in artifacts.items()
    ]
    content = {"artifacts": files, "claims": claims}
    return _HEAD + yaml.safe_dump(content, sort_keys=False, allow_unicode=True, width=100)


def reference_manifest() -> str:
    """Text of the manifest in the root: every statement, looked up in ``data/results``."""
    stated = statements()
    papers = dict.fromkeys(one.item.partition(".")[0] for one in stated)
    files = {
        paper: (
            f"data/results/{paper}.json",
            hashlib.sha256(reference_path(paper).read_bytes()).hexdigest(),
        )
        for paper in papers
    }

    def locate(item: str) -> tuple[str, str]:
        return item.partition(".")[0], f"/items/{_escape(item)}/obtained"

    return manifest(stated, files, locate)


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


def _escape(part: str | int) -> str:
    return str(part).replace("~", "~0").replace("/", "~1")
