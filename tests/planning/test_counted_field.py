"""Counting what a descent looks at changes nothing of it."""

import numpy as np
import pytest

from dualarm_repro.arms import load_arm
from dualarm_repro.planning.checks.counted_field import counted_descent
from dualarm_repro.planning.descent.apf import plan_apf
from dualarm_repro.planning.descent.problem import problem
from dualarm_repro.planning.field.obstacles import obstacles_of
from dualarm_repro.planning.settings import (
    APFSettings,
    Attraction,
    Repulsion,
    Termination,
    Trap,
    Update,
)
from dualarm_repro.scene import PlacedArm, Scene, Sphere

ARM = PlacedArm("arm", load_arm("es165d"))
START, GOAL = np.zeros(6), np.array([0.3, 0.1, 0.0, 0.0, 0.2, 0.0])


def settings(gain):
    return APFSettings(
        attraction=Attraction(gain=3.0, joint_weight=1.0),
        control_points="frames_2_6",
        repulsion=Repulsion(gain=1.0, influence=0.3),
        update=Update(rule="gradient", gain=gain, max_step=0.02),
        termination=Termination(
            joint_tolerance=0.02,
            step_limit=300,
            trap=Trap(rule="block_means", steps=50, threshold=1e-3),
        ),
    )


def counted(gain, spheres):
    scene = Scene([ARM], {"ball": spheres} if spheres else {})
    made = problem(ARM, START, GOAL, obstacles_of(scene), settings(gain))
    record, looks = counted_descent(made)
    plan = plan_apf(ARM, START, GOAL, obstacles_of(scene), made.settings)
    np.testing.assert_array_equal(record.path, plan.path)
    return plan.steps, looks


def test_a_descent_that_never_shortens_a_step_looks_four_times_a_step():
    steps, looks = counted(0.05, ())
    assert looks == 4 * steps + 1  # potential, gradient, potential again, trial; and the end


@pytest.mark.parametrize("offset", [0.18])
def test_steps_that_are_halved_cost_more(offset):
    flange = ARM.arm.positions(0.5 * (START + GOAL))
    steps, looks = counted(0.05, (Sphere(flange + np.array([0.0, 0.0, offset]), 0.05),))
    assert looks > 4 * steps + 1
