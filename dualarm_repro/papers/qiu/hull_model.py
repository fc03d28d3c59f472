"""Figure 9 of `qiu` and the claim on the hull: what it contains, and what it costs."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from time import perf_counter
from typing import Any

import numpy as np
import pandas as pd

from ...ledger import REGISTRY, Assumed, Bounded, Is, NoOriginal, Result
from ...planning.hull_obstacle import circles_on, hull_track, point_hull
from ...scene import ConvexHull, PlacedArm
from ...scene.points import point_capsule
from ...scene.posing import link_frames, links_of, place_cores
from ...view.hull_drawing import hull_figure
from ...view.scene3d import Scene3D
from ...view.style import MASTER, ORANGE
from .readings import circles
from .scenario import SEED, SHOWN_POSTURE, arm_in_use, placed

checks = partial(REGISTRY.checks, page="qiu/master_slave")
_UNIT = {"rad": 1.0, "deg": np.pi / 180.0}
_POSES = 40
_QUERIES = 2000
# Multiplications and additions: a plane of the hull, a nearest point on a face, a capsule.
_PLANE, _FACE, _CAPSULE = 6, 60, 30


@checks(
    "qiu.fig09",
    samples=32,
    rules=[
        Bounded(key="circles_outside", high=1e-9, label="circle points outside the hull by [m]"),
        NoOriginal(key="radii", label="the radii of the circles"),
    ],
)
def hull_of_the_posture(assumed: Assumed) -> Result:
    """The hull over the circles at the six joint origins in the printed posture."""
    arm, q = placed("master"), SHOWN_POSTURE * _UNIT[assumed["angle_unit"]]
    points = circles_on(arm, circles(assumed), q[np.newaxis])[0]
    hull = ConvexHull(points)
    track = hull_track(points[np.newaxis])
    outside = float((points @ track.planes[0, :, :3].T + track.planes[0, :, 3]).max())
    sticking = protrusions(arm, q[np.newaxis], assumed)[0]
    rings = points.reshape(6, -1, 3)

    def scene() -> Scene3D:
        made = Scene3D(
            "The arm in the posture of Fig. 9 and the hull of its circles.", (1.5, 1.0, 0.9)
        )
        made.add_arm("master", arm.arm, q, arm.placement, MASTER)
        made.add_mesh("hull", hull.vertices, hull.faces, ORANGE, 0.45)
        return made

    return Result(
        obtained={
            "circles_outside": max(outside, 0.0),
            "volume": hull.volume,
            "vertices": len(hull.vertices),
            "faces": len(hull.faces),
            "largest_protrusion": float(sticking.max()),
        },
        table=pd.DataFrame(points, columns=["x_m", "y_m", "z_m"]),
        caption=(
            f"Hull over six circles in the printed posture: {len(hull.vertices)} vertices, "
            f"{1e3 * hull.volume:.1f} litres. It contains the circles, while a link of the arm "
            "sticks out "
            f"by up to {1e3 * sticking.max():.0f} mm. No radius is printed."
        ),
        alt="Stick figure of the arm with six circles at its joints inside a translucent convex "
        "hull, "
        "from two sides.",
        figure=lambda: hull_figure(arm, q, hull, rings),
        scene=scene,
    )


@checks(
    "qiu.claim_hull_valid",
    rules=[
        Bounded(key="circles_outside", high=1e-9, label="circle points outside the hull by [m]"),
        Is(key="convex", value=True, label="the model is convex in every posture"),
        Bounded(
            key="operations_ratio",
            high=1.0,
            label="operations per query, hull over capsules of the arm",
        ),
    ],
    samples=16,
)
def hull_claim(assumed: Assumed) -> Result:
    """Containment of circles and links, and the cost of the hull beside that of capsules."""
    scale = assumed["link_radius_scale"]
    arm = placed("master", radius_scale=scale)
    agree = np.allclose(links_of(arm_in_use()).radius, assumed["link_radii"])
    q = arm.arm.random_configurations(_POSES, np.random.default_rng(SEED))
    points = circles_on(arm, circles(assumed), q)
    track = hull_track(points)
    heights = np.einsum("tpr,tfr->tpf", points, track.planes[..., :3]) + track.planes[:, None, :, 3]
    sticking = protrusions(arm, q, assumed)
    faces = float(np.mean([len(ConvexHull(row).faces) for row in points[:8]]))
    seen = _faces_seen(arm, track)
    links = len(links_of(arm.arm).radius)
    hull_cost, capsule_cost = _PLANE * faces + _FACE * seen, _CAPSULE * links
    return Result(
        obtained={
            "circles_outside": float(max(heights.max(), 0.0)),
            "convex": bool(np.isfinite(track.planes).all()),
            "operations_ratio": hull_cost / capsule_cost,
            "median_protrusion": float(np.median(sticking.max(axis=1))),
            "largest_protrusion": float(sticking.max()),
            "protrusion_by_link": dict(
                zip(links_of(arm.arm).names, sticking.max(axis=0).tolist(), strict=True)
            ),
            "radii_of_the_robot": bool(agree),
        },
        measured=_times(arm, track, q),
        caption=(
            f"Over {_POSES} random postures the hull contains all circles, but not the arm: its "
            "links "
            f"stick out by {1e3 * np.median(sticking.max(axis=1)):.0f} mm in the median posture "
            "and "
            f"{1e3 * sticking.max():.0f} mm at most. A distance to it takes about {hull_cost:.0f} "
            f"multiplications and additions, against {capsule_cost} for the {links} capsules of "
            "the "
            "arm, and it has to be built for every posture first: it costs more, not less."
        ),
    )


def protrusions(arm: PlacedArm, q: np.ndarray, values: Mapping[str, Any]) -> np.ndarray:
    """How far each capsule of the arm sticks out of the hull of its circles (N, links) [m].

    The largest height of the capsule over a plane of the hull.
    """
    links = links_of(arm.arm)
    track = hull_track(circles_on(arm, circles(values), q))
    frames = link_frames(arm.arm.chain, np.ascontiguousarray(arm.placement.homogeneous[:3]), q)
    ends = np.empty((len(q), len(links.radius), 2, 3))
    place_cores(frames, links.joint, links.local, ends)
    normal, offset = track.planes[..., :3], track.planes[..., 3]
    heights = np.einsum("tlkr,tfr->tlkf", ends, normal) + offset[:, None, None]
    return np.maximum(heights.max(axis=(2, 3)) + links.radius, 0.0)


def _faces_seen(arm: PlacedArm, track: Any) -> float:
    """Faces on whose outer side a point at 0.3 m from the arm lies, on average."""
    rng = np.random.default_rng(SEED)
    centre = track.triangles.mean(axis=(1, 2))
    directions = rng.normal(size=centre.shape)
    probes = centre + 0.5 * directions / np.linalg.norm(directions, axis=1, keepdims=True)
    heights = np.einsum("tr,tfr->tf", probes, track.planes[..., :3]) + track.planes[..., 3]
    return float((heights > 0).sum(axis=1).mean())


def _times(arm: PlacedArm, track: Any, q: np.ndarray) -> dict[str, float]:
    """Microseconds of one query of either model and of building one hull, from plain Python."""
    point, links = (0.2, 0.1, 0.9), links_of(arm.arm)
    axes = [tuple(row[1] - row[0]) for row in links.local]

    def clock(function: Any, count: int) -> float:
        function()
        began = perf_counter()
        for _ in range(count):
            function()
        return 1e6 * (perf_counter() - began) / count

    return {
        "hull_query_us": clock(
            lambda: point_hull(point, track.planes[0], track.triangles[0]), _QUERIES
        ),
        "capsules_query_us": clock(
            lambda: [
                point_capsule(point, tuple(row[0]), axis, r)
                for row, axis, r in zip(links.local, axes, links.radius, strict=True)
            ],
            _QUERIES // 10,
        ),
        "hull_build_us": clock(lambda: hull_track(track.triangles[0].reshape(1, -1, 3)), 20),
    }
