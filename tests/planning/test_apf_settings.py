"""Settings: wrong values are input errors that name the field; nothing can be changed silently."""

import pydantic
import pytest
from window_scene import IMPROVED

from dualarm_repro.errors import InputError
from dualarm_repro.planning import (
    APFSettings,
    Attraction,
    Repulsion,
    StuckRule,
    Switching,
    Termination,
    Trap,
    Update,
    UpdateRule,
)
from dualarm_repro.settings import code

TRAP = Trap(rule="block_means", steps=5, threshold=1e-3)


@pytest.mark.parametrize(
    ("make", "field", "expected"),
    [
        (lambda: Attraction(gain=0.0), "gain", "greater than 0"),
        (lambda: Attraction(gain=float("nan")), "gain", "finite"),
        (
            lambda: Attraction(gain=1.0, joint_wieght=1.0),
            "joint_wieght",
            "one of the fields joint_weight, ",
        ),
        (
            lambda: Attraction(gain=1.0, position_weight=0.0),
            "combination",
            "a weight that is not zero",
        ),
        (lambda: Repulsion(gain=1.0), "influence", "required"),
        (lambda: Repulsion(gain=1.0, influence=1e-4), "combination", "contact below influence"),
        (lambda: Update(rule="downhill", max_step=0.1), "rule", "'gradient'"),
        (
            lambda: Update(rule="gradient", max_step=0.1),
            "combination",
            "a gain for the rule gradient",
        ),
        (
            lambda: Update(rule="fixed_length", max_step=0.1, gain=1.0),
            "combination",
            "for no other",
        ),
        (
            lambda: Trap(rule="block_means", steps=0, threshold=1.0),
            "steps",
            "greater than or equal",
        ),
        (
            lambda: Termination(step_limit=9, trap=TRAP),
            "combination",
            "joint_tolerance or position",
        ),
        (lambda: IMPROVED.changed(control_points="elbow"), "control_points", "five_links"),
        (lambda: IMPROVED.changed(weights=(-1.0,)), "weights", "greater than or equal to 0"),
        (lambda: IMPROVED.virtual_point.changed(position=(0.0, 1.0)), "position", "required"),
    ],
)
def test_a_wrong_value_names_its_field(make, field, expected):
    with pytest.raises(InputError, match=expected) as caught:
        make()
    assert caught.value.field.startswith(field)


def test_settings_cannot_be_changed_in_place():
    with pytest.raises(pydantic.ValidationError):
        IMPROVED.enforce_limits = True


def test_changed_checks_again_and_keeps_the_rest():
    longer = IMPROVED.termination.changed(step_limit=7)
    assert (longer.step_limit, longer.joint_tolerance) == (7, IMPROVED.termination.joint_tolerance)
    with pytest.raises(InputError):
        IMPROVED.termination.changed(step_limit=0)


def test_settings_survive_json():
    assert APFSettings.model_validate_json(IMPROVED.model_dump_json()) == IMPROVED


def test_codes_of_compiled_choices_are_distinct():
    for choices in (UpdateRule, StuckRule, Switching):
        assert sorted(code(choice) for choice in choices) == list(range(len(choices)))
