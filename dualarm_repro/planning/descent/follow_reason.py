"""Why an arm that is made to follow a point had to stop."""

from __future__ import annotations

from enum import StrEnum

from .termination import StopReason


class FollowReason(StrEnum):
    """Why a plan ended that no :class:`.termination.StopReason` ended.

    ``NO_POSTURE``: none continues the motion to the next point. ``COLLIDES``: those that do touch
    an obstacle.
    """

    NO_POSTURE = "no-posture"
    COLLIDES = "collides"


#: All reasons, in the order of their codes.
REASONS: tuple[StopReason | FollowReason, ...] = (*StopReason, *FollowReason)
