"""RRT-Connect beside other planners: its outcome on a task, as columns of a study."""

from __future__ import annotations

from importlib.util import find_spec
from typing import Any

import numpy as np

from ...scene import Scene
from ..checks.contact_check import contact_check
from ..search.rrt_connect import plan_rrt_connect

#: What the columns begin with, and the package that they need.
YARDSTICK, PACKAGE = "rrt_connect", "ompl"


def yardstick(
    scene: Scene, start: np.ndarray, goal: np.ndarray, rng: np.random.Generator, most: int
) -> dict[str, Any]:
    """Whether RRT-Connect arrives, in truth as well, and the states it checks, at most ``most``.

    Nothing where OMPL is not installed, so that everything else can be compared there.
    """
    if find_spec(PACKAGE) is None:
        return {}
    sampled = plan_rrt_connect(scene, start, goal, int(rng.integers(2**31 - 2)), most)
    path = sampled.path
    return {
        f"{YARDSTICK}_planner": sampled.reached,
        f"{YARDSTICK}_truth": path is not None and contact_check(scene, path).free,
        f"{YARDSTICK}_checks": sampled.checks,
    }
