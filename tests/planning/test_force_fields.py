"""Forces are the negative gradient of their potentials, and one-sided where these have kinks."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualarm_repro.differences import central_differences
from dualarm_repro.planning.field.disc_field import DiscField
from dualarm_repro.planning.field.joint_attraction import conic_force, conic_potential
from dualarm_repro.planning.field.repulsive_force import (
    inverse_distance_force,
    inverse_distance_potential,
    joint_torques,
)
from dualarm_repro.planning.settings import Threshold

GOAL = np.zeros(2)
VECTORS = st.lists(st.floats(-3.0, 3.0), min_size=2, max_size=2).map(np.array)


@pytest.mark.parametrize(
    ("q", "measure", "potential", "force"),
    [
        # Inside: zeta/2 |e|^2; outside of d = 5: d zeta |e| - zeta d^2 / 2.
        ([3.0, 4.0], Threshold.NORM, 25.0, [-6.0, -8.0]),
        ([6.0, 8.0], Threshold.NORM, 2 * (50 - 12.5), [-6.0, -8.0]),
        ([3.0, 8.0], Threshold.PER_JOINT, 9.0 + 2 * (40 - 12.5), [-6.0, -10.0]),
        ([-8.0, 0.0], Threshold.PER_JOINT, 2 * (40 - 12.5), [10.0, 0.0]),
    ],
)
def test_conic_wells_by_hand(q, measure, potential, force):
    terms = np.array(q), GOAL, 2.0, 5.0, measure
    assert conic_potential(*terms) == pytest.approx(potential)
    np.testing.assert_allclose(conic_force(*terms), force)


@pytest.mark.parametrize("measure", list(Threshold))
@settings(max_examples=40)
@given(q=VECTORS, way=VECTORS)
def test_on_the_threshold_both_one_sided_slopes_are_the_force(measure, q, way):
    """The potential is continuously differentiable there; its second derivative jumps."""
    size = np.linalg.norm(q) if measure is Threshold.NORM else np.abs(q).max()
    if size < 1e-3 or np.linalg.norm(way) < 1e-3:
        return
    edge, v, step = q / size, way / np.linalg.norm(way), 1e-6
    here = conic_potential(edge, GOAL, 3.0, 1.0, measure)
    slope = -conic_force(edge, GOAL, 3.0, 1.0, measure) @ v
    for side in (step, -step):
        found = (conic_potential(edge + side * v, GOAL, 3.0, 1.0, measure) - here) / side
        assert found == pytest.approx(slope, abs=1e-5)


@settings(max_examples=30)
@given(q=VECTORS, gain=st.floats(0.1, 10.0), scale=st.floats(0.1, 10.0))
def test_conic_wells_scale_and_are_bounded(q, gain, scale):
    for measure in Threshold:
        plain = conic_force(q, GOAL, 1.0, 0.5, measure)
        np.testing.assert_allclose(conic_force(q, GOAL, gain, 0.5, measure), gain * plain)
        larger = conic_force(scale * q, GOAL, 1.0, scale * 0.5, measure)
        np.testing.assert_allclose(larger, scale * plain, atol=1e-12)
        np.testing.assert_allclose(conic_force(-q, GOAL, 1.0, 0.5, measure), -plain)
        assert plain @ q <= 0.0


def test_repulsion_by_hand():
    # 1/rho - 1/rho_0 = 5 - 2.5 at 0.2 and 0.4 m.
    assert inverse_distance_potential(0.2, 3.0, 0.4) == pytest.approx(1.5 * 2.5**2)
    assert inverse_distance_force(0.2, 3.0, 0.4, 1e-3) == pytest.approx(3.0 * 2.5 / 0.04)
    assert inverse_distance_potential(np.array([0.4, 9.0]), 3.0, 0.4).tolist() == [0.0, 0.0]


def test_at_the_influence_the_force_begins_at_zero_with_a_slope_on_one_side():
    """F = 0 beyond, eta (rho_0 - rho) / rho_0^4 to first order inside."""
    influence, step = 0.4, 1e-6
    potential = [
        inverse_distance_potential(influence + s, 3.0, influence) for s in (-step, 0, step)
    ]
    assert (potential[1] - potential[0]) / step == pytest.approx(0.0, abs=1e-3)
    assert potential[2] == potential[1] == 0.0
    inside = inverse_distance_force(influence - step, 3.0, influence, 1e-3)
    assert inside / step == pytest.approx(3.0 / influence**4, rel=1e-4)
    assert inverse_distance_force(influence + step, 3.0, influence, 1e-3) == 0.0


@settings(max_examples=30)
@given(seed=st.integers(0, 10**6))
def test_a_torque_is_the_power_of_the_force_per_joint_speed(seed):
    """Joints about drawn axes: J^T F of a point, with the velocity z x (p - o) by a small turn."""
    rng = np.random.default_rng(seed)
    frames = np.zeros((4, 3, 4))
    for frame in frames:
        frame[:, :3] = np.linalg.qr(rng.normal(size=(3, 3)))[0]
        frame[:, 3] = rng.normal(size=3)
    points, forces = rng.normal(size=(2, 2, 3))
    joint = np.array([1, 3])
    found = joint_torques(frames, joint, points, forces)
    step = 1e-6
    for j in range(3):
        axis, origin = frames[j + 1, :, 2], frames[j + 1, :, 3]
        power = 0.0
        for number, point, force in zip(joint, points, forces, strict=True):
            if j < number:
                lever = point - origin
                turned = lever + step * np.cross(axis, lever)
                power += force @ (turned - lever) / step
        assert found[j] == pytest.approx(power, abs=1e-6)


@pytest.fixture(scope="module")
def disc():
    return DiscField(np.array([2.0, 0.0]), np.array([0.9, 0.1]), 0.3, 2.0, 0.5, 0.05, 0.4)


@settings(max_examples=40)
@given(x=st.floats(-0.5, 2.5), y=st.floats(-1.0, 1.0))
def test_the_forces_of_a_disc_balance_the_slope_of_its_potential(disc, x, y):
    point = np.array([x, y])
    rho = np.linalg.norm(point - disc.centre) - disc.radius
    if rho < 0.02 or np.linalg.norm(point - disc.goal) < 0.05:
        return  # drawn levels are cut there, and at the goal nothing pulls
    assert disc.imbalance(point) < 1e-4


@pytest.mark.parametrize("angle", [0.0, 1.0, 2.5, 4.0])
def test_at_the_range_of_a_disc_both_one_sided_slopes_are_the_force(disc, angle):
    out = np.array([np.cos(angle), np.sin(angle)])
    edge, step = disc.centre + (disc.radius + disc.influence) * out, 1e-6
    pull, push = disc.forces(edge)
    np.testing.assert_allclose(push, 0.0, atol=1e-12)
    values = disc.potential(np.array([edge - step * out, edge, edge + step * out]))
    slopes = np.diff(values) / step
    np.testing.assert_allclose(slopes, -pull @ out, atol=1e-4)


def test_a_disc_pushes_straight_away_and_only_within_its_range(disc):
    out = np.array([0.6, -0.8])
    _, near = disc.forces(disc.centre + 0.4 * out)
    assert near / np.linalg.norm(near) == pytest.approx(out)
    assert np.linalg.norm(near) == pytest.approx(0.05 * (10 - 2.5) / 0.01)
    _, far = disc.forces(disc.centre + 0.71 * out)
    assert far.tolist() == [0.0, 0.0]


@settings(max_examples=20)
@given(angle=st.floats(-3.0, 3.0), shift=VECTORS, x=st.floats(0.0, 2.0), y=st.floats(0.5, 1.0))
def test_a_field_moved_as_a_whole_has_moved_forces(disc, angle, shift, x, y):
    c, s = np.cos(angle), np.sin(angle)
    R = np.array([[c, -s], [s, c]])
    there = DiscField(
        R @ disc.goal + shift, R @ disc.centre + shift, disc.radius,
        disc.attraction, disc.threshold, disc.repulsion, disc.influence,
    )  # fmt: skip
    point = np.array([x, y])
    for here, moved in zip(disc.forces(point), there.forces(R @ point + shift), strict=True):
        np.testing.assert_allclose(moved, R @ here, atol=1e-9)
    energies = disc.potential(point[None])[0], there.potential((R @ point + shift)[None])[0]
    assert energies[1] == pytest.approx(energies[0])
    slopes = central_differences(lambda p: disc.potential(p[None])[0], point)
    assert np.isfinite(slopes).all()
