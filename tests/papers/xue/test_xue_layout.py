"""Printed inputs and the arrangement."""

from dataclasses import replace

import numpy as np
import pytest

from dualarm_repro.errors import InputError
from dualarm_repro.papers.xue.document import (
    gains,
    master_goal,
    master_start,
    placed_slave,
    slave_end,
    slave_start,
    workspace_points,
)
from dualarm_repro.papers.xue.motions import slave_task
from dualarm_repro.papers.xue.reading import nominal


def test_inputs_are_those_of_print(registry):
    """The one copy of the numbers beside the ledger."""
    np.testing.assert_array_equal(master_start(), np.zeros(6))
    goal = np.pi * np.array([-1 / 2, -1 / 8, -1 / 2, 1 / 2, 1 / 4, 0])
    np.testing.assert_allclose(master_goal(), goal, rtol=1e-15)
    assert slave_start().tolist() == [0.75, 0.35, 0.5]
    assert slave_end().tolist() == [-0.45, 0.8, 0.15]
    assert gains() == {"k_a": 3.0, "k_w": 2.0, "k_r": 1.0, "d_0": 0.3}
    assert workspace_points() == 100_000


def test_slave_starts_and_ends_where_printed(registry):
    slave = placed_slave(nominal().layout)
    for q, point in ((slave.start, slave_start()), (slave.goal, slave_end())):
        reached = slave.placement.act(slave.arm.fk(q)[:3, 3])
        np.testing.assert_allclose(reached, point, atol=1e-12)


def test_far_base_leaves_no_slave(registry):
    case = nominal(base_distance=9.0)
    assert placed_slave(case.layout) is None
    with pytest.raises(InputError, match="slave"):
        slave_task(case)


def test_what_is_changed_reaches_every_part_of_a_case(registry):
    given = nominal()
    case = nominal(window_bar=0.07, update_rule="neighbour_search", equal_speed_meaning="same_step")
    assert case.layout == replace(given.layout, window_bar=0.07)
    assert case.planner == replace(given.planner, update_rule="neighbour_search")
    assert case.encounter.equal_speed_meaning == "same_step"


@pytest.mark.parametrize("normal", ["x", "y", "chord"])
def test_window_has_the_opening_asked_for(registry, normal):
    layout = replace(nominal().layout, window_normal=normal)
    top, bottom, left, right = layout.window()
    vertical = np.linalg.norm(top.center - bottom.center) - top.size[1]
    across = np.linalg.norm(left.center - right.center) - left.size[0]
    assert vertical == pytest.approx(layout.window_opening_height)
    assert across == pytest.approx(layout.window_opening_width)
    np.testing.assert_allclose(0.5 * (top.center + bottom.center), layout.window_centre)
