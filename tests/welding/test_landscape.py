"""Survey of a region, mirror images of an optimum, and extreme positions."""

import numpy as np
import pytest

from dualarm_repro.errors import InputError, UnknownNameError
from dualarm_repro.welding import Objective, Optimum, Placement, extreme_position, survey
from dualarm_repro.welding.landscape import EXTREMES, nearer_image

from .cells import BOX, make_cell


@pytest.fixture(scope="module")
def placement():
    return Placement(make_cell(count=12), Objective())


def test_survey_is_the_grid_of_the_fitness(placement):
    grid = survey(placement, BOX, 0.3)
    assert (placement(grid.points) == grid.fitness).all()
    assert ((grid.fitness > 0) == (grid.status == 0)).all()
    assert 0 < (grid.fitness > 0).mean() < 1


def test_nearer_image():
    target, right = np.array([0.1, 0.0, 0.0]), np.array([0.3, 0.1, 0.2])
    left = right * [-1, 1, 1]
    for position in (left, right):
        same = nearer_image(Optimum(position, 1.0, 5), lambda p: np.ones(len(p)), target)
        assert same.position.tolist() == right.tolist()
    worse = nearer_image(Optimum(left, 1.0, 5), lambda p: np.full(len(p), 0.999), target)
    assert worse.position.tolist() == left.tolist()
    nowhere = nearer_image(Optimum(np.full(3, np.nan), 0.0, 5), lambda p: p[:, 0], target)
    assert np.isnan(nowhere.position).all()


@pytest.mark.parametrize("rule", EXTREMES)
def test_extreme_positions_keep_their_rules(placement, rule):
    fineness = {"spacing": 0.3, "starts": 2, "tolerance": 0.05}
    found = extreme_position(placement, BOX, rule, **fineness)
    grid = survey(placement, BOX, 0.3)
    jobs = placement.jobs(grid.points[grid.status == 0])
    scores = EXTREMES[rule](jobs.w, placement.measures(jobs).system)
    assert found.fitness >= scores.max() * (1 - 1e-9)
    assert found.position[0] >= 0
    at = placement.jobs([found.position])
    assert at.feasible.all()
    assert found.fitness == EXTREMES[rule](at.w, placement.measures(at).system)[0]
    again = extreme_position(placement, BOX, rule, **fineness, known=grid)
    assert again.position.tolist() == found.position.tolist()


def test_no_extreme_out_of_reach(placement):
    away = np.array([[4.0, 4.2]] * 3)
    found = extreme_position(placement, away, "lowest_welder", spacing=0.1, starts=2)
    assert found.fitness == 0
    assert np.isnan(found.position).all()
    with pytest.raises(UnknownNameError, match="lowest_welder, lowest_mean_of_welder"):
        extreme_position(placement, BOX, "worst", spacing=0.1, starts=2)


@pytest.mark.parametrize("box", [BOX.T, BOX[:2], np.empty((0, 2)), BOX[np.newaxis], 3.0])
def test_a_region_has_three_rows_of_bounds(placement, box):
    text = r"box \(its shape\) = .*: expected finite numbers \(3, 2\)"
    with pytest.raises(InputError, match=f"survey: {text}"):
        survey(placement, box, 0.3)
    known = survey(placement, BOX, 0.3)
    for grid in (None, known):
        with pytest.raises(InputError, match=f"extreme_position: {text}"):
            extreme_position(placement, box, "lowest_welder", spacing=0.3, starts=1, known=grid)


def test_bounds_of_a_region_are_in_order_though_its_grid_is_known(placement):
    known, turned = survey(placement, BOX, 0.3), BOX[:, ::-1]
    with pytest.raises(InputError, match="lower < upper"):
        extreme_position(placement, turned, "lowest_welder", spacing=0.3, starts=1, known=known)
