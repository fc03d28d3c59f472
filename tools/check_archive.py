"""Check what archives read, with their own validators: cffconvert, CSL, pybtex and RO-Crate.

    python tools/check_archive.py FOLDER...

Each folder is the root of the project or an export. Every function returns one line per violation.
The official schema of CSL-JSON is taken from the files of the installed commonmeta-py, which is not
imported.
"""

from __future__ import annotations

import json
import sys
from importlib.util import find_spec
from pathlib import Path
from typing import Any


def wrong_cff(path: Path) -> list[str]:
    """What cffconvert objects to in a CITATION.cff."""
    from cffconvert import Citation

    try:
        Citation(path.read_text(encoding="utf-8")).validate()
    except Exception as error:  # ruamel, jsonschema and cffconvert each raise their own
        return [f"{path.name}: {' '.join(str(error).split())[:300]}"]
    return []


def csl_schema() -> dict[str, Any]:
    """The official JSON Schema of CSL-JSON, version 1.0."""
    package = Path(find_spec("commonmeta").origin).parent
    return json.loads(package.joinpath("resources/csl-data.json").read_text(encoding="utf-8"))


def wrong_csl(entries: Any, name: str = "CSL-JSON") -> list[str]:
    """What the official schema objects to in a list of CSL-JSON entries."""
    from jsonschema import Draft7Validator

    errors = Draft7Validator(csl_schema()).iter_errors(entries)
    return [f"{name}: {error.json_path}: {error.message[:200]}" for error in errors]


def wrong_bibtex(text: str, name: str = "BibTeX") -> list[str]:
    """What pybtex cannot parse."""
    from pybtex.database import parse_string
    from pybtex.exceptions import PybtexError

    try:
        found = parse_string(text, "bibtex")
    except PybtexError as error:
        return [f"{name}: {error}"]
    return [] if found.entries else [f"{name}: no entry"]


def wrong_crate(folder: Path) -> list[str]:
    """What a folder's RO-Crate names and does not have, or leaves without a description."""
    from rocrate.rocrate import ROCrate

    try:
        crate = ROCrate(folder)
    except Exception as error:  # rocrate raises ValueError, KeyError and OSError
        return [f"{folder.name}: no RO-Crate: {error}"]
    lines = []
    for field in ("name", "description", "datePublished", "license", "author"):
        if not crate.root_dataset.get(field):
            lines.append(f"{folder.name}: the crate has no {field}")
    for entity in crate.data_entities:
        if not folder.joinpath(entity.id).is_file():
            lines.append(f"{folder.name}: the crate names {entity.id}, which is not there")
        for field in ("name", "description", "license"):
            if not entity.get(field):
                lines.append(f"{folder.name}: {entity.id} has no {field} in the crate")
    known = {entity.id for entity in crate.get_entities()}
    for entity in crate.get_entities():
        text = json.dumps(entity.as_jsonld())
        lines += [f"{folder.name}: {entity.id} refers to {i}" for i in _references(text, known)]
    return lines


def _references(text: str, known: set[str]) -> list[str]:
    """Local identifiers that an entity refers to and the crate does not describe."""
    found = []

    def collect(mapping: dict[str, Any]) -> dict[str, Any]:
        if set(mapping) == {"@id"} and mapping["@id"].startswith("#"):
            found.append(mapping["@id"])
        return mapping

    json.loads(text, object_hook=collect)
    return [identifier for identifier in found if identifier not in known]


def violations(folder: Path) -> list[str]:
    """Everything that is wrong with the files of a folder."""
    lines = wrong_cff(folder / "CITATION.cff") + wrong_crate(folder)
    if (path := folder / "citations.json").is_file():
        lines += wrong_csl(json.loads(path.read_text(encoding="utf-8")), path.name)
    for name in ("citations.bib", "book/references.bib"):
        if (path := folder / name).is_file():
            lines += wrong_bibtex(path.read_text(encoding="utf-8"), name)
    return lines


def main() -> int:
    """Print every violation; 1 if there is any."""
    found = [line for name in sys.argv[1:] for line in violations(Path(name))]
    for line in found:
        print(line, file=sys.stderr)
    print(f"archives: {len(found)} violations")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
