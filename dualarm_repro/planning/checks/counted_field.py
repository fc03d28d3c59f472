"""What a descent costs, whatever the computer: postures at which its field is looked at."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..descent.apf import descend
from ..descent.problem import PlanningProblem
from ..field.potentials import PointRepulsion
from ..plan import Record


@dataclass(frozen=True, eq=False)
class _Counted(PointRepulsion):
    """The same repulsion; ``postures`` grows with every posture whose distances are taken."""

    postures: list[int]

    def value(self, q: np.ndarray, step: int = 0) -> float | np.ndarray:
        self.postures.append(1 if q.ndim == 1 else len(q))
        return super().value(q, step)

    def gradient(self, q: np.ndarray, step: int = 0) -> np.ndarray:
        self.postures.append(1)
        return super().gradient(q, step)


def counted_descent(made: PlanningProblem) -> tuple[Record, int]:
    """The run of :func:`..descent.apf.descend`, and at how many postures it takes the distances of
    its control points: once a step for the gradient, and for every length of the step it tries."""
    fresh, known = replace(made), made.repulsion
    counted = _Counted(**vars(known), postures=[])
    fresh.__dict__["repulsion"] = counted  # where the cached property looks first
    return descend(fresh), sum(counted.postures)
