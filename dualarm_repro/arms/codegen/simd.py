"""Transposing stores: from one row per entry to one row per configuration, by shuffles.

No arithmetic happens here, and every target of the compiler has instructions for it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from llvmlite import ir
from numba import types
from numba.extending import intrinsic

WIDTH = 8  #: configurations that are stored together
_DOUBLE, _INTEGER = ir.DoubleType(), ir.IntType(32)


def _storing(entries: int, past_the_cache: bool) -> Any:
    """The intrinsic for so many entries, a power of 2 up to ``WIDTH``."""

    def store(
        typingctx: Any, w: Any, at: Any, stride: Any, out: Any, to: Any, step: Any
    ) -> tuple[Any, Callable[..., None]]:
        signature = types.void(w, types.int64, types.int64, out, types.int64, types.int64)

        def codegen(context: Any, builder: Any, sig: Any, arguments: Any) -> None:
            first, last = (
                context.make_array(sig.args[k])(context, builder, arguments[k]).data for k in (0, 3)
            )
            _, at, stride, _, to, step = arguments
            rows = []
            for k in range(entries):
                place = builder.add(at, builder.mul(stride, stride.type(k)))
                rows.append(builder.load(_vector_at(builder, first, place, WIDTH), align=8))
            for one, vector in enumerate(_by_configuration(builder, rows)):
                place = builder.add(to, builder.mul(step, step.type(one)))
                target = _vector_at(builder, last, place, entries)
                if past_the_cache:
                    stored = builder.store(vector, target, align=8 * entries)
                    stored.set_metadata("nontemporal", builder.module.add_metadata([_INTEGER(1)]))
                else:
                    builder.store(vector, target, align=8)

        return signature, codegen

    store.__name__ = f"store_{entries}"
    return intrinsic(store)


def _by_configuration(builder: ir.IRBuilder, rows: list[ir.Value]) -> list[ir.Value]:
    """The columns of a matrix of ``WIDTH`` columns that is given by its rows.

    Rows i and i + half are interleaved until the entries of a column lie side by side.
    """
    half = len(rows) // 2
    low, high = range(WIDTH // 2), range(WIDTH // 2, WIDTH)
    for _ in range(half.bit_length()):
        pairs = list(zip(rows[:half], rows[half:], strict=True))
        rows = [
            _shuffled(builder, a, b, [i for lane in part for i in (lane, WIDTH + lane)])
            for a, b in pairs
            for part in (low, high)
        ]
    if len(rows) == WIDTH:
        return rows
    width = len(rows)
    return [
        _shuffled(builder, row, row, range(start, start + width))
        for row in rows
        for start in range(0, WIDTH, width)
    ]


def _shuffled(builder: ir.IRBuilder, a: ir.Value, b: ir.Value, places: Sequence[int]) -> ir.Value:
    mask = ir.Constant(ir.VectorType(_INTEGER, len(places)), [_INTEGER(i) for i in places])
    return builder.shuffle_vector(a, b, mask)


def _vector_at(builder: ir.IRBuilder, data: ir.Value, place: ir.Value, width: int) -> ir.Value:
    pointer = builder.gep(data, [place])
    return builder.bitcast(pointer, ir.VectorType(_DOUBLE, width).as_pointer())


def _fence(typingctx: Any) -> tuple[Any, Callable[..., None]]:
    def codegen(context: Any, builder: Any, sig: Any, arguments: Any) -> None:
        builder.fence("seq_cst")

    return types.void(), codegen


#: Of a number of entries k: ``store(w, at, stride, out, to, step)`` copies w[at + e stride + i] to
#: out[to + i step + e] for e < k and i < WIDTH.
STORES = {entries: _storing(entries, False) for entries in (8, 4, 2, 1)}
#: The same past the cache, for the entries of a whole line at its beginning: what is too large to
#: stay in the cache is not read before it is written.
STREAMS = {WIDTH: _storing(WIDTH, True)}
#: ``written()``: from here on other threads see what went past the cache.
written: Any = intrinsic(_fence)
