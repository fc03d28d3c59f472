"""How a search from both ends of `qiu` is judged: its halves beside print, and its path."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
import pandas as pd

from ...ledger import REGISTRY, Bounded, Is, NoOriginal, Result, Rounds
from ...ledger.captions import Caption
from ...ledger.rules import Rule
from ...planning.search.search_plan import SearchPlan
from ...view.search_curves import coordinate_figure, joint_figure
from .document import FACE_VALUE, PRINTED, full_step

#: The halves of a search, as print names them.
HALVES = ("forward", "backward")
NO_CURVES = NoOriginal("curves", "the curves")
#: Rules for the joints of a smoothed path, and the last one for its flange.
JOINT_RULES = [
    Bounded("largest_step", "largest step of a joint on the smoothed path [rad]", high="two_steps"),
    NO_CURVES,
]
TIP_STEP = Bounded("largest_step", "largest step of the flange on the path [m]", high="two_steps")
#: Columns of tables.
JOINT_COLUMNS = [f"q{j}_deg" for j in range(1, 7)]
TIP_COLUMNS = ["x_m", "y_m", "z_m"]


def by_half(values: Iterable[Any]) -> dict[str, Any]:
    """Two values by the half that each belongs to."""
    return dict(zip(HALVES, values, strict=True))


def count_rules(joined: str) -> list[Rule]:
    """Rules for the printed numbers of searches; ``joined`` says that the halves meet."""
    counts = [Rounds(half, f"searches of the {half} half", to=half) for half in HALVES]
    return [*counts, Is("joined", joined, value=True)]


def meeting_rules(joined: str) -> list[Rule]:
    """Rules for the printed ends of the halves."""
    ends = [
        Bounded(
            f"steps_from_print.{half}",
            f"end of the {half} half from the printed one, in steps of the straight arm's flange",
            high="near",
        )
        for half in HALVES
    ]
    return [*ends, Is("joined", joined, value=True)]


def outcome(plan: SearchPlan, printed: np.ndarray, searches: np.ndarray) -> dict[str, Any]:
    """How a search came out, and where its halves end beside print (2, 3) [m].

    With it the mean step, and the least one with which halves of the printed numbers of
    ``searches`` (2,) can meet: alpha_mean >= (|q_goal - q_start| - tolerance) / (n_1 + n_2).
    """
    pairs = zip(plan.ends, printed, strict=True)
    problem, halves = plan.problem, plan.record.paths
    steps = [np.linalg.norm(np.diff(half, axis=0), axis=1) for half in halves]
    straight = float(np.linalg.norm(problem.goal - problem.start))
    least = (straight - problem.settings.ending.tolerance) / float(searches.sum())
    return {
        "mean_step_over_alpha0": float(np.mean(steps)) / PRINTED.alpha0,
        "least_mean_step_over_alpha0": least / PRINTED.alpha0,
        "reason": str(plan.reason),
        "searches": plan.searches,
        "ends": [end.tolist() for end in plan.ends],
        "gap_tip": float(np.linalg.norm(plan.ends[0] - plan.ends[1])),
        "distance_to_print": [float(np.linalg.norm(end - point)) for end, point in pairs],
    }


def tally(fit: pd.DataFrame) -> dict[str, Any]:
    """What a declared fit tried, and how near print its readings come [m]."""
    sums = {key: int(fit[key].sum()) for key in ("tried", "joined", "counted")}
    return sums | {"nearest": float(fit["nearest"].min()), "calibrated": float(fit["error"].min())}


def near_print(item_id: str) -> float:
    """How near a printed end counts as met [m], by the threshold of an item in steps."""
    limits = REGISTRY.look(item_id, "thresholds").thresholds
    return limits["near"].value * full_step()


def fit_witness(fit: pd.DataFrame, within: float) -> list[dict[str, Any]]:
    """The reading that the fit prefers, which has the printed number of searches, as a witness for
    ends of the halves ``within`` a distance of the printed ones [m]."""
    index = fit["error"].idxmin()
    row = {str(key): value for key, value in fit.loc[index].items()}
    holds = row["error"] <= within
    verdict = "holds" if holds else "fails"
    return [{"choice": f"fit, cell {index}", "verdict": verdict, "values": row}]


def counted(face: dict[str, Any], other: dict[str, Any], fit: pd.DataFrame) -> dict[str, Any]:
    """What the rules for the numbers look at, from the outcomes of both readings and the fit."""
    return {
        "fit": tally(fit),
        **dict.fromkeys(HALVES, face["searches"]),
        "joined": face["reason"] == "reached",
        "face_value": face,
        "calibrated": other,
    }


def met(face: dict[str, Any], other: dict[str, Any], printed: np.ndarray) -> dict[str, Any]:
    """What the rules for the ends look at, from the outcomes of both readings."""
    return {
        **by_half(face["ends"]),
        "steps_from_print": by_half(gap / full_step() for gap in face["distance_to_print"]),
        "joined": face["reason"] == "reached",
        "gap_tip": face["gap_tip"],
        "printed_gap_tip": float(np.linalg.norm(np.subtract(*printed))),
        "distance_to_print": face["distance_to_print"],
        "calibrated": other,
    }


def joints_of(
    paths: Mapping[str, np.ndarray],
    plans: Iterable[SearchPlan],
    told: Caption,
    alt: str,
    **more: Any,
) -> Result:
    """Joint angles on the smoothed paths (N, 6) [rad] of both readings, and what is obtained
    ``more``; the rules look at face value."""
    plans = list(plans)
    face, junctions = paths[FACE_VALUE], [plan.searches + 0.5 for plan in plans]
    return Result(
        obtained={
            "largest_step": float(np.abs(np.diff(face, axis=0)).max()),
            **more,
            "range_deg": np.rad2deg(np.ptp(face, axis=0)).tolist(),
        },
        table=pd.DataFrame(np.rad2deg(face), columns=JOINT_COLUMNS),
        caption=told,
        alt=alt,
        figure=lambda: joint_figure(
            paths,
            junctions,
            ends={"start": (0, plans[0].problem.start)}
            | {
                f"goal, {name}": _at_end(path, plan.problem.goal)
                for (name, path), plan in zip(paths.items(), plans, strict=True)
            },
        ),
    )


def _at_end(path: np.ndarray, point: np.ndarray) -> tuple[int, np.ndarray]:
    return len(path) - 1, point


def coordinates_of(
    tips: Mapping[str, np.ndarray],
    errors: Mapping[str, float],
    halves: np.ndarray,
    task: Mapping[str, np.ndarray],
    told: Caption,
    alt: str,
) -> Result:
    """Flanges (N, 3) [m] along the smoothed paths of both readings, with the printed ends of the
    halves (2, 3) [m], the printed start and goals of the ``task`` (3,) and the ``errors`` of the
    path at its ends."""
    tip = tips[FACE_VALUE]
    marks = {f"printed, {half}": end for half, end in by_half(halves).items()}
    return Result(
        obtained={
            **errors,
            "largest_step": float(np.linalg.norm(np.diff(tip, axis=0), axis=1).max()),
            "lowest": {name: float(rows[:, 2].min()) for name, rows in tips.items()},
        },
        table=pd.DataFrame(tip, columns=TIP_COLUMNS),
        caption=told,
        alt=alt,
        figure=lambda: coordinate_figure(
            tips,
            marks,
            "sample of the path",
            {n: (0, p) if "start" in n else _at_end(tip, p) for n, p in task.items()},
        ),
    )
