"""A contest that is run now and not stored: for a planner of one's own, or a closer look."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any

import pandas as pd

from ..ledger.streams import stream
from .cases import case_of, case_settings
from .judged import Outcome, judged_row
from .study import EVALUATIONS, SEED, known

Each = Callable[[Sequence[str], str], Iterable[str]]


def contest_now(
    methods: Sequence[str],
    kind: str | None = None,
    most: int | None = None,
    each: Each = lambda items, what: items,
    evaluations: int = EVALUATIONS,
) -> pd.DataFrame:
    """Rows of some methods on the first tasks of a kind, as :func:`.summary.contest` gives them.

    No witness runs: every task counts.

    Parameters
    ----------
    each : callable
        Passes the methods on one by one, to show how far it is.

    Raises
    ------
    UnknownNameError
        No such method.
    """
    chosen = {name: known(name) for name in methods}
    settings = [one for one in case_settings() if kind in (None, one["kind"])][:most]
    cases = [(one, case_of(one)) for one in settings]
    rows: list[dict[str, Any]] = []
    for name in each(list(chosen), "arena"):
        for k, (one, case) in enumerate(cases):
            row = judged_row(case, chosen[name], evaluations, stream(SEED, k))
            if row["outcome"] != Outcome.NO_TASK:
                rows.append({**one, "method": name, **row})
    table = pd.DataFrame(rows)
    return table.assign(success=table["outcome"] == Outcome.SUCCESS, feasible=True)
