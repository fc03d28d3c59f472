"""Instructions of a straight-line program give the bits that its text gives."""

import math

import numba
import numpy as np
import pytest

from dualarm_repro.arms.codegen.lowering import TINY, lowered
from dualarm_repro.arms.codegen.program import ONE, ZERO, Program, Term
from dualarm_repro.kernel import COMPILES

X, Y = Term(1, "x"), Term(1, "y")


def every_operation(program):
    """Results of all operations, of both signs, with constants among them."""
    product = program.times(X, Y)
    two = program.plus(ONE, ONE)
    square = program.inner((X, Y), (X, Y))
    return [
        product,
        -product,
        ZERO,
        program.plus(X, -Y),
        program.plus(-X, -Y),
        program.plus(program.times(X, product), two),
        -ONE,
        program.function("abs", -Y),
        program.function("sqrt", square),
        program.function("reciprocal", square),
        -program.function("reciprocal", -square),
    ]


@pytest.mark.skipif(not COMPILES, reason="numba is switched off")
@pytest.mark.parametrize(
    "given", [(0.3, -0.7), (1 / 3, 1e-17), (0.0, -0.0), (1e-150, 0.0), (1e200, 3.0)]
)
def test_the_bits_of_the_text(given):
    program = Program()
    results = every_operation(program)
    put = lowered(program, results, ["x", "y"])

    @numba.njit
    def run(x, y, out):
        put((x, y), out, 1, 2)

    out = np.full(2 * len(results) + 1, 7.0)
    run(*given, out)
    lines, texts = program.lines(results)
    scope = {
        "x": given[0],
        "y": given[1],
        "sqrt": math.sqrt,
        "reciprocal": lambda x: 1.0 / x if x > TINY else 0.0,
    }
    exec("\n".join(lines), scope)
    expected = np.full(len(out), 7.0)
    for e, (term, text) in enumerate(zip(results, texts, strict=True)):
        if term.name:
            expected[1 + 2 * e] = eval(text, scope)
    assert out.tobytes() == expected.tobytes()
