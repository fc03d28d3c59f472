"""Stored studies of `pan`: their cells, and that tables say what the method gives there."""

import json
from dataclasses import asdict, fields
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.stats import spearmanr

from dualarm_repro.ledger import REGISTRY, evaluate
from dualarm_repro.ledger.assumptions import alternatives
from dualarm_repro.papers.pan.pages.search import runs as page
from dualarm_repro.papers.pan.reading import PROBLEM, Genetic
from dualarm_repro.papers.pan.studies import consistency, evolution, fit, optimisers, sensitivity
from dualarm_repro.welding import Objective


@pytest.fixture(scope="module")
def sets(registry):
    """The cells of the study of readings."""
    return consistency.cells()


class TestConsistency:
    def test_cells_draw_each_assumption_within_what_is_declared(self, sets):
        made = sets
        for key in consistency.VARIED:
            entry = REGISTRY.declared(f"pan.{key}", "value", "range", "choices")
            drawn = [cell[key] for cell in made]
            if entry.range is not None:
                low, high = entry.range
                assert min(drawn) >= low
                assert max(drawn) <= high
                counts, _ = np.histogram(drawn, bins=4, range=(low, high))
                # a quasi-random set of 256 fills every quarter of a range to a few draws
                np.testing.assert_allclose(counts, len(made) / 4, rtol=0.05)
            else:
                assert set(drawn) == set(entry.choices)

    def test_both_readings_see_the_same_sets(self, sets):
        made = sets
        for first, second in zip(made[::2], made[1::2], strict=True):
            assert (first["base_transform"], second["base_transform"]) == ("inverted", "literal")
            assert first["set"] == second["set"]
            assert all(first[key] == second[key] for key in consistency.VARIED)

    def test_stored_cells_are_those_that_are_declared(self, sets):
        table, made = consistency.CONSISTENCY.load(), sets
        for key in ("set", "base_transform", *consistency.VARIED):
            assert table[key].tolist() == [cell[key] for cell in made]

    def test_what_is_feasible_has_an_optimum_and_the_rest_none(self, registry):
        table = consistency.CONSISTENCY.load()
        some = table["feasible_share"] > 0
        for name in consistency.OBJECTIVES:
            assert (table[f"{name} f"].notna() == some).all()
            assert (table.loc[some, f"{name} f"] > 0).all()

    @pytest.mark.parametrize(
        ("lower", "upper"),
        # a minimum over the seam is at most the mean, of every weight
        [("inverse volume, minimum", "inverse volume"), ("equal weights, minimum", "equal weights"),
         ("carriers only, minimum", "carriers only, (15)"),
         # the harmonic mean of two positive measures at most the arithmetic
         ("harmonic mean", "equal weights")],
    )  # fmt: skip
    def test_laws_between_readings(self, registry, lower, upper):
        table = consistency.CONSISTENCY.load()
        found = table[[f"{lower} f", f"{upper} f"]].dropna().to_numpy()
        assert len(found) > 50
        # searches end within a centimetre of their optimum, which costs 2.5 % at most
        assert (found[:, 0] <= 1.03 * found[:, 1]).all()
        assert (found[:, 0] <= (1 + 1e-9) * found[:, 1]).mean() > 0.99

    def test_every_objective_is_another_reading(self):
        readings = list(consistency.OBJECTIVES.values())
        assert len({tuple(asdict(one).items()) for one in readings}) == len(readings)
        assert consistency.OBJECTIVES["inverse volume"] == Objective()


class TestFit:
    def test_cells_are_all_readings_but_that_of_the_welder_alone(self, registry):
        names = {cell["measure"] for cell in fit.cells()}
        assert names == set(consistency.OBJECTIVES) - {"welder only"}
        assert len(fit.cells()) == 2 * len(names)

    @pytest.mark.parametrize("share", [0.0, 0.4, 0.99])
    def test_neighbours_of_a_choice_are_the_others(self, share):
        entry = SimpleNamespace(choices=["a", "b", "c", "d"])
        found = fit._neighbours(entry, share, 0.25)
        assert [int(one * 4) for one in found] == [k for k in range(4) if k != int(share * 4)]

    @pytest.mark.parametrize(
        ("share", "step", "expected"),
        [(0.5, 0.25, [0.25, 0.75]), (0.1, 0.25, [0.0, 0.35]), (0.9, 0.25, [0.65, 1.0])],
    )
    def test_neighbours_in_a_range_stay_in_it(self, share, step, expected):
        found = fit._neighbours(SimpleNamespace(choices=None), share, step)
        assert found == pytest.approx(expected, abs=1e-11)
        assert max(found) < 1

    def test_every_climb_tried_and_told_a_whole_choice(self, registry):
        for _, row in fit.FIT.load().iterrows():
            assert row["evaluations"] >= fit.DRAWS
            assert set(consistency.VARIED) <= set(json.loads(row["values"]))
            assert 0 <= row["loss"] <= 1

    def test_a_climb_sees_the_reading_it_is_given(self, registry):
        climb = fit._Climb({"base_transform": "literal", **fit.MEASURES["harmonic mean"]})
        shares = dict.fromkeys(consistency.VARIED, 0.0)
        problem = climb.problem(shares, 18)
        assert problem.job.base_transform == "literal"
        assert problem.measure.weights == "harmonic"
        assert problem.job.seam_points == 18
        for key in consistency.VARIED:
            entry = REGISTRY.declared(f"pan.{key}", "range", "choices")
            first = entry.range[0] if entry.range is not None else entry.choices[0]
            assert getattr(problem.job, key) == first


class TestSensitivity:
    def test_every_value_but_the_declared_one_is_a_cell(self, registry):
        made = sensitivity.cells()
        assert made[0] == {"assumption": "none", "value": ""}
        for key in PROBLEM:
            entry = REGISTRY.declared(f"pan.{key}", "value", "range", "choices")
            told = [cell["value"] for cell in made if cell["assumption"] == key]
            if not entry.varies:
                assert told == []
                continue
            values = alternatives(f"pan.{key}", 5)
            assert told == [str(value) for value in values if value != entry.value]

    def test_displacement_counts_mirror_images_as_one(self, registry):
        table = sensitivity.sensitivity_table()
        nominal = table[table["assumption"] == "none"].iloc[0]
        assert nominal["moved"] == 0
        for _, row in table.iterrows():
            away = [abs(row["x"]) - abs(nominal["x"]), row["y"] - nominal["y"],
                    row["z"] - nominal["z"]]  # fmt: skip
            if np.isfinite(away).all():
                assert row["moved"] == pytest.approx(np.sqrt(np.square(away).sum()), abs=1e-12)

    def test_the_declared_optimum_is_the_first_row(self, registry, stored):
        row = sensitivity.SENSITIVITY.load().iloc[0]
        assert row[["x", "y", "z"]].tolist() == pytest.approx(stored["eq_opt"]["optimum"])
        assert row["fitness"] == pytest.approx(stored["eq_opt"]["fitness"])


class TestEvolution:
    def test_variants_change_what_they_say(self, registry):
        declared = Genetic.of(REGISTRY.nominal("pan")).settings()
        known = {field.name for field in fields(declared)}
        for changes in evolution.VARIANTS.values():
            assert set(changes) <= known
            for name, value in changes.items():
                assert getattr(declared, name) != value

    @pytest.mark.parametrize("variant", list(evolution.VARIANTS))
    def test_histories_are_held_after_their_end(self, registry, variant):
        runs = evolution.stored_runs(10, variant)
        assert len(runs.ends) == len(runs.best) == 10
        for name, histories in runs.histories.items():
            for (generation, _), values in zip(runs.ends, histories, strict=True):
                assert (values[generation:] == values[generation]).all(), name
        best = runs.histories["best"]
        assert (np.diff(best, axis=1) >= 0).all()  # the elite passes on
        np.testing.assert_array_equal(best[:, -1], runs.fitness)
        feasible = runs.histories["feasible"]
        assert ((feasible >= 0) & (feasible <= 1)).all()

    def test_fewer_runs_are_the_first_ones(self, registry):
        few, all_ = evolution.stored_runs(3), evolution.stored_runs(10)
        np.testing.assert_array_equal(few.best, all_.best[:3])
        assert few.ends == all_.ends[:3]

    def test_figures_are_medians_of_the_stored_histories(self, registry, stored):
        runs = evolution.stored_runs(10)
        best, distance = runs.histories["best"], runs.histories["distance"]
        assert stored["fig14"]["best_last"] == pytest.approx(np.median(best[:, -1]))
        assert stored["fig15"]["first"] == pytest.approx(np.median(distance[:, 0]))
        assert stored["fig15"]["last"] == pytest.approx(np.median(distance[:, -1]))
        assert stored["fig13"]["best"] == runs.best[0].tolist()
        gap = 1 - runs.fitness.min() / stored["eq_opt"]["fitness"]
        assert stored["fig13"]["gap"] == pytest.approx(gap, abs=1e-12)
        apart = np.linalg.norm(runs.best - [0.023, -0.266, 0.404], axis=1)
        assert stored["fig13"]["distance_to_printed"] == pytest.approx(apart.min())

    def test_table_of_histories(self, registry):
        runs = evolution.stored_runs(2)
        table = page._history_table(runs, ("best", "mean"))
        assert list(table) == ["generation", "best_run_0", "best_run_1", "mean_run_0", "mean_run_1"]
        assert table["mean_run_1"].tolist() == runs.histories["mean"][1].tolist()

    def test_what_is_told_of_one_run(self, registry, monkeypatch):
        """Of a run made by hand: a best value that grows late, a distance that falls but once."""
        best = [1.0, 2.0, 3.0, 3.6, 3.8, 3.9, 3.96, 4.0]
        distance = [8.0, 7.0, 6.0, 5.0, 5.5, 3.0, 2.0, 1.0]
        history = [SimpleNamespace(best=b, distance=d) for b, d in zip(best, distance, strict=True)]
        run = SimpleNamespace(history=history, found=True)
        monkeypatch.setattr(page, "run_of", lambda assumed: run)
        monkeypatch.setattr(page, "optimum", lambda problem: SimpleNamespace(fitness=5.0))
        found = evaluate(registry, "pan.claim_fitness_converges").result.obtained
        assert found["late_gain"] == pytest.approx(1 - 3.96 / 4.0)
        assert found["gap"] == pytest.approx(0.2)
        found = evaluate(registry, "pan.claim_distance_to_zero").result.obtained
        assert found["ratio"] == pytest.approx(1 / 8)
        assert found["trend"] == pytest.approx(spearmanr(range(8), distance).statistic)


class TestOptimisers:
    def test_one_ground_truth_and_ten_runs_of_each(self, registry):
        made = optimisers.cells()
        assert made[0] == {"optimiser": "ground truth", "run": 0}
        counts = {}
        for cell in made[1:]:
            counts[cell["optimiser"]] = counts.get(cell["optimiser"], 0) + 1
        assert set(counts.values()) == {10}
        assert len(counts) == 7

    def test_counts_within_a_tenth_of_a_percent(self, registry, stored):
        table = optimisers.OPTIMISERS.load()
        truth = table.loc[table["optimiser"] == "ground truth", "fitness"].item()
        for name, count in stored["claim_max_mmr"]["within_0.1_percent"].items():
            fitness = table.loc[table["optimiser"] == name, "fitness"]
            assert count == sum(one >= 0.999 * truth for one in fitness)

    def test_peers_of_another_problem_are_not_told(self, registry, stored):
        truth = stored["claim_max_mmr"]["truth"]
        table, told = page._peers(truth)
        assert "ground truth" not in set(table["optimiser"])
        assert told == stored["claim_max_mmr"]["within_0.1_percent"]
        assert page._peers(1.01 * truth) == (None, {})

    def test_certificate_is_the_fitness_at_the_position(self, registry):
        row = optimisers.OPTIMISERS.load().iloc[11]
        found = optimisers._certificate({}, row)
        assert found["fitness"] == pytest.approx(row["fitness"], rel=1e-9)
        away = {**row.to_dict(), "x": row["x"] + 0.05}
        assert optimisers._certificate({}, away)["fitness"] < row["fitness"]

    def test_no_optimiser_spends_more_than_its_budget(self, registry):
        table = optimisers.OPTIMISERS.load()
        spent = table.loc[table["optimiser"] != "ground truth", "evaluations"]
        # a last generation may go beyond it
        assert (spent <= 1.1 * optimisers.BUDGET).all()
