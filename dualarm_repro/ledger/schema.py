"""Schema of ``data/papers/<id>.yaml``: one document, its items, assumptions and errata."""

from __future__ import annotations

from enum import StrEnum
from math import log
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import (
    BeforeValidator,
    Field,
    StringConstraints,
    model_validator,
)

from ..datafiles import StrictModel, Text, read_yaml

Key = Annotated[str, StringConstraints(pattern=r"^[a-z][a-z0-9_]*$")]


def _strings_only(value: Any) -> Any:
    """Printed values are strings, so that the printed digits are kept; they may be nested."""
    if isinstance(value, str) and value.strip():
        return value
    if isinstance(value, list) and value:
        return [_strings_only(part) for part in value]
    if isinstance(value, dict) and value:
        return {str(key): _strings_only(part) for key, part in value.items()}
    raise ValueError(f"non-empty strings, or lists or mappings of strings (found {value!r})")


Printed = Annotated[Any, BeforeValidator(_strings_only)]


class Kind(StrEnum):
    """What sort of thing an item is in print."""

    FIGURE = "figure"
    TABLE = "table"
    EQUATION = "equation"
    CLAIM = "claim"


class Document(StrictModel):
    """Bibliographic record; what the source does not print is listed in ``unknown``."""

    id: Key
    order: int = Field(default=0, description="place in listings")
    type: Literal["article", "inproceedings", "patent", "misc"]
    language: Text | None = Field(default=None, description="of the text, as a BCP 47 tag")
    title: Text = Field(description="title in English")
    title_original: Text | None = None
    authors: list[Text] = Field(default=[], description="family name, given name")
    authors_original: list[Text] = Field(
        default=[], description="the same people in the script of the source, family name first"
    )
    affiliation: Text | None = None
    journal: Text | None = None
    year: Text | None = None
    note: Text | None = None
    unknown: list[Text] = Field(default=[], description="bibliographic fields the source lacks")

    @model_validator(mode="after")
    def _same_people(self) -> Document:
        if self.authors_original and len(self.authors_original) != len(self.authors):
            raise ValueError("authors_original: one name for each of authors")
        return self


class Assumption(StrictModel):
    """A value the document does not print and the reproduction had to choose."""

    statement: Text
    value: Any = Field(description="the value used, in the unit given")
    unit: Text | None = None
    why: Text
    evidence: Literal["printed", "public", "inferred", "assumed"]
    range: tuple[float, float] | None = Field(
        default=None, description="plausible range of a numeric value"
    )
    scale: Literal["linear", "log"] = Field(
        default="linear", description="log: all factors between the ends of the range count alike"
    )
    choices: list[Any] | None = Field(default=None, description="plausible alternatives")

    @property
    def varies(self) -> bool:
        """Whether another plausible value is declared."""
        return self.range is not None or len(self.choices or []) > 1

    def at(self, share: float) -> Any:
        """The plausible value at a share in [0, 1) of the range or of the choices."""
        if self.range is not None:
            low, high = self.range
            if self.scale == "log":
                return float(low * (high / low) ** share)
            return float(low + share * (high - low))
        if self.choices is None:
            raise ValueError("an assumption with a range or with choices")
        return self.choices[int(share * len(self.choices))]

    def share_of(self, value: float) -> float:
        """Where a value lies in the range, the inverse of :meth:`at`."""
        if self.range is None:
            raise ValueError("an assumption with a range")
        low, high = self.range
        if self.scale == "log":
            return log(value / low) / log(high / low)
        return (value - low) / (high - low)

    @model_validator(mode="after")
    def _value_is_plausible(self) -> Assumption:
        if self.range is not None:
            low, high = self.range
            if not low < high:
                raise ValueError("range must be [low, high] with low < high")
            if not isinstance(self.value, int | float) or not low <= self.value <= high:
                raise ValueError("value must be a number inside range")
            if self.scale == "log" and low <= 0:
                raise ValueError("a range on a logarithmic scale must be positive")
        if self.choices is not None and self.value not in self.choices:
            raise ValueError("value must be one of choices")
        return self


class Erratum(StrictModel):
    """Something in print that is wrong, ambiguous or contradicts another place."""

    place: Text
    problem: Text
    resolution: Text
    affects: list[Text] = Field(default=[], description="full item ids, e.g. xue.tab01")
    no_proof: Text | None = Field(
        default=None, description="why no machine proof is registered for it"
    )


class Sentence(StrictModel):
    """A sentence of the source that can be true or false, and the items that judge it."""

    place: Text = Field(description="section and, where it helps, paragraph or caption")
    says: Text = Field(description="what it asserts, in our own words")
    items: list[Text] = Field(default=[], description="full ids of the items that judge it")
    unjudged: Text | None = Field(
        default=None, description="why nothing in the document or computed from it can decide it"
    )

    @model_validator(mode="after")
    def _judged_or_not(self) -> Sentence:
        if bool(self.items) == (self.unjudged is not None):
            raise ValueError("give either items or unjudged")
        return self


class Threshold(StrictModel):
    """A number that a rule compares with, and why it is that number."""

    value: float
    reason: Text


class Search(StrictModel):
    """A directed search for a choice of the assumptions under which print is met."""

    starts: int = Field(default=8, gt=0, description="independent climbs")
    evaluations: int = Field(default=40, gt=0, description="evaluations of each climb")


class Tolerance(StrictModel):
    """How far an ill-conditioned value may move from one processor to another, and why."""

    relative: float | None = Field(default=None, gt=0, le=0.1)
    absolute: float | None = Field(default=None, gt=0)
    reason: Text = Field(description="why six digits do not hold, with the spread measured")

    @model_validator(mode="after")
    def _one_size(self) -> Tolerance:
        if (self.relative is None) == (self.absolute is None):
            raise ValueError("give either relative or absolute")
        return self


class Item(StrictModel):
    """One printed figure, table, equation or claim."""

    kind: Kind
    place: Text = Field(description="section, paragraph or table where it is printed")
    title: Text
    role: Literal["result", "input"] = Field(
        default="result", description="input: a value the method is fed with, adopted or adapted"
    )
    printed: Printed | None = Field(default=None, description="printed values as strings")
    unit: Text | None = None
    needs: Text = Field(description="what has to be computed or shown")
    missing: list[Text] = Field(default=[], description="data it depends on that is not printed")
    assumptions: list[Key] = Field(
        default=[], description="ids of assumptions, each of which can move a judged value"
    )
    context: list[Key] = Field(
        default=[], description="ids of assumptions that are read, but can move no judged value"
    )
    scope: Literal["run", "general"] = Field(
        default="run",
        description="run: about one run of the authors, which is possible or not found; "
        "general: it claims more than possibility",
    )
    statements: list[Text] = Field(
        default=[],
        description="full ids of the statements of the text about a lost original; one that "
        "decides takes precedence over `regenerated`",
    )
    thresholds: dict[Key, Threshold] = Field(
        default={}, description="numbers that the rules compare with, by name"
    )
    search: Search | None = Field(
        default=None, description="directed search for a witness, where sampling finds none"
    )
    seek: Text | None = Field(
        default=None, description="which witness is still to be sought, and where"
    )
    tolerances: dict[Text, Tolerance] = Field(
        default={},
        description="obtained values `verify` compares less closely; * is any one key or index",
    )
    notes: Text | None = None
    pending: Text | None = Field(
        default=None, description="declared reason why no checker is registered yet"
    )


class PaperFile(StrictModel):
    """Content of one file in ``data/papers``."""

    document: Document
    assumptions: dict[Key, Assumption] = Field(default_factory=dict)
    errata: dict[Key, Erratum] = Field(default_factory=dict)
    items: dict[Key, Item]
    sentences: list[Sentence] = Field(
        default=[],
        description="every sentence that can be true or false, in the order of the source; where "
        "there are any, each claim is named by one",
    )

    @model_validator(mode="after")
    def _references_exist(self) -> PaperFile:
        for key, item in self.items.items():
            for field in ("assumptions", "context"):
                for name in getattr(item, field):
                    if name not in self.assumptions:
                        raise ValueError(f"items.{key}.{field}: no assumption named {name!r}")
            if both := set(item.assumptions) & set(item.context):
                raise ValueError(f"items.{key}.context: {sorted(both)} are assumptions already")
        known = {f"{self.document.id}.{key}" for key in self.items}
        for key, item in self.items.items():
            for name in item.statements:
                if name not in known:
                    raise ValueError(f"items.{key}.statements: no item named {name!r}")
        for key, erratum in self.errata.items():
            for name in erratum.affects:
                if name not in known:
                    raise ValueError(f"errata.{key}.affects: no item named {name!r}")
        for number, sentence in enumerate(self.sentences):
            for name in sentence.items:
                if name not in known:
                    raise ValueError(f"sentences.{number}.items: no item named {name!r}")
        return self

    @property
    def unsaid_claims(self) -> list[str]:
        """Full ids of the claims that no sentence names, once sentences are listed."""
        if not self.sentences:
            return []
        named = {name for sentence in self.sentences for name in sentence.items}
        claims = (f"{self.document.id}.{k}" for k, i in self.items.items() if i.kind == Kind.CLAIM)
        return [claim for claim in claims if claim not in named]


def load_paper(path: Path) -> PaperFile:
    """Read and check one paper file.

    Raises
    ------
    DataFileError
        With the first offending field, its value and what was expected.
    """
    return PaperFile.checked(path, read_yaml(path))


def json_schema() -> dict[str, Any]:
    """JSON Schema of a paper file, for editors and other tools."""
    return PaperFile.model_json_schema()
