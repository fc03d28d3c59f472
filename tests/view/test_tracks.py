"""Tracks past boxes: what is near the boxes is seen from two sides, with gaps and lengths told."""

import numpy as np
import pinocchio as pin
import pytest

from dualarm_repro.arms import load_arm
from dualarm_repro.scene import Box, PlacedArm
from dualarm_repro.view.link_bodies import Body
from dualarm_repro.view.style import BLACK, BLUE, MASTER, ORANGE, PURPLE, RED
from dualarm_repro.view.tracks import Track, distances_figure, top_view_figure, tracks_figure

from .drawn import curves, in_space, outside, words

#: Bars around an opening of 1.0 m by 0.8 m about (0, 0.3, 0.5), as seen along x.
BARS = [
    Box(np.array(centre), 2 * np.array(half))
    for centre, half in (
        ((0, 0.3, 0.95), (0.05, 0.6, 0.05)), ((0, 0.3, 0.05), (0.05, 0.6, 0.05)),
        ((0, -0.25, 0.5), (0.05, 0.05, 0.4)), ((0, 0.85, 0.5), (0.05, 0.05, 0.4)),
    )
]  # fmt: skip
STEPS = np.linspace(0.0, 1.0, 61)[:, np.newaxis]
THROUGH = Track("through", np.hstack([2.0 * STEPS - 1.0, 0.3 + 0.3 * STEPS, 0 * STEPS + 0.5]), BLUE)
ASIDE = Track("aside", np.hstack([STEPS + 1.0, STEPS, STEPS]), RED, "--")
MARKS = {"start": THROUGH.points[0], "goal": THROUGH.points[-1], "far": np.array([9.0, 9.0, 9.0])}


@pytest.fixture
def top():
    figure = top_view_figure(BARS, [THROUGH, ASIDE], MARKS)
    return figure.axes[0]


def test_the_view_from_above_is_cut_to_what_happens_at_the_bars(top):
    left, right = top.get_xlim()
    low, high = top.get_ylim()
    assert left <= -1.0 - 0.35 < 1.0 + 0.35 <= right
    assert low <= -0.3 - 0.35 < 0.9 + 0.35 <= high
    assert right < 9.0, "a point far off does not stretch the view"
    assert "far" not in words(top)
    assert {"start", "goal"} <= set(words(top))
    assert top.get_aspect() == 1.0
    assert (top.get_xlabel(), top.get_ylabel()) == ("x [m]", "y [m]")


def test_tracks_have_a_dot_at_every_twentieth_step(top):
    found = curves(top)
    np.testing.assert_allclose(found["through"], THROUGH.points[:, :2])
    dots = [np.column_stack(line.get_data()) for line in top.lines if line.get_marker() == "o"]
    np.testing.assert_allclose(dots[0], THROUGH.points[[0, 20, 40, 60], :2])
    names = [text.get_text() for text in top.figure.legends[0].get_texts()]
    assert names == ["through", "aside", "every 20 steps"]
    handles = top.figure.legends[0].get_lines()
    assert [line.get_linestyle() for line in handles[:2]] == ["-", "--"]


def test_the_gap_to_the_nearest_bar_is_told(top):
    """The way to the right bar is measured by hand: it is nearest where the track passes x = 0."""
    points = THROUGH.points
    over = np.maximum(abs(points[:, 0]) - 0.05, 0.0), np.maximum(0.8 - points[:, 1], 0.0)
    gap = np.hypot(*over).min()
    upper = np.hypot(over[0], 0.4).min()  # to the bars above and below
    told = f"{min(gap, upper):.2f} m"
    assert told in words(top)
    line = next(p for p in top.lines if p.get_color() == BLACK and len(p.get_xdata()) == 2)
    assert line.get_linestyle() == "-"
    assert sum(word.endswith(" m") for word in words(top)) == 1, "none for a dashed track"


def test_bars_are_outlined(top):
    outlines = [patch.get_xy() for patch in top.patches]
    spans = [(*o.min(axis=0), *o.max(axis=0)) for o in outlines]
    expected = [(*(b.center - b.half)[:2], *(b.center + b.half)[:2]) for b in BARS]
    np.testing.assert_allclose(spans, expected)


def test_the_view_along_x_has_the_size_of_the_opening():
    figure = tracks_figure(BARS, [THROUGH], MARKS, elev=15)
    space, above, along = figure.axes
    assert space.elev == 15
    assert {word.strip() for word in words(along)} >= {"1.00 m", "0.80 m"}
    assert "start" not in words(along), "points are explained from above"
    arrows = [np.array([t.xy, t.xyann]) for t in along.texts if not t.get_text()]
    np.testing.assert_allclose(np.sort(arrows[0][:, 0]), [-0.2, 0.8])
    np.testing.assert_allclose(np.sort(arrows[1][:, 1]), [0.1, 0.9])
    assert [ax.get_title(loc="left") for ax in (above, along)] == ["from above", "along x"]
    assert (along.get_xlabel(), along.get_ylabel()) == ("y [m]", "z [m]")


def test_contacts_are_circled_and_nothing_else_is_told():
    hit = {"hit": np.array([0.0, 0.5, 0.5])}
    figure = tracks_figure(BARS, [THROUGH], MARKS, contacts=hit)
    for ax in figure.axes[1:]:
        assert not any(word.strip().endswith(" m") for word in words(ax))
    assert "hit" in words(figure.axes[1])
    rings = [c for c in figure.axes[1].collections if len(c.get_facecolor()) == 0]
    np.testing.assert_allclose(rings[0].get_offsets(), [hit["hit"][:2]])


def test_in_space_only_what_is_near_is_drawn_above_its_shadow():
    marks = {"start": THROUGH.points[0], "goal": THROUGH.points[-1]}
    middle = np.mean(list(marks.values()), axis=0)
    figure = tracks_figure(BARS, [THROUGH], marks, near=0.4)
    space = figure.axes[0]
    lines = [p for line, p in zip(space.lines, in_space(space), strict=True)
             if line.get_color() == BLUE]  # fmt: skip
    kept = THROUGH.points[np.linalg.norm(THROUGH.points - middle, axis=1) <= 0.4]
    np.testing.assert_allclose(lines[0], kept)
    shadow = lines[1]
    np.testing.assert_allclose(shadow[:, :2], kept[:, :2])
    assert np.ptp(shadow[:, 2]) == 0.0
    assert shadow[0, 2] == pytest.approx(space.get_zlim()[0])
    feet = [p for line, p in zip(space.lines, in_space(space), strict=True)
            if line.get_linestyle() == ":"]  # fmt: skip
    for way, point in zip(feet, marks.values(), strict=True):
        np.testing.assert_allclose(way, [point, [*point[:2], space.get_zlim()[0]]])


def test_instants_of_bodies_are_ringed_on_all_full_tracks():
    placed = PlacedArm("arm", load_arm("irb120"), pin.SE3(np.eye(3), np.array([0.0, 0.3, 0.0])))
    bodies = [Body(placed, np.zeros(6), MASTER, step) for step in (10, 50)]
    ax = top_view_figure(BARS, [THROUGH, ASIDE], MARKS, bodies).axes[0]
    rings = [tuple(np.ravel(line.get_data()).round(9)) for line in ax.lines
             if line.get_markersize() == 6.5]  # fmt: skip
    expected = [tuple(track.points[step, :2].round(9)) for step in (10, 50)
                for track in (THROUGH, ASIDE)]  # fmt: skip
    assert rings == expected
    inside = [p for p in expected if ax.get_xlim()[0] < p[0] < ax.get_xlim()[1]]
    told = [word.strip() for word in words(ax) if word.strip().isdigit()]
    assert len(told) == len(inside)


def test_distances_over_the_steps_with_their_levels():
    found = {"improved": np.array([0.4, 0.2, 0.3]), "traditional": np.array([0.4, 0.1, 0.05])}
    (ax,) = distances_figure(found, {"contact": 0.0, "range": 0.35}).axes
    drawn = curves(ax)
    for name, values in found.items():
        np.testing.assert_allclose(drawn[name], np.column_stack([np.arange(3), values]))
    assert drawn["contact"][:, 1].tolist() == [0.0, 0.0]
    styles = {line.get_label(): (line.get_linestyle(), line.get_color()) for line in ax.lines}
    assert styles["contact"] == ("--", BLACK)
    assert styles["range"] == ("--", PURPLE)
    assert ORANGE not in {color for _, color in (styles["contact"], styles["range"])}
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("step", "distance [m]")
    assert set(words(ax)) == {*found, "contact", "range"}
    assert outside(ax) == []
    (ax,) = distances_figure(found, {}, steps=np.array([0.0, 5.0, 10.0])).axes
    assert curves(ax)["improved"][:, 0].tolist() == [0.0, 5.0, 10.0]
