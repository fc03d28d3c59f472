"""Placement of a weld: one position with and without constraints, and a whole genetic run."""

from __future__ import annotations

from collections.abc import Iterator
from importlib.util import find_spec

import coal
import numpy as np
import pinocchio as pin
from equal_work import reference, same
from robots import toolbox_chain
from timing import OURS, Row, timed
from weld_cell import GOOD, weld_cell

from dualarm_repro.arms.capsules import segment_capsule
from dualarm_repro.welding import (
    Cell,
    GeneticSettings,
    Jobs,
    Objective,
    Placement,
    evolve,
)
from dualarm_repro.welding.branches import follow

SEAM_POINTS, POSITIONS = 72, 50
BOX = np.array([[-0.6, 0.6], [-0.9, 0.9], [0.1, 1.5]])
_TOLERANCE = 1e-16  # of half the squared error of a pose
PATHS = "joint paths and manipulabilities of a weld at one position"
FITNESS = "the same with every constraint, and its fitness"
RUN = "genetic algorithm, 4 750 evaluations"


def measure() -> Iterator[Row]:
    """Rows of this suite."""
    placement = Placement(weld_cell(SEAM_POINTS), Objective())
    near = GOOD + np.random.default_rng(0).uniform(-0.03, 0.03, (POSITIONS, 3))
    if not (placement(near) > 0).all():
        raise RuntimeError("the positions of the benchmark should be feasible")
    cell, jobs = placement.cell, placement.jobs(near[:1])
    yield timed(PATHS, OURS, lambda: _paths(cell, near), POSITIONS, check=reference())
    yield timed(
        PATHS,
        "pinocchio per point: Newton, Jacobian, determinant",
        lambda: _by_pinocchio(cell, near[0], jobs.q[0]),
        1,
        check=same(
            lambda: [arm.manipulability(q) for arm, q in zip(cell.arms, jobs.q[0], strict=True)],
            lambda: _by_pinocchio(cell, near[0], jobs.q[0]),
            1e-8,
        ),
    )
    if find_spec("roboticstoolbox"):
        yield from _roboticstoolbox(cell, jobs)
    yield timed(FITNESS, OURS, lambda: placement(near), POSITIONS, check=reference())
    yield timed(
        FITNESS,
        "pinocchio per point, coal per pair",
        lambda: (_by_pinocchio(cell, near[0], jobs.q[0]), _by_coal(placement, jobs)),
        1,
        check=same(
            lambda: placement.separation.smallest(jobs.q, jobs.centres),
            lambda: [_by_coal(placement, jobs)],
            1e-6,
        ),
    )
    yield timed(
        RUN, OURS, lambda: evolve(placement, BOX, GeneticSettings(), np.random.default_rng(1)), 1
    )


def _paths(cell: Cell, centres: np.ndarray) -> None:
    for k in range(len(cell.arms)):
        flanges = cell.flanges[k]
        follow(cell.geometries[k], cell.bases[k], flanges, centres, *cell.limits(k), 1e-3)


def _roboticstoolbox(cell: Cell, jobs: Jobs) -> Iterator[Row]:
    """Joint paths from point to point by its fast solver, and manipulabilities; no distances."""
    chains = [toolbox_chain(arm) for arm in cell.arms]
    to_base = np.linalg.inv(cell.bases)

    def found() -> np.ndarray:
        flanges = cell.flanges.copy()
        flanges[:, :, :3, 3] += jobs.centres[0]
        w = np.empty((3, cell.count))
        for k, chain in enumerate(chains):
            q = jobs.q[0, k, 0]
            for n, target in enumerate(to_base[k] @ flanges[k]):
                q = chain.ik_LM(target, q0=q, tol=_TOLERANCE, joint_limits=False).q
                w[k, n] = abs(np.linalg.det(chain.jacob0(q)))
        return w

    check = same(lambda: jobs.w[0], found, 1e-6)
    yield timed(PATHS, "roboticstoolbox IK and manipulability", found, 1, check=check)


def _by_coal(placement: Placement, jobs: Jobs) -> float:
    """Smallest distance of the watched pairs, from cores that are already placed."""
    separation, smallest = placement.separation, np.inf
    request, result = coal.DistanceRequest(), coal.DistanceResult()
    for cores in separation.cores(jobs.q, jobs.centres):
        bodies = [
            segment_capsule(*core, r)
            for core, r in zip(cores, separation.bodies.radius, strict=True)
        ]
        placed = [(shape, coal.Transform3s(p.rotation, p.translation)) for p, shape in bodies]
        for i, j in separation.pairs.rows["capsule"]:
            result.clear()
            smallest = min(smallest, coal.distance(*placed[i], *placed[j], request, result))
    return smallest


def _by_pinocchio(cell: Cell, centre: np.ndarray, start: np.ndarray) -> np.ndarray:
    """Manipulabilities (3, N) by Newton's method from the previous seam point."""
    w = np.empty((3, cell.count))
    for k, arm in enumerate(cell.arms):
        model, data, flange = arm.model, arm.model.createData(), arm.flange_id
        to_base, q = pin.SE3(cell.bases[k]).inverse(), start[k, 0].copy()
        for n in range(cell.count):
            target = pin.SE3(cell.flanges[k, n])
            target.translation = target.translation + centre
            target = to_base * target
            for _ in range(20):
                pin.forwardKinematics(model, data, q)
                pose = pin.updateFramePlacement(model, data, flange)
                error = pin.log6(pose.actInv(target)).vector
                J = pin.computeFrameJacobian(model, data, q, flange)
                if np.linalg.norm(error) < 1e-9:
                    break
                q = q + np.linalg.solve(J, error)
            w[k, n] = abs(np.linalg.det(J))
    return w
