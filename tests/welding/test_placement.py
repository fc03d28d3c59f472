"""Paths, constraints and fitness of placements."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualarm_repro.arms import load_arm
from dualarm_repro.arms.wrist_geometry import wrist_geometry
from dualarm_repro.errors import InputError, UnknownNameError
from dualarm_repro.welding import (
    ROBOTS,
    Objective,
    Placement,
    Status,
    Tools,
    Torch,
    Workpiece,
    base_poses,
    closed_form,
)
from dualarm_repro.welding.assembly import CARRIER_REFERENCES
from dualarm_repro.welding.branches import follow
from dualarm_repro.welding.ellipsoid import ellipsoid_volume
from dualarm_repro.welding.grid_search import grid_points

from .cells import BASES, BOX, make_cell
from .references import unwrapped_reference

GOOD = np.array([[0.0, 0.1, 0.8]])


@pytest.fixture(scope="module")
def placement():
    return Placement(make_cell(), Objective())


@pytest.fixture(scope="module")
def landscape(placement):
    points = grid_points(BOX, 0.2)
    return points, placement.jobs(points)


def test_some_of_each_status(landscape):
    _, jobs = landscape
    found = set(jobs.status.tolist())
    assert {Status.FEASIBLE, Status.OUT_OF_REACH, Status.JOINT_LIMITS, Status.COLLISION} <= found


def test_paths_reach_their_poses(placement, landscape):
    """IK round trip along the seam, for every robot of every feasible placement."""
    cell, (points, jobs) = placement.cell, landscape
    for p in np.flatnonzero(jobs.feasible):
        for k, arm in enumerate(cell.arms):
            T = cell.bases[k] @ arm.fk(jobs.q[p, k])
            wanted = cell.flanges[k].copy()
            wanted[:, :3, 3] += points[p]
            assert abs(T - wanted).max() < 1e-9
            assert arm.within_limits(jobs.q[p, k], 1e-9).all()
            assert abs(jobs.w[p, k] - closed_form(arm, jobs.q[p, k])).max() < 1e-14
            assert abs(np.diff(jobs.q[p, k], axis=0)).max() < 1.2


def test_every_branch_round_trip():
    """All eight branches of the closed form reproduce the pose they were asked for."""
    cell = make_cell()
    arm, poses = cell.arms[2], cell.flanges[2].copy()
    poses[:, :3, 3] += GOOD - BASES[2, :3, 3]
    found = arm.ik_branches(poses, within_limits=False)
    exists = ~np.isnan(found).any(axis=(0, 2))
    assert exists.sum() >= 4
    for b in np.flatnonzero(exists):
        assert abs(arm.fk(found[:, b]) - poses).max() < 1e-9


def test_best_branch_is_taken():
    """Against an enumeration of the branches in numpy."""
    cell = make_cell()
    for k, arm in enumerate(cell.arms):
        poses = cell.flanges[k].copy()
        poses[:, :3, 3] += GOOD
        branches = arm.ik_branches(np.linalg.inv(cell.bases[k]) @ poses, within_limits=False)
        means = []
        for b in range(8):
            path = None if np.isnan(branches[:, b]).any() else branches[:, b]
            path = path if path is None else unwrapped_reference(path, arm.lower, arm.upper)
            means.append(-1.0 if path is None else closed_form(arm, path).mean())
        q, w, branch, status = follow(
            wrist_geometry(arm.name, arm.chain),
            cell.bases[k],
            cell.flanges[k],
            GOOD,
            arm.lower,
            arm.upper,
            1e-3,
        )
        assert status[0] == Status.FEASIBLE
        assert w[0].mean() == pytest.approx(max(means), rel=1e-12)
        assert means[branch[0]] == pytest.approx(max(means), rel=1e-9)
        path = unwrapped_reference(branches[:, branch[0]], arm.lower, arm.upper)
        assert abs(q[0] - path).max() < 1e-12


def test_nearest_continuation_stays_on_the_branch(landscape, placement):
    """Choosing the nearest solution at every step never changes over to another branch."""
    _, jobs = landscape
    cell = placement.cell
    for p in np.flatnonzero(jobs.feasible)[:10]:
        for k, arm in enumerate(cell.arms):
            poses = cell.flanges[k].copy()
            poses[:, :3, 3] += jobs.centres[p]
            found = arm.ik_branches(np.linalg.inv(cell.bases[k]) @ poses, within_limits=False)
            for n in range(1, cell.count):
                gap = found[n] - jobs.q[p, k, n - 1]
                gap = np.abs((gap + np.pi) % (2 * np.pi) - np.pi).max(axis=1)
                assert np.nanargmin(gap) == jobs.branch[p, k]


@settings(max_examples=25)
@given(st.tuples(st.floats(0, 0.6), st.floats(-0.4, 0.5), st.floats(0.4, 1.2)))
def test_mirror_symmetry(mirror_placement, centre):
    """F(-x, y, z) = F(x, y, z): the limits of axes 1, 4, 6 are symmetric and wide enough."""
    x, y, z = centre
    pair = np.array([[x, y, z], [-x, y, z]])
    first, second = mirror_placement(pair)
    assert abs(first - second) < 1e-12
    feasible = mirror_placement.jobs(pair).feasible
    assert feasible[0] == feasible[1]


@pytest.fixture(scope="module")
def mirror_placement():
    return Placement(make_cell(count=24), Objective())


def test_shift_invariance():
    """Raising all bases and the floor raises the whole landscape."""
    points = grid_points(BOX, 0.3)
    low = Placement(make_cell(count=18), Objective())
    high = Placement(make_cell(count=18, lift=0.25, floor=0.25), Objective())
    assert abs(low(points) - high(points + np.array([0, 0, 0.25]))).max() < 1e-12
    assert low(points).max() > 0.1


def test_literal_reading_mirrors_the_cell():
    """The literal base transform negates every base position."""
    literal = base_poses(BASES, "literal")
    assert abs(literal[:, :3, 3] + BASES[:, :3, 3]).max() < 1e-15
    with pytest.raises(UnknownNameError, match="inverted, literal"):
        base_poses(BASES, "transposed")


def test_seam_points_18_and_360():
    """The mean over a periodic curve has settled with 18 points."""
    coarse, fine = (Placement(make_cell(count=n), Objective())(GOOD)[0] for n in (18, 360))
    assert coarse > 0.1
    assert abs(coarse - fine) < 1e-5


def test_millimetres_change_the_optimum():
    points = grid_points(np.array([[-0.6, 0.6], [-0.1, 0.3], [0.5, 1.0]]), 0.05)
    best = []
    for unit in ("m", "mm"):
        placement = Placement(make_cell(count=18), Objective(weights="equal", unit=unit))
        best.append(points[placement(points).argmax()])
    assert np.linalg.norm(np.abs(best[0]) - np.abs(best[1])) > 0.1


def test_collision_only_cuts(placement):
    """Without the floor the same placements and more are feasible."""
    points = grid_points(BOX, 0.2)
    free = Placement(make_cell(floor=None), Objective()).jobs(points)
    held = placement.jobs(points)
    assert (free.feasible | ~held.feasible).all()
    assert free.feasible.sum() > held.feasible.sum()


@pytest.mark.parametrize("grasp", ["axial", "diagonal", "side"])
@pytest.mark.parametrize("reading", ["inverted", "literal"])
def test_grasps_close(grasp, reading):
    """p_2 + R r - p = 0 for both carriers, with one r each for the whole seam."""
    cell = make_cell(grasp=grasp, reading=reading)
    for k in (0, 1):
        r = np.einsum("nji,nj->ni", cell.rotations, cell.flanges[k, :, :3, 3])
        assert abs(r - r[0]).max() < 1e-12
        assert r[0, 0] * cell.bases[k, 0, 3] > 0
        approach = cell.flanges[k, 0, :3, 2]
        assert approach @ (cell.rotations[0] @ r[0]) < 0


@pytest.mark.parametrize("crank", [0.0, 0.6])
@pytest.mark.parametrize("axis", ["along_bisector", "work_angle_45"])
def test_torch_tip_is_on_the_seam(crank, axis):
    cell = make_cell(crank=crank, axis=axis, posture="main_pipe_normal")
    torch = Torch(0.35, crank, 0.02, 0.1)
    flange = cell.flanges[2]
    tip = flange[:, :3, :3] @ torch.centre_line[2] + flange[:, :3, 3]
    assert abs(tip - cell.seam_in_world(np.zeros(3))).max() < 1e-12
    assert (flange[:, 1, 3] > tip[:, 1]).mean() > 0.5 or crank == 0
    along = flange[:, :3, :3] @ torch.rotation[:, 2]
    if axis == "work_angle_45":
        assert np.allclose(along, [0, -np.sqrt(0.5), -np.sqrt(0.5)])
    else:
        assert (along[:, 2] < 0).all()


def test_piece_pose_carries_the_seam(placement):
    cell, centre = placement.cell, np.array([0.1, 0.2, 0.3])
    pose = cell.piece_pose(centre)
    p = np.einsum("nij,nj->ni", pose[:, :3, :3], cell.seam) + pose[:, :3, 3]
    assert abs(p - cell.seam_in_world(centre)).max() < 1e-15


def test_bad_input():
    with pytest.raises(InputError, match=r"centres.*expected finite positions"):
        Placement(make_cell(count=12), Objective())([[0.0, np.nan, 0.0]])
    with pytest.raises(InputError, match="length = 0"):
        Torch(0.0, 0.0, 0.02, 0.0)
    with pytest.raises(InputError, match=r"exempt = 0\.4"):
        Torch(0.35, 0.0, 0.02, 0.4)
    with pytest.raises(InputError, match="branch_length = -1"):
        Workpiece(0.1, 0.06, 0.6, -1.0, 36)
    with pytest.raises(InputError, match="gripper_length = 0"):
        Tools("axial", 0.0, 0.06, Torch(0.35, 0.0, 0.02, 0.1), "along_bisector")
    with pytest.raises(UnknownNameError, match="axial, diagonal, side"):
        make_cell(grasp="top")
    with pytest.raises(UnknownNameError, match="along_bisector, work_angle_45"):
        make_cell(axis="flat")
    cell = make_cell(count=12)
    with pytest.raises(InputError, match=r"Cell: bases \(its shape\) = \(4, 4\): .*\(3, 4, 4\)"):
        type(cell)(**{**_fields(cell), "bases": np.eye(4)})
    with pytest.raises(InputError, match=r"flanges \(its shape\).*\(3, N, 4, 4\), N = 2"):
        type(cell)(**{**_fields(cell), "rotations": cell.rotations[:2]})
    along = {name: getattr(cell, name)[:2] for name in ("rotations", "torch_axis", "seam")}
    along |= {name: getattr(cell, name)[:, :2] for name in ("flanges", "references")}
    with pytest.raises(InputError, match="seam points = 2"):
        type(cell)(**{**_fields(cell), **along})


@pytest.mark.parametrize("count", [0, 2, 4])
def test_a_cell_is_assembled_of_three_arms(count):
    with pytest.raises(InputError, match=f"assemble: number of arms = {count}: expected 3: carr"):
        make_cell(count=12, arms=[load_arm("kr16-2")] * count, bases=BASES)


@pytest.mark.parametrize(
    "bases", [BASES[np.newaxis], BASES[:2], BASES[:, :3], np.empty((0, 4, 4)), np.array([]), 3]
)
def test_a_cell_is_assembled_on_three_bases(bases):
    with pytest.raises(InputError, match=r"assemble: bases \(its shape\) = .*\(3, 4, 4\)"):
        make_cell(count=12, bases=bases)


def test_arms_may_differ():
    arms = [load_arm(name) for name in ("kr16-2", "er16", "irb2400")]
    jobs = Placement(make_cell(arms=arms, count=18), Objective()).jobs(GOOD)
    assert len(ROBOTS) == 3
    assert jobs.status[0] != Status.OUT_OF_REACH


def _fields(cell):
    return {name: value for name, value in vars(cell).items() if name not in ("geometries",)}


def test_a_wrist_that_leaves_the_reach_between_two_points_is_out_of_reach():
    """Feasible on a seam means feasible on every denser one, at the edge of the reach too."""
    coarse, dense = (Placement(make_cell(count=n, floor=None), Objective()) for n in (24, 720))
    inner, outer = np.array([0.0, 0.1, 0.8]), np.array([0.0, 0.1, 2.5])
    for _ in range(40):
        middle = 0.5 * (inner + outer)
        inside = coarse.jobs([middle]).status[0] != Status.OUT_OF_REACH
        inner, outer = (middle, outer) if inside else (inner, middle)
    assert dense.jobs([inner]).status[0] != Status.OUT_OF_REACH
    assert dense.jobs([outer]).status[0] != Status.OUT_OF_REACH  # the bound is on the safe side


def test_a_step_past_a_singularity_is_no_path():
    """Through an aligned wrist a smooth motion of the flange turns joint 4 by pi at once."""
    arm = make_cell().arms[2]
    turn = 2 * np.pi * (np.arange(36) + 0.5) / 36
    q = np.tile(np.radians([10.0, 20.0, 10.0, 30.0, 0.0, 40.0]), (36, 1))
    lower, upper, found = arm.lower.copy(), arm.upper.copy(), {}
    lower[1:3], upper[1:3] = q[0, 1:3] - 0.2, q[0, 1:3] + 0.2  # one branch but for the wrist
    for name, middle in (("through", 0.0), ("beside", 1.0)):
        q[:, 4] = middle + 0.5 * np.cos(turn)
        for threshold in (1e-6, 0.0):
            path, _, _, status = follow(
                wrist_geometry(arm.name, arm.chain), np.eye(4), arm.fk(q), np.zeros((1, 3)),
                lower, upper, threshold,
            )  # fmt: skip
            found[name, threshold] = status[0]
    assert found["through", 1e-6] == Status.SINGULAR
    assert found["through", 0.0] == Status.FEASIBLE  # singularities left aside
    assert found["beside", 1e-6] == Status.FEASIBLE
    assert abs(np.diff(path[0], axis=0)).max() < 0.1


def test_the_reference_of_the_carriers_changes_their_weight_and_nothing_else():
    found = {}
    for reference in CARRIER_REFERENCES:
        placement = Placement(make_cell(reference=reference), Objective())
        jobs = placement.jobs([[0.0, 0.1, 0.8]])
        found[reference] = jobs, placement.measures(jobs)
    (jobs, measures), *others = found.values()
    for other, weighted in others:
        assert np.array_equal(other.q, jobs.q)
        assert np.array_equal(weighted.tight, measures.tight)
        assert abs(weighted.beta_tight / measures.beta_tight - 1).max() > 0.05
    own = found["own_flange"]
    gram = gram_of(own[0], make_cell(reference="own_flange"))
    assert np.allclose(0.5 * sum(1 / ellipsoid_volume(a) for a in gram), own[1].beta_tight[0])


def gram_of(jobs, cell):
    return [np.array([j @ j.T for j in cell.arms[k].jacobian(jobs.q[0, k])[:, :3]]) for k in (0, 1)]


def test_an_unknown_reference_is_named():
    with pytest.raises(UnknownNameError, match="reference"):
        make_cell(reference="elbow")
