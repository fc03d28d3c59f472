"""Replayed motions of two arms around boxes: their tracks, and animated 3-D scenes of them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from ..planning.field.control_points import end_effector
from ..planning.plan import Plan
from ..planning.trials.replay import Replay
from ..scene import Box, PlacedArm
from .link_bodies import Body
from .scene3d import Scene3D
from .style import MASTER, SLAVE
from .tracks import Track

_BAR = "#9A9A9A"
_CONTACT = "#D00000"
#: Draws boxes, tracks, named points and further circles.
TracksView = Callable[..., Any]


def replay_figure(
    view: TracksView,
    replay: Replay,
    bars: Iterable[Box],
    marks: Mapping[str, np.ndarray],
    contacts: Mapping[str, np.ndarray] | None = None,
    instants: Sequence[int] = (),
    **how: Any,
) -> Any:
    """Tracks of both end effectors around boxes, with named points and, if given, contacts.

    Both arms are drawn as bodies at the ``instants``, steps of the replay.
    """
    points = end_effector(replay.other, replay.track.configurations)
    tracks = [
        Track(replay.other.name, points, MASTER, "--"),
        Track(replay.plan.placed.name, replay.plan.tcp, SLAVE),
    ]
    bodies = [body for step in instants for body in bodies_at(replay, step)]
    further = [] if contacts is None else [contacts]
    return view(bars, tracks, marks, *further, bodies=bodies, **how)


def bodies_at(replay: Replay, step: int) -> tuple[Body, Body]:
    """Both arms at one instant."""
    mine, plan = replay.plan.placed, replay.plan
    other = replay.track.at(np.array([float(step)]))[0]
    own = plan.path[min(step, plan.steps)]
    return Body(replay.other, other, MASTER, step), Body(mine, own, SLAVE, step)


def meeting(replay: Replay) -> tuple[int, np.ndarray]:
    """The step at which the end effectors come nearest while the planned one moves, and the middle
    between them there (3,) [m]."""
    _, step = contacts_of(replay)
    other = end_effector(replay.other, replay.track.at(np.array([float(step)])))[0]
    return step, 0.5 * (other + replay.plan.tcp[step])


def contacts_of(replay: Replay) -> tuple[int, int]:
    """Steps at which the planned arm is deepest in an obstacle, and nearest to the other arm."""
    return int(replay.to_obstacles().argmin()), int(replay.apart(moving=True).argmin())


def add_stage(
    made: Scene3D, bars: Iterable[Box], marks: Mapping[str, tuple[np.ndarray, float, str]]
) -> Scene3D:
    """Draw boxes, and named points as spheres: place (3,) [m], radius [m] and colour."""
    for k, bar in enumerate(bars):
        pose = np.eye(4)
        pose[:3] = bar.pose
        made.add_box(f"bar {k}", bar.size, pose, _BAR, solid=True)
    for name, (place, radius, color) in marks.items():
        made.add_sphere(name, place, radius, color)
    return made


def add_plan(made: Scene3D, plan: Plan, color: str = MASTER) -> Scene3D:
    """Draw one arm in motion, with the track of its end effector."""
    placed = plan.placed
    made.add_arm(placed.name, placed.arm, plan.path[0], placed.placement, color)
    made.add_path("track", plan.tcp, color)
    made.animate({placed.name: (placed.arm, plan.path)})
    return made


def add_replay(made: Scene3D, replay: Replay) -> Scene3D:
    """Draw both arms in motion, with the tracks of their end effectors."""
    arms: dict[str, PlacedArm] = {arm.name: arm for arm in (replay.other, replay.plan.placed)}
    paths = replay.configurations()
    for (name, placed), color in zip(arms.items(), (MASTER, SLAVE), strict=True):
        made.add_arm(name, placed.arm, paths[name][0], placed.placement, color)
        made.add_path(f"{name} track", end_effector(placed, paths[name]), color)
    made.animate({name: (placed.arm, paths[name]) for name, placed in arms.items()})
    return made


def add_contacts(made: Scene3D, replay: Replay) -> Scene3D:
    """Mark in red where the planned arm is inside an obstacle and where it meets the other arm."""
    plan, placed = replay.plan, replay.plan.placed
    for k in np.flatnonzero(replay.to_obstacles() <= 0.0):
        made.add_sphere(f"in bar {k}", plan.tcp[k], 0.05, _CONTACT)
    deepest, nearest = contacts_of(replay)
    made.add_sphere("meeting", plan.tcp[nearest], 0.09, _CONTACT)
    for name, at in (("at bar", deepest), ("at meeting", nearest)):
        shown = f"{placed.name} {name}"
        made.add_arm(shown, placed.arm, plan.path[at], placed.placement, _CONTACT, 0.3)
    return made
