"""Animated 3-D scenes of the motions: contacts are red."""

from __future__ import annotations

import numpy as np

from .....planning.field.control_points import end_effector
from .....planning.plan import Plan
from .....planning.trials.encounter import instants, tips_apart
from .....scene import JointPath
from .....view.scene3d import Scene3D
from .....view.style import MASTER, SLAVE
from ...document import Layout, placed_master
from ...motions import flange_to_window
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


def colliding_scene(layout: Layout, slave: Plan, track: JointPath) -> Scene3D:
    """The undisturbed slave: red where it is inside a bar and where it meets the master."""
    made = stage("Attracted only, the slave runs into window and master; contacts are red.", layout)
    _both(made, layout, slave, track)
    master = placed_master(layout)
    window = flange_to_window(slave, layout)
    apart = tips_apart(slave, master, track, moving=True)
    inside = np.flatnonzero(window <= 0.0)
    for k in inside:
        made.add_sphere(f"in bar {k}", slave.tcp[k], 0.05, _CONTACT)
    nearest = int(apart.argmin())
    made.add_sphere("meeting", slave.tcp[nearest], 0.09, _CONTACT)
    for name, k in (("at bar", int(window.argmin())), ("at meeting", nearest)):
        made.add_arm(
            f"slave {name}", slave.placed.arm, slave.path[k], slave.placed.placement, _CONTACT, 0.3
        )
    return made


def avoiding_scene(layout: Layout, slave: Plan, track: JointPath) -> Scene3D:
    """The slave by the improved method beside the master."""
    made = stage("The slave passes the window while the master moves; nothing is touched.", layout)
    _both(made, layout, slave, track)
    return made


def _both(made: Scene3D, layout: Layout, slave: Plan, track: JointPath) -> None:
    master, times = placed_master(layout), instants(slave, track)
    paths = {
        "master": (master, track.at(times), MASTER),
        "slave": (slave.placed, slave.path[np.minimum(times, slave.steps)], SLAVE),
    }
    for name, (placed, path, color) in paths.items():
        made.add_arm(name, placed.arm, path[0], placed.placement, color)
        made.add_path(f"{name} track", end_effector(placed, path), color)
    made.animate({name: (placed.arm, path) for name, (placed, path, _) in paths.items()})
