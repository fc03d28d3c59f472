"""The checkers and figures of `qiu`, by the page of the book that shows them."""

from . import field, geometry, master_slave, one_sided, success, two_sided

__all__ = ["field", "geometry", "master_slave", "one_sided", "success", "two_sided"]
