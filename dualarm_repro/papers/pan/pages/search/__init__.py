"""Page `pan/search`: the genetic algorithm and its runs."""

from . import algorithm, runs

__all__ = ["algorithm", "runs"]
