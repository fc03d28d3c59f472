"""The claims that the arms avoid each other and finish their task, over random tasks."""

from __future__ import annotations

from functools import partial

import pandas as pd
from scipy.stats import binomtest

from ...control.settings import FORMS
from ...ledger import REGISTRY, Assumed, Bounded, Result
from ...view.control_figures import shares_figure
from .comparison import AVOIDANCE
from .random_tasks import TASKS
from .scenario import COARSE_STEP, crossing, run, settings_of

checks = partial(REGISTRY.checks, page="patent/avoidance")


@checks(
    "patent.claim_avoids",
    samples=32,
    rules=[
        Bounded(key="distance", low=0.0, label="smallest distance on the frozen task [m]"),
        Bounded(key="smallest_of_all", low=0.0, label="and on every colliding random task [m]"),
    ],
)
def avoids(assumed: Assumed) -> Result:
    """Contact is excluded, on the frozen task and on all colliding random tasks."""
    scenario = crossing(assumed, "base_distance", "duration", "capsules")
    motion = run(scenario, settings_of(assumed, *AVOIDANCE), COARSE_STEP)
    table = _colliding(assumed)
    smallest = {name: float(table[f"{name}_distance"].min()) for name in (*FORMS, "slack")}
    chosen = smallest[assumed["avoidance_form"]]
    return Result(
        obtained={
            "distance": motion.smallest_distance,
            "smallest_of_all": min(chosen, smallest["slack"]),
            "smallest": smallest,
            "colliding_tasks": len(table),
        },
        table=pd.DataFrame(smallest.items(), columns=["reading", "smallest distance [m]"]),
        caption=(
            f"On the frozen task the arms stay {1e3 * motion.smallest_distance:.1f} mm apart. Of "
            f"the random tasks {len(table)} collide without avoidance; with it none does: the "
            f"smallest distance of all is {1e3 * chosen:.1f} mm where the motion may stop, and "
            f"{1e3 * smallest['slack']:.1f} mm where the task yields instead and joints run at "
            "their speed limits. Above d2 standing still satisfies every row."
        ),
    )


@checks(
    "patent.claim_task_completed",
    rules=[
        Bounded(key="colliding", low=20, label="random tasks that collide without avoidance"),
        Bounded(key="share", low=1.0, label="share of them completed with it"),
    ],
    samples=2,
)
def completes(assumed: Assumed) -> Result:
    """Share of the colliding random tasks that each reading completes."""
    table = _colliding(assumed)
    done = {name: int(table[f"{name}_completed"].sum()) for name in FORMS}
    accurate = table["slack_error"] <= assumed["accuracy_bound"]
    stops = assumed["infeasible_policy"] == "stop"
    share = done["pair_normal"] / len(table) if stops else float(accurate.mean())
    large = float((table["slack_error"] > 1e-2).mean())
    shares = {_WORDS[name]: _interval(done[name], len(table)) for name in FORMS}
    counted = counted_tasks(assumed)
    return Result(
        obtained={
            "tasks": len(counted),
            "colliding": len(table),
            "share": float(share),
            "completed": done,
            "slack_completed": int(table["slack_completed"].sum()),
            "off_by_a_centimetre_with_slack": large,
        },
        table=pd.DataFrame(
            [(name, *_quality(table, name)) for name in FORMS],
            columns=[
                "reading",
                "completed",
                "median peak acceleration [rad/s^2]",
                "median energy [rad^2/s]",
            ],
        ),
        caption=(
            f"Of {len(counted)} random tasks within reach {len(table)} collide without avoidance "
            f"({len(table) / len(counted):.1%}). The QP completes {done['pair_normal']} of these; "
            "in the others task and avoidance exclude each other at some instant. Where the task "
            f"then yields, {int(table['slack_completed'].sum())} run to their end, {share:.0%} of "
            f"all within the tip error taken for accurate, while {large:.0%} leave the path by "
            "more than a centimetre. The scheme looks no step ahead, so completion is no property "
            "of it. The other readings of J_N complete "
            + ", ".join(f"{done[name]} ({_WORDS[name]})" for name in FORMS[1:])
            + "."
        ),
        alt="Bars with the share of colliding tasks completed by each of five readings of the "
        "avoidance rows.",
        figure=lambda: shares_figure(shares),
    )


_WORDS = {
    "pair_normal": "relative, along the normal",
    "arm_normal": "other arm standing still, along the normal",
    "pair_axes": "relative, signs per axis",
    "arm_axes": "other arm standing still, signs per axis",
    "pair_components": "relative, components of the normal",
}


def counted_tasks(assumed: Assumed) -> pd.DataFrame:
    """Random tasks within reach among the assumed number of draws."""
    table = TASKS.load().iloc[: int(assumed["task_selection"])]
    return table[table["counts"].astype(bool)]


def _colliding(assumed: Assumed) -> pd.DataFrame:
    table = counted_tasks(assumed)
    return table[table["collides"].astype(bool)].infer_objects()


def _interval(count: int, total: int) -> tuple[float, float, float]:
    interval = binomtest(count, total).proportion_ci(method="wilson")
    return count / total, interval.low, interval.high


def _quality(table: pd.DataFrame, form: str) -> tuple[int, float, float]:
    done = table[table[f"{form}_completed"].astype(bool)]
    return (
        len(done),
        float(done[f"{form}_acceleration"].median()),
        float(done[f"{form}_energy"].median()),
    )
