"""Straight-line programs as source of Python: a plain function, and a loop over configurations.

Both are made of the same lines. The plain function takes numbers, arrays or symbols. The loop is
for the compiler: configurations are taken in blocks of ``LANES``, and all that a block reads and
writes lies in one buffer at constant places, so that the compiler sees no aliasing and turns the
inner loops into SIMD code.
"""

from __future__ import annotations

from collections.abc import Sequence

from .program import Program, Term
from .simd import STORES, WIDTH
from .structure import Structure

LANES = 32


def plain_function(
    name: str, program: Program, results: Sequence[Term], chain: Structure, constants: int
) -> str:
    """Source of ``name(s, c, d, k)``, which gives the results as a tuple.

    ``s``, ``c`` and ``d`` hold an entry for each joint: sine, cosine and displacement, of which a
    joint has the first two or the third; ``k`` the constants.
    """
    lines, values = program.lines(results)
    turning = [j for j, slides in enumerate(chain.slides) if not slides]
    sliding = [j for j, slides in enumerate(chain.slides) if slides]
    reads = [f"s{j + 1}, c{j + 1} = s[{j}], c[{j}]" for j in turning]
    reads += [f"d{j + 1} = d[{j}]" for j in sliding]
    reads += [f"k{i} = k[{i}]" for i in _used(program, results, constants)]
    body = "\n    ".join([*reads, *lines, f"return ({', '.join(values)},)"])
    return f"def {name}(s, c, d, k):\n    {body}\n"


def block_function(
    name: str, program: Program, results: Sequence[Term], chain: Structure, constants: int
) -> str:
    """Source of ``name(q, k, out)`` for flat q (N n), constants k and flat results out (N m).

    It returns the number of the first configuration with an entry that is not finite, -1 if there
    is none.
    """
    n, m = chain.joints, len(results)
    used = {name for _, operands in program.needed(results).values() for name in operands}
    used |= {term.name for term in results}
    turning = [j for j in range(n) if used & {f"s{j + 1}", f"c{j + 1}"}]
    sliding = [j for j in range(n) if f"d{j + 1}" in used]
    # Places in the buffer: n joint values or sines, n cosines, then what is written.
    first = 2 * n
    written = [(first + e) * LANES for e in range(m)]
    lines, values = program.lines(results)
    fixed = [(at, term) for at, term in zip(written, results, strict=True) if not term.name]
    moving = [(at, v) for at, v, term in zip(written, values, results, strict=True) if term.name]
    text = [f"def {name}(q, k, out):"]
    text += [f"    k{i} = k[{i}]" for i in _used(program, results, constants)]
    text += [f"    w = np.zeros({(first + m) * LANES})"]
    text += [f"    w[{at}:{at + LANES}] = {term.text}" for at, term in fixed if term.sign]
    text += [
        f"    count = q.size // {n}",
        f"    for start in range(0, count, {LANES}):",
        f"        rows = min({LANES}, count - start)",
        f"        at = start * {n}",
        "        for i in range(rows):",
        *[f"            w[{j * LANES} + i] = q[at + {n} * i + {j}]" for j in range(n)],
        "        near = True",
        f"        for i in range({n * LANES}):",
        "            near &= abs(w[i]) <= FAR",
        "        if near:",
        *_sines(turning, n, "sincos"),
        "        else:",
        f"            for i in range(rows):",
        f"                for j in range({n}):",
        f"                    if not isfinite(w[j * {LANES} + i]):",
        "                        return start + i",
        *_sines(turning, n, "sincos_anywhere"),
        f"        for i in range({LANES}):",
        *[f"            d{j + 1} = w[{j * LANES} + i]" for j in sliding],
        *[
            f"            s{j + 1}, c{j + 1} = w[{j * LANES} + i], w[{(n + j) * LANES} + i]"
            for j in turning
        ],
        *[f"            {line}" for line in lines],
        *[f"            w[{at} + i] = {value}" for at, value in moving],
        f"        to = start * {m}",
        f"        if rows == {LANES}:",
        f"            for i in range(0, {LANES}, {WIDTH}):",
    ]
    entry = 0
    for size in STORES:
        while m - entry >= size:
            text.append(
                f"                store_{size}(w, {written[entry]} + i, {LANES}, "
                f"out, to + {m} * i + {entry}, {m})"
            )
            entry += size
    text += [
        "        else:",
        "            for i in range(rows):",
        f"                for e in range({m}):",
        f"                    out[to + {m} * i + e] = w[{first * LANES} + e * {LANES} + i]",
        "    return -1",
    ]
    return "\n".join(text) + "\n"


def _sines(joints: Sequence[int], n: int, function: str) -> list[str]:
    if not joints:
        return ["            pass"]
    return [
        f"            for i in range({LANES}):",
        *[
            f"                w[{j * LANES} + i], w[{(n + j) * LANES} + i] = "
            f"{function}(w[{j * LANES} + i])"
            for j in joints
        ],
    ]


def _used(program: Program, results: Sequence[Term], constants: int) -> list[int]:
    """Numbers of the constants that the results depend on."""
    names = {term.name for term in results}
    names.update(*(operands for _, operands in program.needed(results).values()))
    return [i for i in range(constants) if f"k{i}" in names]
