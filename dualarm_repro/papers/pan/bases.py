"""Where the three bases stand, by the printed list and by the printed matrix."""

from __future__ import annotations

from functools import partial

import numpy as np

from ...ledger import REGISTRY, Adopts, Assumed, Bounded, NoOriginal, Result, Role, Rounds
from ...welding import base_poses
from .scenario import placed_bases, printed_base_matrix, printed_bases

checks = partial(REGISTRY.checks, page="pan/cell")


@checks(
    "pan.claim_bases",
    samples=32,
    rules=[Adopts(key=name, to=name, label=f"{name} [m]") for name in ("base1", "base2", "base3")],
)
def positions(assumed: Assumed) -> Result:
    """Origins of the base frames that the cell uses."""
    poses = placed_bases("inverted", assumed["base_orientation"])
    used = dict(zip(("base1", "base2", "base3"), poses[:, :3, 3].tolist(), strict=True))
    spread = np.linalg.norm(printed_bases()[:, :2], axis=1)
    return Result(
        obtained=used,
        caption=(
            "The three bases stand where the list puts them, at horizontal distances of "
            f"{spread[0]:.3f}, {spread[1]:.3f} and {spread[2]:.3f} m from the origin of the world. "
            "Orientations are not printed for two of them; all are taken as parallel to the world."
        ),
    )


@checks(
    "pan.eq_base",
    samples=32,
    rules=[
        Rounds(
            key="matrix",
            to="matrix",
            tolerance=1e-12,
            reason="entries of an input",
            label="pose of base 1 in the world, as used",
        ),
        Bounded(
            key="as_labelled",
            low=0.1,
            role=Role.CONTRADICTS,
            label="read as labelled, base 1 would stand off its listed position by [m]",
        ),
    ],
)
def matrix(assumed: Assumed) -> Result:
    """The printed matrix as pose of base 1, and what follows from its label."""
    printed = printed_base_matrix()
    reading = assumed["base_transform"]
    used = placed_bases(reading, assumed["base_orientation"])[0]
    labelled = base_poses(printed[np.newaxis], "literal")[0, :3, 3]
    gap = float(np.linalg.norm(labelled - printed_bases()[0]))
    return Result(
        obtained={"matrix": used.tolist(), "as_labelled": gap},
        caption=(
            "The matrix has the listed position of base 1 as translation, so it is the pose of "
            "the base in the world. Its label makes it the map from world to base; then base 1 "
            f"would stand at ({', '.join(f'{v:g}' for v in labelled)}) m, {gap:.2f} m away from "
            "the listed position."
        ),
    )


@checks(
    "pan.claim_teaching",
    rules=[NoOriginal(key="experiment", label="an experiment with taught robots")],
)
def teaching(assumed: Assumed) -> Result:
    """A statement about practice."""
    return Result(
        obtained={},
        caption=(
            "That coordinated robots cannot be taught by hand is a statement about practice; the "
            "document reports no experiment, and no computation can decide it."
        ),
    )
