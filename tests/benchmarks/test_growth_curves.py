"""Growth curves: what is measured at which size, and what is claimed of it."""

from importlib import import_module
from types import SimpleNamespace

import growth
import growth_claims
import numpy as np
import pytest
import timing
from curves import obstacles, workers
from growth import Series

import dualarm_repro.scene as scene


@pytest.fixture(autouse=True)
def no_repeats(monkeypatch):
    monkeypatch.setattr(timing, "TURN", 0.0)


def curve_of(name, seconds, **peak):
    points = [{"x": x, "seconds": s, "cpu_seconds": s} for x, s in seconds.items()]
    return {"name": name, "series": [{"name": "dualarm_repro", "points": points}], "peak_mb": peak}


def test_each_series_is_measured_at_its_sizes():
    made = []

    def prepare(n):
        made.append(n)
        return lambda: None

    both = [Series("ours", prepare, (1, 10)), Series("bound", prepare, (1,), limit=True)]
    found = growth.times("title", "things", both, rounds=5, budget=1.0)
    assert made == [1, 1, 10]
    assert [[p["x"] for p in s["points"]] for s in found["series"]] == [[1, 10], [1]]
    assert [s["limit"] for s in found["series"]] == [False, True]


def test_peak_memory_sees_an_array():
    before = growth._peak()
    large = int((before + 100.0) * 1e6 / 8)  # more than this process has ever held
    found = growth.memory([Series("ours", lambda n: lambda: np.ones(n), (1, large))])
    assert list(found) == ["1", str(large)]
    assert found["1"] < before + 50.0
    assert found[str(large)] > before + 90.0


@pytest.mark.parametrize(("power", "factor"), [(1.0, 2.0), (2.0, 4.0), (0.5, 2**0.5)])
def test_growth_of_a_doubling(power, factor):
    points = [{"x": x, "cpu_seconds": 3e-6 * x**power} for x in (10, 100, 5_000)]
    assert growth_claims.doubling(points) == pytest.approx(factor)


def test_the_worst_doubling_counts():
    points = [{"x": x, "cpu_seconds": s} for x, s in ((1, 1.0), (2, 2.0), (4, 6.0), (8, 6.0))]
    assert growth_claims.doubling(points) == pytest.approx(3.0)


def test_claims_of_curves():
    linear = {n: 1e-8 * n for n in (10, 1_000, 10_000)}
    made = growth_claims.judged([
        curve_of("configurations", {**linear, 10: 1.0}, **{"10000": 2_200.0}),
        two_studies(1.9, 1.7),
    ])  # fmt: skip
    assert [one["value"] for one in made] == pytest.approx([2.0, 2_200.0, 1.7])
    assert [one["gate_holds"] for one in made] == [True, False, False]


def two_studies(*gains):
    """The curve of workers, one series a study."""
    both = [curve_of("workers", {1: gain, 2: 1.0})["series"][0] for gain in gains]
    return {**curve_of("workers", {}), "series": both}


def test_one_core_says_nothing_of_two_workers():
    (one,) = growth_claims.judged([curve_of("workers", {1: 1.0})])
    assert (one["gate_holds"], one["reason"]) == (None, "not measured: one core")


@pytest.mark.parametrize("name", [name for name in growth.names() if name != "workers"])
def test_the_first_series_of_a_curve_is_ours(name):
    curve = import_module(f"curves.{name}")
    found = curve.series()
    assert curve.TITLE
    assert curve.X
    assert found[0].name == "dualarm_repro"
    assert all(list(s.sizes) == sorted(s.sizes) for s in found)
    found[0].prepare(found[0].sizes[0])()


@pytest.fixture
def study_of(monkeypatch):
    """A study of fifty cells that take so long [s], and the numbers of those that are computed."""

    def use(seconds):
        computed, now = [], [0.0]

        def cell(k, _):
            now[0] += seconds
            computed.append(k)

        study = SimpleNamespace(name="toy", cells=lambda: [{}] * 50, cell=cell)
        monkeypatch.setattr(workers, "load", lambda: SimpleNamespace(studies={"toy": study}))
        monkeypatch.setattr(workers, "perf_counter", lambda: now[0])
        monkeypatch.setattr(workers, "sleep", lambda _: None)
        return study, computed

    return use


def test_few_cells_of_a_dear_study_are_drawn_and_each_is_computed_twice(study_of):
    study, computed = study_of(5.0)
    drawn, order = workers.drawn("toy"), workers.order_of(study)
    assert drawn == [5.0, 5.0]
    computed.clear()
    assert workers.spent("toy", 1, drawn)["seconds"] == 20.0
    assert sorted(computed) == sorted([order[0], *order[:2] * 2])


def test_no_cell_is_computed_again_where_there_are_enough(study_of):
    computed = study_of(0.2)[1]
    drawn = workers.drawn("toy")
    computed.clear()
    assert workers.spent("toy", 1, drawn)["seconds"] == pytest.approx(0.2 * len(drawn))
    assert len({*computed}) == len(computed) == 1 + len(drawn)


def test_distances_among_obstacles_are_those_of_the_peer():
    """The peer compares its distances with ours before it is timed."""
    obstacles._peer(10)()
    found = scene.distances(obstacles.scene_of(10), obstacles.postures(10))
    assert found.shape == (obstacles.CONFIGURATIONS, 50)
