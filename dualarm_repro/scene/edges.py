"""Which straight joint edges of a scene are free of contact, certified, in one compiled call."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import numpy as np
from numpy.typing import ArrayLike

from ..arguments import checked
from ..arms.angle import LARGEST
from ..errors import ConfigurationError, InputError
from .edge_batches import edges_free
from .edge_model import edge_model
from .scene import Scene

#: Edges from which on a thread is worth its start.
_FEW = 64


@checked
def free_edges(
    scene: Scene, starts: ArrayLike, ends: ArrayLike, margin: float = 0.0, jobs: int = 1
) -> np.ndarray:
    """Whether d_k(q) > ``margin`` for every watched pair k and every q on each edge, (E,) of bool.

    True is a proof: between the configurations that are looked at no pair can come nearer (see
    :mod:`.edge_batches`). Capsules of one arm are compared as they are, without the hulls within
    them (:mod:`.hull_pairs`), so that an edge can be free although the answer is False, never the
    other way round; so too where a pair keeps the margin by less than 0.02 mm.

    Parameters
    ----------
    starts, ends : (E, nq)
        Ends of the edges [rad, m].
    margin : float
        Distance to keep, not negative [m].
    jobs : int
        Threads; the answer is the same for any number.

    Raises
    ------
    ConfigurationError, InputError
        Ends of the wrong shape, with NaN or infinity, or angles of which nothing is left but whole
        turns; a margin or number of threads out of range; a body that moves by itself.
    """
    first, last = (np.atleast_2d(scene.configurations(end)) for end in (starts, ends))
    if first.shape != last.shape:
        expected = f"as many as starts: {first.shape}"
        raise ConfigurationError("free_edges", "ends", last.shape, expected)
    if not 0.0 <= margin < np.inf:
        raise InputError("free_edges", "margin", margin, "a finite number that is not negative")
    if jobs < 1:
        raise InputError("free_edges", "jobs", jobs, "at least one thread")
    model = edge_model(scene)
    widest = np.where(model.slides, np.abs(scene.limits).max(axis=0), np.inf)
    if (np.abs([first, last]) > widest).any():
        expected = "joints that slide within their limits"
        raise ConfigurationError("free_edges", "edges", "a slide beyond them", expected)
    if (np.abs([first, last]) > np.where(model.slides, np.inf, LARGEST)).any():
        expected = f"angles of at most {LARGEST:g} rad"
        raise ConfigurationError("free_edges", "edges", "a larger one", expected)
    free, looked = np.empty(len(first), dtype=np.bool_), np.empty(len(first), dtype=np.int64)

    def run(rows: slice) -> None:
        edges_free(model, first[rows], last[rows], float(margin), free[rows], looked[rows])

    threads = min(jobs, -(-len(first) // _FEW))
    if threads <= 1:
        run(slice(None))
        return free
    bounds = np.linspace(0, len(first), 4 * threads + 1).astype(int)
    with ThreadPoolExecutor(threads) as pool:
        list(pool.map(run, map(slice, bounds[:-1], bounds[1:])))
    return free
