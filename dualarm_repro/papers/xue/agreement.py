"""What equations (9)-(16) are judged by: print against the potential that is descended."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np

from ...ledger import REGISTRY, Residual, Result
from ...planning.field.potentials import Potential
from .sample_problem import worst_gradient

checks = partial(REGISTRY.checks, page="xue/potentials")

VALUE = partial(
    Residual, key="value", high=1e-9, label="largest difference of the field run to print"
)
GRADIENT = partial(
    Residual,
    key="gradient",
    high=1e-6,
    label="relative error of its gradient by central differences",
)
#: Configurations at which gradients are compared.
_GRADIENTS = 60


def choices(name: str) -> list[Any]:
    """The readings that are declared for an assumption."""
    return list(REGISTRY.declared(f"xue.{name}", "choices").choices)


def difference(printed: np.ndarray, run: np.ndarray) -> float:
    """Largest difference; NaN counts, so that what cannot be evaluated agrees with nothing."""
    return float(abs(printed - run).max())


def agreement(
    name: str,
    printed: np.ndarray,
    potential: Potential,
    q: np.ndarray,
    further: dict[str, Any] | None = None,
) -> Result:
    """The printed formula against the potential that is descended, and its gradient."""
    found = difference(printed, potential.value(q))
    error = worst_gradient(potential, q[:_GRADIENTS])
    return Result(
        obtained={"value": found, "gradient": error, **(further or {})},
        caption=(
            f"{name} evaluated as printed at {len(q)} configurations differs from the potential "
            f"that is descended by at most {found:.0e}, its joint gradient from central "
            f"differences by {error:.0e}."
        ),
    )


def worst(results: dict[str, Result], name: str) -> Result:
    """Several readings as one result: the largest difference and gradient error of all."""
    found = {
        key: float(np.max([result.obtained[key] for result in results.values()]))
        for key in ("value", "gradient")
    }
    return Result(
        obtained={**found, "by_reading": {key: r.obtained for key, r in results.items()}},
        caption=(
            f"{name}, evaluated as printed, differs from the potential that is descended by at "
            f"most {found['value']:.0e} whichever of the readings {', '.join(results)} is taken; "
            f"the joint gradient differs from central differences by {found['gradient']:.0e}."
        ),
    )
