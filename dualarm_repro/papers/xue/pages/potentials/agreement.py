"""What equations (9)-(16) are judged by: print against the potential that is descended.

Both are evaluated in a small problem in which all terms act.
"""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np

from .....arms import load_arm
from .....ledger import REGISTRY, Residual, Result
from .....planning.checks.field_agreement import gradient_error
from .....planning.descent.problem import PlanningProblem, problem
from .....planning.field.obstacles import obstacles_of
from .....planning.field.potentials import Potential
from .....planning.settings import (
    APFSettings,
    Attraction,
    PointSet,
    Repulsion,
    Termination,
    Trap,
    Update,
    VirtualPoint,
)
from .....scene import PlacedArm, Scene, facing, window_frame
from .....tracking import memo
from ...document import SEED, gains, master_goal, master_start
from ...reading import COMBINATIONS

checks = partial(REGISTRY.checks, page="xue/potentials")

VALUE = Residual("value", "largest difference of the field run to print", high=1e-9)
GRADIENT = Residual("gradient", "relative error of its gradient by central differences", high=1e-6)
#: Configurations at which gradients are compared.
_GRADIENTS = 60
#: Place of a window close to the master's wrist at its start, in the frame of its base [m].
_CENTRE = np.array([1.4, 0.0, -1.1])


@memo(64)
def sample_problem(
    window_distance: str = "sum_over_bars",
    control_points: PointSet = "frames_2_6",
    joint_weight: float = 1.0,
    virtual_gain: float = 2.0,
    virtual_centre: tuple[float, float, float] = tuple(_CENTRE),
    virtual_switching: str = "on_when_stuck",
    virtual_joints: bool = False,
) -> PlanningProblem:
    """Master from the printed start to the printed goal beside a window, with the printed gains.

    With ``virtual_joints`` the virtual point attracts the joints to the goal angles as well.
    """
    placed = PlacedArm("master", load_arm("es165d"), start=master_start(), goal=master_goal())
    window = window_frame(_CENTRE, facing((1.0, 0.0, 0.0)), 0.5, 0.5, 0.1, 0.1)
    scene = Scene([placed], {"window": window}, self_collision=False)
    k_a, k_r, d_0 = (gains()[name] for name in ("k_a", "k_r", "d_0"))
    trap = Trap(rule="block_means", steps=1, threshold=1e-3)
    settings = APFSettings(
        attraction=Attraction(gain=k_a, joint_weight=joint_weight),
        control_points=control_points,
        repulsion=Repulsion(gain=k_r, influence=d_0, combination=COMBINATIONS[window_distance]),
        virtual_point=VirtualPoint(
            gain=virtual_gain,
            position=virtual_centre,
            joints=tuple(master_goal()) if virtual_joints else None,
            switching=virtual_switching,
            release_distance=0.1,
            max_steps=1,
            max_activations=1,
        ),
        update=Update(rule="gradient", max_step=0.02, gain=0.05),
        termination=Termination(joint_tolerance=0.02, step_limit=1, trap=trap),
    )
    away = master_start() + np.array([0.8, 0.0, 0.0, 0.0, 0.0, 0.0])
    return problem(placed, away, master_goal(), obstacles_of(scene), settings)


def samples(made: PlanningProblem, count: int = 200) -> np.ndarray:
    """Configurations about the start with all control points outside the bars (N, 6)."""
    rng = np.random.default_rng(SEED)
    q = master_start() + rng.uniform(-0.5, 0.5, (count, 6))
    return q[made.repulsion.distances(q).min(axis=(1, 2)) > 0.02]


def choices(name: str) -> list[Any]:
    """The readings that are declared for an assumption."""
    return list(REGISTRY.declared(f"xue.{name}", "choices").choices or ())


def difference(printed: np.ndarray, run: float | np.ndarray) -> float:
    """Largest difference; NaN counts, so that what cannot be evaluated agrees with nothing."""
    return float(abs(printed - run).max())


def agreement(name: str, printed: np.ndarray, potential: Potential, q: np.ndarray) -> Result:
    """The printed formula against the potential that is descended, and its gradient."""
    found, error = (
        difference(printed, potential.value(q)),
        gradient_error(potential, q[:_GRADIENTS]),
    )
    return Result(
        obtained={"value": found, "gradient": error},
        caption=(
            f"{name} evaluated as printed at {len(q)} configurations differs from the potential "
            f"that is descended by at most {found:.0e}, its joint gradient from central "
            f"differences by {error:.0e}."
        ),
    )


def worst(results: dict[str, Result], name: str) -> Result:
    """Several readings as one result: the largest difference and gradient error of all."""
    found = {
        key: float(np.max([result.obtained[key] for result in results.values()]))
        for key in ("value", "gradient")
    }
    return Result(
        obtained={**found, "by_reading": {key: r.obtained for key, r in results.items()}},
        caption=(
            f"{name}, evaluated as printed, differs from the potential that is descended by at "
            f"most {found['value']:.0e} whichever of the readings {', '.join(results)} is taken; "
            f"the joint gradient differs from central differences by {found['gradient']:.0e}."
        ),
    )
