"""An arm of rotary joints and its capsules in plain numpy, from its table; nothing of the project.

Standard convention: A_i = Rz(theta_i) Tz(d_i) Tx(a_i) Rx(alpha_i). A capsule of joint i is fixed to
the frame before d_i, after theta_i.
"""

from itertools import combinations, pairwise

import numpy as np
import yaml


def angle(value):
    """An angle [rad] as robot files write it: a number, ``-pi/2``, ``90 deg``."""
    text = str(value).strip()
    if text.endswith("deg"):
        return np.deg2rad(float(text[:-3]))
    sign, text = (-1.0, text[1:]) if text.startswith("-") else (1.0, text)
    if text.startswith("pi"):
        return sign * np.pi / float(text[3:] or 1)
    return sign * float(text)


class Arm:
    """One placed arm; a posture is (6,) [rad], lengths are metres."""

    def __init__(self, robot_file, base, yaw_deg):
        table = yaml.safe_load(robot_file.read_text(encoding="utf-8"))
        joints = table["joints"]
        self.offset, self.alpha = (
            np.array([angle(joint[key]) for joint in joints]) for key in ("offset", "alpha")
        )
        self.d, self.a = (np.array([float(j[key]) for j in joints]) for key in ("d", "a"))
        self.limits = np.array([[angle(j["lower"]), angle(j["upper"])] for j in joints])
        self.capsules = table["capsules"]
        turn = np.deg2rad(yaw_deg)
        self.base = np.eye(4)
        self.base[:2, :2] = [[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]]
        self.base[:3, 3] = base

    def frames(self, q):
        """Frames 0 ... 6 of the table, and the turned frames of the joints 0 ... 6."""
        frames, turned = [self.base], [self.base]
        for k, theta in enumerate(q + self.offset):
            c, s, ca, sa = (
                np.cos(theta),
                np.sin(theta),
                np.cos(self.alpha[k]),
                np.sin(self.alpha[k]),
            )
            turn, rest = np.eye(4), np.eye(4)
            turn[:2, :2] = [[c, -s], [s, c]]
            rest[:3, 3] = self.a[k], 0.0, self.d[k]
            rest[1:3, 1:3] = [[ca, -sa], [sa, ca]]
            turned.append(frames[-1] @ turn)
            frames.append(turned[-1] @ rest)
        return frames, turned

    def points(self, q, numbers):
        """Origins of joints (7 is the flange) and the Jacobians of their velocities."""
        frames, _ = self.frames(q)
        for number in numbers:
            point, jacobian = frames[number - 1][:3, 3], np.zeros((3, len(q)))
            for j in range(number - 1):
                axis, origin = frames[j][:3, 2], frames[j][:3, 3]
                jacobian[:, j] = np.cross(axis, point - origin)
            yield point, jacobian

    def cores(self, q):
        """Ends of the cores of the capsules (C, 2, 3)."""
        _, turned = self.frames(q)
        ends = [
            [turned[c["joint"]] @ [*c[key], 1.0] for key in ("start", "end")] for c in self.capsules
        ]
        return np.array(ends)[..., :3]

    @property
    def radii(self):
        """Radii of the capsules (C,)."""
        return np.array([c["radius"] for c in self.capsules])


def segment_distance(p, q, r, s):
    """Distance of the segments pq and rs, by the minimum over the corners, edges and inside of the
    square of their parameters."""
    u, v, w = q - p, s - r, p - r
    a, b, c, d, e = u @ u, u @ v, v @ v, u @ w, v @ w
    tried = []
    for t in (0.0, 1.0):
        tried.append((t, np.clip((b * t + e) / c, 0.0, 1.0) if c > 0.0 else 0.0))
        tried.append((np.clip((b * t - d) / a, 0.0, 1.0) if a > 0.0 else 0.0, t))
    det = a * c - b * b
    if det > 1e-14:
        inner = (b * e - c * d) / det, (a * e - b * d) / det
        if all(0.0 <= x <= 1.0 for x in inner):
            tried.append(inner)
    return min(np.linalg.norm(w + x * u - y * v) for x, y in tried)


def arm_to_arm(one, q, other, p):
    """Smallest distance of the links of two arms, their bases apart, of which none ever moves."""
    ends, radii = (one.cores(q), other.cores(p)), (one.radii, other.radii)
    pairs = [
        segment_distance(*ends[0][i], *ends[1][k]) - radii[0][i] - radii[1][k]
        for i, first in enumerate(one.capsules)
        for k, second in enumerate(other.capsules)
        if first["joint"] or second["joint"]
    ]
    return min(pairs)


def to_itself(arm, q, pairs):
    """Smallest distance of the links of an arm to each other, in these pairs."""
    ends, radii = arm.cores(q), arm.radii
    return min(segment_distance(*ends[i], *ends[k]) - radii[i] - radii[k] for i, k in pairs)


def apart_somewhere(arm):
    """Pairs of links that are no neighbours and do not overlap in every posture."""
    postures = np.random.default_rng(0).uniform(*arm.limits.T, (40, len(arm.limits)))
    return [
        (i, k)
        for (i, one), (k, other) in combinations(enumerate(arm.capsules), 2)
        if other["joint"] - one["joint"] > 1
        and max(to_itself(arm, q, [(i, k)]) for q in postures) > 0.0
    ]


def arm_to_spheres(arm, q, centres, radius):
    """Smallest distance of the links of an arm to spheres."""
    found = [
        segment_distance(start, end, centre, centre) - r - radius
        for (start, end), r in zip(arm.cores(q), arm.radii, strict=True)
        for centre in centres
    ]
    return min(found)


def densified(path, most=0.02):
    """Samples between the rows (N, n) so that no joint moves more than ``most`` [rad]."""
    rows = [path[:1]]
    for start, end in pairwise(path):
        pieces = max(int(np.ceil(np.abs(end - start).max() / most)), 1)
        rows.append(start + np.arange(1, pieces + 1)[:, np.newaxis] / pieces * (end - start))
    return np.vstack(rows)
