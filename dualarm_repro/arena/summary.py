"""What the arena says: shares with intervals, failures by class, lengths against the best.

A failure is never left out: it counts as a task that is not done, as a path without end, and as all
evaluations used up.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pandas as pd

from ..ledger.shares import Share
from .judged import Outcome
from .study import CONTESTANTS, EVALUATIONS, WITNESS

#: Columns that name a task.
TASK = ("kind", "group", "subject", "number")
#: Drawings of the tasks with replacement from which intervals of means come, and their seed.
_RESAMPLED, _SEED = 2000, 15
#: Columns of the time of the processor.
CLOCK = ("quarter [s]", "median [s]", "three quarters [s]")
#: Shift of the geometric mean of evaluations, as in benchmarks of solvers [evaluations].
SHIFT = 100.0


def contest(table: pd.DataFrame) -> pd.DataFrame:
    """The rows of the contestants on tasks, with whether somebody has shown that it can be done.

    A task is feasible if the witness, or any contestant, has a certified path; column
    ``feasible``. Tasks with an end in contact or beyond limits are no tasks and are left out.
    """
    rows = table[table["outcome"] != Outcome.NO_TASK]
    success = rows["outcome"] == Outcome.SUCCESS
    feasible = success.groupby([rows[key] for key in TASK]).transform("any")
    return rows.assign(success=success, feasible=feasible)[rows["method"] != WITNESS]


def methods_of(rows: pd.DataFrame) -> list[str]:
    """Those that ran, in the order of the list."""
    there = list(dict.fromkeys(rows["method"]))
    return [name for name in CONTESTANTS if name in there] + [
        name for name in there if name not in CONTESTANTS
    ]


def success_table(rows: pd.DataFrame) -> pd.DataFrame:
    """Certified successes of each method on feasible tasks, with the interval of Wilson.

    Columns ``tasks``, ``share``, ``low``, ``high``, and ``claimed``: the share of tasks in which
    the planner itself says that it arrived.
    """
    found = {}
    for name in methods_of(rows):
        mine = rows[(rows["method"] == name) & rows["feasible"]]
        share = Share.of(int(mine["success"].sum()), len(mine))
        claimed = float(mine["claim"].mean()) if len(mine) else np.nan
        found[name] = {"tasks": len(mine), **share._asdict(), "claimed": claimed}
    return pd.DataFrame.from_dict(found, orient="index").rename(columns={"value": "share"})


def outcome_counts(rows: pd.DataFrame) -> pd.DataFrame:
    """How often each method ended in each way, on all tasks; methods by outcomes."""
    counts = pd.crosstab(rows["method"], rows["outcome"])
    columns = [str(one) for one in Outcome if one != Outcome.NO_TASK]
    return counts.reindex(index=methods_of(rows), columns=columns, fill_value=0)


def profile(rows: pd.DataFrame, column: str, ratios: np.ndarray) -> pd.DataFrame:
    """Share of the feasible tasks that a method does within a ratio of the best, by ratio.

    E. D. Dolan and J. J. More, Benchmarking optimization software with performance profiles,
    Math. Programming 91, 2002. The best is the smallest value of any success on the task; a
    failure has no ratio and never counts.
    """
    mine = rows[rows["feasible"]]
    value = mine[column].where(mine["success"], np.inf)
    best = value.groupby([mine[key] for key in TASK]).transform("min")
    ratio = value / best
    found = {
        name: [float((ratio[mine["method"] == name] <= most).mean()) for most in ratios]
        for name in methods_of(rows)
    }
    return pd.DataFrame(found, index=pd.Index(ratios, name="ratio"))


def effort(rows: pd.DataFrame, most: int = EVALUATIONS) -> pd.DataFrame:
    """Shifted geometric mean of the evaluations on feasible tasks, with its interval.

    exp(mean ln(e + s)) - s; a failure counts as ``most`` evaluations, or its own if it took more.
    The interval of 95 % comes from drawing the tasks again with replacement. Columns ``quarter
    [s]``, ``median [s]``, ``three quarters [s]``: of the time of the processor of all runs.
    """
    rng, found = np.random.default_rng(_SEED), {}
    for name in methods_of(rows):
        mine = rows[(rows["method"] == name) & rows["feasible"]]
        spent = mine["evaluations"].to_numpy(dtype=float)
        spent = np.where(mine["success"], spent, np.maximum(spent, most))
        logs = np.log(spent + SHIFT)
        drawn = logs[rng.integers(len(logs), size=(_RESAMPLED, len(logs)))].mean(axis=1)
        low, high = np.quantile(drawn, (0.025, 0.975))
        values = np.exp([logs.mean(), low, high]) - SHIFT
        found[name] = dict(zip(("evaluations", "low", "high"), values.tolist(), strict=True))
        clock = mine["time"].dropna().quantile([0.25, 0.5, 0.75])
        found[name] |= dict(zip(CLOCK, clock, strict=True))
    return pd.DataFrame.from_dict(found, orient="index")


def by_group(rows: pd.DataFrame, kind: str, chosen: Sequence[str]) -> pd.DataFrame:
    """Successes of some methods on the feasible tasks of a kind, by group: ``k of n``."""
    found: dict[str, dict[str, str]] = {}
    mine = rows[(rows["kind"] == kind) & rows["feasible"]]
    for group in dict.fromkeys(rows.loc[rows["kind"] == kind, "group"]):
        inside = mine[mine["group"] == group]
        for name in chosen:
            here = inside[inside["method"] == name]["success"]
            found.setdefault(name, {})[group] = f"{int(here.sum())} of {len(here)}"
    return pd.DataFrame.from_dict(found, orient="index")


def lost_tasks(table: pd.DataFrame) -> pd.DataFrame:
    """Tasks counted apart, by kind: with unsound ends, and not shown by anyone to be feasible."""
    tasks = table.drop_duplicates(list(TASK))
    rows = contest(table).drop_duplicates(list(TASK))
    found = {
        kind: {
            "tasks": int((tasks["kind"] == kind).sum()),
            "unsound ends": int(
                ((tasks["kind"] == kind) & (tasks["outcome"] == Outcome.NO_TASK)).sum()
            ),
            "no witness": int(((rows["kind"] == kind) & ~rows["feasible"]).sum()),
        }
        for kind in dict.fromkeys(tasks["kind"])
    }
    return pd.DataFrame.from_dict(found, orient="index").rename_axis("kind")
