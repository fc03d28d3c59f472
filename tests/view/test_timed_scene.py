"""A timed motion as a scene: pictures at equal times, and enough of them."""

import numpy as np
import pytest

from dualarm_repro.arms import load_arm
from dualarm_repro.planning.timing.timed_motion import timed
from dualarm_repro.scene import JointPath, PlacedArm, Scene
from dualarm_repro.view.timed_scene import timed_scene

ARM = load_arm("irb120")


@pytest.fixture(scope="module")
def motion():
    there = np.array([1.2, 0.3, 0.0, 0.0, 0.0, 0.0])
    path = JointPath([np.zeros(6), there])
    return timed(Scene([PlacedArm("arm", ARM)]), {"arm": path}, speed=0.5, acceleration=4.0)


def test_pictures_are_a_twentieth_of_a_second_apart(motion):
    made = timed_scene(motion, "A motion.")
    frames = made.contents.motion.frames
    count = int(np.ceil(20.0 * motion.duration))
    assert frames[-1] == count
    tips = made.contents.tips["arm"]
    assert len(tips) == count + 1
    time = np.linspace(0.0, motion.duration, count + 1)
    assert time[1] <= 1.0 / 20.0
    expected = [ARM.fk(q)[:3, 3] for q in motion.paths["arm"].at(time)]
    np.testing.assert_allclose(tips, expected, atol=1e-9)
    np.testing.assert_allclose(tips[-1], ARM.fk(motion.q[-1])[:3, 3], atol=1e-9)


def test_it_is_slow_at_its_ends(motion):
    """Equal times, not equal ways: the first step is shorter than one half way."""
    steps = np.linalg.norm(np.diff(timed_scene(motion, "t").contents.tips["arm"], axis=0), axis=1)
    assert steps[0] < 0.5 * steps[len(steps) // 2]
    assert steps[-1] < 0.5 * steps[len(steps) // 2]
