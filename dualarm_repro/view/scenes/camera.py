"""A camera that sees all of the action, and nothing but it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

#: Angle of view from top to bottom [rad], width over height of the picture, and share of it used.
FIELD, ASPECT, FILLED = np.deg2rad(32.0), 16.0 / 9.0, 0.9
_CLOSEST = 1e-3  # of the eye to a point [m]


@dataclass(frozen=True, eq=False)
class Camera:
    """A perspective camera with z up.

    Attributes
    ----------
    eye, target : ndarray (3,)
        [m]
    """

    eye: np.ndarray
    target: np.ndarray

    @property
    def axes(self) -> np.ndarray:
        """Rows right, up and forward (3, 3)."""
        forward = self.target - self.eye
        forward = forward / np.linalg.norm(forward)
        right = np.cross(forward, [0.0, 0.0, 1.0])
        right /= np.linalg.norm(right)
        return np.array([right, np.cross(right, forward), forward])

    def project(self, points: np.ndarray) -> np.ndarray:
        """Points (..., 3) to x and y in -1 ... 1 within the picture, and the depth [m]."""
        x, y, depth = np.moveaxis((points - self.eye) @ self.axes.T, -1, 0)
        scale = 1.0 / (np.tan(0.5 * FIELD) * np.maximum(depth, 1e-9))
        return np.stack([x * scale / ASPECT, y * scale, depth], axis=-1)


def framed(direction: np.ndarray, points: np.ndarray) -> Camera:
    """The camera that looks along ``-direction`` and fills the picture with the points (N, 3)."""
    unit = direction / np.linalg.norm(direction)
    if np.hypot(*unit[:2]) < 1e-3:  # from straight above or below there is no "up"
        unit = np.array([1e-3, 0.0, unit[2]]) / np.hypot(1e-3, unit[2])
    camera = Camera(unit, np.zeros(3))
    x, y, depth = camera.axes @ points.T
    k = FILLED * np.tan(0.5 * FIELD)
    across, far_x = _seen(x, depth, k * ASPECT)
    up, far_y = _seen(y, depth, k)
    eye = camera.axes.T @ [across, up, min(far_x, far_y, float(depth.min()) - _CLOSEST)]
    middle = 0.5 * float(depth.min() + depth.max())
    return Camera(eye, camera.axes.T @ [across, up, middle])


def _seen(x: np.ndarray, depth: np.ndarray, k: float) -> tuple[float, float]:
    """Where an eye stands, across and along, that just has |x - x_eye| <= k (depth - depth_eye)."""
    right, left = float((x - k * depth).max()), float((-x - k * depth).max())
    return 0.5 * (right - left), -0.5 * (right + left) / k
