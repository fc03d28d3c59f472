"""The arena: every planner on the same scenes, judged by the certified distance of whole links."""

from .cases import KINDS, Case, case_of, cells
from .judged import Outcome, judged_row
from .study import ARENA

__all__ = ["ARENA", "KINDS", "Case", "Outcome", "case_of", "cells", "judged_row"]
