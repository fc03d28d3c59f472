"""Assumptions of `patent` reach the field of the settings that the text means."""

import pytest

from dualarm_repro.control.neural.network_settings import NetworkSettings
from dualarm_repro.control.settings import ControllerSettings
from dualarm_repro.errors import InputError
from dualarm_repro.ledger import REGISTRY
from dualarm_repro.ledger.assumptions import alternatives
from dualarm_repro.papers.patent import reading
from dualarm_repro.papers.patent.document import RADII, frozen, redundant_arm, scenario_file
from dualarm_repro.papers.patent.studies.crossings import CROSSINGS, cells, tipped_arm
from dualarm_repro.papers.patent.studies.tasks import MEASURES, SETTINGS, TASKS

#: Assumption, another value of it, and the field of the settings with its value.
CONTROLLER = [
    ("avoidance_form", "arm_axes", "form", "arm_axes"),
    ("pair_selection", None, "selection", None),
    ("damper_law", None, "damper", None),
    ("damper_gain", 7.0, "damper_gain", 7.0),
    ("outer_range", 0.12, "outer", 0.12),
    ("inner_range", 0.02, "inner", 0.02),
    ("feedback_gain", 3.0, "feedback", 3.0),
    ("limit_form", "velocity", "angle_limits", False),
    ("limit_form", "velocity_and_angle", "angle_limits", True),
    ("limit_gain", 8.0, "limit_gain", 8.0),
    ("limit_margin", 0.01, "limit_margin", 0.01),
]
NETWORK = [
    ("penalty_form", "quadratic", "penalty", "quadratic"),
    ("penalty_factor", 1e4, "factor", 1e4),
    ("penalty_sharpness", 300.0, "sharpness", 300.0),
    ("state_matrix", "without_hessian", "hessian", False),
    ("state_matrix", "with_hessian", "hessian", True),
    ("gain", 20.0, "gamma", 20.0),
    ("gain_cap", "step_limited", "capped", True),
    ("gain_cap", "none", "capped", False),
    ("activation", None, "activation", None),
]


def other(name, value):
    """The value, or a declared choice that is not the nominal one."""
    if value is not None:
        return value
    now = REGISTRY.nominal("patent")[name]
    return next(one for one in alternatives(f"patent.{name}", 0) if one != now)


@pytest.mark.parametrize(("name", "value", "field", "expected"), CONTROLLER)
def test_controller(nominal, name, value, field, expected):
    value = other(name, value)
    expected = value if expected is None else expected
    made = reading.controller_settings({**nominal, name: value}, name)
    assert getattr(made, field) == expected
    rest = {field: getattr(ControllerSettings(), field)}
    assert made.changed(**rest) == ControllerSettings()


@pytest.mark.parametrize(("name", "value", "field", "expected"), NETWORK)
def test_network(nominal, name, value, field, expected):
    value = other(name, value)
    expected = value if expected is None else expected
    made = reading.network_settings({**nominal, name: value}, name)
    assert getattr(made, field) == expected
    assert made.changed(**{field: getattr(NetworkSettings(), field)}) == NetworkSettings()


@pytest.mark.parametrize("name", sorted({row[0] for row in CONTROLLER}))
def test_what_is_not_named_stays_at_its_nominal_value(nominal, name):
    assert reading.controller_settings(nominal, name) == ControllerSettings()


@pytest.mark.parametrize("name", sorted({row[0] for row in NETWORK}))
def test_defaults_of_the_network_are_the_declared_ones(nominal, name):
    assert reading.network_settings(nominal, name) == NetworkSettings()


def test_groups_of_assumptions_name_declared_ones(nominal):
    for group in (reading.AVOIDANCE, reading.PENALTY, reading.LIMITS):
        assert set(group) <= set(nominal)
    assert reading.controller_settings(nominal, *reading.AVOIDANCE) == ControllerSettings()


@pytest.mark.parametrize(
    ("robot", "tip", "title"),
    [("panda", "flange", "Two Pandas"), ("xarm7", "flange", "Two xArm 7"),
     ("panda", "fingertip", "Two Pandas with their fingertips on the paths")],
)  # fmt: skip
def test_titles_of_the_arms(robot, tip, title):
    assert reading.arm_title(robot, tip) == title


@pytest.mark.parametrize("robot", ["panda", "xarm7"])
def test_the_frozen_crossing_is_the_one_of_its_base_distance(nominal, robot):
    name = {"panda": "crossing", "xarm7": "crossing_xarm7"}[robot]
    distance = scenario_file(name).base_distance
    assumed = {**nominal, "robot": robot, "base_distance": distance, "tip": "flange"}
    assert reading.crossing(assumed) is frozen(name)
    # named assumptions on the timing reach the path
    quick = reading.crossing({**assumed, "duration": 2.0}, "duration")
    assert quick.period == pytest.approx(2.0)


def test_another_layout_is_the_stored_draw(nominal):
    table = CROSSINGS.load()
    row = table[(table["robot"] == "panda") & (table["tip"] == "fingertip")].iloc[0]
    assumed = {**nominal, **row.to_dict()}
    made = reading.crossing(assumed)
    assert "fingertips" in made.title
    assert f"{row['base_distance']:g} m apart" in made.title


def test_a_layout_without_a_task_is_refused(nominal, monkeypatch):
    none = CROSSINGS.load().assign(draw=-1)
    monkeypatch.setattr(type(CROSSINGS), "load", lambda study: none)
    assumed = {**nominal, "robot": "panda", "base_distance": 0.8, "tip": "fingertip"}
    with pytest.raises(InputError, match="a search found a task"):
        reading.crossing(assumed)


def test_cells_of_the_crossings_are_all_layouts():
    made = cells()
    assert len(made) == len({tuple(sorted(one.items())) for one in made})
    for name in ("robot", "base_distance", "tip"):
        assert {one[name] for one in made} == set(alternatives(f"patent.{name}", 0))
    table = CROSSINGS.load()
    assert [one["base_distance"] for one in made] == table["base_distance"].tolist()


def test_a_tip_at_the_fingers_lies_ahead_of_the_flange():
    import numpy as np

    flange, tip = redundant_arm("panda"), tipped_arm("panda", "fingertip")
    q = np.zeros(7)
    way = (np.linalg.inv(flange.fk(q)) @ tip.fk(q))[:3, 3]
    np.testing.assert_allclose(way, [0, 0, 0.1034], atol=1e-12)
    np.testing.assert_array_equal(tipped_arm("panda", "flange").fk(q), flange.fk(q))


def test_settings_of_the_study_are_those_of_the_controller():
    assert SETTINGS["outer"] == ControllerSettings().outer
    assert SETTINGS["inner"] == ControllerSettings().inner
    assert SETTINGS["radii"] == list(RADII)
    assert len(TASKS.cells()) == REGISTRY.assumption("patent.task_selection")


def test_columns_of_the_study_are_the_measures_of_a_motion():
    from dualarm_repro.control.motion import Motion

    columns = set(TASKS.load())
    for key, measure in MEASURES:
        assert isinstance(getattr(Motion, measure), property)
        assert f"network_{key}" in columns
