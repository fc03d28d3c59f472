"""Two Pandas read from the XML of their URDF: chains, capsules, distances and rows, in numpy."""

import sysconfig
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np

#: Radii with which the capsules of the Panda contain hand and base as well.
WIDER = {"panda_hand": 0.057, "panda_link0": 0.101}


def urdf():
    """The collision model that comes with example-robot-data."""
    folder = Path(sysconfig.get_paths()["purelib"]) / "cmeel.prefix" / "share"
    return folder / "example-robot-data/robots/panda_description/urdf/panda_collision.urdf"


class Panda:
    """Seven joints, the flange panda_link8 and twelve capsules, on a base that is shifted."""

    def __init__(self, base):
        root = ET.parse(urdf()).getroot()
        self.base = np.eye(4)
        self.base[:3, 3] = base
        joints = [one for one in root.iter("joint") if one.find("parent") is not None]
        self.above = {one.find("child").get("link"): one for one in joints}
        turning = [one for one in joints if one.get("type") == "revolute"]
        self.names = [one.get("name") for one in turning]
        limits = [one.find("limit") for one in turning]
        self.lower, self.upper, self.speed = (
            np.array([float(one.get(key)) for one in limits])
            for key in ("lower", "upper", "velocity")
        )
        self.capsules = self._capsules(root)

    def _capsules(self, root):
        found = []
        for link in root.iter("link"):
            name = link.get("name")
            for shape in link.findall("collision"):
                body = shape.find("geometry").find("cylinder")
                if body is None:
                    continue
                half, radius = 0.5 * float(body.get("length")), float(body.get("radius"))
                place = _placement(shape.find("origin"))
                ends = [place @ [0.0, 0.0, sign * half, 1.0] for sign in (-1.0, 1.0)]
                found.append((name, np.array(ends)[:, :3], radius))
        fingers = [one for one in found if "finger" in one[0]]
        kept = [(n, ends, WIDER.get(n, r)) for n, ends, r in found if "finger" not in n]
        # One capsule stands for both fingers, in the frame of the hand.
        placed = [self._up(n, "panda_hand") for n, _, _ in fingers]
        middles = [
            T[:3, :3] @ ends.mean(axis=0) + T[:3, 3]
            for T, (_, ends, _) in zip(placed, fingers, strict=True)
        ]
        middle, half = (
            np.mean(middles, axis=0),
            0.5 * np.linalg.norm(np.diff(fingers[0][1], axis=0)),
        )
        radius = np.linalg.norm(middles[0] - middle) + fingers[0][2]
        along = np.array([0.0, 0.0, half])
        return [*kept, ("panda_hand", np.array([middle - along, middle + along]), radius)]

    def _up(self, link, ancestor):
        made = np.eye(4)
        while link != ancestor:
            joint = self.above[link]
            made = _placement(joint.find("origin")) @ made
            link = joint.find("parent").get("link")
        return made

    def frames(self, q):
        """Link to its frame (4, 4), and the frame of every joint before it turns (7, 4, 4)."""
        made, axes = {"panda_link0": self.base}, np.empty((7, 4, 4))
        waiting = dict(self.above)
        while waiting:
            for link, joint in list(waiting.items()):
                parent = joint.find("parent").get("link")
                if parent not in made:
                    continue
                frame = made[parent] @ _placement(joint.find("origin"))
                if joint.get("name") in self.names:
                    k = self.names.index(joint.get("name"))
                    axes[k] = frame
                    frame = frame @ _about_z(q[k])
                made[link] = frame
                del waiting[link]
        return made, axes

    def state(self, q):
        """Flange, cores (12, 2, 3), joints before each capsule (12,), joint axes and origins."""
        frames, axes = self.frames(q)
        cores = np.array(
            [ends @ frames[n][:3, :3].T + frames[n][:3, 3] for n, ends, _ in self.capsules]
        )
        before = [self._joints_before(name) for name, _, _ in self.capsules]
        return frames["panda_link8"][:3, 3], cores, before, axes[:, :3, 2], axes[:, :3, 3]

    def _joints_before(self, link):
        count = 0
        while link in self.above:
            count += self.above[link].get("name") in self.names
            link = self.above[link].find("parent").get("link")
        return count


def point_jacobian(axes, origins, before, point):
    """Velocity of a point of a link per joint speed (3, 7)."""
    made = np.zeros((3, 7))
    made[:, :before] = np.cross(axes[:before], point - origins[:before]).T
    return made


def closest(a, b):
    """Nearest points of segments a and b (P, 2, 3), pair by pair."""
    u, v, w = a[:, 1] - a[:, 0], b[:, 1] - b[:, 0], a[:, 0] - b[:, 0]
    uu, vv, uv = (u * u).sum(1), (v * v).sum(1), (u * v).sum(1)
    uw, vw = (u * w).sum(1), (v * w).sum(1)
    wide = uu * vv - uv**2
    s = np.clip(
        np.where(wide > 1e-14, (uv * vw - vv * uw) / np.where(wide > 1e-14, wide, 1), 0), 0, 1
    )
    t = (uv * s + vw) / vv
    clipped = np.clip(t, 0, 1)
    s = np.where(t == clipped, s, np.clip((uv * clipped - uw) / uu, 0, 1))
    return a[:, 0] + s[:, None] * u, b[:, 0] + clipped[:, None] * v


class Pair:
    """Two arms side by side, every link of one against every link of the other but both bases."""

    def __init__(self, distance):
        self.arms = [Panda((0.0, side * distance / 2, 0.0)) for side in (1.0, -1.0)]
        radii = np.array([r for _, _, r in self.arms[0].capsules])
        count = len(radii)
        every = [(i, j) for i in range(count) for j in range(count)]
        fixed = [k for k, (n, _, _) in enumerate(self.arms[0].capsules) if n == "panda_link0"]
        self.rows = np.array([p for p in every if not (p[0] in fixed and p[1] in fixed)])
        self.thick = radii[self.rows].sum(axis=1)

    def look(self, q):
        """Tips (2, 3), surface distances (P,), J (6, 14) and gradients of the distances (P, 14)."""
        states = [arm.state(part) for arm, part in zip(self.arms, np.split(q, 2), strict=True)]
        (_, left, left_before, *left_joints), (_, right, right_before, *right_joints) = states
        i, j = self.rows.T
        p, o = closest(left[i], right[j])
        gap = p - o
        length = np.linalg.norm(gap, axis=1)
        gradient = np.zeros((len(i), 14))
        for k in range(len(i)):
            n = gap[k] / length[k]
            gradient[k, :7] = n @ point_jacobian(*left_joints, left_before[i[k]], p[k])
            gradient[k, 7:] = -n @ point_jacobian(*right_joints, right_before[j[k]], o[k])
        J = np.zeros((6, 14))
        for side, (tip, _, _, *joints) in enumerate(states):
            J[3 * side : 3 * side + 3, 7 * side : 7 * side + 7] = point_jacobian(*joints, 7, tip)
        return np.array([s[0] for s in states]), length - self.thick, J, gradient

    def distance(self, q):
        """Tips and smallest surface distance alone."""
        states = [arm.state(part) for arm, part in zip(self.arms, np.split(q, 2), strict=True)]
        p, o = closest(states[0][1][self.rows[:, 0]], states[1][1][self.rows[:, 1]])
        least = (np.linalg.norm(p - o, axis=1) - self.thick).min()
        return np.array([s[0] for s in states]), float(least)


def optimality_residual(x, A, b, C, d, tolerance=1e-6):
    """How far x is from the minimiser of |x|^2 under A x = b, C x <= d: violation, stationarity."""
    violation = max(np.abs(A @ x - b).max(), (C @ x - d).max(initial=0.0))
    tight = np.flatnonzero(C @ x - d > -tolerance)
    while True:
        columns = np.vstack([A, C[tight]]).T
        found = np.linalg.lstsq(columns, -x, rcond=None)[0]
        signs = found[len(A) :]
        if not len(signs) or signs.min() > -1e-7:
            return max(violation, np.abs(columns @ found + x).max())
        tight = np.delete(tight, signs.argmin())


def _placement(origin):
    made = np.eye(4)
    if origin is None:
        return made
    x, y, z = map(float, origin.get("rpy", "0 0 0").split())
    made[:3, :3] = _about_z(z)[:3, :3] @ _about_y(y) @ _about_x(x)
    made[:3, 3] = [float(v) for v in origin.get("xyz", "0 0 0").split()]
    return made


def _about_z(angle):
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1.0]])


def _about_y(angle):
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])


def _about_x(angle):
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[1, 0, 0], [0, c, -s], [0, s, c]])
