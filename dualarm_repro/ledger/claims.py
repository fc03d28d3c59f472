"""Numbers of the book as ``repro.yaml``, a manifest that the independent checker `claims` verifies.

`claims` looks each number up in a file pinned by its SHA-256: in ``data/results`` for the manifest
in the root, in the newly computed ``ledger.json`` for that of an export. A number is met when the
value found rounds to the digits stated.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterable, Mapping

import yaml

from .headlines import Statement, pointer_part, statements
from .reference import reference_path

_HEAD = "# Written by `dualarm export` or `make metadata`; check with `claims verify repro.yaml`.\n"


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
    text: str = yaml.safe_dump(content, sort_keys=False, allow_unicode=True, width=100)
    return _HEAD + text


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
        return item.partition(".")[0], f"/items/{pointer_part(item)}/obtained"

    return manifest(stated, files, locate)
