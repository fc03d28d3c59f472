"""Equations of the motion: forward map, velocities, the objective."""

from __future__ import annotations

from functools import partial

import numpy as np
import pandas as pd
import pinocchio as pin

from ...control.controller import VelocityController
from ...control.problem import QuadraticProgram
from ...control.settings import ControllerSettings
from ...control.simulate import pseudo_inverse
from ...control.system import ArmSystem
from ...ledger import REGISTRY, Assumed, Bounded, NoOriginal, Residual, Result
from ...ledger.formula import Formula, parse
from .constants import COARSE_STEP, SEED
from .scenario import CROSSING, Frozen, frozen, run

checks = partial(REGISTRY.checks, page="patent/problem")
STILL = np.zeros((2, 3))
_DIFFERENCE = 1e-6  # [rad] step of central differences


@checks(
    "patent.eq_forward",
    rules=[
        Residual("apart", "both printed sides agree, to [m]", high=1e-12),
        Bounded("other_solution", "another solution for the same r is this far "
            "[rad]", low="other"),
        Residual("same_tips", "and has the same r, to [m]", high=1e-6),
    ],
)  # fmt: skip
def forward_map(assumed: Assumed) -> Result:
    """f of Pinocchio and r of the controller in the printed equation; a second theta."""
    printed = parse(REGISTRY.printed("patent.eq_forward")["formula"])
    rows = [_forward(printed, scenario) for scenario in _scenarios()]
    other = min(row[1] for row in rows)
    system = _scenarios()[0].system
    return Result(
        obtained={
            "apart": max(row[0] for row in rows),
            "other_solution": other,
            "same_tips": max(row[2] for row in rows),
            "unknowns": system.nq,
            "equations": 3 * len(system.arms),
        },
        caption=(
            f"The printed {printed.text} holds for {len(rows)} makes of arm: the map from "
            f"{system.nq} joint angles to {3 * len(system.arms)} tip coordinates agrees with "
            f"Pinocchio. It has no inverse: at least {other:.2f} rad away lies another posture "
            "with the same tips, reached by a motion of the joints alone. That is why the text "
            "turns to velocities, although it words f as the inverse map."
        ),
    )


@checks(
    "patent.eq_velocity",
    rules=[
        Residual("difference", "J theta' is the derivative of f, to [m/rad]", high=1e-6),
        Bounded("coupling", "entries that couple one arm to the other's tip", high=0.0),
        NoOriginal("formula", "the equation of velocities"),
    ],
)
def velocity_map(assumed: Assumed) -> Result:
    """J of both arms against central differences of f at random configurations."""
    rng = np.random.default_rng(SEED)
    worst, coupling = 0.0, 0.0
    for scenario in _scenarios():
        system = scenario.system
        controller = VelocityController(system)
        for _ in range(20):
            q = random_configuration(system, rng)
            J = controller.problem(q, system.tips(q), STILL).A
            for k in range(system.nq):
                step = _DIFFERENCE * np.eye(system.nq)[k]
                column = (system.tips(q + step) - system.tips(q - step)).ravel()
                difference = np.abs(column / (2 * _DIFFERENCE) - J[:, k]).max()
                worst = max(worst, float(difference))
            n = system.arrays.start[1]
            blocks = (J[:3, n:], J[3:, :n])
            coupling = max(coupling, *(float(np.abs(block).max()) for block in blocks))
    return Result(
        obtained={"difference": worst, "coupling": coupling},
        caption=(
            "The words between the lost formulas say what is differentiated: f by time. The block "
            f"matrix of both Jacobians equals central differences of f to {worst:.1e} m/rad on 20 "
            f"random configurations of {len(_scenarios())} makes of arm."
        ),
    )


@checks(
    "patent.eq_min_energy",
    rules=[
        Bounded("excess", "no joint velocity with the same tip velocity is smaller", high=1e-9),
        Residual("to_pseudo_inverse", "distance to J^+ dr/dt [rad/s]", high=1e-9),
        NoOriginal("formula", "the objective"),
    ],
)
def least_velocity(assumed: Assumed) -> Result:
    """Minimiser of the weighted norm under the task alone, and its drift over five turns."""
    scenario = frozen("crossing")
    system = scenario.system
    worst, excess = 0.0, 0.0
    rng = np.random.default_rng(SEED)
    controller = VelocityController(system, pseudo_inverse(ControllerSettings()))
    for _ in range(20):
        q, velocity = random_configuration(system, rng), rng.normal(size=(2, 3))
        p = controller.problem(q, system.tips(q), velocity)
        least = np.linalg.pinv(p.A) @ p.b
        x = least if assumed["energy_weight"] == "identity" else _inertia_weighted(system, q, p)
        worst = max(worst, float(np.abs(x - least).max()))
        excess = max(excess, float(np.linalg.norm(x) - np.linalg.norm(least)))
        if assumed["energy_weight"] == "identity":
            worst = max(
                worst, float(np.abs(controller.velocity(q, system.tips(q), velocity) - x).max())
            )
    drifts = {weight: _drift(scenario, weight) for weight in (0.0, 2.0)}
    return Result(
        obtained={"excess": excess, "to_pseudo_inverse": worst, **_named(drifts)},
        table=pd.DataFrame(
            [(turn + 1, *(drifts[w][turn] for w in drifts)) for turn in range(5)],
            columns=["turn", "drift [rad]", "drift with repetitive term [rad]"],
        ),
        caption=(
            "Least energy in the words of the text is the least norm of the joint velocity, which "
            "under the task alone is the pseudo-inverse solution. The price: after one closed "
            f"turn with avoidance a joint is {drifts[0.0][0]:.2f} rad from its start, after five "
            f"{drifts[0.0][-1]:.2f} rad. With the pull lambda (q - q0), lambda = 2 1/s, it is at "
            f"most {max(drifts[2.0]):.1e} rad."
        ),
    )


def _scenarios() -> list[Frozen]:
    """The frozen crossing of every declared robot."""
    robots = REGISTRY.declared("patent.robot", "choices").choices
    return [frozen(CROSSING[robot]) for robot in robots]


def _forward(printed: Formula, scenario: Frozen) -> tuple[float, float, float]:
    """Difference of both sides, distance of a second solution and the difference of its tips."""
    system, q = scenario.system, scenario.q0
    halves = np.split(q, 2)
    model = [placed.arm.fk(part)[:3, 3] for placed, part in zip(system.arms, halves, strict=True)]
    f = np.array([p.placement.act(tip) for p, tip in zip(system.arms, model, strict=True)])
    controller = VelocityController(system, pseudo_inverse(ControllerSettings()))
    tips = system.tips(q)
    controller.velocity(q, tips, STILL)
    given = {"f": f, "r": controller.tips}
    apart = float(np.abs(printed.value(0, given) - printed.value(1, given)).max())
    other = _self_motion(system, q)
    same = float(np.abs(system.tips(other) - tips).max())
    return apart, float(np.linalg.norm(other - q)), same


def random_configuration(system: ArmSystem, rng: np.random.Generator) -> np.ndarray:
    """Joint angles uniform in their ranges, at most half a turn either way."""
    arrays = system.arrays
    return rng.uniform(arrays.lower.clip(min=-np.pi), arrays.upper.clip(max=np.pi))


def _self_motion(system: ArmSystem, q: np.ndarray) -> np.ndarray:
    """A posture with the same tips, reached along the null space of J."""
    controller = VelocityController(system, pseudo_inverse(ControllerSettings()))
    tips, moved = system.tips(q), q.copy()
    direction = np.ones(system.nq)
    for _ in range(400):
        p = controller.problem(moved, tips, STILL)
        J = np.linalg.pinv(p.A)
        moved = (
            moved + 1e-2 * (direction - J @ (p.A @ direction)) / np.sqrt(system.nq) + 0.05 * J @ p.b
        )
    for _ in range(20):
        p = controller.problem(moved, tips, STILL)
        moved = moved + 0.1 * np.linalg.pinv(p.A) @ p.b
    return moved


def _inertia_weighted(system: ArmSystem, q: np.ndarray, p: QuadraticProgram) -> np.ndarray:
    """min x^T M(q) x under the task, M the joint-space inertia."""
    W = np.zeros((system.nq, system.nq))
    start = system.arrays.start
    for k, placed in enumerate(system.arms):
        part = slice(start[k], start[k + 1])
        model = placed.arm.model
        M = pin.crba(model, model.createData(), q[part])
        W[part, part] = np.triu(M) + np.triu(M, 1).T
    inverse = np.linalg.inv(W)
    return inverse @ p.A.T @ np.linalg.solve(p.A @ inverse @ p.A.T, p.b)


def _drift(scenario: Frozen, weight: float) -> list[float]:
    motion = run(scenario, ControllerSettings(repetition=weight), COARSE_STEP, cycles=5)
    return motion.drift(scenario.period).tolist()


def _named(drifts: dict[float, list[float]]) -> dict[str, list[float]]:
    return {"drift_free": drifts[0.0], "drift_repetitive": drifts[2.0]}
