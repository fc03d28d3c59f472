"""Measures of a path that do not depend on how it is sampled."""

import numpy as np
import pytest

from dualarm_repro.planning.checks.path_measures import MEASURES, bending, chatter, until_rest


def _arc(count, radius=2.0):
    angle = np.linspace(0.0, 1.0, count)
    return radius * np.column_stack([np.cos(angle), np.sin(angle)])


def test_bending_of_an_arc_is_its_squared_curvature_however_it_is_sampled():
    found = [bending(_arc(count), 0.05) for count in (100, 400, 2000)]
    # chords of 0.05 m instead of the arc
    assert found == pytest.approx([0.25] * 3, rel=2e-3)
    assert bending(np.linspace([0.0, 0.0], [1.0, 2.0], 30), 0.05) == pytest.approx(0.0, abs=1e-15)


def test_a_path_that_chatters_at_its_end_is_cut_there():
    way = np.linspace(0.0, 1.0, 21)[:, np.newaxis]
    path = np.vstack([way, 1.0 + 0.01 * (-1.0) ** np.arange(60)[:, np.newaxis]])
    assert 18 <= until_rest(path, 0.02) <= 21
    assert until_rest(np.zeros((30, 1)), 0.02) == 0


@pytest.mark.parametrize("measure", MEASURES)
def test_chatter_tells_a_zigzag_from_a_slope(measure):
    slope = np.linspace(0.0, 1.0, 60)
    zigzag = 0.02 * (-1.0) ** np.arange(60)
    assert chatter(slope, measure, 0.033) < 0.05
    assert chatter(zigzag, measure, 0.033) > 0.5


def test_peak_to_peak_is_a_share_of_a_full_step():
    zigzag = 0.02 * (-1.0) ** np.arange(60)
    full, half = (chatter(zigzag, "peak_to_peak", step) for step in (0.04, 0.08))
    assert full == pytest.approx(2.0 * half)
    assert full == pytest.approx(0.8)  # a running mean of five leaves a fifth of the zigzag
