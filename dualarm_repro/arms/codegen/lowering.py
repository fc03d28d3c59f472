"""Straight-line programs as instructions of LLVM.

As text of Python every statement would be parsed, typed and translated one by one, which takes the
compiler longer than all the rest. The instructions are those that it would make of the text, in the
same order.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic

from .program import Program, Term

#: Squares up to here count as 0: their reciprocals would overflow.
TINY = 1e-290
_NUMBER = ir.DoubleType()


def lowered(program: Program, results: Sequence[Term], given: Sequence[str]) -> Any:
    """``put(values, out, to, stride)``: the e-th result of the program into out[to + e stride].

    Results that are constants are left out.

    Parameters
    ----------
    given
        Names of the inputs, in the order in which ``values`` holds their numbers.
    """

    def put(
        typingctx: Any, values: Any, out: Any, to: Any, stride: Any
    ) -> tuple[Any, Callable[..., None]]:
        signature = types.void(values, out, types.int64, types.int64)

        def codegen(context: Any, builder: Any, sig: Any, arguments: Any) -> None:
            inputs, matrix, first, step = arguments
            numbers = cgutils.unpack_tuple(builder, inputs, len(given))
            known = dict(zip(given, numbers, strict=True))
            for name, (operation, operands) in program.needed(results).items():
                read = [_read(builder, known, operand) for operand in operands]
                known[name] = _INSTRUCTIONS[operation](builder, *read)
            data = context.make_array(sig.args[1])(context, builder, matrix).data
            for e, term in enumerate(results):
                if term.name:
                    place = builder.add(first, builder.mul(step, step.type(e)))
                    value = _read(builder, known, term.text)
                    builder.store(value, builder.gep(data, [place]))

        return signature, codegen

    return intrinsic(put)


def _read(builder: ir.IRBuilder, known: dict[str, ir.Value], text: str) -> ir.Value:
    """The value of a name, of a number, or of minus one of them."""
    if text.startswith("-"):
        return builder.fneg(_read(builder, known, text[1:]))
    return known[text] if text in known else _NUMBER(float(text))


def _of_llvm(name: str) -> Callable[..., ir.Value]:
    def made(builder: ir.IRBuilder, x: ir.Value) -> ir.Value:
        return builder.call(builder.module.declare_intrinsic(name, [_NUMBER]), [x])

    return made


def _reciprocal(builder: ir.IRBuilder, x: ir.Value) -> ir.Value:
    large = builder.fcmp_ordered(">", x, _NUMBER(TINY))
    return builder.select(large, builder.fdiv(_NUMBER(1.0), x), _NUMBER(0.0))


#: By operation of a program: builder and operands -> value.
_INSTRUCTIONS: dict[str, Callable[..., ir.Value]] = {
    "*": ir.IRBuilder.fmul,
    "+": ir.IRBuilder.fadd,
    "-": ir.IRBuilder.fsub,
    "abs": _of_llvm("llvm.fabs"),
    "sqrt": _of_llvm("llvm.sqrt"),
    "reciprocal": _reciprocal,
}
