"""Joints of a URDF: how they move, which follow others, and which are locked where."""

from __future__ import annotations

import math
from collections.abc import Mapping
from numbers import Real
from pathlib import Path
from typing import NamedTuple
from xml.etree.ElementTree import Element, SubElement

import numpy as np

from ...errors import DataFileError, UnknownNameError
from ..angle import EXPECTED, Angle
from ..joint_type import JointType
from .document import children
from .fields import has, numbers

#: What a URDF may say besides; such joints can only stand still.
_OTHERS = ("fixed", "planar", "floating")
_MOST_GEARS = 50
#: Limits of a turning joint [rad] that say that there are none; files have 1e16.
ENDLESS = 1e5
_LENGTH = "a length: a finite number in metres"


class Gear(NamedTuple):
    """q_joint = ``multiplier`` q_master + ``offset``."""

    master: str
    multiplier: float
    offset: float


class Joints(NamedTuple):
    """By name: how the moving joints move, which follow another one, and what cannot be free."""

    types: dict[str, JointType]
    gears: dict[str, Gear]
    standing: dict[str, str]


def read_joints(path: Path, root: Element) -> Joints:
    """Check the joints of a robot and make all of them a vector of numbers for the parser.

    A continuous joint becomes a revolute one without limits to speak of, and gears are taken out.
    One whose limits are beyond :data:`ENDLESS` on both sides counts as continuous.

    Raises
    ------
    DataFileError
        A type that URDF does not have, or a gear (``mimic``) that is not finite.
    """
    found = Joints({}, {}, {})
    joints = children(root, "joint")
    for name, joint in joints.items():
        kind = joint.get("type", "nothing")
        if kind in list(JointType):
            found.types[name] = JointType(kind)
        elif kind not in _OTHERS:
            known = f"one of {', '.join((*JointType, *_OTHERS))}"
            raise DataFileError(path, f"type of joint {name}", kind, known)
        elif kind != "fixed":
            found.standing[name] = kind
        if kind == JointType.CONTINUOUS or (kind == JointType.REVOLUTE and _unlimited(joint)):
            found.types[name] = JointType.CONTINUOUS
            _endless(joint)
        if (mimic := joint.find("mimic")) is not None:
            found.gears[name] = _gear(path, name, mimic)
            joint.remove(mimic)
    return found


def _unlimited(joint: Element) -> bool:
    limit = joint.find("limit")
    return limit is not None and (
        has(limit, "lower", 1, lambda end: end < -ENDLESS)
        and has(limit, "upper", 1, lambda end: end > ENDLESS)
    )


def _endless(joint: Element) -> None:
    joint.set("type", "revolute")
    limit = joint.find("limit")
    if limit is None:
        limit = SubElement(joint, "limit", effort="0", velocity="0")
    limit.set("lower", repr(-2 * math.pi))
    limit.set("upper", repr(2 * math.pi))


def _gear(path: Path, name: str, mimic: Element) -> Gear:
    factors = []
    for attribute, default in (("multiplier", "1"), ("offset", "0")):
        mimic.attrib.setdefault(attribute, default)
        value = numbers(mimic, attribute)
        if len(value) != 1:
            field = f"mimic of joint {name}: {attribute}"
            raise DataFileError(path, field, mimic.get(attribute), "a finite number")
        factors += value
    return Gear(mimic.get("joint", "nothing"), *factors)


def locked_values(
    path: Path,
    joints: Joints,
    lock: Mapping[str, object],
    limits: Mapping[str, tuple[float, float]],
) -> dict[str, float]:
    """Angles [rad] or lengths [m] that the user locks joints at.

    Raises
    ------
    UnknownNameError
        No such joint.
    DataFileError
        No angle or length, or one beyond the limits of the joint.
    """
    known = [*joints.types, *joints.standing]
    found = {}
    for name, given in lock.items():
        if name not in known:
            raise UnknownNameError(path, "lock", name, f"one of {', '.join(known)}")
        value = given.item() if isinstance(given, np.generic) else given
        found[name] = _locked(path, name, value, joints)
        kind = joints.types.get(name)
        low, high = limits[name]
        if kind in (JointType.REVOLUTE, JointType.PRISMATIC) and not (
            low - 1e-9 <= found[name] <= high + 1e-9
        ):
            unit = "m" if kind is JointType.PRISMATIC else "rad"
            expected = f"a value within its limits {low:.6g} ... {high:.6g} {unit}"
            raise DataFileError(path, f"lock: {name}", given, expected)
    return found


def _locked(path: Path, name: str, value: object, joints: Joints) -> float:
    if name in joints.standing:
        if value == 0 and not isinstance(value, bool):
            return 0.0
        expected = f"0, since the joint is {joints.standing[name]}"
        raise DataFileError(path, f"lock: {name}", value, expected)
    if joints.types[name] is JointType.PRISMATIC:
        number = isinstance(value, Real) and not isinstance(value, bool)
        if number and math.isfinite(value):  # type: ignore[arg-type]
            return float(value)  # type: ignore[arg-type]
        raise DataFileError(path, f"lock: {name}", value, _LENGTH)
    try:
        return float(Angle.parse(value))
    except ValueError:
        raise DataFileError(path, f"lock: {name}", value, EXPECTED) from None


def geared(
    path: Path, joints: Joints, free: set[str], values: Mapping[str, float]
) -> dict[str, float]:
    """Values of all joints that stand still: as locked, as their gear says, else 0.

    Parameters
    ----------
    free
        The joints that move.

    Raises
    ------
    DataFileError
        A joint follows one that moves, so that it cannot stand still, or none that there is; or it
        moves but follows another.
    """
    remedy = "a joint without gear: choose another flange=, or lock="
    for name in sorted(free & joints.gears.keys()):
        raise DataFileError(path, f"mimic of joint {name}", joints.gears[name].master, remedy)

    def value(name: str, seen: tuple[str, ...] = ()) -> float:
        if name in values or name not in joints.gears:
            return values.get(name, 0.0)
        gear = joints.gears[name]
        if len(seen) > _MOST_GEARS:
            expected = f"at most {_MOST_GEARS} joints that follow one another"
            raise DataFileError(path, f"mimic of joint {name}", gear.master, expected)
        if gear.master in free or gear.master not in joints.types or name in seen:
            wanted = "a joint that stands still" if gear.master in free else "another joint"
            expected = f"{wanted}, or lock={{{name!r}: ...}}, which fixes the joint"
            raise DataFileError(path, f"mimic of joint {name}", gear.master, expected)
        return gear.multiplier * value(gear.master, (*seen, name)) + gear.offset

    return {name: value(name) for name in joints.types if name not in free}
