"""Arms as bodies in drawings: every link is the capsule that collision checks see."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from matplotlib.collections import PolyCollection
from mpl_toolkits.mplot3d.art3d import Poly3DCollection
from scipy.spatial import ConvexHull

from ..planning.field.control_points import ends_of
from ..scene import PlacedArm
from ..scene.posing import links_of

_SIDES = 10  # of a link in space
_ROUND = 16  # corners of an end in a view from a side


class Body(NamedTuple):
    """An arm at one instant: its configuration (nq,) [rad], colour, and the step."""

    placed: PlacedArm
    q: np.ndarray
    color: str
    step: int


def capsules_at(body: Body) -> tuple[np.ndarray, np.ndarray]:
    """Ends (C, 2, 3) and radii (C,) of the links in the world [m]."""
    links = links_of(body.placed.arm)
    return ends_of(body.placed, links, body.q[np.newaxis])[0], links.radius


def draw_in_space(ax: Any, body: Body, alpha: float = 0.25) -> None:
    """Each link as a tube of its radius."""
    faces: list[np.ndarray] = []
    for (start, end), radius in zip(*capsules_at(body), strict=True):
        faces += _tube(start, end, radius)
    if faces:
        ax.add_collection3d(
            Poly3DCollection(faces, facecolor=body.color, edgecolor="none", alpha=alpha, zorder=1)
        )


def draw_flat(ax: Any, body: Body, pair: list[int], alpha: float = 0.22) -> None:
    """Each link as its outline, seen along the axis that is not in ``pair``."""
    turn = np.linspace(0.0, 2.0 * np.pi, _ROUND, endpoint=False)
    circle = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    outlines = []
    for ends, radius in zip(*capsules_at(body), strict=True):
        rim = np.concatenate([end[pair] + radius * circle for end in ends])
        outlines.append(rim[ConvexHull(rim).vertices])
    ax.add_collection(
        PolyCollection(outlines, facecolor=body.color, edgecolor=body.color, lw=0.5, alpha=alpha,
                       zorder=1.5),
        autolim=False,
    )  # fmt: skip


def _tube(start: np.ndarray, end: np.ndarray, radius: float) -> list[np.ndarray]:
    """Faces (4, 3) of a tube; of a link without length, a short one along z."""
    way = end - start
    length = float(np.linalg.norm(way))
    if length < 1e-9:
        way, length = np.array([0.0, 0.0, radius]), radius
        start = start - 0.5 * way
        end = start + way
    axis = way / length
    side = np.cross(axis, np.eye(3)[np.abs(axis).argmin()])
    side /= np.linalg.norm(side)
    turn = np.linspace(0.0, 2.0 * np.pi, _SIDES + 1)
    rim = radius * (np.outer(np.cos(turn), side) + np.outer(np.sin(turn), np.cross(axis, side)))
    return [
        np.array([start + rim[k], start + rim[k + 1], end + rim[k + 1], end + rim[k]])
        for k in range(_SIDES)
    ]
