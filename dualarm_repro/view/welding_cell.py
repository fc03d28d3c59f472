"""Drawings of a welding cell: robots, workpiece, frames, position vectors, ellipsoids."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..scene.posing import links_of
from ..welding import ROBOTS, WELDER, Cell, Separation
from .ellipsoids import ROBOT_COLORS, ellipsoid_surface
from .style import BLACK, BLUE, GREEN, ORANGE, PURPLE, RED, axes_3d, house_style

_AXES = (RED, GREEN, BLUE)


def cell_figure(
    cell: Cell,
    q: np.ndarray,
    centre: np.ndarray,
    *,
    index: int = 0,
    grams: np.ndarray | None = None,
    scale: float = 0.25,
    capsules: bool = False,
) -> Any:
    """The three robots, the workpiece and its seam at one seam point.

    Parameters
    ----------
    q : ndarray (3, N, 6) [rad]
    grams : ndarray (3, 3, 3), optional
        Matrices of ellipsoids drawn at the reference points, ``scale`` metres per unit.
    capsules : bool
        Draw the links as thick as their capsules instead of as lines.
    """
    with house_style():
        figure, ax = axes_3d(8.0, 6.4, elev=26, azim=-104)
        for k, (name, color) in enumerate(zip(ROBOTS, ROBOT_COLORS, strict=True)):
            points = _skeleton(cell, k, q[k, index])
            ax.plot(*points.T, "o-", color=color, lw=9 if capsules else 4, ms=4, label=name)
            triad(ax, cell.bases[k], 0.22)
        _workpiece(ax, cell, centre, index)
        if grams is not None:
            for k, color in enumerate(ROBOT_COLORS):
                at = centre + cell.references[k, index]
                surface = [
                    scale * part + at[i] for i, part in enumerate(ellipsoid_surface(grams[k]))
                ]
                ax.plot_surface(*surface, color=color, alpha=0.25, lw=0)
        _same_scale(ax)
        ax.legend(loc="upper left")
    return figure


def vectors_figure(cell: Cell, q: np.ndarray, centre: np.ndarray) -> Any:
    """Frames of workpiece, flanges and bases, with the vectors of the closure equations."""
    with house_style():
        figure, ax = axes_3d(8.0, 6.4, elev=26, azim=-104)
        for k, color in enumerate(ROBOT_COLORS):
            ax.plot(*_skeleton(cell, k, q[k, 0]).T, color=color, lw=3, alpha=0.35)
            triad(ax, cell.bases[k], 0.2)
            ax.text(*cell.bases[k][:3, 3], f" B{k + 1}")
        piece = cell.piece_pose(centre)[0]
        triad(ax, piece, 0.15)
        origin = np.zeros(3)
        triad(ax, np.eye(4), 0.25)
        ax.text(*origin, " W")
        _arrow(ax, origin, centre, "p2", BLACK)
        for k, (flange_name, grip_name) in enumerate((("p1", "r1"), ("p3", "r2"))):
            flange = centre + cell.flanges[k, 0, :3, 3]
            _arrow(ax, origin, flange, flange_name, ORANGE)
            _arrow(ax, centre, flange, grip_name, PURPLE)
        _same_scale(ax)
    return figure


def triad(ax: Any, pose: np.ndarray, length: float) -> None:
    """Axes of a frame: x red, y green, z blue."""
    for axis, color in enumerate(_AXES):
        ends = np.array([pose[:3, 3], pose[:3, 3] + length * pose[:3, axis]])
        ax.plot(*ends.T, color=color, lw=1.6)


def capsule_figure(cell: Cell, q: np.ndarray, robot: int) -> Any:
    """The capsules of one robot, tool included, at a configuration (6,)."""
    arm = cell.arms[robot]
    path = np.broadcast_to(q, (3, cell.count, 6))
    ends = Separation(cell).cores(path[np.newaxis], np.zeros((1, 3)))[0]
    start = sum(len(links_of(other).radius) for other in cell.arms[:robot])
    radii = links_of(arm).radius
    with house_style():
        figure, ax = axes_3d(6.4, 6.2, elev=16, azim=-60)
        for core, radius in zip(ends[start : start + len(radii)], radii, strict=True):
            ax.plot_surface(*_capsule(core, radius), color=ROBOT_COLORS[robot], alpha=0.45, lw=0)
        ax.plot(*_skeleton(cell, robot, q).T, "o-", color=BLACK, lw=1, ms=3)
        ax.set_aspect("equal")
    return figure


def _skeleton(cell: Cell, robot: int, q: np.ndarray) -> np.ndarray:
    """Base, joints, flange and, for the welder, the tip of the torch in the world."""
    arm, base = cell.arms[robot], cell.bases[robot]
    points = np.vstack([np.zeros(3), arm.joint_positions(q)])
    if robot == WELDER:
        flange = arm.fk(q)
        fixed = cell.flanges[robot][0]
        lever = fixed[:3, :3].T @ cell.lever_arms[robot][0]
        points = np.vstack([points, flange[:3, :3] @ lever + flange[:3, 3]])
    return points @ base[:3, :3].T + base[:3, 3]


def _workpiece(ax: Any, cell: Cell, centre: np.ndarray, index: int) -> None:
    R = cell.rotations[index]
    for core, radius in zip(cell.pipe_cores, cell.pipe_radii, strict=True):
        ax.plot_surface(*_capsule(core @ R.T + centre, radius), color="0.5", alpha=0.3, lw=0)
    seam = np.vstack([cell.seam, cell.seam[:1]]) @ R.T + centre
    ax.plot(*seam.T, color=ORANGE, lw=2)


def _capsule(core: np.ndarray, radius: float) -> list[np.ndarray]:
    """Surface of a capsule with a core (2, 3) as three arrays."""
    start, end = core
    axis = end - start
    length = float(np.linalg.norm(axis))
    z = axis / length if length > 0 else np.array([0.0, 0.0, 1.0])
    x = np.cross(z, np.eye(3)[np.argmin(abs(z))])
    x /= np.linalg.norm(x)
    y = np.cross(z, x)
    polar = np.concatenate([np.linspace(0, np.pi / 2, 7), np.linspace(np.pi / 2, np.pi, 7)])
    along = radius * -np.cos(polar) + np.where(np.arange(14) < 7, 0.0, length)
    around = np.linspace(0, 2 * np.pi, 19)
    ring = radius * np.sin(polar)
    points = (
        start[:, None, None]
        + z[:, None, None] * along[None, None, :]
        + x[:, None, None] * np.cos(around)[None, :, None] * ring[None, None, :]
        + y[:, None, None] * np.sin(around)[None, :, None] * ring[None, None, :]
    )
    return list(points)


def _arrow(ax: Any, start: np.ndarray, end: np.ndarray, name: str, color: str) -> None:
    ax.quiver(*start, *(end - start), color=color, lw=1.6, arrow_length_ratio=0.06)
    ax.text(*(0.5 * (start + end)), f" {name}", color=color)


def _same_scale(ax: Any) -> None:
    ax.set_xlim(-1.3, 1.3)
    ax.set_ylim(-1.4, 1.2)
    ax.set_zlim(0, 1.5)
    ax.set_aspect("equal")
