"""A master on its path as a moving obstacle of a slave that is searched from both ends.

While the slave searches, its forward half sees the master go from its start to its middle and its
backward half from its end to its middle, over ``spread`` searches; then both see the middle. Read
along the slave's path this is a time map: the share of the master's path at every sample. Executing
the arms by any other map is another motion, which nobody has planned.
"""

from __future__ import annotations

import numpy as np

from ...errors import InputError
from ...scene.bodies import PlacedArm
from ...scene.moving import JointPath
from ..field.hull_obstacle import NO_HULL, HullTrack, JointCircles, circles_on, hull_track
from .search_plan import SearchPlan


def shares(searches: int, spread: int, end: float = 0.5) -> np.ndarray:
    """Share of the master's path that the forward half sees, (searches + 1,), from 0 to at most
    ``end``, 1/(2 spread) a search; a search from one side only sees all of it, ``end`` = 1.

    Raises
    ------
    InputError
        ``spread`` is not positive.
    """
    if spread < 1:
        raise InputError("shares", "spread", spread, "a positive number of searches")
    return np.minimum(0.5 * np.arange(searches + 1) / spread, end)


def along_path(path: np.ndarray, share: np.ndarray) -> np.ndarray:
    """Configurations at shares 0 ... 1 of the samples of a path, linear in between (M, nq)."""
    return JointPath(path).at(np.asarray(share) * (len(path) - 1))


def hull_tracks(
    placed: PlacedArm, path: np.ndarray, circles: JointCircles, spread: int, two_sided: bool = True
) -> tuple[HullTrack, HullTrack]:
    """The moving hull as the forward and the backward half of a slave meet it."""
    if not two_sided:
        poses = along_path(path, shares(2 * spread, spread, 1.0))
        return hull_track(circles_on(placed, circles, poses)), NO_HULL
    forward = shares(spread, spread)
    poses = along_path(path, np.concatenate([forward, 1.0 - forward[:-1]]))
    track = hull_track(circles_on(placed, circles, poses))
    back = [*range(spread + 1, 2 * spread + 1), spread]
    return (
        HullTrack(track.planes[: spread + 1], track.triangles[: spread + 1]),
        HullTrack(track.planes[back], track.triangles[back]),
    )


def time_map(slave: SearchPlan, spread: int) -> np.ndarray:
    """Share of the master's path at every sample of the slave's path (N,), never falling."""
    if len(slave.record.paths) == 1:
        return shares(slave.searches, spread, 1.0)
    seen = shares(slave.searches, spread)
    return np.concatenate([seen, 1.0 - seen[::-1]])


def replay(
    master: np.ndarray, slave: np.ndarray, share: np.ndarray, spread: int
) -> tuple[np.ndarray, np.ndarray]:
    """Both arms on common samples: paths (M, nq) of the master and (M, nq) of the slave.

    Where the map jumps, since the slave was found before the master was at its middle, the slave
    waits and the master goes on at its own pace of 1/(2 spread) a sample.
    """
    pace = 0.5 / spread
    jump = np.diff(share)
    parts = np.maximum(np.ceil(jump / pace - 1e-9).astype(int), 1)
    last = np.cumsum(parts)
    part = np.repeat(np.arange(len(parts)), parts)
    done = np.arange(1, len(part) + 1) - (last - parts)[part]
    common = np.concatenate([share[:1], share[part] + done * (jump / parts)[part]])
    common[last] = share[1:]
    rows = np.append(0, part + (done == parts[part]))
    return along_path(master, common), slave[rows]
