"""Settings of a method: keyword arguments that are checked when they are made, choices by name."""

from __future__ import annotations

from enum import StrEnum
from typing import Annotated, Any, Self, TypeVar

from pydantic import BaseModel, ConfigDict, Field, ValidationError, model_validator

from .datafiles import from_validation, with_known_fields
from .errors import InputError, UnknownNameError

Positive = Annotated[float, Field(gt=0)]

_Choice = TypeVar("_Choice", bound=StrEnum)
_Numbers = TypeVar("_Numbers")


def code(member: StrEnum) -> int:
    """Number of a choice inside compiled code: its place among the choices."""
    return list(type(member)).index(member)


def numbers(kind: type[_Numbers], settings: Settings, **computed: Any) -> _Numbers:
    """A named tuple for kernels: each field as computed or as set, a choice by its :func:`code`."""
    found = {**dict(settings), **computed}
    values = (found[name] for name in kind.__annotations__)
    return kind(*(code(one) if isinstance(one, StrEnum) else one for one in values))


def choice(kind: type[_Choice], source: str, field: str, name: str) -> _Choice:
    """The choice of that name.

    Raises
    ------
    UnknownNameError
        There is none.
    """
    try:
        return kind(name)
    except ValueError:
        raise UnknownNameError(source, field, name, f"one of {', '.join(kind)}") from None


class Settings(BaseModel):
    """Base: keyword arguments only, immutable; unknown fields and wrong values are input errors."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    @model_validator(mode="before")
    @classmethod
    def _known(cls, values: Any) -> Any:
        return with_known_fields(cls, values)

    def __init__(self, **values: Any) -> None:
        try:
            super().__init__(**values)
        except ValidationError as error:
            first, found = error.errors()[0], from_validation(type(self).__name__, error)
            field = found.field if found.field != "file" else "combination of values"
            kind = UnknownNameError if first["type"] == "enum" else InputError
            raise kind(found.source, field, found.value, found.expected) from None

    def changed(self, **values: Any) -> Self:
        """The same settings with some values changed, checked again."""
        return type(self)(**{**dict(self), **values})
