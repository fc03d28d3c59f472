"""The cell of `pan` with numpy alone: seam, arms, inverse kinematics, measure, separations."""

import numpy as np

EYE, UP = np.eye(3), np.array([0.0, 0.0, 1.0])
GRIPPER, TORCH = 0.06, 0.02  # radii [m]
TURN = 2 * np.pi


def turned(a, b):
    """Smallest rotations (N, 3, 3) of unit vectors a (N, 3) to b (3,) or (N, 3)."""
    a, b = np.broadcast_arrays(a, b)
    v, c = np.cross(a, b), np.sum(a * b, axis=1)[:, None, None]
    K = np.zeros((len(v), 3, 3))
    K[:, 0, 1], K[:, 0, 2], K[:, 1, 2] = -v[:, 2], v[:, 1], -v[:, 0]
    K -= K.transpose(0, 2, 1)
    return EYE + K + K @ K / (1 + c)


def pose(R, p):
    """Homogeneous (N, 4, 4)."""
    made = np.zeros((len(R), 4, 4))
    made[:, :3, :3], made[:, :3, 3], made[:, 3, 3] = R, p, 1.0
    return made


class Seam:
    """Points and outward normals of main pipe and branch (N, 3)."""

    def __init__(self, Ra, Rb, count):
        t = TURN * np.arange(count) / count
        y = Rb * np.sin(t)
        z = np.sqrt(Ra**2 - y**2)
        self.p = np.column_stack([Rb * np.cos(t), y, z])
        self.main = np.column_stack([0 * t, y, z]) / Ra
        self.branch = np.column_stack([np.cos(t), np.sin(t), 0 * t])
        both = self.main + self.branch
        self.bisector = both / np.linalg.norm(both, axis=1, keepdims=True)


class Arm:
    """Six joints, modified convention; rows alpha, a, d, offset, lower, upper [rad, m]."""

    def __init__(self, table, capsules):
        self.alpha, self.a, self.d, self.offset, self.lower, self.upper = table
        self.capsules = capsules  # (joint, start, end, radius)

    def frames(self, q):
        """Frames 1 ... 6 of rows q (N, 6), (N, 6, 4, 4)."""
        T, made = np.tile(np.eye(4), (len(q), 1, 1)), []
        for j in range(6):
            t, ca, sa = q[:, j] + self.offset[j], np.cos(self.alpha[j]), np.sin(self.alpha[j])
            step = np.zeros((len(q), 4, 4))
            step[:, 0, :2] = np.column_stack([np.cos(t), -np.sin(t)])
            step[:, 0, 3] = self.a[j]
            step[:, 1, :3] = np.column_stack([np.sin(t) * ca, np.cos(t) * ca, np.full(len(q), -sa)])
            step[:, 2, :3] = np.column_stack([np.sin(t) * sa, np.cos(t) * sa, np.full(len(q), ca)])
            step[:, 1:3, 3], step[:, 3, 3] = [-sa * self.d[j], ca * self.d[j]], 1.0
            T = T @ step
            made.append(T)
        return np.stack(made, axis=1)

    def jacobian(self, q, point):
        """(N, 6, 6) at points (N, 3) in the base frame."""
        F = self.frames(q)
        z, o = F[:, :, :3, 2], F[:, :, :3, 3]
        linear = np.cross(z, point[:, None] - o)
        return np.concatenate([linear, z], axis=2).transpose(0, 2, 1)

    def inverse(self, T):
        """All eight branches for flange poses (N, 4, 4), (8, N, 6), NaN out of reach.

        Wrist centre, then two links in the plane of the arm, then the wrist.
        """
        wrist = T[:, :3, 3] - self.d[5] * T[:, :3, 2]
        fore = np.hypot(self.a[3], self.d[3])
        made = []
        for side in (0.0, np.pi):
            q1 = np.arctan2(wrist[:, 1], wrist[:, 0]) + side - self.offset[0]
            sign = 1.0 if side == 0 else -1.0
            x = sign * np.hypot(wrist[:, 0], wrist[:, 1]) - self.a[1]
            z = wrist[:, 2] - self.d[0]
            with np.errstate(invalid="ignore"):
                inner = np.arccos((x**2 + z**2 - self.a[2] ** 2 - fore**2) / (2 * self.a[2] * fore))
            for elbow in (1.0, -1.0):
                bend = elbow * inner  # from the upper arm to the forearm, downwards
                pitch = np.arctan2(-z, x) - np.arctan2(
                    fore * np.sin(bend), self.a[2] + fore * np.cos(bend)
                )
                q2, q3 = pitch - self.offset[1], bend - np.arctan2(self.d[3], self.a[3])
                q3 = q3 - self.offset[2]
                q = np.column_stack([q1, q2, q3, *np.zeros((3, len(q1)))])
                R = np.einsum("nji,njk->nik", self.frames(q)[:, 2, :3, :3], T[:, :3, :3])
                # R = Rx(-90) Rz(4) Rx(90) Rz(5) Rx(-90) Rz(6)
                axis = R[:, :, 2]
                for flip in (1.0, -1.0):
                    s5 = flip * np.hypot(axis[:, 0], axis[:, 2])
                    q5 = np.arctan2(s5, axis[:, 1])
                    q4 = np.arctan2(flip * axis[:, 2], -flip * axis[:, 0])
                    q6 = np.arctan2(-flip * R[:, 1, 1], flip * R[:, 1, 0])
                    made.append(
                        np.column_stack(
                            [q1, q2, q3, *(np.array([q4, q5, q6]) - self.offset[3:, None])]
                        )
                    )
        return np.array(made)


def segments(p, r, q, s):
    """Distances of segments p + t (r - p) and q + u (s - q), (..., 3) -> (...)."""
    u, v, w = r - p, s - q, p - q
    a, b, c = (np.sum(x * y, -1) for x, y in ((u, u), (u, v), (v, v)))
    d, e = np.sum(u * w, -1), np.sum(v * w, -1)
    tiny = 1e-14
    den = a * c - b * b
    t = np.where(den > tiny, (b * e - c * d) / np.where(den > tiny, den, 1), 0.0).clip(0, 1)
    n = np.where(c > tiny, (b * t + e) / np.where(c > tiny, c, 1), 0.0).clip(0, 1)
    t = np.where(a > tiny, (b * n - d) / np.where(a > tiny, a, 1), 0.0).clip(0, 1)
    n = np.where(c > tiny, (b * t + e) / np.where(c > tiny, c, 1), 0.0).clip(0, 1)
    return np.linalg.norm(w + t[..., None] * u - n[..., None] * v, axis=-1)
