"""Document `qiu`: search from both ends for two IRB 120 among spheres."""

from . import (
    dual_motion,
    errata,
    field,
    gain_and_step,
    hull_model,
    kinematics,
    master_slave,
    one_sided,
    search_rules,
    studies,
    success,
    task,
    two_sided,
)

__all__ = [
    "dual_motion",
    "errata",
    "field",
    "gain_and_step",
    "hull_model",
    "kinematics",
    "master_slave",
    "one_sided",
    "search_rules",
    "studies",
    "success",
    "task",
    "two_sided",
]
