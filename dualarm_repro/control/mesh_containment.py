"""Whether the capsules of an arm contain the meshes of its moving links."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pinocchio as pin

from ..arms.arm import Arm
from ..arms.capsules import corners
from .link_capsules import sticking_out


def mesh_excess(arm: Arm, urdf: Path, configurations: np.ndarray) -> dict[str, float]:
    """How far the vertices of the moving links' meshes stick out of the capsules of the arm [m].

    Several configurations have to be checked, since some links are covered by the capsule of the
    next one, which turns about its own axis.

    Parameters
    ----------
    urdf
        File of the same arm, whose collision meshes are taken; joints that the arm has not are
        locked at zero.
    configurations : (N, nq) [rad]

    Returns
    -------
    dict
        Link mesh to the largest excess, negative if all vertices are inside in all configurations.
    """
    model = pin.buildModelFromUrdf(str(urdf))
    folders = [str(folder) for folder in urdf.resolve().parents]
    meshes = pin.buildGeomFromUrdf(
        model, str(urdf), pin.GeometryType.COLLISION, package_dirs=folders
    )
    locked = [k for k, name in enumerate(model.names) if k and name not in list(arm.model.names)]
    _, reduced = pin.buildReducedModel(model, meshes, locked, pin.neutral(model))
    excess = {}
    for g in reduced.geometryObjects:
        if not g.parentJoint:
            continue
        points = np.unique(corners(g.geometry), axis=0)
        placed = points @ g.placement.rotation.T + g.placement.translation
        excess[g.name] = max(sticking_out(arm, q, g.parentJoint, placed) for q in configurations)
    return excess
