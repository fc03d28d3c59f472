"""Figures of the arena: what is drawn is what is counted, with units and names."""

import contest_rows
import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
import pytest
from contest_rows import A, B

from dualarm_repro.arena import figures
from dualarm_repro.arena.judged import Outcome
from dualarm_repro.arena.summary import contest, outcome_counts, success_table


@pytest.fixture
def rows():
    yield contest(contest_rows.table())
    plt.close("all")


def test_successes_are_drawn_where_they_are(rows):
    ax = figures.success_figure(rows).axes[0]
    assert ax.get_xlabel() == "share of the feasible tasks"
    names = [label.get_text() for label in ax.get_yticklabels()]
    certified = [one for one in ax.collections if "certified" in str(one.get_label())]
    drawn = {names[int(y)]: x for one in certified for x, y in one.get_offsets()}
    share = success_table(rows)["share"]
    assert drawn == pytest.approx({A: share[A], B: share[B]})
    assert len(certified) == 2  # the documents' and today's, told by colour and by shape
    assert len({one.get_paths()[0].vertices.shape for one in certified}) == 2


def test_bars_add_up_to_the_tasks(rows):
    ax = figures.outcome_figure(rows).axes[0]
    assert ax.get_xlabel() == "number of tasks"
    width = sum(bar.get_width() for bar in ax.patches)
    assert width == outcome_counts(rows).to_numpy().sum() == 8


def test_every_outcome_of_a_task_has_a_colour_of_its_own():
    assert set(figures._OUTCOMES) == set(Outcome) - {Outcome.NO_TASK}
    looks = list(figures._OUTCOMES.values())
    assert len(set(looks)) == len(looks)


def test_profile_ends_at_the_share_that_is_done(rows):
    ax = figures.profile_figure(rows, "joint_length", "length over the best").axes[0]
    lines = {line.get_label(): line.get_ydata() for line in ax.lines}
    assert lines[A][-1] == pytest.approx(2 / 3)
    assert lines[B][-1] == pytest.approx(1 / 3)
    assert all((np.diff(line) >= 0).all() for line in lines.values())
    assert ax.get_xlabel() == "length over the best"


def test_intervals_are_drawn_at_their_methods(rows):
    ax = figures.success_figure(rows).axes[0]
    names = [label.get_text() for label in ax.get_yticklabels()]
    table = success_table(rows)
    spans = {
        names[round(segment[0, 1])]: segment[:, 0].tolist()
        for lines in ax.collections
        if hasattr(lines, "get_segments")
        for segment in lines.get_segments()
    }
    assert spans == {name: [table.loc[name, "low"], table.loc[name, "high"]] for name in (A, B)}
    claims = next(one for one in ax.collections if one.get_label() == "planner's claim")
    drawn = {names[round(y)]: x for x, y in claims.get_offsets()}
    assert drawn == pytest.approx(table["claimed"].to_dict())
    assert ax.get_xlim() == (-0.02, 1.02)


def test_bars_of_a_method_touch_and_keep_the_order_of_the_outcomes(rows):
    ax = figures.outcome_figure(rows).axes[0]
    counts = outcome_counts(rows).iloc[::-1]
    ends = np.zeros(len(counts))
    for container, outcome in zip(ax.containers, figures._OUTCOMES, strict=True):
        assert container.get_label() == str(outcome)
        lefts = np.array([bar.get_x() for bar in container])
        np.testing.assert_allclose(lefts, ends)
        widths = np.array([bar.get_width() for bar in container])
        np.testing.assert_array_equal(widths, counts[str(outcome)])
        ends = lefts + widths
    assert [t.get_text() for t in ax.get_yticklabels()] == list(counts.index)


def test_only_the_best_eight_have_a_profile_and_all_look_different(rows):
    many = pd.concat(
        [rows.assign(method=rows["method"] + f" {k}", success=rows["success"] & (k % 3 > 0))
         for k in range(6)]
    )  # fmt: skip
    ax = figures.profile_figure(many, "joint_length", "length over the best").axes[0]
    assert len(ax.lines) == 8
    assert not any(line.get_label().endswith((" 0", " 3")) for line in ax.lines)
    looks = {(line.get_color(), line.get_linestyle()) for line in ax.lines}
    assert len(looks) == 8
    assert ax.get_xlim() == (1.0, 10.0)
    assert [t.get_text() for t in ax.get_xticklabels()] == ["1", "2", "5", "10"]
