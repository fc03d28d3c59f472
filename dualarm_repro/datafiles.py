"""Where the data files are, in a clone or inside an installed wheel, and how YAML is read and
checked."""

from __future__ import annotations

from difflib import get_close_matches
from functools import cache
from pathlib import Path
from typing import Annotated, Any, Self

import yaml
from pydantic import BaseModel, ConfigDict, StringConstraints, ValidationError, model_validator
from pydantic_core import PydanticCustomError

from .errors import DataFileError
from .input_files import contents
from .tracking import note

#: Text that says something.
Text = Annotated[str, StringConstraints(strip_whitespace=True, min_length=1)]


_UNKNOWN = "unknown_field"
_SIMILAR = 0.5  # of names, as difflib measures it
_LARGEST_FILE = 100_000_000  # [bytes], more than any data file of the project


class StrictModel(BaseModel):
    """Base: unknown fields are errors, so that a misspelt field cannot be ignored."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    @model_validator(mode="before")
    @classmethod
    def _known(cls, content: Any) -> Any:
        return with_known_fields(cls, content)

    @classmethod
    def checked(cls, path: Path, content: Any) -> Self:
        """The content of a file, checked.

        Raises
        ------
        DataFileError
            With the first offending field, its value and what was expected.
        """
        try:
            return cls.model_validate(content)
        except ValidationError as error:
            raise from_validation(path, error) from None


@cache
def data_root() -> Path:
    """Folder with ``papers/``, ``robots/``, ``scenes/`` and ``results/``."""
    package = Path(__file__).resolve().parent
    installed = package / "_data"
    return installed if installed.is_dir() else package.parent / "data"


def data_path(*parts: str) -> Path:
    """Path of a data file below :func:`data_root`; it need not exist."""
    return data_root().joinpath(*parts)


def opened(path: Path) -> Path:
    """The same path, after telling the recordings under way that this data file is read."""
    path = Path(path)
    if path.is_relative_to(data_root()):
        note(path.relative_to(data_root()).as_posix())
    return path


_Fastest: Any = yaml.CSafeLoader if hasattr(yaml, "CSafeLoader") else yaml.SafeLoader


class _Loader(_Fastest):
    """Safe loader that refuses a key given twice, which YAML would let the last one win."""


def _mapping(loader: _Loader, node: yaml.MappingNode, deep: bool = False) -> dict[Any, Any]:
    seen: set[Any] = set()
    for key_node, _ in node.value:
        key = loader.construct_object(key_node, deep=True)
        if key in seen:
            raise yaml.constructor.ConstructorError(
                None, None, f"key {key!r} is given twice", key_node.start_mark
            )
        seen.add(key)
    found: dict[Any, Any] = yaml.SafeLoader.construct_mapping(loader, node, deep=True)
    return found


_Loader.add_constructor(yaml.resolver.BaseResolver.DEFAULT_MAPPING_TAG, _mapping)


#: Most values that a file may stand for once its aliases are written out.
_LARGEST = 500_000
_VALUES = (ValueError, TypeError, KeyError, AttributeError, OverflowError)


def _content(text: str) -> Any:
    """What a YAML text holds; a few lines of aliases of aliases could stand for any amount."""
    loader = _Loader(text)
    try:
        node = loader.get_single_node()
        if node is None:
            return None
        if _written_out(node, {}) > _LARGEST:
            raise yaml.composer.ComposerError(
                None,
                None,
                f"aliases that multiply: at most {_LARGEST} values are read",
                node.start_mark,
            )
        return loader.construct_document(node)
    finally:
        loader.dispose()


def _written_out(node: yaml.Node, known: dict[int, int]) -> int:
    """Number of values below a node, those of an alias counted each time."""
    if (found := known.get(id(node))) is not None:
        return found
    known[id(node)] = 1  # an alias within itself, which the construction refuses
    parts: list[yaml.Node] = []
    if isinstance(node, yaml.MappingNode):
        parts = [part for pair in node.value for part in pair]
    elif isinstance(node, yaml.SequenceNode):
        parts = node.value
    known[id(node)] = 1 + sum(_written_out(part, known) for part in parts)
    return known[id(node)]


def read_yaml(path: Path) -> dict[str, Any]:
    """Read a YAML file that holds a mapping.

    Raises
    ------
    DataFileError
        The file is missing, unreadable, not YAML, or its top level is no mapping.
    """
    path = opened(path)
    return parsed_yaml(path, contents(path, "a readable YAML file", _LARGEST_FILE))


def parsed_yaml(path: Path, written: bytes) -> dict[str, Any]:
    """The mapping that the bytes of a YAML file hold; errors as in :func:`read_yaml`."""
    try:
        text = written.decode()
    except UnicodeDecodeError:
        raise DataFileError(path, "file", "not UTF-8 text", "a readable YAML file") from None
    try:
        content = _content(text)
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        place = f"line {mark.line + 1}, column {mark.column + 1}" if mark else "file"
        problem = getattr(error, "problem", None) or "not YAML"
        raise DataFileError(path, place, problem, "well-formed YAML") from None
    except RecursionError:
        raise DataFileError(path, "nesting", "deeper", "fewer levels of lists") from None
    except _VALUES as error:
        # A date of no calendar, a number of thousands of digits, a list as key.
        problem = f"{type(error).__name__}: {error}"
        raise DataFileError(path, "a value", problem, "well-formed YAML") from None
    if not isinstance(content, dict):
        raise DataFileError(path, "top level", type(content).__name__, "a mapping of field: value")
    return content


def with_known_fields(model: type[BaseModel], content: Any) -> Any:
    """The content of a mapping, if it has no other fields than the model: for a validator.

    The error of pydantic for another field does not know which ones there are.

    Raises
    ------
    PydanticCustomError
        Names the field and the known ones, the most similar first.
    """
    if not isinstance(content, dict):
        return content
    known = list(model.model_fields)
    for name, value in content.items():
        if name not in known:
            near = get_close_matches(str(name), known, n=len(known), cutoff=_SIMILAR)
            listed = ", ".join([*near, *(one for one in known if one not in near)])
            expected = f"one of the fields {listed}" if known else "no field"
            told = {"field": str(name), "given": value, "expected": expected}
            raise PydanticCustomError(_UNKNOWN, "{expected}", told)
    return content


def from_validation(source: object, error: ValidationError) -> DataFileError:
    """The first problem pydantic found, naming file, field, value and expectation."""
    # A misspelt field is also a missing one; the misspelling is what helps.
    first = min(error.errors(), key=lambda entry: entry["type"] != _UNKNOWN)
    place = [str(part) for part in first["loc"]]
    expected = first["msg"].removeprefix("Value error, ")
    value = "nothing" if first["type"] == "missing" else first["input"]
    if first["type"] == _UNKNOWN:
        place.append(first["ctx"]["field"])
        value = first["ctx"]["given"]
    field = ".".join(place) or "file"
    if isinstance(value, dict):
        value = f"mapping with {', '.join(map(str, value))}" if value else "an empty mapping"
    return DataFileError(source, field, value, expected[0].lower() + expected[1:])
