"""Which shapes of links that a joint joins are worth watching, by that joint's whole range.

Most of them touch in the bearing between them, and say nothing. Those that are apart at the home
pose and touch elsewhere are stops that the limits of the joint do not keep.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable

import numpy as np
import pinocchio as pin

from ..exclusions import Evidence, Exclusion, Neighbours
from .postures import contacts, home_pose, usual_range

STEPS = 181  # values of the joint over its range, both ends among them
APART = 2e-3  # distance at the home pose [m] of shapes whose contact elsewhere counts


def neighbours(
    model: pin.Model, shapes: pin.GeometryModel, pairs: Iterable[tuple[int, int]]
) -> tuple[list[Neighbours], list[Exclusion]]:
    """Those of pairs of adjacent shapes that are watched, and of the others those that touch.

    Their place relative to each other is a matter of one joint. A pair is watched if it is at least
    :data:`APART` apart at the home pose and touches for some of :data:`STEPS` values of its joint;
    what touches for none is neither watched nor listed.

    Parameters
    ----------
    pairs
        Indices of shapes of joints next to each other.
    """
    watched, silent = list[Neighbours](), list[Exclusion]()
    of_joint = defaultdict(list)
    for i, j in pairs:
        of_joint[max(shapes.geometryObjects[k].parentJoint for k in (i, j))].append((i, j))
    lower, upper = usual_range(model)
    home = home_pose(model)
    for joint, own in sorted(of_joint.items()):
        at = model.joints[joint].idx_q
        q = np.tile(home, (STEPS, 1))
        q[:, at] = np.linspace(lower[at], upper[at], STEPS)
        counts = contacts(model, shapes, own, q).sum(axis=0).tolist()
        near = contacts(model, shapes, own, home[np.newaxis], APART)[0]
        for (i, j), count, close in zip(own, counts, near, strict=True):
            names = shapes.geometryObjects[i].name, shapes.geometryObjects[j].name
            if 0 < count < STEPS and not close:
                watched.append(Neighbours(*names, count, STEPS))
            elif count:
                silent.append(Exclusion(*names, Evidence.ADJACENT, count, STEPS, STEPS))
    return watched, silent


def adjacent_pairs(shapes: pin.GeometryModel) -> list[tuple[int, int]]:
    """Indices of shapes that one joint joins."""
    joints = [shape.parentJoint for shape in shapes.geometryObjects]
    count = range(len(joints))
    return [(i, j) for i in count for j in count[i + 1 :] if abs(joints[i] - joints[j]) == 1]
