"""Where the three bases stand, by the printed list and by the printed matrix."""

from __future__ import annotations

import re
from functools import partial

import numpy as np

from ...errors import DataFileError
from ...ledger import REGISTRY, Adopts, Assumed, Is, NoOriginal, Result, Role
from ...ledger.printed import rounds_to
from ...welding import base_poses
from .print_forms import printed_text
from .scenario import placed_bases, printed_base_matrix, printed_bases

checks = partial(REGISTRY.checks, page="pan/cell")


@checks(
    "pan.claim_bases",
    rules=[Adopts(name, f"{name} [m]", to=name) for name in ("base1", "base2", "base3")],
)
def positions(assumed: Assumed) -> Result:
    """Origins of the base frames that the cell uses."""
    poses = placed_bases(assumed["base_transform"], assumed["base_orientation"])
    used = dict(zip(("base1", "base2", "base3"), poses[:, :3, 3].tolist(), strict=True))
    spread = np.linalg.norm(printed_bases()[:, :2], axis=1)
    return Result(
        obtained=used,
        caption=(
            f"{_places(poses[:, :3, 3])}, at horizontal distances of "
            f"{spread[0]:.3f}, {spread[1]:.3f} and {spread[2]:.3f} m from the origin of the world. "
            "Orientations are not printed for two of them; all are taken as parallel to the world."
        ),
    )


@checks(
    "pan.eq_base",
    rules=[
        Adopts("matrix", "pose of base 1 in the world, as used", to="matrix"),
        Is(
            "labelled_is_listed",
            "read as its label says, the matrix puts base 1 where the list has it",
            value=False,
            role=Role.CONTRADICTS,
        ),
    ],
)
def matrix(assumed: Assumed) -> Result:
    """The printed matrix as pose of base 1, and what follows from its label."""
    printed, listed = printed_base_matrix(), REGISTRY.printed("pan.claim_bases")["base1"]
    used = placed_bases(assumed["base_transform"], assumed["base_orientation"])[0]
    reading = label_reading(printed_text("pan.eq_base", "label"))
    labelled = base_poses(printed[np.newaxis], reading)[0, :3, 3] + 0.0
    as_pose = _listed(base_poses(printed[np.newaxis], "inverted")[0, :3, 3], listed)
    gap = float(np.linalg.norm(labelled - printed_bases()[0]))
    return Result(
        obtained={
            "matrix": used.tolist(),
            "labelled_is_listed": _listed(labelled, listed) if as_pose else None,
            "as_labelled": gap,
        },
        caption=(
            f"As pose of base 1 in the world the matrix {'gives' if as_pose else 'does not give'} "
            "the listed position. Its label makes it the "
            f"{'map from world to base' if reading == 'literal' else 'pose'}; then base 1 "
            f"would stand at ({', '.join(f'{v:g}' for v in labelled)}) m, {gap:.2f} m away from "
            "the listed position."
        ),
    )


def label_reading(label: str) -> str:
    """How ``base_poses`` has to read a matrix of that label.

    By (6) and (8) T_ab carries coordinates from b to a: T_B1w from the world to base 1.

    Raises
    ------
    DataFileError
        The label names no base and the world.
    """
    found = re.fullmatch(r"T_(B\d|w)(B\d|w)", label)
    if not found or "w" not in found.groups() or found[1] == found[2]:
        raise DataFileError("printed matrix", "label", label, "T_B1w or T_wB1")
    return "literal" if found[2] == "w" else "inverted"


def _listed(position: np.ndarray, listed: list[str]) -> bool:
    """Whether a position rounds to the listed one."""
    return all(rounds_to(float(v), text) for v, text in zip(position, listed, strict=True))


def _places(positions: np.ndarray) -> str:
    gap = np.linalg.norm(positions - printed_bases(), axis=1).max()
    if gap < 1e-12:
        return "The three bases stand where the list puts them"
    return f"The three bases stand up to {gap:.2f} m from where the list puts them"


@checks(
    "pan.claim_teaching",
    rules=[NoOriginal("experiment", "an experiment with taught robots")],
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
