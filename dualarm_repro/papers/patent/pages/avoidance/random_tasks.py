"""Promises over many tasks and problems: avoidance, completion, and the pseudo-inverse's effort."""

from __future__ import annotations

from functools import partial

import numpy as np
import pandas as pd

from .....control.motion import FOLLOWED
from .....control.neural.network_settings import NetworkSettings
from .....control.operations import exact_cost, network_cost, pseudo_inverse_cost
from .....control.settings import RowForm
from .....instrument import Cost
from .....ledger import REGISTRY, Assumed, Generally, Result, Share
from .....ledger.captions import captions
from .....tracking import memo
from .....view.shares import shares_figure
from ...problems import recorded
from ...studies.tasks import SETTINGS, TASKS

checks = partial(REGISTRY.checks, page="patent/avoidance")
caption = captions(__file__)
_nearly_all = partial(Generally, at_least="nearly_all", margin="margin")


@checks(
    "patent.claim_avoids",
    rules=[
        _nearly_all("free", "admitted random tasks without contact, by the exact QP"),
        _nearly_all("kept", "and with d2 kept"),
        _nearly_all("network_free", "without contact, by the network"),
        _nearly_all("network_kept", "and with d2 kept"),
    ],
)
def avoids(assumed: Assumed) -> Result:
    """Admitted random tasks on which the arms stay clear, by the exact QP and by the network."""
    table, exact = admitted_tasks(assumed), _exact(assumed)
    least = SETTINGS["inner"] - assumed["reading_noise"]
    found: dict[str, dict[str, int]] = {}
    for name, solver in (("", exact), ("network_", "network"), ("guarded_", "guarded")):
        distance = table[f"{solver}_distance"]
        found |= {f"{name}free": _count(distance > 0.0), f"{name}kept": _count(distance >= least)}
    solvers = (*RowForm, "slack", "calm", "network", "guarded")
    smallest = {name: float(table[f"{name}_distance"].min()) for name in solvers}
    beyond = {
        "speed": table["network_beyond_speed"] > 0.0,
        "angle": table["network_beyond_angle"] > 0.0,
    }
    rough = {name: float(table[f"{name}_roughness"].max()) for name in ("slack", "calm")}
    return Result(
        obtained={
            **found,
            "smallest": smallest,
            "network_beyond_speed": int(beyond["speed"].sum()),
            "network_beyond_angle": int(beyond["angle"].sum()),
            "roughness": rough,
        },
        table=pd.DataFrame(
            [(name, *_worst(table, name)) for name in solvers],
            columns=["solver", *_WORST],
        ),
        caption=caption(
            "claim_avoids",
            exact=exact,
            inner=SETTINGS["inner"],
            assumed=assumed,
            ran=int(table["network_finished"].sum()),
            calm=SETTINGS["calm"],
        ),
    )


@checks(
    "patent.claim_task_completed",
    rules=[
        _nearly_all(
            "done", "tasks that joint limits alone allow, completed accurately by the exact QP"
        ),
        _nearly_all("network_done", "the same by the network, within distance and limits"),
    ],
)
def completes(assumed: Assumed) -> Result:
    """Share of the admitted tasks that are completed, and what the others fail by."""
    every, table = colliding_tasks(assumed), admitted_tasks(assumed)
    bound, counted = assumed["accuracy_bound"], counted_tasks(assumed)
    done = {name: _count(_accurate(table, name, bound)) for name in _SOLVERS}
    alone = every[_alone(every)]
    shares = {
        words: {"exact QP": Share.of(done[name]["count"], len(table))}
        for name, words in _WORDS.items()
    }
    given = {
        "limits": Share.of(done["pair_normal"]["count"], len(table)),
        "avoidance": Share.of(int(_accurate(alone, "pair_normal", bound).sum()), len(alone)),
    }
    failed = {
        "limits_alone": len(every) - len(table),
        "avoidance_alone": int((~_alone(every)).sum()),
        "by_either": int((~_alone(every)).sum() - (~_alone(table)).sum()),
        "only_together": int((_alone(table) & ~_accurate(table, "pair_normal", np.inf)).sum()),
    }
    return Result(
        obtained={
            "done": done[_exact(assumed)],
            "network_done": done["network"],
            "guarded_done": done["guarded"],
            "set": int(TASKS.load()["set"].sum()),
            "tasks": len(counted),
            "colliding": len(every),
            "failed": failed,
            "given": {name: [one.value, one.low, one.high] for name, one in given.items()},
            "completed": {name: value["count"] for name, value in done.items()},
            "off_by_a_centimetre_with_slack": float((table["slack_error"] > 1e-2).mean()),
        },
        table=pd.DataFrame(
            [(name, *_quality(table, name)) for name in _SOLVERS],
            columns=["solver", "completed", *_QUALITIES],
        ),
        caption=caption("claim_task_completed", words=_WORDS),
        alt="Bars with the share of admitted tasks completed by each of five readings of the "
        "avoidance rows.",
        figure=lambda: shares_figure(shares, "share of the admitted tasks that are completed"),
    )


@checks(
    "patent.claim_pinv_slow",
    samples=8,
    rules=[
        _nearly_all(
            "slower",
            "problems on which the pseudo-inverse takes more operations than either solver",
        )
    ],
)
def slow_pseudo_inverse(assumed: Assumed) -> Result:
    """Operations of the pseudo-inverse against the cheaper of the exact QP and a network step."""
    factor = assumed["pseudo_inverse_factor"]
    cost = assumed["function_cost"]
    counted = _operations(singular_values=factor == "singular_values")
    own, steps, exact = ([one.total(cost) for one in each] for each in counted)
    slower = sum(a > min(b, c) for a, b, c in zip(own, steps, exact, strict=True))
    return Result(
        obtained={
            "slower": {"count": slower, "of": len(own)},
            "pseudo_inverse": float(np.median(own)),
            "network_step": float(np.median(steps)),
            "exact": float(np.median(exact)),
        },
        caption=caption("claim_pinv_slow", factor=factor),
    )


@memo()
def _operations(*, singular_values: bool) -> tuple[tuple[Cost, ...], ...]:
    """Costs of the pseudo-inverse, of a network step and of the exact QP on each problem."""
    network = NetworkSettings(penalty="quadratic")
    counted = (
        (
            pseudo_inverse_cost(p, singular_values=singular_values),
            network_cost(p, network),
            exact_cost(p),
        )
        for p in recorded(100)
    )
    return tuple(zip(*counted, strict=True))


_QUALITIES = ("largest tip error [m]", "median peak acceleration [rad/s^2]")
_WORST = ("smallest distance [m]", "largest tip error [m]", "peak acceleration [rad/s^2]",
          "rms acceleration [rad/s^2]", "beyond speed limit [rad/s]")  # fmt: skip
_SOLVERS = (*RowForm, "slack", "calm", "network", "guarded")
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


def admitted_tasks(assumed: Assumed) -> pd.DataFrame:
    """Those among them that joint limits alone, without the avoidance rows, allow."""
    table = colliding_tasks(assumed)
    return table[table["limits_finished"].astype(bool) & (table["limits_error"] <= FOLLOWED)]


def _alone(table: pd.DataFrame) -> pd.Series:
    """Tasks that the avoidance rows alone, without joint limits, allow."""
    return table["alone_finished"].astype(bool) & (table["alone_error"] <= FOLLOWED)


def _accurate(table: pd.DataFrame, name: str, bound: float) -> pd.Series:
    """Tasks completed, none of the bounds broken, with the tips within a bound [m]."""
    return table[f"{name}_completed"].astype(bool) & (table[f"{name}_error"] <= bound)


def _exact(assumed: Assumed) -> str:
    """Prefix of the columns of the exact QP: its reading, or with slack."""
    form = assumed["avoidance_form"]
    return "slack" if assumed["infeasible_policy"] == "slack_on_task" else form


def _count(chosen: pd.Series) -> dict[str, int]:
    return {"count": int(chosen.sum()), "of": len(chosen)}


def _worst(table: pd.DataFrame, name: str) -> tuple[float, ...]:
    columns = [
        table[f"{name}_{key}"] for key in ("error", "acceleration", "roughness", "beyond_speed")
    ]
    return (float(table[f"{name}_distance"].min()), *(float(column.max()) for column in columns))


def _quality(table: pd.DataFrame, name: str) -> tuple[int, float, float]:
    done = table[table[f"{name}_completed"].astype(bool)]
    return (
        len(done),
        float(done[f"{name}_error"].max()),
        float(done[f"{name}_acceleration"].median()),
    )
