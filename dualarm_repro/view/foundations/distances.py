"""Signed distances: closed forms against coal, the distance field, and the crease of a minimum."""

from __future__ import annotations

from collections.abc import Callable

import coal
import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
import pinocchio as pin

from ...scene.bodies import Shape
from ...scene.distance import signed_distance
from ...scene.shapes import Box, Capsule, HalfSpace, Sphere
from ..card import figure_html
from ..page import Page
from ..style import BLACK, ORANGE, RED, SKY, WIDTH, house_style

_Draw = Callable[[np.random.Generator], Shape]
_UP = np.array([0.0, 0.0, 1.0])
_STEP = 1e-6  # of the central differences [m] or [rad]
_POINTS = 2000
_JUMP = 0.1  # a change of slope between samples that counts as a jump [m/rad]
_PROBE = 0.01  # radius of the sphere that measures the field [m]


def agreement_with_coal(count: int, rng: np.random.Generator) -> pd.DataFrame:
    """Closed forms against coal on random pairs, separated and penetrating.

    Returns
    -------
    DataFrame
        Index: kinds of the two shapes; columns: pairs, share that penetrates, largest difference of
        the signed distance [m].
    """
    kinds: dict[str, tuple[_Draw, _Draw]] = {
        "capsule, capsule": (_capsule, _capsule),
        "sphere, capsule": (_sphere, _capsule),
        "sphere, box": (_sphere, _box),
        "capsule, box": (_capsule, _box),
        "capsule, half-space": (_capsule, _half_space),
    }
    rows = {}
    for name, (first, second) in kinds.items():
        pairs = [(first(rng), second(rng)) for _ in range(count)]
        ours = np.array([signed_distance(a, b).distance for a, b in pairs])
        theirs = np.array([_by_coal(a, b) for a, b in pairs])
        rows[name] = [count, (ours < 0).mean(), np.abs(ours - theirs).max()]
    columns = ["pairs", "penetrating", "largest difference [m]"]
    return pd.DataFrame.from_dict(rows, orient="index", columns=columns)


def field_page(rng: np.random.Generator) -> Page:
    """Signed distance of a point to a box and a capsule in their plane, with its gradient."""
    turn = pin.utils.rotate("z", 0.4)
    box = Box((-0.45, 0.0, 0.0), (0.7, 0.45, 0.6), turn)
    capsule = Capsule((0.4, -0.3, 0.0), (0.6, 0.4, 0.0), 0.15)
    x, y = np.meshgrid(np.linspace(-1.1, 1.1, 112), np.linspace(-0.75, 0.75, 76))
    to_box, to_capsule = _field(x, y, box), _field(x, y, capsule)
    nearest = np.where(to_box[..., :1] < to_capsule[..., :1], to_box, to_capsule)
    points = rng.uniform((-1.1, -0.75), (1.1, 0.75), (_POINTS, 2))
    error = max(_gradient_error(points, shape) for shape in (box, capsule))
    crease = np.diff(to_box[..., 0] < to_capsule[..., 0], axis=1)
    cosine = (to_box[:, 1:, 1:] * to_capsule[:, 1:, 1:]).sum(axis=-1)[crease]
    jump = np.degrees(np.arccos(cosine.clip(-1, 1)))
    with house_style():
        figure, ax = plt.subplots(figsize=(WIDTH, 4.6))
        levels = np.arange(-0.25, 0.85, 0.05)
        filled = ax.contourf(x, y, nearest[..., 0], levels, cmap="RdBu", vmin=-0.8, vmax=0.8)
        ax.contour(x, y, nearest[..., 0], [0.0], colors=BLACK, linewidths=2)
        ax.contour(x, y, to_box[..., 0] - to_capsule[..., 0], [0.0], colors=RED, linestyles="--")
        some = np.s_[3::6, 3::6]
        ax.quiver(x[some], y[some], nearest[..., 1][some], nearest[..., 2][some], scale=36)
        ax.set(xlabel="x [m]", ylabel="y [m]", aspect="equal")
        ax.grid(False)
        figure.colorbar(filled, ax=ax, label="signed distance [m]")
    alt = (
        "Map of the signed distance around a turned box and a capsule, with arrows of its "
        "gradient. The arrows lead away from the nearer obstacle and turn abruptly on the dashed "
        "line where both are equally near, and on the diagonals inside the box."
    )
    caption = (
        "Signed distance to a box and a capsule (black outlines), and its gradient of length one. "
        f"At {_POINTS} random points the gradients to either shape differ from central "
        f"differences by at most {error:.1e}. On the dashed line both shapes are equally near, and "
        f"the gradient of the smaller distance turns by {jump.min():.0f} to {jump.max():.0f} "
        "degrees at once."
    )
    return Page(figure_html(figure, alt, caption))


def crease_page() -> Page:
    """A capsule on a revolute joint between two obstacles: both distances, and their minimum."""
    link = Capsule((0.25, 0.0, 0.0), (0.9, 0.0, 0.0), 0.06)
    obstacles: dict[str, Shape] = {
        "sphere": Sphere((0.55, 0.75, 0.0), 0.12),
        "box": Box((0.75, -0.45, 0.1), (0.3, 0.25, 0.4)),
    }
    q = np.linspace(-0.6, 1.0, 400)
    found = {name: _along_turn(link, shape, q) for name, shape in obstacles.items()}
    distance = np.array([d for d, _ in found.values()])
    slope = np.array([g for _, g in found.values()])

    def distances_to_all(at: np.ndarray) -> np.ndarray:
        return np.array([_along_turn(link, shape, at)[0] for shape in obstacles.values()])

    error = np.abs(_central(distances_to_all, q) - slope).max()
    switch = int(np.flatnonzero(np.diff(distance.argmin(axis=0)))[0])
    order = distance.argmin(axis=0)[switch : switch + 2]
    before, after = slope[order[0], switch], slope[order[1], switch + 1]
    own = np.flatnonzero(np.abs(np.diff(slope[list(found).index("box")])) > _JUMP)
    with house_style():
        figure, axes = plt.subplots(2, 1, figsize=(6.8, 5.4), sharex=True)
        for ax, values, label in zip(
            axes, (distance, slope), ("signed distance [m]", "d(distance)/dq [m/rad]"), strict=True
        ):
            for row, name, color in zip(values, found, (SKY, ORANGE), strict=True):
                ax.plot(q, row, color=color, lw=4, alpha=0.6, label=f"to the {name}")
            least = np.take_along_axis(values, distance.argmin(axis=0)[None], axis=0)[0]
            least = np.insert(least, switch + 1, np.nan) if ax is axes[1] else least
            at = np.insert(q, switch + 1, q[switch]) if ax is axes[1] else q
            ax.plot(at, least, color=BLACK, lw=1.5, label="of the nearest")
            ax.axvline(q[switch], color=RED, ls="--", lw=1)
            for k in own:
                ax.axvline(q[k], color=BLACK, ls=":", lw=1)
            ax.set_ylabel(label)
        axes[0].legend()
        axes[1].set_xlabel("joint angle q [rad]")
    alt = (
        "Distance and its derivative over a joint angle. The smaller of two distances rises to a "
        "peak and falls; at the peak its derivative jumps from positive to negative. The distance "
        "to the box alone has corners of its own, where its derivative jumps as well."
    )
    corners = " and ".join(f"{round(q[k], 2) + 0.0:.2f}" for k in own)
    caption = (
        f"At q = {q[switch]:.2f} rad (dashed) the nearest obstacle changes from the "
        f"{list(found)[order[0]]} to the {list(found)[order[1]]}: the smaller distance is "
        f"continuous, its derivative jumps from {before:+.3f} to {after:+.3f} m/rad. The box alone "
        f"adds {len(own)} jumps, at q = {corners} rad (dotted): the shortest way out changes while "
        "it is penetrated, and the nearest point changes ends where the link lies parallel to a "
        f"face. Derivatives -n·(z × p) and central differences differ by at most {error:.0e}."
    )
    return Page(figure_html(figure, alt, caption))


def _field(x: np.ndarray, y: np.ndarray, shape: Shape) -> np.ndarray:
    """Distance of points (x, y, 0) and its gradient in the plane, (..., 3)."""
    probes = (Sphere((u, v, 0.0), _PROBE) for u, v in zip(x.flat, y.flat, strict=True))
    found = [signed_distance(probe, shape) for probe in probes]
    return np.array([[w.distance + _PROBE, *-w.normal[:2]] for w in found]).reshape(*x.shape, 3)


def _gradient_error(points: np.ndarray, shape: Shape) -> float:
    """Largest difference of the gradient from central differences; points on a crease left out."""
    x, y = points.T
    gradient = _field(x, y, shape)[:, 1:]
    along_x = _central(lambda u: _field(u, y, shape)[:, 0], x)
    along_y = _central(lambda v: _field(x, v, shape)[:, 0], y)
    return float(np.abs(np.column_stack([along_x, along_y]) - gradient).max())


def _along_turn(link: Capsule, shape: Shape, q: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Distance of a link turned about z and its derivative -n . (z x p_link)."""
    turned = (link.moved(pin.SE3(pin.utils.rotate("z", angle), np.zeros(3))) for angle in q)
    found = [signed_distance(capsule, shape) for capsule in turned]
    slope = [-w.normal @ np.cross(_UP, w.point_a) for w in found]
    return np.array([w.distance for w in found]), np.array(slope)


def _central(function: Callable[[np.ndarray], np.ndarray], at: np.ndarray) -> np.ndarray:
    return (function(at + _STEP) - function(at - _STEP)) / (2.0 * _STEP)


def _by_coal(a: Shape, b: Shape) -> float:
    return coal.distance(*a.coal(), *b.coal(), coal.DistanceRequest(), coal.DistanceResult())


def _sphere(rng: np.random.Generator) -> Sphere:
    return Sphere(rng.uniform(-0.5, 0.5, 3), rng.uniform(0.05, 0.3))


def _capsule(rng: np.random.Generator) -> Capsule:
    return Capsule(rng.uniform(-0.5, 0.5, 3), rng.uniform(-0.5, 0.5, 3), rng.uniform(0.05, 0.2))


def _box(rng: np.random.Generator) -> Box:
    axis = rng.normal(size=3)
    return Box(rng.uniform(-0.5, 0.5, 3), rng.uniform(0.1, 0.6, 3), pin.exp3(axis))


def _half_space(rng: np.random.Generator) -> HalfSpace:
    return HalfSpace(rng.normal(size=3), rng.uniform(-0.5, 0.5))
