"""Which pairs give rows, and the rows of every form against matrices."""

from types import SimpleNamespace

import numpy as np
import pytest

from dualarm_repro.control.assembly import make_buffers, sense, state
from dualarm_repro.control.avoidance import select_pairs
from dualarm_repro.control.settings import ControllerSettings, PairSelection
from dualarm_repro.differences import central_differences
from dualarm_repro.settings import code

#: Bodies 0, 1 of one arm against 2, 3 of the other.
PAIRS = np.array([[0, 2], [0, 3], [1, 2], [1, 3]])


def chosen(selection, distance, outer=0.5):
    arrays = SimpleNamespace(pairs=PAIRS, radius=np.ones(4))
    numbers = np.empty(len(PAIRS), np.int64)
    count = select_pairs.py_func(arrays, code(selection), outer, np.array(distance), numbers)
    return numbers[:count].tolist()


@pytest.mark.parametrize(
    ("selection", "distance", "expected"),
    [
        (PairSelection.ALL_WITHIN_OUTER, [0.4, 0.1, 0.5, 0.3], [0, 1, 3]),
        (PairSelection.SINGLE_NEAREST, [0.4, 0.1, 0.5, 0.3], [1]),
        (PairSelection.SINGLE_NEAREST, [0.9, 0.7, 0.5, 0.6], []),
        # Nearest of body 0: pair 1, of body 1: pair 3, of body 2: pair 0, of body 3: pair 1.
        (PairSelection.NEAREST_PER_LINK, [0.4, 0.1, 0.45, 0.3], [0, 1, 3]),
        # Pair 2 is the nearest of body 2, but beyond the outer range.
        (PairSelection.NEAREST_PER_LINK, [0.9, 0.1, 0.6, 0.3], [1, 3]),
        (PairSelection.NEAREST_PER_LINK, [0.1, 0.2, 0.3, 0.4], [0, 1, 2]),
    ],
)
def test_pairs_that_give_rows(selection, distance, expected):
    assert chosen(selection, distance) == expected


def stated(system, q, **settings):
    numbers = ControllerSettings(outer=0.6, inner=0.0, **settings).numbers()
    buffers = make_buffers(system.arrays, numbers)
    count = sense(system.arrays, numbers, q, np.empty(0), buffers)
    still = np.zeros((2, 3))
    program = state(system.arrays, numbers, q, q, still, still, count, buffers)
    return buffers, buffers.chosen[:count].copy(), program


def point_slopes(system, q, body, point):
    """Derivative (3, n) of the point of a body that is at ``point`` now, by differences."""
    from .test_kinematics import frames_at

    arrays = system.arrays
    F = frames_at(arrays, q)[0][arrays.frame[body]]
    local = F[:, :3].T @ (point - F[:, 3])

    def place(at):
        G = frames_at(arrays, at)[0][arrays.frame[body]]
        return G[:, :3] @ local + G[:, 3]

    return central_differences(place, q).T


@pytest.fixture(scope="module")
def slopes(system, q):
    """Of every pair that gives rows: normal, velocities of both points, approach and still."""
    buffers, pairs, _ = stated(system, q)
    arrays, found = system.arrays, []
    for k in pairs:
        bodies = arrays.pairs[k]
        D = [
            sign * point_slopes(system, q, body, buffers.witness[k, side])
            for side, (body, sign) in enumerate(zip(bodies, (-1, 1), strict=True))
        ]
        still = [arrays.first[body] == arrays.last[body] for body in bodies]
        found.append((buffers.witness[k, 2].copy(), D, 5.0 * buffers.distance[k], still))
    return found


def expected_rows(form, normal, D, beta, still):
    """Rows of one pair as the formulas of the module have them."""
    both, n = D[0] + D[1], normal
    axes = range(3)
    if form == "pair_normal":
        return [(-n @ both, beta)]
    if form == "pair_axes":
        return [(-np.sign(n[r]) * both[r], beta) for r in axes]
    if form == "pair_components":
        return [(-n[r] * both[r], n[r] ** 2 * beta) for r in axes]
    alone = [side for side, fixed in zip(D, still, strict=True) if not fixed]
    if form == "arm_normal":
        return [(-n @ side, beta) for side in alone]
    return [(-np.sign(n[r]) * side[r], beta) for side in alone for r in axes]


@pytest.mark.parametrize(
    "form", ["pair_normal", "arm_normal", "pair_axes", "arm_axes", "pair_components"]
)
def test_every_form_has_the_rows_of_its_formula(system, q, slopes, form):
    *_, program = stated(system, q, form=form)
    rows = [row for one in slopes for row in expected_rows(form, *one)]
    assert any(any(still) for *_, still in slopes)
    np.testing.assert_allclose(program.G, [row for row, _ in rows], atol=1e-8)
    np.testing.assert_allclose(program.h, [bound for _, bound in rows], atol=1e-12)


def test_without_avoidance_there_is_no_row(system, q):
    _, pairs, program = stated(system, q, avoid=False)
    assert len(pairs) == len(program.h) == 0


def test_between_axes_the_radii_are_left_out_of_what_is_kept(system, q):
    surface, pairs, _ = stated(system, q)
    axes, *_ = stated(system, q, surface=False)
    radii = system.arrays.radius[system.arrays.pairs].sum(axis=1)
    np.testing.assert_allclose(axes.distance - surface.distance, radii, atol=1e-12)
    np.testing.assert_allclose(axes.surface, surface.surface, atol=1e-15)
    assert len(pairs) > 0
