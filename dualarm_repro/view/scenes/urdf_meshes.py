"""Visual meshes of an arm, with few triangles, where their licence lets them be shown."""

from __future__ import annotations

import re
from base64 import b64decode, b64encode
from collections.abc import Iterator
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import Any

import numpy as np
import pinocchio as pin
from example_robot_data import getModelPath

from ...arms import Arm
from ...arms.catalog import arm_names
from ...arms.robot_file import URDFRobot, load_robot_file
from ...datafiles import data_path
from ...ledger import REGISTRY, kept
from ...ledger.closure import hash_file
from .contents import Part

#: What a description's README or LICENSE may say for its meshes to be part of a page.
_FREE = re.compile(r"license:\s*(BSD|Apache|MIT)", re.IGNORECASE)
#: Triangles of a whole arm.
_BUDGET = 12_000
_KIND = "meshes"
_Meshes = tuple[list[str], list[tuple[int, np.ndarray, np.ndarray, np.ndarray]]]


def visual_parts(name: str, arm: Arm, color: str, base: str) -> list[Part]:
    """The meshes of a catalogue arm as parts; empty if it has none that may be shown.

    The description is that of ``data/robots``, whose README names a licence that lets the meshes be
    passed on. The arm of a reader is drawn from its capsules.
    """
    path = _description(arm)
    return [] if path is None else list(_parts(name, arm, color, base, path))


def decimated(
    vertices: np.ndarray, faces: np.ndarray, cell: float
) -> tuple[np.ndarray, np.ndarray]:
    """Triangles whose corners are joined where they share a cube of edge ``cell``.

    J. Rossignac, P. Borrel, Multi-resolution 3D approximations for rendering, 1993.
    """
    keys = _in_order(np.floor(vertices / cell).astype(np.int64))
    _, where, counts = np.unique(keys, return_inverse=True, return_counts=True)
    joined = np.zeros((len(counts), 3))
    np.add.at(joined, where, vertices)
    kept = where[faces]
    proper = (kept[:, 0] != kept[:, 1]) & (kept[:, 1] != kept[:, 2]) & (kept[:, 2] != kept[:, 0])
    _, first = np.unique(_in_order(np.sort(kept[proper], axis=1)), return_index=True)
    return joined / counts[:, np.newaxis], kept[proper][np.sort(first)]


def _in_order(rows: np.ndarray) -> np.ndarray:
    """One number for each row of three integers (N, 3), in the order of the rows: sorted several
    times faster than they are."""
    rows = rows - rows.min(axis=0, initial=0)
    spans = rows.max(axis=0, initial=0) + 1
    return np.asarray((rows[:, 0] * spans[1] + rows[:, 1]) * spans[2] + rows[:, 2])


def _description(arm: Arm) -> Path | None:
    if arm.name not in arm_names():
        return None
    robot = load_robot_file(data_path("robots", f"{arm.name}.yaml"))
    if not isinstance(robot, URDFRobot):
        return None
    path = Path(getModelPath(robot.urdf)) / robot.urdf
    readme = path.parents[len(Path(robot.urdf).parts) - 2] / "README.md"
    free = readme.is_file() and _FREE.search(readme.read_text(encoding="utf-8"))
    return path if free else None


def _parts(name: str, arm: Arm, color: str, base: str, path: Path) -> Iterator[Part]:
    names, meshes = _meshes(path, frozenset(arm.model.names))
    if names != list(arm.model.names):
        return
    carriers = {shape.parentJoint for shape in arm.geometry.geometryObjects}
    for joint, pose, vertices, faces in meshes:
        node = f"{name}/{joint}" if joint else base
        body = f"{name}:{joint}" if joint in carriers else None
        yield Part(node, "mesh", (), color, pose, body=body, vertices=vertices, faces=faces)


@cache
def _meshes(path: Path, joints: frozenset[str]) -> _Meshes:
    """Names of the joints, and of each mesh the joint, the pose there, and few triangles.

    They are kept from one process to the next, for this code, this description and the versions of
    what reads it: reading all triangles takes longer than a plan.
    """
    name = sha256(" ".join([hash_file(path), *sorted(joints)]).encode()).hexdigest()[:32]
    found = kept.read(REGISTRY, _KIND, name)
    if found is None:
        names, meshes = _decimated_meshes(path, joints)
        written = [[joint, *map(_written, arrays)] for joint, *arrays in meshes]
        found = {"names": names, "meshes": written}
        kept.keep(REGISTRY, _KIND, name, found, [__name__], [], drawn=True)
    return found["names"], [(mesh[0], *map(_read, mesh[1:])) for mesh in found["meshes"]]


def _written(array: np.ndarray) -> dict[str, Any]:
    """An array as JSON holds it, every bit of it."""
    form = {"type": array.dtype.str, "shape": list(array.shape)}
    return {**form, "bytes": b64encode(array.tobytes()).decode()}


def _read(written: dict[str, Any]) -> np.ndarray:
    flat = np.frombuffer(b64decode(written["bytes"]), dtype=written["type"])
    return flat.reshape(written["shape"]).copy()


def _decimated_meshes(path: Path, joints: frozenset[str]) -> _Meshes:
    full = pin.buildModelFromUrdf(str(path))
    folders = [str(folder) for folder in path.resolve().parents]
    shapes = pin.buildGeomFromUrdf(full, str(path), pin.GeometryType.VISUAL, package_dirs=folders)
    locked = [k for k in range(1, full.njoints) if full.names[k] not in joints]
    reduced, shapes = pin.buildReducedModel(full, shapes, locked, pin.neutral(full))
    found = [s for s in shapes.geometryObjects if hasattr(s.geometry, "tri_indices")]
    raw = [(np.asarray(m.geometry.vertices()) * m.meshScale, _triangles(m.geometry)) for m in found]
    cells = np.array([0.015 * float(np.ptp(vertices, axis=0).max()) for vertices, _ in raw])
    small = [decimated(*one, cell) for one, cell in zip(raw, cells, strict=True)]
    while sum(len(faces) for _, faces in small) > _BUDGET:
        cells *= 1.15
        small = [decimated(*one, cell) for one, cell in zip(raw, cells, strict=True)]
    placed = [(m.parentJoint, m.placement.homogeneous) for m in found]
    return list(reduced.names), [(*at, *few) for at, few in zip(placed, small, strict=True)]


def _triangles(geometry: Any) -> np.ndarray:
    rows = map(geometry.tri_indices, range(geometry.num_tris))
    return np.array([(row[0], row[1], row[2]) for row in rows])
