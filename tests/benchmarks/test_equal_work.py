"""Work is compared before it is timed."""

import numpy as np
import pytest
from equal_work import DifferentWork, holds, reference, same


def test_equal_answers_pass_and_say_how_closely():
    assert same(lambda: [1.0, 2.0], lambda: [1.0, 2.0 + 1e-12], 1e-9)() == "equal to 1e-09"


@pytest.mark.parametrize(
    ("theirs", "says"),
    [
        ([1.0, 2.1], "differs by 0.1"),
        ([1.0], "shapes"),
        ([1.0, np.nan], "not finite"),
        ([1.0, np.inf], "not finite"),
    ],
)
def test_other_answers_are_refused(theirs, says):
    with pytest.raises(DifferentWork, match=says):
        same(lambda: [1.0, 2.0], lambda: theirs, 1e-2)()


def test_a_condition():
    assert holds("free", lambda: True)() == "free"
    with pytest.raises(DifferentWork, match="not free"):
        holds("free", lambda: False)()
    assert reference()() == "the reference"
