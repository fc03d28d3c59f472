"""A slave searched around its moving master, and both played in step and out of step."""

import numpy as np
import pinocchio as pin
import pytest
from two_spheres import GOAL, START, obstacles, placed_arm, settings

from dualarm_repro.planning.field.hull_obstacle import JointCircles
from dualarm_repro.planning.search.bidirectional_compiled import plan_bidirectional_compiled
from dualarm_repro.planning.search.dual_search import search_around
from dualarm_repro.scene import PlacedArm, Scene

CIRCLES = JointCircles((1, 3, 5, 7), (0.09, 0.08, 0.06, 0.04), 8)


@pytest.fixture(scope="module")
def both():
    master, chosen = placed_arm(), settings()
    away = pin.SE3(pin.utils.rotate("z", np.pi / 2), np.array([-0.35, 0.0, 0.0]))
    slave = PlacedArm("slave", master.arm, away)
    plan = plan_bidirectional_compiled(master, START, GOAL, obstacles(), chosen)
    return search_around(
        plan, slave, (START, -GOAL), obstacles(), chosen, CIRCLES, 20, lambda path: path
    )


def test_both_begin_and_end_where_they_shall(both):
    for how in ("time map", "uniform"):
        master, slave = both.played(how)
        assert len(master) == len(slave)
        assert master[[0, -1]] == pytest.approx(np.array([START, GOAL]))
        assert slave[[0, -1]] == pytest.approx(np.array([START, -GOAL]))
    assert both.reached


def test_a_shifted_master_is_ahead_by_as_many_samples(both):
    steps = [np.linalg.norm(both.played(shift=k)[0][0] - START) for k in (0, 2, 4)]
    assert steps[0] == 0.0 < steps[1] < steps[2]


def test_contact_is_that_of_the_stacked_configurations(both):
    scene = Scene(list(both.arms), {})
    q = both.stacked(scene)
    assert q == pytest.approx(np.hstack(both.played()))
    assert both.contact(scene).clearance["arms"] > -1.0
    assert [len(tip) for tip in both.tips()] == [len(q)] * 2
