"""Sine, cosine and arctangent without branches, so that loops over them become SIMD code.

Polynomials of S. L. Moshier, Methods and Programs for Mathematical Functions, 1989. Where a
product and a sum are rounded once, this is written out, so the same input gives the same bits on
every CPU (one without such an instruction is slower). Quadrants are told by the last bits of a
number, and signs are changed in its first.
"""

from __future__ import annotations

import math
from typing import Any

from llvmlite import ir
from numba import types
from numba.extending import intrinsic

from ..kernel import kernel

# pi/2 in a part of 33 bits and the rest: k times the part is exact for |k| < 2^20
# (W. J. Cody and W. Waite, Software Manual for the Elementary Functions, 1980).
_PART = 1.57079632673412561417
_REST = 6.07710050650619224932e-11
_ROUND = 6755399441055744.0  # 1.5 * 2^52: adding and subtracting it rounds to the nearest integer
FAR = 1.6e6  #: [rad] from where on k times the part is not exact


def _as_integer(context: Any, x: Any) -> Any:
    return types.int64(types.float64), lambda _, builder, __, parts: builder.bitcast(
        parts[0], ir.IntType(64)
    )


def _as_float(context: Any, bits: Any) -> Any:
    return types.float64(types.int64), lambda _, builder, __, parts: builder.bitcast(
        parts[0], ir.DoubleType()
    )


def _rounded_once(context: Any, a: Any, b: Any, c: Any) -> Any:
    return types.float64(a, b, c), lambda _, builder, __, parts: builder.fma(*parts)


#: The bits of a float64 as an integer, the float64 of bits, and a b + c rounded once.
_bits: Any = intrinsic(_as_integer)
_number: Any = intrinsic(_as_float)
_fma: Any = intrinsic(_rounded_once)


@kernel
def sincos(x):
    """sin x and cos x [x in rad] to 1.2e-16 for |x| < FAR."""
    shifted = _fma(x, 0.6366197723675814, _ROUND)
    k = shifted - _ROUND
    r = _fma(-k, _REST, _fma(-k, _PART, x))
    t = r * r
    s = _fma(1.58962301576546568060e-10, t, -2.50507477628578072866e-8)
    s = _fma(_fma(s, t, 2.75573136213857245213e-6), t, -1.98412698295895385996e-4)
    s = _fma(_fma(s, t, 8.33333333332211858878e-3), t, -1.66666666666666307295e-1)
    s = _fma(s * t, r, r)
    c = _fma(-1.13585365213876817300e-11, t, 2.08757008419747316778e-9)
    c = _fma(_fma(c, t, -2.75573141792967388112e-7), t, 2.48015872888517045348e-5)
    c = _fma(_fma(c, t, -1.38888888888730564116e-3), t, 4.16666666666665929218e-2)
    c = _fma(_fma(c, t, -0.5), t, 1.0)
    quadrant = _bits(shifted)
    odd = (quadrant & 1) != 0
    sine = c if odd else s
    cosine = s if odd else c
    sine = _number(_bits(sine) ^ ((quadrant & 2) << 62))
    cosine = _number(_bits(cosine) ^ (((quadrant + 1) & 2) << 62))
    return sine, cosine


@kernel
def arctan2(y, x):
    """Angle of (x, y) in (-pi, pi], to 4.5e-16; a negative zero counts as zero, never as -pi."""
    u, v = abs(x), abs(y)
    small, large = min(u, v), max(u, v)
    far = small > 0.66 * large
    numerator = small - large if far else small
    denominator = small + large if far else large
    t = numerator / (denominator if denominator > 0.0 else 1.0)
    z = t * t
    p = -8.750608600031904122785e-1 * z - 1.615753718733365076637e1
    p = (p * z - 7.500855792314704667340e1) * z - 1.228866684490136173410e2
    p = p * z - 6.485021904942025371773e1
    q = (z + 2.485846490142306297962e1) * z + 1.650270098316988542046e2
    q = (q * z + 4.328810604912902668951e2) * z + 4.853903996359136964868e2
    q = q * z + 1.945506571482613964425e2
    angle = t * z * p / q + t
    angle = angle + 0.25 * math.pi if far else angle
    angle = 0.5 * math.pi - angle if v > u else angle
    angle = math.pi - angle if x < 0.0 else angle
    return -angle if y < 0.0 else angle
