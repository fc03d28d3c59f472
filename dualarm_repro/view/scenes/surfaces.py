"""Triangles of the parts of a scene, with the normals that light them."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .contents import Part

_AROUND, _ARC = 28, 8
_BEVEL = 0.12  # of the radius of a rod


class Surface(NamedTuple):
    """Triangles ``faces`` (F, 3) of ``vertices`` (V, 3), with a normal (V, 3) for each vertex."""

    vertices: np.ndarray
    normals: np.ndarray
    faces: np.ndarray


def surface(part: Part) -> Surface:
    """The surface of a part in the frame of its node; a cloud and a polyline have none."""
    match part.kind:
        case "tapered":
            made = _lathe(*tapered_profile(*part.size))
        case "rod":
            made = _lathe(*_rod_profile(*part.size))
        case "box":
            made = _box(np.array(part.size))
        case "mesh":
            made = _mesh(np.asarray(part.vertices), np.asarray(part.faces))
        case _:
            raise ValueError(f"a part of the kind {part.kind} has no surface")
    turn, shift = part.pose[:3, :3], part.pose[:3, 3]
    return Surface(made.vertices @ turn.T + shift, made.normals @ turn.T, made.faces)


def tapered_profile(lower: float, upper: float, length: float) -> tuple[np.ndarray, np.ndarray]:
    """Points (r, z) and normals of the hull of two balls that lie ``length`` apart on z.

    The cone touches both where sin(phi) = (lower - upper) / length.
    """
    if length <= abs(lower - upper):
        ball, middle = max(lower, upper), 0.5 * length * (1 if upper > lower else -1)
        lower = upper = ball
        bottom = top = middle
    else:
        bottom, top = -0.5 * length, 0.5 * length
    touch = np.arcsin((lower - upper) / length) if length > abs(lower - upper) else 0.0
    below = np.linspace(-0.5 * np.pi, touch, _ARC)
    above = np.linspace(touch, 0.5 * np.pi, _ARC)
    normals = np.column_stack([np.cos(np.append(below, above)), np.sin(np.append(below, above))])
    radius = np.repeat([lower, upper], _ARC)[:, np.newaxis]
    return normals * radius + [0.0, 1.0] * np.repeat([[bottom], [top]], _ARC, axis=0), normals


def _rod_profile(radius: float, height: float) -> tuple[np.ndarray, np.ndarray]:
    half, bevel = 0.5 * height, min(_BEVEL * radius, 0.3 * height)
    corners = np.array(
        [
            [0.0, -half],
            [radius - bevel, -half],
            [radius, -half + bevel],
            [radius, half - bevel],
            [radius - bevel, half],
            [0.0, half],
        ]
    )
    edges = np.diff(corners, axis=0)
    across = np.column_stack([edges[:, 1], -edges[:, 0]])
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    points = np.column_stack([corners[:-1], corners[1:]]).reshape(-1, 2)
    return points, np.repeat(across, 2, axis=0)


def _lathe(profile: np.ndarray, normals: np.ndarray) -> Surface:
    """A profile (r, z) turned about z."""
    angle = np.linspace(0.0, 2.0 * np.pi, _AROUND + 1)
    turned = []
    for rows in (profile, normals):
        r, z = rows[:, 0][:, np.newaxis], rows[:, 1][:, np.newaxis]
        spread = np.broadcast_to(z, (len(rows), len(angle)))
        turned.append(np.stack([r * np.cos(angle), r * np.sin(angle), spread], axis=-1))
    row, column = np.meshgrid(np.arange(len(profile) - 1), np.arange(_AROUND), indexing="ij")
    first = row * (_AROUND + 1) + column
    here, after = first.ravel(), first.ravel() + _AROUND + 1
    faces = np.concatenate(
        [
            np.column_stack([here, here + 1, after + 1]),
            np.column_stack([here, after + 1, after]),
        ]
    )
    return Surface(turned[0].reshape(-1, 3), turned[1].reshape(-1, 3), faces)


def _box(size: np.ndarray) -> Surface:
    vertices: list[np.ndarray] = []
    normals: list[np.ndarray] = []
    faces: list[list[int]] = []
    for axis in range(3):
        for side in (-1.0, 1.0):
            u, v = np.roll(np.eye(3), -axis - 1, axis=0)[:2]
            out = side * np.eye(3)[axis]
            corners = [out + a * u + b * side * v for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
            start = len(vertices)
            vertices += [0.5 * size * corner for corner in corners]
            normals += [out] * 4
            faces += [[start, start + 1, start + 2], [start, start + 2, start + 3]]
    return Surface(np.array(vertices), np.array(normals), np.array(faces))


def _mesh(vertices: np.ndarray, faces: np.ndarray) -> Surface:
    """Normals are those of the triangles around a vertex, weighted by their areas."""
    corners = vertices[faces]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals = np.zeros_like(vertices)
    for k in range(3):
        np.add.at(normals, faces[:, k], across)
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    return Surface(vertices, normals / np.where(length > 0.0, length, 1.0), faces)
