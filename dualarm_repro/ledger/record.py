"""The public record of an item: what `show`, `list`, the book and the exports give away."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

from ..errors import DataFileError, LedgerError
from ..sources import graph
from ..tracking import note, recording
from . import kept
from .evaluation import Evaluation, evaluate, prove
from .files import through_json
from .registry import Registry

_KIND = "records"
#: Modules that shape a record beside those that compute and judge.
_SHAPING = tuple(
    f"dualarm_repro.ledger.{name}"
    for name in ("evaluation", "influence", "record", "robustness", "settled", "shares", "study")
)


def record(registry: Registry, item_id: str) -> dict[str, Any]:
    """The record of an item, kept from before if nothing it depends on has changed.

    Raises
    ------
    UnknownNameError
        No such item.
    """
    registry.look(item_id)
    found = kept.read(registry, _KIND, item_id)
    if found is None:
        found = make(registry, item_id)[0]
    note(*found["inputs"])
    return located(found["record"])


def record_or_reason(registry: Registry, item_id: str) -> dict[str, Any]:
    """The record; where it cannot be had, what is declared, with the reason under ``unavailable``.

    A stored study that is stale or damaged takes the verdict from the items that rest on it, and
    nothing from all the others.

    Raises
    ------
    UnknownNameError
        No such item.
    """
    registry.look(item_id)
    try:
        return record(registry, item_id)
    except (LedgerError, DataFileError) as error:
        return {**_declared(registry, item_id), "verdict": None, "unavailable": str(error)}


def make(registry: Registry, item_id: str) -> tuple[dict[str, Any], Evaluation]:
    """Compute the record of an item now and keep it; with the evaluation behind it."""
    with recording() as inputs:
        evaluation = evaluate(registry, item_id)
        made = compose(registry, evaluation)
    entry = through_json({"record": made, "inputs": sorted(inputs)})
    kept.keep(registry, _KIND, item_id, entry, roots(registry, item_id), inputs)
    return entry, evaluation


def roots(registry: Registry, item_id: str) -> set[str]:
    """Modules whose closure the record of an item depends on."""
    from .closure import module_of
    from .robustness import roots_of

    proofs = (registry.proof(key) for key in registry.errata_of(item_id))
    found = {*_SHAPING, *roots_of(registry, item_id), *(module_of(p) for p in proofs if p)}
    for name in registry.look(item_id).statements:
        found |= roots(registry, name)
    return found


def compose(
    registry: Registry,
    evaluation: Evaluation,
    verdict_of: Callable[[str], str] | None = None,
) -> dict[str, Any]:
    """Build the record of an evaluated item.

    Parameters
    ----------
    verdict_of
        Gives the settled verdict of another item; default that of its record.
    """
    from .settled import settle

    def by_record(item_id: str) -> str:
        return str(record(registry, item_id)["verdict"])

    item_id, result, checker = evaluation.item_id, evaluation.result, evaluation.checker
    item, paper = registry.item(item_id), registry.paper_of(item_id)
    settled = settle(registry, evaluation, verdict_of or by_record)
    name = paper.document.id
    note(*(f"papers/{name}.yaml#assumptions.{key}" for key in (*item.assumptions, *item.context)))
    note(*(f"papers/{name}.yaml#errata.{key.partition('.')[2]}"
           for key in registry.errata_of(item_id)))  # fmt: skip

    return {
        **_declared(registry, item_id),
        "obtained": result.obtained if result else None,
        "measured": result.measured if result else None,
        "verdict": str(settled.verdict),
        "checks": evaluation.checks(),
        "change": checker.change if checker else None,
        "caption": result.told() if result else None,
        "alt": result.alt if result else None,
        "errata": [erratum_record(registry, key) for key in registry.errata_of(item_id)],
        "decided_by": settled.decided_by,
        "witnesses": settled.witnesses,
        "search": settled.search,
        "robustness": settled.robustness,
        "draws": settled.draws,
        "code": _code(checker.compute, result.figure if result else None) if checker else None,
    }


def _declared(registry: Registry, item_id: str) -> dict[str, Any]:
    """The record as far as nothing has to be computed; each of its keys has its place."""
    item, paper = registry.item(item_id), registry.paper_of(item_id)
    checker = registry.checker(item_id)

    def entries(keys: Iterable[str]) -> list[dict[str, Any]]:
        return [{"id": key, **paper.assumptions[key].model_dump(exclude_none=True)} for key in keys]

    return {
        "id": item_id,
        "paper": paper.document.id,
        "kind": str(item.kind),
        "title": item.title,
        "place": item.place,
        "role": item.role,
        "scope": item.scope,
        "printed": item.printed,
        "unit": item.unit,
        "obtained": None,
        "measured": None,
        "verdict": None,
        "checks": [],
        "change": None,
        "caption": None,
        "alt": None,
        "assumptions": entries(item.assumptions),
        "context": entries(item.context),
        "thresholds": {key: entry.model_dump() for key, entry in item.thresholds.items()},
        "errata": [],
        "missing": item.missing,
        "notes": item.notes,
        "pending": item.pending,
        "statements": item.statements,
        "decided_by": None,
        "witnesses": [],
        "search": None,
        "seek": item.seek,
        "robustness": None,
        "draws": "none",
        "code": None,
        "page": checker.page if checker else None,
        "url": f"{checker.page}.html#{item_id}" if checker else None,
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


def _code(compute: Callable[..., Any], figure: Callable[..., Any] | None) -> dict[str, Any]:
    """Module and function of the checker, and of the function that draws its figure."""
    drawing = _drawing(figure) if figure else None
    return {
        "module": compute.__module__,
        "function": compute.__qualname__,
        "figure": {"module": drawing.__module__, "function": drawing.__qualname__}
        if drawing
        else None,
    }


def _drawing(figure: Callable[..., Any]) -> Callable[..., Any]:
    """The function of the library that a closure over its data calls to draw."""
    while hasattr(figure, "func"):
        figure = figure.func
    if figure.__name__ != "<lambda>":
        return figure
    called = (figure.__globals__.get(name) for name in figure.__code__.co_names)
    drawers = [f for f in called if ".view." in getattr(f, "__module__", "") and callable(f)]
    return drawers[0] if drawers else figure


def located(made: dict[str, Any]) -> dict[str, Any]:
    """A record whose ``code`` names file and line as they are now.

    An edit that moves a function down the file changes no value, so the line is not kept.
    """
    code = made["code"]
    if code is None:
        return made
    figure = code["figure"]
    place = _place(code) | {"figure": _place(figure) if figure else None}
    return {**made, "code": place}


def _place(code: dict[str, Any]) -> dict[str, Any]:
    module, function = code["module"], code["function"]
    if module not in graph().files:
        return {"file": module, "function": function, "line": None}
    file = module.replace(".", "/")
    suffix = "/__init__.py" if graph().files[module].name == "__init__.py" else ".py"
    lines = graph().module(module).lines
    outer = function.partition(".<locals>")[0]
    return {
        "file": file + suffix,
        "function": function,
        "line": lines.get(function, lines.get(outer)),
    }
