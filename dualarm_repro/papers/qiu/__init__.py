"""Document `qiu`: search from both ends for two IRB 120 among spheres."""

from . import (
    dual_motion,
    errata,
    field,
    gain_and_step,
    hull_model,
    improvements,
    kinematics,
    master_slave,
    one_sided,
    search_rules,
    settings_printed,
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
    "improvements",
    "kinematics",
    "master_slave",
    "one_sided",
    "search_rules",
    "settings_printed",
    "studies",
    "success",
    "task",
    "two_sided",
]
