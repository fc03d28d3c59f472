"""Copies within compiled functions: an assignment to a slice is compiled with the text of its
error, for seconds."""

from __future__ import annotations

from .kernel import inlined


@inlined
def copy_row(values, out):
    """Numbers (n,) into ``out``."""
    for j in range(len(out)):
        out[j] = values[j]


@inlined
def copy_rows(values, out):
    """Numbers (m, n) into ``out``."""
    for i in range(out.shape[0]):
        for j in range(out.shape[1]):
            out[i, j] = values[i, j]
