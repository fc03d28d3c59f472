"""The optimum of `pan`: the problem, its constraints, the printed point and Figs 16 and 17."""

from __future__ import annotations

from functools import partial

import numpy as np
import pandas as pd
from scipy.stats import binomtest

from ...ledger import REGISTRY, Assumed, Bounded, Is, NoOriginal, Result
from ...view.landscape import readings_figure, slices_figure
from ...view.seam_curves import joints_figure, measures_figure
from ...welding import ROBOTS, Placement, Separation, Status
from ...welding.grid_search import grid_points
from ..wording import point
from .consistency import CONSISTENCY, OBJECTIVES, READINGS
from .optimum import SPACING, solved
from .positions import at_optimum, found_optimum, job_scene_at, search_box, status_name
from .scenario import printed_optimum

checks = partial(REGISTRY.checks, page="pan/optimum")
_NEAR, _FAR = 0.10, 0.15  # [m]
_LABELS = {"inverted": "matrix as pose of the base", "literal": "matrix as labelled"}
_CONSTRAINTS = {
    "joint angles within limits": (Status.JOINT_LIMITS,),
    "away from singularities": (Status.SINGULAR,),
    "no collision": (Status.COLLISION,),
    "inside the common workspace": (Status.OUT_OF_REACH,),
}


@checks(
    "pan.eq_opt",
    rules=[
        Bounded(key="feasible_share", low=1e-4, high=0.9999, label="feasible share of the region"),
        Is(key="interior", value=True, label="the optimum lies inside the region, not on its edge"),
        Bounded(key="better_neighbours", high=0.0, label="feasible neighbours that are better"),
    ],
)
def problem(assumed: Assumed) -> Result:
    """Feasible set and maximum of the declared problem."""
    job, measure, best = found_optimum(assumed)
    rule = assumed["branch_rule"]
    box = np.array(search_box(assumed))
    placement = job.placement(measure.reading())
    values = placement(grid_points(box, SPACING))
    margin = np.minimum(best.position - box[:, 0], box[:, 1] - best.position)
    around = best.position + 0.01 * np.concatenate([np.eye(3), -np.eye(3)])
    better = int((placement(around) > best.fitness * (1 + 1e-9)).sum())
    return Result(
        obtained={
            "feasible_share": float((values > 0).mean()),
            "interior": bool(margin.min() > 0),
            "better_neighbours": better,
            "optimum": best.position.tolist(),
            "fitness": best.fitness,
            "branch_rule": rule,
        },
        caption=(
            f"The constraints leave {np.mean(values > 0):.1%} of the region. The best fitness, "
            f"{best.fitness:.4f}, is taken at ({point(best.position, 3)}) m inside it. The region "
            "within one per cent of it is long in x and thin in y, which is the coordinate the "
            "measure tells best."
        ),
        alt="Three slices of the fitness with the feasible set, the optimum and the printed point.",
        figure=lambda: slices_figure(
            placement, box, best.position, best.fitness, printed_optimum()
        ),
    )


@checks(
    "pan.claim_constraints",
    rules=[
        Is(key="count", to="count", label="constraints tested"),
        Bounded(key="separation", low=1e-9, label="smallest separation at the optimum [m]"),
        Bounded(key="joint_margin", low=1e-9, label="smallest margin to a joint limit [deg]"),
        Bounded(key="measure", low=1e-9, label="smallest manipulability less the threshold [m^3]"),
        Bounded(key="inside", low=0.0, label="distance of the optimum from the edge of S [m]"),
    ],
)
def constraints(assumed: Assumed) -> Result:
    """The four constraints at the optimum, and what each excludes of the region."""
    cell, jobs, centre, _ = at_optimum(assumed)
    box = np.array(search_box(assumed))
    separation = Separation(cell)
    pairs = separation.per_pair(jobs.q, jobs.centres)[0]
    owners = pd.Series(pairs, index=[" - ".join(pair) for pair in separation.owners])
    nearest = owners.groupby(level=0).min().sort_values()
    margins = []
    for k in range(len(ROBOTS)):
        lower, upper = cell.limits(k)
        margins.append(np.minimum(jobs.q[0, k] - lower, upper - jobs.q[0, k]).min())
    points = grid_points(box, SPACING)
    placement = Placement(cell, found_optimum(assumed)[1].reading())
    status = np.concatenate([placement.jobs(part).status for part in np.array_split(points, 64)])
    excluded = {
        name: float(np.isin(status, [int(s) for s in causes]).mean())
        for name, causes in _CONSTRAINTS.items()
    }
    told = ", ".join(f"{name} {share:.1%}" for name, share in excluded.items())
    return Result(
        obtained={
            "count": len(excluded),
            "separation": float(pairs.min()),
            "joint_margin": float(np.degrees(min(margins))),
            "measure": float(jobs.w.min() - cell.threshold),
            "inside": float(np.minimum(centre - box[:, 0], box[:, 1] - centre).min()),
            "excluded": excluded,
            "separations": nearest.to_dict(),
        },
        table=nearest.rename("separation_m").rename_axis("pair").reset_index(),
        caption=(
            f"All four constraints hold at the optimum: the nearest pair ({nearest.index[0]}) is "
            f"{nearest.iloc[0]:.3f} m apart, the nearest joint limit "
            f"{np.degrees(min(margins)):.1f} deg away. Tested in turn they exclude of the region: "
            f"{told}. Of the pairs, torch and workpiece have the same distance at every position, "
            "since both follow the seam; the others are given one by one for that reason."
        ),
    )


@checks(
    "pan.claim_optimum",
    rules=[
        Bounded(
            key="readings_near",
            low=1,
            label="readings with an optimum within 0.15 m of the printed point in some set",
        ),
        NoOriginal(key="robot", label="parameters and limits of the robot"),
        NoOriginal(key="workpiece", label="workpiece, grasp, torch and posture"),
    ],
)
def printed_point(assumed: Assumed) -> Result:
    """Distance of the optimum to the printed point, and which readings could have produced it."""
    job, measure, best = found_optimum(assumed)
    printed = printed_optimum()
    distance = float(np.linalg.norm(best.position - printed))
    at_print = solved(job, tuple(printed))
    table = reading_table()
    near, far = (table[[f"{reading} {radius}" for reading in READINGS]] for radius in (_NEAR, _FAR))
    shares = far.set_axis([_LABELS[reading] for reading in READINGS], axis=1)
    excluded = [
        f"{row} ({column})" for column in shares for row in shares.index[shares[column] == 0]
    ]
    told = "; ".join(
        f"with the {column} '{shares[column].idxmax()}' comes nearest, "
        f"{shares[column].max():.1%} of its optima"
        for column in shares
    )
    sets = len(CONSISTENCY.load()) // len(READINGS)
    cell = job.cell().unlimited()
    unlimited = Placement(cell, measure.reading()).jobs([printed])
    return Result(
        obtained={
            "C": best.position.tolist(),
            "distance": distance,
            "fitness": best.fitness,
            "printed_point_is": status_name(at_print),
            "readings_near": int((far > 0).to_numpy().sum()),
            "readings": shares.size,
            "feasible_sets": _feasible_sets(),
            "excluded": excluded,
            "shares": {name: row.to_dict() for name, row in table.iterrows()},
        },
        table=table.reset_index(),
        caption=(
            f"With the declared assumptions the best position is ({point(best.position, 3)}) m, "
            f"{distance:.2f} m from the printed one, which is itself not feasible there "
            f"({status_name(at_print)}). Over {sets} sampled sets of assumptions, and within "
            f"{_FAR:g} m: {told}. The largest share within {_NEAR:g} m is "
            f"{near.to_numpy().max():.1%}. {len(excluded)} of {shares.size} readings never come "
            f"within {_FAR:g} m. The text does not determine the printed point."
        ),
        alt=(
            "Left: optima of all readings in two projections with the printed point and circles "
            "around it. Right: share of optima near the printed point for each objective and "
            "reading."
        ),
        figure=lambda: readings_figure(_clouds(), printed, shares, (_NEAR, _FAR)),
        scene=lambda: job_scene_at(
            "The job at the printed position, joint limits left aside.", cell, unlimited, printed
        ),
    )


@checks(
    "pan.fig16",
    rules=[
        Bounded(
            key="smallest", low=0.01, label="smallest manipulability of a robot on the seam [m^3]"
        ),
        NoOriginal(key="values", label="values of the curves"),
    ],
)
def optimal_curves(assumed: Assumed) -> Result:
    """Measures along the seam at the optimum."""
    _, jobs, _, measures = at_optimum(assumed)
    w, axis = jobs.w[0], assumed["time_axis"]
    return Result(
        obtained={
            "smallest": float(w.min()),
            "range": [float(measures.system.min()), float(measures.system.max())],
        },
        table=curve_table(w, measures.system, axis),
        caption=(
            f"At the optimum the system measure stays between {measures.system.min():.3f} and "
            f"{measures.system.max():.3f}; the welder's lies between {w[2].min():.3f} and "
            f"{w[2].max():.3f} m^3, since in the flat position it hardly moves. Values of the "
            "printed curves are not known, nor which measures they show."
        ),
        alt="Manipulability of three robots and of the system along the seam, well above zero.",
        figure=lambda: measures_figure({"at the optimum": (w, measures)}),
    )


@checks(
    "pan.fig17",
    rules=[
        Bounded(
            key="largest_step", high=0.6, label="largest step of a joint between seam points [rad]"
        ),
        Bounded(key="joint_margin", low=1e-9, label="smallest margin to a joint limit [rad]"),
        NoOriginal(key="values", label="values of the curves"),
    ],
)
def joint_curves(assumed: Assumed) -> Result:
    """Joint angles along the seam at the optimum."""
    cell, jobs, _, _ = at_optimum(assumed)
    rule, axis = assumed["branch_rule"], assumed["time_axis"]
    q = jobs.q[0]
    closed = np.concatenate([q, q[:, :1]], axis=1)
    step = float(abs(np.diff(closed, axis=1)).max())
    margin = min(
        float(np.minimum(q[k] - cell.limits(k)[0], cell.limits(k)[1] - q[k]).min())
        for k in range(len(ROBOTS))
    )
    span = np.degrees(np.ptp(q, axis=1))
    columns = {
        f"{name} q{j + 1}": np.degrees(q[k, :, j])
        for k, name in enumerate(ROBOTS)
        for j in range(6)
    }
    return Result(
        obtained={
            "largest_step": step,
            "joint_margin": margin,
            "span_deg": span.tolist(),
            "branches": jobs.branch[0].tolist(),
            "rule": rule,
        },
        table=pd.DataFrame(columns).rename_axis(axis).reset_index(),
        caption=(
            "Joint paths at the optimum, each on one branch: smooth, closed after one turn and "
            f"within limits. The carriers' joints sweep up to {span[:2].max():.0f} deg, the "
            f"welder's {span[2, :5].max():.0f} deg."
        ),
        alt="Six joint angles of each of three robots along the seam, smooth and periodic.",
        figure=lambda: joints_figure(cell, q),
    )


def reading_table() -> pd.DataFrame:
    """Share of optima near the printed point for every objective (rows) and reading of the bases.

    Columns ``<reading> 0.1`` and ``<reading> 0.15`` are shares among the sets with a feasible
    position, ``<reading> upper`` the upper end of the 95 % interval of the latter.
    """
    table, printed = CONSISTENCY.load(), printed_optimum()
    rows = {}
    for name in OBJECTIVES:
        row = {}
        for reading in READINGS:
            part = table[table["base_transform"] == reading]
            points = part[[f"{name} {axis}" for axis in "xyz"]].dropna().to_numpy()
            distance = np.linalg.norm(points - printed, axis=1)
            for radius in (_NEAR, _FAR):
                row[f"{reading} {radius}"] = float((distance <= radius).mean())
            hits = int((distance <= _FAR).sum())
            interval = binomtest(hits, len(distance)).proportion_ci(method="wilson")
            row[f"{reading} upper"] = float(interval.high)
        rows[name] = row
    return pd.DataFrame.from_dict(rows, orient="index").rename_axis("objective")


def _feasible_sets() -> dict[str, float]:
    """Share of the sampled sets in which some position is feasible, for each reading."""
    table = CONSISTENCY.load()
    some = table["feasible_share"] > 0
    return {name: float(some[table["base_transform"] == name].mean()) for name in READINGS}


def _clouds() -> list[tuple[str, np.ndarray]]:
    """Optima of all objectives, one cloud for each reading of the bases."""
    table = CONSISTENCY.load()
    clouds = []
    for reading in READINGS:
        part = table[table["base_transform"] == reading]
        points = [part[[f"{name} {axis}" for axis in "xyz"]].dropna() for name in OBJECTIVES]
        clouds.append((_LABELS[reading], np.concatenate(points)))
    return clouds


def curve_table(w: np.ndarray, system: np.ndarray, axis: str) -> pd.DataFrame:
    """Manipulabilities of the robots and the system measure against the seam point."""
    columns = {f"{name}_m3": values for name, values in zip(ROBOTS, w, strict=True)}
    return pd.DataFrame({**columns, "system": system}).rename_axis(axis).reset_index()
