"""The report of a recipe says what a motion is worth, also where it is worth nothing."""

import numpy as np
import pytest

from dualarm_repro.planning import plan_file
from dualarm_repro.scene import JointPath
from dualarm_repro.view.certified_report import certified_motion, certified_report

#: Two IRB 120 face to face, 0.8 m apart; the left one turns through the place of the right one.
CROSSING = """
arms:
  left: {robot: irb120, xyz: [-0.4, 0, 0], start: ["60 deg", "60 deg", -0.5, 0, 0, 0], goal: ["-60 deg", "60 deg", -0.5, 0, 0, 0]}
  right: {robot: irb120, xyz: [0.4, 0, 0], rpy: [0, 0, pi], start: [0, "60 deg", -0.5, 0, 0, 0]}
"""  # noqa: E501


@pytest.fixture
def plan(tmp_path):
    path = tmp_path / "crossing.yaml"
    path.write_text(CROSSING, encoding="utf-8")
    return plan_file(path, "attraction-only")


def test_a_plan_through_another_arm_is_told_as_a_collision(plan):
    told = certified_report(plan)["plan"]
    assert told["right"] == "parked"
    assert told["left"].startswith("reached, ")
    assert told["outcome"] == "COLLISION"
    low, high = map(float, told["distance [m]"].split(" to "))
    assert low <= high < 0.0
    assert {one.split("/")[0] for one in told["closest bodies"].split(" - ")} == {"left", "right"}


def test_phases_are_columns(plan):
    assert list(certified_report(plan, plan).columns) == ["plan 1", "plan 2"]


def test_a_motion_of_ones_own_is_told_with_its_limits(plan):
    still = {name: JointPath(path.configurations[:1]) for name, path in plan.paths.items()}
    told = certified_motion(plan.scene, still)["motion"]
    assert (told["joint limits"], told["outcome"]) == ("kept", "certified free")
    beyond = still | {"left": JointPath([np.append(still["left"].configurations[0, :5], 7.2)])}
    assert certified_motion(plan.scene, beyond)["motion"]["joint limits"] == "NOT KEPT"
