"""What the project says of itself, in one place: the table ``[project]`` of pyproject.toml.

An installed package carries that table as its metadata, a clone as the file; both give the same.
"""

from __future__ import annotations

from dataclasses import dataclass
from importlib.metadata import metadata
from typing import Any

NAME = "dualarm_repro"
#: Year of the work that is cited; the first release will bring a date.
YEAR = "2026"
#: Licence of text and figures; that of the code is in the table.
TEXT_LICENCE = "CC-BY-4.0"


@dataclass(frozen=True)
class Project:
    """Name, version and licence of the project, as every description of it states them."""

    name: str
    version: str
    summary: str
    authors: tuple[str, ...]
    keywords: tuple[str, ...]
    licence: str
    python: str
    year: str = YEAR
    text_licence: str = TEXT_LICENCE

    @property
    def title(self) -> str:
        """Title of the whole work."""
        return f"{self.name}: {self.summary[0].lower()}{self.summary[1:]}"


def project() -> Project:
    """The project as installed."""
    found = metadata(NAME)
    return Project(
        name=NAME,
        version=found["Version"],
        summary=found["Summary"],
        authors=tuple(name.strip() for name in found["Author"].split(",")),
        keywords=tuple(sorted(word.strip() for word in found["Keywords"].split(","))),
        licence=found["License-Expression"],
        python=found["Requires-Python"],
    )


def from_table(table: dict[str, Any]) -> Project:
    """The project as the table ``[project]`` of a clone's pyproject.toml describes it."""
    return Project(
        name=table["name"],
        version=table["version"],
        summary=table["description"],
        authors=tuple(author["name"] for author in table["authors"]),
        keywords=tuple(sorted(table["keywords"])),
        licence=table["license"],
        python=table["requires-python"],
    )
