"""The method as `pan` has it: cell, measure and search by its assumptions, and their runs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import radians
from typing import Any

import numpy as np

from ...errors import InputError
from ...ledger import Result
from ...ledger.assumptions import FromAssumptions, hashable
from ...tracking import memo
from ...view.scene3d import Scene3D
from ...view.welding_scene import job_scene
from ...welding import (
    Cell,
    Evolution,
    GeneticSettings,
    Jobs,
    Measures,
    Objective,
    Optimum,
    Placement,
    Seam,
    Status,
    Survey,
    Tools,
    Torch,
    Trace,
    Workpiece,
    assemble,
    evolve,
    extreme_position,
    flat_rotations,
    grid_optimum,
    saddle_seam,
    survey,
    watch,
)
from ...welding.landscape import nearer_image
from .document import SEED, placed_bases, printed_optimum, stand_in

GRIPPER_RADIUS, TORCH_RADIUS = 0.06, 0.02  # [m]
SPACING, STARTS, TOLERANCE = 0.1, 4, 1e-5  # [m], cells, [m]
#: Largest manipulability of the bars in the scenes [m^3].
FULL_SCALE = 0.7
#: How much denser than the seam that is searched the constraints are tested.
DENSER = 10
#: Seam point at which the cell is drawn.
SHOWN = {"first_seam_point": 0}
_NO_SOLUTION = "No position of the region is feasible, so the problem has no solution."
#: Generations over which each stall rule averages.
_STALLS = {"mean_over_10": 10, "best_over_50": 50}
_FLOORS = {"present": 0.0, "absent": None}
#: Answers kept: small ones of every draw, large ones of the last few.
_SMALL, _LARGE, _CELLS = 4096, 16, 64


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
    carrier_reference: str

    @memo(_CELLS)
    def cell(self) -> Cell:
        """Arms, workpiece and tools put together."""
        scale, bend = self.link_radius_scale, radians(self.torch_crank)
        pipes = self.radius_main, self.radius_branch, self.workpiece_length, self.branch_length
        torch = Torch(self.torch_length, bend, scale * TORCH_RADIUS, self.torch_exemption)
        return assemble(
            [stand_in(self.arm, self.shoulder_height, scale)] * 3,
            placed_bases(self.base_transform, self.base_orientation),
            Workpiece(*pipes, round(self.seam_points)),
            self.flat_posture,
            Tools(self.grasp, self.gripper_length, scale * GRIPPER_RADIUS, torch, self.torch_axis),
            floor=_FLOORS[self.floor],
            threshold=self.singularity_threshold,
            reference=self.carrier_reference,
        )

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


#: The assumptions on the problem, the region aside.
PROBLEM = (*Job.names(), *Measure.names())


@dataclass(frozen=True)
class Genetic(FromAssumptions):
    """Settings of the genetic algorithm."""

    ga_population: int
    ga_generations: int
    ga_crossover: float
    ga_elite: float
    ga_mutation: str
    ga_stall: float
    ga_stall_rule: str
    ga_box: tuple[tuple[float, float], ...]
    infeasible_fitness: str

    @property
    def box(self) -> np.ndarray:
        """Bounds of the individuals (3, 2) [m]."""
        return np.array(self.ga_box)

    def settings(self) -> GeneticSettings:
        """The same in the words of the method."""
        return GeneticSettings(
            population=round(self.ga_population),
            generations=round(self.ga_generations),
            crossover=self.ga_crossover,
            elite=self.ga_elite,
            mutation=self.ga_mutation,
            stall=self.ga_stall,
            stall_of=self.ga_stall_rule.split("_")[0],
            stall_generations=_STALLS[self.ga_stall_rule],
            infeasible=self.infeasible_fitness,
        )


@dataclass(frozen=True)
class Problem:
    """What is optimised: a job, a reading of (16) and the region of its positions [m]."""

    job: Job
    measure: Measure
    search_box: tuple[tuple[float, float], ...]

    @classmethod
    def of(cls, assumed: Mapping[str, Any], measure: Measure | None = None) -> Problem:
        """From the assumptions, which say nothing of the measure if it is given."""
        measure = measure or Measure.of(assumed)
        return cls(Job.of(assumed), measure, hashable(assumed["search_box"]))

    @property
    def box(self) -> np.ndarray:
        """Lower and upper bounds (3, 2) [m]."""
        return np.array(self.search_box)

    def placement(self) -> Placement:
        """Fitness of positions."""
        return self.job.placement(self.measure.reading())


@memo(_LARGE)
def surveyed(problem: Problem) -> Survey:
    """Fitness and constraints on the grid from which the optimum is refined."""
    return survey(problem.placement(), problem.box, SPACING)


@memo(_SMALL)
def optimum(problem: Problem) -> Optimum:
    """Best position in the region; of two mirror images the one nearer to the printed point.

    The position is NaN if no position of the grid is feasible.
    """
    placement, known = problem.placement(), surveyed(problem).fitness
    found = grid_optimum(placement, problem.box, SPACING, STARTS, TOLERANCE, known)
    return nearer_image(found, placement, printed_optimum())


@memo(_SMALL)
def poor_position(problem: Problem, rule: str) -> Optimum:
    """Feasible position that a rule calls poor; NaN if no position of the grid is feasible."""
    placement, known = problem.placement(), surveyed(problem)
    return extreme_position(
        placement, problem.box, rule, spacing=SPACING, starts=STARTS, known=known
    )


@memo(_LARGE)
def solved(job: Job, position: tuple[float, ...]) -> Jobs:
    """Joint paths and constraints of the job at one position."""
    return job.placement().jobs([position])


def denser(job: Job) -> Job:
    """The same job on a denser seam."""
    return replace(job, seam_points=DENSER * round(job.seam_points))


def measures_at(problem: Problem, position: np.ndarray) -> Measures:
    """Measures along the seam (N,) at a position that every robot reaches."""
    found = problem.placement().measures(solved(problem.job, tuple(position)))
    return Measures(*(values[0] for values in found))


def at_display(assumed: Mapping[str, Any]) -> tuple[Cell, Jobs, np.ndarray]:
    """The cell and its job at the position used where any would do.

    Raises
    ------
    InputError
        A robot has no joint path there.
    """
    job, centre = Job.of(assumed), hashable(assumed["display_position"])
    jobs = solved(job, centre)
    if not np.isfinite(jobs.q).all():
        expected = "a position at which every robot has a joint path"
        raise InputError("pan", "display_position", centre, expected)
    return job.cell(), jobs, np.array(centre)


def at_optimum(assumed: Mapping[str, Any]) -> tuple[Cell, Jobs, np.ndarray, Measures]:
    """The job at the optimum obtained: cell, joint paths, position, measures along the seam.

    Raises
    ------
    InputError
        No position of the region is feasible.
    """
    problem = Problem.of(assumed)
    centre = optimum(problem).position
    jobs = solved(problem.job, tuple(centre))
    return problem.job.cell(), jobs, centre, measures_at(problem, centre)


@memo(_SMALL)
def one_run(problem: Problem, settings: Genetic) -> Evolution:
    """One seeded run of the search, as the document describes one."""
    rng = np.random.default_rng(SEED)
    return evolve(problem.placement(), settings.box, settings.settings(), rng, must_find=False)


@memo(_LARGE)
def traced(problem: Problem, settings: Genetic) -> Trace:
    """One seeded run of the search, watched."""
    rng = np.random.default_rng(SEED)
    return watch(problem.placement(), settings.box, settings.settings(), rng)


def job_scene_at(title: str, cell: Cell, jobs: Jobs, centre: np.ndarray) -> Scene3D:
    """The animation of the whole job at one position."""
    return job_scene(title, cell, jobs.q[0], centre, jobs.w[0], FULL_SCALE)


def status_name(jobs: Jobs) -> str:
    """Outcome of the constraints at the first position, in words."""
    return Status(int(jobs.status[0])).name.lower().replace("_", " ")


def nothing_feasible(*keys: str, told: str = _NO_SOLUTION) -> Result:
    """The outcome where nothing is feasible, and so none of these values exist."""
    return Result(obtained=dict.fromkeys(keys), caption=told)
