"""Figures 15-17 of `qiu`: the slave's path and both arms together."""

from __future__ import annotations

from functools import partial

import numpy as np
import pandas as pd

from .....ledger import REGISTRY, Assumed, Bounded, NoOriginal, Result
from .....planning.checks.contact_check import SAMPLING
from .....planning.field.control_points import end_effector
from .....planning.search.dual_search import DualSearch
from .....scene import Scene, densify, distances
from .....view.arm_scenes import pair_panel, played_pair
from .....view.search_curves import coordinate_figure, joint_figure
from .....view.tip_paths import tip_path_figure
from ...document import ARMS, FACE_VALUE, PRINTED, spheres
from ...reading import Links, Slave

checks = partial(REGISTRY.checks, page="qiu/master_slave")
_PLAYED = (
    "Both arms on their paths (reconstruction); translucent: hull of the master at its middle pose."
)


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
    plans = Slave.of(assumed).dual_readings()
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
    plans, halves = Slave.of(assumed).dual_readings(), PRINTED.slave_meeting
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
    reading, radii = Slave.of(assumed), Links.of(assumed).radii
    plans, scene = reading.dual_readings(), reading.scene(radii)
    face, other = plans.values()
    pairs = {"arm to arm": ("master",), "slave to spheres": tuple(spheres())}
    curves = {
        f"{pair}, {name}": _distance(scene, densify(plan.stacked(scene), SAMPLING)[0], *bodies)
        for name, plan in plans.items()
        for pair, bodies in pairs.items()
    }
    return Result(
        obtained={
            "apart": max(face.master.gap, face.slave.gap) - reading.joint_tolerance,
            "smallest": {name: float(values.min()) for name, values in curves.items()},
            "floor": face.contact(scene).clearance["floor"],
        },
        caption=(
            "Smallest distance over the common motion: "
            + "; ".join(f"{name} {1e3 * values.min():.0f} mm" for name, values in curves.items())
            + ". Below zero the links overlap. A common time scale is not printed."
        ),
        table=_motion(face, scene),
        alt="Both arms among the spheres at common times, with the paths of both flanges, in two "
        "panels for two readings.",
        figure=lambda: tip_path_figure(
            [pair_panel(name, plan) for name, plan in plans.items()],
            list(spheres().values()),
            azim=60,
        ),
        scene=lambda: played_pair(_PLAYED, other, spheres(), (0.6, 2.0, 1.4)),
    )


def _motion(plan: DualSearch, scene: Scene) -> pd.DataFrame:
    """Joints of both arms on common samples and the smallest distance between them there."""
    q = plan.stacked(scene)
    columns = {
        f"{name}_q{j}_deg": np.rad2deg(path[:, j - 1])
        for name, path in zip(ARMS, plan.played(), strict=True)
        for j in range(1, 7)
    }
    return pd.DataFrame(columns | {"arm_to_arm_m": _distance(scene, q, "master")})


def _distance(scene: Scene, q: np.ndarray, *others: str) -> np.ndarray:
    """Smallest distance of the slave to these bodies at configurations (N, 12) of both arms (N,)
    [m]."""
    mask = np.any([scene.pairs.between("slave", name) for name in others], axis=0)
    return distances(scene, q)[:, mask].min(axis=1)
