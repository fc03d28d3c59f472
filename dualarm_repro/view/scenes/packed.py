"""A scene as a short JSON text: whole numbers of 16 bits for poses, points and triangles."""

from __future__ import annotations

import json
from base64 import b64encode
from typing import Any

import numpy as np
import pinocchio as pin

from .camera import FIELD, Camera
from .contents import Contents, Part
from .floor import Floor

_FULL = 32767


def packed(contents: Contents, camera: Camera, floor: Floor | None) -> str:
    """What the viewer reads; a text that may stand inside a script element."""
    names = list(contents.nodes)
    body_names = sorted({part.body for part in contents.parts if part.body})
    index = {name: k for k, name in enumerate(body_names)}
    meshes: list[dict[str, Any]] = []
    made: dict[str, Any] = {
        "title": contents.title,
        "eye": _short(camera.eye),
        "target": _short(camera.target),
        "field": round(float(np.rad2deg(FIELD)), 2),
        "floor": floor and [floor.height, floor.cell, *floor.low, *floor.high],
        "nodes": [_pose(contents.nodes[name]) for name in names],
        "parts": [_part(part, names, index, meshes) for part in contents.parts],
        "checked": [_part(part, names, index, meshes) for part in contents.checked],
        "meshes": meshes,
        "marks": [[m.text, names.index(m.node), *_short(m.point)] for m in contents.marks],
    }
    if contents.motion:
        motion = contents.motion
        moving = [name for name in names if name in motion.poses]
        poses = np.array([[_pose(pose) for pose in motion.poses[name]] for name in moving])
        reach = max(float(abs(poses[..., :3]).max()), 1e-6)
        poses[..., :3] /= reach
        made["motion"] = {
            "frames": motion.frames.tolist(),
            "fps": motion.fps,
            "nodes": [names.index(name) for name in moving],
            "reach": reach,
            "poses": _whole(poses),
        }
    if contents.nearest:
        found = contents.nearest
        texts = sorted(set(found.names))
        made["nearest"] = {
            "mm": [round(1e3 * float(d), 2) for d in found.distance],
            "ends": _short(found.ends.ravel()),
            "names": texts,
            "which": [texts.index(pair) for pair in found.names],
            "contacts": [sorted(index[b] for b in c if b in index) for c in found.contacts],
        }
    # "<" could open a comment or a script inside the element that holds the data.
    return json.dumps(made, separators=(",", ":")).replace("<", "\\u003c")


def _part(
    part: Part, names: list[str], index: dict[str, int], meshes: list[dict[str, Any]]
) -> dict[str, Any]:
    """A part; triangles that several parts share are put into ``meshes`` once."""
    made: dict[str, Any] = {
        "n": names.index(part.node),
        "k": part.kind,
        "s": _short(part.size),
        "c": part.color,
    }
    if part.opacity < 1.0:
        made["o"] = part.opacity
    if part.body is not None and part.body in index:
        made["b"] = index[part.body]
    if not np.array_equal(part.pose, np.eye(4)):
        made["p"] = _pose(part.pose)
    if part.vertices is not None:
        reach = max(float(abs(part.vertices).max()), 1e-6)
        shape = {"r": reach, "v": _whole(part.vertices / reach)}
        if part.faces is not None:
            shape["f"] = _bytes(part.faces, "<u2")
        if shape not in meshes:
            meshes.append(shape)
        made["m"] = meshes.index(shape)
    return made


def _pose(pose: np.ndarray) -> list[float]:
    x, y, z, qx, qy, qz, qw = pin.SE3ToXYZQUAT(pin.SE3(np.asarray(pose, dtype=float)))
    return _short([x, y, z, qx, qy, qz, qw])


def _short(values: Any) -> list[float]:
    return [round(float(value), 5) for value in values]


def _whole(values: np.ndarray) -> str:
    return _bytes(np.round(values * _FULL), "<i2")


def _bytes(values: np.ndarray, kind: str) -> str:
    return b64encode(np.ascontiguousarray(values, dtype=kind).tobytes()).decode()
