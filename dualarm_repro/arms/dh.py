"""Denavit-Hartenberg tables in exact arithmetic (sympy).

Modified (Craig):  T_i = Rx(alpha_{i-1}) Tx(a_{i-1}) Rz(theta_i) Tz(d_i)
Standard:          T_i = Rz(theta_i) Tz(d_i) Tx(a_i) Rx(alpha_i)
with theta_i = q_i + offset_i. J. J. Craig, Introduction to Robotics, ch. 3; R. P. Paul, Robot
Manipulators, ch. 2.
"""

from __future__ import annotations

import sympy as sp

from .angle import Angle
from .exact_chain import chain_product
from .robot_file import DHRobot


def joint_symbols(n: int) -> tuple[sp.Symbol, ...]:
    """Joint variables q_1 ... q_n as real symbols."""
    return sp.symbols(f"q_1:{n + 1}", real=True)


def link_transforms(robot: DHRobot) -> list[sp.Matrix]:
    """The transforms T_1 ... T_n of the table, and the fixed flange transform if there is one.

    Returns
    -------
    list of sympy Matrix (4, 4)
        Functions of :func:`joint_symbols`; lengths are Rationals [m], angles exact.
    """
    transforms = []
    for q, joint in zip(joint_symbols(len(robot.joints)), robot.joints, strict=True):
        turn_x, shift_x = _rotation_x(_exact(joint.alpha)), _translation(_length(joint.a), 0, 0)
        theta = q + _exact(joint.offset)
        turn_z, shift_z = _rotation_z(theta), _translation(0, 0, _length(joint.d))
        if robot.convention == "modified":
            transforms.append(turn_x * shift_x * turn_z * shift_z)
        else:
            transforms.append(turn_z * shift_z * shift_x * turn_x)
    if robot.flange:
        roll, pitch, yaw = map(_exact, robot.flange.rpy)
        shift = _translation(*map(_length, robot.flange.translation))
        transforms.append(shift * _rotation_z(yaw) * _rotation_y(pitch) * _rotation_x(roll))
    return transforms


def forward_kinematics(robot: DHRobot) -> sp.Matrix:
    """T(q) = T_1 T_2 ... T_n (T_flange), expanded, without trigonometric identities."""
    return chain_product(link_transforms(robot))


def _exact(angle: Angle) -> sp.Expr:
    value = sp.Rational(angle.coefficient.numerator, angle.coefficient.denominator)
    return value * sp.pi if angle.of_pi else value


def _length(value: float) -> sp.Rational:
    return sp.Rational(repr(value))


def _rotation_x(angle: sp.Expr) -> sp.Matrix:
    c, s = sp.cos(angle), sp.sin(angle)
    return sp.Matrix([[1, 0, 0, 0], [0, c, -s, 0], [0, s, c, 0], [0, 0, 0, 1]])


def _rotation_y(angle: sp.Expr) -> sp.Matrix:
    c, s = sp.cos(angle), sp.sin(angle)
    return sp.Matrix([[c, 0, s, 0], [0, 1, 0, 0], [-s, 0, c, 0], [0, 0, 0, 1]])


def _rotation_z(angle: sp.Expr) -> sp.Matrix:
    c, s = sp.cos(angle), sp.sin(angle)
    return sp.Matrix([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])


def _translation(x: sp.Expr, y: sp.Expr, z: sp.Expr) -> sp.Matrix:
    return sp.Matrix([[1, 0, 0, x], [0, 1, 0, y], [0, 0, 1, z], [0, 0, 0, 1]])
