"""Keys of the ledger in words."""

import pytest

from dualarm_repro.view.names import phrase


@pytest.mark.parametrize(
    ("key", "told"),
    [
        ("theta_1", "θ₁"), ("theta12", "theta12"), ("omega_max", "ω_max"), ("lambda", "λ"),
        ("d_0", "d_0"), ("d_max", "d max"), ("joint_3", "joint 3"), ("joint3", "joint 3"),
        ("mean_joint_speed", "mean joint speed"), ("subject_to", "subject to"),
        ("q", "joint angles"), ("q_12", "q_12"), ("X_dot", "X_dot"), ("plain", "plain"),
    ],
)  # fmt: skip
def test_a_key_in_words(key, told):
    assert phrase(key) == told


@pytest.mark.parametrize("key", ["mean_time", "tool_point_of_arm", "beta_2"])
def test_no_underscore_is_left_of_words(key):
    assert "_" not in phrase(key)
