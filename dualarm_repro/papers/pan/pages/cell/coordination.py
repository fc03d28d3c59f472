"""Equations (1)-(8) of `pan`, and Fig. 2: how the robots and the workpiece move together."""

from __future__ import annotations

from functools import partial

import numpy as np
import pinocchio as pin

from .....differences import central_differences
from .....ledger import REGISTRY, Assumed, Bounded, NoOriginal, Residual, Result
from .....ledger.captions import captions
from .....view.welding_cell import vectors_figure
from .....welding import ROBOTS, WELDER, Cell, Jobs, flange_poses, held_poses, torch_tips
from .....welding.motion import periodic_derivative
from ...document import SEED
from ...print_forms import block_residual, printed_text, residual, worst
from ...reading import SHOWN, FlatSeam, at_display

checks = partial(REGISTRY.checks, page="pan/cell")
caption = captions(__file__)
#: Samples of the turn for derivatives by Fourier transform.
_FINE = 1440


def grips(cell: Cell, jobs: Jobs, robot: int, centre: np.ndarray) -> np.ndarray:
    """r = R_wc^T (p - C): from the workpiece to the flange, in the workpiece frame (N, 3) [m]."""
    flange = flange_poses(cell, jobs, robot)[:, :3, 3]
    return np.einsum("nji,nj->ni", cell.rotations, flange - centre)


def grip_change(cell: Cell, jobs: Jobs, centre: np.ndarray) -> float:
    """Largest change of the grips of both carriers along the job [m]."""
    found = [grips(cell, jobs, robot, centre) for robot in range(WELDER)]
    return max(float(abs(r - r[0]).max()) for r in found)


@checks(
    "pan.eq01", rules=[Residual("residual", "both sides of the printed (1) differ by", high=1e-7)]
)
def tight_coordination(assumed: Assumed) -> Result:
    """Twists at two points of one rigid body, against central differences of a screw motion."""
    rng, cases = np.random.default_rng(SEED), []
    for _ in range(100):
        body = pin.SE3(pin.exp3(rng.normal(size=3)), rng.normal(size=3))
        arms, twist = rng.normal(size=(2, 3)), rng.normal(size=6)
        velocities = _screw_velocities(body, twist, arms)
        turn = body.rotation @ twist[3:]
        first, second = (np.concatenate([v, turn]) for v in velocities)
        J = _between(body.rotation @ (arms[0] - arms[1]))
        cases.append({"x1_dot": first, "x2_dot": second, "J": J})
    return Result(
        obtained={"residual": worst(printed_text("pan.eq01"), cases)}, caption=caption("eq01")
    )


@checks(
    "pan.eq02",
    rules=[
        Residual("residual", "both sides of the printed (2) differ by [m/rad]", high=1e-9),
        Residual("across", "part of alpha_dot across the seam [m/rad]", high=1e-9),
        Bounded(
            "along",
            "smallest alpha_dot along the seam, in radii of the branch per radian",
            low=1.0 - 1e-9,
        ),
    ],
)
def loose_coordination(assumed: Assumed) -> Result:
    """Velocity of the torch, that of the seam point it touches, and the rest."""
    flat = FlatSeam(
        assumed["radius_main"], assumed["radius_branch"], _FINE, assumed["flat_posture"]
    )
    seam, R = flat.seam, flat.rotations
    torch = periodic_derivative(np.einsum("nij,nj->ni", R, seam.points))
    tangent = np.einsum("nij,nj->ni", R, seam.tangent)
    turning = periodic_derivative(R) @ R.transpose(0, 2, 1)
    cases, slip = [], periodic_derivative(seam.points)
    for n in range(0, _FINE, 10):
        omega = np.array([turning[n, 2, 1], turning[n, 0, 2], turning[n, 1, 0]])
        cases.append(
            {
                "x1_dot": np.concatenate([torch[n], omega]),
                "x2_dot": np.concatenate([np.zeros(3), omega]),
                "J": _between(R[n] @ seam.points[n]),
                "alpha_dot": np.concatenate([R[n] @ slip[n], np.zeros(3)]),
            }
        )
    relative = np.einsum("nij,nj->ni", R, slip)
    along = np.sum(relative * tangent, axis=1)
    across = np.linalg.norm(relative - along[:, np.newaxis] * tangent, axis=1)
    return Result(
        obtained={
            "residual": worst(printed_text("pan.eq02"), cases),
            "across": float(across.max()),
            "along": float(abs(along).min() / flat.radius_branch),
        },
        caption=caption("eq02", speeds=abs(along)),
    )


@checks(
    "pan.eq03",
    rules=[
        Residual("residual", "printed matrix and the pose the carriers hold differ", high=1e-9),
        Residual("orthonormal", "R^T R - I is at most", high=1e-12),
    ],
)
def workpiece_pose(assumed: Assumed) -> Result:
    """The printed blocks of the transform against the pose that both carriers hold."""
    cell, jobs, centre = at_display(assumed)
    R, rows = cell.rotations, printed_text("pan.eq03", "matrix")
    gaps = [
        block_residual(rows, {"R_wc": R[n], "P_wc0": centre}, held)
        for robot in range(WELDER)
        for n, held in enumerate(held_poses(cell, jobs, robot))
    ]
    turn = np.degrees(np.arccos(np.clip((np.trace(R, axis1=1, axis2=2) - 1) / 2, -1, 1)))
    return Result(
        obtained={
            "residual": max(gaps),
            "orthonormal": float(abs(R.transpose(0, 2, 1) @ R - np.eye(3)).max()),
            "turn": float(turn.max()),
        },
        caption=caption("eq03", least=turn.min()),
    )


@checks(
    "pan.fig02",
    rules=[
        Residual("closure", "p2 + R r - p closes for both carriers, to [m]", high=1e-9),
        NoOriginal("drawing", "the drawing"),
    ],
)
def position_vectors(assumed: Assumed) -> Result:
    """Frames and the vectors of (4) and (5)."""
    cell, jobs, centre = at_display(assumed)
    index = SHOWN[assumed["display_configuration"]]
    r = np.einsum("ji,kj->ki", cell.rotations[index], cell.flanges[:WELDER, index, :3, 3])
    return Result(
        obtained={"closure": grip_change(cell, jobs, centre), "r": r.tolist()},
        caption=caption("fig02", lengths=np.linalg.norm(r, axis=1)),
        alt="Coordinate frames joined by arrows from the world to workpiece and flanges.",
        figure=lambda: vectors_figure(cell, jobs.q[0], centre),
    )


def _closure(item: str, robot: int, names: tuple[str, str]) -> None:
    @checks(
        f"pan.{item}", rules=[Residual("residual", "largest residual along the job [m]", high=1e-9)]
    )
    def closure(assumed: Assumed) -> Result:
        cell, jobs, centre = at_display(assumed)
        flange = flange_poses(cell, jobs, robot)[:, :3, 3]
        r = grips(cell, jobs, robot, centre)[0]
        cases = [
            {"p_2": centre, "R_wc": R, names[0]: r, names[1]: end}
            for R, end in zip(cell.rotations, flange, strict=True)
        ]
        return Result(
            obtained={"residual": worst(printed_text(f"pan.{item}"), cases), "r": r.tolist()},
            caption=caption("closure", robot=ROBOTS[robot]),
        )


_closure("eq04", 0, ("r_1", "p_1"))
_closure("eq05", 1, ("r_2", "p_3"))


def _seam_points(item: str, frame: str, label: str) -> None:
    """p = T p_c in one frame, against the tip of the torch by forward kinematics of the welder."""

    @checks(f"pan.{item}", rules=[Residual("residual", label, high=1e-9)])
    def seam_points(assumed: Assumed) -> Result:
        cell, jobs, centre = at_display(assumed)
        turn = np.eye(4) if frame == "w" else np.linalg.inv(cell.bases[WELDER])
        tips, poses = _lifted(torch_tips(cell, jobs)) @ turn.T, turn @ cell.piece_pose(centre)
        cases = [
            {f"p_{frame}": tip, f"T_{frame}c": pose, "p_c": seen}
            for tip, pose, seen in zip(tips, poses, _lifted(cell.seam), strict=True)
        ]
        return Result(
            obtained={"residual": worst(printed_text(f"pan.{item}"), cases)},
            caption=caption(item, count=cell.count),
        )


_seam_points("eq06", "w", "tip of the torch misses p_w by at most [m]")
_seam_points("eq07", "B", "p_B = T_Bc p_c holds for the welder to [m]")


@checks(
    "pan.eq08",
    rules=[Residual("residual", "the product and the pose the carriers hold", high=1e-9)],
)
def workpiece_in_base(assumed: Assumed) -> Result:
    """The product against the pose of the workpiece from the carriers' forward kinematics."""
    cell, jobs, centre = at_display(assumed)
    text, largest, wrong = printed_text("pan.eq08"), 0.0, np.inf
    for robot in range(WELDER):
        base = cell.bases[robot]
        to_base = np.linalg.inv(base)
        held = to_base @ held_poses(cell, jobs, robot)
        for T_wc, T_Bc in zip(cell.piece_pose(centre), held, strict=True):
            given = {"T_Bc": T_Bc, "T_wc": T_wc}
            largest = max(largest, residual(text, {**given, "T_Bw": to_base}))
            wrong = min(wrong, float(np.linalg.norm((base @ T_wc - T_Bc)[:3, 3])))
    return Result(obtained={"residual": largest, "other": wrong}, caption=caption("eq08"))


@checks(
    "pan.claim_tight",
    rules=[
        Residual("shift", "relative displacement of both flanges [m]", high=1e-9),
        Residual("turn", "relative rotation of both flanges", high=1e-9),
    ],
)
def no_relative_motion(assumed: Assumed) -> Result:
    """Pose of one carrier's flange in the other's along the job."""
    cell, jobs, _ = at_display(assumed)
    first, second = (flange_poses(cell, jobs, robot) for robot in range(WELDER))
    relative = np.linalg.inv(first) @ second
    change = abs(relative - relative[0])
    return Result(
        obtained={
            "shift": float(change[:, :3, 3].max()),
            "turn": float(change[:, :3, :3].max()),
            "moved": float(np.ptp(first[:, :3, 3], axis=0).max()),
        },
        caption=caption("claim_tight"),
    )


def _lifted(points: np.ndarray) -> np.ndarray:
    """Points (N, 3) in homogeneous coordinates (N, 4)."""
    return np.column_stack([points, np.ones(len(points))])


def _between(lever: np.ndarray) -> np.ndarray:
    """J = [[I, -[r]x], [0, I]] between the twists at two points, r (3,) from one to the other."""
    J = np.eye(6)
    J[:3, 3:] = -pin.skew(lever)
    return J


def _screw_velocities(body: pin.SE3, twist: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Velocities (K, 3) of points fixed in a body that moves by a screw, by differences."""

    def places(time: np.ndarray) -> list[np.ndarray]:
        moved = body * pin.exp6(pin.Motion(time[0] * twist))
        return [moved.act(point) for point in points]

    return central_differences(places, [0.0])[0]
