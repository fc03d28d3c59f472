"""The verdict on an item over all declared choices of what is not printed, with its witnesses."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

from ..datafiles import opened
from .evaluation import Evaluation
from .files import through_json
from .influence import first_order
from .registry import Registry
from .robustness import NOT_COMPUTABLE, SEED, judged, miss, study_of, varied
from .shares import Share
from .verdict import Verdict

if TYPE_CHECKING:
    import pandas as pd

#: A statement that decides an item without an original, the gravest first.
_PRECEDENCE = (
    Verdict.INCONSISTENT,
    Verdict.NOT_REPRODUCED,
    Verdict.UNDECIDABLE,
    Verdict.UNDER_ASSUMPTION,
    Verdict.REPRODUCED,
)


@dataclass(frozen=True)
class Settled:
    """The verdict, and what it was settled with.

    Attributes
    ----------
    witnesses
        Choices of the assumptions with the verdict they give and the values that were judged.
    robustness
        Share of the draws, smallest flip and influence; None without stored draws.
    search
        How a witness was looked for where none was found.
    decided_by
        The statement that decided an item without an original.
    draws
        ``none`` where nothing varies, else the status of the stored draws.
    """

    verdict: Verdict
    witnesses: list[dict[str, Any]] = field(default_factory=list)
    robustness: dict[str, Any] | None = None
    search: dict[str, Any] | None = None
    decided_by: str | None = None
    draws: str = "none"


def settle(registry: Registry, evaluation: Evaluation, verdict_of: Callable[[str], str]) -> Settled:
    """Settle the verdict on an evaluated item.

    A statement about one run is possible (``reproduced-under-assumption``) if any declared choice
    meets print, else ``not-reproduced``. One that claims more is ``undecidable`` where declared
    choices disagree. Choices are the draws that are stored for the item, and the witnesses that the
    computation found in a study of its own. An item without an original takes the verdict of a
    statement that decides it.

    Parameters
    ----------
    verdict_of
        Gives the settled verdict of another item.
    """
    item = evaluation.item
    draws, table = stored(registry, evaluation.item_id)
    own = evaluation.verdict
    found = Settled(own, draws=draws)
    if evaluation.result is not None:
        if own in (Verdict.NOT_REPRODUCED, Verdict.UNDER_ASSUMPTION, Verdict.UNDECIDABLE):
            found = replace(_over_choices(evaluation, table), draws=draws)
        found = replace(found, robustness=robustness(registry, evaluation, found.verdict, table))
    if own is Verdict.REGENERATED and item.statements:
        verdicts = {name: verdict_of(name) for name in item.statements}
        for grave in _PRECEDENCE:
            deciding = [name for name, verdict in verdicts.items() if verdict == grave]
            if deciding:
                return replace(found, verdict=grave, decided_by=deciding[0])
    return found


def stored(registry: Registry, item_id: str) -> tuple[str, pd.DataFrame | None]:
    """Status and table of the stored draws of an item; no table if they are not of this code."""
    study = study_of(registry, item_id)
    if study is None:
        return "none", None
    opened(study.meta_path)
    opened(study.table_path)
    status = study.status()
    if status != "up to date":
        return status, None
    table = study.load()
    return (status, table) if (table["kind"] == "draw").any() else ("none", table)


def _over_choices(evaluation: Evaluation, table: pd.DataFrame | None) -> Settled:
    own, result = evaluation.verdict, evaluation.result
    nominal = {
        "choice": "nominal",
        "verdict": str(own),
        "values": {},
        "judged": judged(evaluation),
    }
    given = [dict(entry) for entry in (result.witnesses if result else ())]
    if own is Verdict.UNDECIDABLE:
        return Settled(own, given)
    tried = [] if table is None else _tried(table)
    met = [entry for entry in tried if entry.pop("met")]
    missed = [entry for entry in tried if entry not in met]
    met = [entry for entry in given if entry["verdict"] == "holds"] + met
    missed = [entry for entry in given if entry["verdict"] == "fails"] + missed
    if evaluation.item.scope == "general":
        other = met if own is Verdict.NOT_REPRODUCED else missed
        if other:
            return Settled(Verdict.UNDECIDABLE, _distinct([nominal, other[0], *given]))
        return Settled(own, [nominal, *given], search=_search(evaluation, table))
    if own is Verdict.UNDER_ASSUMPTION:
        return Settled(own, [nominal, *given])
    if met:
        return Settled(Verdict.UNDER_ASSUMPTION, _distinct([met[0], *given]))
    return Settled(own, given, search=_search(evaluation, table))


def _distinct(witnesses: list[dict[str, Any]]) -> list[dict[str, Any]]:
    return [entry for k, entry in enumerate(witnesses) if entry not in witnesses[:k]]


def _tried(table: pd.DataFrame) -> list[dict[str, Any]]:
    """Every choice that was evaluated and is stored: draws first, then flips, then climbs."""
    found = []
    for index, row in table.iterrows():
        if isinstance(row["values"], str) and row["verdict"] != NOT_COMPUTABLE:
            found.append(
                {
                    "choice": f"{row['kind']} {index}",
                    "verdict": row["verdict"],
                    "values": json.loads(row["values"]),
                    "judged": json.loads(row["judged"]),
                    "met": bool(row["met"]),
                }
            )
    return found


def _search(evaluation: Evaluation, table: pd.DataFrame | None) -> dict[str, Any] | None:
    """How a witness was looked for: method, evaluations and the nearest miss."""
    if table is None:
        return None
    draws, climbs = table[table["kind"] == "draw"], table[table["kind"] == "search"]
    rows = table[table["miss"].notna() & table["values"].notna()]
    nearest = {"choice": "nominal", "values": {}, "miss": miss(evaluation)}
    if len(rows) and rows["miss"].min() < nearest["miss"]:
        best = rows["miss"].idxmin()
        nearest = {
            "choice": f"{rows.loc[best, 'kind']} {best}",
            "values": json.loads(rows.loc[best, "values"]),
            "miss": float(rows.loc[best, "miss"]),
        }
    return {
        "method": "draws and climbs" if len(climbs) else "draws",
        "directed": bool(len(climbs)),
        "evaluations": len(draws) + int(climbs["evaluations"].sum() if len(climbs) else 0),
        "nearest": nearest,
    }


def robustness(
    registry: Registry, evaluation: Evaluation, verdict: Verdict, table: pd.DataFrame | None
) -> dict[str, Any] | None:
    """What the draws of a table say: shares, smallest flip, influence; None without draws."""
    if table is None:
        return None
    draws = table[table["kind"] == "draw"]
    if not len(draws):
        return None
    item, paper = evaluation.item, registry.paper_of(evaluation.item_id)
    entries = {key: paper.assumptions[key] for key in item.assumptions}
    met = draws["met"].astype(bool).to_numpy()
    misses = verdict in (Verdict.NOT_REPRODUCED, Verdict.INCONSISTENT)
    holds = (draws["verdict"] == str(verdict)).to_numpy() if misses else met
    share, meets = Share.of(holds.sum(), len(holds)), Share.of(met.sum(), len(met))
    values = [json.loads(text) for text in draws["values"]]
    influence = {
        key: index
        for key in varied(entries)
        if (index := first_order([row[key] for row in values], met, SEED)) is not None
    }
    return through_json(
        {
            "holds": share.value,
            "samples": len(draws),
            "interval": [share.low, share.high],
            "meets_print": {"share": meets.value, "interval": [meets.low, meets.high]},
            "not_computable": int((draws["verdict"] == NOT_COMPUTABLE).sum()),
            "varied": list(varied(entries)),
            "flip": _smallest_flip(table, entries),
            "influence": dict(sorted(influence.items(), key=lambda pair: -pair[1])),
        }
    )


def robustness_of_draws(registry: Registry, item_id: str, samples: int) -> dict[str, Any] | None:
    """Robustness from so many draws, made now and not stored; None without assumptions.

    Raises
    ------
    InputError
        ``samples`` is not positive.
    """
    import pandas as pd

    from .evaluation import evaluate

    study = study_of(registry, item_id, samples)
    if study is None:
        return None
    rows = [{**cell, **study.cell(k, cell)} for k, cell in enumerate(study.cells())]
    evaluation = evaluate(registry, item_id)
    return robustness(registry, evaluation, evaluation.verdict, pd.DataFrame(rows))


def _smallest_flip(table: pd.DataFrame, entries: Mapping[str, Any]) -> dict[str, Any] | None:
    rows = table[(table["kind"] == "change") & table["change"].notna()]
    if not len(rows):
        return None
    row = rows.loc[rows["change"].astype(float).idxmin()]
    key = row["assumption"]
    return {
        "assumption": key,
        "nominal": entries[key].value,
        "value": json.loads(row["values"])[key],
        "change": float(row["change"]),
        "verdict": row["verdict"],
    }
