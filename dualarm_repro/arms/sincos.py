"""Sine and cosine without branches, so that a loop over them becomes SIMD code."""

from __future__ import annotations

import numpy as np
from numba import njit

# pi/2 in three parts of 33 bits and a rest: k times a part is exact for |k| < 2^20
# (W. J. Cody and W. Waite, Software Manual for the Elementary Functions, 1980).
_P1 = 1.57079632673412561417
_P2 = 6.07710050630396597660e-11
_P3 = 2.02226624871116645580e-21
_P4 = 8.47842766036889956997e-32
_ROUND = 6755399441055744.0  # 1.5 * 2^52: adding and subtracting it rounds to the nearest integer


@njit(cache=True)
def sincos(x):
    """sin x and cos x [x in rad, |x| < 1.6e6] to 2.3e-16, by polynomials on [-pi/4, pi/4].

    Beyond that range the error grows like the rounding of ``x`` itself. The coefficients are the
    minimax ones of S. L. Moshier, Methods and Programs for Mathematical Functions, 1989.
    """
    k = (x * 0.6366197723675814 + _ROUND) - _ROUND
    r = ((x - k * _P1) - k * _P2) - k * _P3 - k * _P4
    t = r * r
    s = 1.58962301576546568060e-10 * t - 2.50507477628578072866e-8
    s = (s * t + 2.75573136213857245213e-6) * t - 1.98412698295895385996e-4
    s = (s * t + 8.33333333332211858878e-3) * t - 1.66666666666666307295e-1
    s = s * t * r + r
    c = 2.08757008419747316778e-9 - 1.13585365213876817300e-11 * t
    c = (c * t - 2.75573141792967388112e-7) * t + 2.48015872888517045348e-5
    c = (c * t - 1.38888888888730564116e-3) * t + 4.16666666666665929218e-2
    c = c * t * t - 0.5 * t + 1.0
    quadrant = k - 4.0 * np.floor(0.25 * k)
    odd = (quadrant == 1.0) | (quadrant == 3.0)
    sine = c if odd else s
    cosine = s if odd else c
    sine = -sine if quadrant >= 2.0 else sine
    cosine = -cosine if (quadrant == 1.0) | (quadrant == 2.0) else cosine
    return sine, cosine
