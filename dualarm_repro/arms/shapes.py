"""What the links of an arm are made of."""

from __future__ import annotations

from enum import StrEnum


class Shapes(StrEnum):
    """What the links of an arm are made of when distances are computed.

    ``fitted``: several capsules around each collision shape, and pairs left out by evidence;
    ``enclosing``: one capsule around each; ``visual``: as ``fitted``, around the visual shapes;
    ``none``: nothing, for kinematics alone.
    """

    FITTED = "fitted"
    ENCLOSING = "enclosing"
    VISUAL = "visual"
    NONE = "none"
