"""Torch, grasps and workpiece by their geometry, worked out by hand."""

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualarm_repro.arms import load_arm
from dualarm_repro.errors import InputError, UnknownNameError
from dualarm_repro.welding import Tools, Torch, Workpiece, base_poses
from dualarm_repro.welding.posture import smallest_rotations
from dualarm_repro.welding.tooling import grasp_pose, torch_axes, torch_flanges, with_tool

ROOT = np.sqrt(0.5)


def test_a_torch_bent_by_a_right_angle():
    torch = Torch(0.4, np.pi / 2, 0.02, 0.05)
    np.testing.assert_allclose(
        torch.centre_line, [[0, 0, 0], [0, 0, 0.2], [0.2, 0, 0.2]], atol=1e-12
    )
    np.testing.assert_allclose(torch.rotation[:, 2], [1, 0, 0], atol=1e-12)
    np.testing.assert_allclose(torch.cores[1], [[0, 0, 0.2], [0.15, 0, 0.2]], atol=1e-12)
    np.testing.assert_allclose(torch.cores[0], [[0, 0, 0], [0, 0, 0.2]], atol=1e-12)


def test_a_torch_whose_exempt_tip_reaches_back_beyond_the_bend():
    torch = Torch(0.4, 0.7, 0.02, 0.25)
    np.testing.assert_allclose(torch.cores, [[[0, 0, 0], [0, 0, 0.15]]])


@settings(max_examples=30)
@given(length=st.floats(0.05, 2.0), crank=st.floats(0.0, 3.0), share=st.floats(0.0, 0.99))
def test_the_capsules_are_as_long_as_the_torch_without_its_tip(length, crank, share):
    torch = Torch(length, crank, 0.01, share * length)
    lengths = np.linalg.norm(np.diff(torch.cores, axis=1), axis=2).sum()
    assert lengths == pytest.approx(length - share * length)
    assert np.linalg.norm(torch.centre_line[2] - torch.centre_line[1]) == pytest.approx(length / 2)


@settings(max_examples=30)
@given(seed=st.integers(0, 10**6), crank=st.floats(0.0, 1.5))
def test_the_flange_puts_the_tip_on_its_point_along_its_axis(seed, crank):
    rng = np.random.default_rng(seed)
    torch = Torch(0.35, crank, 0.02, 0.1)
    tips, axes = rng.normal(size=(6, 3)), rng.normal(size=(6, 3))
    axes[:, 2] = -abs(axes[:, 2])
    axes /= np.linalg.norm(axes, axis=1, keepdims=True)
    poses = torch_flanges(tips, axes, rng.normal(size=2), torch)
    tip = poses[:, :3, :3] @ torch.centre_line[2] + poses[:, :3, 3]
    np.testing.assert_allclose(tip, tips, atol=1e-12)
    np.testing.assert_allclose(poses[:, :3, :3] @ torch.rotation[:, 2], axes, atol=1e-12)
    np.testing.assert_allclose(np.linalg.det(poses[:, :3, :3]), 1.0, atol=1e-12)


def test_a_torch_that_points_down_leans_its_flange_towards_the_welder():
    torch = Torch(0.4, np.pi / 2, 0.02, 0.05)
    (pose,) = torch_flanges(np.zeros((1, 3)), np.array([[0, 0, -1.0]]), np.array([0.0, 3.0]), torch)
    # From the tip 0.2 m up along the torch, then 0.2 m towards the welder, along +y.
    np.testing.assert_allclose(pose[:3, 3], [0.0, 0.2, 0.2], atol=1e-12)


@settings(max_examples=20)
@given(angle=st.floats(-3.0, 3.0), seed=st.integers(0, 1000))
def test_torch_flanges_turn_with_everything_about_the_vertical(angle, seed):
    rng = np.random.default_rng(seed)
    torch, R = Torch(0.35, 0.6, 0.02, 0.1), pin.utils.rotate("z", angle)
    tips, axes = rng.normal(size=(4, 3)), -np.abs(rng.normal(size=(4, 3)))
    axes /= np.linalg.norm(axes, axis=1, keepdims=True)
    towards = rng.normal(size=2)
    plain = torch_flanges(tips, axes, towards, torch)
    turned = torch_flanges(tips @ R.T, axes @ R.T, R[:2, :2] @ towards, torch)
    np.testing.assert_allclose(turned[:, :3], R @ plain[:, :3], atol=1e-12)


def test_axes_of_the_torch():
    bisector = np.array([[0, 0, 1.0], [ROOT, 0, ROOT]])
    np.testing.assert_allclose(torch_axes("along_bisector", bisector, np.ones(2)), -bisector)
    leaning = torch_axes("work_angle_45", bisector, np.array([0.0, 5.0]))
    np.testing.assert_allclose(leaning, [[0, -ROOT, -ROOT]] * 2, atol=1e-12)
    with pytest.raises(UnknownNameError, match="along_bisector, work_angle_45"):
        torch_axes("straight", bisector, np.ones(2))


@pytest.mark.parametrize(
    ("name", "side", "origin", "approach"),
    [
        ("axial", (2.0, -1.0), [0.45, 0, 0], [-1, 0, 0]),
        ("axial", (-2.0, -1.0), [-0.45, 0, 0], [1, 0, 0]),
        ("side", (2.0, -1.0), [0.3, -0.25, 0], [0, 1, 0]),
        ("side", (-2.0, 1.0), [-0.3, 0.25, 0], [0, -1, 0]),
        (
            "diagonal",
            (1.0, 1.0),
            [0.3 + ROOT * (0.15 + 0.1 * ROOT), ROOT * (0.15 + 0.1 * ROOT), 0],
            [-ROOT, -ROOT, 0],
        ),
    ],
)
def test_grasps_by_hand(name, side, origin, approach):
    pose = grasp_pose(name, side, 0.3, 0.1, 0.15)
    np.testing.assert_allclose(pose[:3, 3], origin, atol=1e-12)
    np.testing.assert_allclose(pose[:3, 2], approach, atol=1e-12)
    np.testing.assert_allclose(pose[:3, 0], [0, 0, 1], atol=1e-12)
    np.testing.assert_allclose(pose[:3, :3] @ pose[:3, :3].T, np.eye(3), atol=1e-12)
    assert np.linalg.det(pose[:3, :3]) == pytest.approx(1.0)


def test_an_unknown_grasp_is_named():
    with pytest.raises(UnknownNameError, match=r"grasp_pose: name = 'hook': expected one of axial"):
        grasp_pose("hook", (1, 1), 0.3, 0.1, 0.15)


def test_a_tool_moves_with_the_flange_and_leaves_the_links():
    arm, cores = (
        load_arm("kr16-2"),
        np.array([[[0, 0, 0], [0, 0, 0.2]], [[0, 0, 0.2], [0.1, 0, 0.3]]]),
    )
    longer = with_tool(arm, cores, 0.03)
    old, new = arm.geometry.geometryObjects, longer.geometry.geometryObjects
    assert [g.name for g in new[: len(old)]] == [g.name for g in old]
    q = arm.random_configurations(1, np.random.default_rng(4))[0]
    data, geometry = longer.model.createData(), pin.GeometryData(longer.geometry)
    pin.updateGeometryPlacements(longer.model, data, longer.geometry, geometry, q)
    flange = arm.fk(q)
    for k, core in enumerate(cores):
        shape, at = new[len(old) + k].geometry, geometry.oMg[len(old) + k]
        assert shape.radius == 0.03
        ends = [at.act(np.array([0, 0, s * shape.halfLength])) for s in (-1, 1)]
        wanted = core @ flange[:3, :3].T + flange[:3, 3]
        gaps = np.linalg.norm(np.array(ends)[:, None] - wanted[None], axis=2)
        assert gaps.min(axis=0).max() < 1e-9


def test_the_cores_of_a_workpiece_contain_its_flat_ends():
    piece = Workpiece(0.10, 0.06, length=0.6, branch_length=0.15, seam_points=12)
    rim = np.array([[0.3, 0.1 * np.cos(a), 0.1 * np.sin(a)] for a in np.linspace(0, 6, 30)])
    for point in np.vstack([rim, -rim, [[0.3, 0, 0], [-0.3, 0, 0]]]):
        depths = []
        for (start, end), radius in zip(piece.cores, piece.radii, strict=True):
            along = end - start
            share = np.clip((point - start) @ along / max(along @ along, 1e-12), 0, 1)
            depths.append(np.linalg.norm(point - start - share * along) - radius)
        assert min(depths) <= 1e-12
    np.testing.assert_allclose(piece.axes[1, 1], [0, 0, 0.25])
    assert piece.radii[:2].tolist() == [0.10, 0.06]


#: A matrix whose inverse is not finite.
FAR_APART = np.array(
    [[-9e99, 1e-99, 0, -1e-90], [-1e-90, 0, 9e99, -9e99], [-9e99, 1e-99, -1e-90, -9e99],
     [0, 0, 0, 1e-99]]
)  # fmt: skip


@pytest.mark.parametrize(
    ("make", "line"),
    [
        (lambda: Torch(0.0, 0.1, 0.02, 0.0), r"torch: length = 0\.0: expected a positive length"),
        (lambda: Torch(0.3, 0.1, 0.02, 0.3), r"torch: exempt = 0\.3: expected from 0 to less"),
        (lambda: Torch(0.3, 0.1, 0.02, -0.1), "torch: exempt"),
        (lambda: Workpiece(0.1, 0.06, 0.0, 0.1, 12), "workpiece: length = 0"),
        (lambda: Workpiece(0.1, 0.06, 0.6, -0.1, 12), "workpiece: branch_length"),
        (lambda: Tools("axial", 0.0, 0.06, Torch(0.3, 0, 0.02, 0), "x"), "tools: gripper_length"),
        (lambda: base_poses(np.tile(np.eye(4), (3, 1, 1)), "both"), "inverted, literal"),
        (lambda: base_poses(np.zeros((3, 4, 4)), "literal"), "matrices that have an inverse"),
        (lambda: base_poses(FAR_APART[None], "literal"), "matrices that have an inverse"),
    ],
)
def test_each_wrong_part_is_named_in_one_line(make, line):
    with pytest.raises(InputError, match=line) as caught:
        make()
    assert "\n" not in str(caught.value)


def test_bases_are_read_as_poses_or_as_their_inverses():
    poses = np.array([pin.SE3.Random().homogeneous for _ in range(3)])
    np.testing.assert_array_equal(base_poses(poses, "inverted"), poses)
    np.testing.assert_allclose(base_poses(poses, "literal") @ poses, [np.eye(4)] * 3, atol=1e-12)


@settings(max_examples=30)
@given(seed=st.integers(0, 10**6))
def test_the_smallest_rotation_is_that_of_the_angle_between(seed):
    rng = np.random.default_rng(seed)
    a, b = (v / np.linalg.norm(v) for v in rng.normal(size=(2, 3)))
    R = smallest_rotations(a, b)
    np.testing.assert_allclose(R @ a, b, atol=1e-9)
    assert np.linalg.norm(pin.log3(R)) == pytest.approx(np.arccos(np.clip(a @ b, -1, 1)), abs=1e-6)
    np.testing.assert_allclose(smallest_rotations(b, a), R.T, atol=1e-9)
