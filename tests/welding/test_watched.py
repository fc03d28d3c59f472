"""A watched run is the run itself, and stop rules end it where they first hold."""

from dataclasses import replace

import numpy as np
import pytest

from dualarm_repro.errors import InputError
from dualarm_repro.welding import GeneticSettings, Objective, Placement, evolve, watch
from dualarm_repro.welding.watched import first_stop

from .cells import BOX, make_cell


@pytest.mark.parametrize("mutation", ["gaussian", "adaptive_feasible"])
def test_watched_run_is_the_run(mutation):
    placement = Placement(make_cell(count=12), Objective())
    settings = GeneticSettings(population=50, generations=12, mutation=mutation)
    trace = watch(placement, BOX, settings, np.random.default_rng(3))
    found = evolve(placement, BOX, settings, np.random.default_rng(3))
    assert tuple(trace.history) == found.history
    assert trace.reason == found.reason
    assert trace.tested == sum(trace.evaluated) == found.evaluations
    assert trace.rated == trace.met < trace.tested
    elite, crossed, mutants = settings.counts
    assert set(trace.passed_on) == {elite}
    assert set(trace.evaluated[1:]) == {crossed + mutants}
    assert max(trace.mutated) <= mutants
    assert len(trace.infeasible_parents) == len(trace.passed_on) == len(trace.history) - 1


def test_first_stop():
    rising, resting = np.linspace(1, 2, 40), np.ones(40)
    settings = GeneticSettings(generations=30, stall=1e-6)
    assert first_stop(rising, settings) == (30, "generations")
    assert first_stop(resting, settings) == (10, "stall")
    assert first_stop(resting, replace(settings, stall_generations=20)) == (20, "stall")
    assert first_stop(resting, replace(settings, generations=5)) == (5, "generations")
    assert first_stop(rising[:5], settings) == (5, "none")
    assert first_stop(np.zeros(40), settings) == (30, "generations")


def test_a_run_can_be_ended_by_its_best_fitness():
    """The best rests for long while mutants still change the mean."""
    placement = Placement(make_cell(count=12), Objective())
    settings = GeneticSettings(generations=60, mutation="gaussian", stall_generations=8)
    ends = {}
    for watched in ("mean", "best"):
        chosen = replace(settings, stall_of=watched)
        run = evolve(placement, BOX, chosen, np.random.default_rng(3))
        values = np.array([getattr(generation, watched) for generation in run.history])
        ends[watched] = (len(values) - 1, run.reason)
        assert first_stop(values, chosen) == ends[watched]
    assert ends["best"][1] == "stall"
    assert ends["best"] < ends["mean"]


@pytest.mark.parametrize("box", [BOX.T, BOX[:2], np.empty((0, 2))])
def test_the_region_of_a_watched_run_has_three_rows(box):
    placement = Placement(make_cell(count=12), Objective())
    with pytest.raises(InputError, match=r"watch: box \(its shape\) = .*\(3, 2\)"):
        watch(placement, box, GeneticSettings(), np.random.default_rng(3))
