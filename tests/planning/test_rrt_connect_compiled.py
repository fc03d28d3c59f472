"""RRT-Connect in compiled code: valid, seeded, and no longer than OMPL's simplified paths."""

import numpy as np
import pinocchio as pin
import pytest

from dualarm_repro.arms import load_arm
from dualarm_repro.errors import ConfigurationError
from dualarm_repro.planning.search.rrt_connect_compiled import plan_rrt_connect_compiled
from dualarm_repro.planning.search.tree_kernels import shortened
from dualarm_repro.scene import PlacedArm, Scene, Sphere, certified_minimum, distances
from dualarm_repro.scene.edge_kernels import edge_buffers
from dualarm_repro.scene.edge_model import edge_model
from dualarm_repro.scene.edges import free_edges

MARGIN = 0.005


@pytest.fixture(scope="module")
def scene():
    """Two arms face to face, 12 joints, a ball between them."""
    arm = load_arm("irb120")
    turned = pin.rpy.rpyToMatrix(0.0, 0.0, np.pi)
    arms = [
        PlacedArm("left", arm, pin.SE3(np.eye(3), np.array([-0.4, 0.0, 0.0]))),
        PlacedArm("right", arm, pin.SE3(turned, np.array([0.4, 0.0, 0.0]))),
    ]
    return Scene(arms, {"ball": Sphere([0.0, 0.1, 0.6], 0.05)}, floor=-0.05)


@pytest.fixture(scope="module")
def tasks(scene):
    """Ends that are free and whose straight line is not."""
    rng, found = np.random.default_rng(1), []
    lower, upper = scene.limits
    while len(found) < 6:
        ends = rng.uniform(0.6 * lower, 0.6 * upper, (2, scene.nq))
        apart = distances(scene, ends).min() > 0.02
        if apart and not free_edges(scene, ends[:1], ends[1:], MARGIN)[0]:
            found.append(ends)
    return found


def planned(scene, ends, seed=0, **given):
    return plan_rrt_connect_compiled(scene, *ends, np.random.default_rng(seed), MARGIN, **given)


def length(path):
    return float(np.linalg.norm(np.diff(path, axis=0), axis=1).sum())


def test_path_joins_the_ends_and_is_certified(scene, tasks):
    for ends in tasks:
        found = planned(scene, ends)
        np.testing.assert_array_equal(found.path[[0, -1]], ends)
        bracket = certified_minimum(scene, found.path, tolerance=1e-4)
        assert bracket.upper > MARGIN - 1e-9
        lower, upper = scene.limits
        assert ((found.path >= lower) & (found.path <= upper)).all()
        assert 0 < found.checks <= 20_000


def test_same_seed_same_path_and_another_seed_another(scene, tasks):
    one, again, other = (planned(scene, tasks[0], seed) for seed in (3, 3, 4))
    np.testing.assert_array_equal(one.path, again.path)
    assert one.checks == again.checks
    assert one.path.shape != other.path.shape or (one.path != other.path).any()


def test_straight_line_that_is_free_is_the_path(scene):
    ends = np.zeros((2, scene.nq))
    ends[:, [0, 6]] = [[1.2], [1.6]]
    assert free_edges(scene, ends[:1], ends[1:], MARGIN)[0]
    np.testing.assert_array_equal(planned(scene, ends).path, ends)


def test_budget_ends_the_search(scene, tasks):
    found = planned(scene, tasks[0], max_checks=40)
    assert not found.reached
    assert found.checks < 200  # an edge that has begun is finished


def test_end_in_contact_has_no_path(scene, tasks):
    hit = scene.stack(left=[0.0, 1.6, 0.6, 0, 0, 0], right=[0.0, 1.6, 0.6, 0, 0, 0])
    assert distances(scene, hit).min() < 0.0
    assert not planned(scene, (tasks[0][0], hit)).reached


def test_joint_whose_limits_coincide_stands(scene):
    """The right arm stays where it is while the left one moves."""
    ends = np.zeros((2, scene.nq))
    ends[:, 0], ends[0, 6:] = (1.5, -1.5), 0.1
    ends[1, 6:] = ends[0, 6:]
    ends[:, 1], ends[:, 2] = 0.9, -0.4
    lower, upper = (limit.copy() for limit in scene.limits)
    lower[6:] = upper[6:] = ends[0, 6:]
    found = planned(scene, ends, limits=(lower, upper))
    assert found.reached
    assert (found.path[:, 6:] == ends[0, 6:]).all()


def test_shortcuts_never_lengthen(scene, tasks):
    """A detour over a third configuration becomes shorter, and stays free."""
    model, rng = edge_model(scene), np.random.default_rng(5)
    plain = planned(scene, tasks[1]).path
    detour = np.vstack([plain[:-1], plain[-2:][::-1], plain[-2:]])
    counted = np.zeros(4, dtype=np.int64)
    places = rng.random((100, 2))
    buffers = edge_buffers(model)
    short = shortened(model, detour, places, MARGIN, 10**6, 50, counted, buffers)
    assert length(short) <= length(plain) + 1e-9
    assert length(short) < length(detour)
    assert certified_minimum(scene, short, tolerance=1e-4).upper > MARGIN - 1e-9


def test_against_ompl(scene, tasks):
    """Of the same tasks OMPL solves none that we do not, and our paths are not longer together."""
    pytest.importorskip("ompl")
    from dualarm_repro.baselines.sampling import rrt_connect_simplified
    from dualarm_repro.planning.planner import PathProblem, PlannerSettings

    ours, theirs = [], []
    for k, ends in enumerate(tasks[:4]):
        settings = PlannerSettings(seed=k, evaluations=20_000, margin=MARGIN)
        found = rrt_connect_simplified(PathProblem(scene, *ends, settings))
        mine = planned(scene, ends, k)
        assert mine.reached or not found.claimed
        if found.claimed and mine.reached:
            ours.append(length(mine.path))
            theirs.append(length(found.path))
    assert len(ours) >= 3
    assert sum(ours) <= 1.05 * sum(theirs)


def test_wrong_ends_are_named(scene):
    with pytest.raises(ConfigurationError):
        planned(scene, (np.zeros(3), np.zeros(scene.nq)))
