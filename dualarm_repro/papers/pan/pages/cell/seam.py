"""The seam of `pan`: equation (17) and Figs 5-8."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np
import pandas as pd
import sympy as sp

from .....ledger import REGISTRY, Adopts, Assumed, Is, NoOriginal, Residual, Result
from .....ledger.captions import captions
from .....ledger.formula import parse
from .....view.pipe_seam import pipes_figure, seam_figure
from .....welding import WELDER, Seam, saddle_seam
from .....welding.motion import periodic_derivative
from ...print_forms import in_symbols, printed_text
from ...reading import FlatSeam, SeamModel, at_display

checks = partial(REGISTRY.checks, page="pan/cell")
caption = captions(__file__)
_SLOW = 0.25  # share of the pace along the seam, below which a point all but stands still


@checks(
    "pan.eq17",
    rules=[
        Is("on_pipes", "the printed curve lies on both cylinders, in symbols", value=True),
        Residual("points", "seam points used and the printed formula differ by [m]", high=1e-12),
    ],
)
def saddle_curve(assumed: Assumed) -> Result:
    """The printed formula in symbols against both cylinders, and against the points used."""
    model = SeamModel.of(assumed)
    symbols = {name: sp.Symbol(name, positive=True) for name in ("theta", "R_a", "R_b")}
    lines = {str(parse(line).sides[0]): line for line in printed_text("pan.eq17")}
    x, y, z = (in_symbols(lines[axis], 1, **symbols) for axis in "xyz")
    rb, ra = symbols["R_b"], symbols["R_a"]
    on_pipes = sp.simplify(x**2 + y**2 - rb**2) == 0 and sp.simplify(y**2 + z**2 - ra**2) == 0
    seam, radii = model.seam, {ra: model.radius_main, rb: model.radius_branch}
    formula = sp.lambdify(symbols["theta"], [part.subs(radii) for part in (x, y, z)], "numpy")
    printed = np.column_stack(np.broadcast_arrays(seam.theta, *formula(seam.theta)))[:, 1:]
    return Result(
        obtained={
            "on_pipes": bool(on_pipes),
            "points": float(abs(printed - seam.points).max()),
            "height": float(np.ptp(seam.points[:, 2])),
        },
        caption=caption("eq17"),
    )


@checks(
    "pan.claim_theta_range",
    rules=[Adopts("theta", "range of theta that the seam covers [rad]", to="theta")],
)
def theta_range(assumed: Assumed) -> Result:
    """First value of theta and the end of the last step, of the seam that is used."""
    theta = saddle_seam(0.1, 0.06, round(assumed["seam_points"])).theta
    return Result(
        obtained={"theta": [float(theta[0]), float(theta[-1] + np.diff(theta).max())]},
        caption=(
            f"The seam is closed and covered once, by {len(theta)} equally spaced points. The "
            "interval is printed open, which would leave out the point at theta = 0."
        ),
    )


@checks(
    "pan.fig05",
    rules=[
        Residual("residual", "the seam lies on both pipes, to [m]", high=1e-12),
        NoOriginal("radii", "the radii and lengths of the pipes"),
    ],
)
def workpiece(assumed: Assumed) -> Result:
    """Main pipe and branch."""
    model = SeamModel.of(assumed)
    length, branch, seam = assumed["workpiece_length"], assumed["branch_length"], model.seam
    return Result(
        obtained={"residual": _residual(model)},
        caption=caption("fig05", model=model, length=length),
        alt="A level pipe with a thinner pipe standing on its middle; the seam is a saddle curve.",
        figure=lambda: pipes_figure(seam, model.radius_main, model.radius_branch, length, branch),
    )


@checks(
    "pan.fig06",
    rules=[
        Residual("residual", "the seam lies on both pipes, to [m]", high=1e-12),
        NoOriginal("radii", "the radii"),
    ],
)
def curve(assumed: Assumed) -> Result:
    """The saddle curve in space."""
    model = SeamModel.of(assumed)
    points = model.seam.points
    return Result(
        obtained={"residual": _residual(model), "extent": np.ptp(points, axis=0).tolist()},
        table=_table(points),
        caption=(
            "The saddle curve of equation (17) in the workpiece frame, "
            f"{_extent(points)} in x, y and z. Its size follows from radii that are not printed."
        ),
        alt="A closed space curve shaped like a saddle.",
        figure=lambda: seam_figure({"seam in the workpiece frame": points}),
    )


@checks(
    "pan.fig07",
    rules=[
        Residual("not_level", "slope of the seam at the point being welded", high=1e-9),
        NoOriginal("posture", "the rule of the flat position"),
    ],
)
def flat_points(assumed: Assumed) -> Result:
    """The current seam point after the rotation that lays it flat, about the fixed origin."""
    flat = FlatSeam.of(assumed)
    seam, R = flat.seam, flat.rotations
    points = np.einsum("nij,nj->ni", R, seam.points)
    tangent = np.einsum("nij,nj->ni", R, seam.tangent)
    slope = float(abs(tangent[:, 2]).max())
    return Result(
        obtained={"not_level": slope, "extent": np.ptp(points, axis=0).tolist()},
        table=_table(points),
        caption=caption(
            "fig07", points=_extent(points), seam=_extent(seam.points), **_standstill(seam, points)
        ),
        alt="The saddle curve and, smaller above it, the curve of the points as they are welded.",
        figure=lambda: seam_figure(
            {"on the workpiece": seam.points, "as welded, flat": points}, _turns(seam, points)
        ),
    )


@checks(
    "pan.fig08",
    rules=[
        Residual("residual", "the points are reached by the welder, to [m]", high=1e-9),
        NoOriginal("position", "the initial position used"),
    ],
)
def points_in_base(assumed: Assumed) -> Result:
    """The points of Fig. 7 in the frame of base 3."""
    cell, jobs, centre = at_display(assumed)
    to_base = np.linalg.inv(cell.bases[WELDER])
    points = cell.seam_in_world(centre) @ to_base[:3, :3].T + to_base[:3, 3]
    flange = cell.arms[WELDER].fk(jobs.q[0, WELDER])[:, :3, 3]
    lever = cell.lever_arms[WELDER] @ to_base[:3, :3].T
    return Result(
        obtained={
            "residual": float(abs(flange + lever - points).max()),
            "mean": points.mean(axis=0).tolist(),
        },
        table=_table(points),
        caption=caption("fig08", centre=centre, extent=_extent(points)),
        alt="A small closed curve in the frame of the welder's base.",
        figure=lambda: seam_figure(
            {"in the frame of base 3": points}, _turns(SeamModel.of(assumed).seam, points)
        ),
    )


def _residual(model: SeamModel) -> float:
    x, y, z = model.seam.points.T
    main = abs(np.hypot(y, z) - model.radius_main).max()
    return float(max(main, abs(np.hypot(x, y) - model.radius_branch).max()))


def _pace(seam: Seam, points: np.ndarray) -> np.ndarray:
    """Pace of the points over that along the seam (N,); near 0 the workpiece carries them back."""
    speeds = [np.linalg.norm(periodic_derivative(p), axis=1) for p in (points, seam.points)]
    return speeds[0] / speeds[1]


def _turns(seam: Seam, points: np.ndarray) -> dict[str, np.ndarray]:
    """The places at which the curve of the points nearly stands still, by name."""
    pace = _pace(seam, points)
    slow = (pace < _SLOW) & (pace < np.roll(pace, 1)) & (pace <= np.roll(pace, -1))
    return {f"theta = {np.degrees(seam.theta[k]):.0f} deg": points[k] for k in np.flatnonzero(slow)}


def _standstill(seam: Seam, points: np.ndarray) -> dict[str, Any]:
    """For a caption: where the points are slowest, and their pace as a share of the seam's."""
    return {"turns": list(_turns(seam, points)), "slowest": float(_pace(seam, points).min())}


def _extent(points: np.ndarray) -> str:
    return " x ".join(f"{1000 * side:.0f}" for side in np.ptp(points, axis=0)) + " mm"


def _table(points: np.ndarray) -> pd.DataFrame:
    table = pd.DataFrame(points, columns=["x_m", "y_m", "z_m"])
    return table.rename_axis("seam_point").reset_index()
