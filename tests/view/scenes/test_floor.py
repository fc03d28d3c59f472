"""The grid on the floor: round cells, as wide as the action, no gap and no overlap."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualarm_repro.view.scenes.floor import Floor

PLACES = st.lists(
    st.tuples(*[st.floats(-3.0, 3.0, allow_nan=False)] * 3), min_size=1, max_size=6
).map(np.array)


@settings(max_examples=40)
@given(PLACES)
def test_the_grid_lies_under_all_points_and_hardly_beyond(points):
    floor = Floor.under(points, -0.2)
    low, high = points[:, :2].min(axis=0), points[:, :2].max(axis=0)
    assert (np.array(floor.low) <= low + 1e-9).all()
    assert (np.array(floor.high) >= high - 1e-9).all()
    assert (low - floor.low < floor.cell + 1e-9).all()
    assert (floor.high - high < floor.cell + 1e-9).all()
    shares = np.array([*floor.low, *floor.high]) / floor.cell
    np.testing.assert_allclose(shares, shares.round(), atol=1e-9)
    assert floor.height == -0.2


@pytest.mark.parametrize(
    ("width", "cell"), [(0.01, 0.05), (0.8, 0.1), (1.6, 0.2), (4.0, 0.5), (8.0, 1.0), (90.0, 2.0)]
)
def test_cells_are_round(width, cell):
    floor = Floor.under(np.array([[0.0, 0.0, 0.0], [width, 0.5 * width, 1.0]]), 0.0)
    assert floor.cell == cell


def test_lines_are_the_edges_of_all_cells_once():
    """Of a grid of 2 by 3 cells: 3 * 4 - 2 lines of one cell each along x, and so on."""
    floor = Floor(0.5, 0.25, (-0.25, 0.0), (0.25, 0.75))
    lines = floor.lines()
    assert lines.shape == (2 * 4 + 3 * 3, 2, 3)
    np.testing.assert_allclose(np.linalg.norm(lines[:, 1] - lines[:, 0], axis=1), 0.25)
    np.testing.assert_array_equal(lines[..., 2], 0.5)
    assert len({tuple(np.round(line, 6).ravel()) for line in lines}) == len(lines)
    assert lines[..., 0].min() == -0.25
    assert lines[..., 1].max() == 0.75
