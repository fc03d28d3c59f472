"""How the kernels of this room are compiled: once, kept on disk, IEEE division."""

from __future__ import annotations

from numba import njit

# error_model="numpy": a division by zero gives infinity, without a branch in every kernel.
kernel = njit(cache=True, error_model="numpy")
