"""Distances of a cell against coal and against the scene of the package."""

import coal
import numpy as np
import pinocchio as pin
import pytest

from dualarm_repro.arms.capsules import segment_capsule
from dualarm_repro.scene.pair_kernels import capsules_capsules
from dualarm_repro.scene.posing import links_of
from dualarm_repro.welding import ROBOTS, Objective, Placement, Separation, Workpiece
from dualarm_repro.welding.grid_search import grid_points
from dualarm_repro.welding.separation import EXEMPTIONS, FLOOR, HELD, WORKPIECE

from .cells import BOX, make_cell

CENTRE = np.array([[0.05, 0.1, 0.8]])


@pytest.fixture(scope="module")
def solved():
    placement = Placement(make_cell(count=12), Objective())
    return placement, placement.jobs(CENTRE)


def _coal_distance(core_a, radius_a, core_b, radius_b):
    (pose_a, a), (pose_b, b) = (
        segment_capsule(*core, r) for core, r in ((core_a, radius_a), (core_b, radius_b))
    )
    request, result = coal.DistanceRequest(), coal.DistanceResult()
    poses = [coal.Transform3s(p.rotation, p.translation) for p in (pose_a, pose_b)]
    return coal.distance(a, poses[0], b, poses[1], request, result)


def test_capsules_are_coal():
    rng = np.random.default_rng(11)
    ends = rng.normal(size=(1000, 2, 2, 3)) * rng.choice([0.2, 1.0], size=(1000, 1, 1, 1))
    radius, distance = np.array([0.1, 0.3]), np.empty((1000, 1))
    capsules_capsules(ends, radius, np.array([[0, 1]]), distance, np.empty((0, 0, 3, 3)), 0)
    expected = [_coal_distance(a, 0.1, b, 0.3) for a, b in ends]
    assert (np.array(expected) < 0).sum() > 50
    assert abs(distance[:, 0] - expected).max() < 1e-12


def test_whole_cell_against_pinocchio_and_coal(solved):
    """Every watched pair, from the geometry models of the arms instead of the kernels."""
    placement, jobs = solved
    separation, cell = placement.separation, placement.cell
    bodies = []
    for k, arm in enumerate(cell.arms):
        data = arm.model.createData()
        rows = []
        for q in jobs.q[0, k]:
            pin.forwardKinematics(arm.model, data, q)
            base = pin.SE3(cell.bases[k])
            rows.append(
                [
                    (base * data.oMi[g.parentJoint] * g.placement, g.geometry)
                    for g in arm.geometry.geometryObjects
                ]
            )
        bodies.append(rows)
    pipes = []
    for n in range(cell.count):
        at = pin.SE3(cell.piece_pose(CENTRE[0])[n])
        shapes = zip(cell.pipe_cores, cell.pipe_radii, strict=True)
        pipes.append([(at * p, g) for p, g in (segment_capsule(*c, r) for c, r in shapes)])
    smallest = np.full(len(separation.pairs.rows["capsule"]), np.inf)
    for n in range(cell.count):
        world = [body for rows in bodies for body in rows[n]] + pipes[n]
        for k, (i, j) in enumerate(separation.pairs.rows["capsule"]):
            poses = [
                coal.Transform3s(world[b][0].rotation, world[b][0].translation) for b in (i, j)
            ]
            request, result = coal.DistanceRequest(), coal.DistanceResult()
            found = coal.distance(world[i][1], poses[0], world[j][1], poses[1], request, result)
            smallest[k] = min(smallest[k], found)
    found = separation.per_pair(jobs.q, CENTRE)[0]
    assert abs(found[: len(smallest)] - smallest).max() < 1e-9
    assert jobs.separation[0] == found.min()


def test_floor_distances(solved):
    placement, jobs = solved
    separation = placement.separation
    cores = separation.cores(jobs.q, CENTRE)
    rows = separation.pairs.rows["plane"][:, 0]
    lowest = cores[:, rows][..., 2].min(axis=(0, 2)) - separation.bodies.radius[rows]
    assert abs(separation.per_pair(jobs.q, CENTRE)[0, -len(rows) :] - lowest).max() < 1e-12


def test_which_pairs_are_watched(solved):
    separation = solved[0].separation
    owners = {frozenset(pair) for pair in separation.owners}
    for pair in (
        {ROBOTS[0], ROBOTS[1]},
        {ROBOTS[0], ROBOTS[2]},
        {ROBOTS[0], WORKPIECE},
        {"torch", WORKPIECE},
        {"torch", ROBOTS[1]},
        {ROBOTS[2], FLOOR},
        {WORKPIECE, FLOOR},
    ):
        assert frozenset(pair) in owners
    names = separation.pairs.names
    assert len(names) == len(set(names)) == len(separation.owners)
    held = [pair for pair in names if set(HELD) & set(pair)]
    assert not any("tool" in a and "carrier" in a for a, _ in held)
    assert any("tool" in a and "welder" in a for a, _ in held)
    assert not any("joint_1" in a and b == FLOOR for a, b in names)
    assert len(EXEMPTIONS) == 4


def test_no_floor():
    separation = Separation(make_cell(count=12, floor=None))
    assert not len(separation.pairs.rows["plane"])
    assert FLOOR not in {name for pair in separation.owners for name in pair}


def test_tools_belong_to_the_arms():
    cell = make_cell(count=12, crank=0.5)
    assert [sum("tool" in n for n in links_of(arm).names) for arm in cell.arms] == [1, 1, 2]


def test_smallest_is_the_smallest_pair():
    """With and without leaving out the pairs that are far apart, in gaps and in penetration."""
    placement = Placement(make_cell(count=12), Objective())
    jobs = placement.jobs(grid_points(BOX, 0.3))
    kept = ~np.isnan(jobs.separation)
    every = placement.separation.per_pair(jobs.q[kept], jobs.centres[kept]).min(axis=1)
    assert (every > 0).any()
    assert (every < 0).any()
    assert abs(jobs.separation[kept] - every).max() < 1e-14


@pytest.mark.parametrize("length", [0.15, 0.3, 0.6])
def test_the_capsules_contain_the_pipes(length):
    """Every point of both cylinders with flat ends, their rims included."""
    piece, rng = Workpiece(0.1, 0.06, length, 0.15, 12), np.random.default_rng(3)
    for (start, end), radius in zip(piece.axes, piece.radii, strict=False):
        x = (end - start) / np.linalg.norm(end - start)
        across = np.linalg.svd(x[np.newaxis])[2][1:]
        angle, along = rng.uniform(0, 2 * np.pi, 500), rng.choice([0.0, 1.0, 0.3, 0.7], 500)
        rim = radius * np.column_stack([np.cos(angle), np.sin(angle)]) @ across
        points = start + along[:, np.newaxis] * (end - start) + rim
        gaps = [
            _from_core(points, *core) - r for core, r in zip(piece.cores, piece.radii, strict=True)
        ]
        assert np.min(gaps, axis=0).max() < 1e-12


def _from_core(points, start, end):
    u = end - start
    part = np.clip((points - start) @ u / max(u @ u, 1e-30), 0.0, 1.0)
    return np.linalg.norm(points - start - part[:, np.newaxis] * u, axis=1)
