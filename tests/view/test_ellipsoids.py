"""Velocity ellipsoids: their surface solves its equation, and titles give the semi-axes."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualarm_repro.view.ellipsoids import beta_figure, ellipsoid_panels, ellipsoid_surface
from dualarm_repro.view.style import WIDTH, axes_3d
from dualarm_repro.welding import ROBOTS

from .drawn import curves, in_space, words


def gram(seed, stretch=1.0):
    root = np.random.default_rng(seed).normal(size=(3, 3))
    return stretch**2 * (root @ root.T + 0.05 * np.eye(3))


@settings(max_examples=20)
@given(st.integers(0, 2**32 - 1))
def test_the_surface_is_that_of_unit_joint_velocities(seed):
    """v^T A^-1 v = 1, and the extreme points are the roots of the eigenvalues of A."""
    matrix = gram(seed)
    points = np.stack(ellipsoid_surface(matrix, steps=32), axis=-1).reshape(-1, 3)
    form = np.einsum("ni,ij,nj->n", points, np.linalg.inv(matrix), points)
    np.testing.assert_allclose(form, 1.0, rtol=1e-8)
    reach = np.linalg.norm(points, axis=1)
    low, high = np.sqrt(np.linalg.eigvalsh(matrix)[[0, -1]])
    assert low - 1e-9 <= reach.min()
    assert reach.max() <= high + 1e-9
    # 64 by 32 points come this close to the tip of the longest semi-axis
    assert reach.max() == pytest.approx(high, rel=0.01)


def test_panels_share_the_scale_of_the_largest(surfaces):
    grams = np.array([gram(1), gram(2, 0.3), gram(3, 2.0)])
    figure, axes = axes_3d(WIDTH, 3.0, columns=3)
    ellipsoid_panels(axes, grams)
    assert len(surfaces) == 3
    longest = np.sqrt(np.linalg.eigvalsh(grams[2])[-1])
    for ax, name, matrix in zip(axes, ROBOTS, grams, strict=True):
        assert ax.get_xlim() == ax.get_ylim() == ax.get_zlim()
        assert ax.get_xlim() == pytest.approx((-longest, longest))
        low, high = np.sqrt(np.linalg.eigvalsh(matrix)[[0, -1]])
        assert ax.get_title() == f"{name}: {high:.2f} to {low:.2f} m/s"
        spans = sorted(np.linalg.norm(p[1] - p[0]) for p in in_space(ax))
        assert spans == pytest.approx(2 * np.sqrt(np.linalg.eigvalsh(matrix)))
        assert ax.get_zlabel() == "vz [m/s]"
    assert figure.axes == list(axes)


def test_weights_fill_the_panel_below_the_volumes():
    volumes = np.array([np.linspace(1, 2, 7), np.linspace(3, 4, 7), np.linspace(2, 5, 7)])
    common, share = np.linspace(0.5, 0.9, 7), np.linspace(0.2, 0.6, 7)
    above, below = beta_figure(volumes, common, share).axes
    found = curves(above)
    for name, values in zip(ROBOTS, volumes, strict=True):
        np.testing.assert_allclose(found[name][:, 1], values)
    np.testing.assert_allclose(found["common to all"][:, 1], common)
    assert above.get_ylim()[0] == 0.0
    carriers, welder = (c.get_paths()[0].vertices for c in below.collections)
    at = carriers[np.isclose(carriers[:, 0], 3.0), 1]
    assert (at.min(), at.max()) == pytest.approx((0.0, share[3]))
    at = welder[np.isclose(welder[:, 0], 3.0), 1]
    assert (at.min(), at.max()) == pytest.approx((share[3], 1.0))
    heights = {text.get_text(): text.get_position()[1] for text in below.texts}
    assert 0.0 < heights["carriers"] < share[3] < heights["welder"] < 1.0
    assert set(words(above)) == {*ROBOTS, "common to all"}
    assert below.get_ylim() == (0.0, 1.0)
