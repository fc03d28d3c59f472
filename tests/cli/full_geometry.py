"""Replay of a written plan by full geometry: Pinocchio and coal on the files, nothing of ours.

Arms that a URDF describes are its own collision shapes; arms of a table, which has no meshes, are
their capsules, placed by Pinocchio.
"""

from pathlib import Path

import coal
import numpy as np
import pandas as pd
import pinocchio as pin
import yaml
from scipy.spatial.transform import Rotation

from dualarm_repro.arms import load_arm

#: Postures that are looked at, spread over the motion.
LOOKS = 30


class Posed:
    """Shapes of one arm and where its joints put them."""

    def __init__(self, folder, entry, table):
        turn = Rotation.from_euler("xyz", entry.get("rpy", [0, 0, 0])).as_matrix()
        self.base = pin.SE3(turn, np.array(entry.get("xyz", [0, 0, 0]), dtype=float))
        options = {k: entry[k] for k in ("flange", "lock") if k in entry}
        file = folder / entry["robot"]
        arm = load_arm(file if file.is_file() else entry["robot"], **options)
        self.names, self.lock = list(arm.model.names)[1:], entry.get("lock", {})
        self.q = table[[f"q{k + 1}" for k in range(arm.nq)]].to_numpy()
        self.model, self.shapes = arm.model, arm.geometry
        if file.suffix == ".urdf":
            self.model = pin.buildModelFromUrdf(str(file))
            folders = [str(one) for one in file.parents]
            self.shapes = pin.buildGeomFromUrdf(
                self.model, str(file), pin.GeometryType.COLLISION, package_dirs=folders
            )
        silent = arm.exclusions or ()
        self.silent = {frozenset((one.first, one.second)) for one in silent}
        self.exact = file.suffix == ".urdf"
        self.moved = self._carried()

    def _carried(self):
        """Number of the arm's joints between the base and each shape."""
        joints = [self.model.getJointId(name) for name in self.names]
        found = []
        for shape in self.shapes.geometryObjects:
            support = set(self.model.supports[shape.parentJoint])
            found.append(sum(joint in support for joint in joints))
        return found

    def bodies(self, row):
        """Name, joints between, shape and pose in the world of every shape, at a row."""
        whole = pin.neutral(self.model)
        values = dict(zip(self.names, self.q[min(row, len(self.q) - 1)], strict=True))
        for name, value in {**self.lock, **values}.items():
            joint = self.model.joints[self.model.getJointId(name)]
            at = slice(joint.idx_q, joint.idx_q + joint.nq)
            whole[at] = [np.cos(value), np.sin(value)] if joint.nq == 2 else value
        data = self.model.createData()
        pin.forwardKinematics(self.model, data, whole)
        return [
            (one.name, moved, one.geometry, self.base * data.oMi[one.parentJoint] * one.placement)
            for one, moved in zip(self.shapes.geometryObjects, self.moved, strict=True)
        ]


class Replay:
    """The motion that `dualarm plan` has written for a scene."""

    def __init__(self, scene, out, solids=()):
        self.scene = yaml.safe_load(scene.read_text(encoding="utf-8"))
        self.arms, self.solids = {}, list(solids)
        for name, entry in self.scene["arms"].items():
            file = out / f"{scene.stem}_{name}.csv"
            start = entry["start"]
            table = pd.DataFrame([start], columns=[f"q{k + 1}" for k in range(len(start))])
            if file.is_file():
                table = pd.read_csv(file, comment="#")
            self.arms[name] = Posed(Path(scene.parent), entry, table)
        for one in self.scene.get("obstacles", {}).values():
            if one["kind"] == "sphere":
                at = pin.SE3(np.eye(3), np.array(one["center"], dtype=float))
                self.solids.append((coal.Sphere(one["radius"]), at))
        if "floor" in self.scene:
            at = pin.SE3(np.eye(3), np.array([0.0, 0.0, float(self.scene["floor"])]))
            self.solids.append((coal.Halfspace(np.array([0.0, 0.0, 1.0]), 0.0), at))
        self.length = max(len(arm.q) for arm in self.arms.values())

    def rows(self):
        """Rows that are looked at."""
        return np.unique(np.linspace(0, self.length - 1, LOOKS).round().astype(int))

    def smallest(self):
        """Smallest distance of shapes of different arms, and of moving shapes and solids [m]."""
        least = np.inf
        for row in self.rows():
            arms = [arm.bodies(row) for arm in self.arms.values()]
            for k, bodies in enumerate(arms):
                others = [(shape, at) for more in arms[k + 1 :] for _, _, shape, at in more]
                for _, moved, shape, at in bodies:
                    for other, to in others + (self.solids if moved > 1 else []):
                        least = min(least, apart(shape, at, other, to, least))
        return least

    def touching(self):
        """Shapes of one arm, two or more joints apart, that touch at one of the rows."""
        found = set()
        for row in self.rows():
            for arm in self.arms.values():
                bodies = arm.bodies(row) if arm.exact else []
                for k, (one, low, shape, at) in enumerate(bodies):
                    for other, high, more, to in bodies[k + 1 :]:
                        if abs(high - low) <= 1 or frozenset((one, other)) in arm.silent:
                            continue
                        if apart(shape, at, more, to, 1e-9) <= 0.0:
                            found.add((one, other))
        return found


def apart(shape, at, other, to, enough):
    """Distance of two shapes [m], or ``enough`` if balls around them are farther apart."""
    if not isinstance(shape, coal.Halfspace) and not isinstance(other, coal.Halfspace):
        for one in (shape, other):
            if one.aabb_radius <= 0.0:
                one.computeLocalAABB()
        centres = at.act(shape.aabb_center) - to.act(other.aabb_center)
        if np.linalg.norm(centres) - shape.aabb_radius - other.aabb_radius > enough:
            return enough
    places = [coal.Transform3s(one.rotation, one.translation) for one in (at, to)]
    asked, answer = coal.DistanceRequest(), coal.DistanceResult()
    return coal.distance(shape, places[0], other, places[1], asked, answer)
