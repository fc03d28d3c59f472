"""Drawings of a welding cell: arms end where they hold or weld, vectors where they point."""

import numpy as np
import pytest
from welding.cells import make_cell

from dualarm_repro.view import welding_cell as figures
from dualarm_repro.view.style import BLACK, ORANGE, PURPLE
from dualarm_repro.welding import ROBOTS, WELDER, Objective, Placement, torch_tips

from .drawn import in_space, words

CENTRE = np.array([0.0, -0.2, 0.8])


@pytest.fixture(scope="module")
def cell():
    return make_cell(count=12)


@pytest.fixture(scope="module")
def job(cell):
    """The first feasible position of a few, joint angles (3, N, 6) there, and the jobs."""
    centres = CENTRE + np.array([(x, y, z) for x in (0.0, 0.1) for y in (-0.2, 0.0, 0.2)
                                 for z in (-0.2, 0.0, 0.2)])  # fmt: skip
    jobs = Placement(cell, Objective()).jobs(centres)
    kept = np.flatnonzero(jobs.feasible)
    assert len(kept), "one of these is feasible"
    return centres[kept[0]], jobs.q[kept[0]], jobs.select(jobs.feasible)


@pytest.mark.parametrize("robot", [0, 1, 2])
def test_a_skeleton_ends_at_the_flange_or_at_the_tip_of_the_torch(cell, job, robot):
    centre, q, _ = job
    for index in (0, 5):
        points = figures._skeleton(cell, robot, q[robot, index])
        np.testing.assert_allclose(points[0], cell.bases[robot][:3, 3])
        pose = cell.bases[robot] @ cell.arms[robot].fk(q[robot, index])
        if robot == WELDER:
            np.testing.assert_allclose(points[-2], pose[:3, 3], atol=1e-9)
            # at a seam point, and there the reference of the welder is the tip
            tip = centre + cell.references[WELDER, index]
            np.testing.assert_allclose(points[-1], tip, atol=1e-6)
            seam = cell.seam_in_world(centre)[index]
            np.testing.assert_allclose(points[-1], seam, atol=1e-6)
        else:
            np.testing.assert_allclose(points[-1], pose[:3, 3], atol=1e-9)


@pytest.mark.parametrize("robot", [0, 1])
def test_a_gripper_ends_at_the_end_of_the_pipe_it_holds(cell, job, robot):
    centre, q, _ = job
    for index in (0, 4, 9):
        found = figures._grip(cell, robot, q, index)
        ends = centre + cell.pipe_axes[0] @ cell.rotations[index].T
        flange = figures._skeleton(cell, robot, q[robot, index])[-1]
        nearest = ends[np.linalg.norm(ends - flange, axis=1).argmin()]
        np.testing.assert_allclose(found, nearest, atol=1e-6)


def test_the_whole_cell_and_its_middle_are_drawn(cell, job, surfaces):
    centre, q, _ = job
    whole, close = figures.cell_figure(cell, q, centre, index=3).axes
    assert set(ROBOTS) <= set(words(whole))
    assert {"torch", "gripper"} <= set(words(close))
    assert words(close).count("gripper") == 2
    pipes = [arrays for arrays, how in surfaces if how["color"] == "0.5"]
    assert len(pipes) == 4  # two in each view
    for (x, y, z), axis, radius in zip(pipes, cell.pipe_axes, cell.pipe_radii, strict=False):
        ends = axis @ cell.rotations[3].T + centre
        way = (ends[1] - ends[0]) / np.linalg.norm(ends[1] - ends[0])
        away = np.stack([x, y, z], axis=-1).reshape(-1, 3) - ends[0]
        across = np.linalg.norm(away - np.outer(away @ way, way), axis=1)
        assert across.max() == pytest.approx(radius)
        assert (away @ way).max() == pytest.approx(np.linalg.norm(ends[1] - ends[0]))
    seams = [p for line, p in zip(whole.lines, in_space(whole), strict=True)
             if line.get_color() == ORANGE]  # fmt: skip
    expected = centre + cell.seam @ cell.rotations[3].T
    np.testing.assert_allclose(seams[0], [*expected, expected[0]])
    for axis, limits in zip(centre, (close.get_xlim(), close.get_ylim(), close.get_zlim()),
                            strict=True):  # fmt: skip
        assert limits == pytest.approx((axis - 0.6, axis + 0.6))
    tools = [p for line, p in zip(close.lines, in_space(close), strict=True)
             if line.get_color() == BLACK]  # fmt: skip
    assert len(tools) == len(ROBOTS)


def test_ellipsoids_get_a_panel_each(cell, job, surfaces):
    centre, q, _ = job
    grams = np.array([np.diag((1.0, 4.0, 9.0)), np.eye(3), 0.25 * np.eye(3)])
    axes = figures.cell_figure(cell, q, centre, grams=grams, capsules=True).axes
    assert len(axes) == 2 + len(ROBOTS)
    assert axes[2].get_title() == "carrier 1: 3.00 to 1.00 m/s"
    assert axes[4].get_title() == "welder: 0.50 to 0.50 m/s"


def test_vectors_lead_from_frame_to_frame(cell, job, monkeypatch):
    from mpl_toolkits.mplot3d import Axes3D

    centre, q, _ = job
    arrows = []
    monkeypatch.setattr(Axes3D, "quiver", lambda self, *a, **how: arrows.append((a, how["color"])))
    (ax,) = figures.vectors_figure(cell, q, centre).axes
    assert set(words(ax)) == {"B1", "B2", "B3", "W", "C", "p1", "p2", "p3", "r1", "r2"}
    starts = np.array([a[:3] for a, _ in arrows])
    ends = starts + np.array([a[3:] for a, _ in arrows])
    flanges = [centre + cell.flanges[k, 0, :3, 3] for k in range(2)]
    np.testing.assert_allclose(starts[0], 0.0)
    np.testing.assert_allclose(ends[0], centre)
    for k, flange in enumerate(flanges):
        first, second = 1 + 2 * k, 2 + 2 * k
        np.testing.assert_allclose(starts[first], 0.0)
        np.testing.assert_allclose(starts[second], centre)
        np.testing.assert_allclose(ends[[first, second]], [flange, flange])
        assert [arrows[n][1] for n in (first, second)] == [ORANGE, PURPLE]


def test_capsules_of_a_robot_have_their_radii(cell, job, surfaces):
    from dualarm_repro.scene.posing import links_of

    _, q, _ = job
    for robot in (0, 2):
        surfaces.clear()
        figures.capsule_figure(cell, q[robot, 0], robot)
        radii = links_of(cell.arms[robot]).radius
        assert len(surfaces) == len(radii)
        for ((x, y, z), _), radius in zip(surfaces, radii, strict=True):
            points = np.stack([x, y, z], axis=-1)
            # rows are circles about the core: the widest has the radius of the capsule
            middle = points[:, :, :].mean(axis=0)
            widest = np.linalg.norm(points - middle, axis=2).max()
            assert widest == pytest.approx(radius, rel=0.05)  # the mean counts one corner twice


def test_a_triad_has_an_arrow_along_each_axis():
    from dualarm_repro.view.style import axes_3d

    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = [[0, -1, 0], [1, 0, 0], [0, 0, 1]], [1.0, 2.0, 3.0]
    _, ax = axes_3d()
    figures.triad(ax, pose, 0.5)
    tips = [line[1] - line[0] for line in in_space(ax)]
    np.testing.assert_allclose(tips, [(0, 0.5, 0), (-0.5, 0, 0), (0, 0, 0.5)], atol=1e-12)
    assert [line.get_color() for line in ax.lines] == ["#D55E00", "#009E73", "#0072B2"]


def test_the_torch_ends_where_the_method_has_it(cell, job):
    centre, q, jobs = job
    tips = np.array([figures._skeleton(cell, WELDER, row)[-1] for row in q[WELDER]])
    np.testing.assert_allclose(tips, torch_tips(cell, jobs), atol=1e-9)
    np.testing.assert_allclose(tips, cell.seam_in_world(centre), atol=1e-6)
