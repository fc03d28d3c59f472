"""Stored studies of `qiu`. Their settings were fixed before the first run."""

from . import (
    ablation,
    dual_pairs,
    fit,
    improvements,
    models,
    quality,
    random_scenes,
)

__all__ = [
    "ablation",
    "dual_pairs",
    "fit",
    "improvements",
    "models",
    "quality",
    "random_scenes",
]
