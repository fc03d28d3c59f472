"""Whether the capsules of an arm contain the meshes of its moving links."""

from __future__ import annotations

from itertools import product
from pathlib import Path

import coal
import numpy as np
import pinocchio as pin
from example_robot_data import getModelPath

from ...control.link_capsules import sticking_out
from ...tracking import memo
from .constants import SEED
from .robots import redundant_arm

#: Name in the assumption ``robot`` to the URDF whose meshes the capsules have to contain.
URDFS = {
    "panda": "panda_description/urdf/panda.urdf",
    "xarm7": "xarm_description/urdf/xarm7.urdf",
}
_CHECKED = 8


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
