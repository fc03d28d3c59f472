"""The workspace of any arm as a scene that can be turned."""

from __future__ import annotations

import numpy as np

from ...arms import Arm
from ...arms.workspace import sample_workspace
from ..page import Page
from ..scene3d import Scene3D
from ..style import BLUE, GREEN

_POINTS = 4000  # enough to show the shape, few enough for a small page


def cloud_page(arm: Arm, rng: np.random.Generator) -> Page:
    """The arm in the middle of its joint ranges, within a Monte-Carlo cloud of flange positions."""
    points = sample_workspace(arm, _POINTS, rng)
    reach = float(np.abs(points).max())
    title = f"{arm.title} and {_POINTS} flange positions for random joint angles."
    scene = Scene3D(title, camera=(1.3 * reach, 1.3 * reach, 0.8 * reach), grid=False)
    scene.add_points("workspace", points, GREEN, size=0.02 * reach)
    scene.add_arm("arm", arm, 0.5 * np.add(*arm.usual_range), color=BLUE)
    return Page(scene.page_html())
