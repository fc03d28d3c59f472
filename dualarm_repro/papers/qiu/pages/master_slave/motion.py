"""Figures 15-17 of `qiu`: the slave's path and both arms together."""

from __future__ import annotations

from functools import partial

import numpy as np
import pandas as pd

from .....ledger import REGISTRY, Assumed, Bounded, NoOriginal, Result
from .....ledger.captions import captions
from .....ledger.printed_values import printed_numbers
from .....planning.checks.contact_check import SAMPLING
from .....planning.field.control_points import end_effector
from .....planning.search.dual_search import DualSearch
from .....scene import Scene, densify, distances
from .....view.arm_scenes import pair_panel, played_pair
from .....view.tip_paths import tip_path_figure
from ... import ends
from ...calibrated import dual_readings
from ...document import ARMS, FACE_VALUE, PRINTED, spheres
from ...reading import Links, Slave
from ...studies.free_pairs import FREE, MARGIN, free_reading

checks = partial(REGISTRY.checks, page="qiu/master_slave")
caption = captions(__file__)
FREE_OF_CONTACT = "free of contact"
_PLAYED = "Both arms on paths without contact; translucent: hull of the master at its middle pose."


@checks("qiu.fig15", rules=ends.JOINT_RULES)
def slave_joints(assumed: Assumed) -> Result:
    """Joint angles of the slave while the hull of the master moves."""
    plans = dual_readings(Slave.of(assumed))
    face, other = plans.values()
    return ends.joints_of(
        {name: plan.slave_path for name, plan in plans.items()},
        [face.slave, other.slave],
        caption("fig15", samples=[len(face.slave_path), len(other.slave_path)]),
        "Six panels of joint angles of the slave over the samples of its path, for two readings.",
        joined=face.slave.reached,
        calibrated_joined=other.slave.reached,
    )


@checks(
    "qiu.fig16",
    rules=[
        Bounded("end_error", "distance of the ends to start and goal [m]", high="held"),
        ends.TIP_STEP,
        ends.NO_CURVES,
    ],
)
def slave_coordinates(assumed: Assumed) -> Result:
    """Coordinates of the slave's flange while the hull of the master moves."""
    plans, halves = dual_readings(Slave.of(assumed)), PRINTED.slave_meeting
    tips = {n: end_effector(p.slave.placed, p.slave_path) for n, p in plans.items()}
    shifts = tips[FACE_VALUE][[0, -1]] - plans[FACE_VALUE].slave.tcp[[0, -1]]
    return ends.coordinates_of(
        tips,
        {"end_error": float(np.linalg.norm(shifts, axis=1).max())},
        halves,
        {
            "printed start": printed_numbers("qiu.claim_slave_task", "start"),
            "printed goal": PRINTED.slave_goal,
        },
        caption("fig16", height=halves[0, 2]),
        "Three panels with x, y and z of the slave's flange over its path for two readings.",
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
    chosen = free_reading()
    plans, scene = dual_readings(reading), reading.scene(radii)
    face, free = plans[FACE_VALUE], chosen.dual_plan()
    plans[FREE_OF_CONTACT] = free
    keeps = free.contact(chosen.scene()).smallest
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
            "yield": _yield(),
        },
        caption=caption("fig17", chosen=chosen, margin=MARGIN, keeps=keeps),
        table=pd.concat([_motion(plan, scene, name) for name, plan in plans.items()]),
        alt="Both arms among the spheres at common times, with the paths of both flanges, in two "
        "panels for two readings.",
        figure=lambda: tip_path_figure(
            [pair_panel(name, plans[name]) for name in (FACE_VALUE, FREE_OF_CONTACT)],
            list(spheres().values()),
            azim=60,
        ),
        scene=lambda: played_pair(_PLAYED, free, spheres(), (0.6, 2.0, 1.4)),
    )


def _yield() -> dict[str, int]:
    """How many readings of the stored map join both arms, and how many of those are free."""
    table = FREE.load()
    return {key: int(table[key].sum()) for key in ("joined", "free")} | {"tried": len(table)}


def _motion(plan: DualSearch, scene: Scene, name: str) -> pd.DataFrame:
    """Joints of both arms on common samples of a reading and the smallest distance between them
    there."""
    q = plan.stacked(scene)
    made = pd.DataFrame(
        np.rad2deg(np.hstack(plan.played())),
        columns=[f"{name}_{joint}" for name in ARMS for joint in ends.JOINT_COLUMNS],
    )
    made.insert(0, "reading", name)
    return made.assign(arm_to_arm_m=_distance(scene, q, "master"))


def _distance(scene: Scene, q: np.ndarray, *others: str) -> np.ndarray:
    """Smallest distance of the slave to these bodies at q (N, 12) of both arms (N,) [m]."""
    mask = np.any([scene.pairs.between("slave", name) for name in others], axis=0)
    return distances(scene, q)[:, mask].min(axis=1)
