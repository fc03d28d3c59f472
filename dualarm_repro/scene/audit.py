"""What a loaded arm is worth, against Pinocchio and the exact shapes of its own file."""

from __future__ import annotations

from collections import defaultdict
from pathlib import Path
from time import process_time
from typing import Any

import coal
import numpy as np
import pinocchio as pin
import scipy

from ..arms import load_arm
from ..arms.arm import Arm
from ..arms.capsules import capsule_ends, to_segment
from ..arms.exclusions import Evidence, shape_of
from ..arms.fit.evidence import watched_pairs
from ..arms.fit.neighbours import adjacent_pairs
from ..arms.fit.postures import contacts, home_pose
from ..arms.fit.triangles import triangles_of
from ..errors import DualArmError, UnsupportedArmError
from .bodies import PlacedArm
from .clearance import distances
from .exact_shapes import exact_minimum
from .moving import JointPath
from .scene import Scene

_FOR_GOOD = (Evidence.ALWAYS, Evidence.HOME)
_PROBES = 4000  # points of a shape by which volumes are compared


def audit(path: Path, rng: np.random.Generator, postures: int = 400) -> dict[str, Any]:
    """One row: whether a URDF loads, and if so how true its kinematics and its capsules are.

    ``fk`` [m] is the largest difference from Pinocchio's model of the whole file, ``outside`` [m]
    how far a vertex of a shape is outside the capsules of its shape, ``excess`` the volume of the
    capsules over that of the convex parts in them, ``clear`` how many postures
    the exact shapes call free of self-collision, ``false_alarms`` how many of these the capsules
    flag, ``missed`` how many others they do not. Shapes that touch in every posture,
    or at the home pose and in most, are listed by the arm and count for neither. ``home`` tells the
    same of the home pose. ``seconds`` of the processor it took to load, which the cache shortens.
    """
    begin = process_time()
    try:
        arm = load_arm(path)
        arm.geometry  # noqa: B018  the meshes shall be read here
    except DualArmError as error:
        return {"loads": False, "said": str(error), "seconds": process_time() - begin}
    seconds = process_time() - begin
    q = arm.random_configurations(postures, rng)
    touching, flagged = _touching(arm, q), _flagged(arm, q)
    home = home_pose(arm.model)
    return {
        "loads": True,
        "said": "",
        "seconds": seconds,
        "joints": arm.nq,
        "flange": arm.model.frames[arm.flange_id].name,
        "prismatic": int(arm.slides.sum()),
        "continuous": int(arm.turns_for_ever.sum()),
        "shapes": arm.solids.ngeoms if arm.solids else 0,
        "capsules": arm.geometry.ngeoms,
        "excluded": len(arm.exclusions or ()),
        "fk": fk_error(path, arm, q[:20]),
        "outside": outside(arm),
        "excess": excess(arm),
        "home_clear": not _touching(arm, home[np.newaxis], q)[0],
        "home_flagged": bool(_flagged(arm, home[np.newaxis])[0]),
        "clear": int((~touching).sum()),
        "false_alarms": int((flagged & ~touching).sum()),
        "missed": int((touching & ~flagged).sum()),
    }


def fk_error(path: Path, arm: Arm, q: np.ndarray) -> float:
    """Largest difference of T(q) from Pinocchio's own model of the whole file [m, 1]."""
    full = pin.buildModelFromUrdf(str(path))
    data, worst = full.createData(), 0.0
    names = list(arm.model.names)[1:]
    frame = full.getFrameId(arm.model.frames[arm.flange_id].name, pin.FrameType.BODY)
    for row, pose in zip(q, arm.fk(q), strict=True):
        whole = pin.neutral(full)
        for name, value in zip(names, row, strict=True):
            joint = full.joints[full.getJointId(name)]
            at = slice(joint.idx_q, joint.idx_q + joint.nq)
            whole[at] = [np.cos(value), np.sin(value)] if joint.nq == 2 else value
        pin.framesForwardKinematics(full, data, whole)
        both = np.abs(data.oMf[frame].homogeneous - pose), np.abs(pose - arm.fk(row))
        worst = max(worst, *(float(part.max()) for part in both))
    return worst


def outside(arm: Arm) -> float:
    """How far a vertex of an exact shape is outside all capsules of its joint [m]."""
    if arm.solids is None:
        raise UnsupportedArmError(f"arm {arm.name}: its exact shapes are not known")
    worst = -np.inf
    for shape in arm.solids.geometryObjects:
        if isinstance(shape.geometry, coal.Sphere | coal.Capsule):
            continue
        points = _surface(shape.geometry)
        points = points @ shape.placement.rotation.T + shape.placement.translation
        gaps = [
            to_segment(points, *capsule_ends(one.placement, one.geometry)) - one.geometry.radius
            for one in arm.geometry.geometryObjects
            if one.parentJoint == shape.parentJoint
        ]
        worst = max(worst, float(np.min(gaps, axis=0).max()))
    return worst


def _surface(solid: coal.CollisionGeometry) -> np.ndarray:
    """Points (N, 3) whose convex hull or whose triangles are the shape [m]."""
    if not isinstance(solid, coal.Cylinder):
        return triangles_of(solid).reshape(-1, 3)
    turn = np.linspace(0.0, 2.0 * np.pi, 180)
    rim = solid.radius * np.column_stack([np.cos(turn), np.sin(turn)])
    ends = (np.full(len(turn), z) for z in (-solid.halfLength, solid.halfLength))
    return np.vstack([np.column_stack([rim, z]) for z in ends])


def excess(arm: Arm) -> float:
    """Volume of the capsules over that of the convex parts that they contain, by points spread over
    each shape; balls and capsules count as themselves."""
    volumes = np.zeros(2)
    of_shape = defaultdict(list)
    for one in arm.geometry.geometryObjects:
        of_shape[shape_of(one.name)].append(one)
    for capsules in of_shape.values():
        ends = [capsule_ends(one.placement, one.geometry) for one in capsules]
        radii = [one.geometry.radius for one in capsules]
        corners = np.concatenate([np.array(pair) for pair in ends])
        low, high = corners.min(axis=0) - max(radii), corners.max(axis=0) + max(radii)
        probes = low + scipy.stats.qmc.Halton(3, seed=0).random(_PROBES) * (high - low)
        in_capsule, in_part = (np.zeros(_PROBES, dtype=bool) for _ in range(2))
        for one, pair, radius in zip(capsules, ends, radii, strict=True):
            inside = to_segment(probes, *pair) <= radius
            in_capsule |= inside
            if one.name in arm.hulls:
                planes = scipy.spatial.ConvexHull(arm.hulls[one.name]).equations
                inside &= (probes @ planes[:, :3].T + planes[:, 3] <= 0.0).all(axis=1)
            in_part |= inside
        volumes += np.prod(high - low) * np.array([in_capsule.mean(), in_part.mean()])
    return float(volumes[0] / volumes[1])


def _touching(arm: Arm, q: np.ndarray, sample: np.ndarray | None = None) -> np.ndarray:
    """Whether exact shapes two or more joints apart touch (N,), but for those that always do and
    those that touch at the home pose for good, which the arm lists, or neighbours that count."""
    if arm.solids is None:
        raise UnsupportedArmError(f"arm {arm.name}: its exact shapes are not known")
    names = [shape.name for shape in arm.solids.geometryObjects]
    listed = {(one.first, one.second) for one in arm.exclusions or () if one.evidence in _FOR_GOOD}
    near = {(one.first, one.second) for one in arm.neighbours}
    pairs = [(i, j) for i, j in watched_pairs(arm.solids) if (names[i], names[j]) not in listed]
    pairs += [(i, j) for i, j in adjacent_pairs(arm.solids) if (names[i], names[j]) in near]
    found = contacts(arm.model, arm.solids, pairs, q)
    always = found if sample is None else contacts(arm.model, arm.solids, pairs, sample)
    return np.asarray(found[:, ~always.all(axis=0)].any(axis=1))


def _flagged(arm: Arm, q: np.ndarray) -> np.ndarray:
    """Whether watched capsules of the arm alone overlap, or exact shapes of which they do not tell
    touch (N,)."""
    placed = PlacedArm("arm", arm)
    scene = Scene([placed])
    flagged = np.asarray((distances(scene, q) <= 0.0).any(axis=1))
    for k in np.flatnonzero(~flagged):
        exact = exact_minimum(scene, placed, JointPath([q[k]]), 0.0, np.inf)
        if exact is None:
            break
        flagged[k] = exact[0].upper <= 0.0
    return flagged
