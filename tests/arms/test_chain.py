"""Chains of any axes as products about z, and models that are no chain."""

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualarm_repro import load_arm
from dualarm_repro.arms.chain import Chain, SlidingChain, chain_of
from dualarm_repro.errors import UnsupportedArmError

AXES = {
    "turn": [pin.JointModelRX, pin.JointModelRY, pin.JointModelRZ],
    "slide": [pin.JointModelPX, pin.JointModelPY, pin.JointModelPZ],
}


def drawn_pose(rng):
    return pin.SE3(pin.exp3(rng.normal(size=3)), rng.normal(size=3))


def drawn_model(seed, kinds):
    """A serial model with these kinds of joints about or along drawn axes."""
    rng, model, parent = np.random.default_rng(seed), pin.Model(), 0
    for k, kind in enumerate(kinds):
        if rng.random() < 0.5:
            made = AXES[kind][rng.integers(3)]()
        else:
            axis = rng.normal(size=3)
            axis /= np.linalg.norm(axis)
            unaligned = {
                "turn": pin.JointModelRevoluteUnaligned,
                "slide": pin.JointModelPrismaticUnaligned,
            }
            made = unaligned[kind](axis)
        parent = model.addJoint(parent, made, drawn_pose(rng), f"j{k}")
    frame = pin.Frame("tip", parent, drawn_pose(rng), pin.FrameType.OP_FRAME)
    return model, model.addFrame(frame)


def product(chain, q):
    """C_0 M(q_1) C_1 ... M(q_n) C_n in Pinocchio's own group."""
    slides = getattr(chain, "slides", np.zeros(len(q), bool))
    pose = pin.SE3(chain.rotation[0], chain.translation[0])
    for k, value in enumerate(q):
        if slides[k]:
            motion = pin.SE3(np.eye(3), np.array([0.0, 0.0, value]))
        else:
            motion = pin.SE3(pin.utils.rotate("z", value), np.zeros(3))
        pose = pose * motion * pin.SE3(chain.rotation[k + 1], chain.translation[k + 1])
    return pose


@settings(max_examples=40)
@given(
    seed=st.integers(0, 10**6),
    kinds=st.lists(st.sampled_from(["turn", "turn", "slide"]), min_size=1, max_size=7),
)
def test_the_product_of_the_chain_is_the_pose_of_the_model(seed, kinds):
    model, tip = drawn_model(seed, kinds)
    chain = chain_of("a", model, tip)
    assert isinstance(chain, SlidingChain if "slide" in kinds else Chain)
    if "slide" in kinds:
        assert chain.slides.tolist() == [kind == "slide" for kind in kinds]
    data = model.createData()
    for q in np.random.default_rng(seed).uniform(-3, 3, (3, len(kinds))):
        pin.framesForwardKinematics(model, data, q)
        np.testing.assert_allclose(product(chain, q), data.oMf[tip], atol=1e-12)


def plain(arm, quantity, q, shape):
    """Values of a quantity by numpy: compiling code for every drawn flange would take seconds."""
    known = arm._kinematics
    return getattr(known, quantity).by_numpy(q, known.constants).reshape(-1, *shape)


@pytest.mark.parametrize("name", ["irb120", "panda", "ur5"])
@settings(max_examples=10)
@given(seed=st.integers(0, 10**6))
def test_a_frame_fixed_to_the_flange_follows_it(name, seed):
    """T'(q) = T(q) X, and its point moves with v + omega x r."""
    arm, rng = load_arm(name), np.random.default_rng(seed)
    X = drawn_pose(rng)
    longer = arm.reshaped(lambda: arm.geometry, flange=("further", X))
    q = arm.random_configurations(3, rng)
    T, further = (plain(one, "pose", q, (4, 4)) for one in (arm, longer))
    np.testing.assert_allclose(further, T @ X.homogeneous, atol=1e-12)
    J, K = (plain(one, "jacobian", q, (6, arm.nq)) for one in (arm, longer))
    lever = T[:, :3, :3] @ X.translation
    moved = J[:, :3] + np.cross(J[:, 3:], lever[:, :, None], axis=1)
    np.testing.assert_allclose(K[:, :3], moved, atol=1e-12)
    np.testing.assert_allclose(K[:, 3:], J[:, 3:], atol=1e-12)
    w, v = (plain(one, "manipulability", q, (1,)) for one in (arm, longer))
    if arm.nq == 6:
        np.testing.assert_allclose(v, w, atol=1e-12)


def test_a_branching_model_and_a_flange_before_the_end_are_no_chain():
    model = pin.Model()
    first = model.addJoint(0, pin.JointModelRZ(), pin.SE3.Identity(), "a")
    last = model.addJoint(first, pin.JointModelRZ(), pin.SE3.Identity(), "b")
    kind = pin.FrameType.OP_FRAME
    early = model.addFrame(pin.Frame("early", first, pin.SE3.Identity(), kind))
    with pytest.raises(UnsupportedArmError, match="arm a: not a serial chain"):
        chain_of("a", model, early)
    end = model.addFrame(pin.Frame("end", last, pin.SE3.Identity(), kind))
    assert len(chain_of("a", model, end).rotation) == 3
    model.addJoint(first, pin.JointModelRZ(), pin.SE3.Identity(), "c")
    with pytest.raises(UnsupportedArmError, match="not a serial chain"):
        chain_of("a", model, end)


@pytest.mark.parametrize("joint", [pin.JointModelSpherical, pin.JointModelPlanar])
def test_a_joint_with_several_axes_is_no_link_of_a_chain(joint):
    model = pin.Model()
    only = model.addJoint(0, joint(), pin.SE3.Identity(), "ball")
    tip = model.addFrame(pin.Frame("t", only, pin.SE3.Identity(), pin.FrameType.OP_FRAME))
    with pytest.raises(UnsupportedArmError, match="serial chain of revolute or prismatic"):
        chain_of("a", model, tip)
