"""What a motion costs, and how it leaves the house as a table."""

from dataclasses import replace

import numpy as np
import pinocchio as pin
import pytest

from dualarm_repro.control.controller import VelocityController
from dualarm_repro.control.effort import effort
from dualarm_repro.control.settings import ControllerSettings
from dualarm_repro.control.simulate import simulate
from dualarm_repro.control.solvers import solve
from dualarm_repro.control.trajectory import trajectories, trajectory


@pytest.fixture(scope="module")
def motion(crossing):
    return simulate(*crossing.parts, ControllerSettings(), dt=1e-2)


def test_slow_work_is_the_change_of_potential_energy(crossing, motion):
    # A hundred times as slow nothing is left of inertia, and power is that against gravity.
    slow = replace(motion, dt=100 * motion.dt, x=motion.x / 100)
    placed = crossing.system.arms
    data = [one.arm.model.createData() for one in placed]
    heights = np.array(
        [
            sum(
                pin.computePotentialEnergy(one.arm.model, d, part)
                for one, d, part in zip(placed, data, np.split(q, 2), strict=True)
            )
            for q in motion.q
        ]
    )
    paid = effort(crossing.system, slow)
    assert paid.driven >= paid.work / 2 - np.ptp(heights)
    assert paid.work >= np.abs(np.diff(heights)).sum() * 0.99
    # kinetic energy of a slow motion, which the potential leaves out [J]
    assert 2 * paid.driven - paid.work == pytest.approx(heights[-1] - heights[0], abs=0.1)


def test_heat_is_that_of_holding_still(crossing, motion):
    still = replace(motion, q=np.tile(motion.q[0], (len(motion.q), 1)), x=0.0 * motion.x)
    paid = effort(crossing.system, still)
    torque = np.concatenate(
        [
            pin.computeGeneralizedGravity(one.arm.model, one.arm.model.createData(), part)
            for one, part in zip(crossing.system.arms, np.split(motion.q[0], 2), strict=True)
        ]
    )
    assert (paid.work, paid.driven) == (0.0, 0.0)
    assert paid.heat == pytest.approx(len(motion.x) * motion.dt * (torque**2).sum())


def test_a_table_holds_what_was_run(crossing, motion):
    made = trajectory(crossing.system, crossing.circles, motion)
    assert len(made) == len(motion.q)
    assert made["left_q3 [rad]"].to_numpy() == pytest.approx(motion.q[:, 2], abs=1e-9)
    assert made["right_v7 [rad/s]"].to_numpy()[:-1] == pytest.approx(motion.x[:, 13], abs=1e-9)
    assert np.isnan(made["right_v7 [rad/s]"].iloc[-1])
    position, velocity = crossing.circles.at(motion.time[40])
    assert made["right_y [m]"][40] == pytest.approx(position[1, 1], abs=1e-9)
    assert made["left_vz [m/s]"][40] == pytest.approx(velocity[0, 2], abs=1e-9)
    both = trajectories({name: (*crossing.parts[:2], motion) for name in ("a", "b")})
    assert list(both["motion"].unique()) == ["a", "b"]
    assert both.columns[0] == "motion"


def test_smoothing_minimises_the_distance_from_the_answer_before_as_well(crossing):
    smooth = simulate(*crossing.parts, ControllerSettings(), dt=1e-2, smoothing=10.0)
    controller = VelocityController(crossing.system)
    for k in range(1, len(smooth.x), 97):
        p = controller.problem(smooth.q[k], *crossing.circles.at(smooth.time[k]))
        shifted = replace(p, target=10.0 * smooth.x[k - 1] / 11.0)
        assert smooth.x[k] == pytest.approx(solve(shifted).x, abs=1e-8)
    assert smooth.mean_speed > 0.0
