"""What two motions show: tips, points, openings, and clearance of links for every radius."""

import numpy as np
import pytest
from window_scene import (
    CENTRE,
    GOAL,
    IMPROVED,
    MASTER,
    MASTER_GOAL,
    MASTER_START,
    SLAVE,
    START,
    around,
    scene,
)

from dualarm_repro.errors import UnknownNameError
from dualarm_repro.planning import link_clearance, plan_apf_compiled
from dualarm_repro.planning.field.control_points import end_effector
from dualarm_repro.planning.trials.encounter import inside_opening, to_obstacles
from dualarm_repro.planning.trials.link_cores import link_cores
from dualarm_repro.planning.trials.replay import Replay
from dualarm_repro.scene import JointPath, facing

PLAN = plan_apf_compiled(SLAVE, START, GOAL, around(), IMPROVED)
TRACK = JointPath(np.linspace(MASTER_START, MASTER_GOAL, PLAN.steps + 31))
REPLAY = Replay(PLAN, MASTER, TRACK, around())
PATHS = {"master": TRACK, "slave": PLAN.joint_path()}
FACING = facing((1.0, 0.0, 0.0))


def test_an_arm_that_has_arrived_waits():
    times, apart = REPLAY.times, REPLAY.apart()
    assert (times[0], times[-1]) == (0, PLAN.steps + 30)
    for k in (0, 7, len(times) - 1):
        other = end_effector(MASTER, TRACK.at(times[k : k + 1]))[0]
        assert apart[k] == pytest.approx(np.linalg.norm(PLAN.tcp[min(k, PLAN.steps)] - other))
    short = JointPath(TRACK.configurations[:5])
    assert len(Replay(PLAN, MASTER, short, around()).apart()) == PLAN.steps + 1


def test_while_it_moves_is_the_beginning_of_it():
    moving = REPLAY.apart(moving=True)
    assert len(moving) == PLAN.steps + 1
    assert np.array_equal(moving, REPLAY.apart()[: PLAN.steps + 1])


def test_points_to_obstacles_are_those_the_planner_kept():
    found = to_obstacles(PLAN, "frames_2_6", around())
    assert found.shape == (PLAN.steps + 1, 5)
    assert found.min() == pytest.approx(PLAN.clearance.min(), abs=1e-12)
    flange = to_obstacles(PLAN, "end_effector", around())
    assert flange[:, 0] == pytest.approx(found[:, -1])


@pytest.mark.parametrize(
    ("offset", "expected"), [((0.0, 0.0), 0.45), ((0.3, 0.0), 0.15), ((0.0, 0.6), -0.05)]
)
def test_opening_is_passed_by_the_distance_to_its_edge(offset, expected):
    ends = CENTRE + np.array([[-0.5], [0.5]]) * FACING[:, 2] + np.array(offset) @ FACING[:, :2].T
    assert inside_opening(ends, CENTRE, FACING, (0.9, 1.1)) == pytest.approx(expected)


def test_an_opening_that_is_not_reached_is_not_passed():
    ends = CENTRE + np.array([[-0.5], [-0.1]]) * FACING[:, 2]
    assert inside_opening(ends, CENTRE, FACING, (0.9, 1.1)) == -np.inf


def test_cores_less_the_radii_are_the_clearance_of_links():
    cores, links = link_cores(scene(), PATHS, 0.05), link_clearance(scene(), PATHS, 0.05)
    radii = cores.found.distance - links.distance
    assert (radii >= 0.0).all()
    assert radii == pytest.approx(np.tile(radii[0], (len(radii), 1)))
    first, second = cores.nearest("slave", "window")
    assert (first.partition("/")[0], second.partition("/")[0]) == ("slave", "window")
    column = cores.found.pairs.index((first, second))
    assert cores.found.distance[:, column].min() == cores.between("slave", "window").min()
    assert np.array_equal(cores.between("master", "slave"), cores.between("slave", "master"))


def test_an_arm_the_scene_lacks_is_named():
    with pytest.raises(UnknownNameError):
        link_cores(scene(), {"third": TRACK}, 0.05)
