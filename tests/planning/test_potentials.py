"""Potentials: formulas by hand, every gradient by central differences, behaviour in contact."""

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given
from hypothesis import strategies as st
from window_scene import GOAL, MASTER, SLAVE, START

from dualarm_repro.errors import ConfigurationError, InputError
from dualarm_repro.planning import (
    Combination,
    JointAttraction,
    PointRepulsion,
    PositionAttraction,
    Sum,
    control_points,
    obstacles_of,
)
from dualarm_repro.scene import (
    Box,
    Capsule,
    HalfSpace,
    MovingShape,
    PlacedArm,
    PosePath,
    Scene,
    Sphere,
    facing,
    window_frame,
)

joints = st.lists(st.floats(-1.5, 1.5), min_size=6, max_size=6).map(np.array)
BASE = MASTER.placement.translation


def everything():
    """Every sort of shape near the master, one of them moving."""
    path = PosePath([pin.SE3.Identity(), pin.SE3(np.eye(3), np.array([0.0, 0.0, 0.4]))], [0, 4])
    shapes = {
        "window": window_frame(
            BASE + np.array([1.6, 0.0, -0.9]), facing((1.0, 0.2, 0.0)), 0.6, 0.6, 0.1, 0.1
        ),
        "ball": Sphere(BASE + np.array([0.9, 0.5, 0.3]), 0.2),
        "bar": Capsule(BASE + np.array([0.5, -0.9, 0.4]), BASE + np.array([1.2, -0.5, 0.9]), 0.05),
        "floor": HalfSpace((0.0, 0.1, 1.0), BASE[2] - 1.6),
    }
    moving = {"crate": MovingShape(Box(BASE + np.array([1.0, -0.4, -1.2]), (0.3, 0.2, 0.4)), path)}
    return obstacles_of(Scene([MASTER], shapes, moving))


def repulsion(points="frames_2_6", combination=Combination.SUM, influence=0.8, obstacles=None):
    chosen = control_points(MASTER.arm, points)
    around = obstacles or everything()
    return PointRepulsion(MASTER, chosen, around, 1.3, influence, 1e-3, combination)


def central_differences(potential, q, step=0, h=1e-6):
    shifts = h * np.eye(len(q))
    return np.array(
        [potential.value(q + s, step) - potential.value(q - s, step) for s in shifts]
    ) / (2 * h)


def assert_gradient(potential, q, step=0, tolerance=1e-6):
    expected = central_differences(potential, q, step)
    scale = 1.0 + np.abs(expected).max()
    assert np.abs(potential.gradient(q, step) - expected).max() < tolerance * scale


@given(joints)
def test_gradients_of_the_attractions(q):
    assert_gradient(PositionAttraction(SLAVE, np.array([0.3, 0.2, 0.5]), 3.0), q)
    assert_gradient(JointAttraction(GOAL, 2.0), q)
    both = Sum([PositionAttraction(SLAVE, np.zeros(3), 3.0), JointAttraction(GOAL, 2.0)])
    assert_gradient(both, q)


@pytest.mark.parametrize(
    "points", ["end_effector", "frames_2_6", "frames_1_5", "five_links", "capsules"]
)
@pytest.mark.parametrize("combination", list(Combination))
def test_gradient_of_the_repulsion(points, combination):
    potential = repulsion(points, combination)
    rng = np.random.default_rng(3)
    outside = 0
    for q in rng.uniform(-1.2, 1.2, (60, 6)):
        distance = potential.distances(q, 2)
        if distance.min() < 0.02 or abs(np.diff(np.sort(distance, axis=1)[:, :2])).min() < 1e-3:
            continue  # next to contact u is too steep, next to a crease not differentiable
        outside += potential.value(q, 2) > 0
        assert_gradient(potential, q, 2, 1e-5)
    assert outside >= 10


def test_gradient_points_out_of_an_obstacle():
    ball = obstacles_of(
        Scene([MASTER], {"ball": Sphere(BASE + np.array([1.559, 0.1, -1.45]), 0.3)})
    )
    potential = repulsion("end_effector", obstacles=ball)
    q = np.zeros(6)
    assert potential.distances(q).item() == pytest.approx(-0.2)
    assert np.isfinite(potential.value(q))
    assert_gradient(potential, q)
    step = -1e-6 * potential.gradient(q) / np.linalg.norm(potential.gradient(q))
    assert potential.distances(q + step).item() > -0.2


def test_potential_is_smooth_at_contact_distance_and_at_influence():
    wall = obstacles_of(Scene([MASTER], {"wall": HalfSpace((1.0, 0.0, 0.0), BASE[0] + 1.0)}))
    for distance in (1e-3, 0.8):
        at = PointRepulsion(
            MASTER,
            control_points(MASTER.arm, "end_effector"),
            wall,
            1.0,
            0.8,
            1e-3,
            Combination.SUM,
        )
        values, slopes = zip(
            *((at._energy(d), at._slope(d)) for d in distance + np.array([-1e-9, 1e-9])),
            strict=True,
        )
        assert values[0] == pytest.approx(values[1], rel=1e-5, abs=1e-12)
        assert slopes[0] == pytest.approx(slopes[1], rel=1e-4, abs=1e-7)


def test_formulas_by_hand():
    q = np.zeros(6)
    X = BASE + np.array([1.559, 0.0, -1.450])
    attraction = PositionAttraction(MASTER, X + np.array([0.3, -0.4, 0.0]), 2.0)
    assert attraction.value(q) == pytest.approx(0.25)
    assert JointAttraction(np.full(6, 0.5), 2.0).value(q) == pytest.approx(1.5)
    ball = obstacles_of(Scene([MASTER], {"ball": Sphere(X + np.array([0.0, 0.0, -0.5]), 0.3)}))
    potential = repulsion("end_effector", obstacles=ball, influence=0.4)
    assert potential.value(q) == pytest.approx(1.3 / 2 * (1 / 0.2 - 1 / 0.4) ** 2)
    assert repulsion("end_effector", obstacles=ball, influence=0.19).value(q) == 0.0


def test_the_bars_of_a_window_add_up_or_only_the_nearest_counts():
    q = np.zeros(6)
    summed, nearest = (repulsion("frames_2_6", choice) for choice in Combination)
    distance = nearest.distances(q)
    window = [k for k, name in enumerate(nearest.obstacles.names) if name.startswith("window")]
    assert len(window) == 4
    energy = nearest._energy(distance)
    others = np.delete(energy, window, axis=1).sum()
    assert summed.value(q) == pytest.approx(energy.sum())
    assert nearest.value(q) == pytest.approx(others + energy[:, window].max(axis=1).sum())
    assert nearest.value(q) < summed.value(q)


def test_values_of_many_configurations_at_once():
    q = np.random.default_rng(0).uniform(-1, 1, (5, 6))
    for potential in (
        PositionAttraction(MASTER, np.ones(3), 1.0),
        JointAttraction(GOAL, 1.0),
        repulsion(),
        repulsion(combination=Combination.NEAREST),
    ):
        one_by_one = [potential.value(row) for row in q]
        assert potential.value(q) == pytest.approx(one_by_one, rel=1e-13)


def test_acting_names_the_shapes_that_repel():
    q = np.zeros(6)
    potential = repulsion("end_effector", influence=0.2)
    distance = potential.distances(q)[0]
    expected = {n for n, d in zip(potential.obstacles.names, distance, strict=True) if d < 0.2}
    assert set(potential.acting(q)) == expected != set()


@given(joints, st.integers(0, 6))
def test_a_rigid_motion_of_everything_changes_nothing(q, step):
    motion = pin.SE3(pin.rpy.rpyToMatrix(0.4, -1.1, 2.0), np.array([0.3, -2.0, 0.7]))
    ball = Sphere(BASE + np.array([1.0, 0.2, -0.5]), 0.2)
    moved = PlacedArm("moved", MASTER.arm, motion * MASTER.placement)
    values = []
    for placed, shape, target in (
        (MASTER, ball, np.ones(3)),
        (moved, ball.moved(motion), motion.act(np.ones(3))),
    ):
        around = obstacles_of(Scene([placed], {"ball": shape}))
        points = control_points(placed.arm, "five_links")
        repelled = PointRepulsion(placed, points, around, 1.0, 0.9, 1e-3, Combination.SUM)
        total = Sum([PositionAttraction(placed, target, 2.0), repelled])
        values.append([total.value(q, step), *total.gradient(q, step)])
    assert values[0] == pytest.approx(values[1], rel=1e-9, abs=1e-9)


def test_mirrored_arm_among_mirrored_obstacles_feels_the_mirrored_pull():
    mirror = np.array([1.0, -1.0, 1.0])
    centre = np.array([1.2, 0.3, -0.6])
    values = []
    for arm, sign in ((MASTER.arm, 1.0), (SLAVE.arm, -1.0)):
        placed = PlacedArm("arm", arm)
        place = centre if sign > 0 else centre * mirror
        around = obstacles_of(Scene([placed], {"ball": Sphere(place, 0.2)}))
        points = control_points(arm, "frames_2_6")
        potential = PointRepulsion(placed, points, around, 1.0, 1.0, 1e-3, Combination.SUM)
        q = sign * np.array([0.2, -0.1, 0.3, 0.1, -0.2, 0.4])
        values.append([potential.value(q), *(sign * potential.gradient(q))])
    assert values[0] == pytest.approx(values[1], rel=1e-12)


def test_unit_of_length_acts_as_a_weight_in_a_mixed_attraction():
    """In millimetres the position term is a million times heavier beside the joint term."""
    position = PositionAttraction(SLAVE, np.array([0.1, 0.2, 0.3]), 1.0)
    joint = JointAttraction(GOAL, 1.0)
    metres = position.gradient(START) + joint.gradient(START)
    millimetres = 1e6 * position.gradient(START) + joint.gradient(START)
    directions = [g / np.linalg.norm(g) for g in (metres, millimetres, position.gradient(START))]
    assert directions[0] @ directions[2] < 0.99
    assert directions[1] @ directions[2] > 1.0 - 1e-6


PARTS = [JointAttraction(GOAL, 1.0), PositionAttraction(SLAVE, np.ones(3), 1.0), repulsion()]


@pytest.mark.parametrize("potential", [*PARTS, Sum(PARTS[:2]), Sum(PARTS)])
def test_a_gradient_is_that_of_one_configuration(potential):
    for wrong in ([START], START[:, np.newaxis], 0.3):
        line = r"gradient: q \(its shape\) = .*: expected finite numbers \(n,\)"
        with pytest.raises(InputError, match=line):
            potential.gradient(np.array(wrong))


@pytest.mark.parametrize("potential", [*PARTS, Sum(PARTS)])
def test_joints_of_another_arm_are_refused_and_no_configurations_have_no_values(potential):
    for wrong in (START[:5], np.zeros((2, 7)), np.zeros((1, 2, 6))):
        with pytest.raises(ConfigurationError, match="6"):
            potential.value(wrong)
    with pytest.raises(ConfigurationError, match="6"):
        potential.gradient(START[:5])
    assert np.shape(potential.value(np.empty((0, 6)))) == (0,)


def test_distances_and_shares_of_another_number_of_joints_are_refused():
    """A kernel would read beyond the end of the row."""
    for ask in (PARTS[2].distances, PARTS[2].terms, PARTS[2].acting):
        with pytest.raises(ConfigurationError, match=r"shape of q = \(5,\): expected \(6,\)"):
            ask(START[:5])


@pytest.mark.parametrize("parts", [[np.nan], [3], "ab", 3.0, [PARTS[0], None]])
def test_a_sum_has_potentials(parts):
    with pytest.raises(InputError, match=r"Sum: parts(\[\d\])? = .*a value and a gradient"):
        Sum(parts)


@pytest.mark.parametrize("target", [np.ones(2), np.ones((1, 3)), 1.0, [np.nan] * 3])
def test_a_wanted_position_is_one_point(target):
    with pytest.raises(InputError, match=r"PositionAttraction: target .*finite numbers \(3,\)"):
        PositionAttraction(SLAVE, target, 1.0)
