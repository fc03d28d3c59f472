"""What `xue` is told over populations, counted anew row by row from the stored studies."""

from statistics import mean, median, stdev

import numpy as np
import pandas as pd
import pyarrow.parquet as pq
import pytest

from dualarm_repro.datafiles import data_path
from dualarm_repro.ledger import REGISTRY, evaluate
from dualarm_repro.ledger.reference import read_reference
from dualarm_repro.papers.xue import stored as shares
from dualarm_repro.papers.xue.document import Layout
from dualarm_repro.papers.xue.pages import beyond, claims
from dualarm_repro.papers.xue.pages.table2 import superiority
from dualarm_repro.papers.xue.reading import nominal

#: Reading of the traditional method to the prefix of its columns.
COLUMNS = {"end_effector": "traditional", "five_points": "five_points",
           "cartesian_ik": "cartesian_ik"}  # fmt: skip
RADIUS, LAST = 0.12, 2 * 0.225
Z = 1.959963984540054


def rows_of(name):
    return pq.read_table(data_path("results", f"xue_{name}.parquet")).to_pylist()


@pytest.fixture(scope="module")
def stored():
    """Obtained values of the reference, by item without the document."""
    return {k.partition(".")[2]: one["obtained"] for k, one in read_reference("xue").items()}


@pytest.fixture(scope="module")
def drawn(registry):
    return rows_of("lottery")


@pytest.fixture(scope="module")
def lottery(drawn):
    return [row for row in drawn if row["figures_hold"]]


@pytest.fixture(scope="module")
def paths(registry):
    return rows_of("paths")


@pytest.fixture(scope="module")
def ablation(registry):
    return [row for row in rows_of("ablation") if row["layout"] not in ("nominal", "yawed")]


def number(value):
    return value is not None and value == value


def interval(values):
    half = Z * stdev(values) / np.sqrt(len(values))
    return {"value": mean(values), "low": mean(values) - half, "high": mean(values) + half}


def wilson(count, of):
    share, spread = count / of, Z**2 / of
    middle = (share + spread / 2) / (1 + spread)
    half = Z * np.sqrt(share * (1 - share) / of + spread / (4 * of)) / (1 + spread)
    return {"value": share, "low": max(middle - half, 0.0), "high": min(middle + half, 1.0)}


def holds(told, expected):
    assert {key: told[key] for key in expected} == pytest.approx(expected, abs=1e-9)


class TestLottery:
    def test_rows_are_those_in_which_the_figures_hold(self, registry, drawn, lottery):
        for row in drawn:
            kept = (
                row["master_distance"] > 0
                and row["slave_reason"] == "reached"
                and row["slave_flange_window"] > 0
                and row["flanges_apart"] > row["meeting_distance"]
            )
            assert bool(row["figures_hold"]) is bool(kept)
        table = shares.lottery_table()
        assert table["drawn"].tolist() == [row["layout"] for row in lottery]
        assert len(table) == len(lottery)

    @pytest.mark.parametrize("reading", COLUMNS)
    def test_outcomes_of_the_table_and_of_the_text(self, lottery, reading):
        prefix = COLUMNS[reading]
        found = {name: mask.tolist() for name, mask in shares.outcomes_of_table_2(reading).items()}
        for k, row in enumerate(lottery):
            old, new = row[f"{prefix}_held"] >= 8, row["improved_held"] >= 8
            assert found["text"][k] == (old and row["improved_missed"] == 0)
            assert found["table"][k] == (new and row[f"{prefix}_missed"] == 0)
            both = row[f"{prefix}_missed"] == row["improved_missed"] == 0
            assert found["both_never_missed"][k] == both

    def test_outcomes_of_arrangements_made_by_hand(self, registry, monkeypatch):
        table = pd.DataFrame(
            {
                "traditional_held": [8, 0, 9, 0],
                "traditional_missed": [8, 0, 9, 1],
                "improved_held": [0, 8, 0, 9],
                "improved_missed": [0, 8, 1, 9],
            }
        )
        monkeypatch.setattr(shares, "lottery_table", lambda: table)
        found = shares.outcomes_of_table_2("end_effector")
        assert found["text"].tolist() == [True, False, False, False]
        assert found["table"].tolist() == [False, True, False, False]
        assert found["traditional_mostly_held"].tolist() == [True, False, True, False]

    def test_difference_of_text_and_table(self, lottery, stored):
        values = [
            float(row["traditional_held"] >= 8 and row["improved_missed"] == 0)
            - float(row["improved_held"] >= 8 and row["traditional_missed"] == 0)
            for row in lottery
        ]
        holds(stored["tab02"]["text_less_table"], interval(values))

    def test_shares_of_the_lottery(self, lottery, stored):
        told = stored["tab02"]["lottery"]
        never = sum(row["improved_missed"] == 0 for row in lottery)
        holds(told["improved_never_missed"], wilson(never, len(lottery)))
        assert stored["claim_success_10"]["lottery"] == told["improved_never_missed"]
        held = sum(row["traditional_held"] >= 8 for row in lottery)
        holds(told["traditional_mostly_held"], wilson(held, len(lottery)))
        assert stored["claim_trapped_8"]["lottery"] == told["traditional_mostly_held"]

    def test_counts_nest(self, lottery):
        for row in lottery:
            for name in (*COLUMNS.values(), "without_virtual", "improved"):
                held, still = row[f"{name}_held"], row[f"{name}_stationary"]
                missed, runs = row[f"{name}_missed"], row[f"{name}_runs"]
                assert 0 <= held <= still <= missed <= runs == 10
                assert row[f"{name}_rescued"] <= row[f"{name}_used"]

    def test_improved_runs_differ_from_those_without_the_point_only_in_traps(self, lottery):
        for row in lottery:
            assert row["improved_missed"] <= row["without_virtual_missed"]
            gained = row["without_virtual_missed"] - row["improved_missed"]
            assert gained == row["improved_rescued"] <= row["improved_used"]

    @pytest.mark.parametrize("method", ["cartesian_ik", "improved"])
    def test_mean_share_of_missed_runs(self, lottery, stored, method):
        key = {"cartesian_ik": "missed", "improved": "improved_missed"}[method]
        values = [row[f"{method}_missed"] / row[f"{method}_runs"] for row in lottery]
        holds(stored["claim_no_ik"][key], interval(values))

    def test_runs_that_a_point_in_space_misses(self, lottery, stored):
        told = stored["claim_no_ik"]
        sums = {k: sum(row[f"cartesian_ik_{k}"] for row in lottery)
                for k in ("missed", "runs", "trapped")}  # fmt: skip
        assert told["runs_missed"] == {"count": sums["missed"], "of": sums["runs"]}
        assert told["without_posture_or_colliding"] == sums["missed"] - sums["trapped"]

    def test_share_of_standstills_that_are_minima(self, lottery):
        for method in COLUMNS.values():
            some = [row for row in lottery if row[f"{method}_trapped"] > 0]
            values = [row[f"{method}_held"] / row[f"{method}_trapped"] for row in some]
            found = shares.held_share(method)
            assert found.value == pytest.approx(mean(values))

    @pytest.mark.parametrize("respect", ["ability", "robustness", "quality", "efficiency"])
    def test_superiority(self, lottery, stored, respect):
        def value(row):
            old, new = row["traditional_missed"], row["improved_missed"]
            if respect == "ability":
                return old - new
            if respect == "robustness":
                return float(new == 0) - float(old == 0)
            key = {"quality": "tool_path", "efficiency": "steps_reached"}[respect]
            pair = row[f"traditional_{key}"], row[f"improved_{key}"]
            return np.log(pair[0] / pair[1]) if all(map(number, pair)) else None

        values = [one for one in map(value, lottery) if one is not None]
        told = stored["claim_better"][respect]
        assert told["of"] == len(values)
        holds(told, interval(values))

    @pytest.mark.parametrize("reading", COLUMNS)
    @pytest.mark.parametrize("path", ["tool_path", "joint_path"])
    def test_superiority_of_every_reading(self, registry, lottery, reading, path):
        found = superiority.paired_differences(reading, path)
        prefix = COLUMNS[reading]
        both = [row for row in lottery if number(row[f"{prefix}_{path}"])]
        assert found["quality"].notna().sum() == len(both)
        logs = [np.log(row[f"{prefix}_{path}"] / row[f"improved_{path}"]) for row in both]
        assert found["quality"].mean() == pytest.approx(mean(logs))
        fewer = [row[f"{prefix}_missed"] - row["improved_missed"] for row in lottery]
        assert found["ability"].tolist() == fewer

    @pytest.mark.parametrize("radius", [0.02, 0.1, RADIUS])
    def test_arrangements_with_clear_links(self, registry, lottery, radius):
        limits = {"slave_window": radius, "master_window": radius, "arms": 2 * radius}
        for pair, width in limits.items():
            clear = sum(row[f"cores_{pair}"] > width for row in lottery)
            holds(shares.clear_share(radius, pair)._asdict(), wilson(clear, len(lottery)))
        every = sum(all(row[f"cores_{k}"] > w for k, w in limits.items()) for row in lottery)
        assert shares.clear_share(radius).value == pytest.approx(every / len(lottery))

    def test_other_links_that_touch(self, lottery, stored):
        touch = [row for row in lottery if row["cores_arms"] <= 2 * RADIUS]
        far = [row for row in touch if row["flanges_apart"] > 2 * RADIUS + LAST]
        told = stored["claim_tip_check_suffices"]
        assert (told["touching"], told["refuting"]) == (len(touch), len(far))
        holds(told["share"], wilson(len(far), len(lottery)))
        assert stored["claim_only_tcp"]["others_touch_at_least"] == told["share"]

    def test_farthest_counterexample_is_declared(self, registry, lottery, stored):
        table = shares.lottery_table()
        inside = shares.is_declared(table)
        far = [
            row["flanges_apart"]
            for row, declared in zip(lottery, inside, strict=True)
            if declared
            and row["cores_arms"] <= 2 * RADIUS
            and row["flanges_apart"] > 2 * RADIUS + LAST
        ]
        assert stored["claim_tip_check_suffices"]["farthest_tips"] == pytest.approx(max(far))

    def test_declared_arrangements(self, registry, lottery):
        ranges = {name: REGISTRY.declared(f"xue.{name}", "range").range for name in Layout.names()}
        inside = [
            all(low <= row[name] <= high for name, pair in ranges.items() if pair
                for low, high in [pair])
            for row in lottery
        ]  # fmt: skip
        assert shares.is_declared(shares.lottery_table()).tolist() == inside
        assert 0 < sum(inside)

    def test_witness_carries_its_arrangement(self, registry, lottery):
        found = shares.choice(3, "holds", tips=0.2)
        assert found["choice"].startswith("arrangement 3 of xue_lottery")
        assert found["judged"] == {"tips": 0.2}
        assert set(found["values"]) == set(Layout.names())
        for name in Layout.names():
            assert found["values"][name] == lottery[3][name]

    def test_starts_in_contact(self, lottery, stored):
        left = sum(row["starts_touching"] for row in lottery)
        assert stored["claim_better"]["starts_left_out"] == left
        assert stored["tab02"]["starts_left_out"]["lottery"] == left
        matrix = sum(row["starts_touching"] for row in rows_of("trials"))
        assert stored["tab02"]["starts_left_out"]["matrix"] == matrix


class TestVirtualPoint:
    @pytest.mark.parametrize("method", ["improved", "replaces_goal", "from_start", "always"])
    def test_freed_arrangements(self, registry, ablation, method):
        caught = [row for row in ablation if row["without_virtual_trapped"] > 0]
        freed = sum(
            row["without_virtual_missed"] - row[f"{method}_missed"]
            >= row["without_virtual_trapped"] / 2
            for row in caught
        )
        assert claims.freed(claims._ablation(), method) == {"count": freed, "of": len(caught)}

    def test_sums(self, ablation, lottery, stored):
        told = stored["claim_virtual_escapes"]
        gain = [row["without_virtual_missed"] - row["improved_missed"] for row in ablation]
        assert told["runs_gained"] == sum(gain)
        assert told["spoiled"] == {"count": sum(g < 0 for g in gain), "of": len(ablation)}
        assert told["runs_trapped"] == sum(row["without_virtual_trapped"] for row in ablation)
        assert told["acts"] == sum(row["improved_used"] for row in ablation)
        assert told["rescues"] == sum(row["improved_rescued"] for row in ablation)
        shown = [row for row in lottery if row["without_virtual_trapped"] > 0]
        assert told["freed_shown"]["of"] == len(shown)

    def test_freed_runs_never_exceed_the_trapped(self, registry):
        table = pd.DataFrame({"without_virtual_trapped": [4, 2, 1], "improved_missed": [1, 5, 0],
                              "without_virtual_missed": [4, 3, 3]})  # fmt: skip
        freed, trapped = claims._freed_runs(table, "improved")
        assert freed.tolist() == [3, 0, 1]
        assert trapped.tolist() == [4, 2, 1]


class TestPaths:
    @pytest.mark.parametrize("reading", COLUMNS)
    @pytest.mark.parametrize("measure", ["tool_path", "bending", "radius", "postures"])
    def test_gains(self, registry, paths, reading, measure):
        prefix = COLUMNS[reading]
        both = [r for r in paths if r[f"{prefix}_arrives"] and r["improved_arrives"]]
        pairs = [(r[f"{prefix}_{measure}"], r[f"improved_{measure}"]) for r in both]
        values = [n - o if measure == "radius" else np.log(o / n) for o, n in pairs]
        found = claims.gains_of(prefix)[measure]
        assert found.tolist() == pytest.approx(values, abs=1e-12)

    def test_mean_gains_of_the_item(self, paths, stored):
        both = [r for r in paths if r["traditional_arrives"] and r["improved_arrives"]]
        logs = [np.log(r["traditional_tool_path"] / r["improved_tool_path"]) for r in both]
        told = stored["claim_path_quality"]["tool_path"]
        assert told["of"] == len(both)
        holds(told, interval(logs))
        room = [r["improved_radius"] - r["traditional_radius"] for r in both]
        holds(stored["claim_path_quality"]["radius"], interval(room))

    @pytest.mark.parametrize(
        ("who", "column"),
        [("master", "master_rise"), ("slave", "improved_rise"),
         ("traditional", "traditional_rise")],
    )  # fmt: skip
    def test_attraction_is_largest_at_the_start(self, paths, stored, who, column):
        rises = [row[column] for row in paths if number(row[column])]
        told = stored["claim_attraction_falls"]
        assert told[who] == {"count": sum(r <= 1e-9 for r in rises), "of": len(rises)}
        assert told["largest_rise"][who] == pytest.approx(max(rises))

    def test_goal_angles(self, paths, stored):
        arrived = [row for row in paths if row["improved_arrives"]]
        told = stored["claim_goal_angles"]
        tolerance = 0.02
        near = sum(row["improved_off_goal"] <= tolerance for row in arrived)
        assert told["at_goal"] == {"count": near, "of": len(arrived)}
        assert told["farthest"] == pytest.approx(max(row["improved_off_goal"] for row in arrived))
        old = [row["traditional_off_goal_angles"] for row in paths if row["traditional_arrives"]]
        assert told["traditional_off_angles"] == pytest.approx(median(old))
        assert told["traditional"]["of"] == len(old)

    @pytest.mark.parametrize(
        ("name", "one", "words"),
        [
            ("tool_path", {"value": np.log(2), "low": 0.0, "high": np.log(4)},
             "makes paths shorter by 50 % (0 to 75)"),
            ("tool_path", {"value": -np.log(2), "low": -np.log(4), "high": 0.0},
             "makes paths longer by 100 % (0 to 300)"),
            ("radius", {"value": 0.01, "low": -0.002, "high": 0.022},
             "leaves room for thicker links by 10.0 mm (-2.0 to 22.0)"),
            ("radius", {"value": -0.01, "low": -0.022, "high": 0.002},
             "leaves room for thinner links by 10.0 mm (-2.0 to 22.0)"),
        ],
    )  # fmt: skip
    def test_gains_in_words(self, name, one, words):
        assert claims._told(name, one).replace("-0 ", "0 ") == words

    def test_gains_as_drawn(self, stored):
        import matplotlib.pyplot as plt

        found = stored["claim_path_quality"]
        figure = claims.gains_figure(found)
        left, right = figure.axes
        plt.close(figure)
        points = [line for line in left.lines if line.get_marker() == "o"]
        for line, name in zip(points, ("tool_path", "bending", "postures"), strict=True):
            # of a logarithm g the share 1 - e^-g is saved
            assert line.get_xdata() == pytest.approx(100 * (1 - np.exp(-found[name]["value"])))
        (point,) = [line for line in right.lines if line.get_marker() == "o"]
        assert point.get_xdata() == pytest.approx(1000 * found["radius"]["value"])
        assert "[mm]" in right.get_xlabel()
        assert "[%]" in left.get_xlabel()


@pytest.fixture(scope="module")
def scenes(registry):
    return rows_of("planners")


class TestPlanners:
    def test_postures_saved(self, scenes, stored):
        arrived = [row for row in scenes if row["points_arrives"]]
        told = stored["claim_efficient"]
        logs = {
            name: [np.log(row[f"{name}_effort"] / row["points_effort"]) for row in arrived]
            for name in ("rrt_in_turn", "rrt_both")
        }
        assert told["against"] == min(logs, key=lambda name: mean(logs[name]))
        holds(told["saved"], interval(logs[told["against"]]))
        assert told["scenes"] == len(arrived)
        for name, value in told["median"].items():
            assert value == median(row[f"{name}_effort"] for row in arrived)

    def test_motions_certified_free(self, scenes, stored):
        for name, told in stored["claim_efficient"]["free"].items():
            free = sum(row[f"{name}_free"] is True for row in scenes)
            holds(told, wilson(free, len(scenes)))

    def test_by_obstacles(self, registry, scenes):
        found = beyond.free_by_obstacles()
        assert len(found) == len({row["spheres"] for row in scenes})
        alone = [row for row in scenes if row["spheres"] == 0]
        shares_alone = list(found["the window alone"].values())
        assert shares_alone[0].value == pytest.approx(
            sum(row["points_free"] is True for row in alone) / len(alone)
        )

    def test_comparison(self, registry, scenes):
        table = beyond.comparison_frame().set_index("planner")
        for name, title in beyond.METHODS.items():
            row = table.loc[title]
            assert row["arrives"] == f"{sum(r[f'{name}_arrives'] for r in scenes)} of {len(scenes)}"
            effort = [r[f"{name}_effort"] for r in scenes if r[f"{name}_arrives"]]
            assert row["postures, median"] == median(effort)

    def test_factors(self):
        found = beyond._factors({"value": np.log(4.5), "low": np.log(3.0), "high": np.log(6.0)})
        assert found == pytest.approx({"factor": 4.5, "low": 3.0, "high": 6.0})


def test_cells_of_the_matrix(registry, stored):
    rows = rows_of("trials")
    for cell in shares.table_2_matrix():
        tagged = cell.method == "improved" or cell.criterion == "position"
        name = cell.method if tagged else f"{cell.method}_{cell.criterion}"
        some = [
            r for r in rows
            if r["update_rule"] == cell.update_rule and r["half_width"] == cell.half_width
        ]  # fmt: skip
        runs = sum(r[f"{name}_runs"] for r in some)
        assert cell.runs == runs
        for part in ("missed", "held"):
            expected = wilson(sum(r[f"{name}_{part}"] for r in some), runs)
            holds(getattr(cell, part)._asdict(), expected)


def test_minima_by_weight(registry):
    rows = rows_of("minima")
    for weight, share in shares.minima_shares().items():
        some = [row for row in rows if row["weight"] == weight]
        found = wilson(sum(r["minima"] for r in some), sum(r["pairs"] for r in some))
        holds(share._asdict(), found)
        assert all(row["minima"] <= row["elsewhere"] <= row["pairs"] for row in some)


def test_verdicts_ask_for_the_reading_of_the_traditional_method(registry):
    for reading in COLUMNS:
        found = evaluate(registry, "xue.claim_better", {"classical_method": reading})
        assert found.result.obtained["mean_missed"]["traditional"] == pytest.approx(
            float(np.mean(shares.missed(reading)))
        )


def test_the_nominal_arrangement_is_declared(registry):
    layout = nominal().layout
    row = pd.DataFrame([{name: getattr(layout, name) for name in Layout.names()}])
    assert shares.is_declared(row).tolist() == [True]
    far = row.assign(window_bar=5.0)
    assert shares.is_declared(far).tolist() == [False]
