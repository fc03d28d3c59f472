"""How fast a job can be executed, and how the torch meets the fillet."""

from dataclasses import replace

import numpy as np
import pytest

from dualarm_repro.errors import InputError
from dualarm_repro.welding import Objective, Placement, Status, saddle_seam
from dualarm_repro.welding.execution import (
    EFFORTS,
    arc_speed,
    joint_rates,
    seam_rate,
    speed_limits,
    timed,
)
from dualarm_repro.welding.torch_angles import retract, torch_angles

from .cells import make_cell

CENTRE = np.array([[0.05, 0.1, 0.8]])


@pytest.fixture(scope="module")
def job():
    cell = make_cell(count=72)
    return cell, Placement(cell, Objective()).jobs(CENTRE)


def test_rates_are_those_of_differences(job):
    cell, jobs = job
    fine = make_cell(count=720)
    dense = Placement(fine, Objective()).jobs(CENTRE)
    arc = np.linalg.norm(np.diff(np.vstack([fine.seam, fine.seam[:1]]), axis=0), axis=1)
    assert arc.sum() == pytest.approx(seam_rate(cell).mean() * 2 * np.pi, rel=1e-4)
    turned = np.diff(np.concatenate([dense.q[0], dense.q[0][:, :1]], axis=1), axis=1)
    differences = abs(turned / arc[:, np.newaxis]).max(axis=1)
    # differences over half a degree of the seam against rates at points ten degrees apart
    assert np.allclose(differences, abs(joint_rates(cell, jobs)).max(axis=1), rtol=0.02, atol=0.02)


def test_at_the_arc_speed_one_joint_is_at_its_limit(job):
    cell, jobs = job
    found = arc_speed(cell, jobs)
    used = found.speed * abs(joint_rates(cell, jobs)) / speed_limits(cell)[:, np.newaxis]
    assert used.max() == pytest.approx(1.0)
    robot = ("carrier 1", "carrier 2", "welder").index(found.robot)
    assert used[robot, found.point, found.joint - 1] == pytest.approx(1.0)


def test_timing_keeps_speed_and_acceleration(job):
    pytest.importorskip("toppra")
    cell, jobs = job
    slow, fast = (timed(cell, jobs, speed, 5.0) for speed in (0.01, 10.0))
    length = seam_rate(cell).mean() * 2 * np.pi
    for weld in (slow, fast):
        assert weld.seam[-1] == pytest.approx(length, rel=1e-6)
        assert (abs(weld.speed) <= 1.01 * speed_limits(cell)).all()
        assert abs(weld.acceleration).max() <= 5.0 * 1.05  # kept at the points of a grid
        assert abs(weld.speed[[0, -1]]).max() < 1e-6
    assert slow.time[-1] == pytest.approx(length / 0.01, rel=0.01)  # it starts and ends at rest
    assert np.allclose(slow.q[0], jobs.q[0, :, 0])
    assert fast.time[-1] < 0.2 * slow.time[-1]
    with pytest.raises(InputError, match="speed"):
        timed(cell, jobs, 0.0, 5.0)


def test_efforts_see_a_joint_that_moves_more(job):
    cell, jobs = job
    shaken = jobs.q.copy()
    shaken[:, 2, ::2, 0] += 0.5
    for effort in EFFORTS.values():
        assert effort(cell, replace(jobs, q=shaken))[0] > effort(cell, jobs)[0]


def test_angles_of_the_torch():
    """In the middle of the fillet by one rule; fixed in the world by the other."""
    seam = saddle_seam(0.10, 0.06, 36)
    for axis, largest in (("along_bisector", 0.0), ("work_angle_45", 45.0)):
        cell = make_cell(axis=axis)
        angles = torch_angles(cell, Placement(cell, Objective()).jobs(CENTRE), seam)
        for part in angles:
            # the seam is given by chords [deg]
            assert np.degrees(abs(part).max()) == pytest.approx(largest, abs=0.2)
    # where the welder leans straight along the seam there is travel and no work angle
    both = np.cos(angles.work) * np.cos(angles.travel)
    assert np.allclose(both, np.cos(np.pi / 4), atol=1e-6)


def test_the_way_out_is_reached_or_not(job):
    """It goes on from the joints of the weld: no arm changes its branch to let the torch go."""
    cell, jobs = job
    for point in range(0, cell.count, 6):
        way = retract(cell, jobs, point, 0.05)
        assert way.status[0] == Status.FEASIBLE
        assert np.allclose(way.q[0, :2], way.q[0, :2, :1])  # the carriers wait
        assert np.allclose(way.q[0, :, 0], jobs.q[0, :, point])
    assert retract(cell, jobs, 0, 2.0).status[0] == Status.OUT_OF_REACH
