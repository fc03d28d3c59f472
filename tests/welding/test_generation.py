"""The arithmetic of one generation of the genetic algorithm, against numpy and by hand."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.distance import pdist

from dualarm_repro.errors import InputError
from dualarm_repro.welding import GeneticSettings
from dualarm_repro.welding import genetic as ga
from dualarm_repro.welding.generation import (
    bred,
    mean_distance,
    pointed_at,
    shifted,
    sorted_by_value,
    stepped,
)

LOW, HIGH = np.array([-1.0, 0.0, 2.0]), np.array([1.0, 4.0, 3.0])


@pytest.mark.parametrize("count", [1, 7, 128, 129, 300])
def test_individuals_are_sorted_and_ties_stay_in_order(count):
    rng = np.random.default_rng(count)
    values = rng.integers(0, max(2, count // 3), count).astype(float)
    people = np.column_stack([np.arange(count, dtype=float), values])
    found, sizes = sorted_by_value(people, values)
    order = sorted(range(count), key=lambda k: -values[k])
    np.testing.assert_array_equal(found, people[order])
    np.testing.assert_array_equal(sizes, values[order])


@pytest.mark.parametrize("shape", [(2, 1), (5, 3), (40, 6)])
def test_the_mean_distance_is_that_of_scipy(shape):
    points = np.random.default_rng(1).normal(size=shape)
    assert mean_distance(points) == pytest.approx(pdist(points).mean())


@pytest.mark.parametrize(
    ("start", "slots"), [(0.0, [0, 0, 0, 1]), (0.5, [0, 0, 1, 2]), (0.99, [0, 0, 1, 2])]
)
def test_pointers_on_a_wheel_by_hand(start, slots):
    """Shares 1/2, 1/4, 1/4; pointers at (k + start) / 4."""
    assert pointed_at(np.array([0.5, 0.75, 1.0]), start, 4).tolist() == slots


def test_a_wheel_that_ends_below_one_by_rounding_is_not_left():
    wheel = np.array([0.5, 1.0 - 1e-16, 1.0 - 1e-16])
    assert pointed_at(wheel, np.nextafter(1.0, 0.0), 3).max() <= 2


def test_children_take_each_coordinate_from_one_parent():
    people = np.repeat([[7.0], [8.0], [0.0], [1.0], [0.5]], 3, axis=1)
    parents = np.array([2, 2, 3, 3, 4])
    draws, noise = np.array([[0.0, 0.49, 0.5], [0.51, 0.99, 0.1]]), np.array([[1.0, -2.0, 9.0]])
    step, box = np.array([0.1, 0.2, 0.3]), (np.zeros(3), np.ones(3))
    children = bred(people, parents, draws, noise, step, *box, True)
    assert children[:2].tolist() == people[:2].tolist()
    assert children[2:4].tolist() == [[0, 0, 1], [1, 1, 0]]
    np.testing.assert_allclose(children[4], [0.6, 0.1, 1.0])
    turned = bred(people, parents, draws, noise, step, *box, False)
    assert turned[:4].tolist() == children[:4].tolist()
    assert np.abs(turned[4] - 0.5).max() <= 0.5


@settings(max_examples=30)
@given(seed=st.integers(0, 10**6), size=st.floats(0.01, 10.0))
def test_mutants_stay_in_the_box_and_move_as_their_noise_says(seed, size):
    rng = np.random.default_rng(seed)
    parents = rng.uniform(LOW, HIGH, (20, 3))
    noise = rng.normal(size=(20, 3))
    children = np.empty_like(parents)
    deviation = size * (HIGH - LOW)
    shifted(parents, noise, deviation, LOW, HIGH, children)
    np.testing.assert_allclose(children, (parents + deviation * noise).clip(LOW, HIGH))
    stepped(parents, noise, deviation, LOW, HIGH, children)
    assert (children >= LOW).all()
    assert (children <= HIGH).all()
    unit = deviation * noise / np.linalg.norm(noise, axis=1, keepdims=True)
    for parent, child, way in zip(parents, children, unit, strict=True):
        # One factor in [0, 1] for all coordinates: the direction is kept.
        factor = (child - parent) @ way / (way @ way)
        assert -1e-9 <= factor <= 1.0 + 1e-9
        np.testing.assert_allclose(child, parent + factor * way, atol=1e-9)
        at_wall = np.isclose(child, LOW, atol=1e-9) | np.isclose(child, HIGH, atol=1e-9)
        assert factor > 1.0 - 1e-9 or at_wall.any()


@pytest.mark.parametrize(
    ("settings", "counts"),
    [
        ({}, (3, 38, 9)),
        ({"population": 4, "elite": 0.0}, (0, 3, 1)),
        ({"population": 10, "elite": 0.11, "crossover": 0.0}, (2, 0, 8)),
    ],
)
def test_how_many_are_kept_crossed_and_mutated(settings, counts):
    assert GeneticSettings(**settings).counts == counts


def test_the_wheel_falls_with_the_root_of_the_rank():
    wheel = GeneticSettings(population=4).wheel
    share = np.diff(wheel, prepend=0.0)
    np.testing.assert_allclose(share / share[0], [1, 2**-0.5, 3**-0.5, 0.5])
    assert wheel[-1] == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("values", "rests"),
    [
        ([5.0, 5.0, 5.0, 5.0], True),
        ([5.0, 5.0, 5.0], False),  # not enough generations yet
        ([1.0, 5.0, 5.0, 5.0, 5.0], True),  # only the last four count
        ([5.0, 5.0, 5.0, 5.1], False),
        ([5.0, 5.004, 5.0, 5.004], True),  # 0.004 a generation of 5.004
        ([5.0, 5.006, 5.0, 5.006], False),
        ([0.0, 0.0, 0.0, 0.0], False),  # nothing feasible is no stall
    ],
)
def test_a_stall_by_hand(values, rests):
    settings = GeneticSettings(stall=1e-3, stall_generations=3)
    history = [ga.Generation(best=7.0, mean=v, distance=0.0, feasible=1.0) for v in values]
    assert ga.rests(history, settings) is rests
    best = GeneticSettings(stall=1e-3, stall_generations=3, stall_of="best")
    assert ga.rests(history, best) is (len(values) > 3), "the best never changed"


def search_of(**settings):
    made = ga.Search(
        lambda p: p[:, 0] + 1.0, LOW, HIGH, GeneticSettings(**settings), np.random.default_rng(3)
    )
    ga.initialise(made)
    ga.evaluate(made)
    return made


def test_a_step_grows_after_a_success_and_shrinks_after_a_failure():
    search = search_of(mutation="adaptive_feasible")
    ga.rank(search)
    assert search.step == 1.0
    ga.rank(search)  # the same best again
    assert search.step == 0.25
    search.individuals[7, 0], search.values[7] = 1.0, 2.0 * search.values.max()
    ga.rank(search)
    assert search.step == 1.0
    for _ in range(20):
        ga.rank(search)
    assert search.step == 1e-6


def test_the_record_of_a_generation_by_hand():
    search = search_of(population=4)
    search.individuals = np.array([[0.0, 0, 2], [0, 3, 2], [0, 0, 2], [0, 3, 2]])
    search.values = np.array([1.0, 0.0, 4.0, 3.0])
    ga.rank(search)
    assert search.history[-1] == (4.0, 2.0, pytest.approx(2.0), 0.75)
    assert search.values.tolist() == [4.0, 3.0, 1.0, 0.0]


def test_the_elite_passes_on_and_is_not_asked_for_again():
    search = search_of(population=20, elite=0.1)
    ga.rank(search)
    best = search.individuals[:2].copy()
    ga.select(search)
    ga.reproduce(search)
    np.testing.assert_array_equal(search.individuals[:2], best)
    assert search.known == 2
    before = search.evaluations
    ga.evaluate(search)
    assert search.evaluations - before == 18


@pytest.mark.parametrize(
    ("fitness", "text"),
    [
        (lambda p: np.ones(len(p) - 1), "fitness = "),
        (lambda p: np.full(len(p), np.nan), "fitness = nan: expected 4 finite numbers"),
        (lambda p: np.array(["a"] * len(p)), "fitness"),
        (lambda p: 1.0, "fitness = 1.0"),
    ],
)
def test_a_fitness_that_gives_something_else_is_refused(fitness, text):
    with pytest.raises(InputError, match=text):
        ga.rated(fitness, np.zeros((4, 3)))
