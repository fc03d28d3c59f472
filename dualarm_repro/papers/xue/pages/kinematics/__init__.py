"""Page on the kinematics: Table 1 and equations (1)-(8), Figures 1-3, wrist and mirror image."""

from . import arms, chain

__all__ = ["arms", "chain"]
