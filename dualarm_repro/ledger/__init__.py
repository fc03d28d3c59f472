"""The ledger of printed items and their verdicts. It knows no robot: usable for any paper."""

from .evaluation import Evaluation, evaluate, prove
from .meaning import MEANING
from .record import record
from .registry import REGISTRY, Registry
from .result import Assumed, Proof, Result
from .rules import (
    Adopts,
    Bounded,
    Is,
    NoOriginal,
    Residual,
    Role,
    Rounds,
    Rule,
)
from .settled import Settled, settle
from .shares import Share
from .statistical_rules import Exceeds, Generally
from .study import Study
from .verdict import Verdict

__all__ = [
    "MEANING",
    "REGISTRY",
    "Adopts",
    "Assumed",
    "Bounded",
    "Evaluation",
    "Exceeds",
    "Generally",
    "Is",
    "NoOriginal",
    "Proof",
    "Registry",
    "Residual",
    "Result",
    "Role",
    "Rounds",
    "Rule",
    "Settled",
    "Share",
    "Study",
    "Verdict",
    "evaluate",
    "prove",
    "record",
    "settle",
]
