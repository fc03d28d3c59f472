"""How a joint of an arm moves."""

from __future__ import annotations

from enum import StrEnum


class JointType(StrEnum):
    """About its axis between limits [rad], about it for ever [rad], or along it [m]."""

    REVOLUTE = "revolute"
    CONTINUOUS = "continuous"
    PRISMATIC = "prismatic"
