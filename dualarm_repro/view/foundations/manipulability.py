"""Manipulability: its factors for a spherical wrist, and its map over a slice of the workspace."""

from __future__ import annotations

from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import sympy as sp
from matplotlib.patches import Ellipse

from ...arms import Arm, dh
from ...errors import UnsupportedArmError
from ..card import figure_html
from ..equations import Equations
from ..page import Page
from ..style import BLACK, ORANGE, house_style

_TOOL_DOWN = np.diag([1.0, -1.0, -1.0])
_ELLIPSE = 0.05  # drawn half axis per unit of velocity


def singular_factors(arm: Arm) -> dict[str, sp.Expr]:
    """w = |shoulder| |elbow| |wrist| for six joints with a spherical wrist, exact.

    Joints 4 to 6 do not move the wrist centre, so that J seen from there is block triangular and w
    the product of two determinants: that of d(wrist centre)/d(q_1, q_2, q_3), which splits into the
    distance of the wrist centre from axis 1 and a factor of q_3, and that of the three axes that
    meet. Moving the reference point to the flange leaves the determinant as it is.

    Raises
    ------
    UnsupportedArmError
        The arm has no DH table, or the determinant does not split.
    """
    q = dh.joint_symbols(arm.nq)
    transforms = arm.link_transforms()
    centre = sp.prod(transforms[1:4], start=transforms[0])[:3, 3].applyfunc(sp.trigsimp)
    radius = sp.trigsimp(centre[0] * sp.cos(q[0]) + centre[1] * sp.sin(q[0]))
    arm_factor = sp.factor(sp.trigsimp(centre.jacobian(q[:3]).det()))
    elbow = sp.expand(sp.cancel(arm_factor / sp.factor(radius)))
    axes, rotation = [], sp.eye(3)
    for joint, transform in zip(q[3:], transforms[3:6], strict=True):
        turn = transform[:3, :3]
        spin = (turn.diff(joint) * turn.T).applyfunc(sp.trigsimp)
        axes.append(rotation * sp.Matrix([spin[2, 1], spin[0, 2], spin[1, 0]]))
        rotation = rotation * turn
    wrist = sp.trigsimp(sp.Matrix.hstack(*axes).det())
    if elbow.free_symbols - {q[2]} or wrist.free_symbols - {q[4]}:
        raise UnsupportedArmError(f"arm {arm.name}: no spherical wrist on an arm without offset")
    return {"shoulder": sp.expand(radius), "elbow": elbow, "wrist": wrist}


def factors_equations(arm: Arm) -> Equations:
    """The three factors as displayed equations."""
    factors = singular_factors(arm)
    return Equations({rf"\text{{{name}}}": factor for name, factor in factors.items()})


def factors_residual(arm: Arm, q: np.ndarray) -> float:
    """Largest difference of the product of the factors from sqrt(det(J J^T)) over rows of ``q``."""
    factors = singular_factors(arm).values()
    product = sp.lambdify([dh.joint_symbols(arm.nq)], sp.prod(factors))
    return float(np.abs(np.abs(product(q.T)) - arm.manipulability(q)).max())


def map_page(arm: Arm, extent: tuple[float, float, float, float], columns: int = 121) -> Page:
    """Best manipulability in the plane y = 0 with the tool pointing down, over all branches.

    Parameters
    ----------
    extent
        Range of x and of z [m].
    """
    x0, x1, z0, z1 = extent
    rows = round(columns * (z1 - z0) / (x1 - x0))
    x, z = np.meshgrid(np.linspace(x0, x1, columns), np.linspace(z0, z1, rows))
    best, measure = _best(arm, x.ravel(), z.ravel())
    share = float(np.isfinite(measure).mean())
    top = int(np.nanargmax(measure))
    with house_style():
        figure, ax = plt.subplots(figsize=(7.0, 5.4))
        filled = ax.contourf(x, z, measure.reshape(x.shape), 12, cmap="viridis")
        figure.colorbar(filled, ax=ax, label="manipulability w [m³]")
        _draw_ellipses(ax, arm, x.ravel(), z.ravel(), best, columns)
        ax.plot(x.flat[top], z.flat[top], "*", color=ORANGE, mec=BLACK, ms=14)
        ax.set(xlabel="x [m]", ylabel="z [m]", aspect="equal", xlim=(x0, x1), ylim=(z0, z1))
    alt = (
        f"Map of the manipulability of the {arm.title} in a vertical plane. It is small along the "
        "borders of the reachable region and in a valley that crosses it, and largest in front of "
        "the arm. Velocity ellipses become flat near the borders."
    )
    caption = (
        f"{arm.title}, tool pointing down, best of all branches within the joint limits; "
        f"{share:.0%} of the plane shown is reachable. The largest value, {measure[top]:.4f} m³ "
        f"(star), is at x = {x.flat[top]:.2f} m, z = {z.flat[top]:.2f} m. Ellipses: velocities of "
        "the flange in this plane for joint velocities of norm one."
    )
    return Page(figure_html(figure, alt, caption))


def _best(arm: Arm, x: np.ndarray, z: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Branch with the largest manipulability at every point (NaN out of reach), and its value."""
    poses = np.tile(np.eye(4), (len(x), 1, 1))
    poses[:, :3, :3] = _TOOL_DOWN
    poses[:, 0, 3], poses[:, 2, 3] = x, z
    branches = arm.ik_branches(poses)
    exists = np.isfinite(branches).all(axis=2)
    measure = np.full(exists.shape, -1.0)
    measure[exists] = arm.manipulability(branches[exists])
    chosen = measure.argmax(axis=1)
    row = np.arange(len(x))
    return branches[row, chosen], np.where(exists.any(axis=1), measure[row, chosen], np.nan)


def _draw_ellipses(
    ax: Any, arm: Arm, x: np.ndarray, z: np.ndarray, q: np.ndarray, columns: int
) -> None:
    """The ellipse {J dq : |dq| = 1} of the velocity in the plane, at some points of the grid."""
    step = columns // 7
    index = np.arange(len(x))
    chosen = (index % columns % step == step // 2) & (index // columns % step == step // 2)
    for k in index[chosen & np.isfinite(q).all(axis=1)]:
        values, vectors = np.linalg.eigh(arm.jacobian(q[k])[[0, 2]] @ arm.jacobian(q[k])[[0, 2]].T)
        width, height = 2 * _ELLIPSE * np.sqrt(values.clip(0))
        angle = np.degrees(np.arctan2(vectors[1, 0], vectors[0, 0]))
        ellipse = Ellipse((x[k], z[k]), width, height, angle=angle, fc="none", ec="white", lw=1.5)
        ax.add_patch(ellipse)
