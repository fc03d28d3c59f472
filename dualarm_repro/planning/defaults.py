"""Settings that suit the size of an arm, for a scene that brings none."""

from __future__ import annotations

import numpy as np

from ..arms import Arm
from .search.bidirectional_arms import TwoArmSettings
from .settings import APFSettings, Attraction, Repulsion, Termination, Trap, Update


def default_settings(arm: Arm) -> APFSettings:
    """Settings that scale with the reach of an arm: no number is taken from any publication."""
    reach = _reach(arm)
    influence, weight = 0.1 * reach, 0.25 * reach**2
    return APFSettings(
        attraction=Attraction(gain=1.0, joint_weight=weight),
        control_points=tuple(range(2, arm.nq + 2)),
        repulsion=Repulsion(gain=(0.1 * reach * influence) ** 2, influence=influence),
        update=Update(rule="gradient", gain=0.5 / (reach**2 + weight), max_step=0.02),
        termination=Termination(
            joint_tolerance=0.01,
            position_tolerance=0.005 * reach,
            step_limit=5000,
            trap=Trap(rule="block_means", steps=50, threshold=1e-3),
        ),
        enforce_limits=True,
    )


def default_two_arm_settings(arm: Arm) -> TwoArmSettings:
    """Settings that scale with the reach of an arm: no number is taken from any publication.

    The repulsion at half its range, with the reach as lever, equals the largest attraction.
    """
    reach = _reach(arm)
    influence, threshold = 0.2 * reach, 0.5
    return TwoArmSettings(
        attraction={"gain": 1.0, "threshold": threshold},
        repulsion={"gain": threshold * influence**3 / (4.0 * reach), "influence": influence},
        control_points=tuple(range(3, arm.nq + 2)),
        variable_gain={"rule": "power", "band": 0.1 * influence},
        step={"length": 0.05, "rule": "saturating"},
        ending={"tolerance": 0.06, "search_limit": 500, "stuck_searches": 60},
        enforce_limits=True,
    )


def _reach(arm: Arm) -> float:
    """Length of the stretched chain, with every prismatic joint out to its farther limit [m]."""
    slides, steps = arm.slides, np.linalg.norm(arm.motion.translation[1:], axis=1).sum()
    far = np.maximum(np.abs(arm.lower[slides]), np.abs(arm.upper[slides])).sum()
    return float(steps + far)
