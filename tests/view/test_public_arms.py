"""A few public arms, computed anew: what the stored table says of all of them."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from example_robot_data import getModelPath

from dualarm_repro.arms import load_arm
from dualarm_repro.ledger.spot import spot_check
from dualarm_repro.scene.audit import audit
from dualarm_repro.view.public_arms import PUBLIC_ARMS, _cell, public_files, summary
from dualarm_repro.view.public_pair import planned_pair


def test_there_are_enough_of_them():
    files = public_files()
    assert len(files) >= 36
    assert "ur_description/urdf/ur10_robot.urdf" in files


@pytest.mark.parametrize(
    ("file", "joints"),
    [("ur_description/urdf/ur10_robot.urdf", 6), ("xarm_description/urdf/xarm7.urdf", 7)],
)
def test_arms_that_load(file, joints, rng):
    found = audit(Path(getModelPath(file)) / file, rng, 200)
    assert (found["loads"], found["joints"]) == (True, joints)
    assert found["fk"] <= 1e-12
    assert found["outside"] <= 1e-9
    assert found["home_clear"]
    assert not found["home_flagged"], "the home pose is accepted"
    assert found["clear"] > 100
    assert found["false_alarms"] <= 0.1 * found["clear"]
    assert found["missed"] == 0
    assert 1.0 <= found["excess"] < 3.0


def test_two_of_an_arm_are_planned_and_the_report_is_below_the_meshes(rng):
    file = "ur_description/urdf/ur10_robot.urdf"
    found = planned_pair(load_arm(Path(getModelPath(file)) / file), rng)
    assert found["pair_reached"]
    assert 1.0 < found["pair_apart"] < 1.4
    assert 0.0 < found["pair_lower"] <= found["pair_meshes"]


def test_a_file_that_is_refused_says_how_to_go_on(rng):
    row = _cell({"file": "asr_twodof_description/urdf/TwoDofs.urdf"}, rng)
    assert (row["loads"], row["remedy"], row["joints"]) == (False, True, None)
    assert row["said"].startswith("asr_twodof_description/urdf/TwoDofs.urdf: collision shapes = 0")


def test_a_row_of_the_stored_table_is_computed_again():
    """It is the one of the UR5 with a gripper; ``make arms`` where it is stale."""
    assert spot_check(PUBLIC_ARMS, 1, seed=7).wrong == []


def test_the_counts_see_what_is_wrong():
    good = {
        "loads": True, "remedy": False, "exact": True, "contained": True, "home_clear": True,
        "home_flagged": False, "clear": 200, "false_alarms": 20, "missed": 0,
        "pair_reached": True, "pair_lower": 0.01, "pair_meshes": 0.02,
    }  # fmt: skip
    bad = {
        **good, "exact": False, "home_flagged": True, "false_alarms": 21, "missed": 3,
        "pair_meshes": 0.009,
    }  # fmt: skip
    refused = {**dict.fromkeys(good, np.nan), "loads": False, "remedy": True}
    found = summary(pd.DataFrame([good, bad, refused]))
    assert list(found.values()) == [3, 2, 1, 1, 2, 2, 1, 1, 3, 200, 2, 2, 1]


@pytest.fixture
def rng():
    """Postures of this test."""
    return np.random.default_rng(7)
