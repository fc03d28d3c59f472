"""Promises over many tasks and problems: avoidance, completion, and the pseudo-inverse's effort."""

from __future__ import annotations

from functools import partial

import numpy as np
import pandas as pd

from .....control.neural.network_settings import NetworkSettings
from .....control.operations import exact_cost, network_cost, pseudo_inverse_cost
from .....control.settings import RowForm
from .....ledger import REGISTRY, Assumed, Generally, Result, Share
from .....view.shares import shares_figure
from ...problems import recorded
from ...studies.tasks import SETTINGS, TASKS

checks = partial(REGISTRY.checks, page="patent/avoidance")
_nearly_all = partial(Generally, at_least="nearly_all", margin="margin")


@checks(
    "patent.claim_avoids",
    rules=[
        _nearly_all("free", "colliding random tasks without contact, by the exact QP"),
        _nearly_all("kept", "and with d2 kept"),
        _nearly_all("network_free", "without contact, by the network"),
        _nearly_all("network_kept", "and with d2 kept"),
    ],
)
def avoids(assumed: Assumed) -> Result:
    """Colliding random tasks on which the arms stay clear, by the exact QP and by the network."""
    table = colliding_tasks(assumed)
    form, least = assumed["avoidance_form"], SETTINGS["inner"] - assumed["reading_noise"]
    exact = "slack" if assumed["infeasible_policy"] == "slack_on_task" else form
    columns = {"exact": table[f"{exact}_distance"], "network": table["network_distance"]}
    free = {name: _count(column > 0.0) for name, column in columns.items()}
    kept = {name: _count(column >= least) for name, column in columns.items()}
    smallest = {
        name: float(table[f"{name}_distance"].min()) for name in (*RowForm, "slack", "network")
    }
    faster = int((table["network_beyond_speed"] > 0.0).sum())
    yields = "the task yields" if exact == "slack" else "the motion stops"
    return Result(
        obtained={
            "free": free["exact"],
            "kept": kept["exact"],
            "network_free": free["network"],
            "network_kept": kept["network"],
            "smallest": smallest,
            "network_beyond_speed": faster,
        },
        table=pd.DataFrame(smallest.items(), columns=["reading", "smallest distance [m]"]),
        caption=(
            f"Of {len(table)} random tasks that collide without avoidance, "
            f"{free['exact']['count']} are free of contact with the exact QP ({yields} where it "
            f"has to) and {kept['exact']['count']} keep d2 = {1e3 * SETTINGS['inner']:g} mm to "
            f"{1e3 * assumed['reading_noise']:g} mm; the smallest distance is "
            f"{1e3 * columns['exact'].min():.1f} mm. The document's own solver, the network, runs "
            f"to its end on {int(table['network_completed'].sum())} of them, whatever it does to "
            f"the arms: {free['network']['count']} are free of contact, "
            f"{kept['network']['count']} keep d2, the smallest distance is "
            f"{1e3 * smallest['network']:.0f} mm, and on {faster} tasks joints exceed their speed "
            "limits. Its inequalities are penalties and the task is an equality, so that the "
            "avoidance yields where they exclude each other."
        ),
    )


@checks(
    "patent.claim_task_completed",
    rules=[
        _nearly_all(
            "done", "tasks that joint limits alone allow, completed accurately by the exact QP"
        ),
        _nearly_all(
            "network_done", "the same by the network, without contact and within the speed limits"
        ),
    ],
)
def completes(assumed: Assumed) -> Result:
    """Share of the colliding random tasks that are completed, among those the limits allow."""
    every = colliding_tasks(assumed)
    table = every[every["limits_completed"].astype(bool)]
    bound, form = assumed["accuracy_bound"], assumed["avoidance_form"]
    done = {
        name: _count(table[f"{name}_completed"].astype(bool) & (table[f"{name}_error"] <= bound))
        for name in (*RowForm, "slack")
    }
    chosen = done["slack" if assumed["infeasible_policy"] == "slack_on_task" else form]
    network = _count(
        table["network_completed"].astype(bool)
        & (table["network_error"] <= bound)
        & (table["network_distance"] > 0.0)
        & (table["network_beyond_speed"] <= 0.0)
    )
    large = float((table["slack_error"] > 1e-2).mean())
    shares = {
        _WORDS[name]: {"exact QP": Share.of(done[name]["count"], len(table))} for name in RowForm
    }
    counted = counted_tasks(assumed)
    return Result(
        obtained={
            "done": chosen,
            "network_done": network,
            "tasks": len(counted),
            "colliding": len(every),
            "beyond_limits": len(every) - len(table),
            "completed": {name: value["count"] for name, value in done.items()},
            "off_by_a_centimetre_with_slack": large,
        },
        table=pd.DataFrame(
            [(name, *_quality(table, name)) for name in RowForm],
            columns=[
                "reading",
                "completed",
                "median peak acceleration [rad/s^2]",
                "median energy [rad^2/s]",
            ],
        ),
        caption=(
            f"Of {len(counted)} random tasks within reach {len(every)} collide without avoidance "
            f"({len(every) / len(counted):.1%}); {len(every) - len(table)} of these fail with the "
            f"joint limits alone, whatever the avoidance. Of the other {len(table)} the exact QP "
            f"completes {done['pair_normal']['count']} accurately and the network, counted where "
            f"it neither touches nor exceeds a speed limit, {network['count']}; in the others task "
            "and avoidance exclude each other at some instant. Where the task then yields, "
            f"{large:.0%} leave the path by more than a centimetre. The scheme looks no step "
            "ahead. The other readings of J_N complete "
            + ", ".join(f"{done[name]['count']} ({_WORDS[name]})" for name in tuple(RowForm)[1:])
            + "."
        ),
        alt="Bars with the share of colliding tasks completed by each of five readings of the "
        "avoidance rows.",
        figure=lambda: shares_figure(shares, "share of the colliding tasks that are completed"),
    )


@checks(
    "patent.claim_pinv_slow",
    rules=[
        _nearly_all(
            "slower",
            "problems on which the pseudo-inverse takes more operations than either solver",
        ),
    ],
)
def slow_pseudo_inverse(assumed: Assumed) -> Result:
    """Operations of the pseudo-inverse against the cheaper of the exact QP and a network step."""
    problems, network = recorded(100), NetworkSettings(penalty="quadratic")
    own = [pseudo_inverse_cost(p).total() for p in problems]
    steps = [network_cost(p, network).total() for p in problems]
    exact = [exact_cost(p).total() for p in problems]
    slower = sum(a > min(b, c) for a, b, c in zip(own, steps, exact, strict=True))
    return Result(
        obtained={
            "slower": {"count": slower, "of": len(problems)},
            "pseudo_inverse": float(np.median(own)),
            "network_step": float(np.median(steps)),
            "exact": float(np.median(exact)),
        },
        caption=(
            f"For the same {len(problems)} problems the pseudo-inverse takes {np.median(own):.0f} "
            f"operations in the median, a step of the network {np.median(steps):.0f} and the exact "
            f"QP {np.median(exact):.0f}: it is slower than the cheaper of the two on {slower} of "
            "them. What it lacks is constraints, not speed."
        ),
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


def colliding_tasks(assumed: Assumed) -> pd.DataFrame:
    """Those of them that collide without avoidance."""
    table = counted_tasks(assumed)
    return table[table["collides"].astype(bool)].infer_objects()


def _count(chosen: pd.Series) -> dict[str, int]:
    return {"count": int(chosen.sum()), "of": len(chosen)}


def _quality(table: pd.DataFrame, form: str) -> tuple[int, float, float]:
    done = table[table[f"{form}_completed"].astype(bool)]
    return (
        len(done),
        float(done[f"{form}_acceleration"].median()),
        float(done[f"{form}_energy"].median()),
    )
