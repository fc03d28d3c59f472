"""Schema of the public record of an item, as `list`, `show` and the exports give it.

A record may hold more than is named here; what is named here is always there and of this type.
"""

from __future__ import annotations

from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, Field

from .schema import Kind
from .verdict import Verdict

#: JSON Schema dialect of every published schema.
DIALECT = "https://json-schema.org/draft/2020-12/schema"


class _Open(BaseModel):
    """Base: further fields are allowed."""

    model_config = ConfigDict(extra="allow")


class RecordCheck(_Open):
    """One rule, applied to what was obtained."""

    label: str
    expected: Any = Field(description="what the rule asks for, in words")
    obtained: Any
    holds: bool | None
    outcome: Literal["holds", "fails", "open"]


class RecordWitness(_Open):
    """A choice of what is not printed, with the verdict it gives."""

    choice: str
    verdict: str
    values: dict[str, Any] = Field(description="changed assumptions by id")


class RecordPlace(_Open):
    """Where a function is written."""

    file: str
    function: str
    line: int | None


class RecordCode(RecordPlace):
    """Where the checker is written, and the function that draws its figure."""

    figure: RecordPlace | None


class RecordShare(_Open):
    """A share with its 95 % interval."""

    share: float = Field(ge=0, le=1)
    interval: list[float]


class RecordAssumption(_Open):
    """A value that was chosen because it is not printed."""

    id: str
    statement: str
    value: Any
    why: str
    evidence: str


class RecordProof(_Open):
    """A computation that shows an erratum."""

    statement: str
    holds: bool


class RecordErratum(_Open):
    """Something in print that is wrong, ambiguous or contradicts another place."""

    id: str
    place: str
    problem: str
    resolution: str
    proof: RecordProof | None


class RecordRobustness(_Open):
    """How often the verdict holds over the plausible values of the assumptions."""

    holds: float = Field(ge=0, le=1, description="share of the draws")
    samples: int = Field(ge=0)
    interval: list[float] | None = Field(default=None, description="of the share, 95 %")
    meets_print: RecordShare = Field(description="draws in which print is met")
    flip: dict[str, Any] | None = Field(default=None, description="smallest change that turns it")
    influence: dict[str, float] = Field(
        description="first-order index of each assumption whose influence is beyond chance"
    )


class Record(_Open):
    """Everything the ledger knows about one item."""

    id: str = Field(pattern=r"^[a-z][a-z0-9_]*\.[a-z][a-z0-9_]*$")
    paper: str = Field(description="id of the document")
    kind: Kind
    title: str
    place: str = Field(description="where it is printed")
    role: Literal["result", "input"]
    printed: Any = Field(description="printed values as strings with the digits of the source")
    unit: str | None
    obtained: Any = Field(description="computed values by name")
    verdict: Verdict
    checks: list[RecordCheck]
    scope: Literal["run", "general"]
    decided_by: str | None = Field(description="statement that decides an item without original")
    witnesses: list[RecordWitness]
    search: dict[str, Any] | None = Field(description="how a witness was sought")
    seek: str | None = Field(description="which witness is still to be sought")
    assumptions: list[RecordAssumption]
    context: list[RecordAssumption]
    errata: list[RecordErratum]
    missing: list[str] = Field(description="data it depends on that is not printed")
    notes: str | None
    robustness: RecordRobustness | None
    draws: str = Field(description="`none` where nothing varies, else the status of the draws")
    code: RecordCode | None
    page: str | None
    url: str | None


def record_schema() -> dict[str, Any]:
    """JSON Schema of a record."""
    return Record.model_json_schema()


def ledger_schema() -> dict[str, Any]:
    """JSON Schema of ``ledger.json``: an array of records."""
    schema = record_schema()
    definitions = schema.pop("$defs")
    definitions["Record"] = schema
    items = {"$ref": "#/$defs/Record"}
    title = "Every record of the ledger"
    return {"title": title, "type": "array", "items": items, "$defs": definitions}


def published(name: str, schema: dict[str, Any], version: int = 1) -> dict[str, Any]:
    """A schema with dialect and permanent identifier, which names no host."""
    identifier = f"urn:dualarm-repro:schema:{name}:{version}"
    return {"$schema": DIALECT, "$id": identifier, **schema}
