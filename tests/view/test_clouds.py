"""Point clouds: limits that are read off the points, volumes over cells, density that covers."""

import numpy as np
import pytest
from matplotlib.colors import to_rgb

from dualarm_repro.arms.occupancy import RotationVolume
from dualarm_repro.arms.workspace import VoxelVolume
from dualarm_repro.view.clouds import cloud_figure, volume_figure
from dualarm_repro.view.legibility import faults
from dualarm_repro.view.style import BLUE, ORANGE

from .drawn import curves, words

POINTS = np.random.default_rng(5).uniform((-0.6, -0.5, -0.2), (0.6, 0.5, 0.9), (600, 3))
ASIDE = np.array([0.0, 1.2, 0.0])
BODY = [RotationVolume(cell, 10, 1.0 + cell, 0.0) for cell in (0.02, 0.04, 0.08)]
VOXELS = [VoxelVolume(cell, 10, 1.0 - cell) for cell in (0.02, 0.04, 0.08)]


def test_the_section_tells_the_reach_and_the_heights():
    figure = volume_figure(POINTS, BODY, VOXELS)
    section = figure.axes[1]
    reach = np.linalg.norm(POINTS[:, :2], axis=1).max()
    low, high = POINTS[:, 2].min(), POINTS[:, 2].max()
    assert set(words(section)) == {f"z = {low:.2f} m", f"z = {high:.2f} m", f"{reach:.2f} m"}
    levels = [line.get_ydata()[0] for line in section.lines if len(set(line.get_ydata())) == 1]
    assert sorted(levels) == pytest.approx([low, high])
    (upright,) = [line.get_xdata()[0] for line in section.lines if len(set(line.get_xdata())) == 1]
    assert upright == pytest.approx(reach)
    assert section.get_xlim()[0] == 0.0
    assert section.get_xlim()[1] > reach
    assert section.get_ylim()[0] < low < high < section.get_ylim()[1]
    assert section.get_xlabel() == "distance from axis 1 [m]"
    assert faults(figure) == []


def test_every_point_is_in_the_cloud_and_counted():
    figure = volume_figure(POINTS, BODY, VOXELS)
    space, section = figure.axes[:2]
    assert space.get_title() == "600 positions of the flange"
    x, y, z = space.collections[0]._offsets3d
    np.testing.assert_allclose(np.column_stack([x, y, z]), POINTS)
    assert section.collections[0].get_array().sum() == len(POINTS)


def test_volumes_stand_over_the_size_of_their_cells():
    volume = volume_figure(POINTS, BODY, VOXELS).axes[2]
    found = curves(volume)
    np.testing.assert_allclose(found["rotation body"], [(b.cell, b.volume) for b in BODY])
    np.testing.assert_allclose(found["voxels of the cloud"], [(v.cell, v.volume) for v in VOXELS])
    assert volume.get_ylim()[0] == 0.0
    assert (volume.get_xlabel(), volume.get_ylabel()) == ("cell size [m]", "volume [m$^3$]")


def test_clouds_of_several_arms_are_seen_from_two_sides():
    clouds = {"left": POINTS - ASIDE, "right": POINTS + ASIDE}
    figure = cloud_figure(clouds, (BLUE, ORANGE))
    above, along = figure.axes
    assert [ax.get_title(loc="left") for ax in figure.axes] == ["from above", "along x"]
    assert (above.get_ylabel(), along.get_ylabel(), along.get_xlabel()) == (
        "x [m]", "z [m]", "y [m]")  # fmt: skip
    for ax, up in ((above, 0), (along, 2)):
        assert sorted(words(ax)) == ["left", "right"]
        for image, points, color in zip(ax.images, clouds.values(), (BLUE, ORANGE), strict=True):
            left, right, bottom, top = image.get_extent()
            assert left <= points[:, 1].min() < points[:, 1].max() <= right
            assert bottom <= points[:, up].min() < points[:, up].max() <= top
            picture = np.asarray(image.get_array())
            np.testing.assert_allclose(picture[0, 0, :3], to_rgb(color))
            assert picture[..., 3].max() <= 0.75
            # the cell of a point is tinted, and no more cells are than there are points
            rows, columns = picture.shape[:2]
            k = int(points[:, 1].argmin())
            column = int((points[k, 1] - left) / (right - left) * columns)
            row = int((points[k, up] - bottom) / (top - bottom) * rows)
            assert picture[row, column, 3] > 0.0
            assert 0 < (picture[..., 3] > 0).sum() <= len(points)
            assert image.origin == "lower"
        for text in ax.texts:
            side = -1 if text.get_text() == "left" else 1
            assert side * text.xy[0] > 1.2, "a name stands at the outer half of its cloud"
