"""Planning: artificial potential fields, master and slave, and what their plans are worth."""

from .checks.link_clearance import (
    LinkClearance,
    certified_clearance,
    link_clearance,
    require_links_clear,
)
from .checks.truth import Truth, Verdict, truth
from .descent.apf import plan_apf
from .descent.batch import Batch, perturbed, plan_batch
from .descent.cartesian_ik import plan_cartesian_ik, plan_cartesian_ik_batch
from .descent.certificate import Certificate, certify
from .descent.compiled import plan_apf_compiled
from .descent.follow_reason import FollowReason
from .descent.termination import StopReason
from .faults import TaskFaults
from .field.control_points import ControlPoints, control_points
from .field.obstacles import Obstacles, obstacles_of
from .field.potentials import JointAttraction, PointRepulsion, PositionAttraction, Sum
from .gate import require_sound
from .master_slave import CoordinatedPlan, Task, at_tool_speed, plan_master_slave
from .methods import METHODS, Method, method, plan_file, settings_schema
from .plan import Plan
from .planner import FoundPath, PathPlanner, PathProblem, PlannerSettings
from .settings import (
    APFSettings,
    Attraction,
    Combination,
    Repulsion,
    StuckRule,
    Switching,
    Termination,
    Trap,
    Update,
    UpdateRule,
    VirtualPoint,
)
from .tasks.postures import posture
from .tasks.task_file import TaskSet, load_tasks

__all__ = [
    "METHODS",
    "APFSettings",
    "Attraction",
    "Batch",
    "Certificate",
    "Combination",
    "ControlPoints",
    "CoordinatedPlan",
    "FollowReason",
    "FoundPath",
    "JointAttraction",
    "LinkClearance",
    "Method",
    "Obstacles",
    "PathPlanner",
    "PathProblem",
    "Plan",
    "PlannerSettings",
    "PointRepulsion",
    "PositionAttraction",
    "Repulsion",
    "StopReason",
    "StuckRule",
    "Sum",
    "Switching",
    "Task",
    "TaskFaults",
    "TaskSet",
    "Termination",
    "Trap",
    "Truth",
    "Update",
    "UpdateRule",
    "Verdict",
    "VirtualPoint",
    "at_tool_speed",
    "certified_clearance",
    "certify",
    "control_points",
    "link_clearance",
    "load_tasks",
    "method",
    "obstacles_of",
    "perturbed",
    "plan_apf",
    "plan_apf_compiled",
    "plan_batch",
    "plan_cartesian_ik",
    "plan_cartesian_ik_batch",
    "plan_file",
    "plan_master_slave",
    "posture",
    "require_links_clear",
    "require_sound",
    "settings_schema",
    "truth",
]
