"""Two arms when they are nearest: seen from where the gap shows, and all panels alike."""

import numpy as np
import pinocchio as pin
import pytest

from dualarm_repro.arms import load_arm
from dualarm_repro.scene import PlacedArm
from dualarm_repro.view.crossing import Crossing, crossing_axes
from dualarm_repro.view.link_bodies import Body
from dualarm_repro.view.style import BLACK, MASTER, SLAVE, WIDTH, axes_3d

from .drawn import in_space, words

PATHS = (np.linspace((0, 0, 0), (0.1, 0.2, 0.3), 4), np.linspace((0, 1, 0), (0.1, 0.2, 0.3), 6))


def crossing(nearest):
    bodies = [
        Body(PlacedArm(name, load_arm("irb120"), pin.SE3(np.eye(3), np.array([0.0, y, 0.0]))),
             np.array([0.2 + y, 0.4, -0.3, 0.1, 0.5, 0.0]), color, 0)
        for name, y, color in (("left", 0.0, MASTER), ("right", 0.7, SLAVE))
    ]  # fmt: skip
    return Crossing(tuple(bodies), PATHS, np.array(nearest))


@pytest.mark.parametrize("gap", [(0.0, 0.1, 0.0), (0.1, 0.0, 0.0), (0.05, 0.05, 0.08)])
def test_the_gap_is_seen_at_its_length(gap):
    middle = np.array([0.2, 0.3, 0.4])
    made = crossing([middle, middle + gap])
    _, ax = axes_3d()
    crossing_axes([ax], [made])
    elev, azim = np.radians([ax.elev, ax.azim])
    towards = np.array([np.cos(elev) * np.cos(azim), np.cos(elev) * np.sin(azim), np.sin(elev)])
    along = abs(np.dot(gap, towards)) / np.linalg.norm(gap)
    # of 96 directions to choose from; a view along the gap would have 1
    assert np.sqrt(1 - along**2) > 0.85


def test_every_panel_shows_arms_paths_and_gap_from_the_same_side():
    one = crossing([(0.1, 0.2, 0.4), (0.1, 0.5, 0.4)])
    other = crossing([(0.3, 0.2, 0.2), (0.1, 0.2, 0.2)])
    _, axes = axes_3d(WIDTH, 4.0, columns=2)
    crossing_axes(axes, [one, other])
    assert (axes[0].elev, axes[0].azim) == (axes[1].elev, axes[1].azim)
    for ax, made in zip(axes, (one, other), strict=True):
        lines = dict(zip(map(id, ax.lines), in_space(ax), strict=True))
        (gap,) = [lines[id(line)] for line in ax.lines if line.get_color() == BLACK]
        np.testing.assert_allclose(gap, made.nearest)
        for body, path in zip(made.bodies, made.paths, strict=True):
            mine = [lines[id(line)] for line in ax.lines if line.get_color() == body.color]
            assert any(p.shape == path.shape and np.allclose(p, path) for p in mine)
            flange = body.placed.placement.act(body.placed.arm.fk(body.q)[:3, 3])
            assert any(np.allclose(p[-1], flange) for p in mine)
        assert sorted(words(ax)) == ["left", "right"]
        assert len(ax.collections) == 2
