"""Random tasks, the search among them, scenarios that can be run, and joint ranges."""

from dataclasses import replace

import numpy as np
import pytest

from dualarm_repro import load_arm
from dualarm_repro.control import task_search
from dualarm_repro.control.frozen import FrozenScenario
from dualarm_repro.control.joint_ranges import random_configuration
from dualarm_repro.control.random_tasks import (
    CircleTask,
    admissible,
    draw_task,
    lowest,
    naive_motion,
    own_clearance,
    stands_clear,
)
from dualarm_repro.control.scenario import load_scenario
from dualarm_repro.control.settings import ControllerSettings
from dualarm_repro.control.system import ArmSystem
from dualarm_repro.control.task_search import CROSSING, TO_LIMITS, TOO_CLOSE, score, search_task
from dualarm_repro.datafiles import data_path
from dualarm_repro.errors import ConfigurationError, UnknownNameError
from dualarm_repro.scene import PlacedArm

RADII = (0.1, 0.2)


def test_random_configurations_stay_within_their_ranges(system):
    rng = np.random.default_rng(0)
    q = np.array([random_configuration(system, rng) for _ in range(50)])
    assert (q > system.limits.lower).all()
    assert (q < system.limits.upper).all()
    assert np.abs(q).max() <= np.pi


def test_joints_that_turn_for_ever_are_drawn_within_a_turn():
    kinova = ArmSystem([PlacedArm("arm", load_arm("kinova-j2s6s200"))])
    q = np.array([draw_task(kinova, np.random.default_rng(k), RADII).q0 for k in range(40)])
    for_ever = kinova.arms[0].arm.turns_for_ever
    assert np.isfinite(q).all()
    assert np.abs(q[:, for_ever]).max() <= 0.9 * np.pi
    assert np.abs(q[:, for_ever]).max() > 0.8 * np.pi


def test_drawn_tasks_are_of_the_stream_and_start_at_the_tips(system):
    task, same = (draw_task(system, np.random.default_rng(3), RADII) for _ in range(2))
    np.testing.assert_array_equal(task.q0, same.q0)
    arrays = system.arrays
    reach = 0.45 * (arrays.upper - arrays.lower).clip(max=2 * np.pi)
    assert (np.abs(task.q0 - 0.5 * (arrays.upper + arrays.lower)) <= reach).all()
    assert RADII[0] <= task.radius <= RADII[1]
    circles = task.circles(system, duration=4.0)
    np.testing.assert_allclose(circles.at(0.0)[0], system.tips(task.q0), atol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(circles.u, axis=1), task.radius)
    assert circles.duration == 4.0


def test_a_naive_motion_counts_if_it_follows_and_starts_apart(crossing):
    task, settings = frozen_task("crossing_xarm7"), ControllerSettings()
    naive = naive_motion(crossing.system, task, settings)
    assert admissible(naive, settings)
    assert not admissible(naive, settings.changed(outer=naive.distance[0] + 0.01))
    assert not admissible(replace(naive, error=naive.error + 2e-3), settings)
    assert not admissible(replace(naive, stopped="failed"), settings)


def test_a_task_stands_clear_of_itself_and_of_the_floor(crossing):
    system = crossing.system
    drawn = (draw_task(system, np.random.default_rng([6, k]), RADII) for k in range(100))
    task = next(one for one in drawn if stands_clear(system, one))
    assert lowest(system, task.q0) > 0.0
    arrays = system.arrays
    folded = next(
        q
        for q in np.random.default_rng(1).uniform(arrays.lower, arrays.upper, (200, system.nq))
        if own_clearance(system, q) <= 0.0
    )
    assert not stands_clear(system, replace(task, q0=folded))
    sunk = next(
        q
        for q in np.random.default_rng(2).uniform(arrays.lower, arrays.upper, (200, system.nq))
        if lowest(system, q) < 0.0
    )
    assert not stands_clear(system, replace(task, q0=sunk))
    assert not stands_clear(system, replace(task, radius=5.0))


def test_scores_are_those_of_the_wanted_task(crossing):
    task, settings = frozen_task("crossing_xarm7"), ControllerSettings()
    assert score(crossing.system, task, CROSSING, settings) > 0.0
    assert score(crossing.system, task, TO_LIMITS, settings) is None
    assert score(crossing.system, task, TOO_CLOSE, settings) is None
    small = replace(task, radius=0.01)
    assert score(crossing.system, small, CROSSING, settings) is None


def test_the_search_finds_the_smoothest_draw(system, monkeypatch):
    peaks = {0: None, 1: 5.0, 2: 3.0, 3: None, 4: 4.0}
    asked = iter(peaks.values())
    monkeypatch.setattr(task_search, "score", lambda *_: next(asked))
    found = search_task(system, CROSSING, len(peaks), seed=7, radii=RADII)
    assert (found.draw, found.among) == (2, 3)
    np.testing.assert_array_equal(
        found.task.q0, draw_task(system, np.random.default_rng([7, 2]), RADII).q0
    )


def test_a_search_in_vain_finds_nothing(system):
    assert search_task(system, TOO_CLOSE, 1, seed=7, radii=RADII) is None


def test_scenarios_follow_their_file_and_what_is_changed():
    file, arm = scenario("crossing_xarm7"), load_arm("xarm7")
    plain = FrozenScenario.of(file, arm)
    changed = FrozenScenario.of(file, arm, base_distance=0.8, duration=5.0, law="constant_speed")
    assert plain.period == file.duration
    assert changed.period == 5.0
    assert changed.circles.law == "constant_speed"
    apart = [s.system.tips(s.q0)[0] - s.system.tips(s.q0)[1] for s in (plain, changed)]
    np.testing.assert_allclose(apart[1] - apart[0], [0.0, 0.2, 0.0], atol=1e-12)
    assert plain.parts == (plain.system, plain.circles, plain.q0)


def test_bad_scenarios_are_refused():
    file, arm = scenario("crossing_xarm7"), load_arm("xarm7")
    with pytest.raises(UnknownNameError, match="law"):
        FrozenScenario.of(file, arm, law="sudden")
    with pytest.raises(ConfigurationError):
        FrozenScenario.of(file, load_arm("irb120"))


def scenario(name):
    return load_scenario(data_path("scenes", f"patent_{name}.yaml"))


def frozen_task(name):
    file = scenario(name)
    q0 = np.array([*file.left.q, *file.right.q])
    normals = np.array([file.left.normal, file.right.normal])
    return CircleTask(q0, normals, np.array([file.left.angle, file.right.angle]), file.radius)
