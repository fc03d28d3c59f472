"""Page `two_sided`: the search from both ends, its splice and its step."""

from . import halves, rules

__all__ = ["halves", "rules"]
