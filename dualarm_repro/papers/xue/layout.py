"""The unprinted arrangement: bases, window and postures of the slave, as a scene."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any, Self

import numpy as np
import pinocchio as pin

from ...arms import Arm, load_arm
from ...scene import PlacedArm, Scene, facing, window_frame
from ...tracking import memo
from .postures import posture
from .readings import READINGS
from .scenario import MASTER_GOAL, MASTER_START, SLAVE_END, SLAVE_START


@dataclass(frozen=True)
class Layout:
    """One arrangement; every field is the assumption of that name. Lengths in metres."""

    dh_source: str
    master_base_x: float
    master_base_y: float
    master_base_z: float
    base_distance: float
    window_centre_x: float
    window_centre_y: float
    window_centre_z: float
    window_normal: str
    window_opening_width: float
    window_opening_height: float
    window_bar: float
    slave_frame: str
    slave_postures: str

    @classmethod
    def of(cls, assumed: Mapping[str, Any]) -> Self:
        """The arrangement that the assumptions describe."""
        return cls(**{field.name: assumed[field.name] for field in fields(cls)})

    @property
    def master_base(self) -> np.ndarray:
        """Origin of the master's base (3,) [m]."""
        return np.array([self.master_base_x, self.master_base_y, self.master_base_z])

    @property
    def slave_base(self) -> np.ndarray:
        """Origin of the slave's base (3,) [m]: that of the master moved along -y."""
        return self.master_base - np.array([0.0, self.base_distance, 0.0])

    @property
    def window_centre(self) -> np.ndarray:
        """Middle of the opening, which is the virtual attraction point (3,) [m]."""
        return np.array([self.window_centre_x, self.window_centre_y, self.window_centre_z])

    @property
    def normal(self) -> np.ndarray:
        """Direction in which the window is passed (3,)."""
        chord = SLAVE_END - SLAVE_START
        level = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "chord": (chord[0], chord[1], 0.0)}
        return np.array(level[self.window_normal])

    def window(self) -> tuple:
        """The four bars."""
        size = (self.window_opening_width, self.window_opening_height)
        return window_frame(
            self.window_centre, facing(self.normal), *size, self.window_bar, self.window_bar
        )

    def slave_points(self) -> tuple[np.ndarray, np.ndarray]:
        """Start and End in the world, (3,) each [m]."""
        origin = self.slave_base if self.slave_frame == "slave_base" else np.zeros(3)
        return origin + SLAVE_START, origin + SLAVE_END


@memo()
def arms_of(dh_source: str) -> tuple[Arm, Arm]:
    """Master by the matrices or by Table 1, and the slave, its mirror image."""
    master = load_arm(READINGS[dh_source])
    return master, load_arm("es165d-slave") if dh_source == "matrices" else master.mirrored()


@memo(512)
def placed_master(layout: Layout) -> PlacedArm:
    """The master on its base, with the printed start and goal."""
    placement = pin.SE3(np.eye(3), layout.master_base)
    return PlacedArm("master", arms_of(layout.dh_source)[0], placement, MASTER_START, MASTER_GOAL)


@memo(512)
def placed_slave(layout: Layout) -> PlacedArm | None:
    """The slave on its base, with postures at Start and End; None where one is out of reach."""
    arm, base = arms_of(layout.dh_source)[1], layout.slave_base
    points = layout.slave_points()
    start, goal = (posture(arm, point - base, layout.slave_postures) for point in points)
    if start is None or goal is None:
        return None
    return PlacedArm("slave", arm, pin.SE3(np.eye(3), base), start, goal)


def scene_of(layout: Layout, floor: float | None = None) -> Scene:
    """Both arms and the window; links of one arm are not watched against each other."""
    arms = [placed for placed in (placed_master(layout), placed_slave(layout)) if placed]
    return Scene(arms, {"window": layout.window()}, floor=floor, self_collision=False)
