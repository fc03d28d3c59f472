"""Inverse kinematics in the runs of `xue`: where what is printed makes it necessary."""

from __future__ import annotations

import copy
from functools import partial

import numpy as np

from ...ledger import REGISTRY, Assumed, Bounded, Is, Result, Role
from ...ledger.formula import parse
from ...planning.descent.apf import plan_apf
from ...scene import PlacedArm
from ...tracking import memo
from .chosen import nominal
from .layout import placed_master, placed_slave
from .methods import improved
from .motions import slave_obstacles, window_obstacles
from .postures import posture

checks = partial(REGISTRY.checks, page="xue/table2")

#: Printed start and goal of each arm: angles under ``q`` or a position under ``position``.
_ENDS = {
    "master": ("xue.claim_master_start", "xue.claim_master_goal"),
    "slave": ("xue.claim_slave_start", "xue.claim_slave_end"),
}


@checks(
    "xue.claim_no_ik",
    rules=[
        Is("calls.master", "calls in the run of the master from what is printed", value=0),
        Is(
            "needs_goal_angles",
            "(13), as printed, needs the goal angles",
            value=True,
            role=Role.CONTRADICTS,
        ),
        Bounded(
            "calls.slave",
            "calls in the run of the slave from what is printed",
            low=1,
            role=Role.CONTRADICTS,
        ),
    ],
)
def without_inverse_kinematics(assumed: Assumed) -> Result:
    """Calls of the closed-form inverse in whole runs, from the printed start and goal on."""
    case = nominal()
    centre, placed = case.layout.window_centre, {}
    placed["master"], placed["slave"] = placed_master(case.layout), placed_slave(case.layout)
    around = {"master": window_obstacles(case.layout), "slave": slave_obstacles(case)}
    calls, steps = {}, {}
    for name, arm in placed.items():
        counted, counter = _counting(arm)
        ends = [_angles(counted, item, case.layout.slave_postures) for item in _ENDS[name]]
        settings = improved(case.method, centre, ends[1])
        plan = plan_apf(counted, *ends, around[name], settings)
        calls[name], steps[name] = len(counter), plan.steps
    return Result(
        obtained={"calls": calls, "steps": steps, "needs_goal_angles": needs_goal_angles()},
        caption=(
            f"(13) {'needs' if needs_goal_angles() else 'does not need'} the goal angles. In the "
            f"run of the master, whose start and goal are printed as angles, inverse kinematics is "
            f"called {calls['master']} times in {steps['master']} steps; in that of the slave, for "
            f"which positions are printed, {calls['slave']} times, all of them before the first of "
            f"its {steps['slave']} steps: no step needs it, yet without it the slave has no goal."
        ),
    )


def needs_goal_angles() -> bool:
    """Whether the right side of (13) holds the angles of the goal."""
    formula = parse(REGISTRY.printed("xue.eq13")["formula"])
    return any(str(symbol).startswith("theta_g") for symbol in formula.sides[-1].free_symbols)


def _angles(placed: PlacedArm, item: str, choice: str) -> np.ndarray:
    """Angles of a printed start or goal; a printed position takes inverse kinematics."""
    printed = REGISTRY.printed(item)
    if "q" in printed:
        return np.array(parse_all(tuple(printed["q"])))
    target = np.array(parse_all(tuple(printed["position"])))
    return posture(placed.arm, target - placed.placement.translation, choice)


@memo()
def parse_all(texts: tuple[str, ...]) -> tuple[float, ...]:
    """Printed numbers such as ``-pi/8``."""
    return tuple(float(parse(text).value(0, {})) for text in texts)


def _counting(placed: PlacedArm) -> tuple[PlacedArm, list[None]]:
    """The arm with a closed-form inverse that notes every call."""
    arm, calls = copy.copy(placed.arm), []

    def noted(*args: object, **options: object) -> np.ndarray:
        calls.append(None)
        return placed.arm.ik_branches(*args, **options)

    arm.ik_branches = noted
    return PlacedArm(placed.name, arm, placed.placement, placed.start, placed.goal), calls
