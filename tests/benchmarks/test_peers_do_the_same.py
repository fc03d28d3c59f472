"""What peers are given and how their outcomes are compared before anything is timed."""

import numpy as np
import pytest
from edges import same_edges
from equal_work import DifferentWork
from genetic import CHILDREN, SETTINGS, Run, as_much
from pinocchio_checks import RESOLUTION, free_motion, free_path, length

LIMITS = np.full(2, -1.0), np.full(2, 1.0)
START, GOAL = np.array([-0.5, 0.0]), np.array([0.5, 0.0])


def beside_a_wall(q):
    """A wall between the halves of a square, open above 0.7."""
    return abs(q[0]) > 0.1 or q[1] > 0.7


def test_a_motion_is_looked_at_from_end_to_end_in_small_steps():
    seen = []

    def look(q):
        seen.append(q.copy())
        return True

    assert free_motion(look, START, GOAL)
    np.testing.assert_array_equal([seen[0], seen[-1]], [START, GOAL])
    assert np.abs(np.diff(seen, axis=0)).max() <= RESOLUTION + 1e-12


def test_a_motion_through_a_wall_is_not_free():
    assert not free_motion(beside_a_wall, START, GOAL)
    around = np.array([START, [-0.5, 0.9], [0.5, 0.9], GOAL])
    assert free_path(beside_a_wall, around)
    assert length(around) == pytest.approx(2.8)


def test_edges_may_be_refused_but_never_proved_against_the_peer():
    free = np.ones(200, dtype=bool)
    refused, proved = free.copy(), free.copy()
    refused[0] = False
    assert "99.5%" in same_edges(lambda: refused, lambda: free)()
    with pytest.raises(DifferentWork, match="1 proved edges"):
        same_edges(lambda: proved, lambda: refused)()
    with pytest.raises(DifferentWork, match="judged alike"):
        same_edges(lambda: ~free, lambda: free)()


def test_a_genetic_run_must_rate_as_many_and_find_the_optimum():
    most = SETTINGS.population + SETTINGS.generations * CHILDREN
    assert f"{most} individuals" in as_much(lambda seed: Run(np.zeros(3), most))()
    with pytest.raises(DifferentWork, match="from the optimum"):
        as_much(lambda seed: Run(np.full(3, 0.2), most))()
    with pytest.raises(DifferentWork, match="rated"):
        as_much(lambda seed: Run(np.zeros(3), most // 2))()


def test_our_genetic_run_does_all_of_the_work():
    from genetic import _ours

    assert as_much(_ours)()


def test_ompl_goes_around_a_wall():
    pytest.importorskip("ompl")
    from ompl_paths import ompl_path

    path = ompl_path(LIMITS, START, GOAL, beside_a_wall, 0)
    np.testing.assert_allclose(path[[0, -1]], [START, GOAL])
    assert free_path(beside_a_wall, path)


def test_ompl_in_turn_moves_one_arm_at_a_time():
    pytest.importorskip("ompl")
    from ompl_paths import ompl_path_in_turn

    arms, goal = [slice(1, 2), slice(0, 1)], np.array([0.5, 0.9])
    path = ompl_path_in_turn(LIMITS, arms, START, goal, beside_a_wall, 0)
    assert (np.count_nonzero(np.diff(path, axis=0), axis=1) <= 1).all()
    np.testing.assert_allclose(path[[0, -1]], [START, goal])


def test_ompl_does_not_wait_for_an_end_that_is_not_free():
    pytest.importorskip("ompl")
    from ompl_paths import ompl_path

    with pytest.raises(DifferentWork, match="end"):
        ompl_path(LIMITS, START, np.zeros(2), beside_a_wall, 0)


def test_ompl_ends_in_time(monkeypatch):
    pytest.importorskip("ompl")
    import ompl_paths

    monkeypatch.setattr(ompl_paths, "SECONDS", 0.2)
    closed = lambda q: abs(q[0]) > 0.1  # noqa: E731
    assert ompl_paths.ompl_path(LIMITS, START, GOAL, closed, 0) is None
