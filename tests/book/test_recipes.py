"""The recipes run, each ends in a report, and what they report is so."""

import ast
from itertools import pairwise
from time import process_time

import numpy as np
import pytest
from chapters import BOOK, calls_in, cells_of, chapters_of, run

from dualarm_repro.planning import truth
from dualarm_repro.scene import distances, links_of
from dualarm_repro.view.certified_report import certified_report

RECIPES = chapters_of("recipes")
#: Recipe to the plans that its cells leave behind.
PLANS = {
    "recipes/two_ur5": ["plan"],
    "recipes/pass_a_part": ["bring", "take", "leave", "away"],
    "recipes/parked_arm": ["plan"],
    "recipes/lift": ["plan"],
}
#: Seconds of the processor that a page may take.
SOON = 60.0
ROUNDING = 1e-9  # [m]


def test_every_recipe_is_in_the_list_of_recipes_and_in_the_contents():
    assert set(RECIPES) == {*PLANS, "recipes/weld_cell"}
    listed = (BOOK / "recipes" / "index.md").read_text(encoding="utf-8")
    contents = (BOOK / "_toc.yml").read_text(encoding="utf-8")
    for name in RECIPES:
        assert f"{{doc}}`{name.removeprefix('recipes/')}`" in listed
        assert f"- file: {name}\n" in contents


@pytest.mark.parametrize("recipe", RECIPES)
def test_a_recipe_is_short_cells_that_end_in_a_report(recipe):
    cells = cells_of(recipe)
    assert all(len(code.splitlines()) <= 20 for code in cells)
    assert calls_in(cells[-1]) & {"certified_report", "certified_motion"}
    assert isinstance(ast.parse(cells[-1]).body[-1], ast.Expr)


@pytest.mark.parametrize("recipe", RECIPES)
def test_a_recipe_runs_soon_and_without_a_warning(recipe):
    before = process_time()
    ran = run(recipe)
    assert process_time() - before < SOON
    assert (ran.silent, ran.warned, ran.left) == ([], [], [])


@pytest.mark.parametrize("recipe", PLANS)
def test_what_is_reported_holds_along_the_motion(recipe):
    names = run(recipe).names
    for name in PLANS[recipe]:
        plan = names[name]
        assert certified_report(plan).loc["outcome", "plan"] == "arrived, certified free"
        index = np.linspace(0.0, plan.index[-1], 400)
        q = plan.scene.stack(**{arm: path.at(index) for arm, path in plan.paths.items()})
        lower = truth(plan.scene, plan.paths).lower
        assert 0.0 < lower <= distances(plan.scene, q, index).min() + ROUNDING


def test_the_part_changes_the_arm_and_each_phase_begins_where_the_last_ended():
    names = run("recipes/pass_a_part").names
    phases = [names[name] for name in PLANS["recipes/pass_a_part"]]
    carried = [
        {one.name: "tool_0" in links_of(one.arm).names for one in plan.scene.arms}
        for plan in phases
    ]
    left, right = {"left": True, "right": False}, {"left": False, "right": True}
    assert carried == [left, left, right, right]
    for before, after in pairwise(phases):
        for arm, path in before.paths.items():
            np.testing.assert_array_equal(
                path.configurations[-1], after.paths[arm].configurations[0]
            )


def test_the_bar_is_at_the_same_place_in_both_hands():
    names = run("recipes/pass_a_part").names
    place = []
    for name, arm in (("take", "left"), ("leave", "right")):
        scene, q = names[name].scene, names["take"].paths[arm].configurations[-1]
        one = next(placed for placed in scene.arms if placed.name == arm)
        pose = one.placement.homogeneous @ one.arm.fk(q)
        place.append([(pose @ [0.0, 0.0, z, 1.0])[:3] for z in (0.11, 0.29)])
    np.testing.assert_allclose(place[0], place[1][::-1], atol=1e-4)


def test_the_lift_is_used():
    """The tool of a UR5, 1.0 m above its base at most, ends higher than that."""
    names = run("recipes/lift").names
    path = names["plan"].paths["lifted"].configurations
    assert (path[0, 0], path[-1, 0]) == (0.0, 0.7)
    highest = names["arm"].positions(names["low"])[:, 2].max()
    assert 0.9 < highest < 1.05
    assert names["end"] > highest + 0.2


def test_the_parked_arm_is_named_where_it_stands_in_the_way():
    names = run("recipes/parked_arm").names
    assert set(names["plan"].plans) == {"abb", "ufactory"}
    assert len(names["plan"].paths["parked"].configurations) == 1


def test_the_welding_motion_is_certified_with_the_pipes():
    names = run("recipes/weld_cell").names
    found = truth(names["scene"], names["paths"])
    assert 0.0 < found.lower < 0.1
    q = np.hstack([path.configurations for path in names["paths"].values()])
    index = np.arange(len(q), dtype=float)
    assert distances(names["scene"], q, index).min() >= found.lower - ROUNDING
