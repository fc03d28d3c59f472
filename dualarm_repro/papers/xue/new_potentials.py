"""Equations (13)-(16) of `xue` and the virtual point: print against the potentials run."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...ledger import Assumed, Is, Residual, Result, Role
from ...planning.descent.problem import PlanningProblem
from ...planning.descent.virtual_point import initial
from ...planning.field.control_points import control_points, end_effector, ends_of
from ...view.shares import curve_figure
from .agreement import GRADIENT, VALUE, agreement, checks, choices, difference, worst
from .chosen import nominal
from .motions import master_plan
from .printed_field import (
    attraction,
    new_attraction,
    new_attractions,
    repulsion,
    slope,
    summands,
    summed,
    total,
)
from .sample_problem import sample_problem, samples
from .scenario import GAINS
from .stored import minima_shares

#: Factor by which the unit of length is made smaller; any but 1 would do.
_UNIT = 2.0


@checks(
    "xue.eq13",
    samples=32,
    rules=[
        VALUE(),
        GRADIENT(),
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
    made = sample_problem(joint_weight=weight)
    q = samples(made)
    square, angles = _squares(made, q)
    ratio = float(np.median(square / angles))
    minima, scaling = minima_shares(), term_scaling()
    found = agreement("(13)", new_attractions(made, q), made.attraction, q)
    return Result(
        obtained={
            **found.obtained,
            **scaling,
            "value_at_weight_one": _at_weight_one(),
            "position_to_joint_in_m": ratio,
            "position_to_joint_in_mm": 1e6 * ratio,
            "minima_share": {f"{w:g}": found_share.value for w, found_share in minima.items()},
        },
        caption=(
            f"{found.caption} With a unit of length {_UNIT:g} times smaller the position term "
            f"grows {scaling['position_factor']:.3g} times and the joint term "
            f"{scaling['joint_factor']:.3g} times. Lengths in metres make the position term "
            f"{ratio:.2g} times the joint term in the middle of the samples, in millimetres it "
            f"would be {1e6 * ratio:.1g} times. Without any obstacle {minima[1.0].value:.1%} of "
            f"random descents end in a minimum elsewhere with metres, {minima[1e-6].value:.0%} "
            "with millimetres."
        ),
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
    return difference(new_attractions(made, q), made.attraction.value(q))


def term_scaling() -> dict[str, float | bool]:
    """How the two terms of (13), as printed, grow when the unit of length shrinks.

    One term is had alone where the other vanishes: at the goal angles, or at the goal position.
    They have one dimension if both grow alike; where either is absent print shows no conflict.
    """
    made = sample_problem()
    q = samples(made)[:1]
    (x,), goal = end_effector(made.placed, q), made.goal_point
    joints = (q[0], made.goal)
    at_goal = (made.goal, made.goal)

    def factor(here: np.ndarray, angles: tuple[np.ndarray, np.ndarray]) -> float:
        before, after = (new_attraction(u * here, u * goal, *angles) for u in (1.0, _UNIT))
        return after / before if before else float("nan")

    position, joint = factor(x, at_goal), factor(goal, joints)
    differ = np.isfinite([position, joint]).all() and not np.isclose(position, joint)
    return {
        "one_dimension": not differ,
        "position_factor": position,
        "joint_factor": joint,
    }


@checks("xue.eq14", rules=[VALUE(), GRADIENT()])
def point_repulsion(assumed: Assumed) -> Result:
    """(14): one potential per control point, for every reading of points and bars."""
    found = {}
    for reading in choices("window_distance"):
        for points in choices("control_points"):
            made = sample_problem(reading, points)
            q = samples(made)[:40]
            printed = repulsion(
                "eq14", made.repulsion.distances(q), nearest=reading == "nearest_bar"
            )
            run = made.repulsion.terms(q)
            result = agreement("(14)", printed.sum(axis=1), made.repulsion, q)
            result.obtained["value"] = float(abs(printed - run).max())
            found[f"{points} with {reading}"] = result
    return worst(found, "(14), point by point")


@checks(
    "xue.eq15",
    rules=[
        Is("as_many", "as many points as print sums over, in every reading", value=True),
        VALUE(),
    ],
)
def five_summands(assumed: Assumed) -> Result:
    """(15): the sum over the points; which five of the six joints is left open."""
    differences, counts, fixed = [], {}, {}
    for choice in choices("control_points"):
        made = sample_problem(control_points=choice)
        q = samples(made)[:60]
        terms = made.repulsion.terms(q)
        differences.append(float(abs(summed(terms) - made.repulsion.value(q)).max()))
        counts[choice] = len(made.points.names)
        ends = ends_of(made.placed, control_points(made.placed.arm, choice), q)
        still = np.ptp(ends, axis=0).max(axis=(1, 2)) == 0.0
        fixed[choice] = [
            name for name, rests in zip(made.points.names, still, strict=True) if rests
        ]
    rests = "; ".join(f"{', '.join(names)} of {choice}" for choice, names in fixed.items() if names)
    return Result(
        obtained={
            "as_many": all(count == summands() for count in counts.values()),
            "summands": summands(),
            "points": counts,
            "value": float(np.max(differences)),
            "cannot_move": fixed,
        },
        caption=(
            f"Print sums {summands():.0f} terms; each of the readings {', '.join(counts)} has as "
            "many points. The sum of their potentials differs from the repulsion that is descended "
            f"by at most {np.max(differences):.0e}. No joint can move {rests or 'none of them'}."
        ),
    )


@checks("xue.eq16", rules=[VALUE(), GRADIENT()])
def total_potential(assumed: Assumed) -> Result:
    """(16) against what the arm descends when it sets out."""
    switching, term = assumed["virtual_switching"], assumed["virtual_term"]
    made = sample_problem(virtual_switching=switching, virtual_joints=term == "position_and_joints")
    q = samples(made)
    repulsive = summed(repulsion("eq14", made.repulsion.distances(q), nearest=False))
    printed = total(new_attractions(made, q), repulsive)
    field = made.field_in(initial(made.switch_rules))
    found = agreement("(16)", printed, field, q)
    lacking = " Print lacks the term of the virtual point, which acts from the start."
    return replace(
        found,
        caption=found.caption + ("" if len(field.parts) == 2 else lacking),
    )


@checks(
    "xue.eq_virtual",
    rules=[
        VALUE(),
        GRADIENT(),
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
    switching, case = assumed["virtual_switching"], nominal()
    gain, centre = case.method.virtual_gain, case.layout.window_centre
    found = {}
    for term in choices("virtual_term"):
        joints = term == "position_and_joints"
        made = sample_problem(
            virtual_gain=gain, virtual_centre=tuple(centre.tolist()), virtual_joints=joints
        )
        q = samples(made)
        found[term] = agreement("The term", _virtual(made, q, joints), made.virtual, q)
    result = worst(found, "The term of the virtual point, in the form (9) or (13)")
    plan = master_plan(case.layout, replace(case.method, virtual_switching=switching))
    share = gain / (gain + GAINS["k_a"])
    off = float(np.linalg.norm(plan.tcp[-1] - end_effector(plan.placed, plan.goal)))
    result.obtained.update(
        rest_slope=rest_slope(), rest_share=share, arrives=plan.reached, end_off_goal=off
    )
    return replace(
        result,
        caption=(
            f"{result.caption} An end effector that both attract rests {share:.0%} of the way from "
            "the goal to the virtual point, so that the point must be off when the goal is to be "
            f"reached. Switched '{switching.replace('_', ' ')}', it lets the master end "
            f"{off:.3f} m from its goal."
        ),
    )


def rest_slope() -> float:
    """Slope of (9) for goal and virtual point together, at their mean weighted by the gains."""
    made, case = sample_problem(), nominal()
    gain, centre, goal = case.method.virtual_gain, case.layout.window_centre, made.goal_point
    rest = (GAINS["k_a"] * goal + gain * centre) / (GAINS["k_a"] + gain)

    def both(x: np.ndarray) -> float:
        return attraction(x, goal) + attraction(x, centre, gain)

    return float(abs(slope(both, rest)).max())


def _virtual(made: PlanningProblem, q: np.ndarray, joints: bool) -> np.ndarray:
    """The form printed for the goal, (9) or (13), with the virtual point and its gain (N,)."""
    point = made.settings.virtual_point
    centre, flange = np.array(point.position), end_effector(made.placed, q)
    if not joints:
        return np.array([attraction(x, centre, point.gain) for x in flange])
    angles = np.array(point.joints)
    return np.array(
        [
            new_attraction(x, centre, row, angles, point.gain)
            for x, row in zip(flange, q, strict=True)
        ]
    )


def _squares(made: PlanningProblem, q: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """|X - X_g|^2 and the sum of |theta_i - theta_gi|^2, (N,) each."""
    flange = end_effector(made.placed, q)
    return np.sum((flange - made.goal_point) ** 2, axis=1), np.sum((q - made.goal) ** 2, axis=1)
