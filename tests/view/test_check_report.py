"""What `check` gives away: distances of paths and of ends, who begins and who arrives."""

import numpy as np
import pandas as pd
import pinocchio as pin
import pytest

from dualarm_repro.arms import load_arm
from dualarm_repro.errors import DualArmError
from dualarm_repro.scene import PlacedArm, Scene, distances
from dualarm_repro.view.check_report import (
    away_from_starts,
    begins,
    check_scene,
    check_summary,
    checked_paths,
    loaded,
)

START, GOAL = [0, 0.2, 0, 0, 0.3, 0], [0.5, 0.2, 0, 0, 0.3, 0]
TASKS = f"""
arms:
  left: {{robot: irb120, xyz: [0, 0.6, 0], start: {START}, goal: {GOAL}}}
  right: {{robot: irb120, xyz: [0, -0.6, 0], start: [0, 0, 0, 0, 0, 0]}}
"""
#: The right arm stands with its flange where that of the left one is.
TOUCHING = TASKS.replace("xyz: [0, -0.6, 0]", "xyz: [0, 0.62, 0]")


@pytest.fixture
def write(tmp_path):
    def written(text, name="scene.yaml"):
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return path

    return written


@pytest.fixture
def given(write):
    return loaded(write(TASKS))


def path_file(write, rows, arm="left"):
    table = pd.DataFrame(rows, columns=[f"q{j + 1}" for j in range(6)])
    return write(table.to_csv(index=False), f"{arm}.csv")


def expected_distance(rows):
    """Smallest distance of the scene at rows of the left arm, by the library's scene alone."""
    arms = [PlacedArm(name, load_arm("irb120"), pin.SE3(np.eye(3), np.array([0.0, y, 0.0])))
            for name, y in (("left", 0.6), ("right", -0.6))]  # fmt: skip
    scene = Scene(arms)
    return min(float(distances(scene, np.concatenate([q, np.zeros(6)])).min()) for q in rows)


def test_without_a_path_the_start_is_judged(given):
    found = check_summary(given, [])
    assert found["begun"] is found["reached"] is found["usable"] is True
    lower, upper = found["links"]["bracket_m"]
    assert lower <= expected_distance([START]) <= upper + 1e-9
    assert found["links"]["collision_free"] is True
    assert found["within_limits"] is True
    assert found["arms"] == {name: {"away_from_start": 0.0} for name in ("left", "right")}
    assert found["outcome"] == "arrived, certified free"


def test_a_path_from_start_to_goal_is_usable(given, write):
    rows = np.linspace(START, GOAL, 5)
    found = check_summary(given, [path_file(write, rows)])
    assert found["arms"]["left"] == {"away_from_start": 0.0, "reached": True}
    assert found["arms"]["right"] == {"away_from_start": 0.0}
    assert found["usable"] is True
    assert found["links"]["minimum_distance_m"] <= expected_distance(np.linspace(START, GOAL, 200))


def test_a_path_that_ends_early_has_not_arrived(given, write):
    rows = np.linspace(START, 0.5 * (np.array(START) + GOAL), 5)
    found = check_summary(given, [path_file(write, rows)])
    assert found["arms"]["left"]["reached"] is found["reached"] is found["usable"] is False
    assert found["outcome"] == "not arrived"


def test_a_path_that_does_not_begin_at_the_start_is_not_usable(given, write):
    begin = np.array(START, dtype=float)
    begin[1] -= 0.25
    found = check_summary(given, [path_file(write, np.linspace(begin, GOAL, 5))])
    assert found["arms"]["left"]["away_from_start"] == pytest.approx(0.25)
    assert found["begun"] is found["usable"] is False
    assert found["reached"] is True
    assert found["outcome"] == "not from the start"


def test_a_path_beyond_the_limits_is_told(given, write):
    beyond = np.array(START, dtype=float)
    beyond[5] = load_arm("irb120").upper[5] + 0.2
    found = check_summary(given, [path_file(write, [START, beyond, GOAL])])
    assert found["within_limits"] is found["usable"] is False
    assert "beyond joint limits" in found["outcome"]


def test_a_start_in_contact_is_refused_unless_it_is_allowed(write):
    given = loaded(write(TOUCHING))
    with pytest.raises(DualArmError, match="left"):
        check_summary(given, [])
    found = check_summary(given, [], allow_collision=True)
    assert found["usable"] is False
    assert found["links"]["minimum_distance_m"] < 0.0
    assert found["outcome"] == "COLLISION"


def test_an_arm_without_a_path_stays_where_it_is_parked(given, write):
    rows = np.linspace(START, GOAL, 4)
    paths = checked_paths(given, [path_file(write, rows)])
    np.testing.assert_allclose(paths["left"].configurations, rows)
    np.testing.assert_allclose(paths["right"].configurations, np.zeros((1, 6)))
    away = away_from_starts(given, paths)
    assert away == pytest.approx({"left": 0.0, "right": 0.0})
    assert begins(away)
    assert not begins({"left": 0.0, "right": 2e-3})


def test_a_scene_shows_the_path_and_faintly_the_goal(given, write):
    rows = np.linspace(START, GOAL, 7)
    made = check_scene(given, [path_file(write, rows)], "A path.")
    motion = made.contents.motion
    assert motion.frames.tolist() == [0, 3, 6]
    goal = made.contents.nodes["left at its goal/6"][:3, 3]
    np.testing.assert_allclose(motion.poses["left/6"][-1][:3, 3], goal, atol=1e-9)
    ghosts = [part for part in made.contents.parts if part.node.startswith("left at its goal")]
    assert ghosts
    assert all(part.opacity < 0.5 for part in ghosts)
    assert not [p for p in made.contents.parts if p.node.startswith("right at its goal")]
    still = check_scene(given, [], "Ends.")
    assert still.contents.motion is None
