"""The report that a recipe ends in: what `dualarm plan` prints, as a table."""

from __future__ import annotations

from collections.abc import Mapping

import pandas as pd

from ..planning.checks.truth import Truth, truth
from ..planning.methods import AnyPlan
from ..scene import JointPath, Scene
from .plan_report import plan_summary, told


def certified_report(*plans: AnyPlan) -> pd.DataFrame:
    """One column a plan, phase after phase: every arm, the closest bodies, and the outcome.

    The distance is the bracket ``lower <= d <= upper`` [m] of :func:`.truth` over all watched pairs
    of bodies at every time, between the steps too.
    """
    columns = {}
    for number, plan in enumerate(plans, start=1):
        found = truth(plan.scene, plan.paths)
        summary = plan_summary(plan, found)
        rows = {name: _ended(one) for name, one in summary["arms"].items()}
        rows |= _closest(found) | {"outcome": told(found, summary["reached"])}
        columns["plan" if len(plans) == 1 else f"plan {number}"] = rows
    return pd.DataFrame(columns)


def certified_motion(scene: Scene, paths: Mapping[str, JointPath]) -> pd.DataFrame:
    """The same of a motion that no planner of the library made: paths of every arm of a scene."""
    found = truth(scene, paths)
    arms = {name: f"{len(path.configurations)} configurations" for name, path in paths.items()}
    limits = "kept" if found.within_limits else "NOT KEPT"
    verdict = {"joint limits": limits, "outcome": str(found.verdict)}
    return pd.DataFrame({"motion": arms | _closest(found) | verdict})


def _ended(arm: Mapping[str, object]) -> str:
    return f"{arm['reason']}, {arm['steps']} steps" if arm["steps"] else str(arm["reason"])


def _closest(found: Truth) -> dict[str, str]:
    return {
        "closest bodies": " - ".join(found.pair or ()) or "none are watched",
        "distance [m]": f"{found.lower:.4f} to {found.upper:.4f}",
    }
