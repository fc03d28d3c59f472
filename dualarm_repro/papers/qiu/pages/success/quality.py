"""What `qiu` says of its paths: smooth, regular, calm, and cheap beside sampling."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np
import pandas as pd

from .....ledger import REGISTRY, Assumed, Generally, Result
from .....ledger.captions import captions
from .....ledger.witnesses import cell_witnesses, one_for_each_side
from .....planning.checks.regularity import Line, follow_line
from .....planning.trials.yardstick import YARDSTICK
from ...document import PRINTED, SEED, placed
from ...reading import JUDGED_BY
from ...studies.quality import METHODS, QUALITY, SPACES

checks = partial(REGISTRY.checks, page="qiu/success")
caption = captions(__file__)
_NAMES = {"joints": "joint space", "tip": "task space"}
_LINES = 600
_SHOWN = ("goal", "goal_seed", "ratio")


def tried(kept: str | None = None, methods: tuple[str, ...] = tuple(METHODS)) -> pd.DataFrame:
    """Tasks of the study that were drawn and, judged by ``kept``, solved by all of ``methods``."""
    table = QUALITY.load()
    table = table[table["drawn"]]
    for method in methods if kept else ():
        table = table[table[f"{method}_{kept}"].astype(bool)]
    return table


def _count(found: pd.Series) -> dict[str, int]:
    return {"count": int(found.sum()), "of": len(found)}


@checks(
    "qiu.claim_smoother",
    rules=[
        Generally(
            f"smoother_{key}",
            f"goals that both methods reach with the smoother path of the improved one, in {space}",
            at_least="half",
            margin="margin",
        )
        for key, space in _NAMES.items()
    ],
)
def smoother(assumed: Assumed) -> Result:
    """Curvature over arc length on the goals that both methods reach, after the same spline."""
    judged = JUDGED_BY[assumed["success_rule"]]
    table = tried(judged)
    ratio = {s: table[f"improved_{s}"] / table[f"traditional_{s}"] for s in SPACES}
    obtained: dict[str, Any] = {f"smoother_{s}": _count(ratio[s] < 1.0) for s in SPACES}
    obtained |= {
        "bending_ratio": {s: float(ratio[s].median()) for s in SPACES},
        "judged_by": judged,
    }
    columns = [f"{method}_{space}" for method in METHODS for space in SPACES]
    return Result(
        obtained=obtained,
        table=table[[*_SHOWN, *columns]].reset_index(drop=True),
        caption=caption("claim_smoother"),
        witnesses=cell_witnesses(
            "qiu.claim_smoother", obtained, table, ratio["joints"] < 1.0, (*_SHOWN, *columns)
        ),
    )


@checks(
    "qiu.claim_regular_position",
    rules=[
        Generally(
            "regular",
            "paths of the improved method whose position Jacobian stays regular",
            at_least="most",
            margin="split",
        )
    ],
)
def regular_position(assumed: Assumed) -> Result:
    """Smallest singular value of the position task on the paths to goals that are reached."""
    limits = REGISTRY.look("qiu.claim_regular_position", "thresholds").thresholds
    judged = JUDGED_BY[assumed["success_rule"]]
    table = tried(judged, ("improved",))
    least = table["improved_singular_value"]
    regular = least >= limits["regular"].value
    obtained = {
        "regular": _count(regular),
        "smallest": float(least.min()),
        "median": float(least.median()),
        "judged_by": judged,
    }
    return Result(
        obtained=obtained,
        caption=caption("claim_regular_position", least=limits["regular"].value),
        witnesses=cell_witnesses(
            "qiu.claim_regular_position",
            obtained,
            table,
            regular,
            (*_SHOWN, "improved_singular_value"),
        ),
    )


@checks(
    "qiu.claim_regular_pose",
    rules=[
        Generally(
            "regular",
            "paths to goals with a bent wrist on which det J keeps its sign",
            at_least="most",
            margin="split",
        )
    ],
)
def regular_pose(assumed: Assumed) -> Result:
    """Singular postures of the whole pose between start and goal, where the wrist is free."""
    judged = JUDGED_BY[assumed["success_rule"]]
    table = tried(judged, ("improved",))
    bent = table[table["bent"].astype(bool)]
    regular = ~bent["improved_crosses"].astype(bool)
    jacobian = placed("master").arm.jacobian(PRINTED.start)
    obtained = {
        "regular": _count(regular),
        "straight": len(table) - len(bent),
        "singular_value_at_the_printed_start": float(np.linalg.svd(jacobian, compute_uv=False)[-1]),
        "judged_by": judged,
    }
    return Result(
        obtained=obtained,
        caption=caption("claim_regular_pose"),
        witnesses=cell_witnesses("qiu.claim_regular_pose", obtained, bent, regular, _SHOWN),
    )


@checks(
    "qiu.claim_no_oscillation",
    rules=[
        Generally(
            "calm",
            "tasks in which the traditional search chatters and no half of the improved one does",
            at_least="most",
            margin="split",
        )
    ],
)
def no_oscillation(assumed: Assumed) -> Result:
    """Chatter of the improved search on the goals at which the traditional one chatters."""
    limits = REGISTRY.look("qiu.claim_no_oscillation", "thresholds").thresholds
    measure, bar = assumed["oscillation_measure"], limits["chatters"].value
    table = tried()
    loud = table[table[f"traditional_{measure}"] >= bar]
    calm = ~(loud[f"improved_{measure}"] >= bar)
    obtained = {"calm": _count(calm), "tasks": len(table), "measure": measure}
    return Result(
        obtained=obtained,
        caption=caption("claim_no_oscillation"),
        witnesses=cell_witnesses(
            "qiu.claim_no_oscillation",
            obtained,
            loud,
            calm,
            (*_SHOWN, f"traditional_{measure}", f"improved_{measure}"),
        ),
    )


@checks(
    "qiu.claim_cheaper",
    rules=[
        Generally(
            "cheaper",
            "goals that both reach with fewer evaluations of the improved search than RRT-Connect",
            at_least="half",
            margin="margin",
        )
    ],
)
def cheaper(assumed: Assumed) -> Result:
    """Evaluations of the field against states that RRT-Connect checks, to the same goals."""
    judged = JUDGED_BY[assumed["success_rule"]]
    both = tried(judged, ("improved", YARDSTICK))
    made, states = both["improved_evaluations"], both[f"{YARDSTICK}_evaluations"]
    everything = tried()
    obtained = {
        "cheaper": _count(made < states),
        "median": {"improved": float(made.median()), "RRT-Connect": float(states.median())},
        "checked": _count(made + both["improved_check"] < states),
        "reached": {
            name: int(everything[f"{method}_truth"].sum())
            for name, method in (("improved", "improved"), ("RRT-Connect", YARDSTICK))
        },
        "tasks": len(everything),
        "judged_by": judged,
    }
    shown = (*_SHOWN, "improved_evaluations", f"{YARDSTICK}_evaluations")
    ratio = (both["improved_time"] / both[f"{YARDSTICK}_time"]).median()
    return Result(
        obtained=obtained,
        measured={"time_over_rrt_connect": float(ratio)},
        table=both[list(shown)].reset_index(drop=True),
        caption=caption("claim_cheaper"),
        witnesses=cell_witnesses("qiu.claim_cheaper", obtained, both, made < states, shown),
    )


@checks(
    "qiu.claim_cartesian_singular",
    rules=[
        Generally(
            "broken",
            "straight lines of the flange that inverse kinematics cannot follow",
            at_least="often",
            margin="margin",
        )
    ],
)
def cartesian_lines(assumed: Assumed) -> Result:
    """Straight lines between random postures, followed by inverse kinematics without limits."""
    arm, rng = placed("master").arm, np.random.default_rng(SEED)
    low, high = (np.clip(limit, -np.pi, np.pi) for limit in (arm.lower, arm.upper))
    found = [follow_line(arm, *rng.uniform(low, high, (2, len(low)))) for _ in range(_LINES)]
    ends = {str(line): found.count(line) for line in Line}
    broken = len(found) - ends[str(Line.FOLLOWED)]
    return Result(
        obtained={"broken": {"count": broken, "of": len(found)}, "ends": ends},
        caption=caption("claim_cartesian_singular"),
        witnesses=one_for_each_side(
            (f"line {k}", line is not Line.FOLLOWED, {"outcome": str(line)})
            for k, line in enumerate(found)
        ),
    )
