"""True clearance: whole links, between the steps, all arms over the whole time."""

import numpy as np
import pytest
from window_scene import (
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

from dualarm_repro.errors import InputError, UnknownNameError
from dualarm_repro.planning import (
    certified_clearance,
    link_clearance,
    plan_apf_compiled,
    require_links_clear,
)
from dualarm_repro.scene import Capsule, JointPath, Scene, Sphere, clearance

SLAVE_PATH = plan_apf_compiled(SLAVE, START, GOAL, around(), IMPROVED).joint_path()
MASTER_PATH = JointPath(np.linspace(MASTER_START, MASTER_GOAL, 200))


def test_distances_are_those_of_the_scene_with_both_arms_in_step():
    found = link_clearance(scene(), {"slave": SLAVE_PATH, "master": MASTER_PATH}, 0.01)
    assert (found.index[0], found.index[-1]) == (0.0, 199.0)
    for row in (0, 57, len(found.index) - 1):
        time = found.index[row : row + 1]
        both = scene().stack(master=MASTER_PATH.at(time)[0], slave=SLAVE_PATH.at(time)[0])
        assert found.q[row] == pytest.approx(both)
        assert found.distance[row] == pytest.approx(clearance(scene(), both).distance, abs=1e-12)
    assert np.abs(np.diff(found.q, axis=0)).max() <= 0.01 + 1e-12
    pair, index = found.nearest
    assert found.to_frame()[" - ".join(pair)].min() == found.minimum
    assert found.to_frame()[" - ".join(pair)].loc[index] == found.minimum


def test_an_arm_that_has_arrived_is_still_there():
    """The slave waits at its goal while the master goes on: contact after the end still counts."""
    found = link_clearance(scene(), {"slave": SLAVE_PATH, "master": MASTER_PATH}, 0.05)
    late = found.index > SLAVE_PATH.index[-1]
    assert late.any()
    assert found.q[late][:, 6:] == pytest.approx(
        np.tile(SLAVE_PATH.configurations[-1], (late.sum(), 1))
    )


def test_contact_between_two_steps_is_seen():
    """A thin wall that the tool crosses within one step of a coarse path."""
    q = np.array([MASTER_START, MASTER_START + np.array([0.4, 0, 0, 0, 0, 0])])
    middle = MASTER.placement.act(MASTER.arm.positions(q.mean(axis=0)))
    wall = Capsule(middle - np.array([0, 0, 0.2]), middle + np.array([0, 0, 0.2]), 0.01)
    there = Scene([MASTER], {"wall": wall}, self_collision=False)
    assert clearance(there, q).minimum.min() > 0.0
    path = {"master": JointPath(q)}
    found = link_clearance(there, path, 0.01)
    assert found.minimum < 0.0
    assert 0.0 < found.nearest[1] < 1.0
    bracket = certified_clearance(there, path)
    assert bracket.lower <= bracket.upper <= found.minimum + 1e-9
    assert bracket.upper - bracket.lower <= 1e-3


def test_arms_without_a_path_are_left_out():
    alone = link_clearance(scene(), {"slave": SLAVE_PATH}, 0.05)
    assert alone.q.shape[1] == 6
    assert all("master" not in name for pair in alone.pairs for name in pair)
    with pytest.raises(UnknownNameError, match="one of master, slave"):
        link_clearance(scene(), {"left": SLAVE_PATH}, 0.05)


def test_links_that_touch_at_the_start_are_named():
    require_links_clear(scene(), {"slave": START})
    elbow = SLAVE.placement.act(SLAVE.arm.joint_positions(START)[2])
    blocked = scene(ball=Sphere(elbow, 0.05))
    with pytest.raises(
        InputError, match=r"slave/capsule_\S+ and ball apart, not at a distance of -"
    ):
        require_links_clear(blocked, {"slave": START})
    require_links_clear(blocked, {"master": MASTER_START})
