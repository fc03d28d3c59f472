"""The branch-free sine, cosine and arctangent against the C library."""

import numpy as np
import pytest
from numba import njit
from numpy.testing import assert_allclose

from dualarm_repro.arms.trigonometry import arctan2, sincos


@njit
def sines(x):
    out = np.empty((2, x.size))
    for k in range(x.size):
        out[0, k], out[1, k] = sincos(x[k])
    return out


@njit
def angles(y, x):
    out = np.empty(x.size)
    for k in range(x.size):
        out[k] = arctan2(y[k], x[k])
    return out


@pytest.mark.parametrize("span", [1.0, 10.0, 1e3, 1e6])
def test_sine_and_cosine(span, rng):
    x = np.concatenate([rng.uniform(-span, span, 20_000), np.arange(-40, 41) * np.pi / 8])
    assert_allclose(sines(x), [np.sin(x), np.cos(x)], atol=3e-16)


def test_arctangent(rng):
    x, y = rng.standard_normal((2, 20_000)) * 10.0 ** rng.uniform(-9, 9, (2, 20_000))
    assert_allclose(angles(y, x), np.arctan2(y, x), rtol=5e-16, atol=5e-16)
    turn = np.arange(-8, 8) * np.pi / 8
    assert_allclose(angles(np.sin(turn), np.cos(turn)), np.arctan2(np.sin(turn), np.cos(turn)))


def test_signs_of_zero():
    y, x = np.array([0.0, -0.0, 0.0, -0.0]), np.array([-1.0, -1.0, 0.0, 1.0])
    assert_allclose(angles(y, x), [np.pi, np.pi, 0.0, 0.0], atol=0)
