"""Tool tip or whole links: what section 3.3 says about collisions, against the capsules."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from ....ledger import REGISTRY, Assumed, Bounded, Is, Result, Role
from ....ledger.shares import Share
from ....planning.trials.link_cores import LinkCores
from ....view.shares import curve_figure
from ..document import lengths
from ..motions import PAIRS, cores_of, largest_radius, replay_of, slave_plan, smallest_cores
from ..outcomes import VARIANTS
from ..reading import Case, nominal
from ..stored import choice, clear_share, is_declared, successful

checks = partial(REGISTRY.checks, page="xue/truth")

RADII = (0.02, 0.05, 0.08, 0.10, 0.12, 0.15)


@checks(
    "xue.claim_only_tcp",
    rules=[
        Is(
            "links_collide",
            "the end effectors stay apart, and other links of the two arms touch",
            value=False,
        )
    ],
    samples=32,
)
def only_end_effectors(assumed: Assumed) -> Result:
    """Links of both arms in the nominal arrangement and over the lottery."""
    case, radius = Case.of(assumed), assumed["link_radius"]
    replay = replay_of(case, slave_plan(case))
    found = clear_share(radius, "arms")
    parts = {pair: clear_share(radius, pair) for pair in PAIRS}
    parts["all"] = clear_share(radius)
    floor = case.layout.master_base_z - lengths("published")["d1"]
    cores, apart = None, None
    if replay is not None:
        cores, apart = cores_of(replay, case.layout, floor), float(replay.apart().min())
    ends = successful()
    posture_hits = Share.of(
        (ends[["cores_start", "cores_goal"]].min(axis=1) <= radius).sum(), len(ends)
    )
    nearest = ends["nearest_link"].mode()[0]
    collide = (
        cores is not None
        and apart > assumed["meeting_distance"]
        and 0.5 * smallest_cores(cores)["arms"] <= radius
    )
    return Result(
        obtained={
            "links_collide": bool(collide),
            "flanges_apart": apart,
            "lottery": found._asdict(),
            "by_pair": {pair: value._asdict() for pair, value in parts.items()},
            "start_or_end_collides": posture_hits._asdict(),
            "nearest_link": nearest,
            "arrangements": len(ends),
            **_nominal_numbers(cores, radius),
        },
        table=None if cores is None else cores.found.to_frame().reset_index(),
        caption=(
            _nominal_sentence(cores, radius)
            + f" Of {len(ends)} random arrangements in which the end effectors do what Figs 8 to "
            f"11 show, the links of the two arms, of radius {radius:g} m, stay clear of each other "
            f"in {found.value:.0%} (95 % interval {found.low:.0%} to {found.high:.0%}), and of the "
            f"window as well in {parts['all'].value:.0%}; in {posture_hits.value:.0%} the "
            "slave's posture at Start or End already touches a bar. The link nearest to the "
            f"window is most often {nearest}. What is printed thus does not imply that no other "
            "link collides; whether it was so in the document's own arrangement is left open."
        ),
        alt="Share of random arrangements with clear links over the link radius, falling steeply.",
        figure=_radius_figure,
        witnesses=arms_witnesses(radius),
    )


def arms_witnesses(radius: float) -> list[dict[str, Any]]:
    """Two declared arrangements in which the end effectors stay apart: arms clear, and not."""
    table = successful()
    table = table[is_declared(table)]
    clear = (0.5 * table["cores_arms"] > radius).to_numpy()
    return [
        choice(
            int(table.index[np.flatnonzero(mask)[0]]),
            verdict,
            flanges_apart=float(table["flanges_apart"].to_numpy()[mask][0]),
            links_touch_at_radius=float(0.5 * table["cores_arms"].to_numpy()[mask][0]),
        )
        for mask, verdict in ((clear, "holds"), (~clear, "fails"))
        if mask.any()
    ]


@checks(
    "xue.claim_joints_as_points",
    rules=[
        Bounded(
            "size",
            "largest radius or length of what attracts, repels and is repelled [m]",
            high=0,
            role=Role.ADOPTS,
        )
    ],
    samples=8,
)
def joints_as_points(assumed: Assumed) -> Result:
    """Sizes in the problem that the slave's planner is given; what no size hides."""
    case = nominal()
    planner = replace(case.planner, control_points=assumed["control_points"])
    made = VARIANTS["improved"].problem(case._replace(planner=planner))
    points, obstacles = made.points, made.obstacles
    radius = assumed["link_radius"]
    pieces = ((points.local, points.radius), (obstacles.cores[0], obstacles.radius))
    size = max(_largest(*piece) for piece in pieces)
    thin, thick = clear_share(0.0), clear_share(radius)
    return Result(
        obtained={
            "size": size,
            "clear_without_thickness": thin._asdict(),
            "clear_with_radius": thick._asdict(),
        },
        caption=(
            f"The potentials act on {len(points.names)} points of the slave and repel it from "
            f"{len(obstacles.radius)} of the master; the largest of them measures {size:g} m. "
            "Where the points avoid everything, the segments between them are clear in "
            f"{thin.value:.0%} of the arrangements, links of radius {radius:g} m in "
            f"{thick.value:.0%}."
        ),
    )


def _largest(ends: np.ndarray, radius: np.ndarray) -> float:
    """Largest radius or length among cores with ends (K, 2, 3) [m]."""
    length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    return float(max(length.max(), radius.max()))


def _nominal_numbers(nominal: LinkCores | None, radius: float) -> dict:
    if nominal is None:
        return {"nominal": None}
    smallest = smallest_cores(nominal)
    return {
        "nominal": smallest,
        "nominal_largest_radius": largest_radius(smallest),
        "nominal_arms_clear": 0.5 * smallest["arms"] > radius,
        "nominal_floor": {
            name: float(nominal.between(name, "floor").min()) for name in ("master", "slave")
        },
    }


def _nominal_sentence(nominal: LinkCores | None, radius: float) -> str:
    if nominal is None:
        return "In this arrangement there are not two motions to check."
    smallest = smallest_cores(nominal)
    arms, limit = 0.5 * smallest["arms"], largest_radius(smallest)
    word = "clear of each other" if arms > radius else "not clear of each other"
    return (
        f"In the arrangement shown, selected for it, links of radius {radius:g} m of the two arms "
        f"are {word}: they would touch at {arms:.3f} m, and a bar at {limit:.3f} m or more. On a "
        "floor at the published height of the base, the master would reach "
        f"{-nominal.between('master', 'floor').min():.2f} m below it."
    )


def _radius_figure():
    pairs = {"window and other arm": (), "slave and window": ("slave_window",),
             "master and window": ("master_window",), "the two arms": ("arms",)}  # fmt: skip
    return curve_figure(
        RADII,
        {
            name: [clear_share(radius, *chosen) for radius in RADII]
            for name, chosen in pairs.items()
        },
        "radius of all links [m]",
        "share of arrangements that are clear",
        log=False,
    )
