"""Animated 3-D scenes of the motions: contacts are red."""

from __future__ import annotations

import numpy as np

from .....planning.field.control_points import end_effector
from .....planning.plan import Plan
from .....view.scene3d import Scene3D
from .....view.style import MASTER, SLAVE
from ...document import Layout, placed_master
from ...motions import Replay
from ..scene import stage

_CONTACT = "#D00000"


def master_scene(layout: Layout, plan: Plan) -> Scene3D:
    """The master past the window."""
    made = stage("The master moves past the window; its track is blue.", layout)
    placed = plan.placed
    made.add_arm("master", placed.arm, plan.path[0], placed.placement, MASTER)
    made.add_path("track", plan.tcp, MASTER)
    made.animate({"master": (placed.arm, plan.path)})
    return made


def colliding_scene(replay: Replay) -> Scene3D:
    """The undisturbed slave: red where it is inside a bar and where it meets the master."""
    title = "Attracted only, the slave runs into window and master; contacts are red."
    made, slave = _both(title, replay), replay.slave
    window, nearest = replay.to_window(), int(replay.apart(moving=True).argmin())
    for k in np.flatnonzero(window <= 0.0):
        made.add_sphere(f"in bar {k}", slave.tcp[k], 0.05, _CONTACT)
    made.add_sphere("meeting", slave.tcp[nearest], 0.09, _CONTACT)
    placed = slave.placed
    for name, k in (("at bar", int(window.argmin())), ("at meeting", nearest)):
        made.add_arm(f"slave {name}", placed.arm, slave.path[k], placed.placement, _CONTACT, 0.3)
    return made


def avoiding_scene(replay: Replay) -> Scene3D:
    """The slave by the improved method beside the master."""
    return _both("The slave passes the window while the master moves; nothing is touched.", replay)


def _both(title: str, replay: Replay) -> Scene3D:
    """Both arms in motion, with their tracks."""
    made, slave = stage(title, replay.layout), replay.slave
    paths = {
        "master": (placed_master(replay.layout), replay.track.at(replay.times), MASTER),
        "slave": (slave.placed, slave.path[np.minimum(replay.times, slave.steps)], SLAVE),
    }
    for name, (placed, path, color) in paths.items():
        made.add_arm(name, placed.arm, path[0], placed.placement, color)
        made.add_path(f"{name} track", end_effector(placed, path), color)
    made.animate({name: (placed.arm, path) for name, (placed, path, _) in paths.items()})
    return made
