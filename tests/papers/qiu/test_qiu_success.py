"""Success and quality in `qiu`, counted anew row by row from the stored studies."""

from statistics import median

import numpy as np
import pytest

from dualarm_repro.ledger import REGISTRY, evaluate
from dualarm_repro.ledger.shares import Share
from dualarm_repro.papers.qiu.pages.success import quality, rates
from dualarm_repro.papers.qiu.reading import JUDGED_BY
from dualarm_repro.papers.qiu.studies.improvements import nearest


def limit(item, name):
    return REGISTRY.look(f"qiu.{item}").thresholds[name].value


@pytest.fixture(scope="module")
def judged(nominal):
    return JUDGED_BY[nominal["success_rule"]]


@pytest.fixture(scope="module")
def tasks(rows):
    return [row for row in rows("quality") if row["drawn"]]


@pytest.fixture(scope="module")
def ablation(rows):
    return rows("ablation")


def of(found):
    found = list(found)
    return {"count": sum(map(bool, found)), "of": len(found)}


@pytest.mark.parametrize("item", ["tab02", "claim_success_rate"])
@pytest.mark.parametrize("rule", list(JUDGED_BY))
def test_choices_with_a_higher_rate(registry, ablation, item, rule):
    found = evaluate(registry, f"qiu.{item}", {"success_rule": rule}).result.obtained
    key = JUDGED_BY[rule]
    assert found["judged_by"] == key
    assert found["better"] == of(row[f"VAB_{key}"] > row[f"traditional_{key}"] for row in ablation)


def test_sums_over_the_choices(ablation, judged, stored):
    told = stored["claim_success_rate"]
    assert told["goals"] == sum(row["goals"] for row in ablation)
    assert told["kept"] == {
        "traditional": sum(row[f"traditional_{judged}"] for row in ablation),
        "improved": sum(row[f"VAB_{judged}"] for row in ablation),
    }
    assert stored["tab02"]["seeds"] == sorted({row["goal_seed"] for row in ablation})


def test_face_value_of_the_table_is_that_of_the_printed_gains(ablation, stored):
    """Printed are equal gains, so that their ratio is 1."""
    cells = [
        row
        for row in ablation
        if row["branch"] == "front_shallow"
        and row["control_points"] == "elbow_wrist_flange"
        and row["gain_ratio"] == 1.0
    ]
    goals = sum(row["goals"] for row in cells)
    assert goals == 15 * len(cells) == 60
    for method, variant in (("traditional", "traditional"), ("improved", "VAB")):
        told = stored["tab02"]["face_value"][method]
        for key in ("planner", "truth"):
            kept = sum(row[f"{variant}_{key}"] for row in cells)
            assert told[key] == f"{kept}/{goals}"
            _, low, high = Share.of(kept, goals)
            assert (told[f"{key}_low"], told[f"{key}_high"]) == pytest.approx((low, high))


def test_what_is_true_was_found_by_the_planner(ablation):
    variants = [name.removesuffix("_truth") for name in ablation[0] if name.endswith("_truth")]
    assert len(variants) == 8
    for row in ablation:
        for name in variants:
            assert row[f"{name}_truth"] <= row[f"{name}_planner"] <= row["goals"]


def test_table_has_a_row_for_every_choice_and_method(registry, ablation):
    table = evaluate(registry, "qiu.tab02").result.table
    choices = {(row["control_points"], row["gain_ratio"]) for row in ablation}
    assert len(table) == 2 * len(choices)
    for _, row in table.iterrows():
        kept, goals = map(int, row["truth"].split("/"))
        assert row["truth_low"] - 1e-12 <= kept / goals <= row["truth_high"] + 1e-12


@pytest.mark.parametrize("space", ["joints", "tip"])
def test_smoother_paths(tasks, judged, stored, space):
    both = [r for r in tasks if r[f"traditional_{judged}"] and r[f"improved_{judged}"]]
    ratio = [r[f"improved_{space}"] / r[f"traditional_{space}"] for r in both]
    assert stored["claim_smoother"][f"smoother_{space}"] == of(one < 1 for one in ratio)
    assert stored["claim_smoother"]["bending_ratio"][space] == pytest.approx(median(ratio))


def test_regular_paths_of_the_position(tasks, judged, stored):
    least = [r["improved_singular_value"] for r in tasks if r[f"improved_{judged}"]]
    told, bar = stored["claim_regular_position"], limit("claim_regular_position", "regular")
    assert told["regular"] == of(one >= bar for one in least)
    assert told["smallest"] == pytest.approx(min(least))
    assert told["median"] == pytest.approx(median(least))


def test_regular_paths_of_the_pose(tasks, judged, stored):
    reached = [r for r in tasks if r[f"improved_{judged}"]]
    bent = [r for r in reached if r["bent"]]
    told = stored["claim_regular_pose"]
    assert told["regular"] == of(not r["improved_crosses"] for r in bent)
    assert told["straight"] == len(reached) - len(bent)


@pytest.mark.parametrize("measure", ["sign_changes", "second_difference", "peak_to_peak"])
def test_calm_where_the_traditional_search_chatters(registry, tasks, measure):
    changes = {"oscillation_measure": measure}
    found = evaluate(registry, "qiu.claim_no_oscillation", changes).result.obtained
    bar = limit("claim_no_oscillation", "chatters")
    loud = [
        r for r in tasks if r[f"traditional_{measure}"] is not None
        and r[f"traditional_{measure}"] >= bar
    ]  # fmt: skip
    own = [r[f"improved_{measure}"] for r in loud]
    assert found["calm"] == of(value is None or not value >= bar for value in own)
    assert found["tasks"] == len(tasks)


def test_a_search_too_short_to_chatter_is_calm(registry, monkeypatch):
    """Its measure is missing, which is no chatter; a loud one of the traditional is needed."""
    bar, measure = limit("claim_no_oscillation", "chatters"), "sign_changes"
    table = quality.QUALITY.load().head(4).assign(drawn=True)
    table[f"traditional_{measure}"] = [bar, bar, bar, np.nextafter(bar, 0)]
    table[f"improved_{measure}"] = [np.nan, bar, np.nextafter(bar, 0), bar]
    monkeypatch.setattr(type(quality.QUALITY), "load", lambda study: table)
    changes = {"oscillation_measure": measure}
    found = evaluate(registry, "qiu.claim_no_oscillation", changes).result.obtained
    assert found["calm"] == {"count": 2, "of": 3}


def test_cheaper_than_sampling(tasks, judged, stored):
    both = [r for r in tasks if r[f"improved_{judged}"] and r[f"rrt_connect_{judged}"]]
    own = [r["improved_evaluations"] for r in both]
    states = [r["rrt_connect_evaluations"] for r in both]
    told = stored["claim_cheaper"]
    assert told["cheaper"] == of(a < b for a, b in zip(own, states, strict=True))
    checked = [a + r["improved_check"] for a, r in zip(own, both, strict=True)]
    assert told["checked"] == of(a < b for a, b in zip(checked, states, strict=True))
    assert told["median"] == {"improved": median(own), "RRT-Connect": median(states)}
    assert told["reached"]["improved"] == sum(r["improved_truth"] for r in tasks)
    assert told["reached"]["RRT-Connect"] == sum(r["rrt_connect_truth"] for r in tasks)


@pytest.mark.parametrize("ratio", [1e-4, 1e-2, 1.0])
def test_minima_rescued_from_both_ends(registry, rows, judged, ratio):
    found = evaluate(registry, "qiu.claim_local_min", {"gain_ratio": ratio}).result.obtained
    scenes = rows("random_scenes")
    told = found["ratio"]
    assert told == ratio
    failure, solved = f"traditional_{told:g}_failure", f"B_{told:g}_{judged}"
    minima = [row for row in scenes if row[failure] == "midway-minimum"]
    assert found["rescued"] == of(row[solved] for row in minima)
    for kind, count in found["failures"].items():
        some = [row for row in scenes if row[failure] == kind]
        assert count == len(some)
        assert found["solved_from_both_ends"][kind] == sum(bool(row[solved]) for row in some)


def test_a_search_that_failed_has_a_kind_of_failure(rows):
    for row in rows("random_scenes"):
        for ratio in ("0.0001", "0.01", "1"):
            for name in ("traditional", "A", "V"):
                key = f"{name}_{ratio}"
                assert (row[f"{key}_failure"] == "None") == bool(row[f"{key}_planner"])


def test_rates_of_the_random_scenes(registry, rows):
    table, scenes = rates.scenes_table(), rows("random_scenes")
    assert len(table) == 3 * 8 + 1
    known = table[table["method"] != "RRT-Connect"]
    for _, row in known.iterrows():
        name = f"{row['method']}_{row['eta_0/zeta']:g}"
        for key in ("planner", "truth"):
            share = 100 * np.mean([bool(one[f"{name}_{key}"]) for one in scenes])
            assert any(_told(entry, share) for entry in row.drop("eta_0/zeta")), (name, key)


def _told(entry, share):
    """Whether an entry of a row is a share, as a number or as text, to the digits it has."""
    try:
        return abs(float(str(entry).split()[0].rstrip("%")) - share) <= 0.5
    except ValueError:
        return False


def test_pairs_are_told_for_every_draw_set_and_ratio(registry, rows):
    table, pairs = rates.pairs_table(), rows("dual_pairs")
    drawn = {row["drawn"] for row in pairs}
    assert len(table) == len(drawn) * (3 * 3 + 1)
    assert set(table["goals"]) == drawn


@pytest.mark.parametrize(("given_ratio", "expected"), [(1e-5, 1e-4), (2e-3, 1e-2), (0.5, 1.0)])
def test_the_scenes_nearest_to_a_ratio(given_ratio, expected):
    assert nearest(given_ratio, rates.SCENE_RATIOS) == expected


def test_tried_tasks_are_narrowed_by_every_method(registry, tasks):
    assert len(quality.tried()) == len(tasks)
    one, both = quality.tried("planner", ("improved",)), quality.tried("planner")
    assert len(both) < len(one) < len(tasks)
    assert both["traditional_planner"].all()
    assert quality.tried("truth")["improved_truth"].all()
    assert len(quality.tried("truth")) <= len(both)


@pytest.mark.parametrize(
    ("item", "column", "key"),
    [
        ("claim_smoother", "improved_joints", "smoother_joints"),
        ("claim_cheaper", "improved_evaluations", "cheaper"),
    ],
)
def test_statements_turn_with_what_is_stored(registry, monkeypatch, item, column, key):
    table = quality.QUALITY.load()
    for value, holds in ((0, True), (1e9, False)):
        changed = table.assign(**{column: value})
        monkeypatch.setattr(type(quality.QUALITY), "load", lambda study, made=changed: made)
        found = evaluate(registry, f"qiu.{item}")
        rule = next(one for one in found.rules if one.key == key)
        assert rule.holds(found.evidence) is holds
        monkeypatch.undo()


def test_steps_of_the_random_tasks(rows, nominal, stored):
    rule, told = nominal["adaptive_step"], stored["claim_steps_efficiency"]
    some = [row for row in rows("improvements") if row["gain_ratio"] == told["ratio"]]
    both = [row for row in some if row[f"reached_{rule}"] and row["reached_constant"]]
    pairs = [(row[f"searches_{rule}"], row["searches_constant"]) for row in both]
    assert told["faster"] == of(a < b for a, b in pairs)
    assert told["median_ratio"] == pytest.approx(median(a / b for a, b in pairs))
    assert told["tasks"] == len(some)
    for name, count in told["solved"].items():
        assert count == sum(row[f"reached_{name}"] for row in some)
