"""Adjacent shapes: what touches always or at home says nothing, a stop the limits miss does."""

import numpy as np
import pytest

from dualarm_repro.arms import Evidence, load_arm
from dualarm_repro.scene import Box, Capsule, PlacedArm, Scene, distances
from dualarm_repro.scene.tool import with_tool

BALL = "<collision><origin xyz='{} 0 0'/><geometry><sphere radius='{}'/></geometry></collision>"


def arm_of(folder, first, second, home=(-3.0, 3.0)):
    """Two links that turn about one point, each with balls (place along x, radius)."""
    parts = [
        f"<link name='l{k}'>{''.join(BALL.format(*one) for one in balls)}</link>"
        for k, balls in enumerate((first, second))
    ]
    low, high = home
    parts.append(
        "<joint name='j' type='revolute'><parent link='l0'/><child link='l1'/><axis xyz='0 0 1'/>"
        f"<limit lower='{low}' upper='{high}' effort='1' velocity='1'/></joint>"
    )
    path = folder / "arm.urdf"
    path.write_text(f"<robot name='r'>{''.join(parts)}</robot>", encoding="utf-8")
    return load_arm(path)


def test_a_stop_that_the_limits_miss_is_watched(tmp_path):
    """Balls at -0.3 and 0.3 m meet where the joint turns by pi - 2 asin(0.1 / 0.6)."""
    arm = arm_of(tmp_path, [(-0.3, 0.05)], [(0.3, 0.05)])
    (one,) = arm.neighbours
    assert arm.exclusions == ()
    assert 0 < one.touching < one.sampled
    assert "adjacent and watched" in str(one)
    scene = Scene([PlacedArm("a", arm)])
    angle = np.pi - 2.0 * np.arcsin(0.1 / 0.6)
    found = distances(scene, np.array([[angle - 0.01], [angle + 0.01], [0.0]]))[:, 0]
    assert (found > 0.0).tolist() == [True, False, True]
    assert found[2] == pytest.approx(0.5, abs=1e-6)


@pytest.mark.parametrize(
    ("first", "second", "listed"),
    [
        ([(0.0, 0.1)], [(0.05, 0.1)], 1),  # always
        ([(0.3, 0.05)], [(0.3, 0.05)], 1),  # at home
        ([(0.3, 0.05)], [(0.401, 0.05)], 0),  # never: 1 mm apart at home and more elsewhere
        ([(-0.3, 0.05)], [(0.6, 0.05)], 0),  # never
    ],
)
def test_what_says_nothing(tmp_path, first, second, listed):
    arm = arm_of(tmp_path, first, second)
    assert arm.neighbours == ()
    assert [one.evidence for one in arm.exclusions] == [Evidence.ADJACENT] * listed
    assert len(Scene([PlacedArm("a", arm)]).pairs) == 0


def test_a_tool_meets_the_link_before_the_flange(tmp_path):
    """A bar that the last joint turns into a ball of the link before it; a straight tool cannot."""
    bent, straight = Capsule((0.3, 0, 0), (0.3, 0, 0.1), 0.02), Box((0, 0, 0.3), (0.05, 0.05, 0.1))
    arm = arm_of(tmp_path, [(-0.3, 0.05)], [(0.0, 0.01)])
    held = with_tool(arm, [bent])
    assert [{one.first, one.second} for one in held.neighbours] == [{"l0_0", "tool_0"}]
    scene = Scene([PlacedArm("a", held)])
    assert (distances(scene, np.array([[3.0], [0.0]])) > 0.0).all(axis=1).tolist() == [False, True]
    assert with_tool(arm, [straight]).neighbours == ()


def test_arms_of_tables_have_none_and_their_tools_may():
    arm = load_arm("irb120")
    assert arm.neighbours == ()
    assert with_tool(arm, [Box((0, 0, 0.05), (0.05, 0.05, 0.1))]).neighbours == ()
    bent = Capsule((0.1, 0, 0.02), (0.1, 0, -0.25), 0.02)
    (one,) = with_tool(load_arm("xarm7"), [bent]).neighbours
    assert {one.first, one.second} == {"link6_0", "tool_0"}
