"""The ledger of printed items and their verdicts. It knows no robot: usable for any paper."""

from .evaluation import Evaluation, evaluate, prove
from .record import record
from .registry import REGISTRY, Registry
from .result import Assumed, Proof, Result
from .robustness import Robustness, robustness
from .rules import Adopts, Bounded, Is, NeedsPrinted, Role, Rounds, Rule
from .study import Study
from .verdict import MEANING, Verdict

__all__ = [
    "MEANING",
    "REGISTRY",
    "Adopts",
    "Assumed",
    "Bounded",
    "Evaluation",
    "Is",
    "NeedsPrinted",
    "Proof",
    "Registry",
    "Result",
    "Robustness",
    "Role",
    "Rounds",
    "Rule",
    "Study",
    "Verdict",
    "evaluate",
    "prove",
    "record",
    "robustness",
]
