"""Figures of the arena: what is drawn is what is counted, with units and names."""

import contest_rows
import matplotlib.pyplot as plt
import numpy as np
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
