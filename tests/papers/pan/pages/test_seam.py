"""Equation (17) and Figs 5-8 of `pan`: pipes cut by hand, and the flat position by its words."""

import numpy as np
import pytest

from dualarm_repro.ledger import Verdict, evaluate
from dualarm_repro.papers.pan.pages.cell import seam as page
from dualarm_repro.papers.pan.reading import FlatSeam, SeamModel
from dualarm_repro.welding.motion import periodic_derivative

RADII = [(0.10, 0.06), (0.20, 0.03), (0.08, 0.075)]


def curve(main, branch, count):
    """The cut of two pipes: x = b cos t, y = b sin t, z = sqrt(a^2 - y^2)."""
    theta = 2 * np.pi * np.arange(count) / count
    x, y = branch * np.cos(theta), branch * np.sin(theta)
    return theta, np.column_stack([x, y, np.sqrt(main**2 - y**2)])


def normals(points, branch):
    """Outward normals of the main pipe along x and of the branch along z."""
    main = points * [0, 1, 1]
    side = points * [1, 1, 0] / branch
    return main / np.linalg.norm(main, axis=1, keepdims=True), side


@pytest.mark.parametrize(("main", "branch"), RADII)
@pytest.mark.parametrize("count", [20, 72])
def test_seam_is_the_cut_of_two_pipes(main, branch, count):
    model = SeamModel(main, branch, count)
    theta, points = curve(main, branch, count)
    np.testing.assert_allclose(model.seam.theta, theta, atol=1e-14)
    np.testing.assert_allclose(model.seam.points, points, atol=1e-15)
    assert page._residual(model) < 1e-15
    highest, lowest = main, np.sqrt(main**2 - branch**2)
    assert np.ptp(model.seam.points[:, 2]) == pytest.approx(highest - lowest, rel=1e-9)


def test_a_seam_off_either_pipe_is_measured():
    model = SeamModel(0.1, 0.06, 18)
    for other in (SeamModel(0.11, 0.06, 18), SeamModel(0.1, 0.05, 18)):
        wrong = type("Wrong", (), {"seam": model.seam, "radius_main": other.radius_main,
                                   "radius_branch": other.radius_branch})  # fmt: skip
        assert page._residual(wrong) == pytest.approx(0.01, abs=1e-12)


@pytest.mark.parametrize(("main", "branch"), RADII)
def test_bisector_of_both_normals_is_turned_upright(main, branch):
    flat = FlatSeam(main, branch, 36, "bisector")
    _, points = curve(main, branch, 36)
    bisector = np.sum(normals(points, branch), axis=0)
    upright = np.einsum("nij,nj->ni", flat.rotations, bisector)
    np.testing.assert_allclose(upright[:, :2], 0.0, atol=1e-12)
    assert (upright[:, 2] > 0).all()
    # by the smallest rotation, whose axis is level: R has no part about the vertical
    skew = flat.rotations - flat.rotations.transpose(0, 2, 1)
    np.testing.assert_allclose(skew[:, 1, 0], 0.0, atol=1e-12)


def test_normal_of_the_main_pipe_is_turned_upright_if_that_is_the_posture():
    flat = FlatSeam(0.1, 0.06, 36, "main_pipe_normal")
    main, _ = normals(curve(0.1, 0.06, 36)[1], 0.06)
    np.testing.assert_allclose(
        np.einsum("nij,nj->ni", flat.rotations, main), np.tile([0, 0, 1.0], (36, 1)), atol=1e-12
    )


def test_constant_posture_turns_nothing():
    still = FlatSeam(0.1, 0.06, 36, "constant").rotations
    np.testing.assert_allclose(still, np.tile(still[0], (36, 1, 1)), atol=1e-15)


def test_largest_turn_of_the_workpiece_by_hand(stored):
    """At theta = 0 the normals are z and x, at theta = 90 deg they have the angle acos(b / a)."""
    ends = []
    for theta in (0.0, np.pi / 2):
        y = 0.06 * np.sin(theta)
        main = np.array([0.0, y, np.sqrt(0.01 - y**2)]) / 0.1
        side = np.array([np.cos(theta), np.sin(theta), 0.0])
        bisector = main + side
        ends.append(np.degrees(np.arccos(bisector[2] / np.linalg.norm(bisector))))
    # acos(1 / sqrt 2), and the half of acos(b / a) nearer to the level
    assert ends[0] == pytest.approx(45.0)
    assert stored["eq03"]["turn"] == pytest.approx(max(ends), abs=1e-9)


def test_extents_of_the_figures_by_hand(stored):
    assert stored["fig06"]["extent"] == pytest.approx([0.12, 0.12, 0.1 - 0.08], abs=1e-12)
    assert stored["eq17"]["height"] == pytest.approx(0.02, abs=1e-12)
    flat, (_, points) = FlatSeam(0.1, 0.06, 72, "bisector"), curve(0.1, 0.06, 72)
    welded = np.stack([R @ p for R, p in zip(flat.rotations, points, strict=True)])
    assert stored["fig07"]["extent"] == pytest.approx(np.ptp(welded, axis=0), abs=1e-12)


def test_points_in_the_base_are_those_of_the_world_moved(stored, display, nominal):
    """Base 3 stands unturned at (0, 1, 0): there the welded points lie one metre further back."""
    _, _, centre = display
    flat, (_, points) = FlatSeam(0.1, 0.06, 72, "bisector"), curve(0.1, 0.06, 72)
    welded = np.stack([R @ p for R, p in zip(flat.rotations, points, strict=True)])
    mean = welded.mean(axis=0) + centre - [0.0, 1.0, 0.0]
    assert stored["fig08"]["mean"] == pytest.approx(mean, abs=1e-9)


@pytest.mark.parametrize(("main", "branch"), RADII)
def test_pace_is_that_of_differences(main, branch):
    model = SeamModel(main, branch, 720)
    turn = FlatSeam(main, branch, 720, "bisector").rotations
    welded = np.einsum("nij,nj->ni", turn, model.seam.points)
    step = 2 * np.pi / 720

    def speed(points):
        return np.linalg.norm(np.roll(points, -1, 0) - np.roll(points, 1, 0), axis=1) / (2 * step)

    # central differences over a degree; the curve turns sharply where it nearly stands still
    np.testing.assert_allclose(
        page._pace(model.seam, welded), speed(welded) / speed(model.seam.points), atol=5e-3
    )


def test_a_curve_that_is_the_seam_never_stands_still():
    seam = SeamModel(0.1, 0.06, 72).seam
    np.testing.assert_allclose(page._pace(seam, seam.points), 1.0, atol=1e-12)
    assert page._turns(seam, seam.points) == {}
    assert page._standstill(seam, seam.points) == {"turns": [], "slowest": pytest.approx(1.0)}


def test_turns_are_named_by_their_angle_and_lie_on_the_curve():
    flat = FlatSeam(0.1, 0.06, 72, "bisector")
    welded = np.einsum("nij,nj->ni", flat.rotations, flat.seam.points)
    turns = page._turns(flat.seam, welded)
    pace = page._pace(flat.seam, welded)
    assert turns
    for name, place in turns.items():
        index = round(float(name.split()[2]) / 5)
        np.testing.assert_array_equal(place, welded[index])
        assert pace[index] < 0.25
        assert pace[index] <= pace[[index - 1, (index + 1) % 72]].min()
    # no other local minimum is as slow
    least = (pace < np.roll(pace, 1)) & (pace <= np.roll(pace, -1)) & (pace < 0.25)
    assert len(turns) == least.sum()


def test_extent_in_words_and_table():
    points = np.array([[0.0, 0.1, 0.0], [0.1204, 0.05, 0.3]])
    assert page._extent(points) == "120 x 50 x 300 mm"
    table = page._table(points)
    assert list(table) == ["seam_point", "x_m", "y_m", "z_m"]
    assert table["seam_point"].tolist() == [0, 1]
    np.testing.assert_array_equal(table[["x_m", "y_m", "z_m"]].to_numpy(), points)


@pytest.mark.parametrize("count", [18, 90])
def test_range_of_theta_is_covered_once_by_any_number_of_points(registry, count):
    found = evaluate(registry, "pan.claim_theta_range", {"seam_points": count})
    assert found.verdict is Verdict.ADOPTED
    assert found.result.obtained["theta"] == pytest.approx([0.0, 2 * np.pi])
    assert f"{count} equally spaced points" in found.result.told()


@pytest.mark.parametrize("branch", [0.03, 0.075])
def test_sizes_follow_the_radii_that_are_assumed(registry, branch):
    changed = {"radius_branch": branch}
    for name in ("fig05", "fig06", "fig07"):
        given = evaluate(registry, f"pan.{name}").result
        assert evaluate(registry, f"pan.{name}", changed).result.told() != given.told()
    extent = evaluate(registry, "pan.fig06", changed).result.obtained["extent"]
    height = 0.1 - np.sqrt(0.01 - branch**2)
    assert extent == pytest.approx([2 * branch, 2 * branch, height], abs=1e-12)


def test_tables_are_the_curves_that_are_drawn(registry):
    import matplotlib.pyplot as plt

    result = evaluate(registry, "pan.fig06").result
    figure = result.figure()
    (axes,) = [one for one in figure.axes if one.name == "3d"][:1]
    drawn = np.array(axes.lines[0].get_data_3d()).T
    points = result.table[["x_m", "y_m", "z_m"]].to_numpy()
    plt.close(figure)
    # in metres or millimetres, and closed: the first point once more at the end
    scale = np.abs(drawn).max() / np.abs(points).max()
    assert round(scale) in (1, 1000)
    np.testing.assert_allclose(drawn[: len(points)], scale * points, atol=1e-9 * scale)


def test_derivative_of_the_seam_by_hand():
    theta, points = curve(0.1, 0.06, 360)
    found = periodic_derivative(points)
    z = points[:, 2]
    by_hand = np.column_stack([
        -0.06 * np.sin(theta), 0.06 * np.cos(theta),
        -(0.06**2) * np.sin(theta) * np.cos(theta) / z,
    ])  # fmt: skip
    np.testing.assert_allclose(found, by_hand, atol=1e-12)
