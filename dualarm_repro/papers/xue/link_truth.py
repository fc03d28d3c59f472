"""Tool tip or whole links: what section 3.3 says about collisions, against the capsules."""

from __future__ import annotations

from functools import partial

import numpy as np

from ...ledger import REGISTRY, Assumed, Bounded, Result, Role
from ...planning.control_points import control_points
from ...view.shares import curve_figure
from .layout import arms_of
from .motions import Case, master_track, slave_plan
from .readings import lengths
from .stored import clear_share, share, successful
from .table_2 import DECISIVE
from .truth import Cores, largest_radius, link_cores

checks = partial(REGISTRY.checks, page="xue/truth")

RADII = (0.02, 0.05, 0.08, 0.10, 0.12, 0.15)


@checks(
    "xue.claim_only_tcp",
    rules=[
        Bounded(key="lottery.high", low=0.05, label="arrangements with clear links, upper bound"),
        Bounded(
            key="lottery.low",
            low=DECISIVE,
            label="arrangements with clear links, lower bound; else a printed layout",
        ),
    ],
    samples=32,
)
def only_end_effectors(assumed: Assumed) -> Result:
    """Links of both arms in the nominal arrangement and over the lottery."""
    case, radius = Case.of(assumed), assumed["link_radius"]
    slave, track = slave_plan(case), master_track(case)
    found = clear_share(radius)
    parts = {pair: clear_share(radius, pair) for pair in ("slave_window", "master_window", "arms")}
    floor = case.layout.master_base_z - lengths("published")["d1"]
    nominal = None
    if slave is not None and track is not None:
        nominal = link_cores(case.layout, slave, track, floor)
    ends = successful()
    posture_hits = share(
        (ends[["cores_start", "cores_goal"]].min(axis=1) <= radius).sum(), len(ends)
    )
    nearest = ends["nearest_link"].mode()[0]
    return Result(
        obtained={
            "lottery": found._asdict(),
            "by_pair": {pair: value._asdict() for pair, value in parts.items()},
            "start_or_end_collides": posture_hits._asdict(),
            "nearest_link": nearest,
            "arrangements": len(ends),
            **_nominal_numbers(nominal, radius),
        },
        table=None if nominal is None else nominal.found.to_frame().reset_index(),
        caption=(
            _nominal_sentence(nominal, radius)
            + f" Of {len(ends)} random arrangements in which the end effectors do what Figs 8 to "
            f"11 show, all links of radius {radius:g} m stay clear in {found.value:.0%} (95 % "
            f"interval {found.low:.0%} to {found.high:.0%}); in {posture_hits.value:.0%} the "
            "slave's posture at Start or End already touches a bar. The link nearest to the "
            f"window is most often {nearest}. That no other link collides is thus no rule, and "
            "for the document's own arrangement it cannot be decided."
        ),
        alt="Share of random arrangements with clear links over the link radius, falling steeply.",
        figure=_radius_figure,
    )


@checks(
    "xue.claim_joints_as_points",
    rules=[
        Bounded(
            key="size", high=0.0, role=Role.ADOPTS, label="radius and length of a control point [m]"
        )
    ],
    samples=8,
)
def joints_as_points(assumed: Assumed) -> Result:
    """The control points have no size; what that hides."""
    points = control_points(arms_of("matrices")[1], assumed["control_points"])
    radius = assumed["link_radius"]
    length = np.linalg.norm(points.local[:, 1] - points.local[:, 0], axis=1)
    thin, thick = clear_share(0.0), clear_share(radius)
    return Result(
        obtained={
            "size": float(max(length.max(), points.radius.max())),
            "clear_without_thickness": thin._asdict(),
            "clear_with_radius": thick._asdict(),
        },
        caption=(
            f"The potentials act on {len(points.names)} points without size. Where the points "
            f"avoid everything, the segments between them are clear in {thin.value:.0%} of the "
            f"arrangements, links of radius {radius:g} m in {thick.value:.0%}."
        ),
    )


def _nominal_numbers(nominal: Cores | None, radius: float) -> dict:
    if nominal is None:
        return {"nominal": None}
    return {
        "nominal": nominal.smallest,
        "nominal_largest_radius": largest_radius(nominal.smallest),
        "nominal_clear": largest_radius(nominal.smallest) > radius,
        "nominal_floor": {
            name: float(nominal.between(name, "floor").min()) for name in ("master", "slave")
        },
    }


def _nominal_sentence(nominal: Cores | None, radius: float) -> str:
    if nominal is None:
        return "In this arrangement there are not two motions to check."
    limit = largest_radius(nominal.smallest)
    word = "clear" if limit > radius else "not clear"
    return (
        f"In the arrangement shown, selected for it, links of radius {radius:g} m are {word}: they "
        f"would touch at {limit:.3f} m. On a floor at the published height of the base, the master "
        f"would reach {-nominal.between('master', 'floor').min():.2f} m below it."
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
