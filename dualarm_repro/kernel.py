"""Functions that are compiled by numba."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from numba import njit, types
from numba.core import config

from .interruption import uninterrupted
from .machine_code import MachineCode, NoMachineCode

_NUMBA: Any = config
#: Whether functions are compiled; NUMBA_DISABLE_JIT leaves them to the interpreter.
COMPILES = not _NUMBA.DISABLE_JIT


def kernel(function: Callable[..., Any]) -> Any:
    """Compile a function with numba; a division by zero gives infinity, without a branch for it.

    It runs without the interpreter's lock, so that threads can share the cores.
    """
    return _compiled(function)


def inlined(function: Callable[..., Any]) -> Any:
    """The same for a function that is part of a loop over lanes, which only becomes SIMD code
    without a call in it."""
    return _compiled(function, forceinline=True)


def _compiled(function: Callable[..., Any], **options: Any) -> Any:
    """For Python, and for other kernels without the wrappers that only Python needs: compiling
    them takes a fifth of the time."""
    if not COMPILES:
        return function
    nested = {"no_cpython_wrapper": True, "no_cfunc_wrapper": True}
    outer = _kept(function, nested=False, **options)
    inner = _kept(function, nested=True, **options, **nested)
    template, overload = outer.get_call_template, outer.get_overload

    def template_for_kernels(arguments: Any, keywords: Any) -> Any:
        # A constant is no type of its own, for which everything were compiled once more.
        arguments = tuple(map(types.unliteral, arguments))
        keywords = {name: types.unliteral(kind) for name, kind in keywords.items()}
        _, kinds = outer._compiler.fold_argument_types(arguments, keywords)
        known = tuple(kinds) in outer.overloads
        return (template if known else inner.get_call_template)(arguments, keywords)

    def overload_for_kernels(signature: Any) -> Any:
        known = tuple(getattr(signature, "args", signature)) in outer.overloads
        return (overload if known else inner.get_overload)(signature)

    outer.get_call_template, outer.get_overload = template_for_kernels, overload_for_kernels
    return outer


def _kept(function: Callable[..., Any], *, nested: bool, **options: Any) -> Any:
    compiled = njit(error_model="numpy", nogil=True, **options)(function)
    try:
        compiled._cache = MachineCode(function, nested)
    except RuntimeError:
        compiled._cache = NoMachineCode()
    compile_one = compiled.compile

    def compile_undisturbed(signature: Any) -> Any:
        with uninterrupted():  # an exception in a callback of LLVM is lost, and so is the function
            return compile_one(signature)

    compiled.compile = compile_undisturbed
    return compiled
