"""Parts of a search: the quick check of plain arrays says the same as the thorough one, and what is
kept of an arm stays as it is."""

import gc
import weakref

import numpy as np
import pytest
from two_spheres import GOAL, START, obstacles, placed_arm, settings

from dualarm_repro.arms import load_arm
from dualarm_repro.errors import ConfigurationError, InputError
from dualarm_repro.planning.field.control_points import control_points
from dualarm_repro.planning.search.search_problem import search_problem
from dualarm_repro.scene import PlacedArm

BEYOND = placed_arm().arm.upper + 0.1


def made(start=START, goal=GOAL, **changes):
    return search_problem(placed_arm(), start, goal, obstacles(), settings(**changes))


@pytest.mark.parametrize("end", ["start", "goal"])
@pytest.mark.parametrize(
    "value",
    [np.full(6, np.nan), np.array([0, 0, 0, 0, 0, np.inf]), np.zeros(5), np.zeros((1, 6)), BEYOND],
    ids=["nan", "infinite", "short", "rows", "beyond"],
)
def test_arrays_and_lists_with_a_fault_are_refused_in_the_same_words(end, value):
    told = []
    for given in (value, value.tolist()):
        with pytest.raises(ConfigurationError, match=f"{end} = ") as caught:
            made(**{end: given}, enforce_limits=True)
        told.append(str(caught.value).partition("expected")[2])
    assert told[0] == told[1] != ""


def test_limits_count_only_where_they_are_enforced():
    arm = placed_arm().arm
    assert (made(goal=BEYOND).goal == BEYOND).all()
    assert [bound.tolist() for bound in made().limits] == [[-np.inf] * 6, [np.inf] * 6]
    kept = made(goal=arm.upper, enforce_limits=True)
    assert all((a == b).all() for a, b in zip(kept.limits, arm.limits(), strict=True))


def test_ends_are_float_copies_whatever_they_were_given_as():
    for start in (START.copy(), START.astype(int), START.tolist(), START.astype(">f8")):
        problem = made(start=start)
        assert problem.start.dtype == np.dtype(float)
        assert (problem.start == START).all()
        problem.start[0] = 1.0
        assert start[0] == 0.0


def test_a_changed_problem_leaves_the_next_one_of_its_arm_alone():
    arm = placed_arm().arm
    for choice in ((3, 5, 7), "frames_2_6", "end_effector"):
        expected = control_points(arm, choice)
        chosen = {"control_points": choice, "step": {"weights": None}}
        for array in made(**chosen).points[1:]:
            array[...] = 0
        points = made(**chosen).points
        assert points.names == expected.names
        for one, other in zip(points[1:], expected[1:], strict=True):
            assert (one == other).all()


def test_what_is_kept_of_an_arm_goes_with_it():
    arm = load_arm("irb120")
    placed = PlacedArm("other", arm, placed_arm().placement)
    search_problem(placed, START, GOAL, obstacles(), settings())
    gone = weakref.ref(arm)
    del arm, placed
    gc.collect()
    assert gone() is None


def test_parts_that_do_not_match_are_named():
    with pytest.raises(InputError, match=r"radii = .*3 numbers"):
        made(radii=(0.1, 0.1))
    with pytest.raises(InputError, match=r"step.weights = .*3 numbers"):
        made(step={"weights": (1.0, 2.0)})
    for _ in range(2):
        with pytest.raises(InputError, match="points, not links"):
            made(control_points="five_links", step={"weights": None})
        with pytest.raises(InputError, match="a frame from 1 to 7"):
            made(control_points=(3, 9))
