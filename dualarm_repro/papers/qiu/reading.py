"""The method of `qiu` as it is read: its assumptions as frozen settings, and its searches by
them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, ClassVar, NamedTuple, Self

import numpy as np

from ...errors import InputError
from ...ledger.assumptions import Chosen, FromAssumptions
from ...planning.field.control_points import end_effector
from ...planning.field.hull_obstacle import JointCircles
from ...planning.search.bidirectional import repulsive_torque, surroundings_at
from ...planning.search.bidirectional_compiled import plan_bidirectional_compiled
from ...planning.search.bidirectional_settings import BidirectionalSettings
from ...planning.search.search_plan import SearchPlan
from ...planning.search.search_problem import search_problem
from ...planning.search.splice import smoothed
from ...planning.tasks.random_goals import GoalSet, draw_goals
from ...planning.tasks.tip_goal import nearest_posture
from ...scene import PlacedArm
from ...tracking import memo
from .document import PRINTED, master_arm, placed, repelling, robot, truth_scene
from .postures import BRANCHES, branch_posture, pulled_back, wrist_reach

#: Column of a study that the readings of success look at.
JUDGED_BY = {"planner_and_truth": "truth", "planner": "planner"}
#: Origins of joints as the arm's robot description has them: base, shoulder, elbow, forearm root,
#: wrist centre, flange are frames 1 ... 5 and 7 here.
HULL_FRAMES = (1, 2, 3, 4, 5, 7)
#: Share of its reach at which a posture still bends the elbow.
_BENT = 0.9995


class PointSet(NamedTuple):
    """Control points: their frames, the weight that each has, as origin of which joint its reading
    counts it, and whether it has the thickness of its link."""

    frames: tuple[int, ...]
    weight_of: tuple[int, ...]
    joints: tuple[str, ...]
    thick: bool = False

    @property
    def radii(self) -> tuple[float, ...]:
        """Of the points [m]."""
        links = [capsule.radius for capsule in robot().capsules]
        return tuple(links[-len(self.frames) :]) if self.thick else (0.0,) * len(self.frames)


CONTROL_POINTS = {
    "elbow_wrist_flange": PointSet((3, 5, 7), (0, 1, 2), ("3", "5", "6")),
    "standard_frames": PointSet((4, 5, 7), (0, 1, 2), ("3", "5", "6")),
    "elbow_wrist": PointSet((3, 5), (1, 2), ("3", "5")),
    "four_with_link_radii": PointSet((3, 4, 5, 7), (0, 0, 1, 2), ("3", "4", "5", "6"), thick=True),
}


@dataclass(frozen=True)
class Variant:
    """Which of the three improvements a search uses."""

    variable_gain: bool = True
    adaptive_step: bool = True
    two_sided: bool = True

    @property
    def name(self) -> str:
        """``traditional``, or the letters of the improvements: V gain, A step, B both ends."""
        letters = zip("VAB", (self.variable_gain, self.adaptive_step, self.two_sided), strict=True)
        return "".join(letter for letter, on in letters if on) or "traditional"


ONE_SIDED, IMPROVED = Variant(False, False, False), Variant()
VARIANTS = tuple(
    Variant(gain, step, both)
    for both in (False, True)
    for gain in (False, True)
    for step in (False, True)
)


class Reading(FromAssumptions):
    """The assumptions that a part of the method rests on."""

    @classmethod
    def nominal(cls, **changes: Any) -> Self:
        """As the ledger has them, some of them changed."""
        return cls.of(Chosen("qiu", cls.names(), **changes))


@dataclass(frozen=True)
class Goal(Reading):
    """The goal of the master."""

    master_goal: str
    goal_radius: float
    goal_branch: str
    goal_wrist: tuple[float, ...]

    def arm(self) -> PlacedArm:
        """The master on its base, with the change to arm or base that this reading makes."""
        return master_arm(self.master_goal)

    def posture(self) -> np.ndarray:
        """Goal (6,) [rad]; the radius is cut to what the arm reaches with the wrist."""
        if self.master_goal == "best_effort":
            near = Goal("pulled_back", self.goal_radius, self.goal_branch, self.goal_wrist)
            return _best_effort(near)
        radius = min(self.goal_radius, _BENT * wrist_reach(self.arm(), self.goal_wrist))
        inside = pulled_back(PRINTED.master_goal, self.arm().placement.translation, radius)
        if self.master_goal == "pulled_back":
            return self.posture_at(inside)
        found = self.posture_at(PRINTED.master_goal)
        return self.posture_at(inside) if found is None else found

    def posture_at(self, point: np.ndarray) -> np.ndarray | None:
        """Posture (6,) [rad] on the branch and with the wrist at another point; None beyond
        reach."""
        return branch_posture(self.arm(), point, self.goal_branch, self.goal_wrist)


@memo(512)
def _best_effort(near: Goal) -> np.ndarray:
    return nearest_posture(near.arm(), PRINTED.master_goal, near.posture()).q


@dataclass(frozen=True)
class GoalBox(Goal):
    """The box around the goal of the master from which further goals are drawn."""

    goal_set: float

    def draw(self, seed: int) -> GoalSet:
        """As many goals as are printed."""
        arm, rng = self.arm(), np.random.default_rng(seed)
        centre, scene = end_effector(arm, self.posture()), truth_scene([arm])
        return draw_goals(scene, self.posture_at, centre, self.goal_set, PRINTED.goals, rng)


@dataclass(frozen=True)
class Search(Goal):
    """A search of the master, with what all variants share."""

    attraction_form: str
    repulsion_sources: str
    control_points: str
    gain_ratio: float
    step_rule: str
    joint_tolerance: float
    stuck_rule: float
    search_cap: float

    #: The improvements that it uses unless another variant is asked for.
    variant: ClassVar[Variant] = ONE_SIDED

    def __post_init__(self) -> None:
        if self.step_rule != "unit_vector":
            raise InputError("qiu", "step_rule", self.step_rule, "unit_vector")

    def settings(self, variant: Variant | None = None) -> BidirectionalSettings:
        """Settings of a variant whose assumptions this reading has."""
        variant = variant or self.variant
        points, gain, step = CONTROL_POINTS[self.control_points], {}, {"length": PRINTED.alpha0}
        if variant.variable_gain:
            gain = {
                "rule": self.gain_rule,
                "kappa": self.kappa,
                "band": self.delta_rho,
                "flip": self.flip_rule,
            }
        if variant.adaptive_step:
            step |= {
                "rule": self.adaptive_step,
                "floor": self.step_floor,
                "weights": tuple(self.weights[k] for k in points.weight_of),
            }
        return BidirectionalSettings(
            attraction={
                "gain": PRINTED.zeta,
                "threshold": PRINTED.threshold,
                "measure": self.attraction_form,
            },
            repulsion={
                "gain": self.gain_ratio * PRINTED.zeta,
                "influence": PRINTED.influence,
                "sources": self.repulsion_sources,
            },
            control_points=points.frames,
            radii=points.radii,
            variable_gain=gain,
            step=step,
            two_sided=variant.two_sided,
            order=self.update_order if variant.two_sided else "before",
            ending={
                "tolerance": self.joint_tolerance,
                "search_limit": round(self.search_cap),
                "stuck_searches": round(self.stuck_rule),
            },
        )

    def plan(self) -> SearchPlan:
        """The master from its start to its goal."""
        return _plan(self)

    def plan_to(self, goal: np.ndarray, variant: Variant | None = None) -> SearchPlan:
        """The master from its start to another goal (6,) [rad]."""
        chosen = self.settings(variant)
        return plan_bidirectional_compiled(self.arm(), PRINTED.start, goal, repelling(), chosen)

    def reconstructed(self) -> Self:
        """The second reading: the gain ratio of the scale that the printed trap gives, and control
        points that carry the thickness of their links; everything else as assumed."""
        return replace(self, gain_ratio=balance_ratio(), control_points="four_with_link_radii")


@memo(512)
def _plan(reading: Search) -> SearchPlan:
    return reading.plan_to(reading.posture())


@dataclass(frozen=True)
class Traditional(Search):
    """The one-sided search with constant gain and step."""

    baseline: str

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.baseline != "same_potentials":
            raise InputError("qiu", "baseline", self.baseline, "same_potentials")


@dataclass(frozen=True)
class Gain(Reading):
    """The variable repulsive gain."""

    gain_rule: str
    kappa: float
    delta_rho: float
    flip_rule: str


@dataclass(frozen=True)
class VariableGain(Traditional, Gain):
    """The one-sided search with the variable gain only."""

    variant: ClassVar[Variant] = Variant(True, False, False)


@dataclass(frozen=True)
class Improved(Search, Gain):
    """The search from both ends with all improvements."""

    adaptive_step: str
    step_floor: float
    weights: tuple[float, ...]
    update_order: str

    variant: ClassVar[Variant] = IMPROVED


@dataclass(frozen=True)
class Splice(Reading):
    """The spline over a joined path."""

    smoothing_weight: float
    end_weight: float

    def smooth(self, path: np.ndarray) -> np.ndarray:
        """A path (N, 6) [rad] after the spline."""
        return smoothed(path, self.smoothing_weight, self.end_weight)


@dataclass(frozen=True)
class Hull(Reading):
    """The convex hull of the moving master."""

    hull_radii: tuple[float, ...]
    hull_samples: float
    circle_plane: str

    def circles(self) -> JointCircles:
        """Circles at the origins of the joints."""
        along = self.circle_plane == "containing_axis"
        return JointCircles(HULL_FRAMES, self.hull_radii, round(self.hull_samples), along)


@dataclass(frozen=True)
class Links(Reading):
    """The thickness of the links."""

    link_radii: tuple[float, ...]
    link_radius_scale: float

    @property
    def radii(self) -> tuple[float, ...]:
        """Radii of the link capsules [m]."""
        return tuple(self.link_radius_scale * radius for radius in self.link_radii)


@dataclass(frozen=True)
class SlaveGoal(Reading):
    """The goal of the slave."""

    goal_wrist: tuple[float, ...]
    slave_branch: str

    def slave_postures(self) -> dict[str, np.ndarray]:
        """The postures (6,) [rad] that take the slave to its printed goal, by branch."""
        arm, point = placed("slave"), PRINTED.slave_goal
        return {branch: branch_posture(arm, point, branch, self.goal_wrist) for branch in BRANCHES}

    def slave_posture(self) -> np.ndarray:
        """The one on the assumed branch (6,) [rad]."""
        return self.slave_postures()[self.slave_branch]


@memo()
def balance_ratio() -> float:
    """eta_0/zeta at which repulsion of the flange at the printed trap is as large as the largest
    attraction.

    d zeta = |J^T F_rep| with the flange at the trap, wrist angles zero. Sizes are compared, not
    directions: it is a scale taken from one printed point, and no balance of forces.
    """
    arm, threshold = placed("master"), PRINTED.threshold
    q = branch_posture(arm, PRINTED.trap, "front_shallow")
    chosen = BidirectionalSettings(
        attraction={"gain": 1.0, "threshold": threshold},
        repulsion={"gain": 1.0, "influence": PRINTED.influence},
        control_points=(7,),
        step={"length": PRINTED.alpha0},
        ending={"tolerance": 1.0, "search_limit": 1, "stuck_searches": 1},
    )
    made = search_problem(arm, q, q, repelling(), chosen)
    torque = repulsive_torque(made, surroundings_at(made, 0, q, 0), np.ones(1))
    return threshold / float(np.linalg.norm(torque))
