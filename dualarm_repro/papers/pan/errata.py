"""Machine proofs of the errata of `pan`."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import sympy as sp

from ...ledger import REGISTRY, Proof, evaluate
from ...ledger.assumptions import alternatives
from ...welding import base_poses
from .document import SEED, printed_base_matrix, printed_bases, stand_in
from .pages.measure.system import best_by_unit, unit_powers
from .print_forms import holds, in_symbols, printed_text
from .reading import SPACING, TOLERANCE, FlatSeam, Problem, optimum


@REGISTRY.proves("pan.base_transform")
def base_transform() -> Proof:
    """The base origin in the world under both readings of the printed matrix."""
    matrix = printed_base_matrix()[np.newaxis]
    inverted, literal = (base_poses(matrix, r)[0, :3, 3] for r in ("inverted", "literal"))
    listed = printed_bases()[0]
    return Proof(
        "as pose of the base the matrix gives the listed position; as map from world to base it "
        "puts the base at minus that position",
        bool(np.array_equal(inverted, listed) and np.array_equal(literal, -listed)),
        {"as_pose": inverted.tolist(), "as_labelled": (literal + 0.0).tolist()},
    )


@REGISTRY.proves("pan.eq14_size")
def eq14_size() -> Proof:
    """Printed size against that of the printed blocks for arms of m rows and n columns."""
    m, n = sp.symbols("m n", positive=True, integer=True)
    printed = [in_symbols(printed_text("pan.eq14", name), m=m, n=n) for name in ("rows", "columns")]
    blocks = {f"J_{k}": sp.MatrixSymbol(f"J_{k}", m, n).shape for k in (1, 2)}
    matrix = printed_text("pan.eq14", "matrix")
    rows = sum(next(blocks[cell][0] for cell in row if cell in blocks) for row in matrix)
    columns = sum(
        next(blocks[cell][1] for cell in column if cell in blocks)
        for column in zip(*matrix, strict=True)
    )
    agree = sp.solve([rows - printed[0], columns - printed[1]], [m, n], dict=True)
    return Proof(
        "the printed blocks have 2m rows and 2n columns; the printed size agrees for m = n = 6 "
        "only",
        (rows, columns) == (2 * m, 2 * n) and agree == [{m: 6, n: 6}],
        {"size": f"{rows} x {columns}", "agrees_for": str(agree)},
    )


@REGISTRY.proves("pan.eq13_size")
def eq13_size() -> Proof:
    """Whether (12) is defined with the printed sizes."""
    found = _obtained("pan.eq13")
    return Proof(
        "the product (12) exists for vectors of 2n and 2m entries and not for the printed sizes",
        found["stacked"] and found["as_printed"] is False,
        found,
    )


@REGISTRY.proves("pan.tight_loose_units")
def tight_loose_units() -> Proof:
    """The printed measures under a change of the unit of length, and the optimum in both."""
    values = REGISTRY.nominal("pan")
    powers = unit_powers(values["arm"])
    best = best_by_unit(Problem.of(values))
    moved = float(np.linalg.norm(best["m"] - best["mm"]))
    terms = [round(powers[name][0], 9) for name in ("M_tight", "M_loose")]
    return Proof(
        "with the unit of length the terms of the printed (16) scale by different powers and "
        "their sum by none; the best position in millimetres is another than in metres",
        terms[0] != terms[1] and float(np.ptp(powers["MMR"])) > 0.0 and moved > SPACING / 2,
        {"powers": terms, "optimum_moves_m": moved},
    )


@REGISTRY.proves("pan.beta_cancels")
def beta_cancels() -> Proof:
    """The printed (16) with beta_i = V / V_i, V common to all."""
    V, V1, V2, V3, tight, loose = sp.symbols("V V1 V2 V3 M_tight M_loose", positive=True)
    text = printed_text("pan.eq16").split("=")[-1]

    def measure(common: sp.Expr) -> sp.Expr:
        beta = {"beta_1": (common / V1 + common / V2) / 2, "beta_2": common / V3}
        return in_symbols(text, **beta, M_tight=tight, M_loose=loose)

    cancels = sp.simplify(measure(V) - measure(sp.Integer(1))) == 0
    free = V not in sp.simplify(measure(V)).free_symbols
    gap = _obtained("pan.claim_beta_rule")["gap"]
    return Proof(
        "the volume of the intersection cancels in the printed (16), in symbols and in numbers",
        bool(cancels and free and gap < 1e-9),
        {"largest_difference": gap},
    )


@REGISTRY.proves("pan.constant_pose")
def constant_pose() -> Proof:
    """How far the workpiece must turn to lay every seam point flat."""
    flat = FlatSeam.of(REGISTRY.nominal("pan"))
    trace = np.trace(flat.rotations[0].T @ flat.rotations, axis1=1, axis2=2)
    turn = float(np.degrees(np.arccos(np.clip((trace - 1) / 2, -1, 1)).max()))
    return Proof(
        "no constant orientation lays all seam points flat: between two of them the workpiece "
        "turns",
        turn > 1e-6,
        {"largest_turn_deg": turn},
    )


@REGISTRY.proves("pan.rank_condition")
def rank_condition() -> Proof:
    """Rank of the Jacobian at random and at nearly singular configurations."""
    arm = stand_in(REGISTRY.nominal("pan")["arm"])
    q = arm.random_configurations(10_000, np.random.default_rng(SEED))
    near = q[:100].copy()
    near[:, 4] = 1e-6
    text = next(c for c in printed_text("pan.eq_opt", "subject_to") if c.startswith("Rank"))
    names = {"Rank": np.linalg.matrix_rank, "min": min, "m": 6, "n": 6}
    full, at_near = (holds(text, {**names, "J": arm.jacobian(rows)}) for rows in (q, near))
    smallest = float(np.max(arm.manipulability(near)))
    return Proof(
        "the printed condition holds at every one of 10 000 random configurations and still a "
        "millionth of a radian from a wrist singularity, where the arm can hardly move",
        full and at_near and smallest < REGISTRY.nominal("pan")["singularity_threshold"],
        {"near_a_singularity": at_near, "largest_measure_there": smallest},
    )


@REGISTRY.proves("pan.ellipsoid_axes")
def ellipsoid_axes() -> Proof:
    """Singular values, eigenvalues and the measure of one direction at a random configuration."""
    arm = stand_in(REGISTRY.nominal("pan")["arm"])
    J = arm.jacobian(arm.random_configurations(1, np.random.default_rng(SEED))[0])
    singular = np.linalg.svd(J, compute_uv=False)
    eigen = np.sort(np.abs(np.linalg.eigvals(J)))[::-1]
    return Proof(
        "absolute eigenvalues of the Jacobian differ from its singular values; only their "
        "products agree",
        bool(not np.allclose(singular, eigen) and np.isclose(singular.prod(), eigen.prod())),
        {"singular_values": singular.tolist(), "absolute_eigenvalues": eigen.tolist()},
    )


@REGISTRY.proves("pan.no_certificate")
def no_certificate() -> Proof:
    """The optimum for every declared reference point of the carriers, and its mirror image."""
    declared, apart = Problem.of(REGISTRY.nominal("pan")), {}
    for reference in alternatives("pan.carrier_reference", 0):
        job = replace(declared.job, carrier_reference=reference)
        problem = replace(declared, job=job)
        best = optimum(problem)
        image = best.position * [-1.0, 1.0, 1.0]
        same = abs(float(problem.placement()([image])[0]) / best.fitness - 1) < 1e-6
        apart[reference] = float(np.linalg.norm(best.position - image)) if same else 0.0
    return Proof(
        "with a reference point of the carriers' ellipsoids that is among the plausible ones the "
        "mirror image of the optimum in the plane x = 0 has the same fitness, so that the maximum "
        "is taken twice",
        max(apart.values()) > TOLERANCE,
        {"apart_m": apart},
    )


def _obtained(item: str) -> dict[str, Any]:
    result = evaluate(REGISTRY, item).result
    return result.obtained if result else {}
