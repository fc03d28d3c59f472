"""Readable twins of the compiled kernels, which the tests compare them with."""

import numpy as np

from dualarm_repro.arms.wrist_geometry import WristGeometry


def unwrapped_reference(
    path: np.ndarray, lower: np.ndarray, upper: np.ndarray
) -> np.ndarray | None:
    """Readable twin of the unwrapping and shifting: the path within limits, or None."""
    path = np.unwrap(path, axis=0)
    centre = 0.5 * (path.min(axis=0) + path.max(axis=0))
    path = path + (2.0 * np.pi) * np.round((0.5 * (lower + upper) - centre) / (2.0 * np.pi))
    return path if ((path >= lower) & (path <= upper)).all() else None


def gram_matrices_reference(
    jacobian: np.ndarray, rotation: np.ndarray, lever: np.ndarray, rows: int
) -> np.ndarray:
    """Twin of ``gram_matrices`` from Jacobians (M, 6, n) in base axes."""
    v, w = rotation @ jacobian[:, :3], rotation @ jacobian[:, 3:]
    moved = v + np.cross(w, lever[:, :, np.newaxis], axis=1)
    J = np.concatenate([moved, w], axis=1)[:, :rows]
    return J @ J.transpose(0, 2, 1)


def closed_form_reference(geometry: WristGeometry, q: np.ndarray) -> np.ndarray:
    """The same in numpy, with angles instead of sums of angles."""
    (l2, *direction2), (l3, *direction3) = geometry.upper_arm, geometry.forearm
    angle2 = np.arctan2(*direction2) + q[:, 1]
    angle3 = np.arctan2(*direction3) + q[:, 1] + geometry.elbow_sign * q[:, 2]
    out = geometry.shoulder[0] + l2 * np.sin(angle2) + l3 * np.sin(angle3)
    wrist = np.prod(geometry.twists, axis=0)[0] * np.sin(np.arctan2(*geometry.turn) + q[:, 4])
    return np.abs(l2 * l3 * np.sin(angle3 - angle2) * out * wrist)
