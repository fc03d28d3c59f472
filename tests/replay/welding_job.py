"""A job of `pan` from the values of its assumptions, with numpy alone."""

import numpy as np
from welding_cell import EYE, GRIPPER, TORCH, TURN, UP, Seam, pose, segments, turned

OWNERS = ("carrier 1", "carrier 2", "welder")


class Job:
    """Everything but the position of the workpiece.

    ``arm`` is a robot of the cell, ``listed`` the printed positions of the bases (3, 3) [m] and
    ``given`` the values of the assumptions.
    """

    def __init__(self, arm, listed, given, points=None):
        self.arm, self.of = arm, given
        of, Ra = given, given["radius_main"]
        self.count = points or round(of["seam_points"])
        self.seam = Seam(Ra, of["radius_branch"], self.count)
        up = {"bisector": self.seam.bisector, "main_pipe_normal": self.seam.main}
        posture = of["flat_posture"]
        self.R = turned(up[posture], UP) if posture in up else np.tile(EYE, (self.count, 1, 1))
        self.bases = np.tile(np.eye(4), (3, 1, 1))
        self.bases[:, :3, 3] = listed if of["base_transform"] == "inverted" else -listed
        if of["base_orientation"] == "facing_workpiece":
            for base in self.bases:
                x, y = -base[:2, 3] / np.linalg.norm(base[:2, 3])
                base[:2, :2] = [[x, -y], [y, x]]
        self.flanges, self.references = self._poses()

    def _poses(self):
        of, Ra, R = self.of, self.of["radius_main"], self.R
        half, turns = 0.5 * of["workpiece_length"], pose(R, 0.0)
        angle = {"axial": 0.0, "diagonal": np.pi / 4, "side": np.pi / 2}[of["grasp"]]
        flanges, points = [], []
        for base in self.bases[:2]:
            x, y = np.sign(base[:2, 3])
            a = np.array([-x * np.cos(angle), -y * np.sin(angle), 0.0])
            grasp = np.eye(4)
            grasp[:3, :3] = np.column_stack([UP, np.cross(a, UP), a])
            end = np.array([x * half, 0.0, 0.0])
            grasp[:3, 3] = end - (of["gripper_length"] + Ra * np.sin(angle)) * a
            flanges.append(turns @ grasp)
            choices = {"workpiece_origin": 0 * R[:, :, 0], "pipe_end": R @ end}
            points.append(choices.get(of["carrier_reference"], flanges[-1][:, :3, 3]))
        tip = np.einsum("nij,nj->ni", R, self.seam.p)
        ahead = self.bases[2, :2, 3] / np.linalg.norm(self.bases[2, :2, 3])
        axis = -np.einsum("nij,nj->ni", R, self.seam.bisector)
        if of["torch_axis"] == "work_angle_45":
            axis = np.tile(-np.append(ahead, 1.0) / np.sqrt(2), (self.count, 1))
        x = np.append(ahead, 0.0)
        down = np.column_stack([x, np.cross(-UP, x), -UP])
        turn = turned(np.tile(-UP, (self.count, 1)), axis) @ down @ self._bend().T
        flanges.append(pose(turn, tip - turn @ self._torch()[2]))
        return np.stack(flanges), np.stack([*points, tip])

    def _bend(self):
        c, s = (
            np.cos(np.radians(self.of["torch_crank"])),
            np.sin(np.radians(self.of["torch_crank"])),
        )
        return np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])

    def _torch(self):
        middle = 0.5 * self.of["torch_length"] * UP
        return np.array(
            [0 * UP, middle, middle + 0.5 * self.of["torch_length"] * self._bend()[:, 2]]
        )

    def path(self, robot, C):
        """Joints (N, 6) and manipulability (N,) of the best branch within limits, or None."""
        arm, flange = self.arm, self.flanges[robot].copy()
        flange[:, :3, 3] += C
        local, best = np.linalg.inv(self.bases[robot]) @ flange, None
        for q in arm.inverse(local):
            if np.isnan(q).any():
                continue
            q = np.unwrap(q, axis=0)
            middle = 0.5 * (q.min(axis=0) + q.max(axis=0))
            q = q + TURN * np.round((0.5 * (arm.lower + arm.upper) - middle) / TURN)
            if (q < arm.lower).any() or (q > arm.upper).any() or not self._reached(q):
                continue
            steps = np.diff(q, axis=0, append=q[:1])
            steps[-1] -= TURN * np.round(steps[-1] / TURN)
            if abs(steps).max() > TURN / 4:  # past a singularity between two points
                continue
            w = abs(np.linalg.det(arm.jacobian(q, local[:, :3, 3])))
            better = best is None or w.mean() > best[1].mean() * (1 + 1e-12)
            if w.min() > self.of["singularity_threshold"] and better:
                best = q, w
        return best

    def _reached(self, q):
        """Within reach between the points, by an eighth of the largest second difference."""
        frames = self.arm.frames(q)
        r = np.linalg.norm(frames[:, 3, :3, 3] - frames[:, 1, :3, 3], axis=1)
        upper, fore = self.arm.a[2], np.hypot(self.arm.a[3], self.arm.d[3])
        bend = abs(np.roll(r, 1) - 2 * r + np.roll(r, -1)).max() / 8
        return min(upper + fore - r.max(), r.min() - abs(upper - fore)) >= bend

    def fitness(self, C, check=True):
        """The aggregated measure at a position; 0 where a constraint is violated."""
        found = [self.path(robot, C) for robot in range(3)]
        if any(one is None for one in found):
            return 0.0
        q, w = (np.stack(part) for part in zip(*found, strict=True))
        if check and min(self.separations(q, C).values()) <= 0:
            return 0.0
        system = self.measure(q, w)
        return float(system.mean() if self.of["aggregation"] == "mean" else system.min())

    def measure(self, q, w):
        """(16) along the seam (N,), from joints (3, N, 6) and manipulabilities (3, N)."""
        of = self.of
        scale = {"m": 1.0, "mm": 1e9}[of["length_unit"]]
        pair, loose = scale**2 * w[0] * w[1], scale * w[2]
        tight = pair if of["pair_measure"] == "product" else np.sqrt(pair)
        if of["objective"] == "tight":
            return tight
        if of["weights"] == "equal":
            return 0.5 * (tight + loose)
        if of["weights"] == "harmonic":
            return 2 / (1 / tight + 1 / loose)
        A = [self._gram(k, q[k]) for k in range(3)]
        inverse = [np.linalg.det(one) ** -0.5 for one in A]  # common factors cancel
        merge = {"mean": 0.5 * (inverse[0] + inverse[1]), "sum": inverse[0] + inverse[1]}
        coupled = np.linalg.det(np.linalg.inv(A[0]) + np.linalg.inv(A[1])) ** 0.5
        b = merge.get(of["carrier_weight"], coupled)
        return (b * tight + inverse[2] * loose) / (b + inverse[2])

    def _gram(self, robot, q):
        base = self.bases[robot]
        lever = self.references[robot] - self.flanges[robot][:, :3, 3]
        point = self.arm.frames(q)[:, 5, :3, 3] + lever @ base[:3, :3]
        J = np.kron(np.eye(2), base[:3, :3]) @ self.arm.jacobian(q, point)  # in world axes
        J = J[:, : 3 if self.of["ellipsoid_space"] == "translational" else 6]
        return J @ J.transpose(0, 2, 1)

    def bodies(self, q, C):
        """Owner, joint, number, ends (N, 2, 3) in the world and radius of every capsule."""
        of, made, scale = self.of, [], self.of["link_radius_scale"]
        for k, owner in enumerate(OWNERS):
            frames = self.bases[k] @ self.arm.frames(q[k]).transpose(1, 0, 2, 3)
            links = [(j, np.array([a, b]), scale * r) for j, a, b, r in self.arm.capsules]
            if k < 2:
                links.append((6, np.array([0 * UP, of["gripper_length"] * UP]), scale * GRIPPER))
            else:
                flange, bend, _ = self._torch()
                kept = of["torch_length"] - of["torch_exemption"]
                beyond = kept - 0.5 * of["torch_length"]
                lines = [[flange, kept * UP]] if beyond <= 0 else [
                    [flange, bend], [bend, bend + beyond * self._bend()[:, 2]]]  # fmt: skip
                links += [(6, np.array(line), scale * TORCH) for line in lines]
            for n, (j, ends, radius) in enumerate(links):
                T = frames[j - 1]
                world = np.einsum("nij,kj->nki", T[:, :3, :3], ends) + T[:, None, :3, 3]
                name = "torch" if k == 2 and n >= len(self.arm.capsules) else owner
                made.append((owner, name, j, n, world, radius))
        Ra, Rb, L = of["radius_main"], of["radius_branch"], of["workpiece_length"]
        core, ball = max(L / 2 - Ra, 0.0), max((L - Ra) / 2, 0.0)
        rim, x = np.hypot(Ra, L / 2 - ball), np.array([1.0, 0.0, 0.0])
        pipes = [(-core * x, core * x, Ra), (0 * x, (Ra + of["branch_length"]) * UP, Rb),
                 (-ball * x, -ball * x, rim), (ball * x, ball * x, rim)]  # fmt: skip
        for n, (a, b, radius) in enumerate(pipes):
            world = np.einsum("nij,kj->nki", self.R, np.array([a, b])) + C
            made.append(("workpiece", "workpiece", None, n, world, radius))
        return made

    def separations(self, q, C):
        """Smallest distance of every pair of owners along the seam [m]."""
        bodies, found = self.bodies(q, C), {}

        def note(a, b, value):
            found[f"{a} - {b}"] = min(found.get(f"{a} - {b}", np.inf), float(value))

        for i, (owner, name, joint, _, ends, radius) in enumerate(bodies):
            if self.of["floor"] == "present" and (joint is None or joint > 1):
                note(name, "floor", ends[:, :, 2].min() - radius)
            for other, named, second, number, far, wide in bodies[i + 1 :]:
                if joint is None:
                    continue
                if owner == other:
                    if not (min(joint, second) <= 2 and max(joint, second) == 6):
                        continue
                elif other == "workpiece" and number != 1 and owner != "welder" and joint == 6:
                    continue
                gap = segments(ends[:, 0], ends[:, 1], far[:, 0], far[:, 1]) - radius - wide
                note(name, named, gap.min())
        return found


def climbed(job, start, step=0.04, tolerance=1e-3):
    """Best of the six neighbours again and again, the step halved when none is better."""
    best, value = np.array(start, dtype=float), job.fitness(start)
    while step > tolerance:
        tried = [best + step * d for d in np.vstack([EYE, -EYE])]
        values = [job.fitness(C) for C in tried]
        if max(values) > value * (1 + 1e-12):
            value, best = max(values), tried[int(np.argmax(values))]
        else:
            step *= 0.5
    return best, value
