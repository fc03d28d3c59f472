"""An arm with something at its flange: a tool or a part it carries, as capsules that collide."""

from __future__ import annotations

from collections.abc import Collection, Sequence

import pinocchio as pin

from ..arms.arm import Arm
from ..arms.capsules import enclosing_capsules
from ..arms.exclusions import Evidence, Exclusion, Neighbours, link_of
from ..arms.fit.neighbours import adjacent_pairs, neighbours
from ..errors import InputError
from .pairs import SAMPLES, always_overlapping
from .posing import links_of
from .shapes import HalfSpace, Shape

TIP, TOOL = "tool tip", "tool"


def with_tool(arm: Arm, shapes: Sequence[Shape], tip: pin.SE3 | None = None) -> Arm:
    """The arm with capsules around ``shapes``, which are given in the frame of its flange.

    Parameters
    ----------
    tip : pinocchio.SE3, optional
        Pose of the tool centre point in the frame of the flange; it becomes the flange of the arm,
        to which positions and poses of goals refer.

    Raises
    ------
    InputError
        A half-space, which has no end.
    """
    flange, bodies = arm.model.frames[arm.flange_id], pin.GeometryModel()
    called = name_of_tool(arm) if shapes else TOOL
    for k, shape in enumerate(shapes):
        if isinstance(shape, HalfSpace):
            raise InputError(f"arm {arm.name}", "tool", "halfspace", "a shape with an end")
        geometry, at = shape.coal()
        pose = flange.placement * pin.SE3(at.getRotation(), at.getTranslation())
        one = pin.GeometryObject(f"{called}_{k}", flange.parentJoint, pose, geometry)
        bodies.addGeometryObject(one)

    def carried() -> pin.GeometryModel:
        made = arm.geometry.copy()
        for one in enclosing_capsules(bodies).geometryObjects:
            made.addGeometryObject(one)
        return made

    def exact() -> pin.GeometryModel | None:
        if arm.solids is None:
            return None
        made = arm.solids.copy()
        for one in bodies.geometryObjects:
            made.addGeometryObject(one)
        return made

    def silent() -> tuple[Exclusion, ...] | None:
        if arm.exclusions is None:
            return None
        in_touch = _always_in_touch(held, names)
        return (*arm.exclusions, *_beside_tool(held, names)[1], *in_touch)

    def beside() -> tuple[Neighbours, ...]:
        return (*arm.neighbours, *_beside_tool(held, names)[0])

    at_tip = None if tip is None else (TIP, tip)
    names = {one.name for one in bodies.geometryObjects}
    held = arm.reshaped(carried, f"{arm.name} with tool", at_tip, silent, beside, exact)
    return held


def name_of_tool(arm: Arm) -> str:
    """Name of what is put at the flange: ``tool``, unless a link is called so."""
    links, name = {link_of(one.name) for one in arm.geometry.geometryObjects}, TOOL
    while name in links:
        name = f"held_{name}"
    return name


def _beside_tool(held: Arm, tools: Collection[str]) -> tuple[list[Neighbours], list[Exclusion]]:
    """Parts of the tool and shapes of the link before that of the flange: those that are watched,
    and those that touch without saying anything. Without evidence of the arm capsules count."""
    shapes = held.geometry if held.fit is None or held.solids is None else held.solids
    known = [one.name in tools for one in shapes.geometryObjects]
    pairs = [(i, j) for i, j in adjacent_pairs(shapes) if known[i] != known[j]]
    return neighbours(held.model, shapes, pairs)


def _always_in_touch(held: Arm, tools: Collection[str]) -> list[Exclusion]:
    """Capsules of the arm in which parts of its tool are in every posture."""
    names, overlaps = links_of(held).names, always_overlapping(held)
    return [
        Exclusion(one, tool, Evidence.ALWAYS, SAMPLES, SAMPLES, SAMPLES)
        for a, one in enumerate(names)
        for b, tool in enumerate(names)
        if tool in tools and one not in tools and overlaps[a, b]
    ]
