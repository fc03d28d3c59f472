"""Figures 15-17 of `qiu`: the slave's path and both arms together."""

from __future__ import annotations

from functools import partial

import numpy as np
import pandas as pd

from ...ledger import REGISTRY, Assumed, Bounded, NoOriginal, Result
from ...planning.field.control_points import end_effector
from ...planning.field.hull_obstacle import circles_on
from ...scene import ConvexHull, densify, distances
from ...view.scene3d import Scene3D
from ...view.search_curves import coordinate_figure, joint_figure
from ...view.style import GREEN, MASTER, ORANGE, SLAVE
from ...view.tip_paths import TipPanel, tip_path_figure
from .execution import both_arms, dual_scene, executed
from .master_slave import dual_readings
from .printed_points import slave_meeting
from .readings import DualPlan, circles, link_radii
from .scenario import spheres

checks = partial(REGISTRY.checks, page="qiu/master_slave")
_TIMES = 5


@checks(
    "qiu.fig15",
    rules=[
        Bounded(
            "largest_step", "largest step of a joint on the smoothed path [rad]", high="two_steps"
        ),
        NoOriginal("curves", "the curves"),
    ],
)
def slave_joints(assumed: Assumed) -> Result:
    """Joint angles of the slave while the hull of the master moves."""
    plans = dual_readings(assumed)
    face = plans["face value"]
    table = pd.DataFrame(np.rad2deg(face.slave_path), columns=[f"q{j}_deg" for j in range(1, 7)])
    return Result(
        obtained={
            "largest_step": float(np.abs(np.diff(face.slave_path, axis=0)).max()),
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
    rules=[
        Bounded("end_error", "distance of the ends to start and goal [m]", high="held"),
        Bounded("largest_step", "largest step of the flange on the path [m]", high="two_steps"),
        NoOriginal("curves", "the curves"),
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
            "largest_step": float(
                np.linalg.norm(np.diff(tips["face value"], axis=0), axis=1).max()
            ),
            "lowest": {name: float(tip[:, 2].min()) for name, tip in tips.items()},
        },
        table=pd.DataFrame(tips["face value"], columns=["x_m", "y_m", "z_m"]),
        caption=(
            f"Coordinates of the slave's flange; its lowest point is at z = "
            f"{tips['face value'][:, 2].min():.3f} m at face value, while the printed halves meet "
            "at z = "
            f"{slave_meeting()[0, 2]:.3f} m (dashed, dotted). The printed curves are lost."
        ),
        alt="Three panels with x, y and z of the slave's flange over its path for two readings.",
        figure=lambda: coordinate_figure(
            tips,
            {"printed, forward": slave_meeting()[0], "printed, backward": slave_meeting()[1]},
            "sample of the path",
        ),
    )


@checks(
    "qiu.fig17",
    rules=[
        Bounded(
            "apart", "joint distance of a joined pair of halves beyond the tolerance", high=0.0
        ),
        NoOriginal("time_scale", "a common time scale"),
    ],
)
def both_arms_together(assumed: Assumed) -> Result:
    """Distance of the arms over a common motion, and both arms played."""
    radii = link_radii(assumed)
    plans = dual_readings(assumed)
    curves = {
        f"{'arm to arm' if pair == 'master' else 'slave to spheres'}, {name}": _distance(
            plan, pair, radii
        )
        for name, plan in plans.items()
        for pair in ("master", "spheres")
    }
    face = executed(plans["face value"], radii=radii)
    return Result(
        obtained={
            "apart": max(p.gap for p in (plans["face value"].master, plans["face value"].slave))
            - assumed["joint_tolerance"],
            "smallest": {name: float(values.min()) for name, values in curves.items()},
            "floor": face.clearance["floor"],
        },
        caption=(
            "Smallest distance over the common motion: "
            + "; ".join(f"{name} {1e3 * values.min():.0f} mm" for name, values in curves.items())
            + ". Below zero the links overlap. A common time scale is not printed."
        ),
        table=_motion(plans["face value"], radii),
        alt="Both arms among the spheres at common times, with the paths of both flanges, in two "
        "panels for two readings.",
        figure=lambda: tip_path_figure(
            [_panel(name, plan) for name, plan in plans.items()], list(spheres().values()), azim=60
        ),
        scene=lambda: _scene(plans["reconstruction"], assumed),
    )


def _panel(name: str, plan: DualPlan) -> TipPanel:
    """Both arms at common times, and the paths of their flanges."""
    paths = dict(zip(("master", "slave"), both_arms(plan), strict=True))
    arms = {placed.name: placed for placed in dual_scene(master_goal=plan.master_goal).arms}
    times = np.linspace(0, len(paths["master"]) - 1, _TIMES).round().astype(int)
    return TipPanel(
        name,
        {arm: end_effector(arms[arm], path) for arm, path in paths.items()},
        [(arms[arm], path[k]) for arm, path in paths.items() for k in times],
        {},
    )


def _motion(plan: DualPlan, radii: tuple[float, ...]) -> pd.DataFrame:
    """Joints of both arms on common samples and the smallest distance between them there."""
    scene, (master, slave) = dual_scene(radii, plan.master_goal), both_arms(plan)
    found = distances(scene, scene.stack(master=master, slave=slave))
    columns = {
        f"{name}_q{j}_deg": np.rad2deg(path[:, j - 1])
        for name, path in (("master", master), ("slave", slave))
        for j in range(1, 7)
    }
    pairs = scene.pairs.between("slave", "master")
    return pd.DataFrame(columns | {"arm_to_arm_m": found[:, pairs].min(axis=1)})


def _distance(plan: DualPlan, other: str, radii: tuple[float, ...]) -> np.ndarray:
    scene = dual_scene(radii, plan.master_goal)
    master, slave = both_arms(plan)
    q, _ = densify(scene.stack(master=master, slave=slave), 0.02)
    found = distances(scene, q)
    names = ("master",) if other == "master" else tuple(spheres())
    mask = np.any([scene.pairs.between("slave", name) for name in names], axis=0)
    return found[:, mask].min(axis=1)


def _scene(plan: DualPlan, assumed: Assumed) -> Scene3D:
    """Both arms played by the time map, with the hull of the master at its middle pose."""
    master, slave = both_arms(plan)
    arms = {placed.name: placed for placed in dual_scene(master_goal=plan.master_goal).arms}
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
