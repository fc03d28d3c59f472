"""Page `master_slave`: the hull of the master, the search of the slave, both arms together."""

from . import hull, motion, search

__all__ = ["hull", "motion", "search"]
