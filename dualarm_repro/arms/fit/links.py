"""Capsules and exclusions of a URDF, computed once for each content of its files."""

from __future__ import annotations

import json
import os
from functools import cached_property
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING, Any

import coal
import numpy as np
import pinocchio as pin

from ...cache_folder import cache_folder
from ...errors import DataFileError, DualArmError
from ...sources import graph
from ..capsules import LinkCapsule, geometry_of
from ..exclusions import Evidence, Exclusion, Neighbours
from .evidence import judge
from .neighbours import adjacent_pairs, neighbours
from .parts import parts_of

if TYPE_CHECKING:
    from ..urdf import URDF


_KEYS = {"capsules", "hulls", "exclusions", "neighbours"}


class FittedLinks:
    """Several capsules around each shape of a URDF, the pairs of shapes that say nothing, and the
    neighbours that do.

    All are kept in the cache folder under a hash of the file, its meshes, the locked joints and
    the code that computes them.
    """

    def __init__(self, urdf: URDF) -> None:
        self._urdf = urdf

    def geometry(self) -> pin.GeometryModel:
        """Capsules in the frames of the joints; those of one shape are named ``shape.k``."""
        return geometry_of(
            LinkCapsule(name, joint, np.array(start), np.array(end), radius)
            for name, joint, start, end, radius in self._found["capsules"]
        )

    def hulls(self) -> dict[str, np.ndarray]:
        """Of capsules by name the corners (V, 3) of the hull of what they contain, in the frame of
        their joint [m]."""
        return {name: np.array(corners) for name, corners in self._found["hulls"].items()}

    def exclusions(self) -> tuple[Exclusion, ...]:
        """Pairs of shapes that are not watched."""
        return tuple(
            Exclusion(first, second, Evidence(evidence), *counts)
            for first, second, evidence, *counts in self._found["exclusions"]
        )

    def neighbours(self) -> tuple[Neighbours, ...]:
        """Pairs of adjacent shapes that are watched."""
        return tuple(Neighbours(*one) for one in self._found["neighbours"])

    @cached_property
    def _found(self) -> dict[str, Any]:
        path = self._path()
        if path is not None and (kept := _read(path)) is not None:
            return kept
        solids = self._urdf.solids()
        try:
            found = self._compute(solids)
        except DualArmError:
            raise
        except Exception as error:  # whatever a mesh makes of the algebra is the file's
            reason, expected = str(error), 'shapes that capsules can enclose, or shapes="none"'
            raise DataFileError(self._urdf.path, "collision shapes", reason, expected) from None
        if path is not None:
            _keep(path, found)
        return found

    def _compute(self, solids: pin.GeometryModel) -> dict[str, Any]:
        parts, model = parts_of(solids), self._urdf.model
        watched, silent = neighbours(model, solids, adjacent_pairs(solids))
        return {
            "capsules": [
                [c.name, c.joint, c.start.tolist(), c.end.tolist(), c.radius]
                for c in (part.capsule for part in parts)
            ],
            "hulls": {
                part.capsule.name: part.corners.tolist() for part in parts if len(part.corners)
            },
            "exclusions": [
                [one.first, one.second, one.evidence.value, one.touching, one.sampled, one.flagged]
                for one in [*silent, *judge(model, solids, parts)]
            ],
            "neighbours": [[w.first, w.second, w.touching, w.sampled] for w in watched],
        }

    def _path(self) -> Path | None:
        folder = cache_folder()
        if folder is None:
            return None
        code = graph().digest(graph().closure([__name__]))
        versions = f"{pin.__version__} {coal.__version__} {np.__version__}"
        key = sha256(f"{self._urdf.content()} {code} {versions}".encode()).hexdigest()
        return folder / "arms" / f"{key[:32]}.json"


def _read(path: Path) -> dict[str, Any] | None:
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    whole = isinstance(found, dict) and _KEYS <= found.keys()
    return found if whole else None


def _keep(path: Path, found: dict[str, Any]) -> None:
    """A cache that cannot be written costs time."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        temporary = path.with_suffix(f".{os.getpid()}")
        temporary.write_text(json.dumps(found), encoding="utf-8")
        temporary.replace(path)
    except OSError:
        return
