"""The printed side is read from print: a slip there changes the verdict."""

import copy

import numpy as np
import pytest
from evaluated_items import evaluated

from dualarm_repro.ledger import Verdict, evaluate
from dualarm_repro.papers.xue import stored
from dualarm_repro.papers.xue.document import table_counts, text_counts
from dualarm_repro.papers.xue.pages.potentials import improved, printed_field, traditional
from dualarm_repro.papers.xue.pages.table2 import statements as inverse_calls

#: Another formula that can be parsed, and the printed one with one sign or coefficient changed.
SLIPS = {
    "eq08": ("T_06 = 1*T_01", "T_06 = T_01*T_12*T_23*T_34*T_56*T_45"),
    "eq09": ("U_att = 42", "U_att = k_a/3*|X - X_g|^2"),
    "eq10": (
        "U_rep = 42",
        "U_rep = k_r/2*(1/d + 1/d_0)^2 if d <= d_0, 0 if d > d_0",
    ),
    "eq11": ("F_att = -grad(U_att) = 42", "F_att = -grad(U_att) = -2*k_a*|X - X_g|"),
    "eq12": (
        "F_rep = -grad(U_rep) = 42",
        "F_rep = -grad(U_rep) = k_r*(1/d - 1/d_0)*1/d^3*dd/dX if d <= d_0, 0 if d > d_0",
    ),
    "eq13": (
        "U_aat^* = 42",
        "U_aat^* = k_a/3*(|X - X_g|^2 + sum_{i=1}^{6} |theta_i - theta_{gi}|^2)",
    ),
    "eq14": (
        "U_rep(i)^* = 42",
        "U_rep(i)^* = k_r/2*(1/d_i - 1/d_0)^3 if d_i <= d_0, 0 if d_i > d_0",
    ),
    "eq15": ("U_rep^* = 42", "U_rep^* = sum_{i=1}^{4} U_rep(i)"),
    "eq16": ("U_total = 42", "U_total = U_aat^* - U_rep^*"),
}  # fmt: skip


@pytest.mark.parametrize("item", SLIPS)
@pytest.mark.parametrize("which", [0, 1], ids=["nonsense", "slip"])
def test_a_formula_printed_otherwise_is_not_reproduced(registry, reprint, item, which):
    assert evaluated(f"xue.{item}").verdict is not Verdict.NOT_REPRODUCED
    reprint(item, formula=SLIPS[item][which])
    assert evaluate(registry, f"xue.{item}").verdict is Verdict.NOT_REPRODUCED


@pytest.mark.parametrize("formula", [SLIPS["eq09"][1], "U_att = k_b*X"])
def test_the_virtual_point_takes_the_form_printed_for_the_goal(registry, reprint, formula):
    reprint("eq09", formula=formula)
    assert evaluate(registry, "xue.eq_virtual").verdict is Verdict.NOT_REPRODUCED


def test_a_force_printed_as_a_vector_is_reproduced(registry, reprint):
    reprint("eq11", formula="F_att = -grad(U_att) = -k_a*(X - X_g)")
    assert evaluate(registry, "xue.eq11").verdict is Verdict.REPRODUCED
    assert traditional.attractive_force_forms() == {"vector_form": True, "printed_form": True}


def test_terms_of_one_dimension_are_no_contradiction(registry, reprint):
    scaling = improved.term_scaling()
    assert scaling["position_factor"] == pytest.approx(4.0)
    assert scaling["joint_factor"] == pytest.approx(1.0)
    assert not scaling["one_dimension"]
    angles = "sum_{i=1}^{6} |theta_i - theta_{gi}|^2"
    reprint("eq13", formula=f"U_aat^* = k_a/2*(|X - X_g|^2 + |X|^2*{angles})")
    assert improved.term_scaling()["one_dimension"]


def test_what_cannot_be_evaluated_agrees_with_nothing(registry, reprint):
    reprint("eq09", formula="U_att = k_b*Y")
    assert np.isnan(printed_field.attraction(np.zeros(3), np.ones(3)))


@pytest.mark.parametrize("k", range(2, 8))
def test_a_changed_entry_of_a_matrix_changes_its_verdict(registry, reprint, k):
    matrix = copy.deepcopy(registry.items[f"xue.eq{k:02d}"].printed["matrix"])
    matrix[0][3] = "0.286"
    reprint(f"eq{k:02d}", matrix=matrix)
    assert evaluate(registry, f"xue.eq{k:02d}").verdict is Verdict.NOT_REPRODUCED


def test_general_transform_with_the_twist_printed_is_reproduced(registry, reprint):
    cells = registry.items["xue.eq01"].printed["matrix"]
    right = [[cell.replace("(a_{i-1})", "(alpha_{i-1})") for cell in row] for row in cells]
    reprint("eq01", matrix=right)
    assert evaluate(registry, "xue.eq01").verdict is Verdict.REPRODUCED
    reprint("eq01", matrix=[["1", "0", "0", "0"]] * 4)
    assert evaluate(registry, "xue.eq01").verdict is Verdict.NOT_REPRODUCED


def test_a_slip_in_table_1_is_not_reproduced(registry, reprint):
    assert evaluated("xue.tab01").verdict is Verdict.INCONSISTENT
    reprint("tab01", a=["0.285", "1.025", "0.250", "0", "0", "0"])
    assert evaluate(registry, "xue.tab01").verdict is Verdict.NOT_REPRODUCED
    reprint("tab01", a=["0", "0.285", "1.024", "0.250", "0", "0"])
    assert evaluate(registry, "xue.tab01").verdict is not Verdict.INCONSISTENT


def test_rows_and_text_are_read_from_print(registry, reprint):
    assert table_counts() == {"traditional": 0, "improved": 8}
    assert text_counts() == {"traditional": 8, "improved": 0}
    reprint("claim_success_10", successes="7")
    reprint("claim_trapped_8", trapped="5")
    assert text_counts() == {"traditional": 5, "improved": 3}


def test_goals_printed_as_angles_need_no_inverse(registry, reprint):
    found = evaluated("xue.claim_no_ik")
    assert found.result.obtained["calls"] == {"master": 0, "slave": 2}
    assert found.result.obtained["needs_goal_angles"]
    reprint("eq13", formula="U_aat^* = k_a/2*|X - X_g|^2")
    assert not inverse_calls.needs_goal_angles()


@pytest.mark.parametrize(
    ("share", "verdict"),
    [(0.9, Verdict.REPRODUCED), (0.5, Verdict.UNDECIDABLE), (0.1, Verdict.NOT_REPRODUCED)],
)
def test_a_cartesian_field_is_hard_to_apply_if_it_mostly_fails(
    registry, monkeypatch, share, verdict
):
    table = stored.lottery_table().copy()
    table["cartesian_ik_missed"] = (share * table["cartesian_ik_runs"]).astype(int)
    monkeypatch.setattr(stored, "lottery_table", lambda: table)
    assert evaluate(registry, "xue.claim_no_ik").verdict is verdict
