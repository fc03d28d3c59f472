"""Between the seam points: the certified separation and what linear interpolation loses."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from dualarm_repro.welding import Objective, Placement, saddle_seam
from dualarm_repro.welding.between import (
    _Closed,
    _rates,
    certified_separation,
    interpolation_offset,
)

from .cells import make_cell

CENTRE = np.array([[0.05, 0.1, 0.8]])


@pytest.fixture(scope="module")
def coarse():
    placement = Placement(make_cell(count=12), Objective())
    return placement, placement.jobs(CENTRE)


def _along(placement, jobs, parts):
    """Distances of all pairs (M, K) and ways (M, 19) along the motion."""
    motion = _Closed(placement.cell, jobs)
    q, rotations, way = motion.at(np.linspace(0, placement.cell.count, parts + 1))
    ends = placement.separation.posed(q, rotations, np.repeat(CENTRE, parts + 1, axis=0))
    return placement.separation.distances(ends), way


def test_the_bounds_enclose_a_dense_sample_of_the_motion(coarse):
    placement, jobs = coarse
    found = certified_separation(placement.cell, jobs, tolerance=1e-4)
    assert found.lower <= found.upper <= found.lower + 1.01e-4
    smallest = _along(placement, jobs, 12 * 64)[0].min()
    assert found.lower <= smallest <= found.upper + 1e-4


def test_no_distance_changes_by_more_than_the_ways_allow(coarse):
    """What the certificate rests on, for every pair; and it is not loose beyond use."""
    placement, jobs = coarse
    distances, way = _along(placement, jobs, 12 * 64)
    changed = abs(np.diff(distances, axis=0))
    allowed = np.diff(way, axis=0) @ _rates(placement.cell, placement.separation.pairs).T
    assert (changed <= allowed + 1e-12).all()
    owners = placement.separation.owners
    for owner in ("workpiece", "torch", "floor"):
        of = np.array([owner in pair for pair in owners])
        assert (changed[:, of] / allowed[:, of]).max() > 0.25


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


def test_the_seam_is_met_as_either_carrier_holds_it(coarse):
    """Nothing is lost at the points themselves, and of two carriers the worse one counts."""
    placement, jobs = coarse
    seam = saddle_seam(0.10, 0.06, 20_000).points
    assert interpolation_offset(placement.cell, jobs, seam, parts=1).seam < 1e-5
    held = interpolation_offset(placement.cell, jobs, seam)
    shaken = jobs.q.copy()
    for carrier in (0, 1):
        shaken[:] = jobs.q
        shaken[:, carrier, ::2, 0] += 0.02
        moved = interpolation_offset(placement.cell, replace(jobs, q=shaken), seam)
        assert moved.seam > held.seam + 0.005
