"""Descent of the potentials of `xue`, written once more, with numpy alone.

What the ledger does not export is said here: steps are halved until the potential falls by a
ten-thousandth of what the gradient predicts; a block has 50 steps; the virtual point acts for 200
steps and is tried 3 times; the traditional method arrives within 0.02 m.
"""

from dataclasses import dataclass

import numpy as np
from fields import inverse_distance, to_points

DECREASE, HALVINGS, ROUNDING = 1e-4, 40, 1e-12
BLOCK, VIRTUAL_STEPS, VIRTUAL_TRIES, NEAR = 50, 200, 3, 0.02


@dataclass
class Field:
    """Attraction (9) or (13), repulsion (10) or (14) of some frames, and a virtual point."""

    chain: object
    goal: np.ndarray
    frames: tuple
    joints: float
    boxes: object
    moving: np.ndarray
    gains: dict
    virtual: np.ndarray | None = None

    def __post_init__(self):
        self.target = self.chain.origins(self.goal, [6])[0]

    def value_and_gradient(self, q, step, virtual, slope=True):
        """U and dU/dq at a step, to which the other arm has moved."""
        k_a, k_r, d_0 = self.gains["k_a"], self.gains["k_r"], self.gains["d_0"]
        X = self.chain.origins(q, [6])[0]
        value = (
            0.5
            * k_a
            * (np.sum((X - self.target) ** 2) + self.joints * np.sum((q - self.goal) ** 2))
        )
        pull = k_a * (X - self.target)
        if virtual:
            value += 0.5 * self.gains["k_w"] * np.sum((X - self.virtual) ** 2)
            pull = pull + self.gains["k_w"] * (X - self.virtual)
        points = self.chain.origins(q, self.frames)
        found = [self.boxes.distances(points)]
        if len(self.moving):
            found.append(to_points(points, self.moving[min(step, len(self.moving) - 1)]))
        push = np.zeros_like(points)
        for distance, way in found:
            energy, falls = inverse_distance(distance, k_r, d_0)
            value += energy.sum()
            push += (falls[..., np.newaxis] * way).sum(axis=1)
        if not slope:
            return value, None
        gradient = pull @ self.chain.jacobians(q, [6])[0]
        gradient = gradient + np.einsum("ki,kij->j", push, self.chain.jacobians(q, self.frames))
        return value, gradient + k_a * self.joints * (q - self.goal)


def descend(field, start, settings):
    """Whether the arm arrives, and after how many steps."""
    path, since, active, tries = [np.array(start, dtype=float)], 0, False, 0
    while True:
        q, step = path[-1], len(path) - 1
        X = field.chain.origins(q, [6])[0]
        if not active and _arrived(field, q, X, settings):
            return True, step
        if step == settings["step_limit"]:
            return False, step
        stuck = step >= len(field.moving) - 1 and _still(path, step - since, settings["threshold"])
        if active:
            if (
                np.linalg.norm(X - field.virtual) <= settings["release"]
                or step - since >= VIRTUAL_STEPS
            ):
                active, since = False, step
        elif stuck:
            if field.virtual is None or tries == VIRTUAL_TRIES:
                return False, step
            active, since, tries = True, step, tries + 1
        path.append(_next(field, q, step, active, settings))


def _arrived(field, q, X, settings):
    if field.joints:
        return np.abs(q - field.goal).max() <= settings["tolerance"]
    return np.linalg.norm(X - field.target) <= NEAR


def _still(path, walked, threshold):
    if walked < 2 * BLOCK or walked % BLOCK:
        return False
    last, before = np.array(path[-BLOCK:]), np.array(path[-2 * BLOCK : -BLOCK])
    return bool(np.abs(last.sum(axis=0) - before.sum(axis=0)).max() < threshold * BLOCK)


def _next(field, q, step, active, settings):
    here, g = field.value_and_gradient(q, step, active)
    length = np.linalg.norm(g)
    if length == 0.0:
        return q
    t = min(settings["gain"], settings["max_step"] / length)
    for _ in range(HALVINGS + 1):
        trial = q - t * g
        predicted = g @ (trial - q)
        if -predicted <= ROUNDING * here:
            break
        if field.value_and_gradient(trial, step, active, False)[0] <= here + DECREASE * predicted:
            return trial
        t *= 0.5
    return q
