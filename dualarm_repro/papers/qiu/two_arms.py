"""Master and slave of `qiu`: the plan of both, and its execution in step and out of step."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...ledger import Assumed
from ...planning.checks.contact_check import ContactCheck, contact_check
from ...planning.search.bidirectional_compiled import plan_bidirectional_compiled
from ...planning.search.search_plan import SearchPlan
from ...planning.search.time_map import along_path, hull_tracks, replay, time_map
from ...tracking import memo
from .document import FACE_VALUE, PRINTED, RECONSTRUCTION, dual_scene, placed, repelling
from .reading import Hull, Improved, SlaveGoal, Splice


@dataclass(frozen=True)
class Slave(Improved, Splice, Hull, SlaveGoal):
    """The search of the slave around the hull of the moving master, and that of the master."""

    schedule_steps: float
    slave_obstacles: str
    floor: str

    def dual_plan(self) -> DualPlan:
        """Both arms from their starts to their goals."""
        return _dual_plan(self)


@dataclass(frozen=True, eq=False)
class DualPlan:
    """Master and slave: their reading, their searches and their smoothed paths (N, 6) [rad]."""

    reading: Slave
    master: SearchPlan
    slave: SearchPlan
    master_path: np.ndarray
    slave_path: np.ndarray

    @property
    def spread(self) -> int:
        """Searches of the slave over which the master's path is spread."""
        return round(self.reading.schedule_steps)


@memo(512)
def _dual_plan(reading: Slave) -> DualPlan:
    master = reading.plan()
    path, spread = reading.smooth(master.path), round(reading.schedule_steps)
    slave = plan_bidirectional_compiled(
        placed("slave"),
        PRINTED.start,
        reading.slave_posture(),
        repelling(reading.floor == "half_space", reading.slave_obstacles != "master"),
        reading.settings(),
        hull_tracks(reading.arm(), path, reading.circles(), spread),
    )
    return DualPlan(reading, master, slave, path, reading.smooth(slave.path))


def dual_readings(assumed: Assumed) -> dict[str, DualPlan]:
    """Both arms at face value and in the reconstruction."""
    reading = Slave.of(assumed)
    return {FACE_VALUE: reading.dual_plan(), RECONSTRUCTION: reading.reconstructed().dual_plan()}


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
    plan: DualPlan, how: str = "time map", shift: int = 0, radii: tuple[float, ...] | None = None
) -> ContactCheck:
    """Contact of whole links while both arms move."""
    master, slave = both_arms(plan, how, shift)
    scene = dual_scene(plan.reading.master_goal, radii)
    return contact_check(scene, scene.stack(master=master, slave=slave))
