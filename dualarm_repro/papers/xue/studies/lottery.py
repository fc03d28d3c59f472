"""The layout lottery: random arrangements in which all figures hold, and both methods there.

Bases, window and its opening are not printed. One arrangement can be found for nearly any outcome
of Table 2; the share of arrangements that show it says what the printed facts alone imply. What is
drawn are arrangements in which Fig. 9 holds; those in which Figs 8, 10 and 11 hold as well go on to
the trials.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, replace
from typing import Any

import numpy as np
import pandas as pd

from ....ledger import REGISTRY, Study
from ....ledger.assumptions import Chosen
from ....scene import facing
from ....tracking import memo
from .. import motions
from ..document import Layout, assumptions, slave_end, slave_start
from ..outcomes import DESCENTS, READINGS, TRIALS, VARIANTS, clear_starts, outcomes, variant_of
from ..reading import KEPT, Case, nominal

LAYOUTS = 1000
#: Ranges of the uniform draws, metres; the rest of an arrangement is as assumed.
RANGES: dict[str, Any] = {
    "master_about_meeting": 0.3,
    "slave_base_y": (-1.2, 2.0),
    "smallest_base_distance": 0.5,
    "window_about_midpoint": 0.45,
    "opening_width": (0.4, 1.2),
    "opening_height": (0.35, 1.2),
    "bar": (0.05, 0.15),
    "normals": ("x", "y", "chord"),
    "undisturbed_steps": 100,
}
#: Columns that hold counts where there are trials.
_COUNTS = ("_runs", "_missed", "_trapped", "_stationary", "_held", "_used", "_rescued", "touching")
#: Assumptions of a study that draws arrangements and starts.
DRAWN_WITH = ("meeting_distance", "trial_perturbation")


def draw(rng: np.random.Generator, given: Case) -> Layout:
    """A random arrangement in which the arms are likely to meet.

    An instant k is drawn; the master's base is put where its undisturbed end effector passes the
    straight line from Start to End at that instant, and is then moved by up to
    ``master_about_meeting`` along each axis. The slave stands beside it.
    """
    like = given.layout
    master = motions.master_undisturbed(like, given.planner).tcp - like.master_base
    k = int(rng.integers(len(master)))
    share = min(k / RANGES["undisturbed_steps"], 1.0)
    about, spread = RANGES["master_about_meeting"], RANGES["window_about_midpoint"]
    start, end = slave_start(), slave_end()
    base = start + share * (end - start) - master[k] + rng.uniform(-about, about, 3)
    beside = rng.uniform(*RANGES["slave_base_y"])
    centre = 0.5 * (start + end) + rng.uniform(-spread, spread, 3)
    return replace(
        like,
        **{f"master_base_{axis}": c for axis, c in zip("xyz", base.tolist(), strict=True)},
        base_distance=float(base[1] - beside),
        **{f"window_centre_{axis}": c for axis, c in zip("xyz", centre.tolist(), strict=True)},
        window_normal=str(rng.choice(RANGES["normals"])),
        window_opening_width=rng.uniform(*RANGES["opening_width"]),
        window_opening_height=rng.uniform(*RANGES["opening_height"]),
        window_bar=rng.uniform(*RANGES["bar"]),
    )


def fig_9_holds(case: Case, meeting: float) -> bool:
    """Whether the undisturbed slave enters a bar and meets the master on its way past the window.

    Its control points have to be outside the bars at Start and End, or nothing could be planned.
    """
    layout = case.layout
    if layout.base_distance < RANGES["smallest_base_distance"]:
        return False
    slave = motions.slave_undisturbed(layout, case.planner)
    if slave is None or not slave.reached or not enters_bar(slave.tcp, layout):
        return False
    if motions.points_to_window(slave, layout, case.planner.control_points)[[0, -1]].min() <= 0.0:
        return False
    replay = motions.replay_of(case, slave)
    return replay is not None and bool(replay.apart(moving=True).min() <= meeting)


def enters_bar(track: np.ndarray, layout: Layout) -> bool:
    """Whether a point of a track (N, 3) lies in a bar of the window."""
    way, bar = facing(layout.normal), layout.window_bar
    inside = np.abs((track - layout.window_centre) @ way)
    half = 0.5 * np.array([*layout.opening, 0.0]) + np.array([bar, bar, 0.5 * bar])
    within = (inside <= half).all(axis=1)
    through = (inside[:, :2] < 0.5 * np.array(layout.opening)).all(axis=1)
    return bool((within & ~through).any())


def random_case(meeting: float, rng: np.random.Generator) -> tuple[Case, int, int]:
    """An arrangement in which Fig. 9 holds and the slave can rest at its goal.

    Also the number of draws, and how many of those with Fig. 9 were left because window or parked
    master repel the slave at its goal, so that (13)-(16) cannot end there.
    """
    given, draws, repelled = nominal(), 0, 0
    while True:
        draws += 1
        case = given._replace(layout=draw(rng, given))
        if not fig_9_holds(case, meeting):
            continue
        if not repelled_at_goal(case):
            return case, draws, repelled
        repelled += 1


def lottery_cell(settings: Mapping[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    """Both methods, the traditional one in every reading, from the same ten starts that are clear.

    Without trials where Figs 8, 10 or 11 do not hold.
    """
    meeting = settings["meeting_distance"]
    case, draws, repelled = random_case(meeting, rng)
    row = {"draws": draws, "goal_repelled": repelled, **asdict(case.layout), **motion_row(case)}
    row["figures_hold"] = figures_hold(row, meeting)
    if not row["figures_hold"]:
        return row
    begin, touching = clear_starts(case, settings["trial_perturbation"], TRIALS, rng)
    row["starts_touching"] = touching
    for name in map(variant_of, READINGS):
        plan = VARIANTS[name].plan(case)
        if plan is not None and plan.reached:
            row |= {f"{name}_tool_path": plan.tcp_length, f"{name}_joint_path": plan.length}
    methods = (*map(variant_of, READINGS), "without_virtual", "improved")
    return row | outcomes(case, methods, begin)


def figures_hold(row: Mapping[str, Any], meeting: float) -> bool:
    """Whether the end effectors do what Figs 8, 10 and 11 show: arrive, clear of all they avoid."""
    return bool(
        row["master_distance"] > 0.0
        and row["slave_reason"] == "reached"
        and row["slave_flange_window"] > 0.0
        and row["flanges_apart"] > meeting
    )


def motion_row(case: Case) -> dict[str, Any]:
    """Figs 8, 10 and 11 in one arrangement: ends, distances of points and of link cores [m]."""
    layout, planner, points = case.layout, case.planner, case.planner.control_points
    first = motions.present(motions.master_plan(layout, planner), "plan of the master")
    alone, slave = motions.master_undisturbed(layout, planner), motions.slave_plan(case)
    row: dict[str, Any] = {
        "master_steps": first.steps,
        "master_distance": motions.points_to_window(first, layout, points).min(),
        "master_undisturbed": motions.points_to_window(alone, layout, points).min(),
        "slave_reason": "start-collides" if slave is None else str(slave.reason),
    }
    if slave is None:
        return row
    replay = motions.present(motions.replay_of(case, slave), "motion of the master")
    cores = motions.cores_of(replay, layout)
    to_bars = cores.between("slave", "window")
    return row | {
        "slave_steps": slave.steps,
        "improved_tool_path": slave.tcp_length,
        "improved_joint_path": slave.length,
        "slave_points": slave.clearance.min(),
        "slave_flange_window": replay.to_obstacles().min(),
        "flanges_apart": replay.apart().min(),
        **{f"cores_{name}": value for name, value in motions.smallest_cores(cores).items()},
        "cores_start": to_bars[0],
        "cores_goal": to_bars[-1],
        "nearest_link": cores.nearest("slave", "window")[0],
    }


def repelled_at_goal(case: Case) -> bool:
    """Whether window or parked master repels the slave at its goal: it cannot rest there."""
    made = VARIANTS["improved"].problem(case)
    return made.repels_at_goal(len(made.obstacles.cores) - 1)


def _cells() -> list[dict[str, Any]]:
    return [{"layout": k, **assumptions(*DRAWN_WITH)} for k in range(LAYOUTS)]


LOTTERY = REGISTRY.keeps(
    Study(
        name="xue_lottery",
        title="Random arrangements in which the figures hold: outcome of every method, "
        "clearance of links",
        cells=_cells,
        compute=lottery_cell,
        compared=DESCENTS,
        seed=20200344,
        settings=Chosen("xue", (*KEPT, *DRAWN_WITH), ranges=True, layouts=LAYOUTS, trials=TRIALS),
    )
)


@memo()
def drawn_table() -> pd.DataFrame:
    """One row per random arrangement in which Fig. 9 holds."""
    return LOTTERY.load()


@memo()
def lottery_table() -> pd.DataFrame:
    """One row per random arrangement in which Figs 8 to 11 hold."""
    drawn = drawn_table()
    table = drawn[drawn["figures_hold"]].reset_index(names="drawn")
    counted = [name for name in table if name.endswith(_COUNTS)]
    return table.astype(dict.fromkeys(counted, int))
