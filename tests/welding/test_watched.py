"""A watched run is the run itself, and stop rules end it where they first hold."""

import numpy as np
import pytest

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
    assert first_stop(rising, 30, 1e-6) == (30, "generations")
    assert first_stop(resting, 30, 1e-6) == (10, "stall")
    assert first_stop(resting, 5, 1e-6) == (5, "generations")
    assert first_stop(rising[:5], 30, 1e-6) == (5, "none")
    assert first_stop(np.zeros(40), 30, 1e-6) == (30, "generations")
