"""The genetic algorithm and its peers, on functions with a known maximum and on a cell."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualarm_repro.errors import InputError, UnknownNameError
from dualarm_repro.welding import GeneticSettings, Objective, Placement, evolve, grid_optimum
from dualarm_repro.welding import genetic as ga
from dualarm_repro.welding.grid_search import (
    best_cells,
    grid_points,
    pattern_search,
    ranked,
    refined,
)
from dualarm_repro.welding.peers import OPTIMISERS

from .cells import BOX, make_cell

PEAK = np.array([0.2, -0.3, 0.7])


def hill(points):
    """A smooth hill that is infeasible (0) outside a ball of radius 0.5."""
    square = np.sum((points - PEAK) ** 2, axis=1)
    return np.where(square < 0.25, np.exp(-4 * square), 0.0)


@pytest.mark.parametrize("mutation", ga.MUTATIONS)
@pytest.mark.parametrize("infeasible", ga.INFEASIBLE)
def test_finds_the_hill(mutation, infeasible):
    settings = GeneticSettings(mutation=mutation, infeasible=infeasible)
    for seed in range(3):
        found = evolve(hill, BOX, settings, np.random.default_rng(seed))
        assert found.found
        assert found.fitness > 0.998
        assert np.linalg.norm(found.best - PEAK) < 0.03


@settings(max_examples=20)
@given(st.integers(0, 10_000), st.integers(4, 40), st.sampled_from(ga.MUTATIONS))
def test_invariants(seed, population, mutation):
    settings = GeneticSettings(population=population, generations=15, mutation=mutation)
    asked = []

    def fitness(points):
        asked.append(points)
        return hill(points)

    found = evolve(fitness, BOX, settings, np.random.default_rng(seed))
    best = [generation.best for generation in found.history]
    assert best == sorted(best)
    assert sum(map(len, asked)) == found.evaluations
    points = np.concatenate(asked)
    assert (points >= BOX[:, 0]).all()
    assert (points <= BOX[:, 1]).all()
    assert sum(settings.counts) == population
    assert found.fitness == hill(points).max()
    assert all(g.mean <= g.best for g in found.history)


def test_same_seed_same_run():
    runs = [evolve(hill, BOX, GeneticSettings(), np.random.default_rng(7)) for _ in range(2)]
    assert (runs[0].best == runs[1].best).all()
    assert runs[0].history == runs[1].history
    other = evolve(hill, BOX, GeneticSettings(), np.random.default_rng(8))
    assert other.history != runs[0].history


def test_both_rules_end_a_run():
    long = evolve(hill, BOX, GeneticSettings(stall=0.0, generations=20), np.random.default_rng(1))
    assert (long.reason, len(long.history)) == ("generations", 21)
    flat = evolve(lambda p: np.ones(len(p)), BOX, GeneticSettings(), np.random.default_rng(1))
    assert (flat.reason, len(flat.history)) == ("stall", 11)


def test_nothing_feasible():
    given = (lambda p: np.zeros(len(p)), BOX, GeneticSettings(generations=5))
    found = evolve(*given, np.random.default_rng(1), must_find=False)
    assert not found.found
    with pytest.raises(InputError, match="none of the 285 evaluated ones is"):
        evolve(*given, np.random.default_rng(1))
    nowhere = grid_optimum(lambda p: np.zeros(len(p)), BOX, 0.5)
    assert nowhere.fitness == 0
    assert np.isnan(nowhere.position).all()


@pytest.mark.parametrize("seed", range(4))
def test_parents_are_drawn_in_proportion_to_one_over_the_root_of_their_rank(seed):
    search = ga.Search(hill, *BOX.T, GeneticSettings(), np.random.default_rng(seed))
    ga.initialise(search)
    ga.evaluate(search)
    ga.rank(search)
    ga.select(search)
    count = [np.sum((search.parents == row).all(axis=1)) for row in search.individuals]
    assert sum(count) == len(search.parents) == 2 * 38 + 9
    share = np.arange(1.0, 51.0) ** -0.5
    # equally spaced pointers: each count is the expected one, rounded down or up
    assert np.abs(count - len(search.parents) * share / share.sum()).max() < 1.0


@pytest.mark.parametrize(
    ("changes", "field"),
    [
        ({"population": 1}, "population = 1"),
        ({"generations": 0}, "generations = 0"),
        ({"crossover": 1.0}, "crossover = 1.0"),
        ({"elite": -0.1}, "elite = -0.1"),
    ],
)
def test_bad_settings(changes, field):
    with pytest.raises(InputError, match=field):
        GeneticSettings(**changes)


def test_unknown_operators():
    with pytest.raises(UnknownNameError, match="gaussian, adaptive_feasible"):
        GeneticSettings(mutation="uniform")
    with pytest.raises(UnknownNameError, match="zero, redraw"):
        GeneticSettings(infeasible="penalty")


@pytest.mark.parametrize(
    "box",
    [
        *(BOX[:, ::-1], BOX[:, :1], BOX * np.inf, np.zeros((3, 2))),
        *(np.empty((0, 2)), BOX[np.newaxis], BOX[0], 3.0, np.array([])),
    ],
)
def test_bad_box(box):
    with pytest.raises(InputError, match="lower < upper"):
        evolve(hill, box, GeneticSettings(), np.random.default_rng(1))
    with pytest.raises(InputError, match="lower < upper"):
        grid_optimum(hill, box, 0.1)
    with pytest.raises(InputError, match="lower < upper"):
        grid_points(box, 0.1)


def test_grid_and_pattern_search():
    points = grid_points(BOX, 0.1)
    assert points.min(axis=0) == pytest.approx(BOX[:, 0])
    assert points.max(axis=0) == pytest.approx(BOX[:, 1])
    assert np.diff(np.unique(points[:, 0])).max() <= 0.1 + 1e-12
    end = pattern_search(hill, np.array([0.0, 0.0, 0.6]), BOX, 0.1, 1e-6)
    assert np.linalg.norm(end.position - PEAK) < 1e-5
    cells = best_cells(points, hill(points), 5, 0.15)
    assert len(cells) == 5
    assert (hill(cells) == np.sort(hill(cells))[::-1]).all()
    assert refined(hill, np.empty((0, 3)), BOX, 0.1, 1e-3).fitness == 0
    assert np.linalg.norm(grid_optimum(hill, BOX, 0.2).position - PEAK) < 1e-4


@pytest.mark.parametrize("name", list(OPTIMISERS))
def test_peers_keep_the_budget(name):
    asked = []

    def fitness(points):
        asked.append(len(points))
        return hill(points)

    found = OPTIMISERS[name](fitness, BOX, 1500, 3)
    assert sum(asked) == found.evaluations <= 1500
    assert found.fitness > (0.9 if name == "random search" else 0.99)
    again = OPTIMISERS[name](hill, BOX, 1500, 3)
    assert again.fitness == found.fitness


def test_genetic_algorithm_meets_the_ground_truth():
    """Within 0.1 % of the refined grid; mirror optima count as one."""
    placement = Placement(make_cell(count=18), Objective())
    truth = grid_optimum(placement, BOX, 0.1)
    for seed in range(2):
        found = evolve(placement, BOX, GeneticSettings(), np.random.default_rng(seed))
        assert found.fitness > 0.999 * truth.fitness
        gap = np.abs(found.best) - np.abs(truth.position)
        assert np.linalg.norm(gap) < 0.1


def _nearly(values, seed):
    """The same up to round-off."""
    return values * (1.0 + 1e-14 * np.random.default_rng(seed).normal(size=values.shape))


@pytest.mark.parametrize("seed", range(5))
def test_round_off_does_not_choose_between_ties(seed):
    points = np.array([[0.2, 0.1], [-0.2, 0.3], [-0.2, 0.1], [0.0, 0.0], [0.5, 0.5]])
    values = _nearly(np.array([2.0, 2.0, 2.0, 3.0, -1.0]), seed)
    assert ranked(points, values).tolist() == [3, 2, 1, 0, 4]
    assert best_cells(points, values, 2, 0.1).tolist() == [[0.0, 0.0], [-0.2, 0.1]]
    assert ranked(points, values + np.array([1e-9, 0, 0, 0, 0])).tolist() == [3, 0, 2, 1, 4]
    assert ranked(points[:0], values[:0]).tolist() == []


@pytest.mark.parametrize("seed", range(5))
def test_search_of_a_symmetric_hill_ends_at_the_same_of_its_peaks(seed):
    rng = np.random.default_rng(seed)

    def peaks(points):
        """Two equal hills, mirror images of each other, joined by a ridge that is flat along z."""
        sides = np.exp(-4 * ((np.abs(points[:, 0]) - 0.3) ** 2 + points[:, 1] ** 2))
        return sides * (1.0 + 1e-14 * rng.normal(size=len(points)))

    found = grid_optimum(peaks, BOX, 0.3)
    assert found.position == pytest.approx([-0.3, 0.0, BOX[2, 0]], abs=1e-4)
    steps = pattern_search(peaks, np.array([0.0, 0.0, 0.5]), BOX, 0.1, 1e-3)
    assert steps.position == pytest.approx([-0.3, 0.0, 0.5], abs=2e-3)  # two last steps


def test_known_values_of_the_grid_are_not_asked_for_again():
    asked = []

    def fitness(points):
        asked.append(len(points))
        return hill(points)

    plain = grid_optimum(fitness, BOX, 0.2)
    assert plain.evaluations == sum(asked)
    points = grid_points(BOX, 0.2)
    known = grid_optimum(fitness, BOX, 0.2, values=hill(points))
    assert (known.position == plain.position).all()
    assert known.evaluations == plain.evaluations - len(points)


@pytest.mark.parametrize("values", [np.ones(3), np.empty(0)])
def test_known_values_are_one_for_each_point_of_the_grid(values):
    points = len(grid_points(BOX, 0.2))
    expected = f"length of values = {len(values)}: expected {points}"
    with pytest.raises(InputError, match=expected):
        grid_optimum(hill, BOX, 0.2, values=values)


def test_a_box_of_other_variables_than_the_fitness_has_is_told_with_what_it_raises():
    """The box says how many variables there are; only the fitness knows better."""
    for box, shape in ((BOX[:2], r"\(50, 2\)"), (np.tile(BOX, (2, 1)), r"\(50, 6\)")):
        line = rf"search: fitness of {shape} = 'ValueError: operands .*: expected 50 finite numbers"
        with pytest.raises(InputError, match=line) as caught:
            evolve(hill, box, GeneticSettings(), np.random.default_rng(1))
        assert isinstance(caught.value.__cause__, ValueError)
        with pytest.raises(InputError, match=r"search: fitness of \(\d+, \d\) = 'ValueError"):
            grid_optimum(hill, box, 0.5)


def test_an_error_of_our_own_in_a_fitness_stays_what_it_is():
    placement = Placement(make_cell(count=12), Objective())
    with pytest.raises(InputError, match=r"placement: centres = .*expected finite positions"):
        evolve(placement, BOX[:2], GeneticSettings(), np.random.default_rng(1))
