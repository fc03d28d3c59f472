"""What the reproduction of `pan` feeds its methods with: printed values and assumptions."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from math import radians
from typing import Any, Self

import numpy as np

from ...arms import Arm
from ...arms.robot_file import DHRobot, load_robot_file
from ...datafiles import data_path
from ...errors import UnknownNameError
from ...ledger import REGISTRY
from ...tracking import memo
from ...welding import (
    Cell,
    GeneticSettings,
    Objective,
    Placement,
    Seam,
    Tools,
    Torch,
    Workpiece,
    assemble,
    base_poses,
    flat_rotations,
    saddle_seam,
)

SEED = 17
GRIPPER_RADIUS, TORCH_RADIUS = 0.06, 0.02
_BASES = ("base1", "base2", "base3")
_CELLS = 64
_FLOORS = {"present": 0.0, "absent": None}
_ORIENTATIONS = ("identity", "facing_workpiece")


def printed_optimum() -> np.ndarray:
    """C as printed (3,) [m]."""
    return np.array(REGISTRY.printed("pan.claim_optimum")["C"], dtype=float)


def printed_bases() -> np.ndarray:
    """Positions of the three bases as printed (3, 3) [m]."""
    printed = REGISTRY.printed("pan.claim_bases")
    return np.array([printed[name] for name in _BASES], dtype=float)


def printed_base_matrix() -> np.ndarray:
    """The one matrix printed for base 1 (4, 4)."""
    return np.array(REGISTRY.printed("pan.eq_base")["matrix"], dtype=float)


class FromAssumptions:
    """A dataclass whose fields are assumptions of the document, by name."""

    @classmethod
    def of(cls, assumed: Mapping[str, Any]) -> Self:
        """Read exactly the fields from the assumptions."""
        return cls(**{field.name: _hashable(assumed[field.name]) for field in fields(cls)})


@dataclass(frozen=True)
class SeamModel(FromAssumptions):
    """The saddle seam."""

    radius_main: float
    radius_branch: float
    seam_points: int

    @property
    def seam(self) -> Seam:
        """Points and normals."""
        return saddle_seam(self.radius_main, self.radius_branch, round(self.seam_points))


@dataclass(frozen=True)
class FlatSeam(SeamModel):
    """The saddle seam, turned flat point by point."""

    flat_posture: str

    @property
    def rotations(self) -> np.ndarray:
        """R(theta) of the workpiece (N, 3, 3)."""
        return flat_rotations(self.seam, self.flat_posture)


@dataclass(frozen=True)
class Job(FlatSeam):
    """The whole cell."""

    arm: str
    shoulder_height: float
    workpiece_length: float
    branch_length: float
    gripper_length: float
    grasp: str
    torch_length: float
    torch_crank: float
    torch_axis: str
    base_transform: str
    base_orientation: str
    singularity_threshold: float
    link_radius_scale: float
    torch_exemption: float
    floor: str

    def cell(self) -> Cell:
        """Arms, workpiece and tools put together."""
        return _cell(self)

    def placement(self, objective: Objective | None = None) -> Placement:
        """Fitness of positions of this cell."""
        return Placement(self.cell(), objective or Objective())


@dataclass(frozen=True)
class Measure(FromAssumptions):
    """Reading of (16)."""

    weights: str
    ellipsoid_space: str
    carrier_weight: str
    pair_measure: str
    objective: str
    aggregation: str
    length_unit: str

    def reading(self) -> Objective:
        """The same in the words of the method."""
        return Objective(
            weights="tight_only" if self.objective == "tight" else self.weights,
            space=self.ellipsoid_space,
            carriers=self.carrier_weight,
            pair=self.pair_measure,
            aggregation=self.aggregation,
            unit=self.length_unit,
        )


@dataclass(frozen=True)
class Genetic(FromAssumptions):
    """Settings of the genetic algorithm."""

    ga_population: int
    ga_generations: int
    ga_crossover: float
    ga_elite: float
    ga_mutation: str
    ga_stall: float
    infeasible_fitness: str

    def settings(self) -> GeneticSettings:
        """The same in the words of the method."""
        return GeneticSettings(
            population=round(self.ga_population),
            generations=round(self.ga_generations),
            crossover=self.ga_crossover,
            elite=self.ga_elite,
            mutation=self.ga_mutation,
            stall=self.ga_stall,
            infeasible=self.infeasible_fitness,
        )


@memo()
def stand_in(name: str, shoulder_height: float | None = None, scale: float = 1.0) -> Arm:
    """One of the stand-in arms, its shoulder moved and its capsules scaled if asked for."""
    robot = load_robot_file(data_path("robots", f"{name}.yaml"))
    return Arm.from_dh(name, _changed(robot, shoulder_height, scale))


def placed_bases(reading: str, orientation: str) -> np.ndarray:
    """Poses of the bases in the world (3, 4, 4): listed positions read as matrices, then turned.

    Parameters
    ----------
    reading : str
        As in ``base_poses``.
    orientation : str
        ``identity``, or ``facing_workpiece``: the x axis points to the axis z of the world.
    """
    if orientation not in _ORIENTATIONS:
        expected = f"one of {', '.join(_ORIENTATIONS)}"
        raise UnknownNameError("pan", "base_orientation", orientation, expected)
    matrices = np.tile(np.eye(4), (3, 1, 1))
    matrices[:, :3, 3] = printed_bases()
    poses = base_poses(matrices, reading)
    if orientation == "facing_workpiece":
        for pose in poses:
            x, y = -pose[:2, 3] / np.linalg.norm(pose[:2, 3])
            pose[:2, :2] = [[x, -y], [y, x]]
    return poses


@memo(_CELLS)
def _cell(job: Job) -> Cell:
    arm = stand_in(job.arm, job.shoulder_height, job.link_radius_scale)
    scale = job.link_radius_scale
    torch = Torch(
        job.torch_length, radians(job.torch_crank), scale * TORCH_RADIUS, job.torch_exemption
    )
    return assemble(
        [arm] * 3,
        placed_bases(job.base_transform, job.base_orientation),
        Workpiece(
            job.radius_main,
            job.radius_branch,
            job.workpiece_length,
            job.branch_length,
            round(job.seam_points),
        ),
        job.flat_posture,
        Tools(job.grasp, job.gripper_length, scale * GRIPPER_RADIUS, torch, job.torch_axis),
        floor=_FLOORS[job.floor],
        threshold=job.singularity_threshold,
    )


def _changed(robot: DHRobot, height: float | None, scale: float) -> DHRobot:
    first, *rest = robot.joints
    raised = 0.0 if height is None else height - first.d

    def moved(capsule: Any) -> Any:
        start = capsule.start
        if capsule.joint == 1 and start[2] == -first.d:  # the column keeps its foot on the base
            start = (start[0], start[1], start[2] - raised)
        return capsule.model_copy(update={"start": start, "radius": scale * capsule.radius})

    joints = [first.model_copy(update={"d": first.d + raised}), *rest]
    capsules = [moved(capsule) for capsule in robot.capsules]
    return robot.model_copy(update={"joints": joints, "capsules": capsules})


def _hashable(value: Any) -> Any:
    return tuple(_hashable(part) for part in value) if isinstance(value, list) else value
