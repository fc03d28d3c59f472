"""Reference results in ``data/results``: written by one command, compared at every `verify`."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterable
from pathlib import Path
from time import process_time
from typing import Any

from ..datafiles import data_path
from ..errors import DataFileError
from .comparison import Comparison, comparisons
from .drift import differences
from .evaluation import evaluate, prove
from .files import through_json, to_json, write_text
from .registry import Registry
from .settled import settle
from .verdict import Verdict
from .workers import results


def reference_path(paper: str) -> Path:
    """File with the reference results of one document."""
    return data_path("results", f"{paper}.json")


def read_reference(paper: str) -> dict[str, Any]:
    """Reference results of a document; empty if none have been written.

    Raises
    ------
    DataFileError
        The file is there but holds no reference results.
    """
    path = reference_path(paper)
    if not path.is_file():
        return {}
    try:
        found = json.loads(path.read_text(encoding="utf-8"))["items"]
    except (ValueError, KeyError, TypeError) as error:
        raise DataFileError(path, "file", str(error), "reference results as JSON") from None
    if not isinstance(found, dict) or not all(isinstance(v, dict) for v in found.values()):
        raise DataFileError(path, "items", found, "reference results as JSON, by item id")
    return found


def costs_path() -> Path:
    """File with the seconds that each item took when the reference was written."""
    return data_path("results", "costs.json")


def read_costs() -> dict[str, float]:
    """Seconds per item, to start the longest first; empty if none are known."""
    try:
        found = json.loads(costs_path().read_text(encoding="utf-8"))
        return {str(key): float(value) for key, value in found.items()}
    except (OSError, ValueError, AttributeError, TypeError):
        return {}


def outcome(registry: Registry, item_id: str) -> dict[str, Any]:
    """What is compared: verdict, obtained values and the proofs of the errata, as plain JSON."""
    evaluation = evaluate(registry, item_id)
    settled = settle(registry, evaluation, lambda other: outcome(registry, other)["verdict"])
    proofs = {key: prove(registry, key) for key in registry.errata_of(item_id)}
    found = {
        "verdict": str(settled.verdict),
        "obtained": evaluation.result.obtained if evaluation.result else None,
        "proofs": {key: proof.holds for key, proof in proofs.items() if proof},
    }
    return through_json(found)


def declared(registry: Registry, item_id: str) -> list[Comparison]:
    """Values of an item that are compared otherwise than digit by digit."""
    checker = registry.checker(item_id)
    return comparisons(registry.look(item_id), checker.rules if checker else ())


def verify(
    registry: Registry,
    item_ids: Iterable[str],
    *,
    update: bool = False,
    jobs: int = 1,
    progress: bool = False,
    scheduler: str | None = None,
) -> dict[str, Any]:
    """Recompute items from nothing and compare them with the reference.

    Parameters
    ----------
    update
        Rewrite the reference instead.
    jobs, scheduler
        Worker processes on this machine, or the address of a Dask scheduler.

    Returns
    -------
    dict
        ``checked`` (count), ``drifted`` (list of ``{"id", "differences"}``), ``verdicts`` (count
        per verdict) and ``compared`` (list of ``{"id", "path", "how"}``: the values that are not
        compared by digits).
    """
    ids = list(item_ids)
    tasks = ((_outcome, registry.reopen, item_id) for item_id in ids)
    made = results(tasks, len(ids), "verify", jobs, progress, scheduler)
    found, seconds = {}, {}
    for item_id, (one, taken) in zip(ids, made, strict=True):
        found[item_id], seconds[item_id] = one, round(taken, 1)
    papers = {item_id.partition(".")[0] for item_id in found}
    reference = {key: value for paper in papers for key, value in read_reference(paper).items()}
    if update:
        for paper in sorted(papers):
            kept = {**read_reference(paper), **found}
            items = {i: kept[i] for i in registry.items if i in kept and i.startswith(f"{paper}.")}
            write_text(reference_path(paper), to_json({"items": items}))
        write_text(costs_path(), to_json({**read_costs(), **seconds}))
    ways = {item_id: declared(registry, item_id) for item_id in found}
    drifted = [
        {"id": item_id, "differences": lines}
        for item_id, one in found.items()
        if not update and (lines := differences(reference.get(item_id), one, ways[item_id]))
    ]
    compared = [
        {"id": item_id, "path": way.path, "how": way.how}
        for item_id, declared_here in ways.items()
        for way in declared_here
    ]
    counts = Counter(one["verdict"] for one in found.values())
    verdicts = {str(v): counts[v] for v in Verdict if counts[v]}
    return {
        "checked": len(found),
        "drifted": drifted,
        "verdicts": verdicts,
        "compared": compared,
    }


def _outcome(reopen: Any, item_id: str) -> tuple[dict[str, Any], float]:
    start = process_time()
    return outcome(reopen(), item_id), process_time() - start
