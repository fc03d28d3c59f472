"""Between the seam points: the certified separation and what linear interpolation loses."""

from itertools import pairwise

import numpy as np
import pytest

from dualarm_repro.welding import Objective, Placement, saddle_seam
from dualarm_repro.welding.between import certified_separation, interpolation_offset

from .cells import make_cell

CENTRE = np.array([[0.05, 0.1, 0.8]])


@pytest.fixture(scope="module")
def coarse():
    placement = Placement(make_cell(count=12), Objective())
    return placement, placement.jobs(CENTRE)


def test_the_bounds_enclose_a_dense_sample_of_the_motion(coarse):
    placement, jobs = coarse
    found = certified_separation(placement.cell, jobs, tolerance=1e-4)
    assert found.lower <= found.upper <= found.lower + 1.01e-4
    separation, cell = placement.separation, placement.cell
    closed = np.concatenate([jobs.q[0], jobs.q[0][:, :1]], axis=1)
    smallest = np.inf
    for n in range(cell.count):
        for part in np.linspace(0, 1, 21):
            q = (1 - part) * closed[:, n] + part * closed[:, n + 1]
            ends = separation.posed(q[np.newaxis], cell.rotations[[n]], CENTRE)
            arms = [not name.startswith("workpiece") for _, name in separation.pairs.names]
            smallest = min(smallest, separation.distances(ends)[0][arms].min())
    assert found.lower <= smallest + 1e-12


def test_enough_is_proved_at_less_cost_and_stays_a_bound(coarse):
    placement, jobs = coarse
    exact = certified_separation(placement.cell, jobs)
    rough = certified_separation(placement.cell, jobs, enough=0.0)
    assert 0.0 <= rough.lower <= exact.upper


def test_interpolation_loses_less_on_a_denser_seam():
    seam, offsets = saddle_seam(0.10, 0.06, 20_000).points, []
    for count in (18, 36, 72):
        placement = Placement(make_cell(count=count), Objective())
        offsets.append(interpolation_offset(placement.cell, placement.jobs(CENTRE), seam))
    for coarser, finer in pairwise(offsets):
        assert finer.step < 0.7 * coarser.step
        assert finer.seam < 0.4 * coarser.seam  # of second order
        assert 0 < finer.grips < 0.4 * coarser.grips
