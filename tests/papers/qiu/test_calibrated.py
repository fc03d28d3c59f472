"""Readings of `qiu` that are fitted to print, and the stored searches around them."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from dualarm_repro.ledger import REGISTRY
from dualarm_repro.ledger.printed_values import printed_numbers
from dualarm_repro.papers.qiu.calibrated import calibrated_pair, dual_readings, readings
from dualarm_repro.papers.qiu.document import CALIBRATED, FACE_VALUE, PRINTED
from dualarm_repro.papers.qiu.ends import fit_witness, outcome
from dualarm_repro.papers.qiu.reading import Improved, Slave, Traditional
from dualarm_repro.papers.qiu.studies.equilibria import EQUILIBRIA
from dualarm_repro.papers.qiu.studies.fit import FIT, Tally, calibrated_master, reading_of
from dualarm_repro.papers.qiu.studies.fit_slave import FIT_SLAVE
from dualarm_repro.papers.qiu.studies.free_pairs import FREE, MARGIN, free_reading

RUNS = {
    "master": ("qiu.claim_bi_counts", PRINTED.meeting, FIT),
    "slave": ("qiu.claim_slave_counts", PRINTED.slave_meeting, FIT_SLAVE),
}


def _plan(run):
    pair = calibrated_pair()
    return pair.master if run == "master" else pair.slave


@pytest.mark.parametrize("run", RUNS)
def test_a_calibrated_reading_needs_the_printed_searches_and_is_the_nearest_of_them(run):
    item, ends, study = RUNS[run]
    plan, table = _plan(run), study.load()
    assert plan.reached
    assert plan.searches == int(printed_numbers(item, "forward"))
    error = np.linalg.norm(np.array(plan.ends) - ends, axis=1).max()
    assert error == pytest.approx(table["error"].min())
    assert table["nearest"].min() <= error


@pytest.mark.parametrize("run", RUNS)
def test_no_calibrated_reading_steps_less_than_the_printed_counts_need(run):
    item, ends, _ = RUNS[run]
    found = outcome(_plan(run), ends, printed_numbers(item, "forward", "backward"))
    assert found["mean_step_over_alpha0"] >= found["least_mean_step_over_alpha0"]


def test_a_law_below_the_bound_does_not_give_the_printed_count():
    searches = printed_numbers("qiu.claim_bi_counts", "forward", "backward")
    shortened = replace(calibrated_master(Improved), adaptive_step="saturating").plan()
    found = outcome(shortened, PRINTED.meeting, searches)
    assert found["mean_step_over_alpha0"] < found["least_mean_step_over_alpha0"]
    assert found["searches"] > searches[0]


def test_every_reading_that_was_tried_is_counted():
    for study, inner in ((FIT, 2 * 3 * 21), (FIT_SLAVE, 2 * 21)):
        table = study.load()
        assert (table["tried"] == inner).all()
        assert (table["counted"] <= table["joined"]).all()
        assert (table["joined"] <= table["tried"]).all()
        assert (table["error"].notna() == (table["counted"] > 0)).all()


def test_a_tally_keeps_the_nearest_with_the_printed_number():
    plans = [Improved.nominal(gain_ratio=ratio).plan() for ratio in (1.0, 1e-3)]
    tally = Tally(np.array(plans[1].ends), plans[1].searches)
    for plan, name in zip(plans, "ab", strict=True):
        tally.take(plan, {"name": name})
    assert tally.row["tried"] == tally.row["joined"] == 2
    assert (tally.row["counted"], tally.row["error"], tally.row["name"]) == (1, 0.0, "b")


def test_a_row_of_a_study_becomes_the_reading_it_names():
    row = pd.Series({"goal_wrist": "[0, 0.8, 0]", "gain_ratio": 1e-3, "floor": "at_bases", "x": 1})
    reading = reading_of(row, Traditional)
    assert (reading.goal_wrist, reading.gain_ratio, reading.floor) == (
        (0, 0.8, 0),
        1e-3,
        "at_bases",
    )


def test_both_readings_are_named():
    assert list(readings(Traditional.nominal())) == [FACE_VALUE, CALIBRATED]
    assert list(dual_readings(Slave.nominal())) == [FACE_VALUE, CALIBRATED]
    assert calibrated_master(Traditional).goal_branch == calibrated_master(Improved).goal_branch


def test_a_witness_holds_only_within_the_tolerance():
    table = pd.DataFrame({"error": [np.nan, 0.03, 0.015]})
    assert fit_witness(table, 0.02)[0]["verdict"] == "holds"
    assert fit_witness(table[:2], 0.02)[0]["verdict"] == "fails"
    assert fit_witness(table[:2], np.inf)[0]["verdict"] == "holds"


def test_around_the_printed_trap_no_posture_was_found_in_balance():
    table = EQUILIBRIA.load()
    choices = [REGISTRY.declared(f"qiu.{key}", "choices").choices for key in ("control_points",)]
    assert set(table["control_points"]) == set(choices[0])
    assert (table["starts"] > 0).any()
    assert table["angle_deg"].min() > 1.0


def test_the_free_reading_is_free():
    reading = free_reading()
    check = reading.dual_plan().contact(reading.scene())
    assert reading.is_free(check)
    assert check.smallest >= MARGIN
    assert reading.has_floor
    above = FREE.load().query("free and floor == 'at_bases'")
    assert check.smallest == pytest.approx(above["smallest"].max())
