"""Rows of success, and scenes of arms."""

import numpy as np
import pandas as pd
import pinocchio as pin
import pytest

from dualarm_repro.arms import load_arm
from dualarm_repro.scene import ConvexHull, PlacedArm, Sphere
from dualarm_repro.view.arm_scenes import among_spheres, inside_hull, standing
from dualarm_repro.view.success_table import judged_share, success_row


def test_a_row_of_success():
    table = pd.DataFrame(
        {
            "x_planner": [True, True, False, False],
            "x_truth": [True, False, False, False],
            "x_failure": ["None", "None", "midway-minimum", "displaced-goal"],
        }
    )
    row = success_row(table, "x")
    assert (row["planner %"], row["true %"], row["of"]) == (50.0, 25.0, 4)
    assert row["displaced-goal"] == row["midway-minimum"] == 1
    share = judged_share(table, "x", "truth")
    assert row["true low %"] == pytest.approx(100 * share.low, abs=0.05)  # shown to 0.1 %
    assert "midway-minimum" not in success_row(table.drop(columns="x_failure"), "x")


def test_scenes_of_arms():
    placed = [
        PlacedArm(name, load_arm("irb120"), pin.SE3(np.eye(3), np.array([x, 0.0, 0.0])))
        for name, x in (("master", 0.4), ("slave", -0.4))
    ]
    camera, corners = (1.0, 1.0, 1.0), np.vstack([np.zeros(3), np.eye(3)])
    for made in (
        standing("Two arms.", placed, np.zeros(6), camera),
        inside_hull("A hull.", placed[0], np.zeros(6), ConvexHull(corners), camera),
        among_spheres("A sphere.", {"one": Sphere([0, 0, 1], 0.1)}, camera),
    ):
        assert made.title in made.page_html()
