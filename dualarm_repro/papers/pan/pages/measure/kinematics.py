"""Equations (9)-(15) of `pan`: manipulability of one robot and of both carriers together."""

from __future__ import annotations

from functools import partial

import numpy as np
import pinocchio as pin
from scipy.linalg import block_diag

from .....arms import Arm
from .....ledger import REGISTRY, Assumed, Bounded, Is, Residual, Result, Role
from .....ledger.captions import captions
from .....welding import closed_form
from .....welding.ellipsoid import gram_matrices, unit_ball_volume
from .....welding.manipulability import tight_measure
from .....welding.motion import flange_twist
from ...document import SEED, stand_in
from ...print_forms import block_matrix, block_residual, printed_text, residual, value, worst

checks = partial(REGISTRY.checks, page="pan/measure")
caption = captions(__file__)
_SAMPLES = 500


@checks(
    "pan.eq09",
    rules=[Residual("difference", "J(q) q_dot and the motion of the flange, in (9)", high=1e-7)],
)
def differential_kinematics(assumed: Assumed) -> Result:
    """The Jacobian against central differences of the pose."""
    arm = stand_in(assumed["arm"])
    cases = [
        {"x_dot": flange_twist(arm, q, qd), "J": arm.jacobian(q), "q_dot": qd}
        for q, qd in _motions(arm, 100)
    ]
    largest = worst(printed_text("pan.eq09"), cases)
    return Result(
        obtained={"difference": largest},
        caption=(
            "On 100 random motions of the stand-in arm J(q) q_dot equals the velocity of its "
            f"flange by central differences to {largest:.1e}."
        ),
    )


@checks(
    "pan.eq10",
    rules=[
        Residual("on_ellipsoid", "sides of the printed (10) for extreme motions", high=1e-8),
        Bounded("inside", "largest value over unit joint velocities", high=1.0 + 1e-8),
        Residual("axes", "printed axes against singular values of J", high=1e-9),
    ],
)
def velocity_ellipsoid(assumed: Assumed) -> Result:
    """Unit joint velocities fill the ellipsoid; the axes are the singular values."""
    arm, rng = stand_in(assumed["arm"]), np.random.default_rng(SEED)
    J = arm.jacobian(arm.random_configurations(_SAMPLES, rng))[:, :3]
    axes = [
        {"sigma_i": np.linalg.svd(one, compute_uv=False), "J": one, "lambda_i": _eigenvalues}
        for one in J
    ]
    inverse = np.linalg.inv(J @ J.transpose(0, 2, 1))
    velocity = np.einsum("nij,nj->ni", J, _unit(rng.normal(size=(_SAMPLES, 6))))
    inside = np.einsum("ni,nij,nj->n", velocity, inverse, velocity)
    # q_dot = J^T s reaches the surface: it has no part in the null space of J.
    row = _unit(np.einsum("nji,nj->ni", J, rng.normal(size=(_SAMPLES, 3))))
    extreme = zip(np.einsum("nij,nj->ni", J, row), J, strict=True)
    cases = [{"x_dot": v[:, np.newaxis], "J": one} for v, one in extreme]
    return Result(
        obtained={
            "on_ellipsoid": worst(printed_text("pan.eq10"), cases),
            "inside": float(inside.max()),
            "axes": worst(printed_text("pan.eq10", "axes"), axes),
        },
        caption=caption("eq10"),
    )


@checks(
    "pan.eq11",
    rules=[
        Residual("closed_form", "closed form and the printed (11) differ by [m^3]", high=1e-12),
        Residual("tool", "change of omega with the length of the tool [m^3]", high=1e-9),
        Residual("axes_1_4_6", "change of omega with q1, q4 and q6 [m^3]", high=1e-12),
    ],
)
def single_measure(assumed: Assumed) -> Result:
    """sqrt(det(J J^T)) by Pinocchio's and the batch Jacobian, and its closed form."""
    arm, rng = stand_in(assumed["arm"]), np.random.default_rng(SEED)
    q = arm.random_configurations(_SAMPLES, rng)
    closed = closed_form(arm, q)
    cases = [{"omega": w, "J": J} for w, J in zip(closed, arm.jacobian(q), strict=True)]
    gram = gram_matrices(arm.chain, np.eye(3), q, rng.normal(size=(_SAMPLES, 3)), 6)
    with_tool = np.sqrt(np.abs(np.linalg.det(gram)))
    turned = q + rng.uniform(-np.pi, np.pi, q.shape) * [1, 0, 0, 1, 0, 1]
    return Result(
        obtained={
            "closed_form": worst(printed_text("pan.eq11"), cases),
            "tool": float(abs(with_tool - closed).max()),
            "axes_1_4_6": float(abs(arm.manipulability(turned) - closed).max()),
            "largest": float(closed.max()),
        },
        caption=caption("eq11"),
    )


@checks(
    "pan.eq12", rules=[Residual("difference", "X_dot and J Q_dot differ by at most", high=1e-7)]
)
def stacked_kinematics(assumed: Assumed) -> Result:
    """Twists of both carriers, one above the other, against central differences."""
    arm = stand_in(assumed["arm"])
    (q1, qd1), (q2, qd2) = _motions(arm, 2)
    J = block_diag(arm.jacobian(q1), arm.jacobian(q2))
    measured = np.concatenate([flange_twist(arm, q1, qd1), flange_twist(arm, q2, qd2)])
    given = {"X_dot": measured, "J": J, "Q_dot": np.concatenate([qd1, qd2])}
    return Result(
        obtained={"difference": residual(printed_text("pan.eq12"), given)},
        caption=caption("eq12", shape=J.shape),
    )


@checks(
    "pan.eq13",
    rules=[
        Is(
            "stacked",
            "stacked as printed, the vectors of both carriers fit the matrix of (14)",
            value=True,
        ),
        Is(
            "as_printed",
            "with the printed sizes the product (12) is defined",
            value=False,
            role=Role.CONTRADICTS,
        ),
    ],
)
def stacked_sizes(assumed: Assumed) -> Result:
    """Whether the product of (12) exists, by the vectors stacked and by the sizes printed."""
    m = n = 6
    given = {name: np.zeros(m) for name in ("x1_dot", "x2_dot", "q1_dot", "q2_dot")}
    stacked, printed = {}, {}
    for name in ("X_dot", "Q_dot"):
        entry = printed_text("pan.eq13", name)
        stacked[name] = sum(np.size(value(part, given)) for part in entry["stack"])
        printed[name] = _size(entry, m, n)
    matrix = printed_text("pan.eq14", "matrix")
    blocks = {"J_1": np.ones((m, n)), "J_2": np.ones((m, n))}
    rows, columns = block_matrix(matrix, blocks).shape
    fits = (columns, rows) == (stacked["Q_dot"], stacked["X_dot"])
    size = _size(REGISTRY.printed("pan.eq14"), m, n)
    defined = (size[1], size[0]) == (printed["Q_dot"][0], printed["X_dot"][0]) if fits else None
    return Result(
        obtained={"stacked": fits, "as_printed": defined, "sizes": printed, "entries": stacked},
        caption=caption("eq13", rows=rows, columns=columns),
    )


@checks(
    "pan.eq14",
    rules=[
        Residual(
            "difference",
            "printed blocks and the Jacobian of a model of both carriers differ by",
            high=1e-12,
        ),
        Is("size_agrees", "the printed size is that of the Jacobian", value=True),
    ],
)
def generalized_jacobian(assumed: Assumed) -> Result:
    """Block-diagonal Jacobian of two arms, from a model that holds both."""
    arm = stand_in(assumed["arm"])
    both = pin.Model()
    for k in range(2):
        other = arm.model.copy()
        for joint in range(1, other.njoints):
            other.names[joint] += f"_{k}"
        for frame in other.frames:
            frame.name += f"_{k}"
        both = pin.appendModel(both, other, 0, pin.SE3.Identity()) if k else other
    (q1, _), (q2, _) = _motions(arm, 2)
    data, q = both.createData(), np.concatenate([q1, q2])
    frame = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
    joints = (arm.nq, 2 * arm.nq)
    pin.computeJointJacobians(both, data, q)
    J = np.vstack([pin.getJointJacobian(both, data, joint, frame) for joint in joints])
    printed = _size(REGISTRY.printed("pan.eq14"), 6, arm.nq)
    blocks = {"J_1": arm.jacobian(q1), "J_2": arm.jacobian(q2)}
    return Result(
        obtained={
            "difference": block_residual(printed_text("pan.eq14", "matrix"), blocks, J),
            "size_agrees": printed == J.shape,
            "size": printed,
        },
        caption=caption("eq14", shape=J.shape),
    )


@checks(
    "pan.eq15",
    rules=[
        Residual("determinants", "the printed sides of (15) differ by [m^6]", high=1e-12),
        Residual("product", "(15) and the product of the single measures, [m^6]", high=1e-12),
    ],
)
def pair_measure(assumed: Assumed) -> Result:
    """sqrt(det(J J^T)) of the block matrix, factored."""
    arm, rng = stand_in(assumed["arm"]), np.random.default_rng(SEED)
    q1, q2 = arm.random_configurations(_SAMPLES, rng), arm.random_configurations(_SAMPLES, rng)
    J1, J2 = arm.jacobian(q1), arm.jacobian(q2)
    blocks = [block_diag(a, b) for a, b in zip(J1, J2, strict=True)]
    whole = np.array([abs(np.linalg.det(J)) for J in blocks])
    product = tight_measure(closed_form(arm, q1), closed_form(arm, q2))
    cases = [
        {"M_tight": w, "J": J, "J_1": a, "J_2": b}
        for w, J, a, b in zip(product, blocks, J1, J2, strict=True)
    ]
    factored = worst(printed_text("pan.eq15"), cases)
    single = float(abs(whole - product).max())
    return Result(
        obtained={"determinants": factored, "product": single, "largest": float(whole.max())},
        caption=(
            "The determinant of the block matrix factors: M_tight is the product of the "
            f"carriers' single measures, to {single:.1e} m^6. Its unit is m^6."
        ),
    )


def _motions(arm: Arm, count: int) -> list[tuple[np.ndarray, np.ndarray]]:
    """Random configurations with joint velocities of length one."""
    rng = np.random.default_rng(SEED)
    q = arm.random_configurations(count, rng)
    return list(zip(q, _unit(rng.normal(size=q.shape)), strict=True))


def _size(entry: dict[str, str], m: int, n: int) -> tuple[int, int]:
    """Rows and columns as printed, for robots of m by n."""
    given = {"m": m, "n": n}
    return int(value(entry["rows"], given)), int(value(entry["columns"], given))


def _eigenvalues(matrix: np.ndarray) -> np.ndarray:
    """Eigenvalues of a symmetric matrix, the largest first."""
    return np.linalg.eigvalsh(matrix)[::-1]


def _unit(vectors: np.ndarray) -> np.ndarray:
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


@checks(
    "pan.claim_volume",
    rules=[
        Residual("spread", "ratio of volume and printed (11), relative range of", high=1e-6),
    ],
)
def volume_and_measure(assumed: Assumed) -> Result:
    """Volume by the semi-axes over the printed measure, at random configurations."""
    arm, rng = stand_in(assumed["arm"]), np.random.default_rng(SEED)
    J = arm.jacobian(arm.random_configurations(_SAMPLES, rng))
    volumes = unit_ball_volume(6) * np.linalg.svd(J, compute_uv=False).prod(axis=1)
    text = printed_text("pan.eq11").split("=")[-1]
    ratio = volumes / [value(text, {"J": one}) for one in J]
    return Result(
        obtained={"spread": float(np.ptp(ratio) / ratio.mean()), "factor": float(ratio.mean())},
        caption=caption("claim_volume"),
    )
