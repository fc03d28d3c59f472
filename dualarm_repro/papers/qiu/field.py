"""Figures 4 and 5 and equations (4)-(9) of `qiu`: the potential field."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
import pandas as pd

from ...ledger import REGISTRY, Assumed, Bounded, Is, NoOriginal, Result
from ...planning.bidirectional import repulsive_torque, surroundings_at
from ...planning.bidirectional_settings import Threshold
from ...planning.joint_attraction import conic_force, conic_potential
from ...planning.repulsive_force import (
    inverse_distance_force,
    inverse_distance_potential,
)
from ...planning.search_problem import SearchProblem, search_problem
from ...view.force_field import force_field_figure
from ...view.tip_paths import TipPanel, tip_path_figure
from .readings import (
    CONTROL_POINTS,
    TRADITIONAL_VARIANT,
    settings,
)
from .scenario import (
    ETA0,
    INFLUENCE,
    MASTER_GOAL,
    SEED,
    START,
    THRESHOLD,
    ZETA,
    branch_posture,
    lengths,
    placed,
    pulled_back,
    repelling,
    spheres,
)

checks = partial(REGISTRY.checks, page="qiu/field")
_CONTACT = 1e-3
_SAMPLES = 40
_UNIT = {"rad": 1.0, "deg": np.pi / 180.0}
_LOST = "the formula"


@checks(
    "qiu.fig04",
    rules=[
        Bounded(key="balance", high=1e-6, label="sum of the forces against the slope, relative"),
        NoOriginal(key="drawing", label="the drawing"),
    ],
)
def principle(assumed: Assumed) -> Result:
    """A point among a goal and an obstacle: both forces and their sum."""
    goal, centre, radius = np.array([1.0, 0.0]), np.array([0.45, -0.05]), 0.15

    def potential(points: np.ndarray) -> np.ndarray:
        rho = np.linalg.norm(points - centre, axis=1) - radius
        pull = [conic_potential(p, goal, ZETA, THRESHOLD, Threshold.NORM) for p in points]
        return np.array(pull) + inverse_distance_potential(np.maximum(rho, 0.01), 4.0, INFLUENCE)

    def forces(point: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        away = point - centre
        rho = np.linalg.norm(away) - radius
        push = inverse_distance_force(rho, 4.0, INFLUENCE, _CONTACT) * away / np.linalg.norm(away)
        return conic_force(point, goal, ZETA, THRESHOLD, Threshold.NORM), push

    points = np.array([[0.0, 0.25], [0.12, 0.05], [0.45, 0.32], [0.75, -0.2]])
    balance = max(
        float(np.linalg.norm(sum(forces(p)) + _gradient(lambda x: float(potential(x[None])[0]), p)))
        / float(np.linalg.norm(forces(p)[0]))
        for p in points
    )
    return Result(
        obtained={"balance": balance},
        caption=(
            "A point is drawn to its goal and pushed off the obstacle within the range of the "
            "repulsion. "
            "At the four points shown the sum of the forces is the negative slope of the "
            "potential to "
            f"{balance:.0e}. The drawing of the document is lost."
        ),
        alt="Level lines of a potential around a disc and a goal; arrows of attraction, repulsion "
        "and "
        "their sum at four points.",
        figure=lambda: force_field_figure(potential, forces, goal, centre, radius, points),
    )


@checks(
    "qiu.fig05",
    samples=32,
    rules=[
        Is(key="joints", to="joints", label="joints whose origins are the control points"),
        NoOriginal(key="positions", label="where the origins of the joints are"),
    ],
)
def control_points(assumed: Assumed) -> Result:
    """The three control points on the arm at zero joints."""
    frames, radii, _ = CONTROL_POINTS[assumed["control_points"]]
    arm = placed("master")
    origins = arm.arm.joint_positions(START) @ arm.placement.rotation.T + arm.placement.translation
    points = origins[np.array(frames) - 1]
    apart = np.linalg.norm(points[:, None] - points[None], axis=2)
    joint = {3: "3", 4: "4", 5: "5", 7: "6"}
    known = max(abs(lengths()[key] - value) for key, value in assumed["link_lengths"].items())
    panel = TipPanel("control points at zero joints", {}, [(arm, START)], {"control point": points})
    return Result(
        obtained={
            "joints": {f"O{k}": joint[frame] for k, frame in enumerate(frames, 1)},
            "points": points.tolist(),
            "radii": list(radii),
            "least_distance": float(apart[~np.eye(len(points), dtype=bool)].min()),
            "length_difference": known,
        },
        caption=(
            "Origins of joints 3, 5 and 6 where a robot description puts them: elbow, wrist centre "
            "and "
            "flange. Under a modified table the last two would be one point, and the printed order "
            "of "
            "three weights would have nothing to tell apart. The drawing is lost."
        ),
        alt="Stick figure of the arm at zero joints with three marked points: elbow, wrist and "
        "flange.",
        figure=lambda: tip_path_figure([panel], []),
    )


@checks(
    "qiu.eq04",
    rules=[
        Bounded(
            key="difference", high=1e-5, label="resultant against finite differences, relative"
        ),
    ],
)
def resultant(assumed: Assumed) -> Result:
    """F = -grad(U_att + U_rep) on postures along the way, by central differences."""
    made = _problem(_PLAIN)
    goal = made.goal
    worst = 0.0
    for q in _postures(goal):
        force = conic_force(q, goal, ZETA, THRESHOLD, Threshold.NORM) + _torque(made, q)
        numeric = -_gradient(
            lambda x: (
                conic_potential(x, goal, ZETA, THRESHOLD, Threshold.NORM) + _repulsive(made, x)
            ),
            q,
        )
        worst = max(worst, float(np.linalg.norm(force - numeric) / np.linalg.norm(numeric)))
    return Result(
        obtained={"difference": worst, "postures": _SAMPLES},
        caption=(
            f"On {_SAMPLES} postures between start and goal the resultant is the negative slope of "
            "the "
            f"summed potentials to a relative {worst:.0e}, by central differences."
        ),
    )


@checks(
    "qiu.eq05",
    samples=32,
    rules=[
        Bounded(key="jump", high=1e-6, label="jump of value or slope at the threshold, relative"),
        Bounded(key="growth_far", high=1e-9, label="beyond the threshold it grows linearly, to"),
        NoOriginal(key="formula", label=_LOST),
    ],
)
def attractive_potential(assumed: Assumed) -> Result:
    """Quadratic inside the threshold, conic outside, smooth across it."""
    measure, unit = Threshold(assumed["attraction_form"]), _UNIT[assumed["angle_unit"]]
    d, goal = THRESHOLD * unit, np.zeros(6)
    ray = np.eye(6)[0]

    def value(r: float) -> float:
        return conic_potential(r * ray, goal, ZETA, d, measure)

    step = 1e-4 * d
    inner, outer = (value(d) - value(d - step)) / step, (value(d + step) - value(d)) / step
    jump = abs(outer - inner) / (ZETA * d) - 0.5 * step / d
    second = value(3 * d) - 2 * value(2.5 * d) + value(2 * d)
    return Result(
        obtained={
            "jump": max(jump, 0.0),
            "growth_far": abs(second) / value(d),
            "at_threshold": value(d),
        },
        caption=(
            "The reconstructed attraction is half a square inside the threshold and grows linearly "
            "outside, with equal value and slope at the threshold. The printed formula is lost."
        ),
    )


@checks(
    "qiu.eq06",
    samples=32,
    rules=[
        Bounded(key="difference", high=1e-6, label="force against finite differences, relative"),
        Bounded(key="largest_over_bound", high=1.0 + 1e-12, label="largest force over its bound"),
        NoOriginal(key="formula", label=_LOST),
    ],
)
def attractive_force(assumed: Assumed) -> Result:
    """The negative gradient of (5); the threshold bounds it."""
    measure, unit = Threshold(assumed["attraction_form"]), _UNIT[assumed["angle_unit"]]
    d, goal = THRESHOLD * unit, np.zeros(6)
    rows = np.random.default_rng(SEED).uniform(-np.pi, np.pi, (_SAMPLES, 6))
    forces = [conic_force(q, goal, ZETA, d, measure) for q in rows]
    numeric = [-_gradient(lambda x: conic_potential(x, goal, ZETA, d, measure), q) for q in rows]
    bound = d * ZETA * (1.0 if measure is Threshold.NORM else np.sqrt(6.0))
    worst = max(float(np.linalg.norm(f - n) / bound) for f, n in zip(forces, numeric, strict=True))
    largest = max(float(np.linalg.norm(f)) for f in forces)
    return Result(
        obtained={"difference": worst, "largest_over_bound": largest / bound, "bound": bound},
        caption=(
            f"The attraction is the negative slope of (5) to {worst:.0e} and never exceeds "
            f"{bound:g}, "
            "which is what the threshold is introduced for. The printed formula is lost."
        ),
    )


@checks(
    "qiu.eq07",
    samples=32,
    rules=[
        Bounded(key="at_range", high=1e-12, label="value at the end of the range"),
        Is(key="grows", value=True, label="it grows without bound towards the obstacle"),
        NoOriginal(key="formula", label=_LOST),
    ],
)
def repulsive_potential(assumed: Assumed) -> Result:
    """Zero at the end of the range, unbounded at the obstacle."""
    rho = np.array([1e-6, 1e-4, 1e-2, 0.1, 0.3, INFLUENCE, 1.0])
    values = inverse_distance_potential(rho, ETA0, INFLUENCE)
    points, sources = assumed["control_points"], assumed["repulsion_sources"]
    return Result(
        obtained={
            "at_range": float(values[-2:].max()),
            "grows": bool((np.diff(values) <= 0).all() and values[0] > 1e6 * values[2]),
            "control_points": len(CONTROL_POINTS[points][0]),
            "sources": sources,
        },
        table=pd.DataFrame({"rho_m": rho, "potential": values}),
        caption=(
            "The reconstructed repulsion of one control point vanishes from the end of its range "
            "on and "
            "grows without bound towards the obstacle. The printed formula is lost."
        ),
    )


@checks(
    "qiu.eq08",
    samples=32,
    rules=[
        Bounded(
            key="direction", high=1e-9, label="printed direction against the slope of the distance"
        ),
        Bounded(key="slope", high=1e-5, label="force against finite differences of (7), relative"),
        NoOriginal(key="factor", label="the factor in front of the gradient"),
    ],
)
def repulsive_force(assumed: Assumed) -> Result:
    """The printed gradient of the distance, and the force as the slope of (7)."""
    made = _problem({**_PLAIN, **_fields(assumed)})
    worst, direction = 0.0, 0.0
    for q in _postures(made.goal):
        found = surroundings_at(made, 0, q, 0)
        for k, m in zip(*np.nonzero(found.acting(made.settings.repulsion.sources)), strict=True):
            sphere = list(spheres().values())[m]
            foot = sphere.center + sphere.radius * _unit(found.points[k] - sphere.center)
            direction = max(
                direction,
                float(np.linalg.norm(_unit(found.points[k] - foot) - found.outward[k, m])),
            )
            rho = float(found.distance[k, m])
            if rho < INFLUENCE - 1e-3:
                slope = _gradient(
                    lambda x: float(inverse_distance_potential(x[0], ETA0, INFLUENCE)),
                    np.array([rho]),
                )
                force = inverse_distance_force(rho, ETA0, INFLUENCE, _CONTACT)
                worst = max(worst, abs(force + float(slope[0])) / max(force, 1.0))
    return Result(
        obtained={"direction": direction, "slope": worst},
        caption=(
            "The printed direction from the nearest obstacle point to the control point is the "
            "slope of "
            f"the distance to {direction:.0e}; with the factor of the textbook the force is the "
            "negative "
            f"slope of (7) to {worst:.0e}. The factor is not in the text edition."
        ),
    )


@checks(
    "qiu.eq09",
    samples=32,
    rules=[
        Bounded(
            key="difference", high=1e-5, label="joint forces against finite differences, relative"
        ),
        NoOriginal(key="formula", label=_LOST),
    ],
)
def joint_forces(assumed: Assumed) -> Result:
    """The sum of transposed velocity Jacobians times point forces."""
    made = _problem({**_PLAIN, **_fields(assumed)})
    worst = 0.0
    for q in _postures(made.goal):
        torque, numeric = _torque(made, q), -_gradient(lambda x: _repulsive(made, x), q)
        if np.linalg.norm(numeric) > 1.0:
            worst = max(worst, float(np.linalg.norm(torque - numeric) / np.linalg.norm(numeric)))
    return Result(
        obtained={"difference": worst},
        caption=(
            f"Carried over by transposed Jacobians, the point forces are the negative slope of the "
            f"repulsive potential over the joints, to a relative {worst:.0e}. The printed formula "
            "is lost."
        ),
    )


_PLAIN: dict[str, Any] = {
    "attraction_form": "norm",
    "repulsion_sources": "nearest",
    "control_points": "elbow_wrist_flange",
    "gain_ratio": ETA0 / ZETA,
    "step_rule": "unit_vector",
    "joint_tolerance": 0.05,
    "search_cap": 1,
    "stuck_rule": 1,
}


def _fields(assumed: Assumed) -> dict[str, Any]:
    return {name: assumed[name] for name in ("control_points", "repulsion_sources")}


def _problem(values: dict[str, Any]) -> SearchProblem:
    """The master between start and pulled-back goal, for evaluating terms."""
    arm = placed("master")
    inside = pulled_back(MASTER_GOAL, arm.placement.translation, 0.63)
    goal = branch_posture(arm, inside, "front_shallow")
    return search_problem(arm, START, goal, repelling(), settings(values, TRADITIONAL_VARIANT))


def _postures(goal: np.ndarray) -> np.ndarray:
    """Postures around the straight line from start to goal, clear of the creases where the nearest
    obstacle of a control point changes."""
    rng = np.random.default_rng(SEED)
    share = rng.uniform(0.0, 0.45, _SAMPLES)
    return share[:, np.newaxis] * goal + rng.normal(0.0, 0.1, (_SAMPLES, 6))


def _repulsive(made: SearchProblem, q: np.ndarray) -> float:
    found = surroundings_at(made, 0, q, 0)
    acting = found.acting(made.settings.repulsion.sources)
    return float((inverse_distance_potential(found.distance, _eta(made), INFLUENCE) * acting).sum())


def _torque(made: SearchProblem, q: np.ndarray) -> np.ndarray:
    gains = np.full(len(made.points.joint), _eta(made))
    return repulsive_torque(made, surroundings_at(made, 0, q, 0), gains)


def _eta(made: SearchProblem) -> float:
    return made.settings.repulsion.gain


def _unit(vector: np.ndarray) -> np.ndarray:
    return vector / np.linalg.norm(vector)


def _gradient(function: Callable[[np.ndarray], float], x: np.ndarray) -> np.ndarray:
    """Central differences."""
    shifts = 1e-6 * np.eye(len(x))
    return np.array([function(x + s) - function(x - s) for s in shifts]) / 2e-6
