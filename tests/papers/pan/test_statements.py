"""What `pan` says of its search and its optimum is judged by rules that can fail."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from evaluated_items import evaluated

from dualarm_repro.ledger import REGISTRY, Verdict, evaluate
from dualarm_repro.papers.pan.pages.optimum.printed_point import fitted, searched
from dualarm_repro.papers.pan.pages.optimum.problem import constraint_disagreements
from dualarm_repro.papers.pan.pages.search.algorithm import (
    seen_inputs,
    seen_steps,
    seen_stops,
)
from dualarm_repro.papers.pan.reading import Measure, Problem, surveyed
from dualarm_repro.papers.pan.studies.consistency import OBJECTIVES, READINGS
from dualarm_repro.papers.pan.studies.fit import MEASURES, distance, loss_at_print
from dualarm_repro.welding import Status
from dualarm_repro.welding.landscape import reaches_point

#: A region out of reach of every robot.
_FAR = [[4.0, 4.2], [4.0, 4.2], [4.0, 4.2]]
AWAY = {"search_box": _FAR, "ga_box": _FAR, "ga_generations": 15}


@pytest.fixture(scope="module")
def trace(watched):
    return watched()


def test_welder_stays_near_zero_with_a_bent_and_inclined_torch(registry):
    """Each change alone does not do it."""
    bent, inclined = {"torch_crank": 45}, {"torch_axis": "work_angle_45"}
    both = evaluate(REGISTRY, "pan.claim_near_zero_robot3", bent | inclined)
    assert both.verdict is Verdict.UNDER_ASSUMPTION
    for one in ({}, bent, inclined):
        alone = evaluate(REGISTRY, "pan.claim_near_zero_robot3", one)
        assert alone.verdict is Verdict.NOT_REPRODUCED


def test_a_choice_makes_the_printed_point_the_optimum(registry):
    limits = {n: t.value for n, t in REGISTRY.look("pan.claim_optimum").thresholds.items()}
    assert limits["inside_branch"] == REGISTRY.declared("pan.radius_branch", "range").range[0]
    found = fitted()[0]["values"]
    problem = Problem.of(REGISTRY.nominal("pan") | found)
    assert distance(problem) <= limits["inside_branch"]
    assert loss_at_print(problem) <= limits["three_digits"]
    assert evaluate(REGISTRY, "pan.claim_optimum", found).verdict is Verdict.UNDER_ASSUMPTION
    assert evaluated("pan.claim_optimum").verdict is Verdict.NOT_REPRODUCED


def test_every_reading_is_searched_in_the_words_of_the_ledger(registry):
    table = searched()
    assert set(zip(table["base_transform"], table["measure"], strict=True)) == set(
        product(READINGS, MEASURES)
    )
    for name, changes in MEASURES.items():
        assert Measure.of(REGISTRY.nominal("pan") | changes).reading() == OBJECTIVES[name]
    assert (table["evaluations"] >= table["evaluations"].max() / 4)[~table["met"]].all()


def test_position_b_asks_for_faster_joints(registry):
    calm = evaluated("pan.claim_sudden_turns").result.obtained
    assert calm["ratio"] > 1.0
    assert calm["position"] == evaluated("pan.claim_unstable_b").result.obtained["position"]


def test_a_start_that_is_lost_was_within_reach(registry):
    """Where the whole job is possible its first point is; the converse is what fails."""
    task = Problem.of(REGISTRY.nominal("pan"))
    grid = surveyed(task)
    begun = reaches_point(task.job.cell(), grid.points, 0)
    assert begun[grid.fitness > 0].all()
    found = evaluated("pan.claim_bad_start").result.obtained
    assert 0 < found["lost"] < found["begun"] == begun.sum() < len(begun)


def test_a_region_in_which_no_start_is_lost(registry):
    whole = {"search_box": [[0.0, 0.1], [0.0, 0.1], [0.6, 0.7]]}
    found = evaluate(registry, "pan.claim_bad_start", whole)
    assert found.result.obtained["lost"] == 0 < found.result.obtained["begun"]
    assert found.verdict is Verdict.NOT_REPRODUCED


def test_contact_with_the_floor_is_no_collision_of_robots(registry):
    """The floor is no obstacle of the document; a short pipe brings the arms to the workpiece."""

    def found(**changes):
        return evaluate(registry, "pan.claim_meets_collision", changes)

    declared, bare = found(), found(floor="absent")
    assert declared.verdict is bare.verdict is Verdict.NOT_REPRODUCED
    assert declared.result.obtained["floor_alone"] > 0 == bare.result.obtained["floor_alone"]
    short = found(workpiece_length=0.3)
    assert short.verdict is Verdict.UNDER_ASSUMPTION
    assert not any("floor" in pair for pair in short.result.obtained["pairs"])


def test_coarse_points_are_no_weld(registry):
    fine = evaluate(REGISTRY, "pan.claim_joint_sequence", {"seam_points": 144})
    coarse = evaluate(REGISTRY, "pan.claim_joint_sequence", {"seam_points": 18})
    assert fine.verdict.meets_print
    assert coarse.verdict is Verdict.NOT_REPRODUCED
    assert coarse.result.obtained["separation"] > 0


@pytest.mark.parametrize(
    "key",
    [
        "claim_bad_start",
        "claim_constraints",
        "claim_energy",
        "claim_joint_sequence",
        "claim_meets_collision",
        "claim_meets_singularity",
        "claim_sudden_turns",
        "claim_fitness_converges",
        "claim_max_mmr",
        "claim_near_zero_robot3",
        "claim_optimum",
        "claim_unstable_b",
        "eq_opt",
    ],
)
def test_region_without_feasible_position_is_an_outcome(registry, key):
    assert evaluate(REGISTRY, f"pan.{key}", AWAY).verdict is Verdict.NOT_REPRODUCED


def test_weights_are_judged_as_used(registry):
    for weights in ("equal", "harmonic", "tight_only"):
        found = evaluate(REGISTRY, "pan.claim_beta_rule", {"weights": weights})
        assert found.verdict is Verdict.NOT_REPRODUCED
    for space in ("translational", "full"):
        for carriers in ("mean", "sum", "coupled_pair"):
            changes = {"ellipsoid_space": space, "carrier_weight": carriers}
            assert evaluate(REGISTRY, "pan.claim_beta_rule", changes).verdict.meets_print


def test_objective_of_the_carriers_alone_is_not_the_printed_one(registry):
    found = evaluate(REGISTRY, "pan.eq_opt", {"objective": "tight"})
    assert found.verdict is Verdict.NOT_REPRODUCED


def test_trace_shows_what_the_run_did(trace):
    _, crossed, mutants = trace.settings.counts
    assert trace.order[0] == "initialise"
    assert trace.evaluated[0] == trace.settings.population
    assert set(trace.evaluated[1:]) == {crossed + mutants}
    assert trace.rated == trace.met < trace.tested


def test_steps_that_are_not_run_are_not_seen(trace):
    assert "crossover probability" not in seen_inputs(replace(trace, crossed=[0]))
    assert "constraints" not in seen_inputs(replace(trace, infeasible_passed_on=1))
    assert seen_steps(replace(trace, rated=trace.tested)) == []
    assert seen_steps(replace(trace, order=trace.order[::-1])) != seen_steps(trace)
    assert seen_stops([trace]) == ["smallest change of the mean fitness"]
    assert seen_stops([replace(trace, history=trace.history[:-1])]) == []


def test_a_wrong_status_is_found(registry):
    declared = Problem.of(REGISTRY.nominal("pan"))
    status = surveyed(declared).status
    assert constraint_disagreements(declared, status) == 0
    swapped = np.where(status == Status.COLLISION, Status.FEASIBLE, Status.COLLISION)
    assert constraint_disagreements(declared, swapped) > 0
