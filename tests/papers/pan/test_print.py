"""Printed equations of `pan` decide: a slip in print, or nonsense in its place, is found."""

import pytest
from evaluated_items import evaluated

from dualarm_repro.ledger import REGISTRY, evaluate
from dualarm_repro.ledger.evaluation import prove
from dualarm_repro.papers.pan.pages.search import algorithm

#: Item, key of what it prints, and something else in its place.
SLIPS = [
    ("eq01", "formula", "x1_dot = 1.001*J*x2_dot"),
    ("eq02", "formula", "x1_dot = J*x2_dot - alpha_dot"),
    ("eq03", "matrix", [["R_wc", "1.001*P_wc0"], ["0", "1"]]),
    ("eq03", "matrix", [["R_wc", "P_wc0"], ["0", "2"]]),
    ("eq04", "formula", "p_2 + R_wc*r_1 + p_1 = 0"),
    ("eq05", "formula", "p_2 - R_wc*r_2 - p_3 = 0"),
    ("eq06", "formula", "p_w = 2*T_wc*p_c"),
    ("eq07", "formula", "p_B = T_Bc*T_Bc*p_c"),
    ("eq08", "formula", "T_Bc = T_wc*T_Bw"),
    ("eq09", "formula", "x_dot = 2*J(q)*q_dot"),
    ("eq10", "formula", "x_dot^T*(J*J^T)^-1*x_dot = 2"),
    ("eq10", "axes", "sigma_i = lambda_i(J*J^T)"),
    ("eq11", "formula", "omega = det(J(q)*J^T(q))"),
    ("eq12", "formula", "X_dot = 2*J*Q_dot"),
    ("eq13", "X_dot", {"stack": ["x1_dot"], "rows": "2", "columns": "m"}),
    ("eq14", "matrix", [["J_1", "0"], ["0", "J_1"]]),
    ("eq14", "rows", "13"),
    ("eq15", "formula", "M_tight = sqrt(det(J*J^T)) = sqrt(det(J_1*J_1^T)*det(J_1*J_1^T))"),
    ("eq16", "formula", "MMR = (beta_1*M_tight + beta_2*M_loose)/(beta_1 + 2*beta_2)"),
    ("eq17", "formula", ["x = R_b*cos(theta)", "y = R_b*sin(theta)", "z = R_a"]),
    ("eq17", "formula", ["x = 2*R_b*cos(theta)", "y = R_b*sin(theta)",
                         "z = sqrt(R_a^2 - R_b^2*sin(theta)^2)"]),
    ("eq_opt", "maximize", "M_tight"),
    ("eq_opt", "over", ["x", "y"]),
    ("eq_opt", "subject_to", ["c in S", "theta_high <= theta", "SD_min > 0"]),
    ("eq_opt", "subject_to", ["c in S", "theta_low <= theta <= theta_high", "SD_min < 0"]),
    ("eq_opt", "subject_to", ["c in S", "theta_low <= theta <= theta_high", "Rank(J) = 5"]),
    ("eq_base", "label", "T_wB1"),
    ("eq_base", "matrix", [["1", "0", "0", "2"], ["0", "1", "0", "-1"], ["0", "0", "1", "0.05"],
                           ["0", "0", "0", "1"]]),
    ("claim_constraints", "count", "5"),
    ("fig11", "stops", ["preset number of generations"]),
    ("fig11", "steps", ["next generation", "decision to end"]),
    ("fig11", "inputs", ["number of bits of a gene"]),
]  # fmt: skip
FORMULAS = [f"eq{n:02d}" for n in (1, 2, 4, 5, 6, 7, 8, 9, 10, 11, 12, 15, 16)]


@pytest.fixture(autouse=True)
def watched_once(monkeypatch, watched):
    monkeypatch.setattr(algorithm, "declared_trace", watched)


@pytest.fixture
def printing(monkeypatch, registry):
    """Puts something else in print."""

    def put(key, field, value):
        items = REGISTRY.paper_of(f"pan.{key}").items
        item = items[key]
        changed = {**item.printed, field: value}
        monkeypatch.setitem(items, key, item.model_copy(update={"printed": changed}))

    return put


@pytest.mark.parametrize(("key", "field", "value"), SLIPS)
def test_slip_in_print_changes_the_verdict(printing, key, field, value):
    before = evaluated(f"pan.{key}").verdict
    printing(key, field, value)
    assert evaluate(REGISTRY, f"pan.{key}").verdict != before


@pytest.mark.parametrize("key", FORMULAS)
def test_nonsense_in_print_changes_the_verdict(printing, key):
    before = evaluated(f"pan.{key}").verdict
    printing(key, "formula", "apples = 2*pears")
    assert evaluate(REGISTRY, f"pan.{key}").verdict != before


def test_units_agree_for_a_geometric_mean(printing):
    """With the square root of the product both terms of (16) would be in m^3."""
    printing("eq15", "formula", "M_tight = sqrt(sqrt(det(J_1*J_1^T)*det(J_2*J_2^T)))")
    found = evaluate(REGISTRY, "pan.eq16").result.obtained
    assert found["one_unit"] is True
    assert not prove(REGISTRY, "pan.tight_loose_units").holds


@pytest.mark.parametrize(
    ("erratum", "key", "field", "value"),
    [
        ("base_transform", "claim_bases", "base1", ["-1.0", "1.0", "-0.05"]),
        ("eq14_size", "eq14", "rows", "2*m"),
        ("eq13_size", "eq13", "Q_dot",
         {"stack": ["q1_dot", "q2_dot"], "rows": "2*n", "columns": "1"}),
        ("beta_cancels", "eq16", "formula", "MMR = beta_1*M_tight + beta_2*M_loose"),
        ("rank_condition", "eq_opt", "subject_to", ["Rank(J) = 5"]),
    ],
)  # fmt: skip
def test_proof_fails_where_print_is_right(printing, erratum, key, field, value):
    printing(key, field, value)
    if erratum == "eq13_size":
        printing("eq13", "X_dot", {"stack": ["x1_dot", "x2_dot"], "rows": "2*m", "columns": "1"})
    assert not prove(REGISTRY, f"pan.{erratum}").holds
