"""With and without avoidance: one task twice, promises on frozen and on random tasks, effort."""

from . import figure_2, frozen_tasks, random_tasks

__all__ = ["figure_2", "frozen_tasks", "random_tasks"]
