"""Page on Table 2: trapped runs, superiority, and what else is said of the method."""

from . import statements, superiority, table

__all__ = ["statements", "superiority", "table"]
