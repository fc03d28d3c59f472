"""Names of capsules, shapes and links, and how evidence is told."""

import pytest

from dualarm_repro.arms.exclusions import (
    Evidence,
    Exclusion,
    Neighbours,
    link_of,
    listed,
    shape_of,
)


@pytest.mark.parametrize(
    ("capsule", "shape", "link"),
    [
        ("forearm_0", "forearm_0", "forearm"),
        ("forearm_0.3", "forearm_0", "forearm"),
        ("link_2_1", "link_2_1", "link_2"),
        ("link_2_1.12", "link_2_1", "link_2"),
        ("v1.0_base_4", "v1.0_base_4", "v1.0_base"),
        ("plain", "plain", "plain"),
    ],
)
def test_names(capsule, shape, link):
    assert shape_of(capsule) == shape
    assert link_of(capsule) == link


def test_lines_name_the_pair_the_evidence_and_the_counts():
    one = Exclusion("a_0", "b_0", Evidence.HOME, 90, 100, 95)
    other = Exclusion("a_0.1", "c_0", Evidence.NEVER, 0, 100, 7)
    assert str(one) == ("a_0 - b_0: home, shapes touch in 90 and capsules in 95 of 100 postures")
    assert listed([one, other]).split("\n") == [str(one), str(other)]
    assert listed([]) == ""
    told = str(Neighbours("a_0", "b_0", 12, 181))
    assert told.startswith("a_0 - b_0: adjacent and watched")
    assert told.endswith("in touch for 12 of 181 values of their joint")
