"""The arms that stand in for the unnamed one, and whether their capsules contain their meshes."""

from __future__ import annotations

from itertools import product
from pathlib import Path

import coal
import numpy as np
import pinocchio as pin
from example_robot_data import getModelPath

from ...arms import Arm, load_arm
from ...control.link_capsules import sticking_out, with_capsules
from ...tracking import memo

#: Name in the assumption ``robot`` to the URDF whose meshes the capsules have to contain.
URDFS = {
    "panda": "panda_description/urdf/panda.urdf",
    "xarm7": "xarm_description/urdf/xarm7.urdf",
}
#: Radii [m] with which the capsules contain hand and base as well.
_WIDER = {"panda_hand_0": 0.057, "panda_link0_0": 0.101}
_CHECKED = 8
#: Entropy of everything random in this room.
SEED = 20240057
_FINGERS = ("panda_leftfinger_0", "panda_rightfinger_0")


@memo()
def redundant_arm(robot: str, capsules: str = "widened") -> Arm:
    """One arm of seven joints with its capsules.

    The collision model of the Panda has spheres at the ends of its capsules, which are left out;
    one capsule stands for both closed fingers.
    """
    arm = load_arm(robot)
    if robot != "panda":
        return arm
    fingers = [g for g in arm.geometry.geometryObjects if g.name in _FINGERS]
    middle = np.mean([g.placement.translation for g in fingers], axis=0)
    half = np.array([0.0, 0.0, fingers[0].geometry.halfLength])
    gap = np.linalg.norm(fingers[0].placement.translation - middle)
    radius = float(gap + fingers[0].geometry.radius)
    joint = fingers[0].parentJoint
    return with_capsules(
        arm,
        widened=_WIDER if capsules == "widened" else {},
        dropped=[g.name for g in arm.geometry.geometryObjects if "finger" in g.name],
        added=[("fingers", joint, middle - half, middle + half, radius)],
    )


@memo()
def mesh_excess(robot: str, capsules: str = "widened") -> dict[str, float]:
    """How far the vertices of the moving links' meshes stick out of the capsules of the arm [m].

    Checked in the neutral and in random configurations, since some links are covered by the capsule
    of the next one, which turns about its own axis.

    Returns
    -------
    dict
        Link mesh to the largest excess, negative if all vertices are inside in all configurations.
    """
    arm = redundant_arm(robot, capsules)
    path = Path(getModelPath(URDFS[robot])) / URDFS[robot]
    model = pin.buildModelFromUrdf(str(path))
    folders = [str(folder) for folder in path.resolve().parents]
    meshes = pin.buildGeomFromUrdf(
        model, str(path), pin.GeometryType.COLLISION, package_dirs=folders
    )
    locked = [k for k, name in enumerate(model.names) if k and name not in list(arm.model.names)]
    _, reduced = pin.buildReducedModel(model, meshes, locked, pin.neutral(model))
    configurations = arm.random_configurations(_CHECKED, np.random.default_rng(SEED))
    excess = {}
    for g in reduced.geometryObjects:
        if not g.parentJoint:
            continue
        points = _corners(g.geometry)
        placed = points @ g.placement.rotation.T + g.placement.translation
        excess[g.name] = max(sticking_out(arm, q, g.parentJoint, placed) for q in configurations)
    return excess


def _corners(shape: coal.CollisionGeometry) -> np.ndarray:
    """Vertices of a mesh or a box (N, 3)."""
    if isinstance(shape, coal.Box):
        return shape.halfSide * np.array(list(product((-1.0, 1.0), repeat=3)))
    return np.unique(np.array(shape.vertices()), axis=0)
