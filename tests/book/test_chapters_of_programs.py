"""The chapters of `patent` and `pan` run what they tell of, and obtain what the ledger obtained."""

import ast
import re

import numpy as np
import pytest
from chapters import calls_in, cells_of, chapters_of, obtained_for
from chapters import run as run_cells
from long_tests import long_where

from dualarm_repro.control import (
    ControllerSettings,
    NetworkSettings,
    integrate_network,
    simulate_network,
    solve,
)
from dualarm_repro.ledger.comparison import comparisons
from dualarm_repro.ledger.drift import differences
from dualarm_repro.ledger.files import through_json
from dualarm_repro.papers.pan.reading import Job, Problem, optimum
from dualarm_repro.papers.patent.document import COARSE_STEP, CONTROL_STEP, frozen, run
from dualarm_repro.view.cell import value_at
from dualarm_repro.welding import GeneticSettings, Status, evolve

#: Page to calls that its story needs.
METHODS = {
    "patent/problem": """
        frozen traced_steps self_motion central_differences run approach_bound cp.Variable
        cp.Minimize cp.Problem least_velocity solve effort
    """,
    "patent/network": """
        solve penalty rest_point L.diff sp.BlockMatrix code_error state_matrix np.linalg.solve
        state_rate simulate_network integrate_network proof_steps odd_and_increasing decay
    """,
    "patent/avoidance": """
        run controller.problem draw_task stands_clear naive_motion simulate simulate_network
        simulate_guarded pseudo_inverse_cost crossing axis_distances
    """,
    "patent/contest": """
        exact_cost exact_cost_after steps_in_a_row network_errors primal_dual_errors network_flow
        primal_dual_flow contest exact_batch
        simulate_network simulate_primal_dual integrate_network simulate_in_single_precision
        low_pass
    """,
    "pan/cell": """
        arm.link_transforms base_poses saddle_seam flat_rotations Workpiece assemble Placement
        flange_poses periodic_derivative torch_tips
    """,
    "pan/measure": """
        np.linalg.eigh closed_form block_diag cell_grams intersection_volume inverse_volumes
        Objective best_by_unit
    """,
    "pan/optimum": """
        survey grid_optimum nearer_image fitness optimum measures_at extreme_position
    """,
    "pan/search": """
        Search initialise act evolve optimise
    """,
    "pan/weld": """
        arc_speed timed certified_separation interpolation_offset torch_angles retract effort
    """,
}
#: Pages to run; those that take long only where there is time. The book runs them all.
LONGEST = "patent/contest"
LONG = (LONGEST, "patent/avoidance", "patent/network", "pan/optimum", "pan/search")
RUN = long_where(LONG.__contains__, METHODS)
OF_A_LONG_PAGE = pytest.mark.long(reason="it reads what a page computes that takes long")


def test_every_chapter_has_its_methods():
    assert set(METHODS) == {*chapters_of("patent"), *chapters_of("pan")}


@pytest.mark.parametrize("page", METHODS)
def test_methods_are_called_where_the_reader_sees_them(page):
    assert set(METHODS[page].split()) <= set.union(*map(calls_in, cells_of(page)))


@pytest.mark.parametrize("page", METHODS)
def test_cells_name_no_path(page):
    for node in ast.walk(ast.parse("\n".join(cells_of(page)))):
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            assert not re.search(r"/(home|root|tmp|work)/", node.value)


@pytest.mark.parametrize("page", RUN)
def test_every_cell_shows_what_it_promises(page):
    ran = run_cells(page)
    assert (ran.silent, ran.warned, ran.left) == ([], [], [])


def nested(key, value):
    """A value below the keys of its dotted key."""
    for part in reversed(key.split(".")):
        value = {part: value}
    return {"obtained": value}


@pytest.mark.parametrize("page", RUN)
def test_a_page_obtains_what_its_cards_judge(page, registry):
    found = run_cells(page).compared
    assert found, "a page sets a number of its own beside the ledger"
    for item_id, key, computed in found:
        assert registry.checkers[item_id].page == page
        declared = comparisons(registry.item(item_id), registry.checkers[item_id].rules)
        value = through_json({"value": computed})["value"]
        expected = nested(key, value_at(obtained_for(item_id), key))
        assert differences(expected, nested(key, value), declared) == [], item_id
        if isinstance(value, float) and abs(value) > 1e-3:
            assert differences(expected, nested(key, 1.1 * value), []), "a wrong one is seen"


def test_the_programme_of_the_page_is_that_of_the_library():
    names = run_cells("patent/problem").names
    problem, least_velocity = names["problem"], names["least_velocity"]
    for pressed in (problem, names["within"]):
        x, z, _ = least_velocity(pressed)
        library = solve(pressed, "cvxpy")
        assert np.abs(x - library.x).max() < 1e-6
        assert np.abs(z - library.z).max(initial=0.0) < 1e-4
    log = names["log"]
    assert log["active"].max() >= 1
    assert log["apart"].max() < 1e-5
    assert log["distance"].min() > names["settings"].inner - 1e-3


@OF_A_LONG_PAGE
def test_the_network_of_the_page_is_that_of_the_library():
    names = run_cells("patent/network").names
    assert np.abs(names["velocities"] - names["motion"].x).max() < 1e-8
    beside = names["beside"]
    pressing = beside[["row", "bound"]].max(axis=1) > 1e-6
    assert beside["network"][pressing].median() > 10 * beside["lag"][pressing].median()


@OF_A_LONG_PAGE
def test_the_draws_of_the_page_are_those_of_the_study():
    sample = run_cells("patent/avoidance").names["sample"]
    assert len(sample) >= 3
    for solver in ("QP", "network"):
        assert np.allclose(sample[solver], sample[f"{solver}, stored"], rtol=1e-4)


def test_the_cell_of_the_page_is_that_of_the_items():
    names = run_cells("pan/cell").names
    own, judged = names["cell"], Job.of(names["assumed"]).cell()
    for array in ("bases", "rotations", "flanges", "references", "seam", "pipe_axes", "pipe_cores"):
        assert np.allclose(getattr(own, array), getattr(judged, array), atol=1e-12), array
    assert own.threshold == judged.threshold
    assert own.floor == judged.floor


@OF_A_LONG_PAGE
def test_the_loop_of_the_page_is_the_search():
    names = run_cells("pan/search").names
    assert names["again"]
    assert names["truth"].fitness >= names["run"].fitness > 0


def test_what_a_reader_of_patent_is_told_to_change_has_the_consequence():
    scenario, settings = frozen("crossing"), ControllerSettings()
    assert run(scenario, settings.changed(avoid=False), COARSE_STEP).smallest_distance < -0.05
    assert run(scenario, settings.changed(inner=0.06), COARSE_STEP).smallest_distance > 0.059
    late = run(scenario, settings.changed(damper_gain=50.0), COARSE_STEP)
    assert late.smallest_distance > 0.029
    assert late.peak_acceleration > 2 * run(scenario, settings, COARSE_STEP).peak_acceleration
    bare = simulate_network(
        *scenario.parts, settings, NetworkSettings(hessian=False), dt=CONTROL_STEP
    )
    assert not bare.completed
    fed, unfed = (
        simulate_network(
            *scenario.parts, settings, NetworkSettings(feed_forward=kind), dt=CONTROL_STEP
        )
        for kind in ("all", "none")
    )
    assert unfed.largest_error > 10 * fed.largest_error


@OF_A_LONG_PAGE
def test_without_feedback_a_wrong_state_is_kept():
    names = run_cells(LONGEST).names
    y0 = names["starts"]["random"]
    for feedback, kept in ((0.0, True), (10.0, False)):
        changed = ControllerSettings(feedback=feedback)
        motion, _ = integrate_network(*names["parts"], changed, NetworkSettings(), y0=y0)
        assert (motion.error[-1].max() > 1e-3) == kept


def test_what_a_reader_of_pan_is_told_to_change_has_the_consequence(registry):
    values = registry.nominal("pan")
    problem = Problem.of(values)
    printed = [[float(x) for x in registry.printed("pan.claim_optimum")["C"]]]
    assert problem.placement().jobs(printed).status[0] != Status.FEASIBLE
    longer = Problem.of(values | {"torch_length": 0.45})
    assert optimum(longer).position[2] < optimum(problem).position[2] - 0.05
    adaptive = GeneticSettings(mutation="adaptive_feasible")
    found = evolve(problem.placement(), problem.box, adaptive, np.random.default_rng(17))
    assert found.reason == "stall"
