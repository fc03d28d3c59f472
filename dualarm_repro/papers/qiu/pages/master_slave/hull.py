"""Figure 9 of `qiu` and the claim on the hull: what it contains, and what it costs."""

from __future__ import annotations

from functools import partial
from time import perf_counter
from typing import Any

import numpy as np
import pandas as pd

from .....ledger import REGISTRY, Assumed, Bounded, Generally, NoOriginal, Residual, Result
from .....ledger.printed import read_number
from .....planning.checks.operations import operations
from .....planning.field.hull_obstacle import (
    HullTrack,
    JointCircles,
    circles_on,
    hull_track,
    point_hull,
)
from .....scene import ConvexHull, PlacedArm
from .....scene.points import point_capsule
from .....scene.posing import link_frames, links_of, place_cores
from .....view.hull_drawing import hull_figure
from .....view.scene3d import Scene3D
from .....view.style import MASTER, ORANGE
from ...document import SEED, placed
from ...reading import JUDGED_BY, Hull, Links
from ...studies.dual_pairs import PAIR_POINTS, PAIR_RATIOS, PAIRS
from ...witnesses import witnesses

checks = partial(REGISTRY.checks, page="qiu/master_slave")
_UNIT = {"rad": 1.0, "deg": np.pi / 180.0}
_POSES = 40
_COUNTED = 12
_QUERIES = 2000


@checks(
    "qiu.fig09",
    rules=[
        Residual("circles_outside", "circle points outside the hull by [m]", high=1e-9),
        Bounded(
            "beyond_right_angle",
            "fifth printed angle from a right angle, beyond the printed digits [rad]",
            high=0.0,
        ),
        NoOriginal("radii", "the radii of the circles"),
    ],
)
def hull_of_the_posture(assumed: Assumed) -> Result:
    """The hull over the circles at the six joint origins in the printed posture."""
    unit = _UNIT[assumed["angle_unit"]]
    read = [read_number(text) for text in REGISTRY.printed("qiu.fig09")["q"]]
    arm, q = placed("master"), unit * np.array([value for value, _ in read])
    beyond = abs(q[4] - 0.5 * np.pi) - unit * read[4][1]
    circles = Hull.of(assumed).circles()
    points = circles_on(arm, circles, q[np.newaxis])[0]
    hull = ConvexHull(points)
    track = hull_track(points[np.newaxis])
    outside = float((points @ track.planes[0, :, :3].T + track.planes[0, :, 3]).max())
    sticking = protrusions(arm, q[np.newaxis], circles)[0]
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
            "beyond_right_angle": float(beyond),
            "volume": hull.volume,
            "vertices": len(hull.vertices),
            "faces": len(hull.faces),
            "largest_protrusion": float(sticking.max()),
        },
        table=pd.DataFrame(points, columns=["x_m", "y_m", "z_m"]),
        caption=(
            f"Hull over six circles in the printed posture: {len(hull.vertices)} vertices, "
            f"{1e3 * hull.volume:.1f} litres. It contains the circles, while a link of the arm "
            f"sticks out by up to {1e3 * sticking.max():.0f} mm. No radius is printed."
        ),
        alt="Stick figure of the arm with six circles at its joints inside a translucent "
        "convex hull, from two sides.",
        figure=lambda: hull_figure(arm, q, hull, rings),
        scene=scene,
    )


@checks(
    "qiu.claim_hull_valid",
    rules=[
        Generally(
            "effective",
            "random pairs of goals that are planned around the moving hull",
            at_least="most",
            margin="margin",
        ),
        Bounded(
            "operations_ratio", "operations per query, hull over capsules of the arm", high=1.0
        ),
    ],
)
def hull_claim(assumed: Assumed) -> Result:
    """Success of the search around the hull, and its cost beside that of capsules."""
    arm, circles = placed("master", radii=Links.of(assumed).radii), Hull.of(assumed).circles()
    q = arm.arm.random_configurations(_POSES, np.random.default_rng(SEED))
    track, sticking = hull_track(circles_on(arm, circles, q)), protrusions(arm, q, circles)
    hull_cost, capsule_cost = _operations(arm, track, q)
    judged = JUDGED_BY[assumed["success_rule"]]
    table = PAIRS.load()
    keys = [f"{p}_{ratio:g}_{judged}" for p in PAIR_POINTS for ratio in PAIR_RATIOS]
    cells = table.melt(id_vars="pair", value_vars=keys, var_name="reading", value_name="planned")
    planned = cells["planned"].astype(bool)
    obtained = {
        "effective": {"count": int(planned.sum()), "of": len(cells)},
        "operations_ratio": hull_cost / capsule_cost,
        "judged_by": judged,
        "median_protrusion": float(np.median(sticking.max(axis=1))),
        "largest_protrusion": float(sticking.max()),
        "protrusion_by_link": dict(
            zip(links_of(arm.arm).names, sticking.max(axis=0).tolist(), strict=True)
        ),
    }
    return Result(
        obtained=obtained,
        measured=_times(arm, track, q),
        caption=(
            f"Judged by the {judged}, {planned.mean():.0%} of {len(cells)} searches around the "
            "moving hull (random pairs of goals, control points and gain ratios) succeed. A "
            f"distance to the hull takes {hull_cost:.0f} additions, multiplications, divisions and "
            f"roots, counted in runs, against {capsule_cost:.0f} for the capsules of the arm, and "
            f"the hull has to be built for every posture first. Over {_POSES} random postures the "
            f"links stick out of it by {1e3 * np.median(sticking.max(axis=1)):.0f} mm in the "
            f"median and {1e3 * sticking.max():.0f} mm at most."
        ),
        witnesses=witnesses("qiu.claim_hull_valid", obtained, cells, planned, ("pair", "reading")),
    )


def protrusions(arm: PlacedArm, q: np.ndarray, circles: JointCircles) -> np.ndarray:
    """How far each capsule of the arm sticks out of the hull of its circles (N, links) [m].

    The largest height of the capsule over a plane of the hull.
    """
    links = links_of(arm.arm)
    track = hull_track(circles_on(arm, circles, q))
    ends = _cores(arm, q)
    normal, offset = track.planes[..., :3], track.planes[..., 3]
    heights = np.einsum("tlkr,tfr->tlkf", ends, normal) + offset[:, None, None]
    return np.maximum(heights.max(axis=(2, 3)) + links.radius, 0.0)


def _operations(arm: PlacedArm, track: HullTrack, q: np.ndarray) -> tuple[float, float]:
    """Mean operations of the distance of a point to the hull, and to all capsules of the arm.

    One point a posture, half a metre from the middle of the hull.
    """
    rng, links = np.random.default_rng(SEED), links_of(arm.arm)
    ends = _cores(arm, q)
    hulls, capsules = [], []
    for k in range(_COUNTED):
        planes, triangles = _faces(track, k)
        direction = rng.normal(size=3)
        point = triangles.mean(axis=(0, 1)) + 0.5 * direction / np.linalg.norm(direction)
        hulls.append(operations(point_hull, tuple(point), planes, triangles))
        capsules.append(
            sum(
                operations(point_capsule, tuple(point), tuple(a), tuple(b - a), float(radius))
                for (a, b), radius in zip(ends[k], links.radius, strict=True)
            )
        )
    return float(np.mean(hulls)), float(np.mean(capsules))


def _faces(track: HullTrack, k: int) -> tuple[np.ndarray, np.ndarray]:
    """Planes and triangles of one hull, without the repeated last face that fills its row."""
    corners = track.triangles[k].reshape(-1, 9)
    faces = np.sort(np.unique(corners, axis=0, return_index=True)[1])
    return track.planes[k][faces], track.triangles[k][faces]


def _cores(arm: PlacedArm, q: np.ndarray) -> np.ndarray:
    """Ends of the cores of the links in the world (N, links, 2, 3) [m]."""
    links = links_of(arm.arm)
    frames = link_frames(arm.arm.chain, np.ascontiguousarray(arm.placement.homogeneous[:3]), q)
    ends = np.empty((len(q), len(links.radius), 2, 3))
    place_cores(frames, links.joint, links.local, ends)
    return ends


def _times(arm: PlacedArm, track: Any, q: np.ndarray) -> dict[str, float]:
    """Microseconds of one query of either model and of building one hull, from plain Python."""
    point, links = (0.2, 0.1, 0.9), links_of(arm.arm)
    planes, triangles = _faces(track, 0)
    axes = [tuple(row[1] - row[0]) for row in links.local]

    def clock(function: Any, count: int) -> float:
        function()
        began = perf_counter()
        for _ in range(count):
            function()
        return 1e6 * (perf_counter() - began) / count

    return {
        "hull_query_us": clock(lambda: point_hull(point, planes, triangles), _QUERIES),
        "capsules_query_us": clock(
            lambda: [
                point_capsule(point, tuple(row[0]), axis, r)
                for row, axis, r in zip(links.local, axes, links.radius, strict=True)
            ],
            _QUERIES // 10,
        ),
        "hull_build_us": clock(lambda: hull_track(triangles.reshape(1, -1, 3)), 20),
    }
