"""Settings that a file gives in part, merged over those that suit an arm."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, TypeVar

from ..errors import InputError
from ..settings import Settings

_Settings = TypeVar("_Settings", bound=Settings)


def merged(default: _Settings, given: Mapping[str, Any]) -> _Settings:
    """``default`` with the fields of ``given`` instead, field by field inside its blocks as well.

    A block whose fields do not go together with the default ones, such as another rule, counts
    alone if it is complete by itself.

    Raises
    ------
    InputError
        An unknown field, or a value of the wrong form.
    """
    values = dict(default)
    for field, value in given.items():
        before = values.get(field)
        if isinstance(value, Mapping) and isinstance(before, Settings):
            values[field] = _block(before, value)
        else:
            values[field] = value
    return type(default)(**values)


def _block(default: Settings, given: Mapping[str, Any]) -> Settings:
    try:
        return merged(default, given)
    except InputError:
        try:
            return type(default)(**given)
        except InputError:
            pass
        raise
