"""Equations of the problem: forward map, velocities, objective, bounds, avoidance, the QP."""

from __future__ import annotations

from functools import partial

import numpy as np
import pandas as pd
import pinocchio as pin

from ...control.controller import VelocityController
from ...control.problem import NoSolution, Problem
from ...control.recorded import recorded_problems
from ...control.settings import Settings
from ...control.simulate import pseudo_inverse
from ...control.solvers import SOLVERS, solve
from ...control.system import ArmSystem
from ...ledger import REGISTRY, Assumed, Bounded, Is, NoOriginal, Result
from ...scene.clearance import distances
from .robots import SEED, mesh_excess
from .scenario import COARSE_STEP, Frozen, crossing, frozen, run, settings_of

checks = partial(REGISTRY.checks, page="patent/problem")
_AGREEMENT = 1e-5  # [rad/s] iterative solvers end at their tolerance
STILL = np.zeros((2, 3))
_DIFFERENCE = 1e-6  # [rad] step of central differences


@checks(
    "patent.eq_forward",
    samples=16,
    rules=[
        Bounded(key="pinocchio", high=1e-12, label="f of both arms is that of Pinocchio, to [m]"),
        Bounded(
            key="other_solution", low=0.1, label="another solution for the same r is this far [rad]"
        ),
        Bounded(key="same_tips", high=1e-6, label="and has the same r, to [m]"),
    ],
)
def forward_map(assumed: Assumed) -> Result:
    """r = f(theta) of both arms stacked, and a second theta with the same r."""
    scenario = crossing(assumed, "base_distance")
    system, q = scenario.system, scenario.q0
    halves = np.split(q, 2)
    model = [placed.arm.fk(part)[:3, 3] for placed, part in zip(system.arms, halves, strict=True)]
    placed = np.array([p.placement.act(tip) for p, tip in zip(system.arms, model, strict=True)])
    controller = VelocityController(system, pseudo_inverse(Settings()))
    tips = system.tips(q)
    controller.velocity(q, tips, STILL)
    other = _self_motion(system, q)
    return Result(
        obtained={
            "pinocchio": float(np.abs(controller.tips - placed).max()),
            "unknowns": system.nq,
            "equations": 3 * len(system.arms),
            "other_solution": float(np.linalg.norm(other - q)),
            "same_tips": float(np.abs(system.tips(other) - tips).max()),
        },
        caption=(
            f"The map from {system.nq} joint angles to {3 * len(system.arms)} tip coordinates "
            f"agrees with Pinocchio. It has no inverse: {np.linalg.norm(other - q):.2f} rad away "
            "lies another posture with the same tips, reached by a motion of the joints alone. "
            "That is why the text turns to velocities, although it words f as the inverse map."
        ),
    )


@checks(
    "patent.eq_velocity",
    samples=8,
    rules=[
        Bounded(key="difference", high=1e-6, label="J theta' is the derivative of f, to [m/rad]"),
        Bounded(key="coupling", high=0.0, label="entries that couple one arm to the other's tip"),
    ],
)
def velocity_map(assumed: Assumed) -> Result:
    """J of both arms against central differences of f at random configurations."""
    system = crossing(assumed).system
    controller = VelocityController(system)
    rng = np.random.default_rng(SEED)
    worst, coupling = 0.0, 0.0
    for _ in range(20):
        q = _random(system, rng)
        J = controller.problem(q, system.tips(q), STILL).A
        for k in range(system.nq):
            step = _DIFFERENCE * np.eye(system.nq)[k]
            column = (system.tips(q + step) - system.tips(q - step)).ravel() / (2 * _DIFFERENCE)
            worst = max(worst, float(np.abs(column - J[:, k]).max()))
        n = system.arrays.start[1]
        coupling = max(coupling, float(np.abs(J[:3, n:]).max()), float(np.abs(J[3:, :n]).max()))
    return Result(
        obtained={"difference": worst, "coupling": coupling},
        caption=(
            "The words between the lost formulas say what is differentiated: f by time. The block "
            f"matrix of both Jacobians equals central differences of f to {worst:.1e} m/rad on 20 "
            "random configurations."
        ),
    )


@checks(
    "patent.eq_min_energy",
    rules=[
        Bounded(
            key="excess", high=1e-9, label="no joint velocity with the same tip velocity is smaller"
        ),
        Bounded(key="to_pseudo_inverse", high=1e-9, label="distance to J^+ dr/dt [rad/s]"),
    ],
    samples=2,
)
def least_velocity(assumed: Assumed) -> Result:
    """Minimiser of the weighted norm under the task alone, and its drift over five turns."""
    scenario = frozen("crossing")
    system = scenario.system
    worst, excess = 0.0, 0.0
    rng = np.random.default_rng(SEED)
    controller = VelocityController(system, pseudo_inverse(Settings()))
    for _ in range(20):
        q, velocity = _random(system, rng), rng.normal(size=(2, 3))
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


@checks(
    "patent.eq_joint_limits",
    samples=32,
    rules=[
        Bounded(
            key="naive_excess", low=0.0, label="without bounds a joint leaves its range by [rad]"
        ),
        Bounded(
            key="angle_excess",
            high=0.0,
            label="with bounds, largest excess over an angle limit [rad]",
        ),
        Bounded(key="speed_excess", high=1e-9, label="largest excess over a speed limit [rad/s]"),
        NoOriginal(key="formula", label="the inequality"),
    ],
)
def joint_limits(assumed: Assumed) -> Result:
    """Bounds of speed merged with those of angle on a task that drives joints to their limits."""
    scenario = frozen("limits")
    settings = settings_of(assumed, "limit_form", "limit_gain", "limit_margin")
    naive = run(scenario, pseudo_inverse(settings), COARSE_STEP)
    motion = run(scenario, settings, COARSE_STEP)
    arrays = scenario.system.arrays
    speed = float((np.abs(motion.x) - arrays.speed).max())
    return Result(
        obtained={
            "naive_excess": angle_excess(scenario, naive.q),
            "angle_excess": angle_excess(scenario, motion.q),
            "speed_excess": speed,
        },
        caption=(
            "On a task of its own the pseudo-inverse takes a joint "
            f"{angle_excess(scenario, naive.q):.3f} rad beyond its range; with merged bounds the "
            f"nearest joint stays {-angle_excess(scenario, motion.q):.3f} rad inside. Limits of "
            "angle are announced in the text, and the inequality that follows is one on speed; "
            "bounds on speed alone would not hold the range, as the section on robustness shows."
        ),
    )


@checks(
    "patent.eq_avoid",
    samples=16,
    rules=[
        Bounded(
            key="gradient", high=1e-6, label="rows are derivatives of the distances, to [m/rad]"
        ),
        Bounded(
            key="mesh_excess",
            high=1e-4,
            label="moving link meshes stick out of the capsules by [m]",
        ),
        NoOriginal(key="formula", label="the inequality and the law of beta"),
    ],
)
def avoidance_rows(assumed: Assumed) -> Result:
    """Rows of all active pairs, and finite differences of the distances they come from."""
    scenario = crossing(assumed, "capsules")
    settings = settings_of(
        assumed, "avoidance_form", "pair_selection", "outer_range", "inner_range"
    )
    near = run(scenario, Settings(), COARSE_STEP)
    q = near.q[int(near.distance.argmin())]
    controller = VelocityController(scenario.system, settings)
    problem = controller.problem(q, scenario.system.tips(q), STILL)
    gradient = _worst_gradient(scenario.system)
    excess = max(mesh_excess(assumed["robot"], assumed["capsules"]).values())
    return Result(
        obtained={"gradient": gradient, "mesh_excess": excess, "rows": len(problem.h)},
        caption=(
            f"At the nearest posture of the frozen task {len(problem.h)} rows are active. Row "
            f"gradients agree with central differences of the distances to {gradient:.1e} m/rad, "
            "in penetration as well. The vertices of the moving link meshes lie at least "
            f"{-1e3 * excess:.2f} mm inside the capsules. How J_N combines vector and Jacobian, "
            "and how beta follows from the ranges, is not in the text."
        ),
    )


@checks(
    "patent.eq_qp",
    rules=[
        Bounded(
            key="residual", high=1e-8, label="largest optimality residual on recorded problems"
        ),
        Is(
            key="solvers_agree",
            value=True,
            label="all solvers agree with the reference to 1e-5 rad/s",
        ),
        Is(
            key="contradiction_found",
            value=True,
            label="an impossible task is reported, not answered",
        ),
        NoOriginal(key="formula", label="the assembled problem"),
    ],
    samples=6,
)
def quadratic_program(assumed: Assumed) -> Result:
    """The problem along the frozen task, solved by every solver and certified."""
    scenario, settings = frozen("crossing"), Settings()
    motion = run(scenario, settings, COARSE_STEP)
    problems = recorded_problems(scenario.system, scenario.circles, motion, settings, 100)
    reference = [solve(p, assumed["reference_solver"]) for p in problems]
    rows = []
    for name in SOLVERS:
        found = [solve(p, name) for p in problems]
        apart = max(float(np.abs(f.x - r.x).max()) for f, r in zip(found, reference, strict=True))
        rows.append((name, apart, max(f.residual for f in found)))
    yielding = VelocityController(
        scenario.system, settings, slack=assumed["infeasible_policy"] != "stop"
    )
    found = _impossible(yielding, scenario)
    residual = max(r.residual for r in reference)
    apart = max(row[1] for row in rows)
    return Result(
        obtained={
            "residual": residual,
            "solvers_agree": apart <= _AGREEMENT,
            "solvers": len(rows),
            "contradiction_found": found,
        },
        measured={"largest_difference": apart},
        table=pd.DataFrame(
            rows, columns=["solver", "largest difference [rad/s]", "largest residual"]
        ),
        caption=(
            f"{len(problems)} problems of the frozen task, up to "
            f"{max(len(p.h) for p in problems)} avoidance rows: {len(rows)} solvers agree to "
            f"{apart:.1e} rad/s, and the reference answers satisfy the optimality conditions to "
            f"{residual:.1e}. A task that no joint velocity can meet is either answered with the "
            "slack it needs, which is reported, or refused."
        ),
    )


def angle_excess(scenario: Frozen, q: np.ndarray) -> float:
    """Largest excess of joint angles (N, n) over their limits, negative inside [rad]."""
    arrays = scenario.system.arrays
    return float(max((q - arrays.upper).max(), (arrays.lower - q).max()))


def _self_motion(system: ArmSystem, q: np.ndarray) -> np.ndarray:
    """A posture with the same tips, reached along the null space of J."""
    controller = VelocityController(system, pseudo_inverse(Settings()))
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


def _random(system: ArmSystem, rng: np.random.Generator) -> np.ndarray:
    arrays = system.arrays
    return rng.uniform(arrays.lower.clip(min=-np.pi), arrays.upper.clip(max=np.pi))


def _inertia_weighted(system: ArmSystem, q: np.ndarray, p: Problem) -> np.ndarray:
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
    motion = run(scenario, Settings(repetition=weight), COARSE_STEP, cycles=5)
    return motion.drift(scenario.period).tolist()


def _named(drifts: dict[float, list[float]]) -> dict[str, list[float]]:
    return {"drift_free": drifts[0.0], "drift_repetitive": drifts[2.0]}


def _worst_gradient(system: ArmSystem) -> float:
    """Largest difference of row gradients to central differences over random configurations."""
    controller = VelocityController(system, Settings(outer=10.0))
    rng, worst, n = np.random.default_rng(SEED), 0.0, system.nq
    for _ in range(5):
        q = _random(system, rng)
        rows = controller.problem(q, system.tips(q), STILL).G
        d = distances(system.scene, q + _DIFFERENCE * np.vstack([np.eye(n), -np.eye(n)]))
        worst = max(worst, float(np.abs((d[:n] - d[n:]).T / (2 * _DIFFERENCE) + rows).max()))
    return worst


def _impossible(controller: VelocityController, scenario: Frozen) -> bool:
    """Whether a task beyond the speed limits is refused, or answered with a reported slack."""
    try:
        tips = scenario.system.tips(scenario.q0)
        found = controller.solution(scenario.q0, tips, np.full((2, 3), 5.0))
    except NoSolution:
        return True
    return found.certified() and float(np.abs(found.slack).max()) > 1.0
