"""Poses of a job by forward kinematics, and velocities by differences and by Fourier transform."""

from dataclasses import replace

import numpy as np
import pytest

from dualarm_repro.arms import load_arm
from dualarm_repro.welding import (
    WELDER,
    Objective,
    Placement,
    flange_poses,
    held_poses,
    joint_margin,
    torch_tips,
)
from dualarm_repro.welding.motion import flange_twist, periodic_derivative, smallest_rank, stretch

from .cells import make_cell

CENTRE = np.array([0.0, 0.1, 0.8])


@pytest.fixture(scope="module")
def job():
    cell = make_cell(count=12, crank=0.5)
    jobs = Placement(cell, Objective()).jobs([CENTRE])
    assert np.isfinite(jobs.q).all()
    return cell, jobs


def test_a_straight_arm_is_stretched_to_one(job):
    cell, jobs = job
    geometry = cell.geometries[0]
    assert ((stretch(cell, jobs, 0) > 0) & (stretch(cell, jobs, 0) < 1)).all()
    turned = np.zeros((1, 3, 3001, 6))
    turned[..., 2] = np.linspace(-np.pi, np.pi, 3001)
    found = stretch(cell, replace(jobs, q=turned), 0)
    assert found.max() == pytest.approx(1.0, abs=1e-5)
    shortest = abs(geometry.upper_arm[0] - geometry.forearm[0])
    longest = geometry.upper_arm[0] + geometry.forearm[0]
    # folded within the spacing of the sampled angles
    assert found.min() == pytest.approx(shortest / longest, abs=1e-2)


def test_flanges_torch_and_workpiece_are_where_the_job_has_them(job):
    cell, jobs = job
    for robot in range(3):
        wanted = cell.flanges[robot].copy()
        wanted[:, :3, 3] += CENTRE
        assert abs(flange_poses(cell, jobs, robot) - wanted).max() < 1e-9
    for robot in range(WELDER):
        assert abs(held_poses(cell, jobs, robot) - cell.piece_pose(CENTRE)).max() < 1e-9
    assert abs(torch_tips(cell, jobs) - cell.seam_in_world(CENTRE)).max() < 1e-9


def test_margin_and_rank(job):
    cell, jobs = job
    gaps = [
        min((q - arm.lower).min(), (arm.upper - q).min())
        for arm, q in zip(cell.arms, jobs.q[0], strict=True)
    ]
    assert joint_margin(cell, jobs) == min(gaps) > 0
    assert smallest_rank(cell, jobs) == 6


def test_twist_is_the_jacobian_times_the_joint_velocity():
    arm, rng = load_arm("er16"), np.random.default_rng(2)
    for q in arm.random_configurations(20, rng):
        qd = rng.normal(size=6)
        assert abs(flange_twist(arm, q, qd) - arm.jacobian(q) @ qd).max() < 1e-7


def test_derivative_of_periodic_samples():
    for count in (24, 25):
        angle = 2 * np.pi * np.arange(count) / count
        values = np.column_stack([np.sin(3 * angle), np.cos(angle) + 2])
        expected = np.column_stack([3 * np.cos(3 * angle), -np.sin(angle)])
        assert abs(periodic_derivative(values) - expected).max() < 1e-12
