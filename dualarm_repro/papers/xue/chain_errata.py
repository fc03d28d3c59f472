"""Machine proofs of the errata on the kinematics of `xue`."""

from __future__ import annotations

import numpy as np

from ...arms import load_arm
from ...ledger import REGISTRY, Proof
from .chain import symbolic_poses
from .printed_chain import (
    LINKS,
    equal,
    link_matrix,
    printed_parameters,
    substituted,
    table_parameters,
    table_pose,
)
from .readings import lengths, reach
from .scenario import MASTER_GOAL, MASTER_START

SHARED = ("a1", "a3", "d4", "d6")


@REGISTRY.proves("xue.eq01_angle")
def eq01_angle() -> Proof:
    """Substituting the parameters into (1) as printed and corrected."""
    literal = [k + 1 for k in LINKS if equal(substituted(k, corrected=False), link_matrix(k))]
    corrected = [k + 1 for k in LINKS if equal(substituted(k, corrected=True), link_matrix(k))]
    return Proof(
        "only with the twist angle does (1) reproduce every matrix (2)-(7)",
        len(corrected) == len(LINKS) > len(literal),
        {"matrices_as_printed": literal, "matrices_with_alpha": corrected},
    )


@REGISTRY.proves("xue.table1_shift")
def table1_shift() -> Proof:
    """Column a of the table against the matrices, and what the two readings differ by."""
    column = table_parameters()["a"]
    matrices = printed_parameters()["a"]
    ends = {pose: _difference(q) for pose, q in (("start", MASTER_START), ("goal", MASTER_GOAL))}
    return Proof(
        "the printed column equals that of the matrices moved up one row; the readings agree at "
        "the start, where only the sum of the lengths counts, and not at the goal",
        column == [*matrices[1:], 0.0]
        and column != matrices
        and ends["start"] < 1e-12 < ends["goal"],
        {
            "flange_difference_start": ends["start"],
            "flange_difference_goal": ends["goal"],
            "reach_matrices": reach("matrices"),
            "reach_table": reach("table"),
        },
    )


@REGISTRY.proves("xue.table1_unit")
def table1_unit() -> Proof:
    """Lengths read as metres are those of the published robot; as millimetres nothing is."""
    printed, published = printed_lengths(), lengths("published")
    metres = [name for name in SHARED if np.isclose(printed[name], published[name], atol=1e-12)]
    millimetres = [name for name in SHARED if np.isclose(1e-3 * printed[name], published[name])]
    return Proof(
        "read as metres, a1, a3, d4 and d6 are those of the published robot; read as millimetres, "
        "as headed, none is, and the arm would reach a few millimetres",
        metres == list(SHARED) and not millimetres,
        {"reach_if_millimetres_in_mm": reach("matrices"), "equal_in_metres": metres},
    )


@REGISTRY.proves("xue.upper_arm")
def upper_arm() -> Proof:
    """The one link length that is not that of the robot named."""
    printed, published = printed_lengths()["a2"], lengths("published")["a2"]
    return Proof(
        "the printed upper arm is shorter than the published one",
        published > printed,
        {
            "printed": printed,
            "published": published,
            "reach_matrices": reach("matrices"),
            "reach_published_from_floor": reach("published"),
        },
    )


@REGISTRY.proves("xue.base_height")
def base_height() -> Proof:
    """Without the published base height the start lies below the floor."""
    height = lengths("published")["d1"]
    z = float(load_arm("es165d").fk(MASTER_START)[2, 3])
    return Proof(
        "the matrices have no base height, and with the published one the start pose would put the "
        "flange of a standing robot below the floor",
        printed_lengths()["d1"] == 0.0 < height and z + height < 0,
        {"published_height": height, "flange_above_floor_at_start": z + height},
    )


@REGISTRY.proves("xue.start_outside_limits")
def start_outside_limits() -> Proof:
    """The printed start against the ranges of the real robot, mapped to the document's zero."""
    arm = load_arm("es165d")
    excess = np.rad2deg(MASTER_START - arm.upper)
    return Proof(
        "axis L is beyond its range at the printed start and within it at the printed goal",
        bool(excess[1] > 0 and MASTER_GOAL[1] < arm.upper[1]),
        {
            "axis_L_at_start_deg": float(90 + np.rad2deg(MASTER_START[1])),
            "beyond_range_deg": float(excess[1]),
        },
    )


def printed_lengths() -> dict[str, float]:
    """Link lengths and offsets of matrices (2)-(7), under the names of the published ones."""
    found = printed_parameters()
    rows = {"a1": ("a", 1), "a2": ("a", 2), "a3": ("a", 3)}
    rows |= {"d1": ("d", 0), "d4": ("d", 3), "d6": ("d", 5)}
    return {name: found[column][row] for name, (column, row) in rows.items()}


def _difference(q: np.ndarray) -> float:
    matrices = symbolic_poses(q[np.newaxis])[0]
    return float(np.linalg.norm(matrices[:3, 3] - table_pose(q)[:3, 3]))
