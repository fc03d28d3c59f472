"""What must not depend on where the world's axes lie, on the order of arms, or on bounds added."""

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualarm_repro.control.controller import VelocityController
from dualarm_repro.control.problem import QuadraticProgram
from dualarm_repro.control.settings import ControllerSettings
from dualarm_repro.control.solvers import solve
from dualarm_repro.control.system import ArmSystem
from dualarm_repro.scene.bodies import PlacedArm

from .conftest import random_problem

VELOCITY = np.array([[0.05, -0.02, 0.03], [-0.04, 0.06, 0.01]])


@pytest.fixture(scope="module")
def near(system, q):
    """Ranges within which the nearest pair is, so that its row presses the arms apart."""
    d = VelocityController(system)
    d.problem(q, system.tips(q), VELOCITY)
    ranges = {"outer": d.distance + 0.4, "inner": d.distance + 0.05}
    return ControllerSettings(**ranges, repetition=0.3, damper_gain=2.0)


def moved(system, pose):
    """The same arms on bases that were moved together."""
    return ArmSystem([PlacedArm(a.name, a.arm, pose * a.placement) for a in system.arms])


@pytest.mark.parametrize("seed", range(4))
def test_a_rigid_move_of_everything_leaves_the_joint_velocity(system, near, q, seed):
    rng = np.random.default_rng(seed)
    pose = pin.SE3(pin.exp3(rng.normal(size=3)), rng.normal(size=3))
    elsewhere, R = moved(system, pose), pose.rotation
    target = system.tips(q) + 0.01 * rng.normal(size=(2, 3))
    here, there = (VelocityController(s, near, home=0.9 * q) for s in (system, elsewhere))
    plain = here.solution(q, target, VELOCITY)
    found = there.solution(q, target @ R.T + pose.translation, VELOCITY @ R.T)
    assert plain.z.max() > 1e-3
    np.testing.assert_allclose(found.x, plain.x, atol=1e-9)
    np.testing.assert_allclose(found.z, plain.z, atol=1e-8)
    np.testing.assert_allclose(found.problem.G, plain.problem.G, atol=1e-11)
    # Forces on the tips turn with the world.
    np.testing.assert_allclose(found.y.reshape(2, 3), plain.y.reshape(2, 3) @ R.T, atol=1e-8)
    np.testing.assert_allclose(there.tips, here.tips @ R.T + pose.translation, atol=1e-12)
    assert there.distance == pytest.approx(here.distance, abs=1e-12)


def test_the_order_of_the_arms_only_changes_the_order_of_the_joints(system, near, q):
    turned = ArmSystem(list(reversed(system.arms)))
    swap = np.concatenate([q[7:], q[:7]])
    here, there = VelocityController(system, near), VelocityController(turned, near)
    plain = here.solution(q, system.tips(q), VELOCITY)
    found = there.solution(swap, system.tips(q)[::-1], VELOCITY[::-1])
    assert plain.z.max() > 1e-3
    np.testing.assert_allclose(found.x, np.concatenate([plain.x[7:], plain.x[:7]]), atol=1e-9)
    assert there.distance == pytest.approx(here.distance, abs=1e-12)
    assert sorted(found.problem.h) == pytest.approx(sorted(plain.problem.h), abs=1e-12)


def objective(p, x):
    return 0.5 * float(((x - p.target) ** 2).sum())


@settings(max_examples=30)
@given(seed=st.integers(0, 10**6), by=st.floats(1e-3, 1.0))
def test_wider_bounds_and_rows_never_make_the_optimum_worse(seed, by):
    p = random_problem(np.random.default_rng(seed), 4, 8)
    wider = QuadraticProgram(p.target, p.A, p.b, p.G, p.h, p.lower - by, p.upper + by)
    looser = QuadraticProgram(p.target, p.A, p.b, p.G, p.h + by, p.lower, p.upper)
    free = QuadraticProgram(p.target, p.A, p.b, p.G[:4], p.h[:4], p.lower, p.upper)
    best = objective(p, solve(p).x)
    for relaxed in (wider, looser, free):
        assert objective(relaxed, solve(relaxed).x) <= best + 1e-9


@settings(max_examples=20)
@given(seed=st.integers(0, 10**6))
def test_a_multiplier_is_what_a_looser_row_gains(seed):
    """d f* / d h = -z, by central differences where the active set stays."""
    p = random_problem(np.random.default_rng(seed), 3, 6)
    found, step = solve(p), 1e-5
    k = int(found.z.argmax())
    if found.z[k] < 1e-2:
        return
    ends = []
    for sign in (1, -1):
        h = p.h.copy()
        h[k] += sign * step
        changed = QuadraticProgram(p.target, p.A, p.b, p.G, h, p.lower, p.upper)
        ends.append(objective(changed, solve(changed).x))
    # The second derivative jumps where another constraint comes or goes within the step.
    assert (ends[0] - ends[1]) / (2 * step) == pytest.approx(-found.z[k], rel=0.02, abs=1e-4)


@settings(max_examples=20)
@given(seed=st.integers(0, 10**6), scale=st.floats(0.1, 10.0))
def test_the_minimiser_scales_turns_and_moves_with_its_problem(seed, scale):
    rng = np.random.default_rng(seed)
    p = random_problem(rng, 4, 6)
    x = solve(p).x
    sides = (p.b, p.h, p.lower, p.upper)
    b, h, lower, upper = (scale * side for side in sides)
    larger = QuadraticProgram(scale * p.target, p.A, b, p.G, h, lower, upper)
    np.testing.assert_allclose(solve(larger).x, scale * x, atol=1e-8)
    weights = rng.uniform(0.2, 5.0, len(p.h))
    rows = QuadraticProgram(
        p.target, p.A, p.b, weights[:, None] * p.G, weights * p.h, p.lower, p.upper
    )
    np.testing.assert_allclose(solve(rows).x, x, atol=1e-8)
    away = rng.normal(size=p.size)
    shifted = QuadraticProgram(
        *(p.target + away, p.A, p.b + p.A @ away, p.G, p.h + p.G @ away),
        *(p.lower + away, p.upper + away),
    )
    np.testing.assert_allclose(solve(shifted).x, x + away, atol=1e-8)
    order = rng.permutation(p.size)
    renamed = QuadraticProgram(
        *(p.target[order], p.A[:, order], p.b, p.G[:, order], p.h),
        *(p.lower[order], p.upper[order]),
    )
    np.testing.assert_allclose(solve(renamed).x, x[order], atol=1e-8)
