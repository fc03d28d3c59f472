"""Result of a search from both ends: its halves, how it ended, and the joined path."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import pandas as pd

from ...scene import PlacedArm
from ..arm_path import ArmPath
from ..descent.termination import StopReason
from ..field.control_points import end_effector
from .search_problem import SearchProblem


@dataclass(frozen=True, eq=False)
class SearchRecord:
    """What a search leaves behind, one entry per half: paths (n + 1, nq) [rad], distances of the
    control points (n + 1, K) [m], gain factors (n + 1, K), flips; its end, and its time [s]."""

    paths: tuple[np.ndarray, ...]
    clearances: tuple[np.ndarray, ...]
    factors: tuple[np.ndarray, ...]
    flips: tuple[int, ...]
    reason: StopReason
    wall_time: float


@dataclass(frozen=True, eq=False)
class SearchPlan(ArmPath):
    """A search and its path; row s of a half belongs to search s."""

    problem: SearchProblem
    record: SearchRecord

    @property
    def reached(self) -> bool:
        """Whether the goal is reached or the halves have met."""
        return self.record.reason is StopReason.REACHED

    @property
    def reason(self) -> StopReason:
        """Why the search ended."""
        return self.record.reason

    @property
    def searches(self) -> int:
        """Steps that each half has taken."""
        return len(self.record.paths[0]) - 1

    @property
    def placed(self) -> PlacedArm:  # type: ignore[override]
        """The arm."""
        return self.problem.placed

    @cached_property
    def path(self) -> np.ndarray:  # type: ignore[override]
        """Forward half, then the backward half turned round (N, nq) [rad]."""
        forward, *backward = self.record.paths
        return np.vstack([forward, *(half[::-1] for half in backward)])

    @cached_property
    def half_tcp(self) -> tuple[np.ndarray, ...]:
        """Flange along each half in the world (n + 1, 3) [m]."""
        return tuple(end_effector(self.problem.placed, half) for half in self.record.paths)

    @cached_property
    def ends(self) -> tuple[np.ndarray, ...]:
        """Flange where each half ends (3,) [m]."""
        return tuple(tcp[-1] for tcp in self.half_tcp)

    @property
    def gap(self) -> float:
        """Joint distance of the halves, or of the end to the goal [rad]."""
        forward, *backward = self.record.paths
        target = backward[0][-1] if backward else self.problem.goal
        return float(np.linalg.norm(forward[-1] - target))

    @property
    def control_clearance(self) -> float:
        """Smallest distance of a control point on the way, as the planner saw it [m]."""
        return float(min(half.min(initial=np.inf) for half in self.record.clearances))

    def to_frame(self) -> pd.DataFrame:
        """One row per sample of the path: half, search, joints q1 ... [rad], flange x, y, z [m],
        and per control point the distance [m] and the gain factor."""
        parts, seen = [], (self.record.clearances, self.record.factors)
        halves = zip(self.record.paths, self.half_tcp, *seen, strict=True)
        for half, (path, tcp, clearance, factor) in enumerate(halves):
            columns = {"half": ("forward", "backward")[half], "search": np.arange(len(path))}
            columns |= {f"q{j + 1}": angle for j, angle in enumerate(path.T)}
            columns |= dict(zip("xyz", tcp.T, strict=True))
            for k, name in enumerate(self.problem.points.names):
                columns[f"clearance {name}"] = clearance[:, k]
                columns[f"gain factor {name}"] = factor[:, k]
            parts.append(pd.DataFrame(columns)[:: 1 - 2 * half])
        return pd.concat(parts, ignore_index=True)
