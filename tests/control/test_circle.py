"""Circles as tip paths: their geometry, both time laws, and what is refused."""

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualarm_repro.control.circle import Circles, TimeLaw
from dualarm_repro.errors import InputError

PLANE = {"centre": [[1.0, 2.0, 3.0]], "u": [[0.2, 0.0, 0.0]], "v": [[0.0, 0.2, 0.0]]}


@pytest.fixture(scope="module", params=list(TimeLaw))
def circles(request):
    rng = np.random.default_rng(3)
    tips, normals = rng.normal(size=(2, 3)), rng.normal(size=(2, 3))
    return Circles.through(tips, normals, [0.3, 2.0], 0.15, duration=4.0, law=request.param)


@pytest.mark.parametrize(
    ("law", "t", "position", "velocity"),
    [
        # A quarter of the turn after a quarter of the time, as fast as ever.
        ("constant_speed", 1.0, [1.0, 2.2, 3.0], [-0.1 * np.pi, 0.0, 0.0]),
        # Half the turn after half the time, at twice the mean speed pi/2 R.
        ("rest_to_rest", 2.0, [0.8, 2.0, 3.0], [0.0, -0.2 * np.pi**2 / 4.0, 0.0]),
        ("rest_to_rest", 4.0, [1.2, 2.0, 3.0], [0.0, 0.0, 0.0]),
    ],
)
def test_places_and_speeds_worked_out_by_hand(law, t, position, velocity):
    found = Circles(**PLANE, duration=4.0, law=law).at(t)
    np.testing.assert_allclose(found[0], [position], atol=1e-12)
    np.testing.assert_allclose(found[1], [velocity], atol=1e-12)


@settings(max_examples=30)
@given(t=st.floats(-20.0, 20.0))
def test_the_tips_stay_on_their_circles_and_move_along_them(circles, t):
    position, velocity = circles.at(t)
    radial = position - circles.centre
    np.testing.assert_allclose(np.linalg.norm(radial, axis=1), 0.15, atol=1e-12)
    normal = np.cross(circles.u, circles.v) / 0.15**2
    np.testing.assert_allclose((radial * normal).sum(axis=1), 0.0, atol=1e-12)
    np.testing.assert_allclose((velocity * normal).sum(axis=1), 0.0, atol=1e-12)
    np.testing.assert_allclose((velocity * radial).sum(axis=1), 0.0, atol=1e-12)
    forward = (np.cross(radial, velocity) * normal).sum(axis=1)
    assert (forward >= -1e-12).all(), "never back"


def test_three_quarters_of_the_time_into_a_rest_to_rest_turn():
    """s = pi (1 + sqrt(1/2)), as fast as after one quarter."""
    position, velocity = Circles(**PLANE, duration=4.0).at(3.0)
    s, rate = np.pi * (1.0 + np.sqrt(0.5)), np.pi**2 / 4.0 * np.sqrt(0.5)
    np.testing.assert_allclose(
        position, [[1.0 + 0.2 * np.cos(s), 2.0 + 0.2 * np.sin(s), 3.0]], atol=1e-12
    )
    found = 0.2 * rate * np.array([[-np.sin(s), np.cos(s), 0.0]])
    np.testing.assert_allclose(velocity, found, atol=1e-12)


@pytest.mark.parametrize("turn", [-3, 1, 7])
def test_a_path_repeats_every_duration(circles, turn):
    for once, again in zip(circles.at(1.3), circles.at(1.3 + turn * 4.0), strict=True):
        np.testing.assert_allclose(again, once, atol=1e-9)


def test_one_turn_is_as_long_as_the_circle(circles):
    times = np.linspace(0.0, 4.0, 4001)
    speeds = np.array([np.linalg.norm(circles.at(t)[1], axis=1) for t in times])
    length = np.trapezoid(speeds, times, axis=0)
    np.testing.assert_allclose(length, 2 * np.pi * 0.15, rtol=1e-6)
    if circles.law is TimeLaw.CONSTANT_SPEED:
        assert np.ptp(speeds) < 1e-12
    else:
        assert speeds[0].max() < 1e-12
        assert speeds.max(axis=0) == pytest.approx(np.pi / 2 * length / 4.0)


def test_circles_lie_normal_to_the_normals_whatever_their_length():
    tips, normals = np.zeros((3, 3)), np.array([[0, 0, 2.0], [0, -0.5, 0], [1.0, 1.0, 1.0]])
    made = Circles.through(tips, normals, np.zeros(3), 0.1)
    unit = normals / np.linalg.norm(normals, axis=1, keepdims=True)
    # Right-handed about the normal: u, v and n in this order.
    np.testing.assert_allclose(np.cross(made.u, made.v), 0.01 * unit, atol=1e-15)
    np.testing.assert_allclose(made.centre, -made.u, atol=1e-15)


@settings(max_examples=20)
@given(angle=st.floats(-7.0, 7.0))
def test_the_angle_turns_the_centre_about_the_tip(angle):
    normal = np.array([[0.3, -0.4, 0.8]])
    plain, turned = (Circles.through(np.zeros((1, 3)), normal, [a], 0.2) for a in (0.0, angle))
    axis = normal[0] / np.linalg.norm(normal)
    rotation = pin.exp3(angle * axis)
    np.testing.assert_allclose(turned.centre[0], rotation @ plain.centre[0], atol=1e-12)
    np.testing.assert_allclose(turned.v[0], rotation @ plain.v[0], atol=1e-12)


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        ((np.zeros((2, 2)), np.eye(3)[:2], [0, 0], 0.1), "tips"),
        ((np.zeros((2, 3)), np.eye(3)[:2], [0], 0.1), "angles"),
        ((np.zeros((1, 3)), np.eye(3)[:1], [0], 0.0), "radius = 0.0: expected"),
    ],
)
def test_paths_through_nonsense_are_refused(arguments, text):
    with pytest.raises(InputError, match=text):
        Circles.through(*arguments)


@pytest.mark.parametrize("t", [np.nan, np.inf, "soon"])
def test_a_time_is_a_number(t):
    with pytest.raises(InputError, match=r"Circles\.at: t = "):
        Circles(**PLANE).at(t)
