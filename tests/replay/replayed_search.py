"""The search of the document `qiu` in plain numpy, from the words of its ledger; nothing of the
project."""

import numpy as np

CONTACT, PROGRESS = 1e-3, 1e-3


class Field:
    """Attraction in joint space and repulsion of three points by the nearest sphere."""

    def __init__(self, arm, centres, radius, printed, assumed):
        self.arm, self.centres, self.radius = arm, centres, radius
        self.printed, self.assumed = printed, assumed
        expected = {
            "attraction_form": "norm",
            "repulsion_sources": "nearest",
            "control_points": "elbow_wrist_flange",
        }
        other = {key: assumed[key] for key, value in expected.items() if assumed[key] != value}
        assert not other, f"the replay knows no {other}"

    def attraction(self, q, goal):
        error, threshold = q - goal, self.printed["d"]
        size = np.linalg.norm(error)
        return -self.printed["zeta"] * error * min(1.0, threshold / size if size > 0.0 else 1.0)

    def repulsion(self, q, factors=(1.0, 1.0, 1.0)):
        """Torques (6,) and the distances of the points (3,)."""
        torque, seen = np.zeros(6), []
        gain, rho0 = self.assumed["gain_ratio"] * self.printed["zeta"], self.printed["rho0"]
        for factor, (point, jacobian) in zip(factors, self.arm.points(q, (3, 5, 7)), strict=True):
            away = point - self.centres
            lengths = np.linalg.norm(away, axis=1)
            near = int(lengths.argmin())
            rho = lengths[near] - self.radius
            seen.append(rho)
            if rho < rho0:
                least = max(rho, CONTACT)
                size = factor * gain * (1.0 / least - 1.0 / rho0) / least**2
                torque += jacobian.T @ (size * away[near] / lengths[near])
        return torque, np.array(seen)


class Half:
    """One end of a search: where it is, which way it went, and its flips."""

    def __init__(self, field, q, improved):
        self.field, self.improved = field, improved
        self.path, self.direction = [np.array(q, dtype=float)], None
        self.flips, self.flip_distance = 0, np.full(3, np.inf)

    def step(self, goal):
        q, a = self.path[-1], self.field.assumed
        _, rho = self.field.repulsion(q)
        factors = np.ones(3)
        if self.improved and self.flips:
            assert a["gain_rule"] == "power"
            inside = np.abs(rho - self.flip_distance) <= a["delta_rho"]
            factors[inside] = a["kappa"] ** self.flips
        force = self.field.attraction(q, goal) + self.field.repulsion(q, factors)[0]
        direction = force / np.linalg.norm(force)
        if self.direction is not None and direction @ self.direction < 0.0:
            self.flips, self.flip_distance = self.flips + 1, rho
        self.direction = direction
        moved = q + self._length(rho) * direction
        if a.get("limits") == "kept":
            moved = np.clip(moved, *self.field.arm.limits.T)
        self.path.append(moved)

    def _length(self, rho):
        first, a = self.field.printed["alpha0"], self.field.assumed
        if not self.improved or a["adaptive_step"] == "constant":
            return first
        assert a["adaptive_step"] == "saturating"
        tau = np.array(a["weights"], dtype=float) / sum(a["weights"])
        share = tau @ np.minimum(1.0, rho / self.field.printed["rho0"])
        return first * max(share, a["step_floor"])


def search(field, start, goal, improved):
    """Whether the search arrives, and its path (N, 6): forward half, backward half turned round."""
    a = field.assumed
    assert a["update_order"] == "before"
    assert a["flip_rule"] == "negative"
    forward, backward = Half(field, start, improved), Half(field, goal, improved)
    closest, since = np.inf, 0
    for turn in range(round(a["search_cap"]) + 1):
        ends = forward.path[-1], backward.path[-1] if improved else goal
        gap = np.linalg.norm(ends[0] - ends[1])
        if gap < closest - PROGRESS:
            closest, since = gap, turn
        if gap <= a["joint_tolerance"] or turn - since >= round(a["stuck_rule"]):
            break
        if turn == round(a["search_cap"]):
            break
        forward.step(ends[1])
        if improved:
            backward.step(ends[0])
    path = [*forward.path, *(backward.path[::-1] if improved else [])]
    return gap <= a["joint_tolerance"], np.array(path)
