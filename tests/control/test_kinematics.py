"""Compiled kinematics of a system against Pinocchio, and distances left out where none matter."""

import numpy as np
import pinocchio as pin
import pytest

from dualarm_repro.control.kinematics import (
    core_distances,
    joint_frames,
    near_distances,
    point_velocity,
    relative_velocity,
    tip_jacobian,
)
from dualarm_repro.differences import central_differences


def frames_at(arrays, q):
    frames, tips = np.empty((len(q) + len(arrays.base), 3, 4)), np.empty((len(arrays.base), 3))
    joint_frames(arrays, np.ascontiguousarray(q), frames, tips)
    return frames, tips


def distances_at(arrays, frames):
    distance, witness = np.empty(len(arrays.pairs)), np.empty((len(arrays.pairs), 3, 3))
    core_distances(arrays, frames, distance, witness)
    return distance, witness


def half_lengths(arrays):
    return 0.5 * np.linalg.norm(arrays.local[:, 1] - arrays.local[:, 0], axis=1)


def near(arrays, frames, noise, thickness, outer):
    pairs = len(arrays.pairs)
    cores, distance, witness = (
        np.empty((len(arrays.radius), 2, 3)),
        np.empty(pairs),
        np.empty((pairs, 3, 3)),
    )
    given = cores, half_lengths(arrays), noise, thickness, outer, distance, witness
    return near_distances(arrays, frames, *given), distance, witness, cores


@pytest.mark.parametrize("seed", range(3))
def test_frames_have_the_origins_and_axes_of_the_joints(system, seed):
    arrays = system.arrays
    q = np.random.default_rng(seed).uniform(arrays.lower, arrays.upper).clip(-3, 3)
    frames, tips = frames_at(arrays, q)
    for k, placed in enumerate(system.arms):
        model = placed.arm.model
        data = model.createData()
        pin.framesForwardKinematics(model, data, q[7 * k : 7 * k + 7])
        np.testing.assert_allclose(frames[8 * k], placed.placement.homogeneous[:3], atol=1e-12)
        flange = placed.placement * data.oMf[placed.arm.flange_id]
        np.testing.assert_allclose(tips[k], flange.translation, atol=1e-12)
        for joint in range(7):
            pose = placed.placement * data.oMi[joint + 1]
            F = frames[8 * k + joint + 1]
            # The origin may lie elsewhere on the axis.
            apart = np.cross(F[:, 3] - pose.translation, F[:, 2])
            np.testing.assert_allclose(apart, 0.0, atol=1e-12)
            assert abs(F[:, 2] @ pose.rotation[:, 2]) == pytest.approx(1.0)


def test_the_jacobian_of_the_tips_is_their_derivative(system, q):
    arrays = system.arrays
    frames, tips = frames_at(arrays, q)
    J = np.empty((6, 14))
    tip_jacobian(arrays, frames, tips, J)
    slopes = central_differences(lambda at: frames_at(arrays, at)[1].ravel(), q).T
    np.testing.assert_allclose(J, slopes, atol=1e-8)
    assert (J[:3, 7:] == 0.0).all()
    assert (J[3:, :7] == 0.0).all()
    v = point_velocity(frames, 1, 9, tuple(tips[1]))
    np.testing.assert_allclose(v, J[3:, 9], atol=1e-15)


def test_a_point_of_a_link_moves_as_its_columns_say(system, q):
    """And only the joints before the link count, with the sign that is asked for."""
    arrays = system.arrays
    body = int(np.flatnonzero((arrays.last - arrays.first == 4) & (arrays.first == 7))[0])
    local = arrays.local[body, 1]

    def point(at):
        F = frames_at(arrays, at)[0][arrays.frame[body]]
        return F[:, :3] @ local + F[:, 3]

    columns = np.ones((3, 14))
    relative_velocity(arrays, frames_at(arrays, q)[0], body, point(q), -2.0, columns)
    slopes = central_differences(point, q).T
    np.testing.assert_allclose(columns, 1.0 - 2.0 * slopes, atol=1e-8)
    assert (columns[:, 11:] == 1.0).all()
    assert (columns[:, :7] == 1.0).all()


def test_nearest_points_lie_on_the_cores_and_the_normal_leads_from_one_to_the_other(system, q):
    arrays = system.arrays
    frames, _ = frames_at(arrays, q)
    distance, witness = distances_at(arrays, frames)
    _, _, _, cores = near(arrays, frames, np.empty(0), 1.0, np.inf)
    for k, (a, b, normal) in enumerate(witness):
        np.testing.assert_allclose(a + distance[k] * normal, b, atol=1e-12)
        for point, body in zip((a, b), arrays.pairs[k], strict=True):
            start, end = cores[body]
            along = np.linalg.norm(point - start) + np.linalg.norm(end - point)
            assert along == pytest.approx(np.linalg.norm(end - start), abs=1e-9)
        # No other points of the two cores are nearer.
        shares = np.linspace(0.0, 1.0, 21)[:, None]
        first, second = (
            cores[i, 0] + shares * (cores[i, 1] - cores[i, 0]) for i in arrays.pairs[k]
        )
        apart = np.linalg.norm(first[:, None] - second[None], axis=-1)
        assert apart.min() >= distance[k] - 1e-12


@pytest.mark.parametrize("thickness", [0.0, 1.0])
@pytest.mark.parametrize("outer", [-np.inf, 0.1, 0.3])
def test_where_distances_matter_they_are_exact_and_elsewhere_bounds(system, thickness, outer):
    arrays, rng = system.arrays, np.random.default_rng(11)
    left_out = 0
    for noise in (np.empty(0), rng.normal(scale=0.02, size=len(arrays.pairs))):
        q = rng.uniform(0.5 * arrays.lower, 0.5 * arrays.upper)
        frames, _ = frames_at(arrays, q)
        exact, normals = distances_at(arrays, frames)
        smallest, found, witness, _ = near(arrays, frames, noise, thickness, outer)
        radii = arrays.radius[arrays.pairs].sum(axis=1)
        assert smallest == pytest.approx((exact - radii).min(), abs=1e-12)
        assert (found <= exact + 1e-9).all()
        read = exact - thickness * radii + (noise if len(noise) else 0.0)
        matters = read < outer
        np.testing.assert_allclose(found[matters], exact[matters], atol=1e-12)
        np.testing.assert_allclose(witness[matters], normals[matters], atol=1e-12)
        left_out += int((found < exact - 1e-9).sum())
    assert left_out > 0
