"""Pairs of shapes of one arm that are not watched, and neighbours that are, with the evidence."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from enum import StrEnum

_PART, _NUMBER = re.compile(r"\.\d+$"), re.compile(r"_\d+$")


class Evidence(StrEnum):
    """Why a pair of shapes says nothing about self-collision.

    ``adjacent``: a joint joins their links; ``always``: they touch in every sampled posture;
    ``home``: they touch at the home pose and in most postures; ``never``: what two capsules contain
    of them comes near in no posture, though the capsules overlap.
    """

    ADJACENT = "adjacent"
    ALWAYS = "always"
    HOME = "home"
    NEVER = "never"


@dataclass(frozen=True)
class Exclusion:
    """Two shapes, or two capsules, that are not watched.

    Attributes
    ----------
    first, second : str
        Names of the collision shapes, or of single capsules of them.
    evidence : Evidence
    touching, sampled : int
        In how many of the sampled postures the shapes themselves touch, of two capsules what they
        contain of them.
    flagged : int
        In how many their capsules, or the two, do.
    """

    first: str
    second: str
    evidence: Evidence
    touching: int
    sampled: int
    flagged: int

    def __str__(self) -> str:
        return (
            f"{self.first} - {self.second}: {self.evidence}, shapes touch in {self.touching} and "
            f"capsules in {self.flagged} of {self.sampled} postures"
        )


@dataclass(frozen=True)
class Neighbours:
    """Two shapes that a joint joins and that are watched all the same.

    They are apart at the home pose, and touch for some values of the joint.

    Attributes
    ----------
    first, second : str
        Names of the collision shapes.
    touching, sampled : int
        For how many of the sampled values of the joint they touch.
    """

    first: str
    second: str
    touching: int
    sampled: int

    def __str__(self) -> str:
        return (
            f"{self.first} - {self.second}: adjacent and watched, apart at the home pose and in "
            f"touch for {self.touching} of {self.sampled} values of their joint"
        )


def shape_of(capsule: str) -> str:
    """Name of the shape that a capsule belongs to; the k-th of several is named ``shape.k``."""
    return _PART.sub("", capsule)


def link_of(capsule: str) -> str:
    """Name of the link that a capsule belongs to; its k-th shape is named ``link_k``."""
    return _NUMBER.sub("", shape_of(capsule))


def listed(exclusions: Iterable[Exclusion]) -> str:
    """One line for each pair."""
    return "\n".join(map(str, exclusions))
