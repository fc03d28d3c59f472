"""A scene as one model of Pinocchio with its geometry, for libraries that take nothing else.

The joints come in the order of the scene; obstacles are fixed to the world. The pairs are those
that the scene watches, and links of one arm are their hulls where the scene knows them; hulls of
adjacent links always overlap, so that these are their exact shapes.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import pinocchio as pin

from ..arms.exclusions import shape_of
from ..arms.fit.triangles import convex
from ..scene import FLOOR, HalfSpace, MovingArm, PlacedArm, Scene, Shape
from ..scene.hull_pairs import hull_pairs, hulls_of
from ..scene.shape_pairs import shape_pairs

_HULL, _SHAPE = " hull", " shape"


class WholeModel(NamedTuple):
    """Model of all arms, and all bodies with the watched pairs."""

    model: pin.Model
    geometry: pin.GeometryModel


def whole_model(scene: Scene) -> WholeModel:
    """The arms, obstacles, floor and parked arms of a scene whose obstacles rest.

    The geometry objects are named as the bodies of the scene.
    """
    model, geometry = pin.Model(), pin.GeometryModel()
    beside = _neighbours(scene)
    shapes = {name for names in beside.values() for name in names}
    for placed in scene.arms:
        named = _named(placed)
        model = pin.appendModel(model, named, 0, placed.placement)
        for one in placed.arm.geometry.geometryObjects:
            joint, at = 0, placed.placement * one.placement
            if one.parentJoint:
                joint, at = model.getJointId(named.names[one.parentJoint]), one.placement
            body = f"{placed.name}/{one.name}"
            geometry.addGeometryObject(pin.GeometryObject(body, joint, at, one.geometry))
            if one.name in hulls_of(placed.arm):
                at = pin.SE3.Identity() if one.parentJoint else placed.placement
                hull = convex(placed.arm.hulls[one.name])
                geometry.addGeometryObject(pin.GeometryObject(f"{body}{_HULL}", joint, at, hull))
        for one in placed.arm.solids.geometryObjects if shapes and placed.arm.solids else ():
            if (name := f"{placed.name}/{one.name}{_SHAPE}") in shapes:
                joint, at = 0, placed.placement * one.placement
                if one.parentJoint:
                    joint, at = model.getJointId(named.names[one.parentJoint]), one.placement
                geometry.addGeometryObject(pin.GeometryObject(name, joint, at, one.geometry))
    for name, solid in _standing(scene).items():
        shape, pose = solid.coal()
        placement = pin.SE3(np.array(pose.getRotation()), np.array(pose.getTranslation()))
        geometry.addGeometryObject(pin.GeometryObject(name, 0, placement, shape))
    for name, mover in scene.moving.items():
        if isinstance(mover, MovingArm):
            _add_parked(geometry, name, mover)
    known = {one.name: k for k, one in enumerate(geometry.geometryObjects)}
    hulled = {pair.column for pairs in hull_pairs(scene).values() for pair in pairs}
    for names in sorted(set(beside.values())):
        geometry.addCollisionPair(pin.CollisionPair(*(known[name] for name in names)))
    for column, names in enumerate(scene.pairs.names):
        if column in beside:
            continue
        hulls = (f"{name}{_HULL}" if column in hulled else name for name in names)
        bodies = (known.get(hull, known[name]) for hull, name in zip(hulls, names, strict=True))
        geometry.addCollisionPair(pin.CollisionPair(*bodies))
    return WholeModel(model, geometry)


def _named(placed: PlacedArm) -> pin.Model:
    """The model with joints and frames that carry the name of the arm."""
    model = placed.arm.model.copy()
    for k in range(1, model.njoints):
        model.names[k] = f"{placed.name}/{model.names[k]}"
    for frame in model.frames:
        frame.name = f"{placed.name}/{frame.name}"
    return model


def _neighbours(scene: Scene) -> dict[int, tuple[str, str]]:
    """Columns of capsules of adjacent links of one arm, and the names of their exact shapes."""
    found = {}
    for pairs in shape_pairs(scene).values():
        for pair in pairs:
            if abs(pair.first.joint - pair.second.joint) == 1:
                for k in pair.columns:
                    first, second = (f"{shape_of(name)}{_SHAPE}" for name in scene.pairs.names[k])
                    found[k] = first, second
    return found


def _standing(scene: Scene) -> dict[str, Shape]:
    found: dict[str, Shape] = {}
    for name, solid in scene.obstacles.items():
        if isinstance(solid, Sequence):
            found |= {f"{name}/{k}": one for k, one in enumerate(solid)}
        else:
            found[name] = solid
    if scene.floor is not None:
        found[FLOOR] = HalfSpace((0.0, 0.0, 1.0), scene.floor)
    return found


def _add_parked(geometry: pin.GeometryModel, name: str, mover: MovingArm) -> None:
    data = mover.arm.model.createData()
    pin.forwardKinematics(mover.arm.model, data, mover.path.at(np.zeros(1))[0])
    for one in mover.arm.geometry.geometryObjects:
        at = mover.placement * data.oMi[one.parentJoint] * one.placement
        geometry.addGeometryObject(pin.GeometryObject(f"{name}/{one.name}", 0, at, one.geometry))
