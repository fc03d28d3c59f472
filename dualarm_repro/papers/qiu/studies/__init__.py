"""Stored studies of `qiu`. Their settings were fixed before the first run."""

from . import (
    ablation,
    dual_pairs,
    equilibria,
    fit,
    fit_slave,
    free_pairs,
    improvements,
    models,
    quality,
    random_scenes,
)

__all__ = [
    "ablation",
    "dual_pairs",
    "equilibria",
    "fit",
    "fit_slave",
    "free_pairs",
    "improvements",
    "models",
    "quality",
    "random_scenes",
]
