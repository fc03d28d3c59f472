"""A hull around an arm: its circles closed, every face drawn, the arm inside."""

import numpy as np
import pinocchio as pin
import pytest
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from dualarm_repro.arms import load_arm
from dualarm_repro.scene import ConvexHull, PlacedArm
from dualarm_repro.view.hull_drawing import hull_figure
from dualarm_repro.view.style import RED

from .drawn import in_space, words

Q = np.array([0.3, 0.4, -0.2, 0.1, 0.5, 0.0])


@pytest.fixture(scope="module")
def drawn():
    base = pin.SE3(np.eye(3), np.array([0.5, 0.0, 0.1]))
    placed = PlacedArm("arm", load_arm("irb120"), base)
    turn = np.linspace(0.0, 2.0 * np.pi, 12, endpoint=False)
    circle = np.column_stack([np.cos(turn), np.sin(turn), 0.0 * turn])
    places = base.act(placed.arm.fk(Q)[:3, 3]), base.translation
    rings = np.array(
        [place + radius * circle for place, radius in zip(places, (0.1, 0.3), strict=True)]
    )
    return placed, rings, ConvexHull(rings.reshape(-1, 3))


def test_both_views_show_circles_hull_and_arm(drawn):
    placed, rings, hull = drawn
    first, second = hull_figure(placed, Q, hull, rings).axes
    assert first.azim != second.azim
    assert first.elev == second.elev
    for ax in (first, second):
        (faces,) = [c for c in ax.collections if isinstance(c, Poly3DCollection)]
        assert faces.get_alpha() < 0.5
        circles = [p for line, p in zip(ax.lines, in_space(ax), strict=True)
                   if line.get_color() == RED]  # fmt: skip
        for ring, shown in zip(rings, circles, strict=True):
            np.testing.assert_allclose(shown, [*ring, ring[0]])
        (arm,) = [p for line, p in zip(ax.lines, in_space(ax), strict=True)
                  if line.get_marker() == "o"]  # fmt: skip
        np.testing.assert_allclose(arm[0], placed.placement.translation)
        flange = placed.placement.act(placed.arm.fk(Q)[:3, 3])
        np.testing.assert_allclose(arm[-1], flange, atol=1e-12)
        assert sorted(words(ax)) == ["arm", "circle"]
    assert first.get_title() == "the hull (blue) from two sides"


def test_the_circle_that_is_named_is_the_widest(drawn):
    from mpl_toolkits.mplot3d import proj3d

    placed, rings, hull = drawn
    ax = hull_figure(placed, Q, hull, rings).axes[0]
    ax.figure.draw_without_rendering()
    (text,) = [t for t in ax.texts if t.get_text() == "circle"]
    near = [min(np.linalg.norm(np.array(proj3d.proj_transform(*p, ax.get_proj())[:2]) - text.xy)
                for p in ring) for ring in rings]  # fmt: skip
    assert near[1] < near[0], "the second has three times the radius"
