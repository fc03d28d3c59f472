"""Figures 15-17 of `qiu`: the slave's path and both arms together."""

from __future__ import annotations

from functools import partial

import numpy as np
import pandas as pd

from ...ledger import REGISTRY, Assumed, Bounded, Is, NoOriginal, Result
from ...planning.control_points import end_effector
from ...planning.hull_obstacle import circles_on
from ...scene import ConvexHull, densify, distances
from ...view.scene3d import Scene3D
from ...view.search_curves import coordinate_figure, joint_figure
from ...view.style import GREEN, MASTER, ORANGE, SLAVE
from ...view.success_curves import distance_figure
from .execution import both_arms, dual_scene, executed
from .master_slave import SLAVE_MEETING, dual_readings
from .readings import DualPlan, circles
from .scenario import spheres

checks = partial(REGISTRY.checks, page="qiu/master_slave")


@checks(
    "qiu.fig15",
    samples=32,
    rules=[
        Is(key="joined", value=True, label="the slave's halves meet"),
        NoOriginal(key="curves", label="the curves"),
    ],
)
def slave_joints(assumed: Assumed) -> Result:
    """Joint angles of the slave while the hull of the master moves."""
    plans = dual_readings(assumed)
    face = plans["face value"]
    table = pd.DataFrame(np.rad2deg(face.slave_path), columns=[f"q{j}_deg" for j in range(1, 7)])
    return Result(
        obtained={
            "joined": face.slave.reached,
            "reconstruction_joined": plans["reconstruction"].slave.reached,
            "range_deg": np.rad2deg(np.ptp(face.slave_path, axis=0)).tolist(),
        },
        table=table,
        caption=(
            f"Joint angles of the slave over its smoothed path, {len(face.slave_path)} samples at "
            "face "
            f"value and {len(plans['reconstruction'].slave_path)} in the reconstruction; junctions "
            "dotted. "
            "The printed curves are lost."
        ),
        alt="Six panels of joint angles of the slave over the samples of its path, for two "
        "readings.",
        figure=lambda: joint_figure(
            {name: plan.slave_path for name, plan in plans.items()},
            [plan.slave.searches + 0.5 for plan in plans.values()],
        ),
    )


@checks(
    "qiu.fig16",
    samples=32,
    rules=[
        Bounded(key="end_error", high=1e-3, label="distance of the ends to start and goal [m]"),
        NoOriginal(key="curves", label="the curves"),
    ],
)
def slave_coordinates(assumed: Assumed) -> Result:
    """Coordinates of the slave's flange while the hull of the master moves."""
    plans = dual_readings(assumed)
    tips = {n: end_effector(p.slave.problem.placed, p.slave_path) for n, p in plans.items()}
    face = plans["face value"].slave
    error = max(float(np.linalg.norm(tips["face value"][k] - face.tcp[k])) for k in (0, -1))
    return Result(
        obtained={
            "end_error": error,
            "lowest": {name: float(tip[:, 2].min()) for name, tip in tips.items()},
        },
        table=pd.DataFrame(tips["face value"], columns=["x_m", "y_m", "z_m"]),
        caption=(
            f"Coordinates of the slave's flange; its lowest point is at z = "
            f"{tips['face value'][:, 2].min():.3f} m at face value, while the printed halves meet "
            "at z = "
            f"{SLAVE_MEETING[0, 2]:.3f} m (dashed, dotted). The printed curves are lost."
        ),
        alt="Three panels with x, y and z of the slave's flange over its path for two readings.",
        figure=lambda: coordinate_figure(
            tips,
            {"printed, forward": SLAVE_MEETING[0], "printed, backward": SLAVE_MEETING[1]},
            "sample of the path",
        ),
    )


@checks(
    "qiu.fig17",
    samples=32,
    rules=[
        Is(key="joined", value=True, label="both arms have a path"),
        NoOriginal(key="time_scale", label="a common time scale"),
    ],
)
def both_arms_together(assumed: Assumed) -> Result:
    """Distance of the arms over a common motion, and both arms played."""
    scale, radii = assumed["link_radius_scale"], assumed["link_radii"]
    plans = dual_readings(assumed)
    curves = {
        f"{'arm to arm' if pair == 'master' else 'slave to spheres'}, {name}": _distance(
            plan, pair, scale
        )
        for name, plan in plans.items()
        for pair in ("master", "spheres")
    }
    face = executed(plans["face value"], radius_scale=scale)
    return Result(
        obtained={
            "joined": all(
                p.reached for p in (plans["face value"].master, plans["face value"].slave)
            ),
            "smallest": {name: float(values.min()) for name, values in curves.items()},
            "floor": face.clearance["floor"],
            "links": len(radii),
        },
        caption=(
            "Smallest distance over the common motion: "
            + "; ".join(f"{name} {1e3 * values.min():.0f} mm" for name, values in curves.items())
            + ". Below zero the links overlap. A common time scale is not printed."
        ),
        alt="Distances between the arms and from the slave to the spheres over a common motion, in "
        "two "
        "readings; the band below zero is shaded.",
        figure=lambda: distance_figure(curves, "share of the common motion"),
        scene=lambda: _scene(plans["reconstruction"], assumed),
    )


def _distance(plan: DualPlan, other: str, scale: float) -> np.ndarray:
    scene = dual_scene(scale)
    master, slave = both_arms(plan)
    q, _ = densify(scene.stack(master=master, slave=slave), 0.02)
    found = distances(scene, q)
    names = ("master",) if other == "master" else tuple(spheres())
    mask = np.any([scene.pairs.between("slave", name) for name in names], axis=0)
    return found[:, mask].min(axis=1)


def _scene(plan: DualPlan, assumed: Assumed) -> Scene3D:
    """Both arms played by the time map, with the hull of the master at its middle pose."""
    master, slave = both_arms(plan)
    arms = {placed.name: placed for placed in dual_scene().arms}
    made = Scene3D(
        "Both arms on their paths (reconstruction); translucent: hull of the master at its middle "
        "pose.",
        camera=(0.6, 2.0, 1.4),
    )
    for name, sphere in spheres().items():
        made.add_sphere(name, sphere.center, sphere.radius, ORANGE)
    for (name, placed), path, color in zip(
        arms.items(), (master, slave), (MASTER, SLAVE), strict=True
    ):
        made.add_arm(name, placed.arm, path[0], placed.placement, color)
        made.add_path(f"{name} flange", end_effector(placed, path), color)
    middle = plan.master_path[len(plan.master_path) // 2]
    hull = ConvexHull(circles_on(arms["master"], circles(assumed), middle[np.newaxis])[0])
    made.add_mesh("hull", hull.vertices, hull.faces, GREEN, 0.25)
    made.animate({"master": (arms["master"].arm, master), "slave": (arms["slave"].arm, slave)})
    return made
