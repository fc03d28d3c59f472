"""Readings of the method of `qiu`: settings and plans from assumption values."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...planning.field.hull_obstacle import JointCircles
from ...planning.search.bidirectional import repulsive_torque, surroundings_at
from ...planning.search.bidirectional_compiled import plan_bidirectional_compiled
from ...planning.search.bidirectional_settings import BidirectionalSettings
from ...planning.search.search_plan import SearchPlan
from ...planning.search.search_problem import search_problem
from ...planning.search.splice import smoothed
from ...planning.search.time_map import hull_tracks
from ...planning.tasks.tip_goal import nearest_posture
from ...scene import PlacedArm
from ...tracking import memo
from .printed_points import trap
from .scenario import (
    ALPHA0,
    BRANCHES,
    INFLUENCE,
    MASTER_GOAL,
    MOVED_BASE,
    SLAVE_GOAL,
    START,
    THRESHOLD,
    TOOL,
    ZETA,
    branch_posture,
    placed,
    pulled_back,
    repelling,
    wrist_reach,
)

GOAL = ("master_goal", "goal_radius", "goal_branch", "goal_wrist")
FIELD = ("attraction_form", "repulsion_sources", "control_points", "gain_ratio")
WALK = ("step_rule", "joint_tolerance", "stuck_rule", "search_cap")
GAIN = ("gain_rule", "kappa", "delta_rho", "flip_rule")
STEP = ("adaptive_step", "step_floor", "weights")
SPLICE = ("smoothing_weight", "end_weight")
HULL = ("hull_radii", "hull_samples", "circle_plane")
TRUTH = ("link_radii", "link_radius_scale")
#: Assumptions behind a one-sided search, the search of the document, and the slave's.
TRADITIONAL = (*GOAL, *FIELD, *WALK, "baseline")
IMPROVED = (*GOAL, *FIELD, *WALK, *GAIN, *STEP, "update_order")
SLAVE = (
    *IMPROVED,
    *SPLICE,
    *HULL,
    "schedule_steps",
    "slave_branch",
    "slave_obstacles",
    "floor",
)

#: Origins of joints as the arm's robot description has them: base, shoulder, elbow, forearm root,
#: wrist centre, flange are frames 1 ... 5 and 7 here.
HULL_FRAMES = (1, 2, 3, 4, 5, 7)
#: Frames of the control points, radii [m], which weight each has, and as origin of which joint its
#: reading counts it.
CONTROL_POINTS = {
    "elbow_wrist_flange": ((3, 5, 7), (0.0, 0.0, 0.0), (0, 1, 2), ("3", "5", "6")),
    "standard_frames": ((4, 5, 7), (0.0, 0.0, 0.0), (0, 1, 2), ("3", "5", "6")),
    "elbow_wrist": ((3, 5), (0.0, 0.0), (1, 2), ("3", "5")),
    "four_with_link_radii": (
        (3, 4, 5, 7),
        (0.075, 0.07, 0.055, 0.04),
        (0, 0, 1, 2),
        ("3", "4", "5", "6"),
    ),
}
#: Share of its reach at which a posture still bends the elbow.
_BENT = 0.9995


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


TRADITIONAL_VARIANT = Variant(False, False, False)
IMPROVED_VARIANT = Variant()
VARIANTS = tuple(
    Variant(gain, step, both)
    for both in (False, True)
    for gain in (False, True)
    for step in (False, True)
)


def settings(values: Mapping[str, Any], variant: Variant) -> BidirectionalSettings:
    """Settings of a search; reads only what the variant needs."""
    frames, radii, weight_of, _ = CONTROL_POINTS[values["control_points"]]
    if values["step_rule"] != "unit_vector":
        raise ValueError("the step follows the unit vector of the force")
    gain, step = {}, {"length": ALPHA0}
    if variant.variable_gain:
        gain = {
            "rule": values["gain_rule"],
            "kappa": values["kappa"],
            "band": values["delta_rho"],
            "flip": values["flip_rule"],
        }
    if variant.adaptive_step:
        step |= {
            "rule": values["adaptive_step"],
            "floor": values["step_floor"],
            "weights": tuple(values["weights"][k] for k in weight_of),
        }
    return BidirectionalSettings(
        attraction={"gain": ZETA, "threshold": THRESHOLD, "measure": values["attraction_form"]},
        repulsion={
            "gain": values["gain_ratio"] * ZETA,
            "influence": INFLUENCE,
            "sources": values["repulsion_sources"],
        },
        control_points=frames,
        radii=radii,
        variable_gain=gain,
        step=step,
        two_sided=variant.two_sided,
        order=values["update_order"] if variant.two_sided else "before",
        ending={
            "tolerance": values["joint_tolerance"],
            "search_limit": round(values["search_cap"]),
            "stuck_searches": round(values["stuck_rule"]),
        },
    )


def link_radii(values: Mapping[str, Any]) -> tuple[float, ...]:
    """Radii of the link capsules as assumed [m]."""
    return tuple(values["link_radius_scale"] * radius for radius in values["link_radii"])


def master_arm(values: Mapping[str, Any], radii: tuple[float, ...] | None = None) -> PlacedArm:
    """The master on its base, with the change to arm or base that the reading of its goal makes."""
    mode = values["master_goal"]
    base = np.array([MOVED_BASE, 0.0, 0.0]) if mode == "moved_base" else None
    tool = TOOL if mode == "longer_tool" else 0.0
    return placed("master", base=base, tool=tool, radii=radii)


def master_posture(values: Mapping[str, Any]) -> np.ndarray:
    """Goal of the master (6,) [rad] under the reading of its goal, radius, branch and wrist.

    The radius is cut to what the arm reaches with the wrist.
    """
    arm, branch, wrist = master_arm(values), values["goal_branch"], values["goal_wrist"]
    base, radius = arm.placement.translation, _radius(arm, values["goal_radius"], wrist)
    inside = pulled_back(MASTER_GOAL, base, radius)
    match values["master_goal"]:
        case "pulled_back":
            point = inside
        case "best_effort":
            return _best_effort(branch, radius, tuple(wrist))
        case _:
            point = MASTER_GOAL
    found = branch_posture(arm, point, branch, wrist)
    return branch_posture(arm, inside, branch, wrist) if found is None else found


def _radius(arm: PlacedArm, radius: float, wrist: Sequence[float]) -> float:
    return min(radius, _BENT * wrist_reach(arm, wrist))


@memo(512)
def _best_effort(branch: str, radius: float, wrist: tuple[float, ...]) -> np.ndarray:
    arm = placed("master")
    near = branch_posture(
        arm, pulled_back(MASTER_GOAL, arm.placement.translation, radius), branch, wrist
    )
    return nearest_posture(arm, MASTER_GOAL, near).q


def _memo(plan: Callable[..., Any]) -> Callable[..., Any]:
    """Keep the outcomes of ``plan(values, names, ...)`` by the values of the names."""

    @memo(512)
    def kept(text: str, *rest: Any) -> Any:
        return plan(json.loads(text), *rest)

    def call(values: Mapping[str, Any], names: Sequence[str], *rest: Any) -> Any:
        return kept(json.dumps({name: values[name] for name in names}), *rest)

    return call


@_memo
def _master_plan(values: Mapping[str, Any], variant: Variant) -> SearchPlan:
    goal = master_posture(values)
    return plan_bidirectional_compiled(
        master_arm(values), START, goal, repelling(), settings(values, variant)
    )


def plan_to(values: Mapping[str, Any], variant: Variant, goal: np.ndarray) -> SearchPlan:
    """Master from its start to another goal (6,) [rad]."""
    chosen = settings(values, variant)
    return plan_bidirectional_compiled(master_arm(values), START, goal, repelling(), chosen)


def traditional_plan(values: Mapping[str, Any]) -> SearchPlan:
    """Master from its start to its goal, one-sided, constant gain and step."""
    return _master_plan(values, TRADITIONAL, TRADITIONAL_VARIANT)


def variable_gain_plan(values: Mapping[str, Any]) -> SearchPlan:
    """The one-sided search with the variable gain only."""
    return _master_plan(values, (*TRADITIONAL, *GAIN), Variant(True, False, False))


def improved_plan(values: Mapping[str, Any]) -> SearchPlan:
    """Master from both ends with all improvements."""
    return _master_plan(values, IMPROVED, IMPROVED_VARIANT)


def smooth(values: Mapping[str, Any], plan: SearchPlan) -> np.ndarray:
    """Path of a plan after the spline (N, 6) [rad]."""
    return smoothed(plan.path, values["smoothing_weight"], values["end_weight"])


def circles(values: Mapping[str, Any]) -> JointCircles:
    """Circles of the hull model."""
    return JointCircles(
        HULL_FRAMES,
        tuple(values["hull_radii"]),
        round(values["hull_samples"]),
        values["circle_plane"] == "containing_axis",
    )


def slave_postures(values: Mapping[str, Any]) -> dict[str, np.ndarray]:
    """The postures (6,) [rad] that take the slave to its printed goal, by branch."""
    arm, wrist = placed("slave"), values["goal_wrist"]
    return {branch: branch_posture(arm, SLAVE_GOAL, branch, wrist) for branch in BRANCHES}


def slave_posture(values: Mapping[str, Any]) -> np.ndarray:
    """Goal of the slave (6,) [rad] on the assumed branch."""
    return slave_postures(values)[values["slave_branch"]]


@dataclass(frozen=True, eq=False)
class DualPlan:
    """Master and slave: the searches, their smoothed paths (N, 6), the spread of the schedule
    and the reading of the master's goal.
    """

    master: SearchPlan
    slave: SearchPlan
    master_path: np.ndarray
    slave_path: np.ndarray
    spread: int
    master_goal: str


@_memo
def _dual_plan(values: Mapping[str, Any]) -> DualPlan:
    master = improved_plan(values)
    path = smooth(values, master)
    spread = round(values["schedule_steps"])
    obstacles = repelling(values["floor"] == "half_space", values["slave_obstacles"] != "master")
    slave = plan_bidirectional_compiled(
        placed("slave"),
        START,
        slave_posture(values),
        obstacles,
        settings(values, IMPROVED_VARIANT),
        hull_tracks(master_arm(values), path, circles(values), spread),
    )
    return DualPlan(master, slave, path, smooth(values, slave), spread, values["master_goal"])


def dual_plan(values: Mapping[str, Any]) -> DualPlan:
    """The slave around the hull of the moving master."""
    return _dual_plan(values, SLAVE)


@memo()
def balance_ratio(branch: str = "front_shallow") -> float:
    """eta_0/zeta at which repulsion of the flange at the printed trap is as large as the largest
    attraction.

    d zeta = |J^T F_rep| with the flange at the trap, wrist angles zero. Sizes are compared, not
    directions: it is a scale taken from one printed point, and no balance of forces.
    """
    arm = placed("master")
    q = branch_posture(arm, trap(), branch)
    chosen = BidirectionalSettings(
        attraction={"gain": 1.0, "threshold": THRESHOLD},
        repulsion={"gain": 1.0, "influence": INFLUENCE},
        control_points=(7,),
        step={"length": ALPHA0},
        ending={"tolerance": 0.05, "search_limit": 1, "stuck_searches": 1},
    )
    made = search_problem(arm, q, q, repelling(), chosen)
    torque = repulsive_torque(made, surroundings_at(made, 0, q, 0), np.ones(1))
    return THRESHOLD / float(np.linalg.norm(torque))


def reconstructed(values: Mapping[str, Any], names: Sequence[str]) -> dict[str, Any]:
    """The second reading: the gain ratio of the scale that the printed trap gives, and control
    points that carry the thickness of their links; everything else as assumed."""
    changes = {"gain_ratio": balance_ratio(), "control_points": "four_with_link_radii"}
    return {name: values[name] for name in names} | changes
