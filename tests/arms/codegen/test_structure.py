"""Which constants of a chain are folded, and that chains of one structure share their code."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualarm_repro import load_arm
from dualarm_repro.arms.chain import Chain
from dualarm_repro.arms.codegen.generated import TINY, generated
from dualarm_repro.arms.codegen.program import ONE, ZERO, Term
from dualarm_repro.arms.codegen.structure import ROUNDING, Constants, structure_of


@pytest.mark.parametrize(
    ("value", "scale", "unit", "term"),
    [
        (0.0, 1.0, True, ZERO),
        (0.9 * ROUNDING, 1.0, True, ZERO),
        (-1e-14, 100.0, False, ZERO),
        (1.0, 1.0, True, ONE),
        (-1.0 + 0.5 * ROUNDING, 1.0, True, -ONE),
        (1.0, 1.0, False, Term(1, "k0")),  # a length of one metre is no pattern
        (2 * ROUNDING, 1.0, True, Term(1, "k0")),
        (-0.5, 1.0, True, Term(1, "k0")),
    ],
)
def test_what_is_round_off_or_a_unit_has_no_name(value, scale, unit, term):
    named = Constants()
    assert named.term(value, scale, unit) == term
    assert named.values == ([value] if term.name else [])


def test_constants_are_numbered_as_they_come():
    named = Constants()
    assert named.vector([0.3, 0.0, -0.4], 1.0) == (Term(1, "k0"), ZERO, Term(1, "k1"))
    assert named.values == [0.3, -0.4]


def chain(lengths):
    turn = np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0.0]])
    rotations = np.array([np.eye(3), turn, np.eye(3)])
    return Chain(rotations, np.array([[0, 0, lengths[0]], [lengths[1], 0, 0], [0, 0, lengths[2]]]))


@settings(max_examples=20)
@given(a=st.lists(st.floats(0.1, 2.0), min_size=3, max_size=3))
def test_chains_that_differ_in_lengths_share_a_structure_and_its_values(a):
    known, other = Constants(), Constants()
    structure = structure_of(chain([1.0, 1.0, 1.0]), known)
    assert structure_of(chain(a), other) == structure
    assert other.values == a
    assert structure.joints == 2
    assert structure.slides == (False, False)
    # By hand: a turn about z, then one about -y of the first link.
    q = np.array([[0.4, -0.9]])
    c, s = np.cos(q[0, 0]), np.sin(q[0, 0])
    radius = a[1] + a[2] * 0.0
    x, y = c * radius + s * a[2], s * radius - c * a[2]
    found = generated("position", structure).by_numpy(q, np.array(other.values))[0]
    np.testing.assert_allclose(found, [x, y, a[0]], atol=1e-12)


def test_a_length_that_vanishes_is_another_structure():
    first, second = (structure_of(chain([1.0, b, 1.0]), Constants()) for b in (0.5, 0.0))
    assert first != second
    codes = [generated("pose", one) for one in (first, second)]
    assert codes[0] is not codes[1]
    assert codes[0] is generated("pose", first)


def test_the_plain_function_says_what_it_reads():
    structure = structure_of(chain([1.0, 0.5, 0.7]), Constants())
    source = generated("position", structure).source
    assert source.startswith("def position(s, c, d, k):")
    assert "s1, c1 = s[0], c[0]" in source
    assert "d1" not in source
    # The flange lies on the last axis: its turn moves nothing.
    assert "s2" not in source


def test_reciprocals_of_next_to_nothing_are_nothing():
    """At a singular posture the measure is zero, not infinite or NaN."""
    arm = load_arm("irb120")
    q = np.zeros((3, 6))
    w = arm.manipulability(q)
    assert np.isfinite(w).all()
    np.testing.assert_allclose(w, 0.0, atol=1e-12)
    named = Constants()
    code = generated("manipulability", structure_of(arm.chain, named))
    plain = code.function({"sqrt": np.sqrt, "reciprocal": lambda x: 1.0 / x if x > TINY else 0.0})
    (found,) = plain([0.0] * 6, [1.0] * 6, [0.0] * 6, named.values)
    assert found == pytest.approx(0.0, abs=1e-12)
