"""Joint frames of serial chains in which some joints slide along their axis.

T(q) = C_0 M_1(q_1) C_1 ... M_n(q_n) C_n with M_j(q) = Rz(q) for a joint that turns [rad] and
Tz(q) for one that slides [m].
"""

from __future__ import annotations

import numpy as np

from ..kernel import kernel


@kernel
def sliding_frames(chain, base, q):
    """Frames of the base and of the joints, F_0 = base, F_j = F_(j-1) C_(j-1) M_j(q_j).

    Parameters
    ----------
    base : (3, 4)
    q : (N, n) [rad, m]

    Returns
    -------
    ndarray (N, n+1, 3, 4)
        Rotation and origin; z is the axis of every joint.
    """
    count, joints = q.shape
    frames = np.empty((count, joints + 1, 3, 4))
    for n in range(count):
        frames[n, 0] = base
        for j in range(joints):
            F, G, C, t = frames[n, j], frames[n, j + 1], chain.rotation[j], chain.translation[j]
            s, c, slide = np.sin(q[n, j]), np.cos(q[n, j]), 0.0
            if chain.slides[j]:
                s, c, slide = 0.0, 1.0, q[n, j]
            for r in range(3):
                x = F[r, 0] * C[0, 0] + F[r, 1] * C[1, 0] + F[r, 2] * C[2, 0]
                y = F[r, 0] * C[0, 1] + F[r, 1] * C[1, 1] + F[r, 2] * C[2, 1]
                G[r, 0], G[r, 1] = c * x + s * y, c * y - s * x
                G[r, 2] = F[r, 0] * C[0, 2] + F[r, 1] * C[1, 2] + F[r, 2] * C[2, 2]
                G[r, 3] = F[r, 0] * t[0] + F[r, 1] * t[1] + F[r, 2] * t[2] + F[r, 3]
                G[r, 3] += slide * G[r, 2]
    return frames
