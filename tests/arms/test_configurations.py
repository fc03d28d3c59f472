"""Configurations: what an arm takes, draws and refuses."""

import pickle

import numpy as np
import pytest
from numpy.testing import assert_allclose

from dualarm_repro import load_arm
from dualarm_repro.arms import arm_names
from dualarm_repro.errors import ConfigurationError, UnsupportedArmError

METHODS = ["fk", "jacobian", "manipulability", "positions", "joint_positions", "within_limits"]


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize(
    ("q", "said"),
    [
        ([0.0] * 5, "shape of q = (5,): expected 6 finite"),
        (np.zeros((3, 7)), "shape of q = (3, 7): expected 6 finite"),
        (np.zeros((2, 2, 6)), "shape of q = (2, 2, 6): expected 6 finite"),
        (0.0, "shape of q = (): expected 6 finite"),
        ([0.0, 0.0, np.nan, 0.0, 0.0, 0.0], "q = nan: expected 6 finite"),
        ([[0.0] * 6, [0.0] * 5 + [-np.inf]], "q = -inf: expected 6 finite"),
        ("abcdef", "q = 'abcdef': expected 6 finite"),
        ([[0.0] * 6, [0.0] * 5], "expected 6 finite"),
    ],
)
def test_wrong_configurations(method, q, said):
    with pytest.raises(ConfigurationError) as caught:
        getattr(load_arm("irb120"), method)(q)
    assert str(caught.value).startswith("arm irb120: ")
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("name", arm_names())
def test_every_arm(name):
    arm = load_arm(name)
    q = arm.random_configurations(300, np.random.default_rng(1))
    assert q.shape == (300, arm.nq)
    assert arm.model.nq == arm.model.nv == arm.nq
    assert arm.within_limits(q).all()
    assert_allclose(q, arm.random_configurations(300, np.random.default_rng(1)), atol=0)
    spread = (q.max(axis=0) - q.min(axis=0)) / np.subtract(*arm.usual_range[::-1])
    assert (spread > 0.9).all()
    assert (arm.velocity_limit > 0).all()
    lower, upper = arm.limits()
    assert np.isinf(lower[arm.turns_for_ever]).all()
    beyond = np.vstack([lower - 1e-6, upper + 1e-6])
    beyond[:, arm.turns_for_ever] = 99.0
    assert arm.within_limits(beyond).tolist() == [False, False]
    assert arm.within_limits(beyond, tolerance=1e-5).all()
    assert name in repr(arm)
    copy = pickle.loads(pickle.dumps(arm))
    assert_allclose(copy.fk(q), arm.fk(q), atol=0)
    assert_allclose(copy.fk(q[0]), arm.fk(q[0]), atol=0)


@pytest.mark.parametrize("method", ["symbolic_fk", "link_transforms", "mirrored"])
def test_exact_methods_need_a_table(method):
    with pytest.raises(UnsupportedArmError, match="panda"):
        getattr(load_arm("panda"), method)()
