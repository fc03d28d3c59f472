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
    """A study of cells that take so long [s], and the numbers of those that are computed."""

    def use(count, seconds):
        computed, now = [], [0.0]

        def cell(k, _):
            now[0] += seconds(k)
            computed.append(k)

        study = SimpleNamespace(
            name="toy",
            cells=lambda: [{}] * count,
            cell=cell,
            handed_out=lambda chunks: [*range(1, len(chunks)), 0],
        )
        monkeypatch.setattr(workers, "load", lambda: SimpleNamespace(studies={"toy": study}))
        monkeypatch.setattr(workers, "perf_counter", lambda: now[0])
        monkeypatch.setattr(workers, "process_time", lambda: 3.0 * now[0])
        return study, computed

    return use


def test_a_sample_of_a_study_is_scaled_to_the_whole_and_nothing_is_computed_twice(study_of):
    study, computed = study_of(1000, lambda k: 0.05)
    one = workers.sampled("toy")
    costs = one["costs"]
    sample = workers.drawn_parts(study)[: len(costs)]
    parted = [k for part in sample for k, _ in part]
    assert computed == 2 * [k for k, _ in sample[0]] + parted
    assert one["seconds"] == pytest.approx(50.0)
    assert one["cpu_seconds"] == pytest.approx(150.0)
    assert workers.SECONDS < sum(costs) < workers.SECONDS + 0.3
    computed.clear()
    found = workers.waited("toy", 1, costs)
    assert found["seconds"] == pytest.approx(50.0)
    assert found["cpu_seconds"] == pytest.approx(150.0)
    assert found["start_seconds"] >= 0.0
    warm = computed[: 2 * len(sample[0])]
    assert warm == 2 * [k for k, _ in sample[0]]
    assert sorted(computed[len(warm) :]) == sorted(parted)


def test_the_dearest_parts_of_a_sample_are_handed_out_first(study_of):
    _, computed = study_of(100, lambda k: 0.1 + 0.01 * k)
    costs = workers.sampled("toy")["costs"]
    computed.clear()
    workers.waited("toy", 1, costs)
    assert 8 <= len(costs) < 100
    assert computed[2:] == sorted(computed[2:], reverse=True)


def test_a_study_of_few_dear_cells_is_measured_whole_and_in_its_order(study_of):
    _, computed = study_of(4, lambda k: 5.0)
    costs = workers.sampled("toy")["costs"]
    computed.clear()
    assert workers.waited("toy", 1, costs)["seconds"] == 20.0
    assert computed[2:] == [1, 2, 3, 0]


@pytest.mark.parametrize(("seconds", "turns"), [(5.0, 3), (50.0, 1)])
def test_what_takes_seconds_is_measured_by_turns_and_the_median_told(monkeypatch, seconds, turns):
    studies = {"toy": SimpleNamespace(missing_peers=list), "peers": None}
    studies["peers"] = SimpleNamespace(missing_peers=lambda: ["ompl"])
    asked, walls = [], {1: iter([8.0, 6.0]), 2: iter([3.0, 9.0, 4.0])}

    def process(call, name, workers=1, costs=None):
        asked.append(workers)
        made = {"cpu_seconds": 1.0, "start_seconds": 0.5}
        if call == "sampled":
            return {**made, "seconds": 7.0, "costs": [seconds]}
        return {**made, "seconds": next(walls[workers])}

    monkeypatch.setattr(workers, "load", lambda: SimpleNamespace(studies=studies))
    monkeypatch.setattr(workers, "_in_a_process", process)
    monkeypatch.setattr("os.cpu_count", lambda: 2)
    (found,) = workers.times()["series"]
    one, two = found["points"]
    assert asked == ([1, 2, 2, 1, 1, 2] if turns == 3 else [1, 2])
    assert (one["x"], two["x"]) == (1, 2)
    assert (one["seconds"], two["seconds"]) == ((7.0, 4.0) if turns == 3 else (7.0, 3.0))
    assert two["quartiles"] == ([3.5, 6.5] if turns == 3 else [3.0, 3.0])


def test_distances_among_obstacles_are_those_of_the_peer():
    """The peer compares its distances with ours before it is timed."""
    obstacles._peer(10)()
    found = scene.distances(obstacles.scene_of(10), obstacles.postures(10))
    assert found.shape == (obstacles.CONFIGURATIONS, 50)
