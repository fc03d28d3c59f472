"""What is shown on the pages of `patent`, one module or folder for each page of the book."""

from . import avoidance, contest, network, problem

__all__ = ["avoidance", "contest", "network", "problem"]
