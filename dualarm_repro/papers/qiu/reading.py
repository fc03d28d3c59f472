"""The method of `qiu` as it is read: assumptions as frozen settings, and the searches by them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar, NamedTuple, Self

import numpy as np

from ...errors import InputError
from ...ledger.assumptions import Chosen, FromAssumptions
from ...planning.checks.contact_check import ContactCheck
from ...planning.field.control_points import end_effector
from ...planning.field.hull_obstacle import JointCircles
from ...planning.field.obstacles import Obstacles
from ...planning.search.bidirectional_compiled import plan_bidirectional_compiled
from ...planning.search.bidirectional_settings import BidirectionalSettings
from ...planning.search.dual_search import DualSearch, search_around
from ...planning.search.search_plan import SearchPlan
from ...planning.search.splice import smoothed
from ...planning.search.variants import IMPROVED, TRADITIONAL, Variant
from ...planning.tasks.elbow_branches import BRANCHES, branch_posture, pulled_back, wrist_reach
from ...planning.tasks.random_goals import GoalSet, draw_goals
from ...planning.tasks.tip_goal import nearest_posture
from ...scene import PlacedArm, Scene
from ...tracking import memo
from .document import (
    PRINTED,
    dual_scene,
    master_arm,
    placed,
    repelling,
    robot,
    truth_scene,
)

#: Column of a study that the readings of success look at.
JUDGED_BY = {"planner_and_truth": "truth", "planner": "planner"}
#: Origins of joints as the arm's robot description has them: base, shoulder, elbow, forearm root,
#: wrist centre, flange are frames 1 ... 5 and 7 here.
HULL_FRAMES = (1, 2, 3, 4, 5, 7)
#: Share of its reach at which a posture still bends the elbow.
_BENT = 0.9995
#: How far the printed unit of an angle turns [rad], by the reading of it.
ANGLE_UNITS = {"rad": 1.0, "deg": np.pi / 180.0}
#: Samples that the spline needs.
SHORTEST = 5


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


class Reading(FromAssumptions):
    """The assumptions that a part of the method rests on."""

    @classmethod
    def nominal(cls, **changes: Any) -> Self:
        """As the ledger has them, some of them changed."""
        return cls.of(Chosen("qiu", cls.names(), **changes))


def within_reach(q: np.ndarray | None) -> np.ndarray:
    """A posture (6,) [rad] that there is.

    Raises
    ------
    InputError
        There is none.
    """
    if q is None:
        raise InputError("qiu", "posture", q, "a point within reach")
    return q


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
        radius = min(self.goal_radius, _BENT * wrist_reach(self.arm().arm, self.goal_wrist))
        inside = pulled_back(self.arm(), PRINTED.master_goal, radius)
        moved = self.master_goal == "pulled_back"
        found = None if moved else self.posture_at(PRINTED.master_goal)
        return within_reach(self.posture_at(inside)) if found is None else found

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
        return draw_goals(scene, self.posture_at, centre, self.goal_set, int(PRINTED.goals), rng)


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
    floor: str
    limits: str

    #: The improvements that it uses unless another variant is asked for.
    variant: ClassVar[Variant] = TRADITIONAL

    def __post_init__(self) -> None:
        if self.step_rule != "unit_vector":
            raise InputError("qiu", "step_rule", self.step_rule, "unit_vector")

    def settings(
        self, variant: Variant | None = None, goal: np.ndarray | None = None
    ) -> BidirectionalSettings:
        """Settings of a variant whose assumptions this reading has; joint limits that it keeps to
        are no use on the way to a ``goal`` (6,) [rad] beyond them."""
        kept = self.limits == "kept" and (goal is None or self.arm().arm.within_limits(goal))
        return BidirectionalSettings(**self.parts(variant or self.variant), enforce_limits=kept)

    def parts(self, variant: Variant) -> dict[str, Any]:
        """Those settings by their names."""
        points, zeta = CONTROL_POINTS[self.control_points], PRINTED.zeta
        attraction = {"gain": zeta, "threshold": PRINTED.threshold, "measure": self.attraction_form}
        return {
            "attraction": attraction,
            "repulsion": {
                "gain": self.gain_ratio * zeta,
                "influence": PRINTED.influence,
                "sources": self.repulsion_sources,
            },
            "control_points": points.frames,
            "radii": points.radii,
            "step": {"length": PRINTED.alpha0},
            "two_sided": variant.two_sided,
            "ending": {
                "tolerance": self.joint_tolerance,
                "search_limit": round(self.search_cap),
                "stuck_searches": round(self.stuck_rule),
            },
        }

    def plan(self) -> SearchPlan:
        """The master from its start to its goal."""
        return _plan(self)

    def plan_to(self, goal: np.ndarray, variant: Variant | None = None) -> SearchPlan:
        """The master from its start to another goal (6,) [rad]."""
        chosen, around = self.settings(variant, goal), self.obstacles()
        return plan_bidirectional_compiled(self.arm(), PRINTED.start, goal, around, chosen)

    def obstacles(self, with_spheres: bool = True) -> Obstacles:
        """What repels an arm: the spheres and, if assumed, the table."""
        return repelling(self.has_floor, with_spheres)

    @property
    def has_floor(self) -> bool:
        """Whether the arms stand on a table that searches and checks of contact know."""
        return self.floor == "at_bases"

    def truth(self) -> Scene:
        """The scene in which contact of the master is judged."""
        return truth_scene([self.arm()], self.has_floor)

    def is_free(self, check: ContactCheck) -> bool:
        """Whether a path touches nothing and keeps to the limits, as far as they count."""
        return check.smallest > 0.0 and (self.limits == "ignored" or check.beyond_limits <= 0.0)


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
class Gain(Search):
    """A search whose repulsive gain may vary."""

    gain_rule: str
    kappa: float
    delta_rho: float
    flip_rule: str

    def parts(self, variant: Variant) -> dict[str, Any]:
        """Those of any search, and the variable gain."""
        parts = super().parts(variant)
        if variant.variable_gain:
            of = {"rule": self.gain_rule, "kappa": self.kappa, "band": self.delta_rho}
            parts["variable_gain"] = of | {"flip": self.flip_rule}
        return parts


@dataclass(frozen=True)
class VariableGain(Traditional, Gain):
    """The one-sided search with the variable gain only."""

    variant: ClassVar[Variant] = Variant(True, False, False)


@dataclass(frozen=True)
class Improved(Gain):
    """The search from both ends with all improvements."""

    adaptive_step: str
    step_floor: float
    weights: tuple[float, ...]
    update_order: str

    variant: ClassVar[Variant] = IMPROVED

    def parts(self, variant: Variant) -> dict[str, Any]:
        """Those of any search, and what the improvements add."""
        parts = super().parts(variant)
        if variant.adaptive_step:
            weights = [self.weights[k] for k in CONTROL_POINTS[self.control_points].weight_of]
            parts["step"] |= {"rule": self.adaptive_step, "floor": self.step_floor}
            parts["step"]["weights"] = tuple(weights)
        if variant.two_sided:
            parts["order"] = self.update_order
        return parts


@dataclass(frozen=True)
class Splice(Reading):
    """The spline over a joined path."""

    smoothing_weight: float
    end_weight: float

    def smooth(self, path: np.ndarray) -> np.ndarray:
        """A path (N, 6) [rad] after the spline; one too short for it as it is."""
        if len(path) < SHORTEST:
            return path
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

    slave_branch: str
    slave_wrist: tuple[float, ...]

    def slave_postures(self) -> dict[str, np.ndarray]:
        """The postures (6,) [rad] that take the slave to its printed goal, by branch."""
        ends = placed("slave"), PRINTED.slave_goal
        return {b: within_reach(branch_posture(*ends, b, self.slave_wrist)) for b in BRANCHES}

    def slave_posture(self) -> np.ndarray:
        """The one on the assumed branch (6,) [rad]."""
        return self.slave_postures()[self.slave_branch]


@dataclass(frozen=True)
class Slave(Improved, Splice, Hull, SlaveGoal):
    """The search of the slave around the hull of the moving master, and that of the master."""

    schedule_steps: float
    slave_obstacles: str

    def dual_plan(self) -> DualSearch:
        """Both arms from their starts to their goals."""
        return _dual_plan(self)

    def smooth_inside(self, path: np.ndarray) -> np.ndarray:
        """A path (N, 6) [rad] after the spline, cut at the limits that it has kept to before."""
        arm, made = placed("slave").arm, self.smooth(path)
        kept = self.limits == "kept" and bool(arm.within_limits(path).all())  # type: ignore[union-attr]
        return np.clip(made, *arm.limits()) if kept else made

    def around(self, master: SearchPlan, goal: np.ndarray) -> DualSearch:
        """The slave from its start to a goal (6,) [rad] around the master on its path."""
        return search_around(
            master,
            placed("slave"),
            (PRINTED.start, goal),
            self.obstacles(self.slave_obstacles != "master"),
            self.settings(goal=goal),
            self.circles(),
            round(self.schedule_steps),
            self.smooth_inside,
        )

    def scene(self, radii: tuple[float, ...] | None = None) -> Scene:
        """Both arms among the spheres, links of other ``radii`` [m]."""
        return dual_scene(self.master_goal, radii, self.has_floor)


@memo(512)
def _dual_plan(reading: Slave) -> DualSearch:
    return reading.around(reading.plan(), reading.slave_posture())
