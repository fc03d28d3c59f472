"""Stored study of `qiu`: is there an equilibrium with the flange near the printed trap at all?

Unknown are the wrist of the posture, the wrist and the radius of the goal, the place of the flange
in the neighbourhood of the printed point, and the ratio of the gains; per branch of the posture and
of the goal, set of control points, rule of the sources and form of the attraction, the nearest
balance of both forces is sought from several starts. Forces that are opposed balance at one ratio;
forces that are not balance at none.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from scipy.stats import qmc

from ....errors import InputError
from ....ledger import REGISTRY, Study
from ....ledger.assumptions import alternatives
from ....ledger.comparison import Comparison
from ....planning.search.equilibrium import nearest_equilibria
from ....planning.search.search_problem import search_problem
from ....planning.tasks.elbow_branches import BRANCHES, branch_posture
from ..document import PRINTED, SEED, full_step, repelling
from ..reading import CONTROL_POINTS, Goal, Traditional
from .fit import combinations

STARTS = 3
#: Columns in which round-off at the start of a descent is seen.
_ROUGH = ("ratio", "curvature", *(f"{end}{j}" for end in ("q", "goal") for j in range(1, 7)))
_BEND = np.deg2rad(120.0)  # of joint 5 of the arm


def _cells() -> list[dict[str, Any]]:
    return combinations(
        branch=BRANCHES,
        goal_branch=BRANCHES,
        control_points=list(CONTROL_POINTS),
        repulsion_sources=alternatives("qiu.repulsion_sources", 0),
        attraction_form=alternatives("qiu.attraction_form", 0),
    )


def _bounds() -> tuple[np.ndarray, np.ndarray]:
    """Of q4, q5 and those of the goal [rad], its radius [m], and the offset of the flange [m], in
    the cube inside the ball of one printed step around the printed point."""
    radius = REGISTRY.declared("qiu.goal_radius", "range").range or (np.nan, np.nan)
    wrist, near = np.array([np.pi, _BEND, np.pi, _BEND]), np.full(3, full_step() / np.sqrt(3.0))
    return np.array([*-wrist, radius[0], *-near]), np.array([*wrist, radius[1], *near])


def _cell(cell: Mapping[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    reading = Traditional.nominal(**{key: cell[key] for key in cell if key != "branch"})
    arm, start = reading.arm(), PRINTED.start
    made = search_problem(arm, start, start, repelling(), reading.settings())

    def place(x: np.ndarray) -> tuple[np.ndarray, np.ndarray] | None:
        q = branch_posture(arm, PRINTED.trap + x[5:], cell["branch"], (*x[:2], 0.0))
        goal = Goal("pulled_back", float(x[4]), cell["goal_branch"], (*x[2:4], 0.0))
        try:
            return None if q is None else (q, goal.posture())
        except InputError:
            return None

    low, high = _bounds()
    starts = qmc.scale(qmc.Sobol(len(low), rng=rng).random(16), low, high)
    placed = [x for x in starts if place(x) is not None][:STARTS]
    found = nearest_equilibria(made, place, placed, (low, high))
    row: dict[str, Any] = {"starts": len(found), "angle_deg": np.nan, "ratio": np.nan}
    row |= {"curvature": np.nan}
    if found:
        nearest = min(found, key=lambda one: one.angle)
        row |= {"angle_deg": float(np.rad2deg(nearest.angle)), "ratio": nearest.ratio}
        row |= {"curvature": nearest.curvature}
        row |= {f"q{j}": float(angle) for j, angle in enumerate(nearest.q, 1)}
        row |= {f"goal{j}": float(angle) for j, angle in enumerate(nearest.goal, 1)}
    return row


EQUILIBRIA = REGISTRY.keeps(
    Study(
        name="qiu_equilibria",
        title="Nearest balance of forces with the flange around the printed trap, for any ratio",
        cells=_cells,
        compute=_cell,
        seed=SEED + 40,
        settings={"starts": STARTS},
        measured=_ROUGH,
        compared=(
            Comparison(
                "angle_deg",
                "a descent of few steps amplifies round-off; measured 0.4 degrees",
                absolute=2.0,
            ),
        ),
    )
)
