"""Machine proofs of the errata of `pan`."""

from __future__ import annotations

import numpy as np
import sympy as sp

from ...ledger import REGISTRY, Proof, evaluate
from ...welding import base_poses
from .nominal import nominal_values
from .optimum import optimum
from .positions import search_box
from .scenario import (
    SEED,
    FlatSeam,
    Job,
    Measure,
    printed_base_matrix,
    printed_bases,
    stand_in,
)


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
    """Size of the block-diagonal Jacobian for arms of m rows and n columns, in symbols."""
    m, n = sp.symbols("m n", positive=True, integer=True)
    blocks = sp.BlockDiagMatrix(sp.MatrixSymbol("J1", m, n), sp.MatrixSymbol("J2", m, n))
    rows, columns = blocks.shape
    printed = (sp.Integer(12), m + n)
    agree = sp.solve([rows - printed[0], columns - printed[1]], [m, n], dict=True)
    return Proof(
        "the matrix has 2m rows and 2n columns; the printed size agrees for m = n = 6 only",
        agree == [{m: 6, n: 6}],
        {"size": f"{rows} x {columns}", "agrees_for": str(agree)},
    )


@REGISTRY.proves("pan.eq13_size")
def eq13_size() -> Proof:
    """Whether (12) is defined with the printed sizes."""
    found = evaluate(REGISTRY, "pan.eq13").result.obtained
    return Proof(
        "the product (12) exists for vectors of 2n and 2m entries and not for the printed sizes",
        found["column_vectors"] and not found["as_printed"],
        found,
    )


@REGISTRY.proves("pan.tight_loose_units")
def tight_loose_units() -> Proof:
    """Both terms of (16) under a change of the unit of length by a factor s."""
    s, w1, w2, w3, b1, b2 = sp.symbols("s w1 w2 w3 beta1 beta2", positive=True)
    terms = b1 * w1 * w2, b2 * w3
    scaled = [
        t.subs({w1: s**3 * w1, w2: s**3 * w2, w3: s**3 * w3}, simultaneous=True) for t in terms
    ]
    powers = [sp.degree(t, s) for t in scaled]
    values = nominal_values()
    job, box = Job.of(values), search_box(values)
    best = {
        unit: np.abs(optimum(job, Measure.of({**values, "length_unit": unit}), box).position)
        for unit in ("m", "mm")
    }
    moved = float(np.linalg.norm(best["m"] - best["mm"]))
    return Proof(
        "with the unit of length the first term scales by the sixth power and the second by the "
        "third; the best position in millimetres is another than in metres",
        powers == [6, 3] and moved > 0.01,
        {"powers": [int(p) for p in powers], "optimum_moves_m": moved},
    )


@REGISTRY.proves("pan.beta_cancels")
def beta_cancels() -> Proof:
    """(16) with beta_i = V / V_i, V common to all."""
    V, V1, V2, V3, tight, loose = sp.symbols("V V1 V2 V3 M_tight M_loose", positive=True)

    def measure(common: sp.Expr) -> sp.Expr:
        first, second = (common / V1 + common / V2) / 2, common / V3
        return (first * tight + second * loose) / (first + second)

    cancels = sp.simplify(measure(V) - measure(sp.Integer(1))) == 0
    free = V not in sp.simplify(measure(V)).free_symbols
    numbers = evaluate(REGISTRY, "pan.claim_beta_rule").result.obtained
    return Proof(
        "the volume of the intersection cancels in (16), in symbols and in numbers",
        bool(cancels and free and numbers["cancels"] < 1e-12),
        {"largest_difference": numbers["cancels"]},
    )


@REGISTRY.proves("pan.constant_pose")
def constant_pose() -> Proof:
    """How far the workpiece must turn to lay every seam point flat."""
    flat = FlatSeam.of(nominal_values())
    trace = np.trace(flat.rotations[0].T @ flat.rotations, axis1=1, axis2=2)
    turn = float(np.degrees(np.arccos(np.clip((trace - 1) / 2, -1, 1)).max()))
    return Proof(
        "no constant orientation lays all seam points flat: between two of them the workpiece "
        "turns",
        turn > 10,
        {"largest_turn_deg": turn},
    )


@REGISTRY.proves("pan.rank_condition")
def rank_condition() -> Proof:
    """Rank of the Jacobian at random and at nearly singular configurations."""
    arm = stand_in(nominal_values()["arm"])
    q = arm.random_configurations(10_000, np.random.default_rng(SEED))
    near = q[:100].copy()
    near[:, 4] = 1e-6
    ranks, at_near = (np.linalg.matrix_rank(arm.jacobian(rows)) for rows in (q, near))
    smallest = float(arm.manipulability(near).max())
    return Proof(
        "the rank is full at every one of 10 000 random configurations and stays full a "
        "millionth of a radian from a wrist singularity, where the arm can hardly move",
        bool((ranks == 6).all() and (at_near == 6).all() and smallest < 1e-5),
        {"full_rank": int((ranks == 6).sum()), "largest_measure_near_singularity": smallest},
    )


@REGISTRY.proves("pan.ellipsoid_axes")
def ellipsoid_axes() -> Proof:
    """Singular values, eigenvalues and the measure of one direction at a random configuration."""
    arm = stand_in(nominal_values()["arm"])
    J = arm.jacobian(arm.random_configurations(1, np.random.default_rng(SEED))[0])
    singular = np.linalg.svd(J, compute_uv=False)
    eigen = np.sort(np.abs(np.linalg.eigvals(J)))[::-1]
    return Proof(
        "absolute eigenvalues of the Jacobian differ from its singular values; only their "
        "products agree",
        bool(abs(singular - eigen).max() > 0.01 and np.isclose(singular.prod(), eigen.prod())),
        {"singular_values": singular.tolist(), "absolute_eigenvalues": eigen.tolist()},
    )


@REGISTRY.proves("pan.no_certificate")
def no_certificate() -> Proof:
    """The mirror image of the optimum is as good."""
    values = nominal_values()
    job, measure = Job.of(values), Measure.of(values)
    best = optimum(job, measure, search_box(values))
    image = best.position * [-1.0, 1.0, 1.0]
    fitness = float(job.placement(measure.reading())([image])[0])
    apart = float(np.linalg.norm(best.position - image))
    return Proof(
        "the mirror image of the optimum in the plane x = 0 has the same fitness, so that the "
        "maximum is taken twice",
        bool(abs(fitness / best.fitness - 1) < 1e-6 and apart > 0.01),
        {"fitness": best.fitness, "of_the_image": fitness, "apart_m": apart},
    )
