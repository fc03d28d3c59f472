"""The scene of a job: robots and workpiece move together, bars are as high as what they show."""

import numpy as np
import pytest
from welding.cells import make_cell

from dualarm_repro.view.scenes.surfaces import surface
from dualarm_repro.view.welding_scene import job_scene
from dualarm_repro.welding import ROBOTS, Objective, Placement

COUNT = 12


@pytest.fixture(scope="module")
def cell():
    return make_cell(count=COUNT)


@pytest.fixture(scope="module")
def job(cell):
    """The first feasible position of a few, and the job there."""
    centres = np.array([(x, y, z) for x in (0.0, 0.1) for y in (-0.4, -0.2, 0.0)
                        for z in (0.6, 0.8, 1.0)])  # fmt: skip
    jobs = Placement(cell, Objective()).jobs(centres)
    kept = jobs.select(jobs.feasible)
    return kept.centres[0], kept


@pytest.fixture(scope="module")
def made(cell, job):
    centre, jobs = job
    return job_scene("A job.", cell, jobs.q[0], centre, jobs.w[0], 2.0 * jobs.w[0].max(), every=4)


def test_the_workpiece_stays_between_flanges_and_torch(made, cell, job):
    """The pose of each carrier's flange relative to the workpiece never changes."""
    motion = made.contents.motion
    assert motion.frames.tolist() == [0, 4, 8, 12], "the last is the first again"
    piece = motion.poses["workpiece"]
    np.testing.assert_allclose(piece[-1], piece[0])
    for name in ROBOTS[:2]:
        relative = np.linalg.inv(piece) @ motion.poses[f"{name}/6"]
        np.testing.assert_allclose(relative, np.tile(relative[0], (4, 1, 1)), atol=1e-6)
    for k, frame in enumerate(motion.frames):
        pose = cell.piece_pose(job[0])[frame % COUNT]
        np.testing.assert_allclose(piece[k], pose)
    assert made.contents.tips == {}


def test_bars_rise_out_of_the_floor_by_their_share(made, cell, job):
    w = job[1].w[0]
    for k, name in enumerate(ROBOTS):
        (part,) = [p for p in made.contents.parts if p.node == f"{name} bar"]
        vertices = surface(part).vertices
        poses = made.contents.motion.poses[f"{name} bar"]
        for pose, frame in zip(poses, made.contents.motion.frames % COUNT, strict=True):
            top = (vertices @ pose[:3, :3].T + pose[:3, 3])[:, 2].max()
            full = part.size[2]
            assert top == pytest.approx(full * w[k, frame] / (2.0 * w.max()))
        away = poses[0][:2, 3] - cell.bases[k][:2, 3]
        outward = cell.bases[k][:2, 3] / np.linalg.norm(cell.bases[k][:2, 3])
        np.testing.assert_allclose(away, 0.35 * outward, atol=1e-12)


def test_pipes_and_seam_are_parts_of_the_workpiece(made, cell):
    parts = [p for p in made.contents.parts if p.node == "workpiece"]
    rods = [p for p in parts if p.kind == "rod"]
    for part, axis, radius in zip(rods, cell.pipe_axes, cell.pipe_radii, strict=False):
        assert part.size == pytest.approx((radius, np.linalg.norm(axis[1] - axis[0])))
        half = 0.5 * part.size[1] * part.pose[:3, 2]
        ends = np.array([part.pose[:3, 3] - half, part.pose[:3, 3] + half])
        np.testing.assert_allclose(ends, axis, atol=1e-9)
    (seam,) = [p for p in parts if p.kind == "line"]
    np.testing.assert_allclose(seam.vertices, [*cell.seam, cell.seam[0]])


def test_what_is_nearest_is_told_at_every_key_frame(made, job):
    nearest = made.contents.nearest
    assert len(nearest.distance) == 4
    gaps = np.linalg.norm(nearest.ends[:, 1] - nearest.ends[:, 0], axis=1)
    np.testing.assert_allclose(gaps, abs(nearest.distance), atol=1e-9)
    assert nearest.distance[0] == pytest.approx(nearest.distance[-1])
    assert (nearest.distance > 0.0).all(), "the job is feasible"
    assert made.contents.note == "Bars beside the bases: manipulability."
    assert made.contents.floor == 0.0
