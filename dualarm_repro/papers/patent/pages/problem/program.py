"""The programme: bounds of the joints, avoidance rows, the QP."""

from __future__ import annotations

import inspect
from functools import partial
from pathlib import Path

import numpy as np
import pandas as pd
from example_robot_data import getModelPath

from .....control.controller import VelocityController
from .....control.frozen import FrozenScenario
from .....control.joint_ranges import random_configuration
from .....control.mesh_containment import mesh_excess
from .....control.problem import NoSolution
from .....control.recorded import recorded_problems
from .....control.settings import ControllerSettings
from .....control.solvers import SOLVERS, solve
from .....control.statement import statement
from .....control.system import ArmSystem
from .....differences import central_differences
from .....ledger import REGISTRY, Assumed, Bounded, Is, NoOriginal, Residual, Result
from .....ledger.captions import captions
from .....scene.clearance import distances
from .....tracking import memo
from ...document import COARSE_STEP, CROSSING, SEED, frozen, redundant_arm, run
from ...reading import LIMITS, controller_settings
from .velocities import STILL

checks = partial(REGISTRY.checks, page="patent/problem")
caption = captions(__file__)
_AGREEMENT = 1e-5  # [rad/s] iterative solvers end at their tolerance
_TICKS = 400  # steps at a bound, after which every joint is at its limit
_STARTS = 5  # random configurations from which joints run at a bound
_MOTIONS = 50  # random motions against the rows
_CHECKED = 8  # configurations in which capsules have to contain meshes
#: Robot to the URDF whose meshes its capsules have to contain.
URDFS = {"panda": "panda_description/urdf/panda.urdf", "xarm7": "xarm_description/urdf/xarm7.urdf"}


@checks(
    "patent.eq_joint_limits",
    samples=32,
    rules=[
        Bounded("angle_excess", "bounded motion leaves an angle range by [rad]", high=0.0),
        Bounded("speed_excess", "and a speed range by [rad/s]", high=1e-9),
        Bounded("standing", "within the ranges, standing still is outside by", high=0.0),
        NoOriginal("formula", "the inequality"),
    ],
)
def joint_limits(assumed: Assumed) -> Result:
    """Steps at either bound from random configurations, until the joints are at their limits."""
    settings = controller_settings(assumed, *LIMITS)
    system, rng = frozen("limits").system, np.random.default_rng(SEED)
    arrays, controller = system.arrays, VelocityController(system, settings)
    angle, speed, standing = -np.inf, -np.inf, -np.inf
    for _ in range(_STARTS):
        start = random_configuration(system, rng)
        for side in ("lower", "upper"):
            q = start.copy()
            for step in range(_TICKS):
                p = controller.problem(q, system.tips(q), STILL)
                bound = getattr(p, side)
                margin = settings.limit_margin
                free = (q > arrays.lower + margin) & (q < arrays.upper - margin)
                if step == 0 and free.any():
                    standing = max(standing, float(np.maximum(p.lower, -p.upper)[free].max()))
                speed = max(speed, float((np.abs(bound) - arrays.speed).max()))
                q = q + COARSE_STEP * bound
                outside = np.where(
                    (start > arrays.lower) & (start < arrays.upper),
                    np.maximum(q - arrays.upper, arrays.lower - q),
                    -np.inf,
                )
                angle = max(angle, float(outside.max()))
    return Result(
        obtained={"angle_excess": angle, "speed_excess": speed, "standing": standing},
        caption=caption("eq_joint_limits", starts=_STARTS, seconds=_TICKS * COARSE_STEP),
    )


@checks(
    "patent.eq_avoid",
    samples=16,
    rules=[
        Residual("gradient", "rows are derivatives of the distances, to [m/rad]", high=1e-6),
        Residual(
            "faster",
            "motion within the rows closes a distance below d1 faster than beta, by [m/s]",
            high=1e-6,
        ),
        Bounded("mesh_excess", "moving link meshes stick out of the capsules by [m]", high=1e-4),
        NoOriginal("formula", "the inequality and the law of beta"),
    ],
)
def avoidance_rows(assumed: Assumed) -> Result:
    """Rows, differences of the distances, and what motion within the rows does to them."""
    scenario = frozen(CROSSING[assumed["robot"]], capsules=assumed["capsules"])
    settings = controller_settings(assumed, "avoidance_form", "pair_selection")
    near = run(scenario, ControllerSettings(), COARSE_STEP)
    middle = 0.5 * (ControllerSettings().inner + ControllerSettings().outer)
    q = near.q[int(np.abs(near.distance - middle).argmin())]
    gradient = _worst_gradient(scenario.system)
    rows, faster = _closing(scenario, settings, q)
    excess = max(uncovered(assumed["robot"], assumed["capsules"]).values())
    return Result(
        obtained={"gradient": gradient, "faster": faster, "mesh_excess": excess, "rows": rows},
        caption=caption("eq_avoid"),
    )


@checks(
    "patent.eq_qp",
    rules=[
        Residual("residual", "largest optimality residual of the exact method", high=1e-8),
        Is(
            "disagree",
            "solvers that end elsewhere than the exact method, by more than 1e-5 rad/s",
            value=0,
        ),
        Is("answered", "impossible tasks answered without a word, of two", value=0),
        NoOriginal("formula", "the assembled problem"),
    ],
)
def quadratic_program(assumed: Assumed) -> Result:
    """The problem along the frozen task, solved by every solver and certified."""
    scenario, settings = frozen("crossing"), ControllerSettings()
    motion = run(scenario, settings, COARSE_STEP)
    problems = recorded_problems(scenario.system, scenario.circles, motion, settings, 100)
    reference = [solve(p) for p in problems]
    rows = []
    for name in SOLVERS:
        found = [solve(p, name) for p in problems]
        apart = max(float(np.abs(f.x - r.x).max()) for f, r in zip(found, reference, strict=True))
        rows.append((name, apart, max(f.residual for f in found)))
    policies = [
        VelocityController(scenario.system, settings, slack=slack) for slack in (True, False)
    ]
    return Result(
        obtained={
            "residual": max(r.residual for r in reference),
            "disagree": sum(row[1] > _AGREEMENT for row in rows),
            "solvers": len(rows),
            "answered": sum(not _impossible(policy, scenario) for policy in policies),
        },
        measured={"largest_difference": max(row[1] for row in rows)},
        table=pd.DataFrame(
            rows, columns=["solver", "largest difference [rad/s]", "largest residual"]
        ),
        caption=caption("eq_qp", problems=len(problems), most=max(len(p.h) for p in problems)),
    )


def statement_source() -> str:
    """Code that states the problem for the reader, without its docstring."""
    return inspect.getsource(statement).split('"""')[-1]


@memo()
def uncovered(robot: str, capsules: str = "widened") -> dict[str, float]:
    """How far each moving link's mesh sticks out of the capsules, negative inside [m]."""
    arm, path = redundant_arm(robot, capsules), Path(getModelPath(URDFS[robot])) / URDFS[robot]
    configurations = arm.random_configurations(_CHECKED, np.random.default_rng(SEED))
    return mesh_excess(arm, path, configurations)


def _closing(
    scenario: FrozenScenario, settings: ControllerSettings, q: np.ndarray
) -> tuple[int, float]:
    """Rows, and by how much a distance below d1 closes faster than beta(d) within them [m/s]."""
    system = scenario.system
    p = VelocityController(system, settings).problem(q, system.tips(q), STILL)
    every = VelocityController(system, ControllerSettings()).problem(q, system.tips(q), STILL)
    lengths = np.linalg.norm(p.G, axis=1)
    rng, worst = np.random.default_rng(SEED), -np.inf
    for _ in range(_MOTIONS):
        x = rng.normal(size=system.nq)
        closing = p.G @ x
        pressed = closing > 1e-9 * lengths
        # Room is positive between the ranges, so that a slower motion the same way is admissible.
        x *= min(1.0, float((p.h[pressed] / closing[pressed]).min(initial=1.0)))
        worst = max(worst, float((every.G @ x - every.h).max()))
    return len(p.h), worst


def _worst_gradient(system: ArmSystem) -> float:
    """Largest difference of row gradients to central differences over random configurations."""
    controller = VelocityController(system, ControllerSettings(outer=10.0))
    rng, worst = np.random.default_rng(SEED), 0.0
    for _ in range(5):
        q = random_configuration(system, rng)
        rows = controller.problem(q, system.tips(q), STILL).G
        gradients = central_differences(lambda at: distances(system.scene, at), q).T
        worst = max(worst, float(np.abs(gradients + rows).max()))
    return worst


def _impossible(controller: VelocityController, scenario: FrozenScenario) -> bool:
    """Whether a task beyond the speed limits is refused, or answered with a reported slack."""
    try:
        tips = scenario.system.tips(scenario.q0)
        found = controller.solution(scenario.q0, tips, np.full((2, 3), 5.0))
    except NoSolution:
        return True
    return found.certified() and float(np.abs(found.slack).max()) > 1.0
