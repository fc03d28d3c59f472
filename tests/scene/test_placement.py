import numpy as np
import pinocchio as pin

from dualarm_repro.arms import load_arm
from dualarm_repro.scene import (
    ConvexHull,
    JointPath,
    MovingArm,
    MovingShape,
    PlacedArm,
    PosePath,
    Scene,
    distances,
)
from dualarm_repro.scene.placement import place
from examples import random_box, random_capsule, random_placement


def test_moving_shapes_are_where_their_path_has_them():
    """Distances to moved shapes equal those to copies of the shapes moved by hand."""
    rng = np.random.default_rng(0)
    shapes = {
        "rod": random_capsule(rng),
        "crate": random_box(rng),
        "stone": ConvexHull(0.2 * rng.normal(size=(12, 3))),
    }
    paths = {name: PosePath([random_placement(rng) for _ in range(3)]) for name in shapes}
    movers = {name: MovingShape(shapes[name], paths[name]) for name in shapes}
    arm = load_arm("irb120")
    scene = Scene([PlacedArm("arm", arm)], moving=movers, self_collision=False)
    q = rng.uniform(-1, 1, (12, 6))
    time = np.linspace(-0.3, 2.4, 12)
    found = distances(scene, q, time)
    for name in shapes:
        poses = paths[name].at(time)
        columns = scene.pairs.between("arm", name)
        standing = [shapes[name].moved(pin.SE3(pose[:, :3], pose[:, 3])) for pose in poses]
        for row, configuration, shape in zip(found, q, standing, strict=True):
            there = Scene([PlacedArm("arm", arm)], {name: shape}, self_collision=False)
            mask = there.pairs.between("arm", name)
            expected = distances(there, configuration)[mask]
            # the base never moves, so that it is watched only against what does
            np.testing.assert_allclose(row[columns][1:], expected, atol=1e-9)


def test_everything_has_its_place():
    rng = np.random.default_rng(1)
    arm, base, other = load_arm("er16"), random_placement(rng), random_placement(rng)
    path = rng.uniform(-1, 1, (2, 6))
    box = random_box(rng)
    scene = Scene(
        [PlacedArm("left", arm, base)],
        {"box": box},
        {"right": MovingArm(arm, JointPath(path), other)},
    )
    q = rng.uniform(-1, 1, (3, 6))
    placed = place(scene, q, np.array([0, 0.5, 1]))
    count = len(scene.bodies.rows("left", "capsule"))
    assert placed.cores.shape == (3, 2 * count, 2, 3)
    np.testing.assert_array_equal(placed.boxes, [[box.pose]] * 3)
    alone = place(Scene([PlacedArm("right", arm, other)]), path.mean(axis=0)[None], np.zeros(1))
    np.testing.assert_allclose(placed.cores[1, count:], alone.cores[0], atol=1e-12)


def test_moving_the_whole_world_changes_no_distance():
    rng = np.random.default_rng(2)
    arm = load_arm("irb120")
    base, box, motion = random_placement(rng, 0.2), random_box(rng), random_placement(rng)
    here = Scene([PlacedArm("arm", arm, base)], {"box": box})
    there = Scene([PlacedArm("arm", arm, motion * base)], {"box": box.moved(motion)})
    q = rng.uniform(-1, 1, (30, 6))
    np.testing.assert_allclose(distances(there, q), distances(here, q), atol=1e-12)
