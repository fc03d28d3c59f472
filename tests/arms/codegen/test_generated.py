"""Generated kinematics: compiled code, numpy, matrix products and symbols agree."""

import os
import subprocess
import sys

import numpy as np
import pinocchio as pin
import pytest
from example_robot_data import getModelPath
from hypothesis import given, settings
from hypothesis import strategies as st
from long_tests import long_where
from numpy.testing import assert_allclose, assert_array_equal

from dualarm_repro import load_arm
from dualarm_repro.arms.chain import SlidingChain
from dualarm_repro.arms.codegen import generated as generated_code
from dualarm_repro.arms.codegen.generated import LARGE, Generated, generated
from dualarm_repro.arms.codegen.program import Program, Term
from dualarm_repro.arms.codegen.simd import WIDTH
from dualarm_repro.arms.codegen.structure import Constants, structure_of
from dualarm_repro.arms.kernels import Kinematics
from dualarm_repro.arms.trigonometry import FAR
from dualarm_repro.errors import ConfigurationError
from dualarm_repro.kernel import COMPILES
from dualarm_repro.scene.posing import cores_in, frames_of, links_of

from ..urdf.texts import joint, link, write

QUANTITIES = {"pose": 16, "position": 3, "origins": 0, "jacobian": 0, "manipulability": 1}
ANGLES = st.sampled_from([0.0, np.pi / 2, -np.pi / 2, np.pi]) | st.floats(-3, 3)
LENGTHS = st.sampled_from([0.0, 0.3, -0.2]) | st.floats(-1, 1)


@st.composite
def chains(draw):
    """Chains of 1 to 7 joints with right angles and zero lengths among the others."""
    n = draw(st.integers(1, 7))
    angles = draw(st.lists(st.tuples(ANGLES, ANGLES, ANGLES), min_size=n + 1, max_size=n + 1))
    lengths = draw(st.lists(st.tuples(*[LENGTHS] * 3), min_size=n + 1, max_size=n + 1))
    slides = draw(st.lists(st.sampled_from([False, False, True]), min_size=n, max_size=n))
    rotations = np.array([pin.rpy.rpyToMatrix(*map(float, one)) for one in angles])
    return SlidingChain(rotations, np.array(lengths), np.array(slides))


def by_products(chain, q):
    """Frames of the joints after their motion and the flange, by matrix products."""
    frames, at = [], np.eye(4)
    for k, (R, t) in enumerate(zip(chain.rotation, chain.translation, strict=True)):
        step, motion = np.eye(4), np.eye(4)
        step[:3, :3], step[:3, 3] = R, t
        if k < len(q) and chain.slides[k]:
            motion[2, 3] = q[k]
        elif k < len(q):
            motion[:2, :2] = [[np.cos(q[k]), -np.sin(q[k])], [np.sin(q[k]), np.cos(q[k])]]
        at = at @ step @ motion
        frames.append(at)
    return np.array(frames)


def plain(quantity, chain, q, carried=()):
    """Values of one configuration by the plain function."""
    named = Constants()
    structure = structure_of(chain, named)
    code = generated(quantity, structure, carried)
    return code.by_numpy(np.array([q]), np.array(named.values))[0]


@settings(deadline=None, max_examples=60)
@given(chains(), st.integers(0, 2**32 - 1))
def test_the_plain_functions_are_the_matrix_products(chain, seed):
    q = np.random.default_rng(seed).uniform(-3, 3, len(chain.slides))
    frames = by_products(chain, q)
    flange, origins, axes = frames[-1], frames[:, :3, 3], frames[:-1, :3, 2]
    turning = np.cross(axes, flange[:3, 3] - origins[:-1])
    slides = chain.slides[:, np.newaxis]
    J = np.hstack([np.where(slides, axes, turning), np.where(slides, 0.0, axes)]).T
    assert_allclose(plain("pose", chain, q), flange.ravel(), atol=1e-12)
    assert_allclose(plain("position", chain, q), flange[:3, 3], atol=1e-12)
    assert_allclose(plain("origins", chain, q), origins.ravel(), atol=1e-12)
    assert_allclose(plain("jacobian", chain, q), J.ravel(), atol=1e-12)
    w = np.prod(np.linalg.svd(J, compute_uv=False)) if len(q) >= 6 else 0.0
    # Round-off of a product of six singular values, three of them lengths.
    assert_allclose(plain("manipulability", chain, q), [w], atol=1e-12 * (1 + abs(J).max()) ** 3)


def sliding_arm(folder, count):
    """So many of seven joints with skew axes, two of which slide."""
    names = [f"l{k}" for k in range(count + 1)]
    kinds = ["revolute", "prismatic", "revolute", "prismatic", *["revolute"] * 3][:count]
    axes = ["0 0 1", "0 0.6 0.8", "0 1 0", "1 0 0", "0 1 0", "1 0 0", "0 0 1"][:count]
    limit = "<limit lower='-0.3' upper='0.4' effort='1' velocity='1'/>"
    joints = [
        joint(f"j{k}", names[k], names[k + 1], kind, axis, *([limit] if "p" in kind else []))
        for k, (kind, axis) in enumerate(zip(kinds, axes, strict=True))
    ]
    return load_arm(write(folder, *map(link, names), *joints), shapes="enclosing")


XARM, SLIDE = "xarm_description/urdf/xarm7.urdf", "seven joints that turn or slide"
#: Whose code takes the compiler up to half a minute.
DEAR = {XARM, SLIDE}


@pytest.fixture(params=long_where(DEAR.__contains__, ["irb120", "panda", "slide", *sorted(DEAR)]))
def arm(request, tmp_path):
    """6R of a table, 7R, 7R of a URDF, and two with joints that slide."""
    if request.param in ("slide", SLIDE):
        return sliding_arm(tmp_path, 4 if request.param == "slide" else 7)
    urdf = request.param.endswith(".urdf")
    return load_arm(f"{getModelPath(request.param)}/{request.param}" if urdf else request.param)


def test_compiled_code_and_numpy_agree(arm, rng):
    q = arm.random_configurations(77, rng)
    named = Constants()
    structure = structure_of(arm.motion, named)
    links = links_of(arm)
    carried = tuple(
        (int(j), named.vector(point, 1.0))
        for j, ends in zip(links.joint, links.local, strict=True)
        for point in ends
    )
    for quantity in (*QUANTITIES, "points"):
        code = generated(quantity, structure, carried if quantity == "points" else ())
        k = np.array(named.values)
        compiled = code.rows(q, k, (code.size,))
        assert_allclose(compiled, code.by_numpy(q, k), rtol=0, atol=1e-12)
        alone = [code.rows(row[np.newaxis], k, (code.size,))[0] for row in q]
        assert_array_equal(compiled, alone, "one configuration is computed as in a block")


def test_ends_of_capsules(arm, rng):
    q, links = arm.random_configurations(40, rng), links_of(arm)
    expected = cores_in(frames_of(arm, np.eye(3, 4), q), links.joint, links.local)
    found = Kinematics(arm.motion).points(q, np.repeat(links.joint, 2), links.local.reshape(-1, 3))
    assert_allclose(found.reshape(expected.shape), expected, rtol=0, atol=1e-12)


def test_what_one_call_refuses():
    arm = load_arm("irb120")
    arm.fk(np.zeros(6)), arm.jacobian(np.zeros(6)), arm.manipulability(np.zeros(6))
    for call in (arm.fk, arm.jacobian, arm.manipulability):
        for wrong in (np.full(6, np.nan), np.array([0, 0, np.inf, 0, 0, 0]), np.zeros(5),
                      np.zeros(12), np.zeros(0)):  # fmt: skip
            with pytest.raises(ConfigurationError, match="arm irb120"):
                call(wrong)
        frozen = np.ones(6)
        frozen.flags.writeable = False
        assert_array_equal(call(frozen), call(np.ones(6)))
        assert_array_equal(call(np.ones(12)[::2]), call(np.ones(6)))
        assert_array_equal(call(np.ones(6, dtype=int)), call(np.ones(6)))


@pytest.mark.parametrize("count", [1, 15, 16, 100])
def test_past_the_cache_the_same_is_written(count, rng, monkeypatch):
    arm = load_arm("irb120")
    q = arm.random_configurations(count, rng)
    q[0, 0] = 2 * FAR  # [rad], for the plain function
    expected = arm.fk(q)
    monkeypatch.setattr(generated_code, "LARGE", 1)
    monkeypatch.setattr(arm._kinematics.pose, "compiled", None)
    found = arm.fk(q)
    assert_array_equal(found, expected)
    assert found.flags.writeable
    assert found.flags.c_contiguous


def test_only_large_matrices_of_whole_lines_go_past_the_cache(monkeypatch):
    q = np.zeros((LARGE // 16, 6))
    kinematics = load_arm("irb120")._kinematics
    monkeypatch.setattr(kinematics.pose, "streamed", None)
    monkeypatch.setattr(kinematics.jacobian, "streamed", None)
    assert len(kinematics.pose.rows(q[1:], kinematics.constants, (4, 4))) == len(q) - 1
    assert len(kinematics.jacobian.rows(q, kinematics.constants, (6, 6))) == len(q)
    with pytest.raises(TypeError):
        kinematics.pose.rows(q, kinematics.constants, (4, 4))


@pytest.mark.skipif(not COMPILES, reason="numba is switched off")
def test_instructions_go_past_the_cache_only_where_they_should(monkeypatch):
    monkeypatch.setenv("DUALARM_CACHE", "off")  # what comes from there has no text
    monkeypatch.delenv("NUMBA_CACHE_DIR", raising=False)
    code, q = load_arm("irb120")._kinematics.pose, np.zeros(6)
    for streamed in (False, True):
        loop = code._loop(streamed)
        loop(q, np.array(load_arm("irb120")._kinematics.constants), np.empty((4, 4)))
        [text] = loop.inspect_llvm().values()
        assert ("!nontemporal" in text, "fence seq_cst" in text) == (streamed, streamed)


def test_room_begins_with_a_line():
    for size in (1, 100, 10**6):
        room = generated_code._from_a_line_on(size)
        assert (room.size, room.ctypes.data % (8 * WIDTH)) == (size, 0)


def test_programs_of_one_loop_have_names_of_their_own():
    """The text of the loop does not hold the program."""
    names = set()
    for second in ("s1", "c1"):
        program = Program()
        result = program.plus(Term(1, "s1"), program.times(Term(1, "c1"), Term(1, second)))
        structure = structure_of(load_arm("irb120").motion, Constants())
        names.add(Generated("pose", structure, program, [result]).compiled.__name__)
    assert len(names) == 2


def test_arms_that_differ_in_lengths_share_their_code():
    arm, other = load_arm("er16"), load_arm("irb2400")
    assert arm._kinematics.pose is other._kinematics.pose
    assert arm._kinematics.pose is not load_arm("irb120")._kinematics.pose


WITHOUT = """
import numpy as np
from dualarm_repro import load_arm
arm = load_arm("irb120")
q = np.linspace(-1, 1, 12).reshape(2, 6)
print(repr([*arm.fk(q).ravel(), *arm.fk(q[0]).ravel(), *arm.jacobian(q).ravel(),
            *arm.manipulability(q), arm.manipulability(q[1]), *arm.positions(q).ravel(),
            *np.nan_to_num(arm.ik_branches(arm.fk(q[[0, 1, 1]]))).ravel()]))
"""


def test_without_a_compiler():
    def values(**more):
        environment = {**os.environ, **more}
        done = subprocess.run([sys.executable, "-c", WITHOUT], env=environment,
                              capture_output=True, text=True, check=True)  # fmt: skip
        return np.array(eval(done.stdout, {"np": np, "array": np.array}))

    assert_allclose(values(NUMBA_DISABLE_JIT="1"), values(), rtol=0, atol=1e-12)
