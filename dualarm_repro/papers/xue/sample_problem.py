"""A small problem with all terms acting, on which the printed potentials are evaluated."""

from __future__ import annotations

import numpy as np
import pinocchio as pin

from ...arms import load_arm
from ...planning.descent.problem import PlanningProblem, problem
from ...planning.field.obstacles import obstacles_of
from ...planning.field.potentials import Potential
from ...planning.settings import (
    APFSettings,
    Attraction,
    Repulsion,
    Termination,
    Trap,
    Update,
    VirtualPoint,
)
from ...scene import PlacedArm, Scene, facing, window_frame
from ...tracking import memo
from .methods import COMBINATIONS
from .scenario import GAINS, MASTER_GOAL, MASTER_START, SEED

#: Place of a window close to the master's wrist at its start, in the frame of its base [m].
_CENTRE = np.array([1.4, 0.0, -1.1])
_SHIFT = 1e-5  # [rad], of central differences


@memo(64)
def sample_problem(
    window_distance: str = "sum_over_bars",
    control_points: str = "frames_2_6",
    joint_weight: float = 1.0,
    virtual_gain: float = 2.0,
    virtual_centre: tuple[float, float, float] = tuple(_CENTRE),
    virtual_switching: str = "on_when_stuck",
    virtual_joints: bool = False,
) -> PlanningProblem:
    """Master from the printed start to the printed goal beside a window, with the printed gains.

    With ``virtual_joints`` the virtual point attracts the joints to the goal angles as well.
    """
    arm = load_arm("es165d")
    placed = PlacedArm("master", arm, pin.SE3.Identity(), MASTER_START, MASTER_GOAL)
    window = window_frame(_CENTRE, facing((1.0, 0.0, 0.0)), 0.5, 0.5, 0.1, 0.1)
    scene = Scene([placed], {"window": window}, self_collision=False)
    settings = APFSettings(
        attraction=Attraction(gain=GAINS["k_a"], joint_weight=joint_weight),
        control_points=control_points,
        repulsion=Repulsion(
            gain=GAINS["k_r"], influence=GAINS["d_0"], combination=COMBINATIONS[window_distance]
        ),
        virtual_point=VirtualPoint(
            gain=virtual_gain,
            position=virtual_centre,
            joints=tuple(MASTER_GOAL) if virtual_joints else None,
            switching=virtual_switching,
            release_distance=0.1,
            max_steps=1,
            max_activations=1,
        ),
        update=Update(rule="gradient", max_step=0.02, gain=0.05),
        termination=Termination(
            joint_tolerance=0.02,
            step_limit=1,
            trap=Trap(rule="block_means", steps=1, threshold=1e-3),
        ),
    )
    away = MASTER_START + np.array([0.8, 0.0, 0.0, 0.0, 0.0, 0.0])
    return problem(placed, away, MASTER_GOAL, obstacles_of(scene), settings)


def samples(made: PlanningProblem, count: int = 200) -> np.ndarray:
    """Configurations about the start with all control points outside the bars (N, 6)."""
    rng = np.random.default_rng(SEED)
    q = MASTER_START + rng.uniform(-0.5, 0.5, (count, 6))
    return q[made.repulsion.distances(q).min(axis=(1, 2)) > 0.02]


def worst_gradient(potential: Potential, q: np.ndarray) -> float:
    """Largest relative difference between dU/dq and central differences of U."""
    worst = 0.0
    for row in q:
        exact = potential.gradient(row)
        shifted = _SHIFT * np.eye(len(row))
        slopes = (potential.value(row + shifted) - potential.value(row - shifted)) / (2 * _SHIFT)
        worst = max(worst, float(abs(slopes - exact).max() / max(1.0, abs(exact).max())))
    return worst
