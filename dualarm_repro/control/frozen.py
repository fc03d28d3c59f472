"""A scenario file as arms, paths and a start that can be run."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arms.arm import Arm
from ..arms.reach import symmetric_bases
from ..scene.bodies import PlacedArm
from .circle import Circles
from .random_tasks import CircleTask
from .scenario import Scenario
from .system import ArmSystem


def arm_pair(arm: Arm, base_distance: float) -> ArmSystem:
    """Two arms of one model, bases ``base_distance`` [m] apart along y, both looking along x."""
    bases = zip(("left", "right"), symmetric_bases(base_distance), strict=True)
    return ArmSystem([PlacedArm(name, arm, base) for name, base in bases])


@dataclass(frozen=True, eq=False)
class FrozenScenario:
    """Two arms, their paths and their start (n,) [rad]."""

    title: str
    system: ArmSystem
    circles: Circles
    q0: np.ndarray

    @classmethod
    def of(
        cls,
        file: Scenario,
        arm: Arm,
        *,
        base_distance: float | None = None,
        duration: float | None = None,
        law: str = "rest_to_rest",
    ) -> FrozenScenario:
        """What a file says, on an arm; the circles go through the tips at the start.

        Parameters
        ----------
        base_distance, duration
            Instead of those of the file [m], [s].
        law
            Time law of the circles.

        Raises
        ------
        ConfigurationError
            The arm has another number of joints than the file.
        InputError, UnknownNameError
            Bad timing.
        """
        sides = (file.left, file.right)
        task = CircleTask(
            np.concatenate([side.q for side in sides]),
            np.array([side.normal for side in sides]),
            np.array([side.angle for side in sides]),
            file.radius,
        )
        distance = file.base_distance if base_distance is None else base_distance
        system = arm_pair(arm, distance)
        timing = {"duration": file.duration if duration is None else duration, "law": law}
        return cls(file.title, system, task.circles(system, **timing), task.q0)

    @property
    def period(self) -> float:
        """Duration of one turn [s]."""
        return self.circles.duration

    @property
    def parts(self) -> tuple[ArmSystem, Circles, np.ndarray]:
        """System, circles and start, as every simulation takes them first."""
        return self.system, self.circles, self.q0
