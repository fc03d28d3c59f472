"""Figures 5 and 6 of `xue` and what section 3.2 says about the workspaces."""

from __future__ import annotations

from functools import partial
from time import perf_counter

import numpy as np
import pandas as pd

from ....arms import Arm
from ....arms.occupancy import Occupancy, occupancy, rotation_volumes
from ....arms.overlap import Overlap, overlap
from ....arms.reach import symmetric_bases
from ....arms.workspace import extents, sample_workspace, voxel_volume
from ....ledger import REGISTRY, Adopts, Assumed, Bounded, Is, NoOriginal, Result
from ....ledger.captions import captions
from ....tracking import memo
from ....view.clouds import cloud_figure, volume_figure
from ....view.scene3d import Scene3D
from ....view.style import MASTER, SLAVE
from ..document import SEED, arm_in_use, master_start, reach, robot, workspace_points

checks = partial(REGISTRY.checks, page="xue/workspace")
caption = captions(__file__)

CELLS = (0.05, 0.03, 0.02, 0.015)
VOXELS = (0.3, 0.2, 0.1, 0.05)
_CELL = 0.02  # of the occupancy behind the overlap
_TEST_POINTS = 100_000
_REPEATS = 5
_ROUND_OFF = 1e-9  # [m]
_SHOWN = 4000  # points of a cloud in the 3-D scene


@memo()
def cloud(arm: Arm, points: int, seed: int = SEED) -> np.ndarray:
    """Flange positions of random configurations (points, 3) [m]."""
    return sample_workspace(arm, points, np.random.default_rng(seed))


@memo()
def common_workspace(joint_ranges: str, upper_arm: float, distance: float) -> Overlap:
    """Overlap of master and mirrored slave."""
    master = arm_in_use(joint_ranges, upper_arm)
    arms = (master, _slave(master))
    first, second = zip(arms, symmetric_bases(distance), strict=True)
    maps = (_reached(arms[0]), _reached(arms[1]))
    return overlap(first, second, seed=SEED, points=_TEST_POINTS, maps=maps)


@memo()
def _reached(arm: Arm) -> Occupancy:
    return occupancy(arm, _CELL, np.random.default_rng(SEED))


@memo()
def _slave(master: Arm) -> Arm:
    return master.mirrored()


@checks(
    "xue.fig05",
    samples=32,
    rules=[
        Is("points", "number of random points", to="points"),
        Bounded(
            "beyond_reach",
            "points farther than the arm of matrices (2)-(7) reaches without joint limits",
            high=0,
        ),
        NoOriginal("extents", "the joint ranges or the extents of the cloud"),
    ],
)
def master_cloud(assumed: Assumed) -> Result:
    """Cloud of the master, its extents, and its volume two ways."""
    arm = arm_in_use(assumed["joint_ranges"], assumed["upper_arm"])
    points = cloud(arm, workspace_points())
    size, farthest = extents(points), np.linalg.norm(points, axis=1)
    body, voxels = rotation_volumes(arm, CELLS, SEED), voxel_volume(points, VOXELS)
    seconds = _time_per_cloud(arm)
    return Result(
        obtained={
            "points": len(points),
            "lower": size.lower.tolist(),
            "upper": size.upper.tolist(),
            "farthest": size.distance[1],
            "beyond_reach": int(np.count_nonzero(farthest > reach("matrices") + _ROUND_OFF)),
            "start_above_lowest": float(arm.fk(master_start())[2, 3] - size.lower[2]),
            "holds_start": _ranges_with_the_start(assumed["upper_arm"]),
            "volume_rotation_body": {f"{b.cell:g}": b.volume for b in body},
            "volume_voxels": {f"{v.cell:g}": v.volume for v in voxels},
        },
        measured={
            "time per sample [ns]": 1e9 * seconds / workspace_points(),
            "time for the cloud [ms]": 1e3 * seconds,
        },
        table=pd.DataFrame(points, columns=["x_m", "y_m", "z_m"]),
        caption=caption("fig05", body=body, voxels=voxels),
        alt="Scatter of the flange positions of one arm in three dimensions, a body of rotation "
        "about the vertical axis; beside it its half section, and volume over cell size.",
        figure=lambda: volume_figure(points, body, voxels),
    )


def _ranges_with_the_start(upper_arm: float) -> list[str]:
    """Joint ranges whose cloud reaches down to the printed start, and which allow its angles."""
    found = []
    for name in REGISTRY.declared("xue.joint_ranges", "choices").choices or ():
        arm = arm_in_use(str(name), upper_arm)
        lowest = extents(cloud(arm, workspace_points())).lower[2]
        if arm.within_limits(master_start()) and lowest <= arm.fk(master_start())[2, 3]:
            found.append(str(name))
    return found


@checks("xue.claim_mc_points", rules=[Adopts("points", "random points used", to="points")])
def monte_carlo_points(assumed: Assumed) -> Result:
    """The cloud of Fig. 5 has the printed number of points."""
    points = len(cloud(arm_in_use("bast165", robot("matrices").joints[2].a), workspace_points()))
    return Result(
        obtained={"points": points},
        caption=f"The cloud of Fig. 5 is drawn from {points} random configurations, as printed.",
    )


@checks(
    "xue.fig06",
    rules=[
        Bounded("share_low", "lower 95 % bound of the share inside the other", low="resolved"),
        Bounded("share_high", "upper 95 % bound of that share", high="not_whole"),
    ],
    samples=32,
)
def both_clouds(assumed: Assumed) -> Result:
    """Two independent clouds and the share of each inside the workspace of the other arm."""
    distance, count = assumed["base_distance"], int(assumed["cloud_points"])
    master = arm_in_use(assumed["joint_ranges"], assumed["upper_arm"])
    slave, (left, right) = _slave(master), symmetric_bases(distance)
    common, bounds = _common(assumed)
    shares = {"master": common.first_in_second, "slave": common.second_in_first}

    def clouds() -> dict[str, np.ndarray]:
        return {
            "master": cloud(master, count, SEED) + left.translation,
            "slave": cloud(slave, count, SEED + 1) + right.translation,
        }

    def scene() -> Scene3D:
        title = f"Both arms at the printed start and {_SHOWN} points of either workspace."
        made = Scene3D(title, camera=(7.5, -3.5, 3.0))
        made.add_arm("master", master, master_start(), left, MASTER)
        made.add_arm("slave", slave, -master_start(), right, SLAVE)
        for (name, points), color in zip(clouds().items(), (MASTER, SLAVE), strict=True):
            made.add_points(f"{name} cloud", points[:_SHOWN], color)
        return made

    return Result(
        obtained={
            "points_per_arm": count,
            "master_in_slave": common.first_in_second.value,
            "slave_in_master": common.second_in_first.value,
            **bounds,
        },
        table=pd.DataFrame(
            [
                {"cloud": name, "share": s.value, "low": s.low, "high": s.high}
                for name, s in shares.items()
            ]
        ),
        caption=caption("fig06", distance=distance, master=common.first_in_second),
        alt="Point clouds of two arms from above and from the front, overlapping in the middle.",
        figure=lambda: cloud_figure(clouds(), (MASTER, SLAVE)),
        scene=scene,
    )


@checks(
    "xue.claim_overlap",
    rules=[
        Bounded("share_low", "lower 95 % bound of the smaller share", low="resolved"),
        Bounded("share_high", "no workspace lies wholly inside the other", high="not_whole"),
    ],
    samples=64,
)
def partial_overlap(assumed: Assumed) -> Result:
    """Volume common to both workspaces with its interval."""
    common, bounds = _common(assumed)
    volume = {"volume": common.volume.value}
    volume |= {"volume_low": common.volume.low, "volume_high": common.volume.high}
    return Result(
        obtained={**volume, **bounds},
        caption=caption("claim_overlap", distance=assumed["base_distance"]),
    )


def _common(assumed: Assumed) -> tuple[Overlap, dict[str, float]]:
    """What both arms reach, and the outer bounds of the shares of either cloud."""
    names = ("joint_ranges", "upper_arm", "base_distance")
    common = common_workspace(*(assumed[name] for name in names))
    shares = (common.first_in_second, common.second_in_first)
    low, high = min(share.low for share in shares), max(share.high for share in shares)
    return common, {"share_low": low, "share_high": high}


def _time_per_cloud(arm: Arm) -> float:
    """Median time of one cloud on one core [s]."""
    times = []
    for seed in range(_REPEATS + 1):
        start = perf_counter()
        sample_workspace(arm, workspace_points(), np.random.default_rng(seed))
        times.append(perf_counter() - start)
    return float(np.median(times[1:]))
