"""The tasks of the arena: drawn as they say, the same every time, feasible at both ends."""

import numpy as np
import pytest

from dualarm_repro.arena.benchmark_cases import benchmark_case, problems
from dualarm_repro.arena.cases import KINDS, case_of, case_settings, cells
from dualarm_repro.arena.document_cases import DOCUMENTS, document_case
from dualarm_repro.arena.random_cases import GRADES, MARGIN, NEAR, PAIRS, near_case, random_case
from dualarm_repro.planning.checks.contact_check import contact_check
from dualarm_repro.scene import distances


@pytest.mark.parametrize("grade", GRADES)
def test_random_task_is_clear_at_its_ends_and_blocked_between(grade):
    case = random_case("irb120-irb120", grade, 0)
    assert case.fault == ""
    assert len(case.scene.obstacles) == GRADES[grade]
    assert distances(case.scene, case.ends).min() > MARGIN
    assert contact_check(case.scene, case.ends).smallest < 0.0
    again = random_case("irb120-irb120", grade, 0)
    np.testing.assert_array_equal(again.ends, case.ends)
    assert not np.array_equal(random_case("irb120-irb120", grade, 1).ends, case.ends)


@pytest.mark.parametrize("end", ["start", "goal"])
def test_one_end_is_near_contact(end):
    case = near_case("irb120-panda", end, 0)
    least = distances(case.scene, case.ends).min(axis=1)
    near, other = least if end == "start" else least[::-1]
    assert NEAR[0] <= near <= NEAR[1]
    assert other > MARGIN


@pytest.mark.parametrize("name", DOCUMENTS)
def test_document_has_a_task_of_all_its_arms(name):
    case = document_case(name)
    assert len(case.scene.arms) == (3 if name == "pan" else 2)
    assert np.abs(case.ends[1] - case.ends[0]).max() > 0.1
    assert case.fault == ""


def test_benchmark_keeps_obstacles_and_joint_vectors():
    first = next(one for one in problems() if one["set"] == "box" and one["number"] == 1)
    case = benchmark_case("box", 1)
    assert len(case.scene.obstacles) == len(first["obstacles"])
    np.testing.assert_array_equal(case.ends, [first["start"], first["goal"]])
    np.testing.assert_allclose(case.ends[0], [0, -0.785, 0, -2.356, 0, 1.571, 0.785])


def test_settings_are_distinct_and_of_every_kind():
    settings = case_settings()
    assert len({tuple(one.values()) for one in settings}) == len(settings)
    assert tuple(dict.fromkeys(one["kind"] for one in settings)) == KINDS
    assert {one["subject"] for one in settings if one["kind"] == "random"} == set(PAIRS)
    assert len(cells(("a", "b"))) == 2 * len(settings)
    assert case_of(settings[4]).name == "irb120-irb120, arms alone, seed 0"
