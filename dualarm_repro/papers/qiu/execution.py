"""Executing master and slave together: replays of the time map, and variants out of step."""

from __future__ import annotations

import numpy as np

from ...planning.checks.contact_check import ContactCheck, contact_check
from ...planning.search.time_map import along_path, replay, time_map
from ...scene import Scene
from ...tracking import memo
from .readings import DualPlan, master_arm
from .scenario import placed, truth_scene


@memo(8)
def dual_scene(radii: tuple[float, ...] | None = None, master_goal: str = "pulled_back") -> Scene:
    """Both arms, spheres and table; links of other radii, the master as its goal is read."""
    master = master_arm({"master_goal": master_goal}, radii)
    return truth_scene([master, placed("slave", radii=radii)])


def both_arms(
    plan: DualPlan, how: str = "time map", shift: int = 0
) -> tuple[np.ndarray, np.ndarray]:
    """Paths (M, 6) of master and slave on common samples.

    ``time map``: as planned; ``uniform``: the master goes at constant speed while the slave moves;
    ``shift``: the master is this many samples ahead of the time map.
    """
    share = time_map(plan.slave, plan.spread)
    if how == "uniform":
        share = np.linspace(0.0, 1.0, len(share))
        return along_path(plan.master_path, share), plan.slave_path
    pace = 0.5 / plan.spread
    return replay(
        plan.master_path, plan.slave_path, np.clip(share + shift * pace, 0.0, 1.0), plan.spread
    )


def executed(
    plan: DualPlan,
    how: str = "time map",
    shift: int = 0,
    radii: tuple[float, ...] | None = None,
) -> ContactCheck:
    """Contact of whole links while both arms move."""
    master, slave = both_arms(plan, how, shift)
    scene = dual_scene(radii, plan.master_goal)
    return contact_check(scene, scene.stack(master=master, slave=slave))
