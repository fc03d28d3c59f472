"""Capsules and exclusions of a URDF, computed once for each content of its files."""

from __future__ import annotations

import json
import os
from collections.abc import Collection
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
from ..capsules import LinkCapsule, geometry_of, not_contained
from ..exclusions import Evidence, Exclusion
from .decomposition import COARSE, FINE, decompose
from .evidence import judge
from .triangles import triangles_of

if TYPE_CHECKING:
    from ..urdf import URDF


#: Share of free postures with a false alarm up to which no more capsules are made, and the share of
#: false alarms that may be left for these to be worth their cost.
ENOUGH, WORTH = 0.05, 0.7


class FittedLinks:
    """Several capsules around each shape of a URDF, and the pairs of shapes that say nothing.

    Both are kept in the cache folder under a hash of the file, its meshes, the locked joints and
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

    def exclusions(self) -> tuple[Exclusion, ...]:
        """Pairs of shapes that are not watched."""
        return tuple(
            Exclusion(first, second, Evidence(evidence), *counts)
            for first, second, evidence, *counts in self._found["exclusions"]
        )

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
        capsules = fitted(solids)
        judged = judge(self._urdf.model, solids, geometry_of(capsules))
        if judged.alarms > ENOUGH:
            finer = fitted(solids, judged.noisy)
            again = judge(self._urdf.model, solids, geometry_of(finer))
            if again.alarms < WORTH * judged.alarms:
                capsules, judged = finer, again
        return {
            "capsules": [
                [c.name, c.joint, c.start.tolist(), c.end.tolist(), c.radius] for c in capsules
            ],
            "exclusions": [
                [one.first, one.second, one.evidence.value, one.touching, one.sampled, one.flagged]
                for one in judged.exclusions
            ],
        }

    def _path(self) -> Path | None:
        folder = cache_folder()
        if folder is None:
            return None
        code = graph().digest(graph().closure([__name__]))
        versions = f"{pin.__version__} {coal.__version__} {np.__version__}"
        key = sha256(f"{self._urdf.content()} {code} {versions}".encode()).hexdigest()
        return folder / "arms" / f"{key[:32]}.json"


def fitted(solids: pin.GeometryModel, finer: Collection[str] = ()) -> list[LinkCapsule]:
    """Capsules around every shape; a ball and a capsule stay as they are, and a long cylinder keeps
    its radius and its axis.

    Parameters
    ----------
    finer
        Names of shapes that get up to twice as many capsules.

    Raises
    ------
    UnsupportedArmError
        A shape is neither of these, nor a box, a cylinder or a mesh.
    """
    found = []
    for shape in solids.geometryObjects:
        solid = shape.geometry
        if isinstance(solid, coal.Sphere):
            cores = [(np.zeros(3), np.zeros(3), solid.radius)]
        elif isinstance(solid, coal.Capsule) or _is_rod(solid):
            half = np.array([0.0, 0.0, solid.halfLength])
            cores = [(-half, half, solid.radius)]
        else:
            fineness = FINE if shape.name in finer else COARSE
            cores = decompose(triangles_of(solid), *fineness)
        for k, (start, end, radius) in enumerate(cores):
            name = shape.name if len(cores) == 1 else f"{shape.name}.{k}"
            ends = shape.placement.act(start), shape.placement.act(end)
            found.append(LinkCapsule(name, shape.parentJoint, *ends, radius))
    return not_contained(found)


def _is_rod(solid: coal.CollisionGeometry) -> bool:
    """Whether the ends of a capsule around a cylinder add at most a quarter to its volume."""
    return isinstance(solid, coal.Cylinder) and 4.0 / 3.0 * solid.radius <= 0.5 * solid.halfLength


def _read(path: Path) -> dict[str, Any] | None:
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    whole = isinstance(found, dict) and {"capsules", "exclusions"} <= found.keys()
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
