"""Drawings of arms: dimensions with their lengths, frames with their names, postures in place."""

import numpy as np
import pinocchio as pin
import pytest

from dualarm_repro.arms import load_arm
from dualarm_repro.view.arm_drawings import (
    dimension_drawing,
    draw_plate,
    frames_figure,
    skeleton,
    stick_figure,
)
from dualarm_repro.view.style import BLUE, GREEN, RED, axes_3d

from .drawn import in_space, outside, words

Q = np.array([0.3, -0.4, 0.5, 0.2, -0.4, 0.1])
BASE = pin.SE3(pin.rpy.rpyToMatrix(0.2, 0.0, 1.1), np.array([0.4, -0.7, 0.3]))


def frame(translation, turn=(0.0, 0.0, 0.0)):
    return pin.SE3(pin.rpy.rpyToMatrix(*turn), np.array(translation, dtype=float)).homogeneous


def test_a_dimension_has_its_length_in_millimetres_and_stands_aside():
    outline = np.array([[0.0, 0.0], [0.0, 0.45], [0.6, 0.45]])
    beside, above = (-0.2, 0.0), (0.0, 0.1)
    figure = dimension_drawing(
        outline, [("d1", outline[0], outline[1], beside), ("a2", outline[1], outline[2], above)]
    )
    (ax,) = figure.axes
    assert words(ax) == ["d1 = 450", "a2 = 600"]
    arrows = [text for text in ax.texts if not text.get_text()]
    ends = [np.array([arrow.xy, arrow.xyann]) for arrow in arrows]
    np.testing.assert_allclose(ends[0], outline[:2] + beside)
    np.testing.assert_allclose(ends[1], outline[1:] + above)
    named = [text for text in ax.texts if text.get_text()]
    for text, offset, piece in zip(named, (beside, above), (outline[:2], outline[1:]), strict=True):
        away = np.array(text.get_position()) - piece.mean(axis=0)
        assert away @ offset > np.dot(offset, offset), "the name is beyond its line"
    assert (ax.get_xlabel(), ax.get_ylabel(), ax.get_aspect()) == ("x [m]", "z [m]", 1.0)
    assert outside(ax) == []
    np.testing.assert_allclose(np.column_stack(ax.lines[0].get_data()), outline)


def test_frames_that_coincide_share_their_labels():
    frames = np.array([frame((0, 0, 0)), frame((0, 0, 0)), frame((0.5, 0, 0), (0, 0, np.pi / 2))])
    (ax,) = frames_figure(frames, 0.1).axes
    colours = {text.get_text(): text.get_color() for text in ax.texts}
    assert set(colours) == {"x0 x1", "y0 y1", "z0 z1", "x2", "y2", "z2"}
    assert len({colours["x0 x1"], colours["y0 y1"], colours["z0 z1"]}) == 3
    triads = [
        (line.get_color(), points)
        for line, points in zip(ax.lines, in_space(ax), strict=True)
        if line.get_color() in (RED, GREEN, BLUE)
    ]
    assert len(triads) == 6
    tips = {(color, *np.round(p[1] - p[0], 9).tolist()) for color, p in triads if p[0, 0] > 0.4}
    assert tips == {(RED, 0.0, 0.1, 0.0), (GREEN, -0.1, 0.0, 0.0), (BLUE, 0.0, 0.0, 0.1)}


@pytest.mark.parametrize(
    ("turn", "corner"),
    [((0, 0, 0), (0, 0, 0.5)), ((0, 0, np.pi / 2), (0.3, 0, 0)), ((np.pi / 3, 0, 1.0), None)],
)
def test_the_skeleton_turns_where_an_offset_ends(turn, corner):
    """Along z and then along the new x of a standard table, along x and then the new z else."""
    frames = np.array([frame((0, 0, 0)), frame((0.3, 0, 0.5), turn)])
    (ax,) = frames_figure(frames, 0.1).axes
    expected = [(0, 0, 0), *([corner] if corner else []), (0.3, 0, 0.5)]
    np.testing.assert_allclose(in_space(ax)[0], expected, atol=1e-12)


def test_pieces_of_a_skeleton_are_named():
    frames = np.array([frame((0, 0, 0)), frame((0, 0, 0.5)), frame((0.4, 0, 0.5))])
    spans = {"d1": (frames[0, :3, 3], frames[1, :3, 3]), "a2": (frames[1, :3, 3], frames[2, :3, 3])}
    (ax,) = frames_figure(frames, 0.1, spans).axes
    assert {"d1", "a2"} <= set(words(ax))
    darker = [p for line, p in zip(ax.lines, in_space(ax), strict=True)
              if line.get_color() == "0.45"]  # fmt: skip
    assert len(darker) == 1
    np.testing.assert_allclose(darker[0], spans["d1"])


def test_a_skeleton_ends_at_the_flange():
    arm = load_arm("irb120")
    points = skeleton(arm, Q, BASE)
    assert points.shape == (arm.nq + 2, 3)
    np.testing.assert_allclose(points[0], BASE.translation)
    np.testing.assert_allclose(points[-1], BASE.act(arm.fk(Q)[:3, 3]), atol=1e-12)
    data = arm.model.createData()
    pin.forwardKinematics(arm.model, data, Q)
    for joint in range(1, arm.nq + 1):
        place = BASE.act(data.oMi[joint].translation)
        # an origin of a table may lie anywhere on the axis of its joint
        axis = BASE.rotation @ data.oMi[joint].rotation[:, 2]
        np.testing.assert_allclose(np.cross(points[joint] - place, axis), 0.0, atol=1e-9)


def test_stick_figures_stand_where_their_arms_do():
    arm, other = load_arm("irb120"), pin.SE3(np.eye(3), np.array([0.0, 0.9, 0.0]))
    figure = stick_figure({"one": (arm, Q, BASE), "two": (arm, 0 * Q, other)}, elev=10, azim=-40)
    (ax,) = figure.axes
    flanges = [p for line, p in zip(ax.lines, in_space(ax), strict=True)
               if line.get_marker() == "s"]  # fmt: skip
    np.testing.assert_allclose(flanges[0][0], BASE.act(arm.fk(Q)[:3, 3]), atol=1e-12)
    np.testing.assert_allclose(flanges[1][0], other.act(arm.fk(0 * Q)[:3, 3]), atol=1e-12)
    dotted = [p for line, p in zip(ax.lines, in_space(ax), strict=True)
              if line.get_linestyle() == ":"]  # fmt: skip
    for way, flange, base in zip(dotted, flanges, (BASE, other), strict=True):
        np.testing.assert_allclose(way[0], flange[0])
        np.testing.assert_allclose(way[1], [*flange[0, :2], base.translation[2]])
    assert sorted(words(ax)) == ["one", "two"]
    assert (ax.elev, ax.azim) == (10, -40)
    used = {line.get_color() for line in ax.lines if line.get_marker() == "s"}
    assert len(used) == 2
    for points in in_space(ax):
        for column, (low, high) in zip(
            points.T, (ax.get_xlim(), ax.get_ylim(), ax.get_zlim()), strict=True
        ):
            assert low <= column.min()
            assert column.max() <= high


def test_a_plate_lies_in_the_plane_of_its_base():
    _, ax = axes_3d()
    draw_plate(ax, BASE, 0.25, RED)
    (corners,) = in_space(ax)
    np.testing.assert_allclose(corners[0], corners[-1])
    away = corners[:-1] - BASE.translation
    np.testing.assert_allclose(away @ BASE.rotation[:, 2], 0.0, atol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(away, axis=1), 0.25 * np.sqrt(2))
    np.testing.assert_allclose(np.linalg.norm(np.diff(corners, axis=0), axis=1), 0.5)
