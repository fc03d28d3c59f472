"""The weld of `pan` as a file of joint angles: closed, timed by its arc, and what it costs."""

import numpy as np
import pytest
from scipy.integrate import quad

from dualarm_repro.ledger import REGISTRY
from dualarm_repro.papers.pan.pages import weld as page
from dualarm_repro.papers.pan.reading import Problem, solved
from dualarm_repro.welding import ROBOTS
from dualarm_repro.welding.execution import EFFORTS


@pytest.fixture(scope="module")
def job(nominal, stored):
    task = Problem.of(nominal)
    return task.job.cell(), solved(task.job, tuple(stored["eq_opt"]["optimum"]))


@pytest.fixture(scope="module")
def length():
    """Length of the seam by quadrature of |dp/dtheta| [m]."""
    a, b = 0.1, 0.06

    def rate(t):
        z = np.sqrt(a**2 - (b * np.sin(t)) ** 2)
        return np.hypot(b, b**2 * np.sin(t) * np.cos(t) / z)

    return quad(rate, 0, 2 * np.pi, limit=200)[0]


def test_file_ends_where_it_began_one_turn_of_the_seam_later(job, length):
    table = page.job_file(*job, 0.01)
    assert len(table) == 73
    assert table["seam [m]"].iloc[0] == 0
    assert table["seam [m]"].iloc[-1] == pytest.approx(length, rel=1e-5)
    # the curve is the same in every quarter of the turn, forth and back
    np.testing.assert_allclose(table["seam [m]"][::18], length * np.arange(5) / 4, rtol=1e-5)
    np.testing.assert_allclose(table["seam [m]"][:19] + table["seam [m]"][18:37][::-1].to_numpy(),
                               length / 2, rtol=1e-5)  # fmt: skip
    joints = [name for name in table if name.endswith("[deg]")]
    assert joints == [f"{robot} q{j} [deg]" for robot in ROBOTS for j in range(1, 7)]
    turn = (table[joints].iloc[-1] - table[joints].iloc[0]) / 360
    np.testing.assert_allclose(turn, np.round(turn), atol=1e-9)
    _, jobs = job
    np.testing.assert_allclose(
        table[joints].to_numpy()[:-1].T.reshape(3, 6, 72),
        np.degrees(jobs.q[0].transpose(0, 2, 1)), atol=1e-12,
    )  # fmt: skip


@pytest.mark.parametrize("pace", [0.005, 0.01, 0.3])
def test_time_is_way_over_pace(job, pace):
    table = page.job_file(*job, pace)
    np.testing.assert_allclose(table["time [s]"] * pace, table["seam [m]"], atol=1e-15)
    assert (np.diff(table["time [s]"]) > 0).all()


def test_a_turn_of_a_joint_is_closed_by_full_turns(job):
    from dataclasses import replace

    cell, jobs = job
    wound = jobs.q.copy()
    wound[0, 1, :, 5] += np.linspace(0, 2 * np.pi, 73)[:-1]
    table = page.job_file(cell, replace(jobs, q=wound), 0.01)
    column = table[f"{ROBOTS[1]} q6 [deg]"]
    assert column.iloc[-1] - column.iloc[0] == pytest.approx(-360) or column.iloc[-1] - column.iloc[
        0
    ] == pytest.approx(360)
    assert abs(column.iloc[-1] - column.iloc[-2]) < 30


def test_fastest_pace_keeps_every_speed_limit_by_differences(job, stored):
    """At the stored pace the file's own differences stay at the limits, and one is reached."""
    cell, jobs = job
    table = page.job_file(cell, jobs, stored["claim_joint_sequence"]["arc_speed"])
    limits = np.concatenate([np.degrees(a.model.upperVelocityLimit[:6]) for a in cell.arms])
    joints = [name for name in table if name.endswith("[deg]")]
    speeds = np.abs(np.diff(table[joints], axis=0)) / np.diff(table["time [s]"])[:, np.newaxis]
    most = (speeds / limits).max()
    # differences over 5 deg of the seam flatten the peak
    assert 0.9 < most < 1.02


def test_largest_step_between_seam_points(job, stored):
    _, jobs = job
    steps = np.abs(np.diff(jobs.q[0], axis=1, append=jobs.q[0][:, :1]))
    steps = np.minimum(steps, 2 * np.pi - steps)
    told = stored["claim_joint_sequence"]["largest_step_deg"]
    assert told == pytest.approx(np.degrees(steps.max()), abs=1e-9)


def test_limits_are_read_from_the_item(registry):
    declared = REGISTRY.look("pan.claim_joint_sequence").thresholds
    for name in ("welding_speed", "off_seam"):
        assert page._limit(name) == declared[name].value


def test_efforts_by_hand(job):
    cell, jobs = job
    path = jobs.q[0]
    changes = np.diff(path, axis=1, append=path[:, :1])
    step = 2 * np.pi / 72
    assert EFFORTS["joint_travel"](cell, jobs)[0] == pytest.approx(np.abs(changes).sum())
    assert EFFORTS["squared_speed"](cell, jobs)[0] == pytest.approx(
        ((changes / step) ** 2).sum() / 72
    )
    limits = np.stack([arm.model.upperVelocityLimit[:6] for arm in cell.arms])
    peak = (np.abs(changes / step) / limits[:, np.newaxis]).max()
    assert EFFORTS["peak_speed"](cell, jobs)[0] == pytest.approx(peak)


def test_shares_of_the_statement_on_effort(stored):
    found = stored["claim_energy"]
    assert found["share"] == pytest.approx(found["better"] / found["positions"])
    feasible = stored["eq_opt"]["feasible_share"]
    assert found["positions"] == round(feasible * 29 * 19 * 24)  # grid of 0.1 m in the region
    assert found["least"] < 1
    assert found["fitness_there"] < 1


def test_sudden_turns_compare_two_paces(stored):
    found = stored["claim_sudden_turns"]
    optimum = stored["claim_joint_sequence"]["arc_speed"]
    assert found["ratio"] == pytest.approx(optimum / found["arc_speed"], rel=1e-9)
