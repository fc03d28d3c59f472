"""Equations (9)-(16) of `xue` and the virtual point: print against the potentials run."""

from __future__ import annotations

from functools import partial

import numpy as np
import sympy as sp
from sympy.physics.units import Dimension, length
from sympy.physics.units.systems.si import dimsys_SI

from ...ledger import REGISTRY, Assumed, Bounded, Is, Result, Role
from ...planning.control_points import control_points, end_effector, ends_of
from ...planning.potentials import Potential, Sum
from ...planning.problem import Problem
from ...view.shares import curve_figure
from .sample_problem import sample_problem, samples, worst_gradient
from .scenario import GAINS
from .stored import minima_shares

checks = partial(REGISTRY.checks, page="xue/potentials")

_VALUE = partial(
    Bounded, key="value", high=1e-9, label="largest difference of the field run to print"
)
_GRADIENT = partial(
    Bounded,
    key="gradient",
    high=1e-6,
    label="relative error of its gradient by central differences",
)


@checks("xue.eq09", rules=[_VALUE(), _GRADIENT()])
def traditional_attraction(assumed: Assumed) -> Result:
    """(9) at the flange against the attraction that is descended."""
    made = sample_problem()
    q, part = samples(made), made.attraction.parts[0]
    return _agreement("(9)", 0.5 * GAINS["k_a"] * _squares(made, q)[0], part, q)


@checks(
    "xue.eq10",
    rules=[
        _VALUE(),
        _GRADIENT(),
        Is(key="smooth_at_range", value=True, label="value and slope vanish at d_0, in symbols"),
    ],
    samples=4,
)
def traditional_repulsion(assumed: Assumed) -> Result:
    """(10) summed over the bars, or for the nearest one."""
    reading = assumed["window_distance"]
    made = sample_problem(reading, control_points="end_effector")
    q = samples(made)
    printed = _printed_repulsion(made.repulsion.distances(q), reading)
    energy, _, d, d0 = _symbolic_repulsion()
    smooth = all(expr.subs(d, d0).equals(0) for expr in (energy, energy.diff(d)))
    return _agreement("(10)", printed, made.repulsion, q, {"smooth_at_range": smooth})


@checks(
    "xue.eq11",
    rules=[
        Is(key="vector_form", value=True, label="-k_a (X - X_g) is the negative gradient of (9)"),
        _GRADIENT(),
        Is(
            key="printed_form",
            value=False,
            role=Role.CONTRADICTS,
            label="so is what is printed, with the modulus",
        ),
    ],
)
def attractive_force(assumed: Assumed) -> Result:
    """(11) as a vector and as printed, against the gradient of (9) in symbols."""
    forms = attractive_force_forms()
    made = sample_problem()
    error = worst_gradient(made.attraction.parts[0], samples(made))
    return Result(
        obtained={**forms, "gradient": error},
        caption=(
            "The negative gradient of (9) is the vector -k_a (X - X_g). With the modulus, as "
            "printed, the right side is one number: it gives neither the direction nor, along a "
            "line, the sign. The joint gradient k_a J^T (X - X_g) agrees with central "
            f"differences to {error:.0e}."
        ),
    )


def attractive_force_forms() -> dict[str, bool]:
    """Whether -grad U of (9) equals the vector form, and the printed scalar on a line."""
    k = sp.Symbol("k_a", positive=True)
    x, goal = sp.Matrix(sp.symbols("x:3", real=True)), sp.Matrix(sp.symbols("g:3", real=True))
    potential = k / 2 * (x - goal).dot(x - goal)
    force = -sp.Matrix([potential.diff(variable) for variable in x])
    on_line = {x[1]: goal[1], x[2]: goal[2]}
    printed = -k * sp.Abs(x[0] - goal[0])
    return {
        "vector_form": bool((force + k * (x - goal)).expand().is_zero_matrix),
        "printed_form": bool(sp.simplify(force[0].subs(on_line) - printed) == 0),
    }


@checks(
    "xue.eq12",
    rules=[
        Is(key="symbolic", value=True, label="sign and factors are those of the gradient of (10)"),
        _GRADIENT(),
    ],
)
def repulsive_force(assumed: Assumed) -> Result:
    """(12) against the derivative of (10) in symbols, and of the field run by differences."""
    energy, force, d, _ = _symbolic_repulsion()
    made = sample_problem(control_points="end_effector")
    error = worst_gradient(made.repulsion, samples(made))
    return Result(
        obtained={"symbolic": bool(sp.simplify(-energy.diff(d) - force) == 0), "gradient": error},
        caption=(
            "Differentiating (10) by d gives (12), sign and factors included. In the joints, "
            "through the nearest point's Jacobian, it agrees with central differences to "
            f"{error:.0e}."
        ),
    )


@checks(
    "xue.eq14",
    rules=[_VALUE(), _GRADIENT()],
    samples=8,
)
def point_repulsion(assumed: Assumed) -> Result:
    """(14): one potential per control point, mapped to the joints."""
    reading, points = assumed["window_distance"], assumed["control_points"]
    made = sample_problem(reading, points)
    q = samples(made)
    printed = _printed_repulsion(made.repulsion.distances(q), reading)
    return _agreement("(14), summed over the points,", printed, made.repulsion, q)


@checks(
    "xue.eq15",
    rules=[
        Is(key="points", value=5, label="number of summands"),
        _VALUE(),
        Is(key="all_movable", value=True, label="every one can be moved by some joint"),
    ],
    samples=4,
)
def five_summands(assumed: Assumed) -> Result:
    """(15): the sum over five points; which five of the six joints is left open."""
    choice = assumed["control_points"]
    made = sample_problem(control_points=choice)
    q = samples(made)
    printed = _printed_repulsion(made.repulsion.distances(q), "sum_over_bars")
    difference = float(abs(printed - made.repulsion.value(q)).max())
    ends = ends_of(made.placed, control_points(made.placed.arm, choice), q)
    moved = np.ptp(ends, axis=0).max(axis=(1, 2)) > 0.0
    names = ", ".join(made.points.names)
    return Result(
        obtained={
            "points": len(names.split(", ")),
            "value": difference,
            "all_movable": bool(moved.all()),
        },
        caption=(
            f"The sum runs over {len(moved)} points ({names}). "
            + ("Each" if moved.all() else f"Only {int(moved.sum())} of them")
            + " can be moved by the joints; the origin of frame 1 lies on the base axis and cannot."
        ),
    )


@checks(
    "xue.eq16",
    rules=[_VALUE(), _GRADIENT()],
    samples=8,
)
def total_potential(assumed: Assumed) -> Result:
    """(16) with the term of the virtual point, which print leaves out."""
    term, switching = assumed["virtual_term"], assumed["virtual_switching"]
    made = sample_problem()
    q = samples(made)
    acting = switching in ("always", "from_start")
    printed = _printed_attraction(made, q, 1.0)
    printed += _printed_repulsion(made.repulsion.distances(q), "sum_over_bars")
    if acting:
        printed += _printed_virtual(made, q)
    parts = [made.attraction, made.repulsion, *([made.virtual] if acting else [])]
    name = (
        f"(16) with the virtual point ({term})" if acting else "(16), the virtual point being off,"
    )
    return _agreement(name, printed, Sum(parts), q)


@checks(
    "xue.eq13",
    samples=32,
    rules=[
        _VALUE(),
        _GRADIENT(),
        Is(
            key="one_dimension",
            value=False,
            role=Role.CONTRADICTS,
            label="both terms of the sum have one physical dimension",
        ),
    ],
)
def improved_attraction(assumed: Assumed) -> Result:
    """(13): position and joint term, their dimensions, and what the unit of length decides."""
    unit, weight = assumed["length_unit"], assumed["joint_term_weight"]
    made = sample_problem(joint_weight=weight)
    q = samples(made)
    square, angles = _squares(made, q)
    ratio = float(np.median(square / angles))
    minima = minima_shares()
    found = _agreement("(13)", _printed_attraction(made, q, weight), made.attraction, q)
    return Result(
        obtained={
            **found.obtained,
            "one_dimension": one_dimension(),
            "position_to_joint_in_m": ratio,
            "position_to_joint_in_mm": 1e6 * ratio,
            "minima_share": {f"{w:g}": found_share.value for w, found_share in minima.items()},
        },
        caption=(
            f"{found.caption} A square of a length is added to a square of an angle: lengths in "
            f"{unit} give the position term {ratio:.2g} times the joint term in the middle of the "
            f"samples, in millimetres it would be {1e6 * ratio:.1g} times. Without any obstacle "
            f"{minima[1.0].value:.1%} of random descents end in a minimum elsewhere with metres, "
            f"{minima[1e-6].value:.0%} with millimetres."
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


def one_dimension() -> bool:
    """Whether |X - X_g|^2 and |theta - theta_g|^2 have one dimension; an angle has none."""
    position = dimsys_SI.get_dimensional_dependencies(length**2)
    angle = dimsys_SI.get_dimensional_dependencies(Dimension(1))
    return position == angle


@checks(
    "xue.eq_virtual",
    rules=[
        _VALUE(),
        _GRADIENT(),
        Is(
            key="rest_point",
            value=True,
            label="beside the goal it rests at (k_a X_g + k_av X_v)/(k_a + k_av)",
        ),
        Bounded(
            key="rest_offset", high=0.02, label="pull away from the goal when it is reached [m]"
        ),
    ],
    samples=8,
)
def virtual_attraction(assumed: Assumed) -> Result:
    """The virtual point: form (9) with k_av, and where an arm rests while it acts."""
    gain, switching, term = (assumed[f"virtual_{name}"] for name in ("gain", "switching", "term"))
    centre = tuple(assumed[f"window_centre_{axis}"] for axis in "xyz")
    made = sample_problem(virtual_gain=gain, virtual_centre=centre)
    q = samples(made)
    printed = _printed_virtual(made, q)
    found = _agreement(f"The virtual term ({term})", printed, made.virtual.parts[0], q)
    share = gain / (gain + GAINS["k_a"])
    offset = share * float(np.linalg.norm(made.goal_point - np.array(centre)))
    always = switching == "always"
    return Result(
        obtained={
            **found.obtained,
            "rest_point": rest_point_formula(),
            "rest_share": share,
            "rest_offset": offset if always else 0.0,
        },
        caption=(
            f"{found.caption} An end effector that both attract rests {share:.0%} of the way from "
            "the goal to the virtual point, so that the point must be off when the goal is to be "
            "reached"
            + (f"; acting always, it would keep the master {offset:.2f} m away." if always else ".")
        ),
    )


def rest_point_formula() -> bool:
    """Whether the gradient of both attractions vanishes at the mean weighted by the gains."""
    k, kv = sp.symbols("k_a k_av", positive=True)
    x, goal, centre = (sp.Matrix(sp.symbols(f"{name}:3", real=True)) for name in "xgv")
    potential = k / 2 * (x - goal).dot(x - goal) + kv / 2 * (x - centre).dot(x - centre)
    rest = (k * goal + kv * centre) / (k + kv)
    slope = sp.Matrix([potential.diff(v) for v in x]).subs(dict(zip(x, rest, strict=True)))
    return bool(sp.simplify(slope).is_zero_matrix)


def _agreement(
    name: str,
    printed: np.ndarray,
    potential: Potential,
    q: np.ndarray,
    further: dict[str, bool] | None = None,
) -> Result:
    """The printed formula against the potential that is descended, and its gradient."""
    difference = float(abs(printed - potential.value(q)).max())
    error = worst_gradient(potential, q[:60])
    return Result(
        obtained={"value": difference, "gradient": error, **(further or {})},
        caption=(
            f"{name} evaluated at {len(q)} configurations agrees with the potential that is "
            f"descended to {difference:.0e}, its joint gradient with central differences to "
            f"{error:.0e}."
        ),
    )


def _printed_repulsion(distance: np.ndarray, reading: str) -> np.ndarray:
    """(10) and (14) for distances (N, points, bars), over all bars or the nearest."""
    if reading == "nearest_bar":
        distance = distance.min(axis=2, keepdims=True)
    excess = np.where(distance <= GAINS["d_0"], 1.0 / distance - 1.0 / GAINS["d_0"], 0.0)
    return 0.5 * GAINS["k_r"] * (excess**2).sum(axis=(1, 2))


def _symbolic_repulsion() -> tuple[sp.Expr, sp.Expr, sp.Symbol, sp.Symbol]:
    """Within range: U of (10), F of (12) along dd/dX, d and d_0."""
    k, d, d0 = sp.symbols("k_r d d_0", positive=True)
    energy = k / 2 * (1 / d - 1 / d0) ** 2
    return energy, k * (1 / d - 1 / d0) / d**2, d, d0


def _printed_attraction(made: Problem, q: np.ndarray, weight: float) -> np.ndarray:
    """(13) with a weight on its joint term (N,)."""
    square, angles = _squares(made, q)
    return 0.5 * GAINS["k_a"] * (square + weight * angles)


def _squares(made: Problem, q: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """|X - X_g|^2 and the sum of |theta_i - theta_gi|^2, (N,) each."""
    flange = end_effector(made.placed, q)
    return np.sum((flange - made.goal_point) ** 2, axis=1), np.sum((q - made.goal) ** 2, axis=1)


def _printed_virtual(made: Problem, q: np.ndarray) -> np.ndarray:
    """(9) with the virtual point and its gain (N,)."""
    point = made.settings.virtual_point
    away = end_effector(made.placed, q) - np.array(point.position)
    return 0.5 * point.gain * np.sum(away**2, axis=1)
