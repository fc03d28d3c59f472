"""Which bodies of a scene are watched against which."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Iterable
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np

from ..arms.arm import Arm
from ..arms.exclusions import link_of, shape_of
from ..errors import UnknownNameError
from .bodies import Bodies, Body, PlacedArm, Sort
from .pair_kernels import capsules_capsules
from .posing import cores_in, frames_of, links_of

SORTS: tuple[Sort, ...] = ("capsule", "box", "plane", "hull")
#: Configurations of :func:`always_overlapping`.
SAMPLES = 64


@dataclass(frozen=True, eq=False)
class Pairs:
    """Watched pairs; the first body is a link of a controlled arm, the second goes by its sort."""

    bodies: tuple[tuple[Body, Body], ...]

    def __len__(self) -> int:
        return len(self.bodies)

    @cached_property
    def names(self) -> tuple[tuple[str, str], ...]:
        """Names of the two bodies of each pair."""
        return tuple((a.name, b.name) for a, b in self.bodies)

    @cached_property
    def rows(self) -> dict[Sort, np.ndarray]:
        """Rows (K, 2) of the pairs whose second body is of a sort, in the order of ``bodies``."""
        return {
            sort: np.array(
                [(a.row, b.row) for a, b in self.bodies if b.sort == sort], dtype=np.int64
            ).reshape(-1, 2)
            for sort in SORTS
        }

    def between(self, first: str, second: str) -> np.ndarray:
        """Mask (P,) of the pairs that join two bodies, links or owners given by name, in either
        order; see :func:`names_of`.

        Raises
        ------
        UnknownNameError
            No watched pair has a body, link or owner of that name.
        """
        for name in (first, second):
            _require(name, [body for pair in self.bodies for body in pair])
        return np.array([_joins(pair, first, second) for pair in self.bodies], dtype=bool)


def find_pairs(
    bodies: Bodies,
    arms: Iterable[PlacedArm],
    exempt: Collection[tuple[str, str]],
    self_collision: bool,
) -> Pairs:
    """Every link of a controlled arm against every other body, with four exceptions.

    Left out are two bodies that never move, neighbouring links of one arm but those whose contact
    is known to count (:func:`counting`), links of one arm whose contact says nothing
    (:func:`saying_nothing`), and the exempt pairs.

    Raises
    ------
    UnknownNameError
        An exempt name that no body, link or owner has.
    """
    for pair in exempt:
        for name in pair:
            _require(name, bodies.all)
    silent = {placed.name: saying_nothing(placed.arm) for placed in arms}
    near = {placed.name: counting(placed.arm) for placed in arms}

    def watched(a: Body, b: Body) -> bool:
        if (a.still and b.still) or any(_joins((a, b), *names) for names in exempt):
            return False
        if a.owner != b.owner:
            return True
        if not self_collision or a.joint is None or b.joint is None:
            return False
        if abs(a.joint - b.joint) <= 1:
            return bool(near[a.owner][a.link, b.link])
        return not silent[a.owner][a.link, b.link]

    links = [body for body in bodies.all if body.joint is not None]
    pairs = [
        (a, b)
        for k, a in enumerate(links)
        for b in [*links[k + 1 :], *bodies.all[len(links) :]]
        if watched(a, b)
    ]
    return Pairs(tuple(sorted(pairs, key=lambda pair: SORTS.index(pair[1].sort))))


def saying_nothing(arm: Arm) -> np.ndarray:
    """Mask (C, C) of capsules of one arm that are not watched against each other: by the evidence
    of the arm (:attr:`..arms.arm.Arm.exclusions`), else :func:`always_overlapping`."""
    if arm.exclusions is None:
        return always_overlapping(arm)
    return _among(arm, ((one.first, one.second) for one in arm.exclusions))


def counting(arm: Arm) -> np.ndarray:
    """Mask (C, C) of capsules of adjacent links that are watched against each other
    (:attr:`..arms.arm.Arm.neighbours`)."""
    return _among(arm, ((one.first, one.second) for one in arm.neighbours))


def _among(arm: Arm, pairs: Iterable[tuple[str, str]]) -> np.ndarray:
    """Mask (C, C) of pairs of capsules given by the names of two capsules or two shapes."""
    names = links_of(arm).names
    rows = defaultdict(set)
    for k, name in enumerate(names):
        rows[name].add(k)
        rows[shape_of(name)].add(k)
    mask = np.zeros((len(names), len(names)), dtype=bool)
    for first, second in pairs:
        for a in rows[first]:
            for b in rows[second]:
                mask[a, b] = mask[b, a] = True
    return mask


def always_overlapping(arm: Arm) -> np.ndarray:
    """Mask (C, C) of capsules of one arm that overlap in each of 64 configurations.

    They are spread evenly over the joint limits by the additive recurrence of the plastic numbers
    (k phi^-j mod 1, with phi the root of phi^(nq+1) = phi + 1).
    """
    phi = 2.0
    for _ in range(32):
        phi = (1.0 + phi) ** (1.0 / (arm.nq + 1))
    fraction = np.outer(np.arange(1, SAMPLES + 1), phi ** -np.arange(1.0, arm.nq + 1)) % 1.0
    lower, upper = arm.usual_range
    q = lower + fraction * (upper - lower)
    links = links_of(arm)
    count = len(links.radius)
    ends = cores_in(frames_of(arm, np.eye(3, 4), q), links.joint, links.local)
    rows = np.ascontiguousarray(np.argwhere(np.ones((count, count), dtype=bool)))
    distance = np.empty((SAMPLES, len(rows)))
    capsules_capsules(ends, links.radius, rows, distance, np.empty((0, 0, 3, 3)), 0)
    return (distance < 0).all(axis=0).reshape(count, count)


@lru_cache(maxsize=4096)
def names_of(name: str, owner: str) -> frozenset[str]:
    """What a body answers to: its name, its owner's, and a capsule of an arm the names of its shape
    and its link too."""
    within = name.removeprefix(f"{owner}/")
    if within == name:
        return frozenset((name, owner))
    shape, link = shape_of(within), link_of(within)
    return frozenset((name, owner, f"{owner}/{shape}", f"{owner}/{link}"))


def _belongs(body: Body, name: str) -> bool:
    return name in names_of(body.name, body.owner)


def _joins(pair: tuple[Body, Body], first: str, second: str) -> bool:
    a, b = pair
    return (_belongs(a, first) and _belongs(b, second)) or (
        _belongs(a, second) and _belongs(b, first)
    )


def _require(name: str, bodies: Iterable[Body]) -> None:
    bodies = list(bodies)
    if not any(_belongs(body, name) for body in bodies):
        known = sorted({known for body in bodies for known in (body.owner, shape_of(body.name))})
        raise UnknownNameError("scene", "body", name, f"one of {', '.join(known)}")
