"""Sphinx extension: functions compiled by numba are documented as the functions they come from."""

from __future__ import annotations

from typing import Any

from numba.core.dispatcher import Dispatcher
from sphinx.application import Sphinx
from sphinx.ext.autodoc import FunctionDocumenter


class KernelDocumenter(FunctionDocumenter):
    """A compiled function, which autodoc would take for data: signature and text of ``py_func``."""

    objtype = "kernel"
    directivetype = "function"
    priority = 20

    @classmethod
    def can_document_member(cls, member: Any, membername: str, isattr: bool, parent: Any) -> bool:
        return isinstance(member, Dispatcher)

    def import_object(self, raiseerror: bool = False) -> bool:
        found = super().import_object(raiseerror)
        if found:
            self.object = self.object.py_func
        return found


def setup(app: Sphinx) -> dict[str, Any]:
    """Entry point of Sphinx."""
    app.add_autodocumenter(KernelDocumenter)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
