"""Promises over many tasks and problems: avoidance, completion, and the pseudo-inverse's effort."""

from __future__ import annotations

from functools import partial

import numpy as np
import pandas as pd

from .....control.neural.network_settings import NetworkSettings
from .....control.operations import exact_cost, network_cost, pseudo_inverse_cost
from .....control.settings import RowForm
from .....ledger import REGISTRY, Assumed, Generally, Result, Share
from .....ledger.captions import captions
from .....view.shares import shares_figure
from ...problems import recorded
from ...studies.tasks import SETTINGS, TASKS

checks = partial(REGISTRY.checks, page="patent/avoidance")
caption = captions(__file__)
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
    table, exact = colliding_tasks(assumed), _exact(assumed)
    least = SETTINGS["inner"] - assumed["reading_noise"]
    found: dict[str, dict[str, int]] = {}
    for name, solver in (("", exact), ("network_", "network")):
        distance = table[f"{solver}_distance"]
        found |= {f"{name}free": _count(distance > 0.0), f"{name}kept": _count(distance >= least)}
    smallest = {
        name: float(table[f"{name}_distance"].min()) for name in (*RowForm, "slack", "network")
    }
    faster, ran = (table["network_beyond_speed"] > 0.0).sum(), table["network_completed"].sum()
    return Result(
        obtained={**found, "smallest": smallest, "network_beyond_speed": int(faster)},
        table=pd.DataFrame(smallest.items(), columns=["reading", "smallest distance [m]"]),
        caption=caption(
            "claim_avoids", exact=exact, inner=SETTINGS["inner"], assumed=assumed, ran=int(ran)
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
    bound, counted = assumed["accuracy_bound"], counted_tasks(assumed)
    done = {
        name: _count(table[f"{name}_completed"].astype(bool) & (table[f"{name}_error"] <= bound))
        for name in (*RowForm, "slack")
    }
    network = _count(
        table["network_completed"].astype(bool)
        & (table["network_error"] <= bound)
        & (table["network_distance"] > 0.0)
        & (table["network_beyond_speed"] <= 0.0)
    )
    shares = {
        _WORDS[name]: {"exact QP": Share.of(done[name]["count"], len(table))} for name in RowForm
    }
    return Result(
        obtained={
            "done": done[_exact(assumed)],
            "network_done": network,
            "tasks": len(counted),
            "colliding": len(every),
            "beyond_limits": len(every) - len(table),
            "completed": {name: value["count"] for name, value in done.items()},
            "off_by_a_centimetre_with_slack": float((table["slack_error"] > 1e-2).mean()),
        },
        table=pd.DataFrame(
            [(name, *_quality(table, name)) for name in RowForm],
            columns=["reading", "completed", *_QUALITIES],
        ),
        caption=caption("claim_task_completed", words=_WORDS),
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
        )
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
        caption=caption("claim_pinv_slow"),
    )


_QUALITIES = ("median peak acceleration [rad/s^2]", "median energy [rad^2/s]")
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


def _exact(assumed: Assumed) -> str:
    """Prefix of the columns of the exact QP: its reading, or with slack."""
    form = assumed["avoidance_form"]
    return "slack" if assumed["infeasible_policy"] == "slack_on_task" else form


def _count(chosen: pd.Series) -> dict[str, int]:
    return {"count": int(chosen.sum()), "of": len(chosen)}


def _quality(table: pd.DataFrame, form: str) -> tuple[int, float, float]:
    done = table[table[f"{form}_completed"].astype(bool)]
    return (
        len(done),
        float(done[f"{form}_acceleration"].median()),
        float(done[f"{form}_energy"].median()),
    )
