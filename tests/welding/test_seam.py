"""The seam lies on both pipes, its normals are theirs, and bad radii are refused."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dualarm_repro.errors import InputError, UnknownNameError
from dualarm_repro.welding import POSTURES, flat_rotations, saddle_seam
from dualarm_repro.welding.posture import smallest_rotations

radii = st.tuples(st.floats(0.05, 0.5), st.floats(0.1, 0.98)).map(lambda r: (r[0], r[0] * r[1]))


@given(radii, st.integers(3, 90))
def test_on_both_cylinders(radius, count):
    seam = saddle_seam(*radius, count)
    x, y, z = seam.points.T
    assert np.allclose(np.hypot(y, z), radius[0], atol=1e-12)
    assert np.allclose(np.hypot(x, y), radius[1], atol=1e-12)
    assert np.allclose(seam.normal_main * radius[0], np.column_stack([0 * x, y, z]), atol=1e-12)
    assert np.allclose(seam.normal_branch * radius[1], np.column_stack([x, y, 0 * z]), atol=1e-12)


@given(radii)
def test_tangent_is_the_derivative(radius):
    seam = saddle_seam(*radius, 720)
    chord = np.roll(seam.points, -1, axis=0) - np.roll(seam.points, 1, axis=0)
    chord /= np.linalg.norm(chord, axis=1, keepdims=True)
    assert abs(np.sum(chord * seam.tangent, axis=1) - 1).max() < 2e-2
    assert abs(np.sum(seam.tangent * seam.bisector, axis=1)).max() < 1e-12


@given(radii, st.sampled_from([name for name, rule in POSTURES.items() if rule]))
def test_posture_turns_the_normal_up(radius, rule):
    seam = saddle_seam(*radius, 24)
    R = flat_rotations(seam, rule)
    turned = np.einsum("nij,nj->ni", R, POSTURES[rule](seam))
    assert abs(turned - [0, 0, 1]).max() < 1e-12
    assert abs(R @ R.transpose(0, 2, 1) - np.eye(3)).max() < 1e-12
    assert np.allclose(np.linalg.det(R), 1)
    # The smallest rotation turns about a horizontal axis: no part about e_z.
    assert abs(R[:, 1, 0] - R[:, 0, 1]).max() < 1e-12


def test_flat_posture_makes_the_tangent_level():
    seam = saddle_seam(0.1, 0.06, 60)
    tangent = np.einsum("nij,nj->ni", flat_rotations(seam, "bisector"), seam.tangent)
    assert abs(tangent[:, 2]).max() < 1e-12


def test_constant_posture_is_the_identity():
    assert (flat_rotations(saddle_seam(0.1, 0.06, 5), "constant") == np.eye(3)).all()


@pytest.mark.parametrize(
    ("arguments", "field"),
    [
        ((0.06, 0.06, 36), "radius_branch = 0.06"),
        ((0.06, 0.10, 36), "radius_branch = 0.1"),
        ((0.0, 0.06, 36), "radius_main = 0.0"),
        ((0.1, float("nan"), 36), "radius_branch = nan"),
        ((0.1, 0.06, 2), "count = 2"),
        ((0.1, 0.06, 7.5), "count = 7.5"),
    ],
)
def test_bad_seam(arguments, field):
    with pytest.raises(InputError, match=field):
        saddle_seam(*arguments)


def test_bad_posture():
    with pytest.raises(UnknownNameError, match="bisector, main_pipe_normal, constant"):
        flat_rotations(saddle_seam(0.1, 0.06, 5), "upright")
    with pytest.raises(InputError, match="opposite"):
        smallest_rotations(np.array([0, 0, -1.0]), np.array([0, 0, 1.0]))
