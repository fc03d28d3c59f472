"""Equations of the motion: forward map, velocities, the objective."""

from __future__ import annotations

from functools import partial

import numpy as np
import pandas as pd

from .....control.controller import VelocityController
from .....control.frozen import FrozenScenario
from .....control.joint_ranges import random_configuration
from .....control.redundancy import inertia_weighted, self_motion
from .....control.settings import ControllerSettings
from .....control.simulate import pseudo_inverse
from .....control.system import ArmSystem
from .....differences import central_differences
from .....ledger import REGISTRY, Assumed, Bounded, NoOriginal, Residual, Result
from .....ledger.assumptions import alternatives
from .....ledger.captions import captions
from .....ledger.formula import Formula, parse
from ...document import COARSE_STEP, CROSSING, SEED, frozen, run

checks = partial(REGISTRY.checks, page="patent/problem")
caption = captions(__file__)
STILL = np.zeros((2, 3))


@checks(
    "patent.eq_forward",
    rules=[
        Residual("apart", "both printed sides agree, to [m]", high=1e-12),
        Bounded("other_solution", "another solution for the same r is this far [rad]", low="other"),
        Residual("same_tips", "and has the same r, to [m]", high=1e-6),
    ],
)
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
        caption=caption("eq_forward", printed=printed.text, makes=len(rows)),
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
        controller, n = VelocityController(system), system.arrays.start[1]
        for _ in range(20):
            q = random_configuration(system, rng)
            J = controller.problem(q, system.tips(q), STILL).A
            worst = max(worst, float(np.abs(_tip_jacobian(system, q) - J).max()))
            apart = np.abs([J[:3, n:], J[3:, :n]])
            coupling = max(coupling, float(apart.max()))
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
    scenario, rng = frozen("crossing"), np.random.default_rng(SEED)
    system, worst, excess = scenario.system, 0.0, 0.0
    controller = VelocityController(system, pseudo_inverse(ControllerSettings()))
    for _ in range(20):
        q, velocity = random_configuration(system, rng), rng.normal(size=(2, 3))
        p = controller.problem(q, system.tips(q), velocity)
        least = np.linalg.pinv(p.A) @ p.b
        x = least if assumed["energy_weight"] == "identity" else inertia_weighted(system, q, p)
        worst = max(worst, float(np.abs(x - least).max()))
        excess = max(excess, float(np.linalg.norm(x) - np.linalg.norm(least)))
        if assumed["energy_weight"] == "identity":
            found = controller.velocity(q, system.tips(q), velocity)
            worst = max(worst, float(np.abs(found - x).max()))
    drifts = {weight: _drift(scenario, weight) for weight in (0.0, 2.0)}
    return Result(
        obtained={
            "excess": excess,
            "to_pseudo_inverse": worst,
            "drift_free": drifts[0.0],
            "drift_repetitive": drifts[2.0],
        },
        table=pd.DataFrame(
            [(turn + 1, *(drifts[w][turn] for w in drifts)) for turn in range(5)],
            columns=["turn", "drift [rad]", "drift with repetitive term [rad]"],
        ),
        caption=caption("eq_min_energy"),
    )


def _tip_jacobian(system: ArmSystem, q: np.ndarray) -> np.ndarray:
    """Differences of the tips by the joint angles (6, n) [m/rad]."""
    return central_differences(lambda at: system.tips(at).ravel(), q).T


def _scenarios() -> list[FrozenScenario]:
    """The frozen crossing of every declared robot."""
    return [frozen(CROSSING[robot]) for robot in alternatives("patent.robot", 0)]


def _forward(printed: Formula, scenario: FrozenScenario) -> tuple[float, float, float]:
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
    other = self_motion(system, q)
    same = float(np.abs(system.tips(other) - tips).max())
    return apart, float(np.linalg.norm(other - q)), same


def _drift(scenario: FrozenScenario, weight: float) -> list[float]:
    motion = run(scenario, ControllerSettings(repetition=weight), COARSE_STEP, cycles=5)
    return motion.drift(scenario.period).tolist()
