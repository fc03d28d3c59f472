"""Statements of `xue` on the kinematics: wrist, mirror image, printed start and goal."""

from __future__ import annotations

from functools import partial

import numpy as np
import sympy as sp

from ...arms import load_arm
from ...ledger import REGISTRY, Adopts, Assumed, Is, Residual, Result
from ..wording import point
from .chosen import nominal
from .layout import placed_master
from .printed_chain import (
    ALPHA,
    LINKS,
    THETA,
    A,
    D,
    equal,
    general_matrix,
    joint_variable,
    link_matrix,
    product,
)
from .scenario import MASTER_GOAL, SEED, matrices_robot

checks = partial(REGISTRY.checks, page="xue/kinematics")


@checks(
    "xue.claim_spherical_wrist",
    rules=[
        Is("origins_coincide", "frames 4, 5 and 6 less d_6 share their origin", value=True),
        Residual("spread", "largest distance of the three axes' common point [m]", high=1e-12),
    ],
)
def spherical_wrist(assumed: Assumed) -> Result:
    """Axes 4, 5 and 6 pass through one point: in symbols, and in Pinocchio at random poses."""
    frames = [product([link_matrix(k) for k in range(1, last + 1)]) for last in (4, 5, 6)]
    wrist, same, sixth = (frame[:3, 3] for frame in frames)
    # Axis 6 is the z axis of frame 6, whose origin lies d_6 further out along it.
    reach = link_matrix(6)[1, 3]
    back = sixth - reach * frames[2][:3, 2]
    meets = equal(sp.Matrix(wrist), sp.Matrix(same)) and equal(sp.Matrix(wrist), sp.Matrix(back))
    spread = _axis_spread()
    return Result(
        obtained={"origins_coincide": meets, "spread": spread},
        caption=(
            "The last three joint axes meet in one point for every configuration, proved in "
            f"symbols; in Pinocchio they miss a common point by at most {spread:.1e} m on 1000 "
            "random poses."
        ),
    )


@checks(
    "xue.claim_mirror",
    rules=[
        Is("symbolic", "negated alpha and theta give M T(q) M in symbols", value=True),
        Residual("pinocchio", "largest difference of the two models", high=1e-12),
    ],
)
def mirror(assumed: Assumed) -> Result:
    """With M = diag(1, -1, 1, 1): negating alpha and theta turns every T_i into M T_i M."""
    reflection = sp.diag(1, -1, 1, 1)
    symbolic = all(_negated(k).equals(reflection * link_matrix(k) * reflection) for k in LINKS)
    master, slave = load_arm("es165d"), load_arm("es165d-slave")
    q = master.random_configurations(1000, np.random.default_rng(SEED))
    flip = np.diag([1.0, -1.0, 1.0, 1.0])
    difference = float(abs(slave.fk(-q) - flip @ master.fk(q) @ flip).max())
    goal = slave.fk(-MASTER_GOAL)[:3, 3]
    return Result(
        obtained={"symbolic": symbolic, "pinocchio": difference, "slave_goal": goal.tolist()},
        caption=(
            "Negating alpha and theta is exactly the reflection in the xz plane of the base, link "
            f"by link in symbols and to {difference:.1e} between the two models. At the mirrored "
            f"goal the slave's flange is at ({point(goal)}) m."
        ),
    )


@checks(
    "xue.claim_master_start",
    rules=[Adopts("q", "start angles used [rad]", to="q")],
)
def master_start(assumed: Assumed) -> Result:
    """Start of the master, and how far it is outside the range of the real axis L."""
    arm = load_arm("es165d")
    start = placed_master(nominal().layout).start
    excess = float(np.rad2deg(start[1] - arm.upper[1]))
    tcp = arm.fk(start)[:3, 3]
    return Result(
        obtained={"q": start.tolist(), "tcp": tcp.tolist(), "excess_deg": excess},
        caption=(
            f"The start is used as printed; its flange is at ({point(tcp)}) m. Axis L of the real "
            f"robot would be {abs(excess):.1f} deg {'beyond' if excess > 0 else 'inside'} its "
            "range."
        ),
    )


@checks(
    "xue.claim_master_goal",
    rules=[Adopts("q", "goal angles used [rad]", to="q")],
)
def master_goal(assumed: Assumed) -> Result:
    """Goal of the master; unlike the start it tells Table 1 from the matrices."""
    arm, goal = load_arm("es165d"), placed_master(nominal().layout).goal
    tcp = arm.fk(goal)[:3, 3]
    inside = arm.within_limits(goal)
    return Result(
        obtained={"q": goal.tolist(), "tcp": tcp.tolist(), "within_limits": inside},
        caption=(
            f"The goal is used as printed; its flange is at ({point(tcp)}) m, "
            f"{'inside' if inside else 'outside'} the joint ranges of the real robot."
        ),
    )


def _negated(k: int) -> sp.Matrix:
    """Printed link transform with alpha and theta negated, composed anew from its parameters."""
    joint = matrices_robot().joints[k - 1]
    twist = sp.Rational(joint.alpha.coefficient) * (sp.pi if joint.alpha.of_pi else 1)
    values = {A: sp.Rational(repr(joint.a)), ALPHA: -twist, D: sp.Rational(repr(joint.d))}
    return general_matrix(corrected=True).subs({**values, THETA: -joint_variable(k)})


def _axis_spread() -> float:
    """Largest distance from the wrist point to axes 4, 5 and 6 over random poses."""
    import pinocchio as pin

    arm = load_arm("es165d")
    data = arm.model.createData()
    largest = 0.0
    for q in arm.random_configurations(1000, np.random.default_rng(SEED)):
        pin.forwardKinematics(arm.model, data, q)
        wrist = data.oMi[5].translation
        for joint in (4, 5, 6):
            placement = data.oMi[joint]
            offset = np.cross(wrist - placement.translation, placement.rotation[:, 2])
            largest = max(largest, float(np.linalg.norm(offset)))
    return largest
