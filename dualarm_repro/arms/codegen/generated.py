"""A quantity of a chain as generated code: its source, its machine code, its values."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache, cached_property
from hashlib import sha256
from typing import Any

import numpy as np

from ...kernel import COMPILES, kernel
from ..trigonometry import FAR, sincos
from . import recursions
from .lowering import TINY, lowered
from .program import Program, Term, Vector
from .simd import STORES, STREAMS, WIDTH, written
from .source import block_function, inputs_of, plain_function
from .structure import Structure

#: Numbers from which on a matrix of results goes past the cache, in which it would not stay.
LARGE = 2**20
Carried = tuple[tuple[int, Vector], ...]
#: Function of flat configurations, constants and a matrix that takes the results.
Compiled = Callable[[np.ndarray, np.ndarray, np.ndarray], bool]


class Generated:
    """The code of one quantity for all chains of one structure.

    Attributes
    ----------
    source : str
        The plain function (s, c, d, k), see :func:`.source.plain_function`.
    size : int
        Number of results of a configuration.
    """

    def __init__(
        self, name: str, structure: Structure, program: Program, results: Sequence[Term]
    ) -> None:
        self._program, self._results, self._structure = program, results, structure
        self.name, self.size = name, len(results)
        self.source = plain_function(name, program, results, structure)

    @cached_property
    def plain(self) -> Callable[..., tuple[Any, ...]]:
        """The plain function, for arrays of numpy."""
        scope = {"sqrt": np.sqrt, "reciprocal": _reciprocals}
        return self.function(scope)

    def function(self, scope: dict[str, Any]) -> Callable[..., tuple[Any, ...]]:
        """The plain function for other numbers, with ``sqrt`` and ``reciprocal`` of their kind."""
        names = dict(scope)
        exec(compile(self.source, f"<generated {self.name}>", "exec"), names)
        made: Callable[..., tuple[Any, ...]] = names[self.name]
        return made

    @cached_property
    def compiled(self) -> Compiled:
        """The loop over configurations, see :func:`.source.block_function`.

        Its name holds the digest of its text and of the program, under which its machine code is
        kept. Where numba is switched off it is a function that does nothing and says so.
        """
        return self._loop(past_the_cache=False)

    @cached_property
    def streamed(self) -> Compiled:
        """The same for a large matrix, which is written past the cache."""
        return self._loop(past_the_cache=True)

    def _loop(self, past_the_cache: bool) -> Compiled:
        if not COMPILES:
            return nothing
        parts = self._program, self._results, self._structure
        text = block_function("block", *parts, past_the_cache)
        name = f"{self.name}_{sha256((self.source + text).encode()).hexdigest()[:16]}"
        text = text.replace("def block(", f"def {name}(", 1)
        put = lowered(self._program, self._results, inputs_of(*parts))
        scope = {**_COMPILED, "put": put}
        exec(compile(text, f"<generated {name}>", "exec"), scope)
        made: Compiled = kernel(scope[name])
        return made

    def rows(self, q: np.ndarray, constants: np.ndarray, shape: tuple[int, ...]) -> np.ndarray:
        """Values of one shape each for finite q (N, n), as (N, ...).

        Angles so far from 0 that the fast sine is not exact go through the plain function.
        """
        large = self.size % WIDTH == 0 and len(q) * self.size >= LARGE
        out = _from_a_line_on(len(q) * self.size) if large else np.empty(len(q) * self.size)
        loop = self.streamed if large else self.compiled
        flat = np.ascontiguousarray(q).reshape(-1)
        if not flat.flags.writeable:  # the compiler has another type for these
            flat = flat.copy()
        if not loop(flat, constants, out.reshape(-1, shape[-1])):
            far = np.ones(len(q), dtype=bool)
            if COMPILES:
                far = ~(np.abs(q) <= FAR).all(axis=1)
            out.reshape(len(q), self.size)[far] = self.by_numpy(q[far], constants)
        return out.reshape(len(q), *shape)

    def by_numpy(self, q: np.ndarray, constants: np.ndarray) -> np.ndarray:
        """Values (N, size) for q (N, n) by the plain function."""
        columns = q.T
        out = np.empty((len(q), self.size))
        found = self.plain(np.sin(columns), np.cos(columns), columns, constants)
        for e, values in enumerate(found):
            out[:, e] = values
        return out


@cache
def generated(quantity: str, structure: Structure, carried: Carried = ()) -> Generated:
    """The code of a quantity, a name of a function of :mod:`.recursions`."""
    program = Program()
    derive = getattr(recursions, quantity)
    results = derive(program, structure, carried) if carried else derive(program, structure)
    return Generated(quantity, structure, program, results)


def nothing(q: np.ndarray, constants: np.ndarray, out: np.ndarray) -> bool:
    """Compiled code that there is not: it has done nothing, and says so."""
    return False


def _from_a_line_on(size: int) -> np.ndarray:
    """Room for so many numbers that begins with a line of the cache."""
    room = np.empty(size + WIDTH)
    before = -(room.ctypes.data // room.itemsize) % WIDTH
    return room[before : before + size]


def _reciprocals(x: np.ndarray) -> np.ndarray:
    return np.divide(1.0, x, out=np.zeros_like(x), where=x > TINY)


#: What the compiled loops refer to.
_COMPILED: dict[str, Any] = {
    "__name__": __name__,
    "FAR": FAR,
    "np": np,
    "sincos": sincos,
    "written": written,
    **{f"store_{size}": store for size, store in STORES.items()},
    **{f"stream_{size}": store for size, store in STREAMS.items()},
}
