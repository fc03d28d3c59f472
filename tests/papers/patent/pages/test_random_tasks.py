"""What is told of random tasks, counted anew row by row from the stored study."""

import numpy as np
import pandas as pd
import pyarrow.parquet as pq
import pytest

from dualarm_repro.datafiles import data_path
from dualarm_repro.ledger import REGISTRY, Verdict, evaluate
from dualarm_repro.papers.patent.pages.avoidance import random_tasks as page

SOLVERS = ("pair_normal", "arm_normal", "pair_axes", "arm_axes", "pair_components", "slack",
           "calm", "network", "guarded")  # fmt: skip
INNER, FOLLOWED = 0.03, 1e-3


def wilson(count, of, z=1.959963984540054):
    share, spread = count / of, z**2 / of
    middle = (share + spread / 2) / (1 + spread)
    half = z * np.sqrt(share * (1 - share) / of + spread / (4 * of)) / (1 + spread)
    return [share, middle - half, middle + half]


@pytest.fixture(scope="module")
def rows(registry, nominal):
    """The draws as plain mappings, without the library's reading of them."""
    table = pq.read_table(data_path("results", "patent_tasks.parquet")).to_pylist()
    assert len(table) == nominal["task_selection"]
    return table


@pytest.fixture(scope="module")
def colliding(rows):
    return [row for row in rows if row["counts"] and row["collides"]]


@pytest.fixture(scope="module")
def admitted(colliding):
    return [row for row in colliding if row["limits_finished"] and row["limits_error"] <= FOLLOWED]


def test_selection_narrows_step_by_step(registry, nominal, rows, colliding, admitted, stored):
    told = stored["claim_task_completed"]
    assert told["set"] == sum(row["set"] for row in rows)
    assert told["tasks"] == sum(row["counts"] for row in rows)
    assert told["colliding"] == len(colliding)
    assert told["done"]["of"] == len(admitted)
    assert [len(f(nominal)) for f in (page.counted_tasks, page.colliding_tasks,
                                      page.admitted_tasks)] == [
        told["tasks"], len(colliding), len(admitted)
    ]  # fmt: skip
    assert not any(row["counts"] and not row["set"] for row in rows)


def test_fewer_draws_are_the_first_ones(registry, nominal):
    few = page.counted_tasks({**nominal, "task_selection": 600})
    assert few["draw"].max() < 600
    assert few["draw"].tolist() == page.counted_tasks(nominal)["draw"].tolist()[: len(few)]


@pytest.mark.parametrize("name", SOLVERS)
def test_completed_counts_only_what_breaks_nothing(colliding, name):
    for row in colliding:
        kept = (
            row[f"{name}_finished"]
            and row[f"{name}_distance"] > 0
            and row[f"{name}_beyond_angle"] <= 1e-9
            and row[f"{name}_beyond_speed"] <= 1e-9
            and row[f"{name}_error"] <= FOLLOWED
        )
        assert bool(row[f"{name}_completed"]) is bool(kept)


@pytest.mark.parametrize("name", SOLVERS)
def test_completed_tasks_by_solver(registry, nominal, admitted, stored, name):
    bound = nominal["accuracy_bound"]
    done = sum(bool(row[f"{name}_completed"]) and row[f"{name}_error"] <= bound for row in admitted)
    assert stored["claim_task_completed"]["completed"][name] == done


def test_failures_by_their_causes(colliding, admitted, stored):
    told = stored["claim_task_completed"]["failed"]

    def alone(row):
        return bool(row["alone_finished"] and row["alone_error"] <= FOLLOWED)

    by_avoidance = [row for row in colliding if not alone(row)]
    by_limits = [row for row in colliding if row not in admitted]
    both = [row for row in by_avoidance if row in by_limits]
    neither = [row for row in admitted if alone(row) and not row["pair_normal_completed"]]
    assert told == {
        "limits_alone": len(by_limits),
        "avoidance_alone": len(by_avoidance),
        "by_either": len(both),
        "only_together": len(neither),
    }


def test_shares_with_their_intervals(admitted, colliding, stored, nominal):
    told, bound = stored["claim_task_completed"], nominal["accuracy_bound"]

    def accurate(row):
        return bool(row["pair_normal_completed"]) and row["pair_normal_error"] <= bound

    own = wilson(sum(map(accurate, admitted)), len(admitted))
    assert told["given"]["limits"] == pytest.approx(own, abs=1e-6)
    alone = [row for row in colliding if row["alone_finished"] and row["alone_error"] <= FOLLOWED]
    assert told["given"]["avoidance"] == pytest.approx(
        wilson(sum(map(accurate, alone)), len(alone)), abs=1e-6
    )


@pytest.mark.parametrize(
    ("prefix", "solver"), [("", "slack"), ("network_", "network"), ("guarded_", "guarded")]
)
def test_tasks_without_contact_and_with_the_inner_range(
    admitted, stored, nominal, prefix, solver
):  # fmt: skip
    told = stored["claim_avoids"]
    distances = [row[f"{solver}_distance"] for row in admitted]
    least = INNER - nominal["reading_noise"]
    assert told[f"{prefix}free"] == {"count": sum(d > 0 for d in distances), "of": len(distances)}
    assert told[f"{prefix}kept"]["count"] == sum(d >= least for d in distances)
    assert told["smallest"][solver] == pytest.approx(min(distances))


def test_bounds_that_the_network_breaks(admitted, stored):
    told = stored["claim_avoids"]
    for kind in ("speed", "angle"):
        beyond = sum(row[f"network_beyond_{kind}"] > 0 for row in admitted)
        assert told[f"network_beyond_{kind}"] == beyond
    for name in ("slack", "calm"):
        rough = max(row[f"{name}_roughness"] for row in admitted)
        assert told["roughness"][name] == pytest.approx(rough)


@pytest.mark.parametrize("name", ["slack", "network"])
def test_tasks_within_limits(admitted, stored, name):
    key = {"slack": "within", "network": "network_within"}[name]
    within = sum(
        row[f"{name}_beyond_angle"] <= 1e-9 and row[f"{name}_beyond_speed"] <= 1e-9
        for row in admitted
    )
    assert stored["claim_limits"][key] == {"count": within, "of": len(admitted)}


def test_pseudo_inverse_on_all_counted_tasks(rows, stored):
    counted = [row for row in rows if row["counts"]]
    told = stored["claim_vs_pinv"]
    collide = np.mean([bool(row["collides"]) for row in counted])
    leave = np.mean([row["naive_beyond_angle"] > 0 for row in counted])
    assert told["random_tasks_colliding"] == pytest.approx(collide)
    assert told["random_tasks_beyond_limits"] == pytest.approx(leave)


def test_tasks_collide_where_their_distance_is_negative(rows):
    for row in rows:
        if row["counts"]:
            assert bool(row["collides"]) is (row["naive_distance"] < 0)


def test_concordant_pairs_of_speed_and_energy(rows, stored, nominal):
    counted = [row for row in rows if row["counts"]]
    half, measure = len(counted) // 2, nominal["energy_measure"]
    pairs = list(zip(counted[:half], counted[half : 2 * half], strict=True))
    agree = sum(
        (a["naive_speed"] > b["naive_speed"]) == (a[f"naive_{measure}"] > b[f"naive_{measure}"])
        for a, b in pairs
    )
    assert stored["claim_energy"]["concordant"] == {"count": agree, "of": half}
    speeds, costs = (
        pd.Series([row[f"naive_{key}"] for row in counted]).rank() for key in ("speed", measure)
    )
    told = stored["claim_energy"]["correlation"]
    assert told == pytest.approx(np.corrcoef(speeds, costs)[0, 1], abs=1e-9)


@pytest.mark.parametrize("measure", ["work", "driven", "heat"])
def test_concordance_is_counted_for_every_measure_of_effort(registry, rows, measure):
    counted = [row for row in rows if row["counts"]]
    found = evaluate(registry, "patent.claim_energy", {"energy_measure": measure})
    both = [row for row in counted if row["pair_normal_completed"]]
    ratio = np.median([row[f"pair_normal_{measure}"] / row[f"naive_{measure}"] for row in both])
    assert found.result.obtained["energy_ratio"] == pytest.approx(ratio)
    assert list(found.result.table) == ["mean speed [rad/s]", measure]
    assert len(found.result.table) == len(counted)


@pytest.fixture
def tiny():
    return pd.DataFrame({
        "net_completed": [True, True, False, True],
        "net_error": [1e-5, 3e-3, 1e-5, 2e-4],
        "net_acceleration": [1.0, 9.0, 50.0, 3.0],
        "net_roughness": [0.5, 0.25, 4.0, 1.0],
        "net_beyond_speed": [-0.2, -0.1, 0.3, -0.4],
        "net_distance": [0.05, 0.02, -0.1, 0.04],
    })  # fmt: skip


def test_accuracy_needs_both_completion_and_a_small_error(tiny):
    assert page._accurate(tiny, "net", 1e-3).tolist() == [True, False, False, True]
    assert page._accurate(tiny, "net", np.inf).tolist() == [True, True, False, True]
    assert page._count(page._accurate(tiny, "net", 1e-4)) == {"count": 1, "of": 4}


def test_a_task_is_allowed_if_it_ends_on_its_path(registry, nominal, monkeypatch):
    finished, errors = [True, True, False, False], [1e-4, 2e-3, 1e-4, 2e-3]
    table = pd.DataFrame({"alone_finished": finished, "alone_error": errors,
                          "limits_finished": finished, "limits_error": errors})  # fmt: skip
    assert page._alone(table).tolist() == [True, False, False, False]
    monkeypatch.setattr(page, "colliding_tasks", lambda assumed: table)
    assert page.admitted_tasks(nominal).index.tolist() == [0]


def test_rows_of_the_tables(tiny):
    assert page._quality(tiny, "net") == (3, 3e-3, 3.0)  # median of 1, 9, 3
    assert page._worst(tiny, "net") == (-0.1, 3e-3, 50.0, 4.0, 0.3)
    assert len(page._WORST) == len(page._worst(tiny, "net"))
    assert len(page._QUALITIES) + 1 == len(page._quality(tiny, "net"))


@pytest.mark.parametrize(
    ("policy", "form", "prefix"),
    [("slack_on_task", "pair_normal", "slack"), ("stop", "arm_axes", "arm_axes")],
)
def test_columns_of_the_exact_qp(policy, form, prefix):
    assumed = {"infeasible_policy": policy, "avoidance_form": form}
    assert page._exact(assumed) == prefix


def test_tables_hold_a_row_for_every_solver(registry):
    avoids = evaluate(registry, "patent.claim_avoids").result
    assert avoids.table["solver"].tolist() == list(SOLVERS)
    for _, row in avoids.table.iterrows():
        smallest = avoids.obtained["smallest"][row["solver"]]
        assert row["smallest distance [m]"] == smallest
    done = evaluate(registry, "patent.claim_task_completed").result
    told = dict(zip(done.table["solver"], done.table["completed"], strict=True))
    # within its limits a task is completed at least as often as it is also accurate
    assert all(told[name] >= done.obtained["completed"][name] for name in SOLVERS)


def test_bars_of_the_figure_are_the_shares(registry):
    import matplotlib.pyplot as plt

    result = evaluate(registry, "patent.claim_task_completed").result
    figure = result.figure()
    of = result.obtained["done"]["of"]
    (axes,) = figure.axes
    drawn = [patch.get_width() for patch in axes.patches]
    names = [label.get_text().replace("\n", " ") for label in axes.get_yticklabels()]
    plt.close(figure)
    assert names == list(page._WORDS.values())
    completed = result.obtained["completed"]
    assert drawn == pytest.approx([100 * completed[name] / of for name in page._WORDS])
    assert "[%]" in axes.get_xlabel()


@pytest.mark.parametrize(
    ("changes", "solver"),
    [({}, "slack"), ({"infeasible_policy": "stop"}, "pair_normal"),
     ({"infeasible_policy": "stop", "avoidance_form": "arm_axes"}, "arm_axes")],
)  # fmt: skip
def test_what_yields_decides_whose_columns_are_judged(
    registry, admitted, nominal, changes, solver
):  # fmt: skip
    found = evaluate(registry, "patent.claim_task_completed", changes)
    bound = nominal["accuracy_bound"]
    done = sum(bool(row[f"{solver}_completed"]) and row[f"{solver}_error"] <= bound
               for row in admitted)  # fmt: skip
    assert found.result.obtained["done"] == {"count": done, "of": len(admitted)}


@pytest.mark.parametrize(
    ("item", "column"),
    [("claim_avoids", "slack_distance"), ("claim_avoids", "network_distance")],
)
def test_verdict_follows_the_stored_distances(registry, monkeypatch, item, column):
    """With every admitted task in contact the statement fails, with none it is met."""
    table = page.TASKS.load()
    for distance, holds in ((-0.01, False), (0.05, True)):
        changed = table.assign(**{column: distance})
        monkeypatch.setattr(type(page.TASKS), "load", lambda study, made=changed: made)
        found = evaluate(registry, f"patent.{item}")
        prefix = "network_" if column.startswith("network") else ""
        for key in (f"{prefix}free", f"{prefix}kept"):
            rule = next(one for one in found.rules if one.key == key)
            assert rule.holds(found.evidence) is holds
        if not holds:
            assert found.verdict is Verdict.NOT_REPRODUCED
        monkeypatch.undo()


def test_thresholds_of_the_statements_have_reasons(registry):
    for item in ("claim_avoids", "claim_task_completed", "claim_energy"):
        for threshold in REGISTRY.look(f"patent.{item}").thresholds.values():
            assert threshold.reason.strip()
