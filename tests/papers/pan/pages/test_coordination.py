"""Equations (1)-(8) of `pan`: rigid motions in plain numpy against what the page computes."""

from dataclasses import replace

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualarm_repro.ledger import Verdict, evaluate
from dualarm_repro.papers.pan.pages.cell import coordination as page
from dualarm_repro.papers.pan.reading import Job
from dualarm_repro.welding import ROBOTS, WELDER

vectors = st.lists(st.floats(-3, 3), min_size=3, max_size=3).map(np.array)


def cross(a, b):
    return np.array([
        a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0],
    ])  # fmt: skip


@settings(max_examples=40)
@given(vectors, vectors, vectors)
def test_twist_at_another_point_of_a_rigid_body(lever, v, omega):
    """v1 = v2 + omega x r with r from the second point to the first, omega the same."""
    found = page._between(lever) @ np.concatenate([v, omega])
    np.testing.assert_allclose(found[:3], v + cross(omega, lever), atol=1e-12)
    np.testing.assert_array_equal(found[3:], omega)


@settings(max_examples=20)
@given(vectors, vectors)
def test_levers_add(first, second):
    np.testing.assert_allclose(
        page._between(first) @ page._between(second), page._between(first + second), atol=1e-12
    )
    np.testing.assert_allclose(page._between(first) @ page._between(-first), np.eye(6), atol=1e-12)


def test_velocities_of_a_screw_by_hand():
    """A body turned by 90 deg about z and moved along its own x: a point far out is faster."""
    body = pin.SE3(np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]]), np.array([5.0, 6.0, 7.0]))
    twist = np.array([2.0, 0.0, 0.0, 0.0, 0.0, 3.0])  # in the body: along x, about z
    points = np.array([[0.0, 0, 0], [1.0, 0, 0], [0, 2.0, 4.0]])
    found = page._screw_velocities(body, twist, points)
    local = np.array([[2.0, 0, 0], [2.0, 3.0, 0], [2.0 - 6.0, 0, 0]])
    np.testing.assert_allclose(found, local @ body.rotation.T, atol=1e-8)


def test_homogeneous_points():
    points = np.arange(6.0).reshape(2, 3)
    np.testing.assert_array_equal(page._lifted(points), [[0, 1, 2, 1], [3, 4, 5, 1]])


def own_flange(cell, jobs, robot):
    """Flange poses by pinocchio alone (N, 4, 4)."""
    arm, poses = cell.arms[robot], []
    data = arm.model.createData()
    for q in jobs.q[0, robot]:
        pin.framesForwardKinematics(arm.model, data, q)
        poses.append(cell.bases[robot] @ data.oMf[arm.model.nframes - 1].homogeneous)
    return np.array(poses)


@pytest.fixture(scope="module")
def flanges(display):
    cell, jobs, _ = display
    return [own_flange(cell, jobs, robot) for robot in range(len(ROBOTS))]


def test_grips_are_the_drawn_vectors_of_both_closures(display, flanges, stored):
    """r = R^T (p - C) of the first seam point: a gripper and half a pipe along the pipe's axis."""
    cell, jobs, centre = display
    half = 0.5 * 0.6 + 0.15
    for robot, (name, side) in enumerate((("eq04", 1.0), ("eq05", -1.0))):
        found = page.grips(cell, jobs, robot, centre)
        by_hand = [R.T @ (p - centre) for R, p in zip(cell.rotations, flanges[robot][:, :3, 3],
                                                     strict=True)]  # fmt: skip
        np.testing.assert_allclose(found, by_hand, atol=1e-12)
        np.testing.assert_allclose(found, np.tile([side * half, 0, 0], (72, 1)), atol=1e-9)
        assert stored[name]["r"] == pytest.approx([side * half, 0, 0], abs=1e-9)
    np.testing.assert_allclose(stored["fig02"]["r"], [[half, 0, 0], [-half, 0, 0]], atol=1e-9)


def test_grip_change_is_found(display):
    cell, jobs, centre = display
    assert page.grip_change(cell, jobs, centre) < 1e-12
    # about another centre the workpiece does not turn with the grips
    assert page.grip_change(cell, jobs, centre + np.array([0.0, 0.0, 0.1])) > 1e-3
    bent = jobs.q.copy()
    bent[0, 1, 40, 1] += 0.01  # one joint of the second carrier, at one point of the seam
    assert page.grip_change(cell, replace(jobs, q=bent), centre) > 1e-3


def test_relative_pose_of_both_carriers_stays(display, flanges, stored):
    relative = [np.linalg.inv(a) @ b for a, b in zip(flanges[0], flanges[1], strict=True)]
    np.testing.assert_allclose(relative, np.tile(relative[0], (72, 1, 1)), atol=1e-9)
    moved = np.ptp(flanges[0][:, :3, 3], axis=0).max()
    assert stored["claim_tight"]["moved"] == pytest.approx(moved, abs=1e-9)
    # half the way from end to end: the flanges look at each other along the pipe
    np.testing.assert_allclose(relative[0][:3, 2], [0, 0, -1], atol=1e-9)


def test_the_other_order_of_the_product_is_far_off(display, flanges, stored):
    """T_Bc = T_Bw T_wc holds; with the pose of the base in place of its inverse it does not."""
    cell, _, centre = display
    gaps = []
    for robot in range(WELDER):
        base = cell.bases[robot]
        for R in cell.rotations:
            piece = np.eye(4)
            piece[:3, :3], piece[:3, 3] = R, centre
            right, wrong = np.linalg.inv(base) @ piece, base @ piece
            gaps.append(np.linalg.norm((wrong - right)[:3, 3]))
    assert stored["eq08"]["other"] == pytest.approx(min(gaps), abs=1e-9)
    # twice the way from the world to base 1 or 2: 2 |(1, -1, 0.05)|
    assert stored["eq08"]["other"] == pytest.approx(2 * np.sqrt(2 + 0.05**2), abs=1e-9)


def test_torch_moves_along_the_seam_faster_than_the_radius_of_the_branch(stored):
    """|dp/dtheta|^2 = b^2 + (b^2 sin cos / z)^2, least b^2 where sin cos = 0."""
    theta = np.linspace(0, 2 * np.pi, 1440, endpoint=False)
    b, a = 0.06, 0.1
    z = np.sqrt(a**2 - (b * np.sin(theta)) ** 2)
    pace = np.hypot(b, b**2 * np.sin(theta) * np.cos(theta) / z)
    assert stored["eq02"]["along"] == pytest.approx(pace.min() / b, abs=1e-9)


@pytest.mark.parametrize("changes", [{"radius_branch": 0.03}, {"radius_main": 0.2},
                                     {"flat_posture": "main_pipe_normal"}])  # fmt: skip
def test_loose_coordination_holds_for_any_seam(registry, changes):
    found = evaluate(registry, "pan.eq02", changes)
    assert found.verdict is Verdict.REPRODUCED
    assert found.result.obtained["along"] == pytest.approx(1.0, abs=1e-6)


@pytest.mark.parametrize("changes", [{"gripper_length": 0.2}, {"workpiece_length": 0.7},
                                     {"grasp": "side"}])  # fmt: skip
@pytest.mark.parametrize("name", ["eq04", "fig02"])
def test_grips_follow_what_is_assumed_of_tools(registry, stored, name, changes):
    found = evaluate(registry, f"pan.{name}", changes)
    r = np.atleast_2d(found.result.obtained["r"])
    before = np.atleast_2d(stored[name]["r"])
    assert found.verdict in (Verdict.REPRODUCED, Verdict.REGENERATED)
    if "grasp" in changes:
        assert np.abs(r - before).max() > 1e-2
    else:
        # 5 cm of gripper, or half of 10 cm of pipe
        np.testing.assert_allclose(abs(r[:, 0]) - abs(before[:, 0]), 0.05, atol=1e-9)


def test_turned_bases_change_the_frame_of_the_welder_and_no_closure(registry):
    turned = {"base_orientation": "facing_workpiece"}
    for name in ("eq07", "eq08"):
        found = evaluate(registry, f"pan.{name}", turned)
        assert found.verdict is Verdict.REPRODUCED


def test_job_of_the_display_is_that_of_the_assumptions(display, nominal):
    cell, jobs, centre = display
    assert centre.tolist() == nominal["display_position"]
    np.testing.assert_array_equal(cell.flanges, Job.of(nominal).cell().flanges)
    assert jobs.feasible[0]
