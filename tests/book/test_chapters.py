"""The chapters of the documents run their methods, and their numbers are those of the ledger."""

import ast
import re
from dataclasses import replace

import numpy as np
import pytest
from chapters import calls_in, cells_of, chapters_of, obtained_for, run

from dualarm_repro.papers.qiu.reading import Goal, Improved, Traditional, VariableGain
from dualarm_repro.planning import StopReason, plan_apf_compiled
from dualarm_repro.view import cell as view_cell

BARE = re.compile(r"\s*show\([^()]*\)\s*")
#: Document, a method that it names, and the function whose call in a cell runs it.
METHODS = [
    ("xue", "link transform by sympy", "rot_ccw_axis1"),
    ("xue", "chain of all links by sympy", "chain_product"),
    ("xue", "the chain in Pinocchio", "forwardKinematics"),
    ("xue", "workspace by random postures", "sample_workspace"),
    ("xue", "workspace as a body of rotation", "rotation_volumes"),
    ("xue", "common workspace", "overlap"),
    ("xue", "search for an arrangement", "disturbed"),
    ("xue", "traditional field", "traditional"),
    ("xue", "improved field", "improved"),
    ("xue", "slice of a field", "contourf"),
    ("xue", "step down a field", "next_configuration"),
    ("xue", "whole descent", "plan_apf"),
    ("xue", "certificate of a trap", "certify"),
    ("xue", "master as a moving obstacle", "with_arm"),
    ("xue", "ten runs from other starts", "run_trials"),
    ("xue", "lottery of arrangements", "random_case"),
    ("xue", "a point that inverse kinematics follows", "plan_cartesian_ik"),
    ("xue", "distances of whole links", "link_cores"),
    ("qiu", "link transform by sympy", "rot_ccw_axis3"),
    ("qiu", "the chain in Pinocchio", "forwardKinematics"),
    ("qiu", "postures at a point", "branch_posture"),
    ("qiu", "attraction", "conic_force"),
    ("qiu", "repulsion", "repulsive_torque_at"),
    ("qiu", "slice of the field", "contourf"),
    ("qiu", "variable gain", "gain_factor"),
    ("qiu", "adaptive step", "step_length"),
    ("qiu", "search from one end and from both", "plan_bidirectional"),
    ("qiu", "class of a failure", "classify"),
    ("qiu", "spline over the splice", "smoothed"),
    ("qiu", "hull of the master", "hull_track"),
    ("qiu", "moving hull of the master", "hull_tracks"),
    ("qiu", "time map", "time_map"),
    ("qiu", "contact of whole links", "contact_check"),
    ("qiu", "both methods on many goals", "campaign"),
    ("qiu", "lines followed by inverse kinematics", "follow_line"),
    ("qiu", "creases around capsules and hull", "to_capsules"),
]
#: Chapters that this file runs; those of the programs and the welds have a file of their own.
CHAPTERS = [*chapters_of("xue"), *chapters_of("qiu")]
EVERY = [*CHAPTERS, *chapters_of("patent"), *chapters_of("pan")]
#: What draws a figure: a cell that calls it has to show it.
DRAWING = re.compile(r"subplots|\w+_figure|\w+_page|figure_html|shown")
_NEAR = {"rel": 1e-4, "abs": 1e-9}


def has_no_output(code):
    """Whether a cell calls something for the sake of its output and then keeps that to itself."""
    last = ast.parse(code).body[-1]
    if isinstance(last, ast.Expr):
        return code.rstrip().endswith(";")
    return any(DRAWING.fullmatch(name) for name in calls_in(code))


@pytest.mark.parametrize("chapter", EVERY)
def test_no_chapter_is_a_pile_of_cards(chapter):
    cells = cells_of(chapter)
    bare = [code for code in cells if BARE.fullmatch(code)]
    assert 2 * len(bare) <= len(cells)


@pytest.mark.parametrize(("document", "method", "call"), METHODS)
def test_every_method_is_run_in_a_cell(document, method, call):
    codes = (code for chapter in chapters_of(document) for code in cells_of(chapter))
    assert any(call in calls_in(code) for code in codes), method


@pytest.mark.parametrize("chapter", EVERY)
def test_no_cell_hides_its_figure(chapter):
    assert [code for code in cells_of(chapter) if has_no_output(code)] == []


@pytest.mark.parametrize("chapter", CHAPTERS)
def test_every_cell_shows_what_it_promises(chapter):
    ran = run(chapter)
    assert ran.silent == []
    assert [text for file, text in ran.warned if file.startswith("<cell")] == []
    assert ran.left == [], "a figure without a caption"


@pytest.mark.parametrize(
    "code", ["scenes_figure();", "figure, ax = plt.subplots()\nax.plot(x)\ny = 1"]
)
def test_a_cell_that_hides_its_figure_is_found(code):
    assert has_no_output(code)


@pytest.mark.parametrize("chapter", CHAPTERS)
def test_numbers_of_a_chapter_are_those_of_the_ledger(chapter):
    compared = run(chapter).compared
    assert compared
    for item_id, key, value in compared:
        ledger = view_cell.value_at(obtained_for(item_id), key)
        if isinstance(ledger, str) or (isinstance(ledger, list) and isinstance(ledger[0], str)):
            assert value == ledger, f"{item_id}, {key}"
        else:
            assert np.asarray(value) == pytest.approx(np.asarray(ledger), **_NEAR), (
                f"{item_id}, {key}"
            )


@pytest.mark.parametrize("chapter", EVERY)
def test_no_chapter_imports_a_private_name(chapter):
    for code in cells_of(chapter):
        imports = [n for n in ast.walk(ast.parse(code)) if isinstance(n, ast.ImportFrom)]
        assert not [a.name for n in imports for a in n.names if a.name.startswith("_")]


@pytest.mark.parametrize("chapter", ["xue/kinematics", "qiu/geometry"])
def test_symbols_and_pinocchio_agree(chapter):
    assert 0.0 < run(chapter).names["largest"] < 1e-12


def test_a_chapter_shows_a_trap_and_the_escape_from_it():
    without, with_point = run("xue/potentials").names["escapes"].values()
    assert without.reason is StopReason.TRAPPED
    assert without.certificate.smallest_curvature > 1.0
    assert with_point.rescued
    assert with_point.arrivals == 1


def _planned(names, **changed):
    """The descent of the potentials page with another repulsion."""
    settings = names["settings"]
    settings = settings.changed(repulsion=settings.repulsion.changed(**changed))
    arm = names["master"]
    return plan_apf_compiled(arm, arm.start, arm.goal, names["window"], settings)


def test_promised_changes_of_the_repulsion_happen():
    names = run("xue/potentials").names
    as_printed, weak, short = (
        _planned(names, **changed) for changed in ({}, {"gain": 0.1}, {"influence": 0.2})
    )
    assert weak.steps < as_printed.steps
    assert weak.clearance.min() < as_printed.clearance.min()
    assert short.reached
    assert 0.0 < short.clearance.min() < 0.2


def test_a_virtual_point_that_lets_go_too_early_does_not_help():
    names = run("xue/potentials").names
    early = replace(names["yawed"].planner, virtual_release=0.7)
    arm = names["slave"]
    settings = names["reading"].improved(early, names["centre"], arm.goal)
    plan = plan_apf_compiled(arm, arm.start, arm.goal, names["obstacles"], settings)
    assert plan.reason is StopReason.TRAPPED
    assert plan.arrivals == settings.virtual_point.max_activations


def test_the_counts_change_with_the_perturbation():
    names = run("xue/table2").names
    counts = []
    for width in (0.01, 0.3):
        begin = names["outcomes"].starts(names["case"], width, 10, np.random.default_rng(0))
        runs = names["outcomes"].run_variant(names["case"], "traditional", begin)
        counts.append(int((~runs.reached).sum()))
    assert counts[0] == 10
    assert counts[1] < 8


def test_a_window_elsewhere_leaves_fig_9_one_contact():
    names = run("xue/scene").names
    case, margins = names["case"], names["demands"].margins
    there = case._replace(layout=replace(case.layout, window_centre_y=0.8))
    facts = names["radius"], names["meeting"]
    here, moved = margins(case, *facts), margins(there, *facts)
    assert here["enters_bar"] > 0.0
    assert moved["enters_bar"] < -names["demands"].DEPTH  # outside of every bar
    assert moved["meets"] > 0.0


def test_the_start_lies_inside_the_cloud_of_an_arm_without_limits():
    names = run("xue/workspace").names
    free = names["document"].arm_in_use("full_turns", 1.024)
    cloud = names["sample_workspace"](free, 100_000, np.random.default_rng(1))
    assert names["points"][:, 2].min() > names["start"][2] > cloud[:, 2].min()


def test_thinner_links_are_clear():
    smallest = run("xue/truth").names["smallest"]
    assert smallest["arms"] - 2 * 0.05 > 0.0 > smallest["arms"] - 2 * 0.12


def test_promised_changes_of_the_searches_happen():
    assert Traditional.nominal(gain_ratio=1e-4).plan().reached
    constant, same = Traditional.nominal().plan(), VariableGain.nominal(kappa=1.0).plan()
    np.testing.assert_array_equal(constant.path, same.path)
    before, after = (Improved.nominal(update_order=order).plan() for order in ("before", "after"))
    assert abs(before.searches - after.searches) <= 1
    dive = before.tcp[:, 2].min()
    assert dive < 0.1 < 0.3 < Improved.nominal(gain_ratio=1e-3).plan().tcp[:, 2].min()
    longer = Goal.nominal(master_goal="longer_tool")
    names = run("qiu/geometry").names
    reached = names["end_effector"](longer.arm(), longer.posture())
    assert reached == pytest.approx(names["wanted"])


def test_wide_circles_hold_the_whole_arm():
    names = run("qiu/master_slave").names
    wide = names["circles"]._replace(radii=(0.2,) * 6)
    assert names["protrusions"](names["master"], names["q"][np.newaxis], wide).max() == 0.0


def test_without_the_flange_hardly_any_path_is_free():
    names = run("qiu/success").names
    reading = Improved.nominal(control_points="elbow_wrist", gain_ratio=1e-4)
    goals, scene = names["goals"], names["truth_scene"]([reading.arm()])
    found = names["campaign"](reading.plan_to, goals.q, scene)
    assert all(found.planner)
    assert sum(found.truth) < 3
