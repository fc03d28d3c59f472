"""What the hull of circles at the joints of an arm leaves out of its links."""

from __future__ import annotations

import numpy as np

from ...scene import PlacedArm
from ...scene.posing import links_of
from ..field.control_points import ends_of
from ..field.hull_obstacle import JointCircles, circles_on, hull_track


def link_cores(placed: PlacedArm, q: np.ndarray) -> np.ndarray:
    """Ends of the cores of the links in the world for configurations (N, nq), (N, links, 2, 3)
    [m]."""
    return ends_of(placed, links_of(placed.arm), q)


def protrusions(placed: PlacedArm, q: np.ndarray, circles: JointCircles) -> np.ndarray:
    """How far each capsule of the arm sticks out of the hull of its circles (N, links) [m].

    The largest height max_f (n_f . x + c_f) + r of the capsule over a plane of the hull, 0 inside.
    """
    track = hull_track(circles_on(placed, circles, q))
    normal, offset = track.planes[..., :3], track.planes[..., 3]
    heights = np.einsum("tlkr,tfr->tlkf", link_cores(placed, q), normal) + offset[:, None, None]
    return np.maximum(heights.max(axis=(2, 3)) + links_of(placed.arm).radius, 0.0)
