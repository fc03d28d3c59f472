"""Figures 4 and 5 and equations (4)-(9) of `qiu`: the potential field and its forces."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np
import pandas as pd

from .....differences import central_differences
from .....ledger import REGISTRY, Assumed, Bounded, Is, NoOriginal, Residual, Result
from .....ledger.captions import captions
from .....ledger.printed import EXACT
from .....planning.field.disc_field import DiscField
from .....planning.field.joint_attraction import conic_force, conic_potential
from .....planning.field.repulsive_force import inverse_distance_force, inverse_distance_potential
from .....planning.search.bidirectional import surroundings_at
from .....planning.search.bidirectional_settings import Threshold
from .....planning.search.search_field import repulsive_potential_at, repulsive_torque_at
from .....planning.search.search_problem import SearchProblem, search_problem
from .....view.force_field import force_field_figure
from .....view.tip_paths import TipPanel, tip_path_figure
from ...document import PRINTED, SEED, placed, printed_side, repelling, spheres
from ...reading import CONTROL_POINTS, Search

checks = partial(REGISTRY.checks, page="qiu/field")
caption = captions(__file__)
_CONTACT = 1e-3
_SAMPLES, _TABLED = 40, 100
_NO_FORMULA = NoOriginal("formula", "the formula")


@checks(
    "qiu.fig04",
    rules=[
        Residual("balance", "sum of the forces against the slope, relative", high=1e-6),
        NoOriginal("drawing", "the drawing"),
    ],
)
def principle(assumed: Assumed) -> Result:
    """A point among a goal and an obstacle: both forces and their sum."""
    place = np.array([1.0, 0.0]), np.array([0.45, -0.05]), 0.15  # goal, centre and radius
    made = DiscField(*place, PRINTED.zeta, PRINTED.threshold, 4.0, PRINTED.influence)
    points = np.array([[0.0, 0.25], [0.12, 0.05], [0.45, 0.32], [0.75, -0.2]])
    return Result(
        obtained={"balance": max(made.imbalance(point) for point in points)},
        caption=caption("fig04"),
        alt="Level lines of a potential around a disc and a goal; arrows of attraction, repulsion "
        "and their sum at four points.",
        figure=lambda: force_field_figure(made.potential, made.forces, *place, points),
    )


@checks(
    "qiu.fig05",
    rules=[
        Is("joints", "joints whose origins are the control points", to="joints"),
        Is("distinct", "the control points are distinct", value=True),
        NoOriginal("positions", "where the origins of the joints are"),
    ],
)
def control_points(assumed: Assumed) -> Result:
    """The three control points on the arm at zero joints."""
    chosen, arm, zero = CONTROL_POINTS[assumed["control_points"]], placed("master"), PRINTED.start
    origins = arm.arm.joint_positions(zero) @ arm.placement.rotation.T + arm.placement.translation
    points = origins[np.array(chosen.frames) - 1]
    apart = np.linalg.norm(points[:, None] - points[None], axis=2)
    named = {f"O{k}": point for k, point in enumerate(points, 1)}
    panel = TipPanel("control points at zero joints", {}, [(arm, zero)], named)
    return Result(
        obtained={
            "joints": {f"O{k}": joint for k, joint in enumerate(chosen.joints, 1)},
            "points": points.tolist(),
            "radii": list(chosen.radii),
            "distinct": bool(apart[~np.eye(len(points), dtype=bool)].min() > EXACT),
        },
        caption=caption("fig05", origins=chosen.joints),
        alt="Stick figure of the arm at zero joints with its control points marked and named.",
        figure=lambda: tip_path_figure([panel], []),
    )


@checks(
    "qiu.eq04",
    rules=[Residual("difference", "resultant against finite differences, relative", high=1e-5)],
)
def resultant(assumed: Assumed) -> Result:
    """The printed sides on postures along the way, slopes by central differences."""
    made = _problem(Search.nominal())
    attraction, worst = (made.goal, PRINTED.zeta, PRINTED.threshold, Threshold.NORM), 0.0
    for q in _postures(made.goal):
        pull, push = conic_force(q, *attraction), repulsive_torque_at(made, q)
        given = {
            "F": pull + push,
            "F_att": pull,
            "F_rep": push,
            "U_att": lambda q: conic_potential(q, *attraction),
            "U_rep": partial(repulsive_potential_at, made),
            "grad": partial(central_differences, x=q),
        }
        sides = [printed_side("eq04", k, given) for k in range(3)]
        size = float(np.linalg.norm(pull + push))
        gaps = [float(np.linalg.norm(side - sides[0])) / size for side in sides[1:]]
        worst = max(worst, *(gap if np.isfinite(gap) else np.inf for gap in gaps))
    return Result(
        obtained={"difference": worst, "postures": _SAMPLES},
        table=_forces(made, attraction),
        caption=caption("eq04"),
    )


def _forces(
    made: SearchProblem, attraction: tuple[np.ndarray, float, float, Threshold]
) -> pd.DataFrame:
    """Both forces at random postures (N, 6) [rad], as columns of joints."""
    q = made.placed.arm.random_configurations(_TABLED, np.random.default_rng(SEED))
    parts = {
        "q": q,
        "goal": np.tile(made.goal, (_TABLED, 1)),
        "F_att": [conic_force(row, *attraction) for row in q],
        "F_rep": [repulsive_torque_at(made, row) for row in q],
    }
    frames = (
        pd.DataFrame(rows, columns=[f"{name}{j}" for j in range(1, 7)])
        for name, rows in parts.items()
    )
    return pd.concat(frames, axis=1)


@checks(
    "qiu.eq05",
    rules=[
        Residual("jump", "jump of value or slope at the threshold, relative", high=1e-6),
        Residual("growth_far", "beyond the threshold it grows linearly, to", high=1e-9),
        _NO_FORMULA,
    ],
)
def attractive_potential(assumed: Assumed) -> Result:
    """Quadratic inside the threshold, conic outside, smooth across it, by either measure."""
    zeta, d, goal, ray = PRINTED.zeta, PRINTED.threshold, np.zeros(6), np.eye(6)[0]
    step, jumps, growths = 1e-4 * d, [], []
    for measure in Threshold:
        near, inside, at, outside, mid, far = (
            conic_potential(r * ray, goal, zeta, d, measure)
            for r in (2 * d, d - step, d, d + step, 2.5 * d, 3 * d)
        )
        slopes = (at - inside) / step, (outside - at) / step
        jumps.append(abs(slopes[1] - slopes[0]) / (zeta * d) - 0.5 * step / d)
        growths.append(abs(far - 2 * mid + near) / at)
    return Result(
        obtained={"jump": max(*jumps, 0.0), "growth_far": max(growths)}, caption=caption("eq05")
    )


@checks(
    "qiu.eq06",
    rules=[
        Residual("difference", "force against finite differences, relative", high=1e-6),
        Residual("beyond_bound", "largest force beyond its bound, relative", high=1e-12),
        _NO_FORMULA,
    ],
)
def attractive_force(assumed: Assumed) -> Result:
    """The negative gradient of (5); the threshold bounds it, by either measure."""
    zeta, d, goal = PRINTED.zeta, PRINTED.threshold, np.zeros(6)
    rows = np.random.default_rng(SEED).uniform(-np.pi, np.pi, (_SAMPLES, 6))
    worst, largest, bounds = 0.0, 0.0, {}
    for measure in Threshold:
        bound = bounds[str(measure)] = d * zeta * np.sqrt(6.0 if measure != "norm" else 1.0)
        for q in rows:
            force = conic_force(q, goal, zeta, d, measure)
            potential = partial(conic_potential, goal=goal, gain=zeta, threshold=d, measure=measure)
            slope = central_differences(potential, q)
            worst = max(worst, float(np.linalg.norm(force + slope)) / bound)
            largest = max(largest, float(np.linalg.norm(force)) / bound)
    return Result(
        obtained={"difference": worst, "beyond_bound": largest - 1.0, "bounds": bounds},
        caption=caption("eq06"),
    )


@checks(
    "qiu.eq07",
    rules=[
        Residual("at_range", "value at the end of the range", high=1e-12),
        Is("grows", "it grows without bound towards the obstacle", value=True),
        _NO_FORMULA,
    ],
)
def repulsive_potential(assumed: Assumed) -> Result:
    """Zero at the end of the range, unbounded at the obstacle."""
    rho = np.array([1e-6, 1e-4, 1e-2, 0.1, 0.3, PRINTED.influence, 1.0])
    values = inverse_distance_potential(rho, PRINTED.eta0, PRINTED.influence)
    return Result(
        obtained={
            "at_range": float(values[-2:].max()),
            "grows": bool((np.diff(values) <= 0).all() and values[0] > 1e6 * values[2]),
        },
        table=pd.DataFrame({"rho_m": rho, "potential": values}),
        caption=caption("eq07"),
    )


@checks(
    "qiu.eq08",
    rules=[Residual("direction", "printed direction against the slope of the distance", high=1e-9)],
)
def repulsive_direction(assumed: Assumed) -> Result:
    """The printed gradient of the distance, at every point that is repelled."""
    balls, direction, count = list(spheres().values()), 0.0, 0
    for point, m, _, outward in _repelled():
        away = point - balls[m].center
        foot = balls[m].center + balls[m].radius * away / np.linalg.norm(away)
        printed = printed_side("eq08", 1, {"a_i": point, "O_s": foot}, "gradient")
        gap = float(np.linalg.norm(printed - outward))
        direction, count = max(direction, gap if np.isfinite(gap) else np.inf), count + 1
    return Result(obtained={"direction": direction}, caption=caption("eq08", points=count))


@checks(
    "qiu.eq08_factor",
    rules=[
        Residual("slope", "force against finite differences of (7), relative", high=1e-5),
        NoOriginal("factor", "the factor in front of the gradient"),
    ],
)
def repulsive_size(assumed: Assumed) -> Result:
    """The size of the force as the slope of (7)."""
    eta0, influence, worst = PRINTED.eta0, PRINTED.influence, 0.0
    for _, _, rho, _ in _repelled():
        if rho < influence - 1e-3:
            slope = central_differences(
                lambda x: inverse_distance_potential(x[0], eta0, influence), [rho]
            )
            force = inverse_distance_force(rho, eta0, influence, _CONTACT)
            worst = max(worst, abs(force + float(slope[0])) / max(force, 1.0))
    return Result(obtained={"slope": worst}, caption=caption("eq08_factor"))


def _repelled() -> Iterator[tuple[np.ndarray, int, float, np.ndarray]]:
    """Points (3,) that a sphere of some number repels on the way, their distance and the direction
    away from it (3,)."""
    made = _problem(Search.nominal())
    for q in _postures(made.goal):
        found = surroundings_at(made, 0, q, 0)
        for k, m in zip(*np.nonzero(found.acting(made.settings.repulsion.sources)), strict=True):
            yield found.points[k], int(m), float(found.distance[k, m]), found.outward[k, m]


@checks(
    "qiu.claim_inverse",
    rules=[
        Bounded(
            "departure", "slope of ln F over ln rho, farthest from that of 1 / rho", high="apart"
        )
    ],
)
def inverse_proportion(assumed: Assumed) -> Result:
    """Slope of the assumed force on logarithmic axes over its range; minus one is 1 / rho."""
    influence, form = PRINTED.influence, assumed["repulsion_form"]
    rho = np.geomspace(0.02, 0.98, 97) * influence
    force = np.array([repulsion(form, r) for r in rho])
    slope = np.gradient(np.log(force), np.log(rho))
    return Result(
        obtained={
            "form": form,
            "departure": float(np.abs(slope + 1.0).max()),
            "slope": {"near": float(slope[1]), "far": float(slope[-2])},
            "falls": bool((np.diff(force) < 0.0).all()),
            "jump": repulsion(form, influence),
        },
        table=pd.DataFrame({"rho_m": rho, "force": force, "slope": slope}),
        caption=caption("claim_inverse", pull=PRINTED.threshold * PRINTED.zeta),
    )


def repulsion(form: str, rho: float) -> float:
    """Size of the repulsive force of the printed gain at a distance rho [m], in one of the forms
    that the text allows: the slope of the textbook potential, or eta_0 / rho to the letter."""
    if form == "inverse":
        return PRINTED.eta0 / rho
    return float(inverse_distance_force(rho, PRINTED.eta0, PRINTED.influence, _CONTACT))


@checks(
    "qiu.eq09",
    rules=[
        Residual("difference", "joint forces against finite differences, relative", high=1e-5),
        _NO_FORMULA,
    ],
)
def joint_forces(assumed: Assumed) -> Result:
    """The sum of transposed velocity Jacobians times point forces, for every control point set."""
    cases = [("elbow_wrist_flange", "nearest"), *((points, "sum") for points in CONTROL_POINTS)]
    worst = 0.0
    for points, sources in cases:
        made = _problem(Search.nominal(control_points=points, repulsion_sources=sources))
        for q in _postures(made.goal):
            slope = central_differences(partial(repulsive_potential_at, made), q)
            if (size := np.linalg.norm(slope)) > 1.0:
                gap = np.linalg.norm(repulsive_torque_at(made, q) + slope) / size
                worst = max(worst, float(gap))
    return Result(obtained={"difference": worst, "cases": len(cases)}, caption=caption("eq09"))


def _problem(reading: Search) -> SearchProblem:
    """The master between start and pulled-back goal, for evaluating terms."""
    ends = PRINTED.start, reading.posture()
    return search_problem(reading.arm(), *ends, repelling(), reading.settings())


def _postures(goal: np.ndarray) -> np.ndarray:
    """Postures around the straight line from start to goal, clear of the creases where the nearest
    obstacle of a control point changes."""
    rng = np.random.default_rng(SEED)
    share = rng.uniform(0.0, 0.45, _SAMPLES)
    return share[:, np.newaxis] * goal + rng.normal(0.0, 0.1, (_SAMPLES, 6))
