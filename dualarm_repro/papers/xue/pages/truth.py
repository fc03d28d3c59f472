"""Tool tip or whole links: what section 3.3 says about collisions, against the capsules."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np
import pandas as pd

from ....ledger import REGISTRY, Assumed, Bounded, Is, Result, Role
from ....ledger.captions import captions
from ....ledger.shares import Share
from ....planning.trials.link_cores import LinkCores
from ....view.shares import curve_figure
from ..document import lengths
from ..motions import (
    PAIRS,
    cores_of,
    largest_radius,
    master_plan,
    present,
    replay_of,
    slave_plan,
    smallest_cores,
)
from ..outcomes import VARIANTS
from ..reading import Case, nominal
from ..stored import choice, clear_share, is_declared, lottery_table

checks = partial(REGISTRY.checks, page="xue/truth")
caption = captions(__file__)

RADII = (0.02, 0.05, 0.08, 0.10, 0.12, 0.15)


@checks(
    "xue.claim_only_tcp",
    rules=[
        Is(
            "links_collide",
            "the end effectors stay apart, and other links of the two arms than both last touch",
            value=False,
        )
    ],
    samples=32,
)
def only_end_effectors(assumed: Assumed) -> Result:
    """Links of both arms in the nominal arrangement and over the lottery."""
    case, radius = Case.of(assumed), assumed["link_radius"]
    replay = replay_of(case, slave_plan(case))
    floor = case.layout.master_base_z - lengths("published")["d1"]
    cores, apart, collide = None, None, False
    if replay is not None:
        cores, apart = cores_of(replay, case.layout, floor), float(replay.apart().min())
        collide = apart > assumed["meeting_distance"] and 0.5 * other_links(cores) <= radius
    ends = lottery_table()
    involved = others_touch(ends, radius)
    postures = (ends[["cores_start", "cores_goal"]].min(axis=1) <= radius).sum()
    shares = {pair: clear_share(radius, pair)._asdict() for pair in PAIRS}
    return Result(
        obtained={
            "links_collide": collide,
            "flanges_apart": apart,
            "lottery": shares["arms"],
            "others_touch_at_least": Share.of(involved.sum(), len(ends))._asdict(),
            "by_pair": {**shares, "all": clear_share(radius)._asdict()},
            "start_or_end_collides": Share.of(postures, len(ends))._asdict(),
            "nearest_link": ends["nearest_link"].mode()[0],
            "arrangements": len(ends),
            **_nominal_numbers(cores, radius),
        },
        table=None if cores is None else cores.found.to_frame().reset_index(),
        caption=caption("claim_only_tcp", radius=radius),
        alt="Share of random arrangements with clear links over the link radius, falling steeply.",
        figure=_radius_figure,
        witnesses=arms_witnesses(radius),
    )


@checks(
    "xue.claim_tip_check_suffices",
    rules=[
        Bounded(
            "refuting",
            "arrangements in which the end effectors stay apart and other links surely touch",
            high=0,
        )
    ],
    samples=8,
)
def tips_speak_for_links(assumed: Assumed) -> Result:
    """Counterexamples to the inference where the end effectors do what Figs 8 to 11 show."""
    radius, table = assumed["link_radius"], lottery_table()
    touch = others_touch(table, radius)
    far = table[touch & is_declared(table)]
    worst = [] if far.empty else [far.loc[far["flanges_apart"].idxmax()]]
    return Result(
        obtained={
            "refuting": int(touch.sum()),
            "of": len(table),
            "share": Share.of(touch.sum(), len(table))._asdict(),
            "touching": int((0.5 * table["cores_arms"] <= radius).sum()),
            "farthest_tips": None if not worst else float(worst[0]["flanges_apart"]),
        },
        caption=caption("claim_tip_check_suffices", radius=radius, apart=2.0 * radius + _last()),
        witnesses=[
            choice(
                int(row.name),
                "fails",
                flanges_apart=float(row["flanges_apart"]),
                links_touch_at_radius=float(0.5 * row["cores_arms"]),
            )
            for row in worst
        ],
    )


def others_touch(table: pd.DataFrame, radius: float) -> np.ndarray:
    """In which arrangements of the lottery another link than both last ones surely touches (N,).

    Cores touch at 2 r. Were only those of the last links, of lengths l_m and l_s, that near, the
    end effectors would come within 2 r + l_m + l_s; where they never do, another link is involved.
    So the count is a lower bound: another link may touch while the end effectors are near as well.
    """
    touch = table["cores_arms"] <= 2.0 * radius
    return (touch & (table["flanges_apart"] > 2.0 * radius + _last())).to_numpy()


def _last() -> float:
    """Length of the last links of both arms together, wrist centre to flange [m]."""
    return 2.0 * lengths(nominal().layout.dh_source)["d6"]


def other_links(cores: LinkCores) -> float:
    """Smallest core distance of the two arms, that between both last links left aside [m]."""
    pairs = [tuple(body.partition("/") for body in pair) for pair in cores.found.pairs]
    last = {owner: max(name for pair in pairs for arm, _, name in pair if arm == owner)
            for owner in PAIRS["arms"]}  # fmt: skip
    kept = [
        {owner for owner, _, _ in pair} == set(PAIRS["arms"])
        and any(name != last[owner] for owner, _, name in pair)
        for pair in pairs
    ]
    return float(cores.found.distance[:, kept].min())


def arms_witnesses(radius: float) -> list[dict[str, Any]]:
    """Two declared arrangements in which the end effectors stay apart: all links clear, and other
    links than both last ones in contact."""
    table = lottery_table()
    table = table[is_declared(table)]
    clear, touch = 0.5 * table["cores_arms"] > radius, others_touch(table, radius)
    return [
        choice(
            int(rows.index[0]),
            verdict,
            flanges_apart=float(rows["flanges_apart"].iloc[0]),
            links_touch_at_radius=float(0.5 * rows["cores_arms"].iloc[0]),
        )
        for rows, verdict in ((table[clear], "holds"), (table[touch], "fails"))
        if len(rows)
    ]


@checks(
    "xue.claim_joints_as_points",
    rules=[
        Bounded(
            "size",
            "largest radius or length of what attracts, repels and is repelled [m]",
            high=0,
            role=Role.ADOPTS,
        ),
        Bounded(
            "off_origins",
            "distances on the path of the master against those of the joint origins [m]",
            high=1e-9,
            role=Role.ADOPTS,
        ),
    ],
    samples=8,
)
def joints_as_points(assumed: Assumed) -> Result:
    """Sizes in the problem that the slave's planner is given; what no size hides."""
    case = nominal(control_points=assumed["control_points"])
    made = VARIANTS["improved"].problem(case)
    points, obstacles, radius = made.points, made.obstacles, assumed["link_radius"]
    pieces = ((points.local, points.radius), (obstacles.cores[0], obstacles.radius))
    counts = {"points": len(points.names), "repelling": len(obstacles.radius)}
    return Result(
        obtained={
            "size": max(_largest(*piece) for piece in pieces),
            "off_origins": _off_origins(case),
            "clear_without_thickness": clear_share(0.0)._asdict(),
            "clear_with_radius": clear_share(radius)._asdict(),
        },
        caption=caption("claim_joints_as_points", radius=radius, **counts),
    )


def _largest(ends: np.ndarray, radius: np.ndarray) -> float:
    """Largest radius or length among cores with ends (K, 2, 3) [m]."""
    length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    return float(max(length.max(), radius.max()))


def _off_origins(case: Case) -> float:
    """Largest difference of the distances to the window that the planner records on the path of
    the master from those of the nearest joint origin, whatever point set it uses [m]."""
    plan = present(master_plan(case.layout, case.planner), "plan of the master")
    placed = plan.placed
    origins = placed.arm.joint_positions(plan.path) + placed.placement.translation
    found = np.full((*origins.shape[:2], 0), np.inf)
    for bar in case.layout.window():
        local = (origins - bar.center) @ bar.rotation
        outside = np.linalg.norm(np.maximum(np.abs(local) - bar.half, 0.0), axis=2)
        found = np.concatenate([found, outside[:, :, np.newaxis]], axis=2)
    nearest = found.min(axis=2)
    gaps = np.abs(plan.clearance[:, :, np.newaxis] - nearest[:, np.newaxis, :])
    return float(gaps.min(axis=2).max())


def _nominal_numbers(nominal: LinkCores | None, radius: float) -> dict[str, Any]:
    if nominal is None:
        return {"nominal": None}
    smallest = smallest_cores(nominal)
    return {
        "nominal": smallest,
        "nominal_other_links": other_links(nominal),
        "nominal_largest_radius": largest_radius(smallest),
        "nominal_arms_clear": 0.5 * smallest["arms"] > radius,
        "nominal_floor": {
            name: float(nominal.between(name, "floor").min()) for name in ("master", "slave")
        },
    }


def _radius_figure() -> Any:
    pairs = {"window and other arm": (), "slave and window": ("slave_window",),
             "master and window": ("master_window",), "the two arms": ("arms",)}  # fmt: skip
    curves = {name: [clear_share(r, *chosen) for r in RADII] for name, chosen in pairs.items()}
    labels = ("radius of all links [m]", "share of arrangements that are clear")
    return curve_figure(RADII, curves, *labels, log=False)
