"""What `qiu` prints decides: another formula or digit in the ledger gives another verdict."""

from contextlib import ExitStack

import numpy as np
import pytest

from dualarm_repro.ledger import REGISTRY, Verdict, evaluate
from dualarm_repro.ledger.printed import replaced
from dualarm_repro.papers.qiu.reading import Improved

FORMULAS = {
    "qiu.eq03": ("formula", "X_slaver = X_master * T_trans * T_trans"),
    "qiu.eq04": ("formula", "F(q) = F_att(q) - F_rep(q) = -grad U_att(q) - grad U_rep(q)"),
    "qiu.eq08": ("gradient", "grad rho(a_i(q)) = (O_s - a_i(q)) / ||a_i(q) - O_s||"),
    "qiu.eq10": ("formula", "eta_i = lambda^2 * eta_0"),
}
DIGITS = {
    "qiu.eq03": ("qiu.claim_bases", ("slave", 0), "-0.351"),
    "qiu.fig03": ("qiu.fig03", ("base_slave", 0), "-0.351"),
    "qiu.fig05": ("qiu.fig05", ("joints", "O3"), "4"),
    "qiu.claim_alpha0": ("qiu.claim_bi_counts", ("forward",), "3"),
    "qiu.claim_kappa_range": ("qiu.claim_kappa_range", ("kappa",), "(0,0.5]"),
    "qiu.claim_tau_order": ("qiu.claim_tau_order", ("order",), "tau_1 > tau_2 > tau_3 > 0"),
    "qiu.claim_mu_nonneg": ("qiu.claim_mu_nonneg", ("mu",), ">= 1"),
    "qiu.tab02": ("qiu.tab02", ("goals",), "16"),
    "qiu.claim_same_posture": ("qiu.claim_slave_task", ("start", 1), "0.381"),
    "qiu.claim_symmetric": ("qiu.claim_bases", ("slave", 0), "0.350"),
    "qiu.claim_overlap": ("qiu.claim_bases", ("slave", 0), "-1.350"),
}
#: Inputs that the runs are fed with, and another print of them.
INPUTS = {
    "qiu.claim_obstacles": ("radius", "0.2"),
    "qiu.claim_goals15": ("count", "16"),
    "qiu.claim_alpha0": ("alpha0", "0.06"),
    "qiu.claim_d": ("d", "0.5"),
    "qiu.claim_zeta": ("zeta", "2000"),
    "qiu.claim_rho0": ("rho0", "0.3"),
}


@pytest.fixture
def printing():
    """Prints something else at a place of an item."""
    with ExitStack() as stack:

        def reprint(item_id, path, text):
            printed = replaced(REGISTRY.printed(item_id), path, text)
            stack.enter_context(REGISTRY.with_printed(item_id, printed))

        yield reprint


@pytest.mark.parametrize("item_id", FORMULAS)
@pytest.mark.parametrize("kind", ["changed", "nonsense"])
def test_another_formula_gives_another_verdict(item_id, kind, printing):
    before = evaluate(REGISTRY, item_id).verdict
    key, changed = FORMULAS[item_id]
    printing(item_id, (key,), changed if kind == "changed" else "a = b + c")
    assert evaluate(REGISTRY, item_id).verdict is Verdict.NOT_REPRODUCED != before


@pytest.mark.parametrize("item_id", DIGITS)
def test_another_digit_gives_another_verdict(item_id, printing):
    before = evaluate(REGISTRY, item_id).verdict
    printing(*DIGITS[item_id])
    assert evaluate(REGISTRY, item_id).verdict is not before


@pytest.mark.parametrize("item_id", INPUTS)
def test_the_runs_are_fed_with_what_is_printed(item_id, printing):
    key, text = INPUTS[item_id]
    printing(item_id, (key,), text)
    found = evaluate(REGISTRY, item_id)
    assert found.verdict is Verdict.ADOPTED
    assert found.result.obtained[key] == float(text)


def test_another_sphere_gives_another_run(printing):
    before = Improved.nominal().plan().path
    assert np.array_equal(before, Improved.nominal().plan().path)
    printing("qiu.claim_obstacles", ("radius",), "0.12")
    after = Improved.nominal().plan().path
    assert before.shape != after.shape or np.abs(before - after).max() > 1e-3


def test_start_is_a_contradiction_until_print_agrees_with_itself(printing):
    for item_id, key, base in (
        ("qiu.claim_start", "tcp", "0.350"),
        ("qiu.claim_slave_task", "start", "-0.350"),
    ):
        assert evaluate(REGISTRY, item_id).verdict is Verdict.INCONSISTENT
        printing(item_id, (key,), [base, "0.374", "0.630"])
        assert evaluate(REGISTRY, item_id).verdict is not Verdict.INCONSISTENT


@pytest.mark.parametrize("wrist", [[0.8, 0.8, 0], [0, 0.8, 0]])
def test_a_bent_or_rolled_wrist_can_be_planned_to(wrist):
    found = evaluate(REGISTRY, "qiu.fig07", {"goal_wrist": wrist})
    assert np.isfinite(found.result.obtained["least_range"])
    rolled = wrist[0] != 0
    assert (found.result.obtained["least_range"] > 0.1) == rolled


def test_general_statements_come_with_a_witness_for_each_side():
    for item_id in ("qiu.tab02", "qiu.claim_local_min"):
        found = evaluate(REGISTRY, item_id)
        assert found.verdict is Verdict.UNDECIDABLE
        assert [w["verdict"] for w in found.result.witnesses] == ["holds", "fails"]
        assert all(w["values"] for w in found.result.witnesses)
