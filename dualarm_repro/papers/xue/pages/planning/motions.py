"""Figures 8-11 of `xue` and the statements about them: both motions around the window."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np
import pandas as pd

from .....ledger import REGISTRY, Assumed, Bounded, Is, Result
from .....ledger.captions import captions
from .....planning.plan import Plan
from .....planning.trials.replay import Replay
from .....view import replays
from .....view.link_bodies import Body
from .....view.style import MASTER
from .....view.tracks import Track, distances_figure, top_view_figure, tracks_figure
from ...document import Layout, gains
from ...motions import (
    master_plan,
    master_undisturbed,
    points_to_window,
    present,
    replay_of,
    slave_plan,
    slave_undisturbed,
    slave_without_master,
)
from ...reading import Case, PlannerChoice
from ..scene import stage

checks = partial(REGISTRY.checks, page="xue/planning", samples=32)
caption = captions(__file__)

_NOTHING = "In this arrangement there are not two motions to compare."
_NO_START = "The printed start of the master would touch a bar."
#: Of the tracks in space, which are shown up to 1.4 m around the window.
_VIEW = {"near": 1.4, "elev": 24, "azim": -70}

_MASTER_RULES = (
    Is("reached", "the master arrives at the printed goal", value=True),
    Bounded("distance", "smallest distance of its control points to a bar [m]", low=1e-6),
    Is("needed", "without repulsion it would come within d_0 of a bar", value=True),
)
_COLLIDING_RULES = (
    Bounded("flange_window", "distance of the undisturbed slave to a bar [m]", high=0),
    Bounded(
        "beyond_meeting",
        "its distance to the master at one instant, less that of a meeting [m]",
        high=0,
    ),
)
_AVOIDING_RULES = (
    Is("reached", "the slave arrives at End", value=True),
    Bounded("flange_window", "smallest distance of its end effector to a bar [m]", low=1e-6),
    Bounded(
        "beyond_meeting",
        "distance of the end effectors until both rest, less that of a meeting [m]",
        low=1e-6,
    ),
    Bounded(
        "beyond_meeting_unaware",
        "the same for a slave that does not know of the master [m]",
        high=0,
    ),
)


@checks("xue.fig08", rules=_MASTER_RULES)
def master_past_window(assumed: Assumed) -> Result:
    """The master by the improved method, and undisturbed."""
    motions, found = _past_window(assumed)
    if motions is None:
        return Result(found, _NO_START)
    layout, (plan, alone) = Layout.of(assumed), motions
    bodies = [Body(plan.placed, plan.path[k], MASTER, k) for k in _instants(plan.steps)]
    tracks = [
        Track("attraction alone", alone.tcp, "0.5", ":"),
        Track("improved method", plan.tcp, MASTER),
    ]
    ends = {"start": plan.tcp[0], "goal": plan.tcp[-1]}
    return Result(
        obtained=found,
        table=plan.to_frame().reset_index(),
        caption=caption("fig08"),
        alt="Track of the master's end effector in space past a window frame of four bars, bent "
        "away from the dashed track it would take without repulsion.",
        figure=lambda: tracks_figure(
            layout.window(), tracks, ends, bodies=bodies, elev=18, azim=-40
        ),
        scene=lambda: replays.add_plan(
            stage("The master moves past the window; its track is blue.", layout), plan
        ),
    )


@checks("xue.claim_master_ok", rules=_MASTER_RULES)
def master_avoids(assumed: Assumed) -> Result:
    """Distance of every control point of the master to every bar."""
    motions, found = _past_window(assumed)
    if motions is None:
        return Result(found, _NO_START)
    layout, points = Layout.of(assumed), assumed["control_points"]
    distances = (points_to_window(motion, layout, points) for motion in motions)
    curves = dict(zip(("improved method", "attraction alone"), distances, strict=True))
    return Result(
        obtained=found,
        caption=caption("claim_master_ok"),
        alt="Distance of the master to the window over the steps, with and without repulsion.",
        figure=lambda: distances_figure(curves, {"range d_0": gains()["d_0"]}),
    )


@checks("xue.fig09", rules=_COLLIDING_RULES)
def slave_collides(assumed: Assumed) -> Result:
    """The slave under attraction alone beside the planned master."""
    replay, found = _colliding(assumed)
    if replay is None:
        return Result(found, _NOTHING)
    layout, (deepest, _) = Layout.of(assumed), replays.contacts_of(replay)
    step, middle = replays.meeting(replay)
    tcp = replay.plan.tcp
    contacts = {f"hit, step {deepest}": tcp[deepest], f"meeting, {step}": middle}
    how: dict[str, Any] = {"instants": [step], **_VIEW}
    title = "Attracted only, the slave runs into window and master; contacts are red."
    return Result(
        obtained=found,
        table=_motion_frame(replay),
        caption=caption("fig09"),
        alt="Tracks of both end effectors in space; the slave's solid track runs through a bar of "
        "the window and crosses the master's dashed track, with circles at both places.",
        figure=lambda: _tracks_figure(tracks_figure, layout, replay, contacts, **how),
        scene=lambda: replays.add_contacts(
            replays.add_replay(stage(title, layout), replay), replay
        ),
    )


@checks("xue.claim_slave_collides_without", rules=_COLLIDING_RULES)
def slave_collides_without(assumed: Assumed) -> Result:
    """Where the undisturbed track enters a bar and where it meets the master."""
    replay, found = _colliding(assumed)
    if replay is None:
        return Result(found, _NOTHING)
    steps = np.flatnonzero(replay.to_obstacles() <= 0.0).tolist()
    return Result(
        obtained={**found, "steps_inside_bar": steps},
        caption=caption("claim_slave_collides_without"),
    )


@checks("xue.fig10", rules=_AVOIDING_RULES)
def avoiding_from_above(assumed: Assumed) -> Result:
    """Both avoiding tracks seen along the vertical."""
    alt = "Plan view of a window, of the master's track and of the slave's track around its bars."
    return _avoiding_tracks(assumed, "fig10", alt, top_view_figure)


@checks("xue.fig11", rules=_AVOIDING_RULES)
def avoiding_in_space(assumed: Assumed) -> Result:
    """Both avoiding tracks in space."""
    alt = (
        "Tracks of both end effectors in space: the slave's runs from Start through the "
        "opening of the window to End, clear of the bars and of the master's track."
    )
    title = "The slave passes the window while the master moves; nothing is touched."
    return _avoiding_tracks(assumed, "fig11", alt, tracks_figure, title, **_VIEW)


def _avoiding_tracks(
    assumed: Assumed, block: str, alt: str, view: replays.TracksView, title: str = "", **how: Any
) -> Result:
    """Both tracks seen in some way, and in a 3-D scene if that has a title."""
    replay, found = _avoiding(assumed)
    if replay is None:
        return Result(found, _NOTHING)
    layout, nearest = Layout.of(assumed), int(replay.apart().argmin())
    instants = [min(nearest, replay.plan.steps)] if title else _instants(replay.plan.steps)
    return Result(
        obtained=found,
        table=_motion_frame(replay),
        caption=caption(block),
        alt=alt,
        figure=lambda: _tracks_figure(view, layout, replay, instants=instants, **how),
        scene=(lambda: replays.add_replay(stage(title, layout), replay)) if title else None,
    )


@checks(
    "xue.claim_slave_ok",
    rules=[
        *_AVOIDING_RULES,
        Bounded("points", "smallest distance of its control points to anything [m]", low=1e-6),
    ],
)
def slave_avoids(assumed: Assumed) -> Result:
    """Smallest distances of the slave's end effector and control points until both arms rest."""
    replay, found = _avoiding(assumed)
    if replay is None:
        return Result({**found, "points": None}, _NOTHING)
    found["points"] = float(replay.plan.clearance.min())
    undisturbed = present(_colliding(assumed)[0], "motion of the slave")
    curves = {
        "window, improved": replay.until_rest(replay.to_obstacles()),
        "master, improved": replay.apart(),
        "window, attraction alone": replay.until_rest(undisturbed.to_obstacles()),
        "master, attraction alone": undisturbed.apart(),
    }
    return Result(
        obtained=found,
        caption=caption("claim_slave_ok"),
        alt="Distances of the slave's end effector to window and master over the steps, two "
        "methods.",
        figure=lambda: distances_figure(
            curves, {"contact": 0.0, "meeting": assumed["meeting_distance"]}
        ),
    )


def _motion_frame(replay: Replay) -> pd.DataFrame:
    """One row per step: end effectors of both arms [m], then their joints, <arm>_q1_rad ..."""
    joints = {
        f"{name}_q{j + 1}_rad": angle
        for name, q in replay.configurations().items()
        for j, angle in enumerate(q.T)
    }
    return replay.to_frame().assign(**joints)


def _instants(steps: int) -> list[int]:
    """Steps at which arms are drawn: a third and two thirds of the way, at multiples of 20."""
    return [20 * round(share * steps / 20) for share in (1 / 3, 2 / 3)]


def _colliding(assumed: Assumed) -> tuple[Replay | None, dict[str, Any]]:
    """The undisturbed slave beside the master, and how they meet while it moves."""
    case, meeting = Case.of(assumed), assumed["meeting_distance"]
    replay = replay_of(case, slave_undisturbed(case.layout, case.planner))
    return replay, _meeting_numbers(replay, meeting, moving=True)


def _avoiding(assumed: Assumed) -> tuple[Replay | None, dict[str, Any]]:
    """The improved slave beside the master, and how they meet until both rest."""
    case, meeting = Case.of(assumed), assumed["meeting_distance"]
    replay, alone = replay_of(case, slave_plan(case)), None
    if replay is not None:
        alone = replay_of(case, slave_without_master(case))
    unaware = None if alone is None else float(alone.apart().min() - meeting)
    found = _meeting_numbers(replay, meeting, moving=False)
    return replay, found | {"beyond_meeting_unaware": unaware}


def _past_window(assumed: Assumed) -> tuple[tuple[Plan, Plan] | None, dict[str, Any]]:
    """The master by the improved method and by attraction alone, and how near they come."""
    layout, planner = Layout.of(assumed), PlannerChoice.of(assumed)
    plan = master_plan(layout, planner)
    if plan is None:
        return None, {"reached": False, "distance": None, "needed": False}
    alone, points = master_undisturbed(layout, planner), planner.control_points
    undisturbed = points_to_window(alone, layout, points).min()
    inside = plan.placed.arm.within_limits(plan.path, 1e-9)
    found: dict[str, Any] = {
        "reached": plan.reached,
        "steps": plan.steps,
        "distance": float(points_to_window(plan, layout, points).min()),
        "distance_undisturbed": float(undisturbed),
        "needed": bool(undisturbed < gains()["d_0"]),
        "activations": plan.activations,
        "beyond_limits": float(1.0 - np.mean(inside)),
    }
    return (plan, alone), found


def _meeting_numbers(replay: Replay | None, meeting: float, *, moving: bool) -> dict[str, Any]:
    """Distances to bars and master until both arms rest, or while the slave is moving."""
    if replay is None:
        nothing = dict.fromkeys(("flange_window", "beyond_meeting"))
        return {"reached": False, "enters_bar": False, "meets_master": False, **nothing}
    window, apart = float(replay.to_obstacles().min()), replay.apart(moving=moving)
    return {
        "reached": replay.plan.reached,
        "reason": str(replay.plan.reason),
        "steps": replay.plan.steps,
        "activations": replay.plan.activations,
        "flange_window": window,
        "enters_bar": window <= 0.0,
        "flanges_apart": float(apart.min()),
        "beyond_meeting": float(apart.min() - meeting),
        "nearest_step": int(apart.argmin()),
        "meets_master": bool(apart.min() <= meeting),
    }


def _tracks_figure(
    view: replays.TracksView, layout: Layout, replay: Replay, *further: Any, **how: Any
) -> Any:
    """Tracks of both end effectors around the window, with Start, End and the virtual point."""
    start, end = layout.slave_points()
    marks = {"Start": start, "End": end, "virtual point": layout.window_centre}
    return replays.replay_figure(view, replay, layout.window(), marks, *further, **how)
