"""Settings given in part are merged over those that suit an arm."""

import pytest
from own_scenes import LEFT, RIGHT, written

from dualarm_repro.arms import load_arm
from dualarm_repro.errors import DataFileError
from dualarm_repro.planning import load_tasks, plan_file
from dualarm_repro.planning.checks.truth import truth
from dualarm_repro.planning.defaults import default_settings, default_two_arm_settings
from dualarm_repro.planning.given_settings import merged
from dualarm_repro.planning.search.bidirectional_arms import TwoArmSettings

DEFAULT = default_settings(load_arm("irb120"))


def tasks(folder, settings):
    written(folder, f"arms:\n  {LEFT}\n  {RIGHT}\nfloor: 0\nexempt: [[left, floor]]\n")
    text = f"scene: cell.yaml\ntasks: {{left: {{goal: [1.2, 0.9, -0.5, 0, 0, 0]}}}}\n{settings}"
    return written(folder, text, "tasks.yaml")


def test_one_field_leaves_all_others_as_they_are():
    found = merged(DEFAULT, {"control_points": "capsules"})
    assert found.control_points == "capsules"
    assert found.changed(control_points=DEFAULT.control_points) == DEFAULT


def test_blocks_are_merged_field_by_field():
    found = merged(
        DEFAULT, {"repulsion": {"influence": 0.2}, "termination": {"trap": {"steps": 7}}}
    )
    assert found.repulsion == DEFAULT.repulsion.changed(influence=0.2)
    assert found.termination.trap == DEFAULT.termination.trap.changed(steps=7)
    assert found.attraction == DEFAULT.attraction


def test_another_rule_counts_alone_if_it_is_complete():
    found = merged(DEFAULT, {"update": {"rule": "fixed_length", "max_step": 0.1}})
    assert found.update.gain is None
    assert found.update.max_step == 0.1


def test_none_switches_a_block_off():
    assert merged(DEFAULT, {"repulsion": None}).repulsion is None


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        (
            "settings: {control_point: capsules}",
            r"APFSettings.control_point.*fields control_points",
        ),
        ("settings: {repulsion: {influence: -1}}", r"settings: Repulsion.influence = -1"),
        ("settings: {repulsion: {gain: .nan}}", r"settings: Repulsion.gain = nan"),
        ("settings: {update: {rule: fixed}}", r"settings: Update.rule = 'fixed'"),
    ],
)
def test_what_is_wrong_is_named(tmp_path, settings, message):
    with pytest.raises(DataFileError, match=message):
        load_tasks(tasks(tmp_path, settings))


def test_the_advice_of_the_page_works_alone(tmp_path):
    """Capsules of whole links as control points, on arms that stand on a floor."""
    found = plan_file(tasks(tmp_path, "settings: {control_points: capsules}"), "apf-improved")
    plan = found.plans["left"]
    assert plan.reached
    assert all(name.startswith("capsule_") for name in plan.point_names)
    assert truth(found.scene, found.paths).collision_free


def test_the_other_family_is_merged_over_its_own_defaults(tmp_path):
    given = load_tasks(tasks(tmp_path, "settings: {step: {length: 0.02}}"), TwoArmSettings)
    default = default_two_arm_settings(load_arm("irb120"))
    assert given.settings["left"].step == default.step.changed(length=0.02)


def test_a_step_cannot_leap_over_where_a_default_search_ends():
    default = default_two_arm_settings(load_arm("irb120"))
    assert default.step.length < default.ending.tolerance < 1.5 * default.step.length
