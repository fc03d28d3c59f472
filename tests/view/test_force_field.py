"""Forces on a point in a plane: arrows of the forces, their sum, and level lines outside."""

import numpy as np
import pytest
from matplotlib.quiver import Quiver

from dualarm_repro.view.force_field import force_field_figure
from dualarm_repro.view.style import BLUE, GREEN, RED

from .drawn import words

GOAL, CENTRE, RADIUS = np.array([1.0, 0.1]), np.array([0.5, 0.0]), 0.15
POINTS = np.array([[0.1, 0.3], [0.3, 0.1], [0.7, -0.3]])


def potential(points):
    away = np.linalg.norm(points - CENTRE, axis=1)
    return np.sum((points - GOAL) ** 2, axis=1) + 0.05 / np.maximum(away, 1e-3)


def forces(point):
    away = point - CENTRE
    return -2.0 * (point - GOAL), 0.2 * away / np.linalg.norm(away) ** 3


@pytest.fixture
def ax():
    (found,) = force_field_figure(potential, forces, GOAL, CENTRE, RADIUS, POINTS).axes
    return found


def test_arrows_are_the_forces_and_their_sum(ax):
    arrows = [c for c in ax.collections if isinstance(c, Quiver)]
    assert len(arrows) == 3 * len(POINTS)
    for k, point in enumerate(POINTS):
        pull, push, total = arrows[3 * k : 3 * k + 3]
        vectors = [np.array([a.U[0], a.V[0]]) for a in (pull, push, total)]
        for arrow in (pull, push, total):
            np.testing.assert_allclose(arrow.get_offsets()[0], point)
        np.testing.assert_allclose(vectors[0] + vectors[1], vectors[2], atol=1e-12)
        for vector, force in zip(vectors, forces(point), strict=False):
            np.testing.assert_allclose(np.cross([*vector, 0], [*force, 0]), 0.0, atol=1e-12)
            assert vector @ force > 0.0
        lengths = [np.linalg.norm(v) for v in vectors[:2]]
        assert max(lengths) == pytest.approx(0.22)
        exact = np.linalg.norm(forces(point), axis=1)
        assert lengths[0] / lengths[1] == pytest.approx(exact[0] / exact[1])
        assert all(a.scale == 1 and a.angles == "xy" for a in (pull, push, total))


def test_names_stand_once_where_repulsion_is_strongest(ax):
    assert sorted(words(ax)) == ["attraction", "goal", "obstacle", "repulsion", "resultant"]
    strongest = POINTS[np.argmin(np.linalg.norm(POINTS - CENTRE, axis=1))]
    ends = {t.get_text(): np.array(t.xy) for t in ax.texts}
    pull, push = ends["attraction"] - strongest, ends["repulsion"] - strongest
    np.testing.assert_allclose(pull + push, ends["resultant"] - strongest, atol=1e-12)
    assert max(np.linalg.norm(pull), np.linalg.norm(push)) == pytest.approx(0.22)
    np.testing.assert_allclose(ends["goal"], GOAL)
    np.testing.assert_allclose(ends["obstacle"], CENTRE)


def test_level_lines_stay_outside_the_obstacle(ax):
    lines = next(c for c in ax.collections if hasattr(c, "levels"))
    assert (np.diff(lines.levels) > 0).all()
    vertices = np.vstack([path.vertices for path in lines.get_paths() if len(path.vertices)])
    assert np.linalg.norm(vertices - CENTRE, axis=1).min() >= RADIUS
    (circle,) = ax.patches
    assert (tuple(circle.center), circle.radius) == (tuple(CENTRE), RADIUS)
    star = next(line for line in ax.lines if line.get_marker() == "*")
    assert np.ravel(star.get_data()).tolist() == GOAL.tolist()
    assert ax.get_aspect() == 1.0
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("x [m]", "y [m]")


def test_each_force_has_a_colour_of_its_own(ax):
    from matplotlib.colors import to_hex

    arrows = [c for c in ax.collections if isinstance(c, Quiver)]
    shown = [to_hex(arrow.get_facecolor()[0]).upper() for arrow in arrows[:3]]
    assert shown == [GREEN, RED, BLUE]
