"""What `xue` claims of its method in words: escapes, success, attraction, quality of paths."""

from __future__ import annotations

from functools import partial
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd

from ....ledger import REGISTRY, Assumed, Bounded, Exceeds, Is, Result
from ....ledger.captions import captions
from ....ledger.shares import Share
from ....ledger.statistical_rules import Generally
from ....tracking import memo
from ....view.shares import shares_figure
from ....view.style import BLACK, BLUE, WIDTH, house_style
from ..document import Layout
from ..motions import points_to_window, present, slave_undisturbed
from ..outcomes import VARIANTS, variant_of
from ..reading import POSITION_TOLERANCE, nominal
from ..stored import is_declared, lottery_table, mean_share, mean_with_interval
from ..studies.ablation import ABLATION, NAMED
from ..studies.paths import PATHS
from ..studies.trials import REPEATED
from .potentials.printed_field import attraction, slope

checks = partial(REGISTRY.checks, page="xue/claims")
caption = captions(__file__)

#: Planner with the virtual point, by when it acts; the others are run in the ablation only.
_SWITCHED = ("replaces_goal", "from_start", "always")
#: What a path is measured by, and the sign of an improvement.
_MEASURES = {
    "tool_path": ("length of the tool's path saved, logarithm", -1.0),
    "bending": ("mean squared curvature of that path saved, logarithm", -1.0),
    "radius": ("radius that all links could have more [m]", 1.0),
    "postures": ("postures looked at saved, logarithm", -1.0),
}


@memo()
def paths_table() -> pd.DataFrame:
    """One row per arrangement: what the path of each method is worth."""
    return PATHS.load()


@checks(
    "xue.claim_virtual_escapes",
    rules=[
        Generally(
            key="freed",
            label="arrangements with Fig. 9 and traps in which it frees half of the trapped runs",
            at_least="mostly",
            margin="margin",
        ),
        Generally(
            key="freed_shown",
            label="the same where the end effectors do what Figs 8 to 11 show",
            at_least="mostly",
            margin="margin",
        ),
        Generally(
            key="spoiled",
            label="arrangements in which more runs miss with it than without",
            at_most="seldom",
            margin="seldom",
        ),
    ],
    samples=16,
)
def virtual_point_escapes(assumed: Assumed) -> Result:
    """Runs trapped without the virtual point, and what becomes of them with it.

    Over both populations of arrangements: those in which Fig. 9 holds, and those of them in which
    the end effectors do what Figs 8 to 11 show, which were run with the point as it is assumed.
    """
    switching, table = assumed["virtual_switching"], _ablation()
    with_it = switching if switching in _SWITCHED else "improved"
    gain = table["without_virtual_missed"] - table[f"{with_it}_missed"]
    return Result(
        obtained={
            "freed": freed(table, with_it),
            "freed_shown": freed(lottery_table(), "improved"),
            "spoiled": {"count": int((gain < 0).sum()), "of": len(table)},
            "runs_trapped": int(table["without_virtual_trapped"].sum()),
            "runs_gained": int(gain.sum()),
            "arrangements": len(table),
            "acts": int(table["improved_used"].sum()),
            "rescues": int(table["improved_rescued"].sum()),
            "nominal": _nominal_counts(),
        },
        caption=caption("claim_virtual_escapes", switching=switching.replace("_", " ")),
        alt="Bars with intervals: share of the trapped runs that the virtual point frees, "
        "mean over arrangements, by when it acts.",
        figure=_freed_figure,
    )


def freed(table: pd.DataFrame, method: str) -> dict[str, int]:
    """Arrangements in which it frees at least half of the runs trapped without the point, of those
    that have such runs."""
    caught = table[table["without_virtual_trapped"] > 0]
    gain = caught["without_virtual_missed"] - caught[f"{method}_missed"]
    mostly = gain >= 0.5 * caught["without_virtual_trapped"]
    return {"count": int(mostly.sum()), "of": len(caught)}


def _ablation() -> pd.DataFrame:
    table = ABLATION.load()
    return table[~table["layout"].isin(NAMED)]


def _nominal_counts() -> dict[str, int]:
    """Trials of the arrangement shown: trapped without the point, it acted, it rescued."""
    table = REPEATED.load()
    columns = {"runs": "improved_runs", "trapped": "without_virtual_trapped",
               "acts": "improved_used", "rescues": "improved_rescued"}  # fmt: skip
    return {name: int(table[column].sum()) for name, column in columns.items()}


def _freed_figure() -> Any:
    table, rows = _ablation(), {}
    for name in ("improved", *_SWITCHED):
        rows[VARIANTS[name].title] = {"freed": mean_share(*_freed_runs(table, name))}
    return shares_figure(rows, "share of trapped runs that arrive with the virtual point")


def _freed_runs(table: pd.DataFrame, name: str) -> tuple[pd.Series, pd.Series]:
    """Runs freed and runs trapped, per arrangement."""
    trapped = table["without_virtual_trapped"]
    gain = (table["without_virtual_missed"] - table[f"{name}_missed"]).clip(lower=0)
    return np.minimum(gain, trapped), trapped


@checks(
    "xue.claim_goal_angles",
    rules=[
        Generally(
            key="at_goal",
            label="runs at the goal angles whose end effector is as near to its goal as assumed",
            at_least="none_beyond",
            margin="margin",
        ),
        Bounded("unavoided", "distance to a bar of the run of Fig. 9, which arrives [m]", low=0.0),
    ],
)
def goal_angles(assumed: Assumed) -> Result:
    """The printed criterion of success, applied to every run there is."""
    table, case = paths_table(), nominal()
    by_angles = table[table["improved_arrives"].astype(bool)]
    near = (by_angles["improved_off_goal"] <= POSITION_TOLERANCE).sum()
    undisturbed = present(slave_undisturbed(case.layout, case.planner), "motion of the slave")
    arrived = table[table["traditional_arrives"].astype(bool)]
    reach = arrived["traditional_off_goal_angles"] <= case.planner.goal_tolerance
    return Result(
        obtained={
            "at_goal": {"count": int(near), "of": len(by_angles)},
            "farthest": float(by_angles["improved_off_goal"].max()),
            "unavoided": float(points_to_window(undisturbed, case.layout).min())
            if undisturbed.reached
            else None,
            "traditional": {"count": int(reach.sum()), "of": len(arrived)},
            "traditional_off_angles": float(arrived["traditional_off_goal_angles"].median()),
        },
        caption=caption("claim_goal_angles", tolerance=POSITION_TOLERANCE),
    )


@checks(
    "xue.claim_attraction_falls",
    rules=[
        Is("falls", "the force of (9), as printed, grows with the distance", value=True),
        Generally(
            key="slave",
            label="improved runs of the slave with the largest attraction at the start",
            at_least="always",
            margin="margin",
        ),
        Generally(
            key="traditional",
            label="the same of traditional runs",
            at_least="always",
            margin="margin",
        ),
        Generally(key="master", label="the same of the master", at_least="always", margin="margin"),
    ],
)
def attraction_falls(assumed: Assumed) -> Result:
    """Force of the goal over the distance, and where it is largest on whole motions."""
    table, forces = paths_table(), _forces()
    rises = {"master": table["master_rise"], "slave": table["improved_rise"],
             "traditional": table["traditional_rise"]}  # fmt: skip
    counts = {
        name: {"count": int((column.dropna() <= 1e-9).sum()), "of": int(column.notna().sum())}
        for name, column in rises.items()
    }
    rows = {name: {"largest at the start": Share.of(**_total(c))} for name, c in counts.items()}
    return Result(
        obtained={
            "falls": bool((np.diff(forces) > 0.0).all()),
            **counts,
            "largest_rise": {name: float(column.max()) for name, column in rises.items()},
        },
        caption=caption("claim_attraction_falls"),
        alt="Bars with intervals: share of motions whose attraction is largest at the start.",
        figure=lambda: shares_figure(rows, "share of motions"),
    )


def _total(counts: dict[str, int]) -> dict[str, int]:
    return {"count": counts["count"], "total": counts["of"]}


def _forces() -> np.ndarray:
    """Size of the slope of (9), as printed, at growing distances from the goal (N,)."""
    goal = np.zeros(3)
    away = np.linspace(0.1, 4.0, 20)[:, np.newaxis] * np.ones(3) / np.sqrt(3.0)
    return np.array([np.linalg.norm(slope(lambda x: attraction(x, goal), x)) for x in away])


@checks(
    "xue.claim_path_quality",
    rules=[
        Exceeds(key=name, label=words, threshold="clearance" if name == "radius" else "gain")
        for name, (words, _) in _MEASURES.items()
    ],
    samples=8,
)
def path_quality(assumed: Assumed) -> Result:
    """Paired differences of four measures over the arrangements in which both methods arrive."""
    reading = assumed["classical_method"]
    differences = gains_of(variant_of(reading))
    found = {name: mean_with_interval(differences[name]) for name in _MEASURES}
    return Result(
        obtained={**found, "arrangements": len(differences)},
        table=differences.reset_index(names="arrangement"),
        caption=caption("claim_path_quality", gains=[_told(k, one) for k, one in found.items()]),
        alt="Mean gain of the improved method with its interval, for four measures of a path.",
        figure=lambda: gains_figure(found),
        witnesses=_witnesses(differences, found),
    )


def gains_of(old: str) -> pd.DataFrame:
    """Advantage of the improved method in every arrangement where both arrive."""
    table = paths_table()
    both = table[table[f"{old}_arrives"].astype(bool) & table["improved_arrives"].astype(bool)]
    columns = {}
    for name, (_, sign) in _MEASURES.items():
        new, before = both[f"improved_{name}"], both[f"{old}_{name}"]
        columns[name] = new - before if name == "radius" else sign * np.log(new / before)
    return pd.DataFrame(columns)


def _told(name: str, one: dict[str, Any]) -> str:
    """A mean gain with its interval in words; a logarithm as the share that is saved or added."""
    better, worse = {
        "tool_path": ("makes paths shorter", "makes paths longer"),
        "bending": ("bends them less", "bends them more"),
        "radius": ("leaves room for thicker links", "leaves room for thinner links"),
        "postures": ("looks at fewer postures", "looks at more postures"),
    }[name]
    sign = 1.0 if one["value"] >= 0.0 else -1.0
    ends = sorted(sign * one[end] for end in ("low", "high"))
    if name == "radius":
        value, low, high = (f"{1e3 * end:z.1f}" for end in (sign * one["value"], *ends))
        unit = "mm"
    else:
        shares = (-100 * sign * np.expm1(-sign * end) for end in (sign * one["value"], *ends))
        value, low, high = (f"{share:z.0f}" for share in shares)
        unit = "%"
    return f"{better if sign > 0 else worse} by {value} {unit} ({low} to {high})"


def gains_figure(found: dict[str, dict[str, Any]]) -> Any:
    """Gains with intervals; the radius has another unit and a panel of its own."""
    told = {"tool_path": "path length", "bending": "bending", "postures": "postures looked at"}
    with house_style():
        figure, (left, right) = plt.subplots(1, 2, figsize=(WIDTH, 2.4), width_ratios=(2.2, 1.0))
        for k, name in enumerate(told):
            one = found[name]
            saved = -100 * np.expm1(-np.array([one["low"], one["value"], one["high"]]))
            _interval(left, saved, k)
        left.set(xlabel="saved by the improved method [%]", yticks=range(len(told)),
                 ylim=(-0.6, len(told) - 0.4))  # fmt: skip
        left.set_yticklabels(list(told.values()))
        one = found["radius"]
        _interval(right, 1e3 * np.array([one["low"], one["value"], one["high"]]), 0)
        right.set(xlabel="links thicker by [mm]", yticks=[], ylim=(-0.6, 0.6))
    return figure


def _interval(ax: Any, ends: np.ndarray, row: float) -> None:
    """An interval (low, value, high) in a row, beside zero."""
    ax.axvline(0.0, color=BLACK, lw=1, ls="--")
    ax.plot(ends[[0, 2]], [row, row], color=BLUE, lw=3)
    ax.plot(ends[1], row, "o", color=BLUE)


def _witnesses(differences: pd.DataFrame, found: dict[str, dict[str, Any]]) -> list[dict[str, Any]]:
    """For every measure that stays open, an arrangement of either kind."""
    table = paths_table()
    table = table[table.index.isin(differences.index)]
    declared = is_declared(table)
    witnesses = []
    for name, one in found.items():
        edge = 0.0 if name == "radius" else _threshold("gain")
        if one["low"] <= edge <= one["high"]:
            column = differences[name].where(declared)
            for k, verdict in ((column.idxmax(), "holds"), (column.idxmin(), "fails")):
                judged = {name: float(column.loc[[k]].iloc[0])}
                row = table.loc[[k], list(Layout.names())].iloc[0]
                values = {n: v.item() if isinstance(v, np.generic) else v for n, v in row.items()}
                where = f"arrangement {k} of {PATHS.name}"
                witnesses.append(
                    {"choice": where, "verdict": verdict, "values": values, "judged": judged}
                )
    return witnesses


def _threshold(name: str) -> float:
    return float(REGISTRY.look("xue.claim_path_quality").thresholds[name].value)
