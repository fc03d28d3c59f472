"""What equations (9)-(16) are judged by: print against the potential that is descended.

Both are evaluated in a small problem in which all terms act.
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from .....arms import load_arm
from .....ledger import REGISTRY, Residual, Result
from .....planning.checks.field_agreement import gradient_error
from .....planning.descent.problem import PlanningProblem, problem
from .....planning.field.obstacles import obstacles_of
from .....planning.field.potentials import Potential
from .....scene import PlacedArm, Scene, facing, window_frame
from .....tracking import memo
from ...document import SEED, master_goal, master_start
from ...reading import PlannerChoice, improved
from .printed_field import difference

checks = partial(REGISTRY.checks, page="xue/potentials")

VALUE = Residual("value", "largest difference of the field run to print", high=1e-9)
GRADIENT = Residual("gradient", "relative error of its gradient by central differences", high=1e-6)
#: Configurations at which gradients are compared.
_GRADIENTS = 60
#: Place of a window close to the master's wrist at its start, in the frame of its base [m].
_CENTRE = (1.4, 0.0, -1.1)
#: That window, which is passed along x [m].
WINDOW: dict[str, Any] = {"centre": list(_CENTRE), "opening": [0.5, 0.5], "bar": 0.1}
#: Only its potentials count; it is never run.
_PLANNER = PlannerChoice(
    control_points="frames_2_6",
    window_distance="sum_over_bars",
    update_rule="gradient",
    step_gain=0.05,
    max_step=0.02,
    step_limit=1,
    goal_tolerance=0.02,
    stuck_rule="block_means",
    stuck_threshold=1e-3,
    virtual_term="position",
    virtual_switching="on_when_stuck",
    virtual_release=0.1,
    virtual_gain=2.0,
    joint_term_weight=1.0,
    joint_limits_in_motion="ignored",
)


@memo(64)
def sample_problem(
    virtual_centre: tuple[float, float, float] = _CENTRE, **chosen: Any
) -> PlanningProblem:
    """Master from the printed start to the printed goal beside a window, with the printed gains.

    Parameters
    ----------
    chosen
        Fields of a :class:`PlannerChoice` that its potentials depend on.
    """
    placed = PlacedArm("master", load_arm("es165d"), start=master_start(), goal=master_goal())
    bar = WINDOW["bar"]
    centre, opening = np.array(_CENTRE), WINDOW["opening"]
    window = window_frame(centre, facing((1.0, 0.0, 0.0)), *opening, bar, bar)  # type: ignore[call-arg]
    obstacles = obstacles_of(Scene([placed], {"window": window}, self_collision=False))
    settings = improved(replace(_PLANNER, **chosen), np.array(virtual_centre), master_goal())
    away = master_start() + np.array([0.8, 0.0, 0.0, 0.0, 0.0, 0.0])
    return problem(placed, away, master_goal(), obstacles, settings)


def samples(made: PlanningProblem, count: int = 200) -> np.ndarray:
    """Configurations about the start with all control points outside the bars (N, 6)."""
    rng = np.random.default_rng(SEED)
    q = master_start() + rng.uniform(-0.5, 0.5, (count, 6))
    return q[made.repulsion.distances(q).min(axis=(1, 2)) > 0.02]


def choices(name: str) -> list[Any]:
    """The readings that are declared for an assumption."""
    return list(REGISTRY.declared(f"xue.{name}", "choices").choices or ())


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
