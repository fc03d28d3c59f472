"""The public record of an item: what `show`, `list`, the book and the exports give away."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

from platformdirs import user_cache_path

from ..errors import OutputError
from .evaluation import Evaluation, evaluate, prove
from .files import to_json, write_text
from .fingerprint import fingerprint
from .registry import Registry
from .robustness import robustness

#: Environment variable: folder of the record cache, or ``off``.
CACHE_VARIABLE = "DUALARM_CACHE"


def cache_folder() -> Path | None:
    """Folder of cached records for exactly this source, data and library versions."""
    chosen = os.environ.get(CACHE_VARIABLE)
    if chosen == "off":
        return None
    root = Path(chosen) if chosen else user_cache_path("dualarm_repro")
    return root / fingerprint()[:32]


def record(registry: Registry, item_id: str) -> dict[str, Any]:
    """The record of an item, from the cache if nothing it depends on has changed."""
    registry.item(item_id)
    folder = cache_folder()
    path = folder / f"{item_id}.json" if folder else None
    if path is not None and path.is_file():
        return json.loads(path.read_text(encoding="utf-8"))
    made = compose(registry, evaluate(registry, item_id))
    text = to_json(made)
    if path is not None:
        try:
            write_text(path, text)
        except OutputError:
            pass  # a cache that cannot be written only costs time
    return json.loads(text)


def compose(registry: Registry, evaluation: Evaluation) -> dict[str, Any]:
    """Build the record of an evaluated item."""
    item, result = evaluation.item, evaluation.result
    paper = registry.paper_of(evaluation.item_id)
    robust = robustness(registry, evaluation.item_id)
    change = evaluation.checker.change if evaluation.checker else None
    return {
        "id": evaluation.item_id,
        "paper": paper.document.id,
        "kind": str(item.kind),
        "title": item.title,
        "place": item.place,
        "role": item.role,
        "printed": item.printed,
        "unit": item.unit,
        "obtained": result.obtained if result else None,
        "measured": result.measured if result else None,
        "verdict": str(evaluation.verdict),
        "checks": evaluation.checks(),
        "change": change,
        "caption": result.caption if result else None,
        "alt": result.alt if result else None,
        "assumptions": [
            {"id": key, **paper.assumptions[key].model_dump(exclude_none=True)}
            for key in item.assumptions
        ],
        "errata": [erratum_record(registry, key) for key in registry.errata_of(evaluation.item_id)],
        "missing": item.missing,
        "notes": item.notes,
        "pending": item.pending,
        "robustness": robust.as_json() if robust else None,
    }


def erratum_record(registry: Registry, erratum_id: str) -> dict[str, Any]:
    """The public record of an erratum: its text, and its proof run now."""
    erratum, proof = registry.errata[erratum_id], prove(registry, erratum_id)
    return {
        "id": erratum_id,
        **erratum.model_dump(exclude_none=True),
        "proof": None
        if proof is None
        else {"statement": proof.statement, "holds": proof.holds, "values": proof.values},
    }
