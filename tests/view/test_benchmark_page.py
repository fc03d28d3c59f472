"""Tables and figures of the stored run say what its rows say, missed gates too."""

import json
from io import StringIO

import matplotlib.pyplot as plt
import pandas as pd
import pytest

from dualarm_repro.errors import DataFileError
from dualarm_repro.view import benchmark_figures, benchmark_page
from dualarm_repro.view.benchmark_run import BenchmarkRun, stored
from dualarm_repro.view.legibility import faults
from dualarm_repro.view.style import BLUE, RED

ROW = {
    "suite": "kinematics", "task": "pose", "implementation": "dualarm_repro", "threads": 1,
    "items": 100, "rounds": 5, "microseconds": 0.0347, "quartiles": [0.034, 0.036],
    "cpu_microseconds": 0.0346, "cpu_quartiles": [0.034, 0.035], "first_call_seconds": 2.5,
    "ratio": 1.0, "cpu_ratio": 1.0, "same_work": "the reference",
}  # fmt: skip
PEER = {**ROW, "implementation": "peer", "microseconds": 1.041, "ratio": 30.0, "same_work": None}
PLAN = {**ROW, "suite": "start_up", "task": "plan", "microseconds": 2.5e6, "ratio": 1.0}
CLAIM = {
    "suite": "kinematics", "text": "poses", "task": "pose", "ours": "dualarm_repro", "peer": "peer",
    "kind": "faster", "gate": 20.0, "goal": 40.0, "value": 30.0, "gate_holds": True,
    "goal_holds": False, "reason": None,
}  # fmt: skip
CLAIMS = [
    CLAIM,
    {**CLAIM, "text": "missed", "value": 10.0, "gate_holds": False},
    {**CLAIM, "text": "reached", "value": 41.2345, "goal_holds": True},
    {**CLAIM, "text": "one call", "kind": "at most", "gate": 1.5, "goal": None, "value": 0.5,
     "goal_holds": None},
    {**CLAIM, "text": "absent", "value": None, "gate_holds": None, "goal_holds": None,
     "reason": "not measured: peer"},
    {**CLAIM, "suite": "start_up", "text": "planning", "task": "plan", "kind": "seconds",
     "gate": 3.0, "goal": None, "value": 2.5, "goal_holds": None},
]  # fmt: skip


def series(name, limit, per_item, sizes):
    points = [
        {"x": x, "seconds": per_item * x, "quartiles": [0.9 * per_item * x, 1.1 * per_item * x],
         "cpu_seconds": per_item * x} for x in sizes
    ]  # fmt: skip
    return {"name": name, "limit": limit, "points": points}


CURVE = {
    "name": "configurations", "title": "poses", "x": "configurations",
    "series": [
        series("dualarm_repro", False, 1e-8, (10, 1_000, 100_000, 1_000_000)),
        series("peer", False, 1e-6, (10, 1_000)),
        series("touching the memory", True, 4e-9, (10, 1_000, 100_000)),
    ],
    "peak_mb": {"10": 200.0, "1000000": 391.2},
}  # fmt: skip
WORKERS = {
    "name": "workers", "title": "cells", "x": "worker processes",
    "series": [
        {"name": "a_study", "limit": False, "points": [
            {"x": 1, "seconds": 1.9, "quartiles": [1.8, 2.0], "cpu_seconds": 1.9},
            {"x": 2, "seconds": 1.0, "quartiles": [0.9, 1.1], "cpu_seconds": 2.0,
             "start_seconds": 1.5}]}],
    "peak_mb": {},
}  # fmt: skip
CONTENT = {
    "cpu": "a processor", "vectors": "AVX2", "cores": 2, "memory_gb": 8.0, "system": "Linux",
    "python": "3.11.7", "libraries": {"numpy": "2.4"}, "missing": {"mink": "control step"},
    "load": {"kinematics": [0.1, 1.25], "start_up": [0.9, 1.0]}, "rows": [ROW, PEER, PLAN],
    "claims": CLAIMS, "growth": [CURVE, WORKERS],
    "different": [{"suite": "kinematics", "task": "pose", "implementation": "a <liar>",
                   "reason": "differs by 1"}],
}  # fmt: skip


@pytest.fixture(scope="module")
def run():
    return BenchmarkRun.model_validate(CONTENT)


@pytest.fixture(autouse=True)
def closed():
    yield
    plt.close("all")


def cells(page):
    (found,) = pd.read_html(StringIO(page.html), keep_default_na=False)
    return found.astype(str).to_numpy().tolist()


def test_machine(run):
    text = benchmark_page.machine_page(run).html
    assert "a processor, AVX2, 2 cores, 8 GB" in text
    assert "0.1 to 1.2 processes" in text
    assert "mink (control step)" in text


def test_nothing_missing_is_said():
    everything = BenchmarkRun.model_validate({**CONTENT, "missing": {}})
    assert "No peer" in benchmark_page.machine_page(everything).html


def test_claims(run):
    assert cells(benchmark_page.claims_page(run)) == [
        ["poses", "30×", "≥ 20×", "≥ 40×", "gate holds"],
        ["missed", "10×", "≥ 20×", "≥ 40×", "gate MISSED"],
        ["reached", "41.2×", "≥ 20×", "≥ 40×", "goal reached"],
        ["one call", "0.5×", "≤ 1.5×", "", "gate holds"],
        ["absent", "not measured: peer", "≥ 20×", "≥ 40×", "not measured"],
        ["planning", "2.5 s", "≤ 3 s", "", "gate holds"],
    ]


def test_rows(run):
    page = benchmark_page.rows_page(run, "kinematics")
    ours, peer = cells(page)
    assert ours == [
        "pose", "dualarm_repro", "34.7 ns", "34 ns – 36 ns", "34.6 ns", "1", "2.5 s",
        "the reference",
    ]  # fmt: skip
    assert (peer[2], peer[5], peer[7]) == ("1.04 µs", "30", "not checked")
    assert "a &lt;liar&gt;" in page.html


@pytest.mark.parametrize(
    ("microseconds", "text"),
    [(0.0042, "4.2 ns"), (0.9996, "1 µs"), (12.34, "12.3 µs"), (4567.0, "4.57 ms"),
     (999_600.0, "1 s"), (1.5e7, "15 s")],
)  # fmt: skip
def test_durations(microseconds, text):
    assert benchmark_page.duration(microseconds) == text


def test_workers(run):
    assert cells(benchmark_page.workers_page(run)) == [
        ["a_study", "1.9", "1.0", "1.9", "1.05", "1.5"]
    ]


def test_a_run_that_took_wall_for_cpu_time_tells_no_cpu_time():
    content = json.loads(json.dumps(CONTENT))
    del content["growth"][1]["series"][0]["points"][1]["start_seconds"]
    older = BenchmarkRun.model_validate(content)
    assert cells(benchmark_page.workers_page(older)) == [["a_study", "1.9", "1.0", "1.9"]]


def test_claims_are_drawn_by_their_margin(run):
    figure, finding, alt = benchmark_figures.claims_figure(run)
    (ax,) = figure.axes
    drawn = [line for line in ax.lines if line.get_marker() in ("o", "X")]
    assert [line.get_xdata()[0] for line in drawn] == pytest.approx(
        [1.5, 0.5, 2.06, 3.0, 1.2], 1e-2
    )
    assert [line.get_marker() for line in drawn] == ["o", "X", "o", "o", "o"]
    assert [line.get_color() for line in drawn] == [BLUE, RED, BLUE, BLUE, BLUE]
    goals = [line.get_xdata()[0] for line in ax.lines if line.get_marker() == "D"]
    assert goals == [2.0, 2.0, 2.0]
    assert finding.startswith("4 of 5 gates hold, and 1 of 3 goals are reached. Missed: missed.")
    assert "1 more claims could not be measured" in finding
    assert "missed: 0.5 times, gate MISSED" in alt
    assert faults(figure) == []


def test_growth_shows_the_limit_beside_ours(run):
    figure, finding, alt = benchmark_figures.growth_figure(run.curve("configurations"))
    (ax,) = figure.axes
    ours, peer, limit = ax.lines
    assert ours.get_ydata() == pytest.approx(0.01)
    assert peer.get_ydata() == pytest.approx(1.0)
    assert limit.get_ydata() == pytest.approx(0.004)
    assert [line.get_linestyle() for line in (ours, peer, limit)] == ["-", "-", "--"]
    assert len({line.get_marker() for line in ax.lines}) == 3
    assert finding == (
        "100,000 times as many configurations take 100,000 times as long, 10 ns at 10 and 10 ns at "
        "1,000,000 each. At 1,000 peer takes 100 times as long as ours. At 100,000 ours takes 2.5 "
        "times as long as touching the memory. Ours takes at most 391 MB of memory, libraries "
        "included."
    )
    assert "peer from 1 µs at 10 to 1 µs at 1,000" in alt
    assert faults(figure) == []


def test_growth_of_a_call(run):
    figure, _, _ = benchmark_figures.growth_figure(run.curve("configurations"), per_item=False)
    assert figure.axes[0].lines[0].get_ydata()[:2] == pytest.approx([1e-4, 1e-2])


def test_start_up_shows_its_limits(run):
    figure, finding, alt = benchmark_figures.start_up_figure(run)
    (ax,) = figure.axes
    limits = [line for line in ax.lines if line.get_color() == RED and len(line.get_xdata())]
    assert [line.get_xdata()[0] for line in limits] == [3.0]
    dots = [line for line in ax.lines if line.get_marker() == "o" and len(line.get_xdata())]
    assert [line.get_xdata()[0] for line in dots] == [2.5]
    assert finding == "1 of 1 limits of start-up are kept."
    assert "planning 2.5 s (limit 3 s)" in alt
    assert faults(figure) == []


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("{", "a stored run"),
        (json.dumps({**CONTENT, "cores": "many"}), "cores"),
        (json.dumps({**CONTENT, "surplus": 1}), "surplus"),
    ],
)
def test_a_damaged_file_is_named(tmp_path, text, says):
    path = tmp_path / "benchmarks.json"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(DataFileError, match=says):
        stored(path)


def test_what_was_not_measured_is_named(run):
    nothing = BenchmarkRun.model_validate({**CONTENT, "growth": [], "rows": [ROW]})
    assert "stored run: moons" in benchmark_figures.growth_page(run, "moons").html
    assert "<svg" not in benchmark_figures.growth_page(run, "moons").html
    assert "stored run: start_up" in benchmark_figures.start_up_page(nothing).html
    assert "stored run: workers" in benchmark_page.workers_page(nothing).html
    page = benchmark_page.rows_page(nothing, "kinematics", "control")
    assert "stored run: control." in page.html
    assert len(cells(page)) == 1


def test_what_was_measured_is_drawn(run):
    assert "<figure" in benchmark_figures.growth_page(run, "configurations").html
    assert "<figure" in benchmark_figures.start_up_page(run).html
