"""Assumptions of `pan` reach cell, measure and search: each changes what it says, and no more."""

from dataclasses import fields

import numpy as np
import pytest

from dualarm_repro.errors import InputError, UnsupportedArmError
from dualarm_repro.ledger import REGISTRY
from dualarm_repro.ledger.assumptions import alternatives
from dualarm_repro.papers.pan import document
from dualarm_repro.papers.pan.reading import (
    DENSER,
    PROBLEM,
    FlatSeam,
    Genetic,
    Job,
    Measure,
    Problem,
    SeamModel,
    at_display,
    denser,
    nothing_feasible,
    status_name,
)
from dualarm_repro.welding import Objective, Status

#: Assumption of the job, another value, and what of the cell shows it.
CELL = [
    ("radius_main", 0.12, "seam"),
    ("radius_branch", 0.05, "seam"),
    ("seam_points", 36, "seam"),
    ("flat_posture", "main_pipe_normal", "rotations"),
    ("workpiece_length", 0.8, "flanges"),
    ("gripper_length", 0.2, "flanges"),
    ("grasp", "side", "flanges"),
    ("torch_length", 0.4, "flanges"),
    ("torch_crank", 45, "flanges"),
    ("torch_axis", "work_angle_45", "flanges"),
    ("base_transform", "literal", "bases"),
    ("base_orientation", "facing_workpiece", "bases"),
    ("singularity_threshold", 0.005, "threshold"),
    ("carrier_reference", "own_flange", "lever_arms"),
]
#: Assumption of the measure and the field of the objective.
MEASURE = {
    "weights": "weights",
    "ellipsoid_space": "space",
    "carrier_weight": "carriers",
    "pair_measure": "pair",
    "aggregation": "aggregation",
    "length_unit": "unit",
}
GENETIC = [
    ("ga_population", 80, "population", 80),
    ("ga_generations", 40, "generations", 40),
    ("ga_crossover", 0.6, "crossover", 0.6),
    ("ga_elite", 0.1, "elite", 0.1),
    ("ga_stall", 1e-4, "stall", 1e-4),
    ("ga_stall_rule", "best_over_50", "stall_of", "best"),
    ("ga_stall_rule", "best_over_50", "stall_generations", 50),
    ("ga_stall_rule", "mean_over_10", "stall_generations", 10),
]


def shown(cell, name):
    return np.array(getattr(cell, name), dtype=float)


@pytest.mark.parametrize(("name", "value", "part"), CELL)
def test_cell_follows_the_job(nominal, name, value, part):
    before, after = (Job.of({**nominal, **more}).cell() for more in ({}, {name: value}))
    one, other = shown(before, part), shown(after, part)
    assert one.shape != other.shape or np.abs(one - other).max() > 1e-4


@pytest.mark.parametrize("name", ["base_transform", "base_orientation", "singularity_threshold"])
def test_what_stands_elsewhere_leaves_the_workpiece_alone(nominal, name):
    value = next(v for n, v, _ in CELL if n == name)
    before, after = (Job.of({**nominal, **more}).cell() for more in ({}, {name: value}))
    for part in ("seam", "rotations"):
        np.testing.assert_array_equal(shown(before, part), shown(after, part))


def test_the_way_to_the_torch_by_hand(nominal):
    """A straight torch of 0.35 m stands upright on the point that lies flat."""
    cell = Job.of(nominal).cell()
    welded = np.einsum("nij,nj->ni", cell.rotations, cell.seam)
    np.testing.assert_allclose(cell.flanges[2, :, :3, 3] - welded, np.tile([0, 0, 0.35], (72, 1)),
                               atol=1e-9)  # fmt: skip


@pytest.mark.parametrize("height", [0.3, 0.6])
def test_the_shoulder_of_every_robot_is_raised(nominal, height):
    cell = Job.of({**nominal, "shoulder_height": height}).cell()
    for arm in cell.arms:
        assert arm.joint_positions(np.zeros(6))[1][2] == pytest.approx(height)


@pytest.mark.parametrize("name", ["er20-1780", "kr16-2", "irb2400"])
def test_the_arm_is_the_one_named(nominal, name):
    assert {arm.name for arm in Job.of({**nominal, "arm": name}).cell().arms} == {name}


@pytest.mark.parametrize(("name", "field"), MEASURE.items())
def test_objective_follows_the_measure(nominal, name, field):
    assert getattr(Measure.of(nominal).reading(), field) == nominal[name]
    for value in alternatives(f"pan.{name}", 0):
        made = Measure.of({**nominal, name: value}).reading()
        assert getattr(made, field) == value
        rest = {f.name for f in fields(Objective)} - {field}
        assert all(getattr(made, one) == getattr(Measure.of(nominal).reading(), one)
                   for one in rest)  # fmt: skip


def test_an_objective_of_the_carriers_alone_has_no_other_weight(nominal):
    for weights in alternatives("pan.weights", 0):
        made = Measure.of({**nominal, "objective": "tight", "weights": weights})
        assert made.reading().weights == "tight_only"


@pytest.mark.parametrize(("name", "value", "field", "expected"), GENETIC)
def test_search_follows_its_assumptions(nominal, name, value, field, expected):
    made = Genetic.of({**nominal, name: value}).settings()
    assert getattr(made, field) == expected


def test_every_assumption_of_the_problem_is_declared_and_read_once(nominal):
    assert len(set(PROBLEM)) == len(PROBLEM)
    assert set(PROBLEM) <= set(nominal)
    assert not {*PROBLEM} & {*Genetic.names()}
    assert set(FlatSeam.names()) <= set(Job.names())
    assert set(SeamModel.names()) == {"radius_main", "radius_branch", "seam_points"}


def test_problems_are_equal_exactly_if_their_assumptions_are(nominal):
    assert Problem.of(nominal) == Problem.of(dict(nominal))
    assert hash(Problem.of(nominal)) == hash(Problem.of(dict(nominal)))
    for name in ("torch_length", "weights", "search_box"):
        other = [[0, 1]] * 3 if name == "search_box" else f"other {name}"
        assert Problem.of({**nominal, name: other}) != Problem.of(nominal)
    assert Problem.of(nominal).box.tolist() == nominal["search_box"]


def test_a_denser_job_is_the_same_elsewhere(nominal):
    job = Job.of(nominal)
    fine = denser(job)
    assert fine.seam_points == DENSER * job.seam_points
    rest = [name for name in Job.names() if name != "seam_points"]
    assert all(getattr(fine, name) == getattr(job, name) for name in rest)
    every = fine.seam.points[::DENSER]
    np.testing.assert_allclose(every, job.seam.points, atol=1e-15)


def test_a_position_out_of_reach_cannot_be_drawn(nominal):
    with pytest.raises(InputError, match="display_position"):
        at_display({**nominal, "display_position": [4.0, 4.0, 4.0]})


def test_status_in_words(display):
    _, jobs, _ = display
    assert status_name(jobs) == "feasible"
    for status in Status:
        made = type("Made", (), {"status": [status]})
        assert status_name(made) == status.name.lower().replace("_", " ")


def test_nothing_is_told_where_nothing_is_feasible():
    result = nothing_feasible("a", "b")
    assert result.obtained == {"a": None, "b": None}
    assert "no solution" in result.told()


def test_an_arm_without_a_table_is_no_stand_in(registry):
    with pytest.raises(UnsupportedArmError, match="given by a table"):
        document.robot_table("panda")


def test_choices_of_bases_are_those_of_the_ledger(registry):
    for name in ("base_transform", "base_orientation"):
        assert REGISTRY.nominal("pan")[name] in alternatives(f"pan.{name}", 0)
    for reading in alternatives("pan.base_transform", 0):
        for turn in alternatives("pan.base_orientation", 0):
            poses = document.placed_bases(reading, turn)
            np.testing.assert_allclose(np.linalg.det(poses[:, :3, :3]), 1.0)
