"""Figure 9 of `qiu` and the claim on the hull: what it contains, and what it costs."""

from __future__ import annotations

from functools import partial

import numpy as np
import pandas as pd

from .....ledger import REGISTRY, Assumed, Bounded, Generally, NoOriginal, Residual, Result
from .....ledger.captions import captions
from .....ledger.printed import read_number
from .....ledger.witnesses import cell_witnesses
from .....planning.checks.hull_cover import protrusions
from .....planning.checks.query_cost import query_operations, query_times
from .....planning.field.hull_obstacle import circles_on, hull_track
from .....scene import ConvexHull
from .....scene.posing import links_of
from .....view.arm_scenes import inside_hull
from .....view.hull_drawing import hull_figure
from ...document import SEED, arm_in_use, placed
from ...ends import TIP_COLUMNS
from ...reading import ANGLE_UNITS, JUDGED_BY, Hull, Links
from ...studies.dual_pairs import PAIR_POINTS, PAIR_RATIOS, PAIRS

checks = partial(REGISTRY.checks, page="qiu/master_slave")
caption = captions(__file__)
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
    unit = ANGLE_UNITS[assumed["angle_unit"]]
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
    title = "The arm in the posture of Fig. 9 and the hull of its circles."
    return Result(
        obtained={
            "circles_outside": max(outside, 0.0),
            "beyond_right_angle": float(beyond),
            "volume": hull.volume,
            "vertices": len(hull.vertices),
            "faces": len(hull.faces),
            "largest_protrusion": float(sticking.max()),
        },
        table=pd.DataFrame(points, columns=TIP_COLUMNS),
        caption=caption("fig09"),
        alt="Stick figure of the arm with six circles at its joints inside a translucent "
        "convex hull, from two sides.",
        figure=lambda: hull_figure(arm, q, hull, rings),
        scene=lambda: inside_hull(title, arm, q, hull, (1.5, 1.0, 0.9)),
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
    arm = placed("master", arm=arm_in_use(0.0, Links.of(assumed).radii))
    circles = Hull.of(assumed).circles()
    q = arm.arm.random_configurations(_POSES, np.random.default_rng(SEED))
    track, sticking = hull_track(circles_on(arm, circles, q)), protrusions(arm, q, circles)
    most, rng = sticking.max(axis=1), np.random.default_rng(SEED)
    hull_cost, capsule_cost = query_operations(arm, track, q[:_COUNTED], rng)
    judged = JUDGED_BY[assumed["success_rule"]]
    table = PAIRS.load()
    keys = [f"{p}_{ratio:g}_{judged}" for p in PAIR_POINTS for ratio in PAIR_RATIOS]
    cells = table.melt(id_vars="pair", value_vars=keys, var_name="reading", value_name="planned")
    planned = cells["planned"].astype(bool)
    obtained = {
        "effective": {"count": int(planned.sum()), "of": len(cells)},
        "operations_ratio": hull_cost / capsule_cost,
        "judged_by": judged,
        "median_protrusion": float(np.median(most)),
        "largest_protrusion": float(sticking.max()),
        "protrusion_by_link": dict(
            zip(links_of(arm.arm).names, sticking.max(axis=0).tolist(), strict=True)
        ),
    }
    return Result(
        obtained=obtained,
        measured=query_times(arm, track, (0.2, 0.1, 0.9), _QUERIES),
        caption=caption("claim_hull_valid", hull=hull_cost, capsules=capsule_cost, poses=_POSES),
        witnesses=cell_witnesses(
            "qiu.claim_hull_valid", obtained, cells, planned, ("pair", "reading")
        ),
    )
