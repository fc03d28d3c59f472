"""The one judge of the arena, on planners whose answers are known."""

from dataclasses import replace

import numpy as np
import pytest

from dualarm_repro.arena.case import Case
from dualarm_repro.arena.judged import Outcome, judged_row
from dualarm_repro.arena.random_cases import random_case
from dualarm_repro.errors import InputError
from dualarm_repro.planning import FoundPath
from dualarm_repro.planning.path_plan import as_method

RNG = np.random.default_rng(0)


@pytest.fixture(scope="module")
def case():
    return random_case("irb120-irb120", "arms alone", 0)


def row(case, planner):
    return judged_row(case, as_method("theirs", "", lambda: planner), 100, RNG)


def straight(problem):
    return FoundPath(np.array([problem.start, problem.goal]), "reached")


def test_who_claims_to_arrive_and_collides_is_no_success(case):
    found = row(case, straight)
    assert found["outcome"] == Outcome.COLLIDES
    assert found["claim"] is True
    assert found["lower"] <= found["upper"] <= 0.0
    start, goal = case.ends
    assert found["joint_length"] == pytest.approx(np.linalg.norm(goal - start))
    assert found["bending"] == pytest.approx(0.0, abs=1e-9)


def test_who_stops_is_told_so_whatever_it_claims(case):
    found = row(case, lambda problem: FoundPath(problem.start[None], "reached"))
    assert found["outcome"] == Outcome.STOPPED
    assert found["claim"] is False
    found = row(case, lambda problem: FoundPath(problem.start[None], "stuck"))
    assert found["reason"] == "left: stuck, right: stuck"


def test_free_task_is_a_certified_success(case):
    """Start and goal a hundredth of a radian apart, with what is asked counted."""
    nearby = {name: q + 0.02 for name, q in case.starts.items()}
    easy = Case("easy", case.scene, case.starts, nearby)

    def planner(problem):
        for _ in range(7):
            problem.clearance(problem.start)
        return straight(problem)

    found = row(easy, planner)
    assert found["outcome"] == Outcome.SUCCESS
    assert 0.0 < found["lower"] <= found["upper"]
    assert found["evaluations"] == 7
    assert found["time"] > 0.0


def test_path_beyond_limits_is_no_success(case):
    far = {name: q.copy() for name, q in case.starts.items()}
    lower = case.scene.arms[0].arm.lower

    def planner(problem):
        out = problem.start.copy()
        out[5] = lower[5] - 0.3
        return FoundPath(np.array([problem.start, out, problem.goal]), "reached")

    found = row(Case("out", case.scene, case.starts, far), planner)
    assert found["outcome"] in (Outcome.LIMITS, Outcome.COLLIDES)
    assert found["outcome"] == Outcome.LIMITS or found["upper"] <= 0.0


def test_refusal_and_failure_of_a_planner_are_rows_too(case):
    def refuses(problem):
        raise InputError("theirs", "arms", 2, "one arm")

    found = row(case, refuses)
    assert found["outcome"] == Outcome.REFUSED
    assert "one arm" in found["reason"]
    assert row(case, lambda problem: 1 / 0)["outcome"] == Outcome.REFUSED


def test_ends_beyond_limits_are_no_task(case):
    beyond = replace(case, goals={**case.goals, "left": case.scene.arms[0].arm.upper + 0.1})
    assert beyond.fault == "limits"
    assert row(beyond, straight)["outcome"] == Outcome.NO_TASK


def test_who_ends_near_the_goal_is_judged_with_the_last_piece(case):
    """0.06 rad short of a goal nearby: completed, and the length is that of the whole way."""
    nearby = {name: q + 0.1 for name, q in case.starts.items()}
    easy = Case("easy", case.scene, case.starts, nearby)

    def short(problem):
        return FoundPath(np.array([problem.start, problem.goal - 0.06]), "reached")

    found = row(easy, short)
    assert found["outcome"] in (Outcome.SUCCESS, Outcome.COLLIDES, Outcome.LIMITS)
    assert found["joint_length"] == pytest.approx(0.1 * np.sqrt(12))
    further = {name: q + 0.2 for name, q in case.starts.items()}
    easy = Case("easy", case.scene, case.starts, further)

    def shorter(problem):
        return FoundPath(np.array([problem.start, problem.goal - 0.15]), "reached")

    assert row(easy, shorter)["outcome"] == Outcome.STOPPED


def test_another_posture_at_the_point_is_no_success(case):
    """The last joint turns the flange about itself, so that its point stays where it is."""
    turned = {name: q.copy() for name, q in case.starts.items()}
    turned["left"][5] += 0.5

    def stays(problem):
        return FoundPath(problem.start[None], "reached")

    found = row(Case("turned", case.scene, case.starts, turned), stays)
    assert found["outcome"] == Outcome.OTHER_POSTURE
