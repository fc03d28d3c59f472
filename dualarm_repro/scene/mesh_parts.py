"""A triangle mesh as convex parts that contain its whole surface.

The parts are those of an approximate convex decomposition (V-HACD: K. Mamou, F. Ghorbel, A simple
and efficient approach for 3D mesh approximate convex decomposition, ICIP 2009). They may lose
slivers of the mesh, so each triangle is given to the part it sticks out of least, and every part
becomes the hull of itself and of its triangles: nothing that touches the mesh is clear of all
parts.
"""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path

import coal
import numpy as np
import scipy

from ..errors import DataFileError
from ..input_files import LARGEST_MESH, require_regular
from .hull import ConvexHull

FORMATS = (".stl", ".obj", ".dae", ".ply")
#: Most triangles that are taken apart.
MOST_TRIANGLES = 200_000
#: Voxels in which a mesh is taken apart.
_RESOLUTION = 50_000
#: Edges of the triangles that are given to parts, as a share of the size of the mesh: 1 / this.
_FINENESS = 24


def read_mesh(path: Path, scale: tuple[float, float, float]) -> tuple[np.ndarray, np.ndarray]:
    """Vertices (V, 3) [m] and triangles (F, 3) of a mesh file.

    Raises
    ------
    DataFileError
        Missing, of another format, broken, flat or too large.
    """
    if path.suffix.lower() not in FORMATS:
        expected = f"a mesh file that ends in {', '.join(FORMATS)}"
        raise DataFileError(path, "file", path.suffix, expected)
    require_regular(path, "a readable mesh file", LARGEST_MESH)
    try:
        model = coal.MeshLoader().load(str(path), np.array(scale))
        vertices = np.array(model.vertices())
        faces = np.array(
            [[t[0], t[1], t[2]] for t in map(model.tri_indices, range(model.num_tris))]
        )
    except (RuntimeError, ValueError, IndexError):
        raise DataFileError(path, "content", "unreadable", "a mesh of triangles") from None
    if len(faces) == 0 or not np.isfinite(vertices).all():
        raise DataFileError(path, "triangles", len(faces), "triangles with finite corners")
    if len(faces) > MOST_TRIANGLES:
        raise DataFileError(path, "triangles", len(faces), f"at most {MOST_TRIANGLES}")
    return vertices, faces.astype(np.int64)


@lru_cache(maxsize=32)
def mesh_parts(path: Path, scale: tuple[float, float, float], most: int) -> tuple[ConvexHull, ...]:
    """At most ``most`` convex parts whose union contains the surface of a mesh, in its own frame.

    One part is the convex hull of the mesh.

    Raises
    ------
    DataFileError
        A mesh that cannot be read or spans no volume.
    """
    vertices, faces = read_mesh(path, scale)
    try:
        whole = scipy.spatial.ConvexHull(vertices)
    except (scipy.spatial.QhullError, ValueError):
        raise DataFileError(path, "triangles", len(faces), "a mesh that spans a volume") from None
    if most == 1 or len(whole.vertices) == len(np.unique(faces)):
        return (ConvexHull(vertices),)
    edge = np.ptp(vertices, axis=0).max() / _FINENESS
    return covering(_decomposed(vertices, faces, most), divided(vertices[faces], edge))


def covering(pieces: list[np.ndarray], triangles: np.ndarray) -> tuple[ConvexHull, ...]:
    """Hulls of point sets grown until each of the triangles (F, 3, 3) lies in one of them."""
    hulls = [scipy.spatial.ConvexHull(points) for points in pieces]
    excess = np.empty((len(triangles), len(hulls)))
    for column, hull in zip(excess.T, hulls, strict=True):
        heights = triangles @ hull.equations[:, :3].T + hull.equations[:, 3]
        column[:] = heights.max(axis=(1, 2))
    owner = excess.argmin(axis=1)
    return tuple(
        ConvexHull(np.vstack([points, triangles[owner == k].reshape(-1, 3)]))
        for k, points in enumerate(pieces)
    )


def divided(triangles: np.ndarray, edge: float) -> np.ndarray:
    """The same surface in triangles (F, 3, 3) whose edges are no longer than ``edge`` [m].

    A triangle is halved at the middle of its longest edge, again and again.
    """
    done = []
    while len(triangles):
        lengths = np.linalg.norm(triangles - np.roll(triangles, -1, axis=1), axis=2)
        long = lengths.max(axis=1) > edge
        done.append(triangles[~long])
        triangles, first = triangles[long], lengths[long].argmax(axis=1)
        rows = np.arange(len(triangles))
        a, b, c = (triangles[rows, (first + k) % 3] for k in range(3))
        middle = 0.5 * (a + b)
        triangles = np.concatenate(
            [np.stack([a, middle, c], axis=1), np.stack([middle, b, c], axis=1)]
        )
    return np.concatenate(done)


def _decomposed(vertices: np.ndarray, faces: np.ndarray, most: int) -> list[np.ndarray]:
    """Corners of the parts; those that span no volume are left to the others."""
    import vhacdx

    counted = np.column_stack([np.full(len(faces), 3), faces]).astype(np.uint32)
    found = vhacdx.compute_vhacd(
        vertices, counted.ravel(), maxConvexHulls=most, resolution=_RESOLUTION, asyncACD=False
    )
    solid = []
    for points, _ in found:
        try:
            scipy.spatial.ConvexHull(points)
        except (scipy.spatial.QhullError, ValueError):
            continue
        solid.append(np.asarray(points))
    return solid or [vertices]
