"""Drawings of a welding cell: robots, workpiece, frames, position vectors, ellipsoids."""

from __future__ import annotations

from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import MultipleLocator

from ..scene.posing import links_of
from ..welding import ROBOTS, WELDER, Cell, Separation
from .ellipsoids import ROBOT_COLORS, ellipsoid_panels
from .labels import name_point, name_points, push_apart
from .style import (
    BLACK,
    BLUE,
    GREEN,
    ORANGE,
    PURPLE,
    RED,
    WIDTH,
    axes_3d,
    house_style,
    name_axes,
    same_scale,
)

_AXES = (RED, GREEN, BLUE)


def cell_figure(
    cell: Cell,
    q: np.ndarray,
    centre: np.ndarray,
    *,
    index: int = 0,
    grams: np.ndarray | None = None,
    capsules: bool = False,
) -> Any:
    """The three robots, the workpiece and its seam at one seam point.

    Parameters
    ----------
    q : ndarray (3, N, 6) [rad]
    grams : ndarray (3, 3, 3), optional
        Matrices of the velocity ellipsoids, each drawn in a panel of its own.
    capsules : bool
        Draw the links as thick as their capsules instead of as lines.
    """
    with house_style():
        figure = plt.figure(figsize=(WIDTH, 4.2 if grams is None else 6.8))
        figure.set_layout_engine("constrained", hspace=0.12)
        if grams is None:
            grid = figure.add_gridspec(1, 2, width_ratios=(1.3, 1))
        else:
            grid = figure.add_gridspec(2, 6, height_ratios=(1.25, 1))
        places = (grid[0, 0], grid[0, 1]) if grams is None else (grid[0, :3], grid[0, 3:])
        whole, close = (figure.add_subplot(place, projection="3d") for place in places)
        for ax in (whole, close):
            name_axes(ax)
            ax.view_init(elev=26, azim=-104)
            ax.computed_zorder = False
            _draw_robots(ax, cell, q, index, thick=capsules)
            _workpiece(ax, cell, centre, index)
        if grams is not None:
            below = [figure.add_subplot(grid[1, 2 * k : 2 * k + 2], projection="3d")
                     for k in range(len(ROBOTS))]  # fmt: skip
            ellipsoid_panels(below, grams)
        _room(whole)
        _around(close, centre)
        close.set_title("at the workpiece")
        name_points(whole, {name: cell.bases[k][:3, 3] for k, name in enumerate(ROBOTS)},
                    offset=(0, -14))  # fmt: skip
        name_point(close, centre + cell.references[WELDER, index], "torch", (0, 16))
        for k in range(WELDER):
            flange, end = _skeleton(cell, k, q[k, index])[-1], _grip(cell, k, q, index)
            aside = 34 if flange[0] > end[0] else -34
            name_point(close, 0.5 * (flange + end), "gripper", (aside, 0))
    return figure


def vectors_figure(cell: Cell, q: np.ndarray, centre: np.ndarray) -> Any:
    """Frames of workpiece, flanges and bases, with the vectors of the closure equations."""
    with house_style():
        figure, ax = axes_3d(WIDTH, 5.4, elev=26, azim=-104)
        ax.computed_zorder = False
        for k, color in enumerate(ROBOT_COLORS):
            ax.plot(*_skeleton(cell, k, q[k, 0]).T, color=color, lw=4, alpha=0.3, zorder=1)
            triad(ax, cell.bases[k], 0.2)
        triad(ax, cell.piece_pose(centre)[0], 0.15)
        origin = np.zeros(3)
        triad(ax, np.eye(4), 0.25)
        named = [(cell.bases[k][:3, 3], f"B{k + 1}", BLACK) for k in range(len(ROBOTS))]
        named += [(origin, "W", BLACK), (centre, "C", BLACK)]
        named.append((_arrow(ax, origin, centre, BLACK), "p2", BLACK))
        for k, (flange_name, grip_name) in enumerate((("p1", "r1"), ("p3", "r2"))):
            flange = centre + cell.flanges[k, 0, :3, 3]
            named.append((_arrow(ax, origin, flange, ORANGE), flange_name, "#8a5f00"))
            named.append((_arrow(ax, centre, flange, PURPLE), grip_name, PURPLE))
        _room(ax)
        texts = [name_point(ax, at, name, (9, 0), color=c, weight="bold") for at, name, c in named]
        push_apart(figure, texts, 1.0)
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
        figure, ax = axes_3d(6.4, 5.8, elev=16, azim=-60)
        for core, radius in zip(ends[start : start + len(radii)], radii, strict=True):
            ax.plot_surface(*_capsule(core, radius), color=ROBOT_COLORS[robot], alpha=0.45, lw=0,
                            rasterized=True)  # fmt: skip
        ax.plot(*_skeleton(cell, robot, q).T, "o-", color=BLACK, lw=1, ms=3)
        low, high = ax.get_ylim()
        middle, half = 0.5 * (low + high), 0.5 * max(high - low, 0.7)
        ax.set_ylim(middle - half, middle + half)
        same_scale(ax)
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
    for axis, radius in zip(cell.pipe_axes, cell.pipe_radii[:2], strict=True):
        surface = _tube(axis @ R.T + centre, radius)
        ax.plot_surface(*surface, color="0.5", alpha=0.3, lw=0, rasterized=True, zorder=2)
    seam = np.vstack([cell.seam, cell.seam[:1]]) @ R.T + centre
    ax.plot(*seam.T, color=ORANGE, lw=2, zorder=4)


def _capsule(core: np.ndarray, radius: float) -> list[np.ndarray]:
    """Surface of a capsule with a core (2, 3) as three arrays."""
    polar = np.concatenate([np.linspace(0, np.pi / 2, 7), np.linspace(np.pi / 2, np.pi, 7)])
    length = float(np.linalg.norm(core[1] - core[0]))
    along = radius * -np.cos(polar) + np.where(np.arange(14) < 7, 0.0, length)
    return _turned(core, along, radius * np.sin(polar))


def _tube(axis: np.ndarray, radius: float) -> list[np.ndarray]:
    """Surface of a cylinder with flat ends around an axis (2, 3) as three arrays."""
    length = float(np.linalg.norm(axis[1] - axis[0]))
    return _turned(axis, np.array([0.0, 0.0, length, length]), radius * np.array([0, 1, 1, 0]))


def _turned(core: np.ndarray, along: np.ndarray, ring: np.ndarray) -> list[np.ndarray]:
    """Surface of revolution about a core (2, 3): radii ``ring`` at the places ``along``."""
    start, end = core
    axis = end - start
    length = float(np.linalg.norm(axis))
    z = axis / length if length > 0 else np.array([0.0, 0.0, 1.0])
    x = np.cross(z, np.eye(3)[np.argmin(abs(z))])
    x /= np.linalg.norm(x)
    y = np.cross(z, x)
    around = np.linspace(0, 2 * np.pi, 25)
    points = (
        start[:, None, None]
        + z[:, None, None] * along[None, None, :]
        + x[:, None, None] * np.cos(around)[None, :, None] * ring[None, None, :]
        + y[:, None, None] * np.sin(around)[None, :, None] * ring[None, None, :]
    )
    return list(points)


def _draw_robots(ax: Any, cell: Cell, q: np.ndarray, index: int, *, thick: bool) -> None:
    """Links in the colours of the robots; grippers and torch as dark ends."""
    for k, color in enumerate(ROBOT_COLORS):
        points = _skeleton(cell, k, q[k, index])
        links = points[:-1] if k == WELDER else points
        ax.plot(*links.T, "-", color=color, lw=8 if thick else 4, zorder=3, alpha=0.9)
        ax.plot(*links.T, "o", color="white", mec=color, ms=4, zorder=4)
        tool = points[-2:] if k == WELDER else np.array([points[-1], _grip(cell, k, q, index)])
        ax.plot(*tool.T, "-", color=BLACK, lw=3, zorder=5)
        triad(ax, cell.bases[k], 0.22)


def _grip(cell: Cell, robot: int, q: np.ndarray, index: int) -> np.ndarray:
    """The end of the main pipe that a carrier holds, as its flange has it."""
    flange = cell.flanges[robot, index, :3, 3]
    ends = cell.pipe_axes[0] @ cell.rotations[index].T
    nearest = ends[np.linalg.norm(ends - flange, axis=1).argmin()]
    return _skeleton(cell, robot, q[robot, index])[-1] + (nearest - flange)


def _arrow(ax: Any, start: np.ndarray, end: np.ndarray, color: str) -> np.ndarray:
    """A vector; where to name it."""
    ax.quiver(*start, *(end - start), color=color, lw=1.8, arrow_length_ratio=0.06, zorder=4)
    return 0.5 * (start + end)


def _room(ax: Any) -> None:
    """All three bases, and the arms above them."""
    ax.set(xlim=(-1.3, 1.3), ylim=(-1.3, 1.3), zlim=(0, 1.5))
    same_scale(ax, zoom=1.15)


def _around(ax: Any, centre: np.ndarray, half: float = 0.6) -> None:
    """Only what lies near the workpiece."""
    x, y, z = centre
    ax.set(xlim=(x - half, x + half), ylim=(y - half, y + half), zlim=(z - half, z + half))
    for artist in (*ax.lines, *ax.collections):
        if hasattr(artist, "_axlim_clip"):
            artist._axlim_clip = True
    same_scale(ax, zoom=1.1)
    for axis in (ax.xaxis, ax.yaxis, ax.zaxis):
        axis.set_major_locator(MultipleLocator(0.5))
