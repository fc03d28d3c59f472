"""Kinematics, distances and rows against the scene, the arms and finite differences."""

import numpy as np
import pytest

from dualarm_repro.control.assembly import make_buffers, sense, state
from dualarm_repro.control.damper import approach_bound
from dualarm_repro.control.settings import ROWS_PER_PAIR, ControllerSettings, Damper, RowForm
from dualarm_repro.errors import InputError, UnknownNameError
from dualarm_repro.scene.clearance import distances
from dualarm_repro.scene.gradients import clearance_gradient
from dualarm_repro.settings import code

STILL = np.zeros((2, 3))
NO_NOISE = np.empty(0)


def filled(system, q, **settings):
    numbers = ControllerSettings(**settings).numbers()
    buffers = make_buffers(system.arrays, numbers)
    count = sense(system.arrays, numbers, q, NO_NOISE, buffers)
    return buffers, count, state(system.arrays, numbers, q, q, STILL, STILL, count, buffers)


def test_kinematics_equal_the_arms_and_the_scene(system, q):
    buffers, count, program = filled(system, q, outer=5.0)
    scene, gradient = clearance_gradient(system.scene, q)
    np.testing.assert_allclose(buffers.surface, scene.distance, atol=1e-12)
    np.testing.assert_allclose(-program.G, gradient, atol=1e-12)
    np.testing.assert_allclose(buffers.tips, system.tips(q), atol=1e-12)
    J = np.zeros((6, 14))
    for k, (placed, part) in enumerate(zip(system.arms, np.split(q, 2), strict=True)):
        J[3 * k : 3 * k + 3, 7 * k : 7 * k + 7] = (
            placed.placement.rotation @ placed.arm.jacobian(part)[:3]
        )
    np.testing.assert_allclose(program.A, J, atol=1e-12)
    assert count == len(program.h) == len(system.arrays.pairs)


@pytest.mark.parametrize("seed", range(20))
def test_row_gradients_pass_finite_differences(system, seed):
    arrays = system.arrays
    q = np.random.default_rng(seed).uniform(0.4 * arrays.lower, 0.4 * arrays.upper)
    _, _, program = filled(system, q, outer=5.0)
    step = 1e-6
    moved = q + step * np.vstack([np.eye(14), -np.eye(14)])
    d = distances(system.scene, moved)
    difference = (d[:14] - d[14:]).T / (2 * step)
    assert np.abs(difference + program.G).max() <= 1e-6


def test_forms_are_related(system, q):
    near = {"outer": 0.6, "inner": 0.0}
    buffers, count, normal = filled(system, q, **near)
    assert len(normal.h) > 3
    *_, parts = filled(system, q, form="pair_components", **near)
    np.testing.assert_allclose(parts.G.reshape(-1, 3, 14).sum(axis=1), normal.G, atol=1e-12)
    np.testing.assert_allclose(parts.h.reshape(-1, 3).sum(axis=1), normal.h, atol=1e-12)
    *_, alone = filled(system, q, form="arm_normal", **near)
    # Both arms' rows of a pair add up to the relative one, unless one link stands still.
    moving = [_moves(system, k) for k in buffers.chosen[:count]]
    at = np.cumsum([0] + [2 if moves else 1 for moves in moving])
    for row in np.flatnonzero(moving):
        both = alone.G[at[row] : at[row] + 2].sum(axis=0)
        np.testing.assert_allclose(both, normal.G[row], atol=1e-12)


def test_selections_nest(system, q):
    chosen = {}
    for name in ("all_within_outer", "nearest_per_link", "single_nearest"):
        buffers, count, _ = filled(system, q, outer=0.8, selection=name)
        chosen[name] = set(buffers.chosen[:count])
    assert chosen["single_nearest"] < chosen["nearest_per_link"] < chosen["all_within_outer"]
    assert len(chosen["single_nearest"]) == 1


@pytest.mark.parametrize("law", Damper)
def test_dampers(law):
    d = np.linspace(-0.02, 0.0999, 300)
    beta = np.array([approach_bound(code(law), v, 5.0, 0.1, 0.03) for v in d])
    assert (np.diff(beta) >= 0).all()
    if law is Damper.LINEAR:
        np.testing.assert_allclose(beta, 5.0 * (d - 0.03), atol=1e-15)
    assert (beta[d < 0.03] <= 0).all()


def test_joint_bounds_brake_before_the_limit_and_drive_back_beyond(system, q):
    arrays = system.arrays
    for i in (1, 3):
        near, beyond = q.copy(), q.copy()
        near[i], beyond[i] = arrays.upper[i] - 0.06, arrays.upper[i] + 0.02
        *_, program = filled(system, near)
        assert program.upper[i] == pytest.approx(5.0 * 0.01)
        *_, program = filled(system, beyond)
        assert program.upper[i] == pytest.approx(-5.0 * 0.07)
        assert (program.lower <= program.upper).all()
        near[i], beyond[i] = arrays.lower[i] + 0.06, arrays.lower[i] - 0.02
        *_, program = filled(system, near)
        assert program.lower[i] == pytest.approx(-5.0 * 0.01)
        *_, program = filled(system, beyond)
        assert program.lower[i] == pytest.approx(5.0 * 0.07)
        assert (program.lower <= program.upper).all()


@pytest.mark.parametrize(
    "wrong",
    [
        {"outer": 0.03},
        {"inner": 0.2},
        {"damper_gain": -1.0},
        {"feedback": np.nan},
        {"limit_gain": 0.0},
    ],
)
def test_bad_settings_are_refused(wrong):
    with pytest.raises(InputError, match="ControllerSettings"):
        ControllerSettings(**wrong)


@pytest.mark.parametrize("name", ["form", "damper", "selection"])
def test_unknown_names_are_refused(name):
    with pytest.raises(UnknownNameError, match=f"{name} = 'other'"):
        ControllerSettings(**{name: "other"})


@pytest.mark.parametrize("form", RowForm)
def test_no_pair_gives_more_rows_than_its_form_says(system, q, form):
    buffers, count, program = filled(system, q, form=form, outer=0.6, inner=0.0)
    assert 0 < len(program.h) <= ROWS_PER_PAIR[form] * count <= len(buffers.program.h)


def _moves(system, pair):
    arrays = system.arrays
    return all(arrays.first[body] < arrays.last[body] for body in arrays.pairs[pair])


@pytest.mark.parametrize("damper", [Damper.LINEAR, Damper.SINE_SQUARED, Damper.STEP])
def test_a_pair_that_enters_may_approach_at_the_closing_speed(damper):
    entering = approach_bound(code(damper), 0.09, 3.0, 0.09, 0.02)
    assert entering == pytest.approx(3.0 * (0.09 - 0.02))
