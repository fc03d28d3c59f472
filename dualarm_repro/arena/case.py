"""A case of the arena: a scene, and where each of its arms starts and ends."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..planning.gate import beyond_limits
from ..planning.methods import Method
from ..planning.tasks.task_file import ReadTask, TaskSet
from ..scene import Scene, distances


@dataclass(frozen=True, eq=False)
class Case:
    """A scene without parked arms, and starts and goals (nq,) [rad] of all arms."""

    name: str
    scene: Scene
    starts: dict[str, np.ndarray]
    goals: dict[str, np.ndarray]

    @property
    def ends(self) -> np.ndarray:
        """Start and goal of all arms one after the other (2, nq) [rad]."""
        return np.array([self.scene.stack(**self.starts), self.scene.stack(**self.goals)])

    @property
    def fault(self) -> str:
        """Why no plan can be right: ``contact`` or ``limits`` at an end; empty if one may be."""
        for placed in self.scene.arms:
            for q in (self.starts[placed.name], self.goals[placed.name]):
                if beyond_limits(placed, q).max() > 1e-9:
                    return "limits"
        least = distances(self.scene, self.ends).min(initial=np.inf)
        return "contact" if least <= 0.0 else ""

    def tasks(self, method: Method[Any]) -> TaskSet[Any]:
        """What a method is given: all it would read in a file that sets nothing."""
        return TaskSet(
            self.scene,
            {name: ReadTask(q, self.goals[name]) for name, q in self.starts.items()},
            {one.name: method.default(one.arm) for one in self.scene.arms},
            (),
            "joint_points",
            None,
            path=Path(self.name),
        )
