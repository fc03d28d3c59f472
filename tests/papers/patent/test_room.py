"""The room of `patent`: every item is attempted, and the findings stand on their own."""

import re

import numpy as np
import pytest
import sympy as sp
from evaluated_items import is_dear
from long_tests import long_where

import dualarm_repro.papers.patent  # noqa: F401  registers its items
from dualarm_repro.control.frozen import arm_pair
from dualarm_repro.control.neural.network_settings import NetworkSettings
from dualarm_repro.control.neural.penalised import rest_point
from dualarm_repro.control.random_tasks import draw_task
from dualarm_repro.control.settings import ControllerSettings
from dualarm_repro.control.simulate import pseudo_inverse
from dualarm_repro.control.task_search import DEEP, KEPT, TRACKED, score
from dualarm_repro.ledger import REGISTRY, Verdict, evaluate
from dualarm_repro.ledger.spot import spot_check
from dualarm_repro.papers import load
from dualarm_repro.papers.patent.document import (
    CONTROL_STEP,
    RADII,
    SEARCHES,
    SEED,
    frozen,
    redundant_arm,
    run,
    scenario_file,
)
from dualarm_repro.papers.patent.pages.contest import robust
from dualarm_repro.papers.patent.pages.network.symbols import matrix_equation, symbols
from dualarm_repro.papers.patent.pages.problem.method import STEPS, name, trace, traced_steps
from dualarm_repro.papers.patent.pages.problem.program import URDFS, uncovered
from dualarm_repro.papers.patent.problems import sample_problem
from dualarm_repro.papers.patent.reading import crossing
from dualarm_repro.papers.patent.studies.crossings import CROSSINGS, drawn, tipped_arm
from dualarm_repro.papers.patent.studies.tasks import TASKS

load()
ITEMS = [item_id for item_id in REGISTRY.items if item_id.startswith("patent.")]


def test_every_item_has_a_checker():
    assert [item_id for item_id in ITEMS if item_id not in REGISTRY.checkers] == []


@pytest.mark.parametrize("robot", list(URDFS))
def test_capsules_contain_the_meshes_of_the_moving_links(robot):
    excess = uncovered(robot)
    assert len(excess) >= 7
    assert max(excess.values()) <= 1e-4


def test_published_capsules_of_the_panda_miss_the_hand():
    assert 0.005 < max(uncovered("panda", "published").values()) < 0.01


def test_panda_has_twelve_capsules():
    assert len(redundant_arm("panda").geometry.geometryObjects) == 12


@pytest.mark.parametrize("name", ["crossing", "crossing_xarm7"])
def test_frozen_crossings_meet_their_criteria_at_the_control_rate(name):
    scenario, settings = frozen(name), ControllerSettings()
    naive = run(scenario, pseudo_inverse(settings), CONTROL_STEP)
    motion = run(scenario, settings, CONTROL_STEP)
    assert naive.smallest_distance < DEEP
    assert motion.completed
    assert motion.smallest_distance >= settings.inner - KEPT
    assert motion.largest_error <= TRACKED


@pytest.mark.parametrize("scenario", list(SEARCHES))
def test_frozen_files_hold_the_recorded_draw(scenario):
    searched, file = SEARCHES[scenario], scenario_file(scenario)
    system = arm_pair(redundant_arm(searched.robot), file.base_distance)
    task = draw_task(system, np.random.default_rng(file.found.seed), RADII)
    np.testing.assert_allclose(task.q0, [*file.left.q, *file.right.q], atol=1e-6)
    np.testing.assert_allclose(task.normals, [file.left.normal, file.right.normal], atol=1e-6)
    assert file.radius == pytest.approx(task.radius, abs=1e-6)
    assert file.found.seed[0] == SEED
    assert f"among {searched.draws} draws; {searched.wanted.words}" in file.found.criteria
    assert score(system, task, searched.wanted, ControllerSettings()) is not None


def test_a_crossing_is_found_for_every_layout_and_stored():
    table = CROSSINGS.load()
    assert (table["draw"] >= 0).all()
    assert len(table) == 16
    assert spot_check(CROSSINGS, 1, seed=3).wrong == []
    case = table.iloc[0].to_dict()
    scenario = crossing(case)
    system = arm_pair(tipped_arm(case["robot"], case["tip"]), case["base_distance"])
    np.testing.assert_array_equal(scenario.q0, drawn(system, int(case["draw"])).q0)


def test_every_kind_of_disturbance_is_of_its_size():
    (push,) = robust._disturbed("state", 0.1, 0).values()
    assert np.abs(push).min() == np.abs(push).max() == 0.1
    assert (push == push[0]).all()
    noisy = robust._disturbed("readings", 2e-3, 0)["readings"]
    # a drawn sample, by a few standard errors of its deviation
    assert noisy.noise.std() == pytest.approx(2e-3, rel=0.01)
    assert (robust._disturbed("readings", 2e-3, 1)["readings"].noise != noisy.noise).any()
    wrong = robust._disturbed("model", 5e-3, 0)["readings"]
    np.testing.assert_array_equal(np.abs(wrong.offset), 5e-3)
    assert robust._disturbed("delay", 5e-3, 0)["readings"].delay == 5
    assert robust._disturbed("none", 0.0, 0) == {}


def test_stored_study_is_current_and_large_enough():
    table = TASKS.load()
    counted = table[table["counts"].astype(bool)]
    assert len(counted) >= 500
    assert 20 < counted["collides"].sum() < len(counted)
    assert spot_check(TASKS, 6, seed=1).wrong == []


def test_symbolic_matrix_is_symmetric():
    E, y, e = matrix_equation()
    assert E.shape == (5, 5)
    assert len(y) == len(e) == 5
    assert E.T == E


def test_symbolic_equation_is_the_zero_of_the_derivatives_of_the_lagrangian():
    (E, y, e), s, P = matrix_equation(), symbols(), sp.Function("P")
    phi, multiplier = s["phi"], s["multiplier"]
    L = (phi.T * phi)[0] / 2 + sum(map(P, s["C"] * phi - s["d"]))
    L += (multiplier.T * (s["J"] * phi - s["rate"]))[0]
    assert sp.simplify(E * y - e - sp.Matrix([sp.diff(L, v) for v in y])) == sp.zeros(len(y), 1)


def test_rest_points_depend_on_the_penalty():
    p = sample_problem()
    soft, hard = (
        rest_point(p, NetworkSettings(penalty="quadratic", factor=factor)) for factor in (1e2, 1e6)
    )
    assert np.abs(soft - hard).max() > 1e-3


@pytest.mark.parametrize(
    ("item_id", "changes", "verdict"),
    long_where(
        lambda one: is_dear(one[0]),
        [
            ("patent.fig02", {"inner_range": 0.0, "time_step": 0.002}, Verdict.UNDER_ASSUMPTION),
            ("patent.fig02", {"tip": "fingertip"}, Verdict.UNDER_ASSUMPTION),
            ("patent.fig02", {"distance_measure": "axis"}, Verdict.UNDER_ASSUMPTION),
            (
                "patent.fig02",
                {"distance_measure": "axis", "base_distance": 0.8},
                Verdict.NOT_REPRODUCED,
            ),
            ("patent.claim_efficient", {"exact_start": "nothing"}, Verdict.UNDER_ASSUMPTION),
            ("patent.claim_efficient", {"exact_start": "before"}, Verdict.NOT_REPRODUCED),
            (
                "patent.claim_robust_state",
                {"robustness_measure": "largest_tip_error"},
                Verdict.NOT_REPRODUCED,
            ),
            (
                "patent.claim_robust_model",
                {"robustness_measure": "peak_acceleration"},
                Verdict.UNDER_ASSUMPTION,
            ),
            ("patent.claim_limits", {"limit_form": "velocity"}, Verdict.NOT_REPRODUCED),
            ("patent.eq_min_energy", {"energy_weight": "inertia"}, Verdict.NOT_REPRODUCED),
            ("patent.claim_limits", {"fast_duration": 2.0}, Verdict.NOT_REPRODUCED),
            (
                "patent.claim_gain_time_varying",
                {"compared_gain": "start"},
                Verdict.UNDER_ASSUMPTION,
            ),
            (
                "patent.claim_gain_time_varying",
                {"compared_gain": "ceiling"},
                Verdict.NOT_REPRODUCED,
            ),
            ("patent.claim_vs_pinv", {"operation_rate": 1e7}, Verdict.NOT_REPRODUCED),
            ("patent.claim_pinv_slow", {}, Verdict.NOT_REPRODUCED),
            (
                "patent.claim_pinv_slow",
                {"pseudo_inverse_factor": "singular_values"},
                Verdict.UNDER_ASSUMPTION,
            ),
            ("patent.claim_real_time", {"operation_rate": 1e7}, Verdict.NOT_REPRODUCED),
            ("patent.claim_real_time", {"accuracy_bound": 1e-5}, Verdict.NOT_REPRODUCED),
            ("patent.claim_redundant_motion", {"energy_weight": "inertia"}, Verdict.NOT_REPRODUCED),
            ("patent.claim_energy", {"energy_measure": "work"}, Verdict.NOT_REPRODUCED),
            ("patent.claim_faster", {"speed_measure": "flow_time"}, Verdict.UNDER_ASSUMPTION),
            ("patent.eq_avoid", {"avoidance_form": "arm_normal"}, Verdict.NOT_REPRODUCED),
            ("patent.eq_solver", {"state_matrix": "without_hessian"}, Verdict.NOT_REPRODUCED),
            ("patent.eq_solver", {"feed_forward": "none"}, Verdict.NOT_REPRODUCED),
            ("patent.eq_matrix_defs", {"state_matrix": "without_hessian"}, Verdict.NOT_REPRODUCED),
        ],
    ),
)
def test_verdicts_follow_their_assumptions(item_id, changes, verdict):
    assert evaluate(REGISTRY, item_id, changes).verdict == verdict


def test_a_run_returns_from_every_step():
    assert {name(step) for step in STEPS} <= set(trace())
    assert len(traced_steps()) == len(STEPS)


def test_every_sentence_of_the_text_has_its_place():
    sentences = REGISTRY.papers["patent"].sentences
    assert len(sentences) >= 50
    named = {item for one in sentences for item in one.items or ()}
    assert named == set(ITEMS)
    assert [one.place for one in sentences if not one.items] == [
        "[0090]-[0091]; [0093]; [0096]",
        "[0097]",
    ]


#: Paragraphs that only announce or close: field, headings, and the opening of a list.
ANNOUNCE = {1, 5, 6, 31, 36, 37, 84, 88, 94}


def test_every_paragraph_of_the_text_is_the_place_of_a_sentence():
    named = set()
    for one in REGISTRY.papers["patent"].sentences:
        for first, last in re.findall(r"\[(\d{4})\](?:-\[(\d{4})\])?", one.place):
            named |= set(range(int(first), int(last or first) + 1))
    assert set(range(1, 98)) - named == ANNOUNCE


def test_no_solver_completes_a_task_whose_bounds_it_breaks():
    table = TASKS.load()
    table = table[table["collides"].eq(True)]
    for solver in ("pair_normal", "slack", "calm", "network", "guarded"):
        done = table[table[f"{solver}_completed"].astype(bool)]
        assert (done[f"{solver}_distance"] > 0.0).all()
        assert (done[f"{solver}_beyond_speed"] <= 1e-9).all()
        assert (done[f"{solver}_beyond_angle"] <= 1e-9).all()
    ended = table["network_finished"].astype(bool)
    assert (ended & ~table["network_completed"].astype(bool)).any()
    guarded = table[["guarded_beyond_speed", "guarded_beyond_angle"]].max(axis=1)
    assert (guarded <= 1e-9).all()
    assert (table["guarded_distance"] > 0.0).all()
