"""The closest pair of bodies at every key frame, and what is in contact then."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ...scene import PlacedArm, Scene, Shape, clearance
from ...scene.bodies import Body


@dataclass(frozen=True, eq=False)
class Nearest:
    """Smallest distance of two arms, or of an arm and an obstacle, at F key frames.

    Attributes
    ----------
    distance : ndarray (F,)
        Signed [m].
    ends : ndarray (F, 2, 3)
        Its two ends in the world [m].
    names : list of (str, str)
        The two bodies in words.
    contacts : list of set of str
        Bodies that touch or overlap another one.
    what : str
        What is compared, in words.
    """

    distance: np.ndarray
    ends: np.ndarray
    names: list[tuple[str, str]]
    contacts: list[set[str]]
    what: str


def nearest_pairs(
    paths: Mapping[str, tuple[PlacedArm, np.ndarray]],
    solids: Mapping[str, Shape],
) -> Nearest | None:
    """The closest pairs of arms, each with its configurations (F, nq), among obstacles.

    Links of one arm are not compared with each other; None if nothing else is there.
    """
    arms = [placed for placed, _ in paths.values()]
    scene = Scene(arms, dict(solids), self_collision=False)
    if not len(scene.pairs):
        return None
    found = clearance(scene, np.hstack([path for _, path in paths.values()]))
    what = "arms and obstacles"
    return nearest_of(found.distance, found.point_a, found.point_b, scene.pairs.bodies, what)


def nearest_of(
    distance: np.ndarray,
    point_a: np.ndarray,
    point_b: np.ndarray,
    pairs: Sequence[tuple[Body, Body]],
    what: str = "bodies",
) -> Nearest:
    """The smallest of the distances (F, P) of P pairs, which the points (F, P, 3) attain."""
    frames, best = np.arange(len(distance)), distance.argmin(axis=1).tolist()
    ends = np.stack([point_a[frames, best], point_b[frames, best]], axis=1)
    contacts = [
        {body_id(body) for k in np.flatnonzero(row <= 0.0).tolist() for body in pairs[k]}
        for row in distance
    ]
    names = [(in_words(pairs[k][0]), in_words(pairs[k][1])) for k in best]
    return Nearest(distance[frames, best], ends, names, contacts, what)


def body_id(body: Body) -> str:
    """How parts of a scene name the body they draw."""
    return body.owner if body.joint is None else f"{body.owner}:{body.joint}"


def in_words(body: Body) -> str:
    """A body as a reader would call it."""
    if body.joint is None:
        return body.owner.replace("_", " ")
    if "/tool_" in body.name:
        return f"{body.owner}, tool"
    return f"{body.owner}, link {body.joint}" if body.joint else f"{body.owner}, base"
