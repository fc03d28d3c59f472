"""Where flanges, torch and held workpiece are along a job by forward kinematics, and velocities."""

from __future__ import annotations

import numpy as np
import pinocchio as pin

from ..arguments import checked
from ..arms import Arm
from ..differences import central_differences
from .cell import ROBOTS, WELDER, Cell, Robot
from .placement import Jobs


@checked
def flange_poses(cell: Cell, jobs: Jobs, robot: Robot) -> np.ndarray:
    """Poses of a flange in the world along the first job (N, 4, 4) [m]."""
    return cell.bases[robot] @ cell.arms[robot].fk(jobs.q[0, robot])


@checked
def torch_tips(cell: Cell, jobs: Jobs) -> np.ndarray:
    """Tip of the torch in the world along the first job (N, 3) [m]."""
    flange, fixed = flange_poses(cell, jobs, WELDER), cell.flanges[WELDER]
    lever = np.einsum("nji,nj->ni", fixed[:, :3, :3], cell.lever_arms[WELDER])[0]
    return flange[:, :3, :3] @ lever + flange[:, :3, 3]


@checked
def held_poses(cell: Cell, jobs: Jobs, robot: Robot) -> np.ndarray:
    """Pose of the workpiece (N, 4, 4) that the joint path of a carrier and its grasp give [m]."""
    local = cell.flanges[robot][0].copy()
    local[:3] = cell.rotations[0].T @ local[:3]
    return flange_poses(cell, jobs, robot) @ np.linalg.inv(local)


def stretch(cell: Cell, jobs: Jobs, robot: Robot) -> np.ndarray:
    """Distance of a wrist from its shoulder along the first job, over the largest there is (N,)."""
    geometry = cell.geometries[robot]
    joints = np.array([cell.arms[robot].joint_positions(q) for q in jobs.q[0, robot]])
    apart = np.linalg.norm(joints[:, 4] - joints[:, 1], axis=1)
    return apart / (geometry.upper_arm[0] + geometry.forearm[0])


@checked
def joint_margin(cell: Cell, jobs: Jobs) -> float:
    """Smallest margin of the first job to a joint limit [rad], negative beyond one."""
    limits = [cell.limits(k) for k in range(len(ROBOTS))]
    pairs = zip(jobs.q[0], limits, strict=True)
    return float(min(np.minimum(q - low, high - q).min() for q, (low, high) in pairs))


def smallest_rank(cell: Cell, jobs: Jobs) -> int:
    """Smallest rank of the Jacobians along the first job."""
    pairs = zip(cell.arms, jobs.q[0], strict=True)
    return min(int(np.linalg.matrix_rank(arm.jacobian(q)).min()) for arm, q in pairs)


def flange_twist(arm: Arm, q: np.ndarray, qd: np.ndarray) -> np.ndarray:
    """Twist (6,) of the flange in base axes, [linear; angular], by central differences of its pose.

    omega is the derivative of log(R(t) R(0)^T). ``q`` [rad] and ``qd`` [rad/s] are (n,).
    """
    back = arm.fk(q)[:3, :3].T

    def moved(time: np.ndarray) -> np.ndarray:
        pose = arm.fk(q + time[0] * qd)
        return np.concatenate([pose[:3, 3], pin.log3(pose[:3, :3] @ back)])

    return central_differences(moved, [0.0])[0]


def periodic_derivative(values: np.ndarray) -> np.ndarray:
    """d/dtheta of samples (N, ...) over one turn along the first axis, by Fourier transform."""
    count = len(values)
    order = np.fft.rfftfreq(count, 1.0 / count)
    if count % 2 == 0:
        order[-1] = 0.0  # the derivative of the highest cosine vanishes at the samples
    spectrum = np.fft.rfft(values, axis=0)
    factor = (1j * order).reshape(-1, *[1] * (values.ndim - 1))
    return np.fft.irfft(factor * spectrum, n=count, axis=0)
