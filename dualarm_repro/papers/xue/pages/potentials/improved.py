"""Equations (13)-(16) of `xue` and the virtual point: print against the potentials run."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pandas as pd

from .....ledger import Assumed, Is, Residual, Result, Role
from .....ledger.captions import captions
from .....planning.descent.problem import PlanningProblem
from .....planning.descent.virtual_point import initial
from .....planning.field.control_points import control_points, end_effector, ends_of
from .....view.shares import curve_figure
from ...document import gains
from ...motions import master_plan, present
from ...reading import nominal
from ...stored import minima_shares
from . import printed_field as printed
from .agreement import (
    GRADIENT,
    VALUE,
    WINDOW,
    agreement,
    checks,
    choices,
    sample_problem,
    samples,
    worst,
)

caption = captions(__file__)
#: Factor by which the unit of length is made smaller; any but 1 would do.
_UNIT = 2.0
#: Postures whose forces are exported.
_EXPORTED = 100


@checks(
    "xue.eq13",
    samples=32,
    rules=[
        VALUE,
        GRADIENT,
        Is(
            "one_dimension",
            "both printed terms scale alike with the unit of length",
            value=False,
            role=Role.CONTRADICTS,
        ),
        Residual(
            "value_at_weight_one",
            "difference of print to the sum that is run with weight 1",
            high=1e-9,
            role=Role.CONTRADICTS,
        ),
    ],
)
def improved_attraction(assumed: Assumed) -> Result:
    """(13): position and joint term, how they scale, and what the unit of length decides."""
    weight = assumed["joint_term_weight"]
    made = sample_problem(joint_term_weight=weight)
    q = samples(made)
    gaps = (end_effector(made.placed, q) - made.goal_point, q - made.goal)
    square, angles = (np.sum(gap**2, axis=1) for gap in gaps)
    ratio, minima = float(np.median(square / angles)), minima_shares()
    found = agreement("(13)", printed.new_attractions(made, q), made.attraction, q)
    return Result(
        obtained={
            **found.obtained,
            **term_scaling(),
            "value_at_weight_one": _at_weight_one(),
            "position_to_joint_in_m": ratio,
            "position_to_joint_in_mm": 1e6 * ratio,
            "minima_share": {f"{w:g}": share.value for w, share in minima.items()},
        },
        caption=caption("eq13", agreement=found.told(), unit=_UNIT),
        alt="Share of descents without obstacle that end elsewhere, falling with the joint weight.",
        figure=lambda: curve_figure(
            list(minima),
            {"in a minimum elsewhere": list(minima.values())},
            "weight of the joint term [m$^2$/rad$^2$]",
            "share of random start and goal pairs",
            log=True,
        ),
    )


def _at_weight_one() -> float:
    made = sample_problem()
    q = samples(made)
    return printed.difference(printed.new_attractions(made, q), made.attraction.value(q))


def term_scaling() -> dict[str, float | bool]:
    """How the two terms of (13), as printed, grow when the unit of length shrinks.

    One term is had alone where the other vanishes: at the goal angles, or at the goal position.
    They have one dimension if both grow alike; where either is absent print shows no conflict.
    """
    made = sample_problem()
    q = samples(made)[:1]
    (x,), goal = end_effector(made.placed, q), made.goal_point

    def factor(here: np.ndarray, angles: np.ndarray) -> float:
        before, after = (
            printed.new_attraction(u * here, u * goal, angles, made.goal) for u in (1.0, _UNIT)
        )
        return after / before if before else float("nan")

    position, joint = factor(x, made.goal), factor(goal, q[0])
    differ = np.isfinite([position, joint]).all() and not np.isclose(position, joint)
    return {"one_dimension": not differ, "position_factor": position, "joint_factor": joint}


@checks("xue.eq14", rules=[VALUE, GRADIENT])
def point_repulsion(assumed: Assumed) -> Result:
    """(14): one potential per control point, for every reading of points and bars."""
    found = {}
    for reading in choices("window_distance"):
        for points in choices("control_points"):
            made = sample_problem(window_distance=reading, control_points=points)
            q = samples(made)[:40]
            distances, nearest = made.repulsion.distances(q), reading == "nearest_bar"
            terms = printed.repulsion("eq14", distances, nearest=nearest)
            result = agreement("(14)", terms.sum(axis=1), made.repulsion, q)
            result.obtained["value"] = printed.difference(terms, made.repulsion.terms(q))
            found[f"{points} with {reading}"] = result
    return worst(found, "(14), point by point")


@checks(
    "xue.eq15",
    rules=[Is("as_many", "as many points as print sums over, in every reading", value=True), VALUE],
)
def five_summands(assumed: Assumed) -> Result:
    """(15): the sum over the points; which five of the six joints is left open."""
    differences, counts, fixed = [], {}, {}
    for choice in choices("control_points"):
        made = sample_problem(control_points=choice)
        q = samples(made)[:60]
        terms = made.repulsion.terms(q)
        differences.append(printed.difference(printed.summed(terms), made.repulsion.value(q)))
        counts[choice] = len(made.points.names)
        ends = ends_of(made.placed, control_points(made.placed.arm, choice), q)
        still = np.ptp(ends, axis=0).max(axis=(1, 2)) == 0.0
        names = made.points.names
        fixed[choice] = [name for name, rests in zip(names, still, strict=True) if rests]
    summands = printed.summands()
    return Result(
        obtained={
            "as_many": all(count == summands for count in counts.values()),
            "summands": summands,
            "points": counts,
            "value": float(np.max(differences)),
            "cannot_move": fixed,
        },
        caption=caption("eq15"),
    )


@checks("xue.eq16", rules=[VALUE, GRADIENT])
def total_potential(assumed: Assumed) -> Result:
    """(16) against what the arm descends when it sets out."""
    switching, term = assumed["virtual_switching"], assumed["virtual_term"]
    made = sample_problem(virtual_switching=switching, virtual_term=term)
    q = samples(made)
    repulsive = printed.repulsion("eq14", made.repulsion.distances(q), nearest=False)
    total = printed.total(printed.new_attractions(made, q), printed.summed(repulsive))
    field = made.field_in(initial(made.switch_rules))
    found = agreement("(16)", total, field, q)
    found.obtained["window"] = WINDOW
    lacking = " Print lacks the term of the virtual point, which acts from the start."
    told = found.told() + ("" if len(field.parts) == 2 else lacking)
    return replace(found, caption=told, table=_forces(made, q[:_EXPORTED]))


def _forces(made: PlanningProblem, q: np.ndarray) -> pd.DataFrame:
    """Joints, total potential and joint forces -dU/dq of (16) at postures (N, 6)."""
    columns = {f"q{j + 1}_rad": angle for j, angle in enumerate(q.T)}
    columns["U"] = np.asarray(made.field.value(q))
    forces = -np.array([made.field.gradient(row) for row in q])
    columns |= {f"tau{j + 1}": torque for j, torque in enumerate(forces.T)}
    return pd.DataFrame(columns)


@checks(
    "xue.eq_virtual",
    rules=[
        VALUE,
        GRADIENT,
        Residual(
            "rest_slope",
            "slope of both attractions, as printed, at (k_a X_g + k_av X_v)/(k_a + k_av)",
            high=1e-6,
        ),
        Is("arrives", "the master arrives in spite of the virtual point", value=True),
    ],
)
def virtual_attraction(assumed: Assumed) -> Result:
    """The virtual point: the form printed for the goal with k_av, and where an arm rests."""
    switching = assumed["virtual_switching"]
    case = nominal(virtual_switching=switching)
    gain, centre = case.planner.virtual_gain, case.layout.window_centre
    found = {}
    for term in choices("virtual_term"):
        made = sample_problem(tuple(centre.tolist()), virtual_gain=gain, virtual_term=term)
        q = samples(made)
        found[term] = agreement("The term", _virtual(made, q), made.virtual, q)
    result = worst(found, "The term of the virtual point, in the form (9) or (13)")
    plan = present(master_plan(case.layout, case.planner), "plan of the master")
    result.obtained.update(
        rest_slope=rest_slope(),
        rest_share=gain / (gain + gains()["k_a"]),
        arrives=plan.reached,
        end_off_goal=float(np.linalg.norm(plan.tcp[-1] - end_effector(plan.placed, plan.goal))),
    )
    told = caption("eq_virtual", agreement=result.told(), switching=switching.replace("_", " "))
    return replace(result, caption=told)


def rest_slope() -> float:
    """Slope of (9) for goal and virtual point together, at their mean weighted by the gains."""
    made, case = sample_problem(), nominal()
    gain, centre, goal = case.planner.virtual_gain, case.layout.window_centre, made.goal_point
    rest = (gains()["k_a"] * goal + gain * centre) / (gains()["k_a"] + gain)

    def both(x: np.ndarray) -> float:
        return printed.attraction(x, goal) + printed.attraction(x, centre, gain)

    return float(abs(printed.slope(both, rest)).max())


def _virtual(made: PlanningProblem, q: np.ndarray) -> np.ndarray:
    """The form printed for the goal, (9) or (13), with the virtual point and its gain (N,)."""
    point = present(made.settings.virtual_point, "virtual point")
    centre, flange = np.array(point.position), end_effector(made.placed, q)
    if point.joints is None:
        return np.array([printed.attraction(x, centre, point.gain) for x in flange])
    angles, pairs = np.array(point.joints), zip(flange, q, strict=True)
    return np.array([printed.new_attraction(x, centre, k, angles, point.gain) for x, k in pairs])
