"""The scene of a plan measures what the summary of the plan says."""

import pytest

from dualarm_repro.datafiles import data_path
from dualarm_repro.planning import plan_file
from dualarm_repro.planning.checks.truth import truth
from dualarm_repro.planning.methods import METHODS
from dualarm_repro.view import plan_report
from dualarm_repro.view.plan_report import compare_methods, plan_scene


def test_scene_and_truth_agree():
    plan = plan_file(data_path("scenes", "example_tasks.yaml"), "apf-bidirectional")
    made = plan_scene(plan, "Two arms and a ball.")
    nearest, found = made.contents.nearest, truth(plan.scene, plan.paths)
    # key frames are some of the motion: they can only be farther apart, by what moves between two
    assert found.lower <= nearest.distance.min()
    assert nearest.distance.min() == pytest.approx(found.upper, abs=2e-3)  # between key frames
    assert made.contents.floor == plan.scene.floor == 0.0
    assert "ball" in {part.body for part in made.contents.parts}


def test_a_method_that_does_not_take_an_arm_says_why(monkeypatch):
    chosen = {name: METHODS[name] for name in ("apf-cartesian-ik", "apf-bidirectional")}
    monkeypatch.setattr(plan_report, "METHODS", chosen)
    table = compare_methods(data_path("scenes", "example_tasks.yaml"))
    refused, planned = (table.loc[name] for name in chosen)
    assert refused["arrive"].startswith("not for these arms (arm panda: ")
    assert refused["between"] == ""
    assert planned["steps"] > 0
