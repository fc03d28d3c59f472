"""Arguments that do not fit are refused by name, and what fits arrives unharmed."""

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
import pytest
from numpy.typing import ArrayLike

from dualarm_repro.arguments import (
    FILLED,
    INFINITE,
    MASK,
    OPEN,
    Cloud,
    Count,
    Joints,
    NonNegative,
    Number,
    Positive,
    Rows3,
    Shape,
    Vector3,
    checked,
)
from dualarm_repro.errors import InputError, UnknownNameError


class Colour(StrEnum):
    RED = "red"
    BLUE = "blue"


def taking(kind):
    """A checked function of one argument of that annotation, which it gives back."""

    def given(value):
        return value

    given.__annotations__ = {"value": kind}
    return checked(given)


@pytest.mark.parametrize(
    ("kind", "value"),
    [
        *((float, wrong) for wrong in (np.nan, np.inf, 10**400, "1", None, True, 1j, [1.0])),
        *((int, wrong) for wrong in (1.5, "1", None, True, 10**400, np.float64(1))),
        *((Positive, wrong) for wrong in (0, -1.0, -0.0)),
        *((Count, wrong) for wrong in (0, -1, 10**9)),
        *((Number, wrong) for wrong in (-1, 2.0)),
        *((bool, wrong) for wrong in ("no", 1, None)),
        *((str, wrong) for wrong in (b"x", 3, None)),
        *((Path, wrong) for wrong in ("", "\0", 3, b"x")),
        *((np.ndarray, wrong) for wrong in ([1, [2]], ["1"], [None], [1j], [np.nan], [10**400])),
        (np.ndarray, np.ma.array([1.0, 2.0], mask=[True, False])),
        (np.ndarray, np.array(["2020-01-01"], dtype="datetime64[D]")),
        (np.ndarray, [True, False]),
        (Rows3, np.zeros(3)),
        (Vector3, np.zeros(2)),
        *((Cloud, wrong) for wrong in (np.empty((0, 3)), np.zeros(3), [])),
        *((Joints, wrong) for wrong in (np.zeros((1, 6)), 0.0)),
        *((Annotated[float, INFINITE], wrong) for wrong in (np.nan, "inf", None)),
        (Annotated[np.ndarray, INFINITE], [np.inf, np.nan]),
        (Annotated[np.ndarray, FILLED], np.empty((3, 0))),
        (Annotated[np.ndarray, Shape(..., 3, 2)], np.zeros((4, 2, 3))),
        (Annotated[np.ndarray, MASK], np.zeros(3)),
        (Colour, "green"),
        (Literal["a", "b"], ["a"]),
        (Sequence[str], "abc"),
        (Collection[str], [1]),
        (Sequence[float], iter([1.0])),
        (tuple[str, int], ("a", "b")),
        (Mapping[str, float], {"a": "b"}),
        (Mapping[str, float], {1: 2.0}),
        (Callable[[float], float], 3),
        (np.random.Generator, 3),
        (float | None, "x"),
    ],
)
def test_what_does_not_fit_is_refused_on_one_line(kind, value):
    with pytest.raises(InputError) as caught:
        taking(kind)(value)
    message = str(caught.value)
    assert "\n" not in message
    assert "value" in message
    assert "expected" in message


@pytest.mark.parametrize(
    ("kind", "value"),
    [
        *((float, right) for right in (1, 0.5, np.float32(0.5), np.int64(3))),
        (Annotated[float, OPEN], np.inf),
        (Annotated[float, INFINITE], -np.inf),
        *((int, right) for right in (0, -3, np.int64(3))),
        *((bool, right) for right in (True, np.bool_(False))),
        (Collection[str], {"a", "b"}),
        (Sequence[float], np.array([1.0])),
        (float | None, None),
        (Mapping[str, ArrayLike], {"a": [1.0]}),
        (tuple[str, ...], ()),
    ],
)
def test_what_fits_is_passed_on(kind, value):
    assert taking(kind)(value) == value


def test_a_choice_arrives_as_its_member():
    assert taking(Colour)("red") is Colour.RED
    with pytest.raises(UnknownNameError, match="one of red, blue"):
        taking(Colour)("green")


@pytest.mark.parametrize(
    "given",
    [
        [[1, 2], [3, 4]],
        np.array([[1, 2], [3, 4]], dtype=np.int32),
        np.array([[1.0, 2.0], [3.0, 4.0]], dtype=np.float32),
        np.array([[1.0, 3.0], [2.0, 4.0]]).T,
        np.repeat([[1.0, 2.0], [3.0, 4.0]], 2, axis=0)[::2],
        np.array([[1.0, 2.0], [3.0, 4.0]]).view(np.recarray),
    ],
)
def test_arrays_arrive_as_one_type(given):
    """Kernels are compiled for this type; another would be compiled anew."""
    array = taking(np.ndarray)(given)
    assert type(array) is np.ndarray
    assert array.dtype == float
    assert array.flags.c_contiguous
    assert array.flags.writeable
    assert array.tolist() == [[1.0, 2.0], [3.0, 4.0]]


def test_an_array_of_this_type_is_not_copied():
    array = np.ones((2, 3))
    assert taking(Rows3)(array) is array


def test_a_letter_is_one_length_in_the_whole_call():
    @checked
    def pairs(a: Annotated[np.ndarray, Shape("N", 3)], b: Annotated[np.ndarray, Shape("N")]) -> int:
        return len(a)

    assert pairs(np.zeros((2, 3)), b=np.zeros(2)) == 2
    with pytest.raises(InputError, match=r"pairs: b \(its shape\) = \(3,\): expected .* \(N,\)"):
        pairs(np.zeros((2, 3)), b=np.zeros(3))


def test_what_is_known_of_a_letter_is_said():
    @checked
    def fitted(
        a: Annotated[np.ndarray, Shape("N", "K")], b: Annotated[np.ndarray, Shape("K", "M", 2)]
    ) -> None:
        """Takes two arrays."""

    line = r"b \(its shape\) = \(2, 7, 3\): expected finite numbers \(K, M, 2\), K = 4"
    with pytest.raises(InputError, match=f"{line}$"):
        fitted(np.zeros((3, 4)), np.zeros((2, 7, 3)))


def test_one_of_two_shapes_leaves_no_letter_behind():
    @checked
    def either(
        a: Annotated[np.ndarray, Shape("N", 3)] | Annotated[np.ndarray, Shape("N")],
        b: Annotated[np.ndarray, Shape("N")],
    ) -> int:
        return len(b)

    assert either(np.zeros(4), np.zeros(4)) == either(np.zeros((4, 3)), np.zeros(4)) == 4


def test_infinite_bounds_arrive():
    bounds = np.array([-np.inf, 0.0, np.inf])
    assert taking(Annotated[np.ndarray, INFINITE])(bounds) is bounds


@pytest.mark.parametrize("zero", [-0.0, np.float64(-0.0)])
def test_no_width_is_minus_zero(zero):
    assert str(taking(NonNegative)(zero)) == "0.0"


def test_a_class_checks_what_it_is_made_of():
    @checked
    @dataclass(frozen=True)
    class Rod:
        length: Positive
        name: str = "rod"

    assert Rod(2.0).length == 2.0
    with pytest.raises(InputError, match="Rod: length = -1: expected a finite number, above 0"):
        Rod(-1)
    with pytest.raises(InputError, match="Rod: name = 3: expected text"):
        Rod(1.0, name=3)


def test_keyword_arguments_of_any_name_are_checked():
    @checked
    def total(**parts: float) -> float:
        return sum(parts.values())

    assert total(a=1.0, b=2) == 3.0
    with pytest.raises(InputError, match="total: b = 'x'"):
        total(a=1.0, b="x")
