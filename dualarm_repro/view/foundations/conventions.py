"""The two Denavit-Hartenberg conventions side by side, on one arm."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import sympy as sp

from ...arms import Arm, dh
from ...arms.angle import Angle
from ...arms.robot_file import DHRobot, Flange, load_robot_file
from ...datafiles import data_path
from ...errors import UnsupportedArmError
from ..card import figure_html
from ..equations import Equations
from ..page import Page
from ..style import BLACK, BLUE, GREEN, WIDTH, house_style

_AXES = ((2, BLUE, 0.10), (0, GREEN, 0.065))  # column of the rotation, colour, drawn length [m]
_SHIFTS = 1000


def link_transforms() -> Equations:
    """The link transforms with symbols for their four parameters.

    Standard: A_i = Rz(theta_i) Tz(d_i) Tx(a_i) Rx(alpha_i); modified: T_i = Rx(alpha_{i-1})
    Tx(a_{i-1}) Rz(theta_i) Tz(d_i).
    """
    alpha, before = sp.symbols(r"\alpha_i \alpha_{i-1}", real=True)
    a, a_before, d, theta = sp.symbols(r"a_i a_{i-1} d_i \theta_i", real=True)
    screw = _turn_z(theta) * _shift(0, 0, d)
    return Equations(
        {
            "A_i": screw * _shift(a, 0, 0) * _turn_x(alpha),
            "T_i": _turn_x(before) * _shift(a_before, 0, 0) * screw,
        }
    )


def in_modified_convention(robot: DHRobot) -> DHRobot:
    """The arm of a standard table in the modified convention.

    The chain of elementary motions is the same; cut before each joint instead of after it, the
    columns a and alpha move down one row and their last entries become the flange.

    Raises
    ------
    UnsupportedArmError
        The table is not standard, or its flange is not the last link frame.
    """
    if robot.convention != "standard" or robot.flange is not None:
        raise UnsupportedArmError(f"{robot.title}: not a standard table that ends at the flange")
    alpha = [Angle.parse(0), *(joint.alpha for joint in robot.joints)]
    a = [0.0, *(joint.a for joint in robot.joints)]
    joints = [
        joint.model_copy(update={"alpha": alpha[k], "a": a[k]})
        for k, joint in enumerate(robot.joints)
    ]
    flange = Flange(
        translation=(a[-1], 0.0, 0.0),
        rpy=(alpha[-1], Angle.parse(0), Angle.parse(0)),
        source=robot.provenance["alpha"].source,
        evidence=robot.provenance["alpha"].evidence,
    )
    update = {"convention": "modified", "joints": joints, "flange": flange, "capsules": []}
    return robot.model_copy(update=update)


def lengths_misread(robot: DHRobot, modified: DHRobot) -> DHRobot:
    """The modified table with the column a of the standard one: shifted against its own header."""
    joints = [
        joint.model_copy(update={"a": wrong.a})
        for joint, wrong in zip(modified.joints, robot.joints, strict=True)
    ]
    return modified.model_copy(update={"joints": joints})


def frames_page(name: str, rng: np.random.Generator) -> Page:
    """Link frames of both conventions in the zero configuration, and what mixing them up costs.

    Parameters
    ----------
    name
        An arm of ``data/robots`` with a standard table.

    Raises
    ------
    UnsupportedArmError
        It has none.
    """
    robot = load_robot_file(data_path("robots", f"{name}.yaml"))
    if not isinstance(robot, DHRobot):
        raise UnsupportedArmError(f"{name}: not an arm of a Denavit-Hartenberg table")
    modified = in_modified_convention(robot)
    residual = dh.forward_kinematics(robot) - dh.forward_kinematics(modified)
    residual = residual.applyfunc(sp.simplify)
    arm = Arm.from_dh("arm", robot)
    misread = Arm.from_dh("misread", lengths_misread(robot, modified))
    q = arm.random_configurations(_SHIFTS, rng)
    shift = np.linalg.norm(arm.positions(q) - misread.positions(q), axis=1)
    same = "identically zero" if residual == sp.zeros(4) else "NOT zero"
    with house_style():
        figure, axes = plt.subplots(1, 2, figsize=(WIDTH, 5.0), sharex=True, sharey=True)
        for ax, table in zip(axes, (robot, modified), strict=True):
            _draw_frames(ax, table)
    alt = (
        f"Two side views of the {robot.title} at zero joint angles. Left, standard convention: "
        "frame i sits at the far end of link i. Right, modified convention: frame i sits on the "
        "axis of joint i."
    )
    caption = (
        f"{robot.title} at q = 0. Both tables describe the same arm: the difference of their "
        f"forward kinematics, simplified by sympy, is {same}. Only the places of the frames "
        "differ. Reading the column a of the standard table under the header of the modified one "
        f"moves the flange by up to {shift.max():.3f} m (median {np.median(shift):.3f} m over "
        f"{_SHIFTS} random configurations)."
    )
    return Page(figure_html(figure, alt, caption))


def _draw_frames(ax: Any, robot: DHRobot) -> None:
    """Axes x and z of every link frame in the xz plane of the base."""
    zero = dict.fromkeys(dh.joint_symbols(len(robot.joints)), 0)
    frames = [np.eye(4)]
    for transform in dh.link_transforms(robot)[: len(robot.joints)]:
        frames.append(frames[-1] @ np.array(transform.subs(zero), dtype=float))
    ax.plot(*np.array([frame[[0, 2], 3] for frame in frames]).T, color=BLACK, lw=5, alpha=0.15)
    names: dict[tuple[float, ...], list[str]] = {}
    for k, frame in enumerate(frames):
        origin = frame[[0, 2], 3]
        names.setdefault(tuple(origin.round(6)), []).append(str(k))
        for column, color, length in _AXES:
            _draw_axis(ax, origin, length * frame[:3, column], color)
    for place, labels in names.items():
        text = f"{{{', '.join(labels)}}}"
        ax.annotate(text, place, (-7, -14), textcoords="offset points", ha="right", fontsize=9)
    ax.set(title=f"{robot.convention} convention", xlabel="x [m]", aspect="equal")
    ax.set_ylabel("z [m]" if robot.convention == "standard" else "")
    ax.margins(0.18)
    _legend(ax, ((GREEN, "x axis"), (BLUE, "z axis (of a joint)")))


def _draw_axis(ax: Any, origin: np.ndarray, axis: np.ndarray, color: str) -> None:
    """An arrow, or a ring for an axis that is normal to the drawing (dot: towards the reader)."""
    tip = origin + axis[[0, 2]]
    if np.allclose(tip, origin):
        ax.plot(*origin, "o", mfc="none", mec=color, ms=13, mew=1.6)
        ax.plot(*origin, "." if axis[1] < 0 else "x", color=color, ms=7)
        return
    arrow = {"arrowstyle": "-|>", "color": color, "lw": 1.8, "shrinkA": 0, "shrinkB": 0}
    ax.annotate("", tip, origin, arrowprops=arrow)
    ax.plot(*tip, alpha=0)


def _legend(ax: Any, entries: Iterable[tuple[str, str]]) -> None:
    handles = [plt.Line2D([], [], color=color, lw=2, label=label) for color, label in entries]
    ax.legend(handles=handles, loc="lower right", fontsize=8)


def _turn_x(angle: sp.Expr) -> sp.Matrix:
    return sp.diag(sp.rot_ccw_axis1(angle), 1)


def _turn_z(angle: sp.Expr) -> sp.Matrix:
    return sp.diag(sp.rot_ccw_axis3(angle), 1)


def _shift(x: sp.Expr, y: sp.Expr, z: sp.Expr) -> sp.Matrix:
    shift = sp.eye(4)
    shift[:3, 3] = sp.Matrix([x, y, z])
    return shift
