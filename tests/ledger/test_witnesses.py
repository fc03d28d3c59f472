"""Witnesses of open statements, and numbers read from print by name."""

import numpy as np
import pytest

from dualarm_repro.ledger import REGISTRY
from dualarm_repro.ledger.printed import replaced
from dualarm_repro.ledger.printed_values import PrintedValue, printed_numbers
from dualarm_repro.ledger.witnesses import one_for_each_side
from dualarm_repro.papers import load


class Inputs:
    radius = PrintedValue("qiu.claim_obstacles", "radius")
    centres = PrintedValue("qiu.claim_obstacles", "centres")


def test_the_first_case_of_each_side_is_the_witness():
    cases = [("a", False, {"x": 1}), ("b", False, {"x": 2}), ("c", True, {"x": 3})]
    found = one_for_each_side(cases)
    assert [(w["choice"], w["verdict"], w["values"]) for w in found] == [
        ("c", "holds", {"x": 3}),
        ("a", "fails", {"x": 1}),
    ]
    assert [w["choice"] for w in one_for_each_side(cases[:2])] == ["a"]
    assert one_for_each_side([]) == []


def test_a_printed_value_follows_print():
    load()
    item, read = "qiu.claim_obstacles", Inputs()
    assert isinstance(read.radius, float)
    assert read.centres.shape == (2, 3)
    printed = replaced(REGISTRY.printed(item), ("radius",), "0.25")
    with REGISTRY.with_printed(item, printed):
        assert read.radius == 0.25


def test_several_keys_are_rows():
    load()
    rows = printed_numbers("qiu.claim_bases", "master", "slave")
    assert rows.shape == (2, 3)
    assert rows[0] == pytest.approx(printed_numbers("qiu.claim_bases", "master"))
    assert not np.allclose(*rows)
