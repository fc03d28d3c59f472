"""Figure 9 of `qiu` and the claim on the hull: what it contains, and what it costs."""

from __future__ import annotations

from functools import partial

import numpy as np
import pandas as pd

from .....ledger import REGISTRY, Assumed, Bounded, Generally, NoOriginal, Residual, Result
from .....ledger.captions import captions
from .....ledger.printed import read_number
from .....ledger.witnesses import cell_witnesses
from .....planning.checks.creases import largest_turn, to_capsules, to_hull
from .....planning.checks.hull_cover import link_cores, protrusions
from .....planning.checks.query_cost import distinct_faces, query_operations, query_times
from .....planning.field.hull_obstacle import JointCircles, circles_on, hull_track
from .....planning.search.failure import Failure
from .....scene import ConvexHull
from .....scene.posing import links_of
from .....view.arm_scenes import inside_hull
from .....view.hull_drawing import hull_figure
from ...document import SEED, arm_in_use, placed
from ...ends import TIP_COLUMNS
from ...reading import ANGLE_UNITS, JUDGED_BY, Hull, Links
from ...studies.dual_pairs import DRAWN, PAIR_POINTS, PAIR_RATIOS, PAIRS
from ...studies.models import MODEL_TASKS, MODELS

checks = partial(REGISTRY.checks, page="qiu/master_slave")
caption = captions(__file__)
_POSES = 40
_COUNTED = 12
_QUERIES = 2000
#: Chords past an arm, half their length, their samples, and the least distance looked at [m].
_CHORDS, _LENGTH, _SPACING, _LEAST = 4, 0.4, 0.002, 0.02


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
        *(
            Generally(
                f"effective.{drawn}",
                f"pairs of goals, {drawn} ones, that are planned around the moving hull",
                at_least="most",
                margin="margin",
            )
            for drawn in DRAWN
        ),
        Generally(
            "cured",
            "tasks that only one of both models solves, solved around the hull",
            at_least="most",
            margin="margin",
        ),
        Bounded(
            "operations_ratio", "operations per query, hull over capsules of the arm", high=1.0
        ),
    ],
)
def hull_claim(assumed: Assumed) -> Result:
    """Success of the search around the hull, alone and beside capsules, and the cost of both."""
    arm = placed("master", arm=arm_in_use(0.0, Links.of(assumed).radii))
    circles = Hull.of(assumed).circles()
    q = arm.arm.random_configurations(_POSES, np.random.default_rng(SEED))
    track, sticking = hull_track(circles_on(arm, circles, q)), protrusions(arm, q, circles)
    most, rng = sticking.max(axis=1), np.random.default_rng(SEED)
    hull_cost, capsule_cost = query_operations(arm, track, q[:_COUNTED], rng)
    judged = JUDGED_BY[assumed["success_rule"]]
    table = PAIRS.load()
    keys = [f"{p}_{ratio:g}_{judged}" for p in PAIR_POINTS for ratio in PAIR_RATIOS]
    cells = table.melt(["pair", "drawn"], keys, var_name="reading", value_name="planned")
    planned, solved = cells["planned"].astype(bool), _solved("improved", judged)
    apart = solved["hull"] != solved["capsules"]
    obtained = {
        "effective": {
            drawn: {"count": int(found.sum()), "of": len(found)}
            for drawn, found in planned.groupby(cells["drawn"])
        },
        "cured": {"count": int(solved["hull"][apart].sum()), "of": int(apart.sum())},
        "operations_ratio": hull_cost / capsule_cost,
        "solved": {model: int(found.sum()) for model, found in solved.items()},
        "tasks": len(apart),
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
            "qiu.claim_hull_valid", obtained, cells, planned, ("pair", "drawn", "reading")
        ),
    )


def _solved(search: str, judged: str) -> dict[str, pd.Series]:
    """Which tasks around a standing master a search solves, by the model of the master."""
    table = MODEL_TASKS.load()
    return {model: table[f"{model}_{search}_{judged}"].astype(bool) for model in MODELS}


@checks(
    "qiu.claim_capsules",
    rules=[
        Generally(
            "creased",
            "random postures with a jump in the direction of repulsion around the capsules",
            at_least="some",
            margin="margin",
        ),
        Bounded("hull_turn", "largest turn of the direction around the hull [rad]", high="crease"),
        Generally(
            "cured",
            "one-way searches that succeed around one model only, around the hull",
            at_least="most",
            margin="margin",
        ),
    ],
)
def capsules_break_the_field(assumed: Assumed) -> Result:
    """Creases of the distance around both models, and the searches that fail around one only."""
    limits = REGISTRY.look("qiu.claim_capsules", "thresholds").thresholds
    judged = JUDGED_BY[assumed["success_rule"]]
    turns = _turns(Hull.of(assumed).circles())
    creased = turns["capsules"] > limits["crease"].value
    table, solved = MODEL_TASKS.load(), _solved("traditional", judged)
    failure = table["capsules_traditional_failure"]
    apart = solved["hull"] != solved["capsules"]
    cured = solved["hull"][apart]
    minima = failure[~solved["capsules"]] == str(Failure.MIDWAY_MINIMUM)
    obtained = {
        "creased": {"count": int(creased.sum()), "of": len(creased)},
        "hull_turn": float(turns["hull"].max()),
        "cured": {"count": int(cured.sum()), "of": len(cured)},
        "solved": {model: int(found.sum()) for model, found in solved.items()},
        "tasks": len(failure),
        "minima": {"count": int(minima.sum()), "of": len(minima)},
        "judged_by": judged,
    }
    return Result(
        obtained=obtained,
        caption=caption("claim_capsules", turn=float(np.median(turns["capsules"]))),
        witnesses=cell_witnesses(
            "qiu.claim_capsules",
            obtained,
            table[apart],
            cured,
            ("task", "ratio"),
        ),
    )


def _turns(circles: JointCircles) -> dict[str, np.ndarray]:
    """Largest turn of the direction of repulsion on chords past a model of the arm, by posture."""
    arm, rng = placed("master"), np.random.default_rng(SEED)
    q, radii = arm.arm.random_configurations(_POSES, rng), links_of(arm.arm).radius
    track = hull_track(circles_on(arm, circles, q))
    found: dict[str, list[float]] = {model: [] for model in MODELS}
    for k, cores in enumerate(link_cores(arm, q)):
        near = {"capsules": to_capsules(cores, radii), "hull": to_hull(*distinct_faces(track, k))}
        for _ in range(_CHORDS):
            middle, way = cores.mean(axis=(0, 1)) + rng.normal(0.0, 0.1, 3), rng.normal(size=3)
            along = np.arange(-_LENGTH, _LENGTH, _SPACING)[:, np.newaxis] * way
            line = middle + along / np.linalg.norm(way)
            for model, distance in near.items():
                found[model].append(largest_turn(distance, line, _LEAST))
    return {m: np.reshape(turns, (_POSES, -1)).max(axis=1) for m, turns in found.items()}
