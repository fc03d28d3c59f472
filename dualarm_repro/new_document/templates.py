"""The files of a new document, from the templates in ``files``, whose names are their places."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from ..ledger.cite import TEX

_FOLDER = Path(__file__).resolve().parent / "files"
_SUFFIX = ".jinja"
#: What has a meaning in TeX; BibTeX would count an escaped brace as one.
_TEX = TEX | {"~": r"\textasciitilde{}", **{sign: f"\\{sign}" for sign in "&%#_"}}


def fill(values: Mapping[str, Any]) -> dict[str, str]:
    """Place of every file, below a clone, with its text.

    Parameters
    ----------
    values
        ``id``, ``title`` and ``order`` of the document.
    """
    made = Environment(  # Python, TeX and MyST have braces of their own
        loader=FileSystemLoader(_FOLDER),
        variable_start_string="<<",
        variable_end_string=">>",
        undefined=StrictUndefined,
        keep_trailing_newline=True,
    )
    made.filters |= {"quoted": _quoted, "plain": _plain, "tex": _tex}
    found = {}
    for name in made.list_templates(extensions=[_SUFFIX.removeprefix(".")]):
        place = re.sub(r"\bID\b", values["id"], name.removesuffix(_SUFFIX))
        found[place] = made.get_template(name).render(values)
    return found


def _quoted(text: str) -> str:
    """A text as a quoted YAML string."""
    return json.dumps(text, ensure_ascii=False)


def _plain(text: str) -> str:
    """A text without meaning to Markdown."""
    return re.sub(r"([\\`*_{}\[\]<>$#|])", r"\\\1", text)


def _tex(text: str) -> str:
    return "".join(_TEX.get(sign, sign) for sign in text)
