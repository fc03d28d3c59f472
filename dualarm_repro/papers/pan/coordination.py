"""Equations (1)-(8) of `pan`: how the robots and the workpiece move together."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Any

import numpy as np

from ...errors import InputError
from ...ledger import REGISTRY, Assumed, Bounded, Result
from ...welding import ROBOTS, WELDER, Cell, Jobs
from ..wording import point
from .optimum import solved
from .scenario import SEED, FlatSeam, Job

checks = partial(REGISTRY.checks, page="pan/cell")
#: Central differences of fourth order.
_STEP, _STENCIL = 1e-3, {-2: 1 / 12, -1: -2 / 3, 1: 2 / 3, 2: -1 / 12}


def at_display(assumed: Mapping[str, Any]) -> tuple[Cell, Jobs, np.ndarray]:
    """The cell and its job at the position used where any would do.

    Raises
    ------
    InputError
        A robot has no joint path there.
    """
    job, centre = Job.of(assumed), tuple(assumed["display_position"])
    jobs = solved(job, centre)
    if not np.isfinite(jobs.q).all():
        expected = "a position at which every robot has a joint path"
        raise InputError("pan", "display_position", centre, expected)
    return job.cell(), jobs, np.array(centre)


def flange_poses(cell: Cell, jobs: Jobs, robot: int) -> np.ndarray:
    """Poses of a flange in the world by forward kinematics of its joint path (N, 4, 4)."""
    return cell.bases[robot] @ cell.arms[robot].fk(jobs.q[0, robot])


@checks(
    "pan.eq01",
    rules=[Bounded(key="residual", high=1e-7, label="x1_dot and J x2_dot differ by at most")],
)
def tight_coordination(assumed: Assumed) -> Result:
    """Twists at two points of one rigid body, against central differences of a screw motion."""
    import pinocchio as pin

    rng, worst = np.random.default_rng(SEED), 0.0
    for _ in range(100):
        body = pin.SE3(pin.exp3(rng.normal(size=3)), rng.normal(size=3))
        arms, twist = rng.normal(size=(2, 3)), rng.normal(size=6)
        velocities = np.zeros((2, 3))
        for step, weight in _STENCIL.items():
            moved = body * pin.exp6(pin.Motion(step * _STEP * twist))
            velocities += weight / _STEP * np.array([moved.act(r) for r in arms])
        turn = body.rotation @ twist[3:]
        first, second = (np.concatenate([v, turn]) for v in velocities)
        J = np.eye(6)
        J[:3, 3:] = -pin.skew(body.rotation @ (arms[0] - arms[1]))
        worst = max(worst, float(abs(first - J @ second).max()))
    return Result(
        obtained={"residual": worst},
        caption=(
            "For two points of one rigid body (1) holds with J = [[I, -[r]x], [0, I]], r the "
            f"vector between them: on 100 random motions to {worst:.1e}. J is a map between "
            "twists; from (9) on the same letter is the Jacobian of an arm."
        ),
    )


@checks(
    "pan.eq02",
    rules=[
        Bounded(
            key="across", high=1e-9, label="part of the relative velocity across the seam [m/rad]"
        ),
        Bounded(key="along", low=1e-3, label="its smallest part along the seam [m/rad]"),
    ],
    samples=32,
)
def loose_coordination(assumed: Assumed) -> Result:
    """Velocity of the torch minus that of the seam point it touches, as the workpiece turns."""
    flat = FlatSeam.of(assumed)
    seam, R = flat.seam, flat.rotations
    tip = np.einsum("nij,nj->ni", R, seam.points)
    carried = np.einsum("nij,nj->ni", periodic_derivative(R), seam.points)
    relative = periodic_derivative(tip) - carried
    tangent = np.einsum("nij,nj->ni", R, seam.tangent)
    along = np.sum(relative * tangent, axis=1)
    across = float(np.linalg.norm(relative - along[:, np.newaxis] * tangent, axis=1).max())
    return Result(
        obtained={"across": across, "along": float(abs(along).min())},
        caption=(
            "Relative to the workpiece that carries it, the torch moves along the tangent of the "
            f"seam by {abs(along).min():.3f} to {abs(along).max():.3f} m per radian of theta and "
            f"across it by at most {across:.1e}: this is the additional term of (2)."
        ),
    )


@checks(
    "pan.eq03",
    rules=[
        Bounded(key="orthonormal", high=1e-12, label="R^T R - I is at most"),
        Bounded(key="turn", low=1.0, label="the pose is not constant: R turns by up to [deg]"),
    ],
    samples=32,
)
def workpiece_pose(assumed: Assumed) -> Result:
    """The transform of the workpiece frame along the seam."""
    flat, centre = FlatSeam.of(assumed), assumed["rotation_centre"]
    R = flat.rotations
    turn = np.degrees(np.arccos(np.clip((np.trace(R, axis1=1, axis2=2) - 1) / 2, -1, 1)))
    return Result(
        obtained={
            "orthonormal": float(abs(R.transpose(0, 2, 1) @ R - np.eye(3)).max()),
            "turn": float(turn.max()),
            "rotation_centre": centre,
        },
        caption=(
            f"To lay each seam point flat the workpiece turns by {turn.min():.1f} to "
            f"{turn.max():.1f} deg about its origin, which stays at C. A pose that is constant "
            "for a given C, as one sentence has it, would leave the carriers at rest."
        ),
    )


def _closure(item: str, robot: int) -> None:
    @checks(
        item,
        samples=32,
        rules=[Bounded(key="residual", high=1e-9, label="largest residual along the job [m]")],
    )
    def closure(assumed: Assumed) -> Result:
        cell, jobs, centre = at_display(assumed)
        flange = flange_poses(cell, jobs, robot)[:, :3, 3]
        r = np.einsum("nji,nj->ni", cell.rotations, flange - centre)
        residual = float(abs(centre + np.einsum("nij,j->ni", cell.rotations, r[0]) - flange).max())
        return Result(
            obtained={"residual": residual, "r": r[0].tolist()},
            caption=(
                f"With the grasp assumed, r = ({point(r[0], 3)}) m leads from the workpiece "
                f"origin to the flange of {ROBOTS[robot]}; the flange found by forward kinematics "
                f"of its joint path meets the closure to {residual:.1e} m along the seam."
            ),
        )


_closure("pan.eq04", 0)
_closure("pan.eq05", 1)


@checks(
    "pan.eq06",
    samples=32,
    rules=[Bounded(key="residual", high=1e-9, label="tip of the torch misses p_w by at most [m]")],
)
def seam_in_world(assumed: Assumed) -> Result:
    """p_w = T_wc p_c, against the tip of the torch by forward kinematics of the welder."""
    cell, jobs, centre = at_display(assumed)
    expected = np.einsum("nij,nj->ni", cell.piece_pose(centre)[:, :3, :3], cell.seam) + centre
    residual = float(abs(_tip(cell, jobs) - expected).max())
    return Result(
        obtained={"residual": residual},
        caption=(
            "The tip of the torch, from the joint path of the welder, is on p_w to "
            f"{residual:.1e} m at each of {cell.count} seam points."
        ),
    )


@checks(
    "pan.eq07",
    samples=32,
    rules=[Bounded(key="residual", high=1e-9, label="p_B = T_Bc p_c holds for the welder to [m]")],
)
def seam_in_base(assumed: Assumed) -> Result:
    """p_B = T_Bc p_c in the frame of base 3, against the tip of the torch in that frame."""
    cell, jobs, centre = at_display(assumed)
    to_base = np.linalg.inv(cell.bases[WELDER])
    T = to_base @ cell.piece_pose(centre)
    expected = np.einsum("nij,nj->ni", T[:, :3, :3], cell.seam) + T[:, :3, 3]
    found = _tip(cell, jobs) @ to_base[:3, :3].T + to_base[:3, 3]
    residual = float(abs(found - expected).max())
    return Result(
        obtained={"residual": residual},
        caption=(
            f"In the frame of base 3 the tip of the torch is on T_Bc p_c to {residual:.1e} m; "
            "these are the points the inverse kinematics of the welder is given."
        ),
    )


@checks(
    "pan.eq08",
    samples=32,
    rules=[
        Bounded(key="residual", high=1e-9, label="T_Bw T_wc is the pose the carriers hold, to"),
        Bounded(key="other", low=0.1, label="with the other reading of T_Bw it is off by [m]"),
    ],
)
def workpiece_in_base(assumed: Assumed) -> Result:
    """The product against the pose of the workpiece from the carriers' forward kinematics."""
    cell, jobs, centre = at_display(assumed)
    worst, wrong = 0.0, np.inf
    for robot in range(WELDER):
        flange = cell.arms[robot].fk(jobs.q[0, robot])
        local = cell.flanges[robot][0].copy()
        local[:3] = cell.rotations[0].T @ local[:3]
        held = flange @ np.linalg.inv(local)
        pose, base = cell.piece_pose(centre), cell.bases[robot]
        worst = max(worst, float(abs(np.linalg.inv(base) @ pose - held).max()))
        wrong = min(wrong, float(np.linalg.norm((base @ pose - held)[:, :3, 3], axis=1).min()))
    return Result(
        obtained={"residual": worst, "other": wrong},
        caption=(
            "The pose of the workpiece in a carrier's base frame, from its joint path and its "
            f"grasp, equals T_Bw T_wc to {worst:.1e} with T_Bw the inverse of the pose of the "
            f"base. With that pose itself in its place it would be off by at least {wrong:.2f} m."
        ),
    )


@checks(
    "pan.claim_tight",
    samples=32,
    rules=[
        Bounded(key="shift", high=1e-9, label="relative displacement of both flanges [m]"),
        Bounded(key="turn", high=1e-9, label="relative rotation of both flanges"),
        Bounded(key="moved", low=1e-3, label="while each flange moves by [m]"),
    ],
)
def no_relative_motion(assumed: Assumed) -> Result:
    """Pose of one carrier's flange in the other's along the job."""
    cell, jobs, _ = at_display(assumed)
    first, second = (flange_poses(cell, jobs, robot) for robot in range(WELDER))
    relative = np.linalg.inv(first) @ second
    change = abs(relative - relative[0])
    shift, turn = float(change[:, :3, 3].max()), float(change[:, :3, :3].max())
    moved = float(np.ptp(first[:, :3, 3], axis=0).max())
    return Result(
        obtained={"shift": shift, "turn": turn, "moved": moved},
        caption=(
            f"While the flange of carrier 1 moves within {moved:.2f} m, the pose of carrier 2 in "
            f"its frame changes by no more than {shift:.1e} m and {turn:.1e}."
        ),
    )


def periodic_derivative(values: np.ndarray) -> np.ndarray:
    """d/dtheta of samples over one full turn along the first axis, by Fourier transform."""
    count = len(values)
    order = np.fft.rfftfreq(count, 1.0 / count)
    if count % 2 == 0:
        order[-1] = 0.0  # the derivative of the highest cosine vanishes at the samples
    spectrum = np.fft.rfft(values, axis=0)
    factor = (1j * order).reshape(-1, *[1] * (values.ndim - 1))
    return np.fft.irfft(factor * spectrum, n=count, axis=0)


def _tip(cell: Cell, jobs: Jobs) -> np.ndarray:
    """Tip of the torch in the world (N, 3)."""
    flange = flange_poses(cell, jobs, WELDER)
    fixed = cell.flanges[WELDER]
    lever = np.einsum("nji,nj->ni", fixed[:, :3, :3], cell.lever_arms[WELDER])[0]
    return flange[:, :3, :3] @ lever + flange[:, :3, 3]
