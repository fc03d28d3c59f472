"""Straight-line programs as source of Python: a plain function, and a loop over configurations.

The plain function takes numbers, arrays or symbols. The loop is for the compiler, which is given
the program as instructions (:mod:`.lowering`): configurations are taken in blocks of ``LANES``, and
all that a block reads and writes lies in one buffer at constant places, so that the compiler sees
no aliasing and turns the inner loops into SIMD code.
"""

from __future__ import annotations

from collections.abc import Sequence

from .program import Program, Term
from .simd import STORES, WIDTH
from .structure import Structure

LANES = 16


def plain_function(name: str, program: Program, results: Sequence[Term], chain: Structure) -> str:
    """Source of ``name(s, c, d, k)``, which gives the results as a tuple.

    ``s``, ``c`` and ``d`` hold an entry for each joint: sine, cosine and displacement, of which a
    joint has the first two or the third; ``k`` the constants.
    """
    used = program.names(results)
    turning, sliding = _joints(used, chain)
    lines, values = program.lines(results)
    reads = [f"s{j + 1}, c{j + 1} = s[{j}], c[{j}]" for j in turning]
    reads += [f"d{j + 1} = d[{j}]" for j in sliding]
    reads += [f"k{i} = k[{i}]" for i in _constants(used)]
    body = "\n    ".join([*reads, *lines, f"return ({', '.join(values)},)"])
    return f"def {name}(s, c, d, k):\n    {body}\n"


def block_function(
    name: str,
    program: Program,
    results: Sequence[Term],
    chain: Structure,
    past_the_cache: bool = False,
) -> str:
    """Source of ``name(q, k, matrix)`` for flat q (N n), constants k and results in a matrix of N m
    entries.

    It returns whether the sizes fit and all of q is so near to 0, and finite, that the results can
    be taken. With ``past_the_cache`` the matrix, which has to begin a line of the cache and to have
    a whole number of them for each configuration, is written without being read into the cache.
    """
    n, m = chain.joints, len(results)
    used = program.names(results)
    turning, sliding = _joints(used, chain)
    # Places in the buffer: n joint values, then what is written.
    written = [(n + e) * LANES for e in range(m)]
    inputs = ", ".join(inputs_of(program, results, chain))
    constant = [(e, term.text) for e, term in enumerate(results) if not term.name]
    text = [
        f"def {name}(q, k, matrix):",
        "    out = matrix.reshape(-1)",
        f"    if q.size % {n} or q.size * {m} != out.size * {n}:",
        "        return False",
    ]
    text += [f"    k{i} = k[{i}]" for i in _constants(used)]
    text += [
        f"    if q.size == {n}:",
        *[f"        d{j + 1} = q[{j}]" for j in sliding],
        *[f"        s{j + 1}, c{j + 1} = sincos(q[{j}])" for j in turning],
        *[f"        put(({inputs},), out, 0, 1)"] * bool(inputs),
        *[f"        out[{e}] = {value}" for e, value in constant],
        f"        return {' and '.join(f'abs(q[{j}]) <= FAR' for j in range(n))}",
    ]
    text += [f"    w = np.zeros({(n + m) * LANES})"]
    text += [f"    for i in range({LANES}):"] if constant else []
    text += [f"        w[{written[e]} + i] = {value}" for e, value in constant]
    text += [
        "    near = True",
        f"    count = q.size // {n}",
        f"    for start in range(0, count, {LANES}):",
        f"        rows = min({LANES}, count - start)",
        f"        at = start * {n}",
        "        for i in range(rows):",
        *[f"            w[{j * LANES} + i] = q[at + {n} * i + {j}]" for j in range(n)],
        f"        for i in range({LANES}):",
        *[f"            near &= abs(w[{j * LANES} + i]) <= FAR" for j in range(n)],
        *[f"            d{j + 1} = w[{j * LANES} + i]" for j in sliding],
        *[f"            s{j + 1}, c{j + 1} = sincos(w[{j * LANES} + i])" for j in turning],
        *[f"            put(({inputs},), w, {n * LANES} + i, {LANES})"] * bool(inputs),
        f"        to = start * {m}",
        f"        if rows == {LANES}:",
        f"            for i in range(0, {LANES}, {WIDTH}):",
    ]
    entry, store = 0, "stream" if past_the_cache else "store"
    for size in STORES:
        while m - entry >= size:
            text.append(
                f"                {store}_{size}(w, {written[entry]} + i, {LANES}, "
                f"out, to + {m} * i + {entry}, {m})"
            )
            entry += size
    text += [
        "        else:",
        "            for i in range(rows):",
        f"                for e in range({m}):",
        f"                    out[to + {m} * i + e] = w[{n * LANES} + e * {LANES} + i]",
        *["    written()"] * past_the_cache,
        "    return near",
    ]
    return "\n".join(text) + "\n"


def inputs_of(program: Program, results: Sequence[Term], chain: Structure) -> list[str]:
    """Names of what a program reads: sines, cosines, displacements and constants."""
    used = program.names(results)
    joints = [f"{letter}{j + 1}" for letter in "scd" for j in range(chain.joints)]
    return [name for name in joints if name in used] + [f"k{i}" for i in _constants(used)]


def _constants(used: set[str]) -> list[int]:
    """Numbers of the constants among the names."""
    return sorted(int(name[1:]) for name in used if name.startswith("k"))


def _joints(used: set[str], chain: Structure) -> tuple[list[int], list[int]]:
    """Joints that turn and joints that slide, counted from 0, whose motion is among the names."""
    turning = [j for j in range(chain.joints) if used & {f"s{j + 1}", f"c{j + 1}"}]
    return turning, [j for j in range(chain.joints) if f"d{j + 1}" in used]
