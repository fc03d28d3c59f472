"""Forward kinematics from printed link transforms, with numpy alone."""

import numpy as np


class Chain:
    """Serial arm whose link transforms are T_i = K_i + C_i cos(theta_i) + S_i sin(theta_i).

    ``mirror`` is the sign with which angles and the y axis count: -1 for the mirror image.
    """

    def __init__(self, links, base=(0.0, 0.0, 0.0), mirror=1.0):
        self.links = links
        self.base = np.asarray(base, dtype=float)
        self.mirror = mirror

    @classmethod
    def of_cells(cls, matrices, base=(0.0, 0.0, 0.0), mirror=1.0):
        """From matrices of cells such as "-sin(theta_2)" or "0.285", one for each joint."""
        return cls([_parts(cells) for cells in matrices], base, mirror)

    @classmethod
    def of_standard_table(cls, d, a, alpha, offset, base=(0.0, 0.0, 0.0)):
        """From a standard table of Denavit and Hartenberg [m, rad]."""
        links = []
        for row in zip(d, a, alpha, offset, strict=True):
            zero, quarter, half = (_standard(angle, *row) for angle in (0.0, np.pi / 2, np.pi))
            constant = 0.5 * (zero + half)
            links.append((constant, zero - constant, quarter - constant))
        return cls(links, base)

    def frames(self, q):
        """Frames 0 ... n (n + 1, 4, 4) from the base; of a mirror image, those before it."""
        made = [np.eye(4)]
        for angle, (constant, cosine, sine) in zip(
            self.mirror * np.asarray(q), self.links, strict=True
        ):
            made.append(made[-1] @ (constant + cosine * np.cos(angle) + sine * np.sin(angle)))
        return np.array(made)

    def origins(self, q, frames):
        """Origins of some frames in the world (K, 3) [m]."""
        found = self.frames(q)[list(frames), :3, 3]
        return found * [1.0, self.mirror, 1.0] + self.base

    def jacobians(self, q, frames):
        """d origin / dq of some frames (K, 3, n): z_j x (p - o_j) for the joints before each, in
        the modified convention, in which the axis of joint j is z of frame j."""
        made = self.frames(q)
        axes, places = made[1:, :3, 2], made[1:, :3, 3]
        found = np.zeros((len(frames), 3, len(axes)))
        for row, k in zip(found, frames, strict=True):
            arms = made[k, :3, 3] - places[: k - 1]
            row[:, : k - 1] = np.cross(axes[: k - 1], arms).T
        flip = np.array([1.0, self.mirror, 1.0])[:, np.newaxis]
        return self.mirror * flip * found


def _parts(cells):
    def at(cos, sin):
        names = {"cos": lambda _: cos, "sin": lambda _: sin, "__builtins__": {}}
        names |= {f"theta_{k}": 0.0 for k in range(1, 10)}
        return np.array([[float(eval(cell, names)) for cell in row] for row in cells])

    constant = at(0.0, 0.0)
    return constant, at(1.0, 0.0) - constant, at(0.0, 1.0) - constant


def _standard(angle, d, a, alpha, offset):
    c, s, ca, sa = np.cos(angle + offset), np.sin(angle + offset), np.cos(alpha), np.sin(alpha)
    return np.array(
        [[c, -s * ca, s * sa, a * c], [s, c * ca, -c * sa, a * s], [0, sa, ca, d], [0, 0, 0, 1]]
    )
