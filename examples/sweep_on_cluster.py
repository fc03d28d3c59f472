"""Sweep a setting on a Dask cluster: here one worker of this machine, elsewhere its address."""

import numpy as np
import pinocchio as pin
from dask.distributed import Client, LocalCluster

from dualarm_repro.arms import load_arm
from dualarm_repro.ledger import Share
from dualarm_repro.scene import PlacedArm, Scene, distances

SAMPLES = 20_000


def touching(apart, seed):
    """How many of so many random postures of two arms, their bases so far apart [m], collide."""
    arm = load_arm("irb120")
    facing = pin.SE3(pin.rpy.rpyToMatrix(0.0, 0.0, np.pi), np.array([apart, 0.0, 0.0]))
    scene = Scene([PlacedArm("left", arm), PlacedArm("right", arm, facing)], self_collision=False)
    rng = np.random.default_rng(seed)
    q = np.hstack([arm.random_configurations(SAMPLES, rng) for _ in scene.arms])
    return int((distances(scene, q).min(axis=1) < 0.0).sum())


if __name__ == "__main__":  # which a worker that imports this file must not run
    sweep = [0.4, 0.6, 0.8, 1.0]
    with LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=None) as cluster:
        with Client(cluster) as client:  # or Client("tcp://host:8786")
            counts = client.gather(client.map(touching, sweep, range(len(sweep))))
    for apart, count in zip(sweep, counts, strict=True):
        share, low, high = Share.of(count, SAMPLES)
        print(f"bases {apart} m apart: {share:.1%} collide ({low:.1%} to {high:.1%})")
