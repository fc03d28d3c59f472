"""Schema of the files beside this one: the findings on a document."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Annotated

from pydantic import Field

from ...datafiles import StrictModel, Text, read_yaml

_HERE = Path(__file__).parent


class Finding(StrictModel):
    """A statement in plain words, what it rests on, and when it may be made.

    Texts and conditions are templates over the records of the items in ``rests_on``, each known by
    its id without the document.
    """

    rests_on: Annotated[list[Text], Field(min_length=1)]
    holds: Annotated[list[Text], Field(min_length=1, description="all must be true")]
    landing: Annotated[int, Field(ge=1)] | None = Field(
        default=None, description="place among the leading findings"
    )
    title: Text
    text: Text
    under: Text | None = Field(default=None, description="what had to be assumed")
    title_zh: Text
    text_zh: Text
    under_zh: Text | None = None


class FindingFile(StrictModel):
    """Content of ``<document>.yaml``."""

    findings: dict[str, Finding]


@cache
def read_findings(paper: str, folder: Path = _HERE) -> dict[str, Finding]:
    """The findings on a document by their names; none where there is no file.

    Raises
    ------
    DataFileError
        With the first offending field, its value and what was expected.
    """
    path = folder / f"{paper}.yaml"
    if not path.is_file():
        return {}
    return FindingFile.checked(path, read_yaml(path)).findings
