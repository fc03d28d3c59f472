"""Figures 15-17 of `qiu`: the slave's path and both arms together."""

from __future__ import annotations

from functools import partial

import numpy as np
import pandas as pd

from .....ledger import REGISTRY, Assumed, Bounded, NoOriginal, Result
from .....planning.field.control_points import end_effector
from .....planning.field.hull_obstacle import circles_on
from .....scene import ConvexHull, densify, distances
from .....view.scene3d import Scene3D
from .....view.search_curves import coordinate_figure, joint_figure
from .....view.style import GREEN, MASTER, SLAVE
from .....view.tip_paths import TipPanel, tip_path_figure
from ...document import ARMS, FACE_VALUE, PRINTED, dual_scene, spheres
from ...drawings import with_spheres
from ...reading import Links
from ...two_arms import DualPlan, both_arms, dual_readings, executed

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
    face, other = plans.values()
    return Result(
        obtained={
            "largest_step": float(np.abs(np.diff(face.slave_path, axis=0)).max()),
            "joined": face.slave.reached,
            "reconstruction_joined": other.slave.reached,
            "range_deg": np.rad2deg(np.ptp(face.slave_path, axis=0)).tolist(),
        },
        table=pd.DataFrame(np.rad2deg(face.slave_path), columns=[f"q{j}_deg" for j in range(1, 7)]),
        caption=(
            f"Joint angles of the slave over its smoothed path, {len(face.slave_path)} samples at "
            f"face value and {len(other.slave_path)} in the reconstruction; junctions dotted. The "
            "printed curves are lost."
        ),
        alt="Six panels of joint angles of the slave over the samples of "
        "its path, for two readings.",
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
    plans, halves = dual_readings(assumed), PRINTED.slave_meeting
    tips = {n: end_effector(p.slave.problem.placed, p.slave_path) for n, p in plans.items()}
    face, tip = plans[FACE_VALUE].slave, tips[FACE_VALUE]
    error = max(float(np.linalg.norm(tip[k] - face.tcp[k])) for k in (0, -1))
    return Result(
        obtained={
            "end_error": error,
            "largest_step": float(np.linalg.norm(np.diff(tip, axis=0), axis=1).max()),
            "lowest": {name: float(rows[:, 2].min()) for name, rows in tips.items()},
        },
        table=pd.DataFrame(tip, columns=["x_m", "y_m", "z_m"]),
        caption=(
            f"Coordinates of the slave's flange; its lowest point is at z = {tip[:, 2].min():.3f} "
            f"m at face value, while the printed halves meet at z = {halves[0, 2]:.3f} m (dashed, "
            "dotted). The printed curves are lost."
        ),
        alt="Three panels with x, y and z of the slave's flange over its path for two readings.",
        figure=lambda: coordinate_figure(
            tips,
            {"printed, forward": halves[0], "printed, backward": halves[1]},
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
    radii, plans = Links.of(assumed).radii, dual_readings(assumed)
    face, other = plans.values()
    curves = {
        f"{'arm to arm' if pair == 'master' else 'slave to spheres'}, {name}": _distance(
            plan, pair, radii
        )
        for name, plan in plans.items()
        for pair in ("master", "spheres")
    }
    return Result(
        obtained={
            "apart": max(face.master.gap, face.slave.gap) - face.reading.joint_tolerance,
            "smallest": {name: float(values.min()) for name, values in curves.items()},
            "floor": executed(face, radii=radii).clearance["floor"],
        },
        caption=(
            "Smallest distance over the common motion: "
            + "; ".join(f"{name} {1e3 * values.min():.0f} mm" for name, values in curves.items())
            + ". Below zero the links overlap. A common time scale is not printed."
        ),
        table=_motion(face, radii),
        alt="Both arms among the spheres at common times, with the paths of both flanges, in two "
        "panels for two readings.",
        figure=lambda: tip_path_figure(
            [_panel(name, plan) for name, plan in plans.items()], list(spheres().values()), azim=60
        ),
        scene=lambda: _scene(other),
    )


def _panel(name: str, plan: DualPlan) -> TipPanel:
    """Both arms at common times, and the paths of their flanges."""
    paths = dict(zip(ARMS, both_arms(plan), strict=True))
    arms = {placed.name: placed for placed in dual_scene(plan.reading.master_goal).arms}
    times = np.linspace(0, len(paths["master"]) - 1, _TIMES).round().astype(int)
    return TipPanel(
        name,
        {arm: end_effector(arms[arm], path) for arm, path in paths.items()},
        [(arms[arm], path[k]) for arm, path in paths.items() for k in times],
        {},
    )


def _motion(plan: DualPlan, radii: tuple[float, ...]) -> pd.DataFrame:
    """Joints of both arms on common samples and the smallest distance between them there."""
    scene, (master, slave) = dual_scene(plan.reading.master_goal, radii), both_arms(plan)
    found = distances(scene, scene.stack(master=master, slave=slave))
    columns = {
        f"{name}_q{j}_deg": np.rad2deg(path[:, j - 1])
        for name, path in (("master", master), ("slave", slave))
        for j in range(1, 7)
    }
    pairs = scene.pairs.between("slave", "master")
    return pd.DataFrame(columns | {"arm_to_arm_m": found[:, pairs].min(axis=1)})


def _distance(plan: DualPlan, other: str, radii: tuple[float, ...]) -> np.ndarray:
    scene, (master, slave) = dual_scene(plan.reading.master_goal, radii), both_arms(plan)
    q, _ = densify(scene.stack(master=master, slave=slave), 0.02)
    found = distances(scene, q)
    names = ("master",) if other == "master" else tuple(spheres())
    mask = np.any([scene.pairs.between("slave", name) for name in names], axis=0)
    return found[:, mask].min(axis=1)


def _scene(plan: DualPlan) -> Scene3D:
    """Both arms played by the time map, with the hull of the master at its middle pose."""
    master, slave = both_arms(plan)
    arms = {placed.name: placed for placed in dual_scene(plan.reading.master_goal).arms}
    made = with_spheres(
        "Both arms on their paths (reconstruction); translucent: hull of the "
        "master at its middle pose.",
        camera=(0.6, 2.0, 1.4),
    )
    for (name, placed), path, color in zip(
        arms.items(), (master, slave), (MASTER, SLAVE), strict=True
    ):
        made.add_arm(name, placed.arm, path[0], placed.placement, color)
        made.add_path(f"{name} flange", end_effector(placed, path), color)
    middle = plan.master_path[len(plan.master_path) // 2]
    hull = ConvexHull(circles_on(arms["master"], plan.reading.circles(), middle[np.newaxis])[0])
    made.add_mesh("hull", hull.vertices, hull.faces, GREEN, 0.25)
    made.animate({"master": (arms["master"].arm, master), "slave": (arms["slave"].arm, slave)})
    return made
