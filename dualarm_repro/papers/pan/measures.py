"""Equations (9)-(16) of `pan`: manipulability of one robot, of the carriers, of all three."""

from __future__ import annotations

from functools import partial

import numpy as np

from ...ledger import REGISTRY, Assumed, Bounded, Is, Result, Role
from ...view.ellipsoids import beta_figure
from ...welding import Objective, closed_form, inverse_volumes
from ...welding.ellipsoid import (
    ellipsoid_volume,
    gram_matrices,
    intersection_volume,
    intersection_volume_monte_carlo,
)
from ...welding.manipulability import tight_measure
from .coordination import at_display
from .optimum import optimum
from .scenario import SEED, Job, Measure, stand_in

checks = partial(REGISTRY.checks, page="pan/measure")
_SAMPLES = 500
_STEP = 1e-6


@checks(
    "pan.eq09",
    rules=[
        Bounded(
            key="difference", high=1e-7, label="J(q) q_dot and the motion of the flange differ by"
        )
    ],
    samples=32,
)
def differential_kinematics(assumed: Assumed) -> Result:
    """The Jacobian against central differences of the pose."""
    arm = stand_in(assumed["arm"])
    worst = float(np.max([_jacobian_error(arm, q, qd) for q, qd in _motions(arm, 100)]))
    return Result(
        obtained={"difference": worst},
        caption=(
            "On 100 random motions of the stand-in arm J(q) q_dot equals the velocity of its "
            f"flange by central differences to {worst:.1e}."
        ),
    )


@checks(
    "pan.eq10",
    rules=[
        Bounded(
            key="on_ellipsoid", high=1e-8, label="x_dot^T (J J^T)^-1 x_dot - 1 of extreme motions"
        ),
        Bounded(key="inside", high=1.0 + 1e-8, label="largest value over unit joint velocities"),
        Bounded(
            key="axes", high=1e-9, label="sqrt of eigenvalues of J J^T against singular values"
        ),
    ],
    samples=32,
)
def velocity_ellipsoid(assumed: Assumed) -> Result:
    """Unit joint velocities fill the ellipsoid; the axes are the singular values."""
    arm, rng = stand_in(assumed["arm"]), np.random.default_rng(SEED)
    J = arm.jacobian(arm.random_configurations(_SAMPLES, rng))[:, :3]
    gram = J @ J.transpose(0, 2, 1)
    inverse = np.linalg.inv(gram)
    eigen = np.sqrt(np.linalg.eigvalsh(gram))[:, ::-1]
    axes = float(abs(eigen - np.linalg.svd(J, compute_uv=False)).max())
    velocity = np.einsum("nij,nj->ni", J, _unit(rng.normal(size=(_SAMPLES, 6))))
    inside = float(np.einsum("ni,nij,nj->n", velocity, inverse, velocity).max())
    # q_dot = J^T s reaches the surface: it has no part in the null space of J.
    row = _unit(np.einsum("nji,nj->ni", J, rng.normal(size=(_SAMPLES, 3))))
    extreme = np.einsum("nij,nj->ni", J, row)
    surface = np.einsum("ni,nij,nj->n", extreme, inverse, extreme)
    return Result(
        obtained={"on_ellipsoid": float(abs(surface - 1).max()), "inside": inside, "axes": axes},
        caption=(
            "Unit joint velocities without a part in the null space of J map onto the ellipsoid "
            f"(residual {abs(surface - 1).max():.1e}), all others into it. The unit sphere of "
            "joint velocities fills it only where J has full row rank. Its axes are the singular "
            "values of J, which for a matrix that is not symmetric are no eigenvalues."
        ),
    )


@checks(
    "pan.eq11",
    rules=[
        Bounded(
            key="closed_form", high=1e-12, label="closed form and sqrt(det(J J^T)) differ by [m^3]"
        ),
        Bounded(key="tool", high=1e-12, label="change of omega with the length of the tool [m^3]"),
        Bounded(key="axes_1_4_6", high=1e-12, label="change of omega with q1, q4 and q6 [m^3]"),
    ],
    samples=32,
)
def single_measure(assumed: Assumed) -> Result:
    """sqrt(det(J J^T)) by Pinocchio's and the batch Jacobian, and its closed form."""
    arm, rng = stand_in(assumed["arm"]), np.random.default_rng(SEED)
    q = arm.random_configurations(_SAMPLES, rng)
    closed = closed_form(arm, q)
    difference = float(abs(closed - abs(np.linalg.det(arm.jacobian(q)))).max())
    levers = rng.normal(size=(_SAMPLES, 3))
    gram = gram_matrices(arm.chain, np.eye(3), q, levers, 6)
    tool = float(abs(np.sqrt(np.abs(np.linalg.det(gram))) - closed).max())
    turned = q + rng.uniform(-np.pi, np.pi, q.shape) * [1, 0, 0, 1, 0, 1]
    others = float(abs(arm.manipulability(turned) - closed).max())
    return Result(
        obtained={
            "closed_form": difference,
            "tool": tool,
            "axes_1_4_6": others,
            "largest": float(closed.max()),
        },
        caption=(
            "For six joints with a spherical wrist omega factors into link lengths, the sine of "
            "the elbow angle, the distance of the wrist centre from axis 1 and the sine of q5; "
            f"this equals the determinant to {difference:.1e} m^3. Neither the tool nor joints 1, "
            "4 and 6 have a part in it. The unit is m^3, since three of the six rows are in "
            "metres."
        ),
    )


@checks(
    "pan.eq12",
    rules=[Bounded(key="difference", high=1e-7, label="X_dot and J Q_dot differ by at most")],
    samples=32,
)
def stacked_kinematics(assumed: Assumed) -> Result:
    """Twists of both carriers, one above the other, against central differences."""
    arm = stand_in(assumed["arm"])
    (q1, qd1), (q2, qd2) = _motions(arm, 2)
    J = _block(arm.jacobian(q1), arm.jacobian(q2))
    stacked = J @ np.concatenate([qd1, qd2])
    measured = np.concatenate([_flange_twist(arm, q1, qd1), _flange_twist(arm, q2, qd2)])
    difference = float(abs(stacked - measured).max())
    return Result(
        obtained={"difference": difference},
        caption=(
            f"The block matrix maps the {J.shape[1]} joint velocities of both carriers to the "
            f"{J.shape[0]} entries of their twists, as central differences confirm to "
            f"{difference:.1e}."
        ),
    )


@checks(
    "pan.eq13",
    rules=[
        Is(
            key="column_vectors",
            value=True,
            label="with vectors of 2m and 2n entries (12) is defined",
        ),
        Is(
            key="as_printed",
            value=False,
            role=Role.CONTRADICTS,
            label="with the printed sizes 2 x m and 2 x n the product (12) is defined",
        ),
    ],
)
def stacked_sizes(assumed: Assumed) -> Result:
    """Whether the product J Q_dot exists for either size."""
    m = n = 6
    J = np.zeros((2 * m, 2 * n))
    sizes = {"as_printed": ((2, n), (2, m)), "column_vectors": ((2 * n,), (2 * m,))}
    found = {name: _defined(J, *shapes) for name, shapes in sizes.items()}
    return Result(
        obtained=found,
        caption=(
            "In R^(2 x m) and R^(2 x n), as printed, the stacked velocities are matrices that "
            "the generalized Jacobian cannot be multiplied with; as vectors of 2m and 2n entries "
            "they fit."
        ),
    )


@checks(
    "pan.eq14",
    rules=[
        Is(key="shape", value=[12, 12], label="size for two arms of six joints"),
        Bounded(key="off_diagonal", high=0.0, label="largest entry outside the two blocks"),
    ],
    samples=32,
)
def generalized_jacobian(assumed: Assumed) -> Result:
    """Block-diagonal Jacobian of two arms, from a model that holds both."""
    import pinocchio as pin

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
    outside = max(abs(J[:6, 6:]).max(), abs(J[6:, :6]).max())
    return Result(
        obtained={"shape": list(J.shape), "off_diagonal": float(outside)},
        caption=(
            f"In one model of both carriers the Jacobian is {J.shape[0]} x {J.shape[1]} and zero "
            "outside its two blocks. The printed size 12 x (m + n) agrees because m = n = 6; in "
            "general it is 2m x 2n."
        ),
    )


@checks(
    "pan.eq15",
    rules=[
        Bounded(key="determinants", high=1e-12, label="both sides of (15) differ by [m^6]"),
        Bounded(
            key="product", high=1e-12, label="(15) and the product of the single measures, [m^6]"
        ),
    ],
    samples=32,
)
def pair_measure(assumed: Assumed) -> Result:
    """sqrt(det(J J^T)) of the block matrix, factored."""
    arm, rng = stand_in(assumed["arm"]), np.random.default_rng(SEED)
    q1, q2 = arm.random_configurations(_SAMPLES, rng), arm.random_configurations(_SAMPLES, rng)
    J1, J2 = arm.jacobian(q1), arm.jacobian(q2)
    whole = np.array([abs(np.linalg.det(_block(a, b))) for a, b in zip(J1, J2, strict=True)])
    gram1, gram2 = (np.abs(np.linalg.det(J)) ** 2 for J in (J1, J2))
    product = tight_measure(closed_form(arm, q1), closed_form(arm, q2))
    factored = float(abs(whole - np.sqrt(gram1 * gram2)).max())
    single = float(abs(whole - product).max())
    return Result(
        obtained={"determinants": factored, "product": single, "largest": float(whole.max())},
        caption=(
            "The determinant of the block matrix factors: M_tight is the product of the "
            f"carriers' single measures, to {single:.1e} m^6. Its unit is m^6."
        ),
    )


@checks(
    "pan.eq16",
    rules=[
        Bounded(
            key="between",
            high=1e-12,
            label="MMR leaves the interval between M_tight and M_loose by",
        ),
        Bounded(
            key="moved_by_unit",
            low=0.05,
            role=Role.CONTRADICTS,
            label="with millimetres instead of metres the best position moves by [m]",
        ),
    ],
)
def system_measure(assumed: Assumed) -> Result:
    """The weighted mean at one position, and its best position in metres and in millimetres."""
    job, measure = Job.of(assumed), Measure.of(assumed)
    _, jobs, _ = at_display(assumed)
    found = job.placement(measure.reading()).measures(jobs)
    low, high = np.minimum(found.tight, found.loose), np.maximum(found.tight, found.loose)
    between = float(np.maximum(low - found.system, found.system - high).max())
    box = tuple(tuple(side) for side in assumed["search_box"])
    best = {}
    for unit in ("m", "mm"):
        changed = Measure(**{**vars(measure), "length_unit": unit})
        best[unit] = np.abs(optimum(job, changed, box).position)
    moved = float(np.linalg.norm(best["m"] - best["mm"]))
    return Result(
        obtained={
            "between": max(between, 0.0),
            "moved_by_unit": moved,
            "best_in_metres": best["m"].tolist(),
            "best_in_millimetres": best["mm"].tolist(),
        },
        caption=(
            "(16) is a weighted mean of a product of two measures, in m^6, and of one, in m^3. "
            "Which position is best therefore depends on the unit of length: it moves by "
            f"{moved:.2f} m when metres become millimetres, with everything else the same (mirror "
            "images counted as one)."
        ),
    )


@checks(
    "pan.claim_beta_rule",
    samples=32,
    rules=[
        Bounded(key="cancels", high=1e-12, label="(16) with and without V_int differs by at most"),
        Is(
            key="larger_ratio_larger_weight",
            value=True,
            label="the larger ratio has the larger weight",
        ),
        Bounded(
            key="monte_carlo",
            high=5.0,
            label="quadrature and Monte Carlo of V_int differ by [sigma]",
        ),
    ],
)
def weights(assumed: Assumed) -> Result:
    """Volumes, their intersection, the weights, and (16) with and without the intersection."""
    cell, jobs, _ = at_display(assumed)
    measure = Measure.of(assumed).reading()
    grams = np.stack(
        [
            gram_matrices(
                arm.chain, cell.bases[k][:3, :3].copy(), jobs.q[0, k], cell.lever_arms[k], 3
            )
            for k, arm in enumerate(cell.arms)
        ]
    )
    volumes = ellipsoid_volume(grams)
    common = np.array([intersection_volume(grams[:, n], 2000) for n in range(cell.count)])
    inverse = inverse_volumes(cell, jobs.q, measure.space, measure.carriers)
    reading = Objective()
    without = reading.measures(jobs.w, inverse)
    within = reading.measures(jobs.w, inverse * common)
    cancels = float(abs(without.system - within.system).max())
    sampled, error = intersection_volume_monte_carlo(
        grams[:, 0], 20_000, np.random.default_rng(SEED)
    )
    exact = intersection_volume(grams[:, 0])
    share = without.beta_tight / (without.beta_tight + without.beta_loose)
    order = np.argsort(common / volumes, axis=0)
    ordered = bool((np.argsort(1.0 / volumes, axis=0) == order).all())
    return Result(
        obtained={
            "cancels": cancels,
            "larger_ratio_larger_weight": ordered,
            "monte_carlo": abs(exact - sampled) / error,
            "volumes": volumes[:, 0].tolist(),
            "intersection": exact,
            "mean_share_of_carriers": float(share.mean()),
        },
        caption=(
            "At the first seam point the ellipsoids have volumes "
            f"{', '.join(f'{v:.2f}' for v in volumes[:, 0])} and a common part of {exact:.2f} "
            f"(quadrature; Monte Carlo {sampled:.2f} +- {error:.2f}). One intersection stands in "
            f"every ratio and cancels: (16) with and without it agrees to {cancels:.1e}. What "
            "remains are inverse volumes, which give the less mobile group the larger say: the "
            f"carriers have {share.mean():.0%} of the weight on average."
        ),
        alt="Volumes of three ellipsoids and of their common part, and weights along the seam.",
        figure=lambda: beta_figure(volumes, common, share[0]),
    )


def _motions(arm: object, count: int) -> list[tuple[np.ndarray, np.ndarray]]:
    """Random configurations with joint velocities of length one."""
    rng = np.random.default_rng(SEED)
    q = arm.random_configurations(count, rng)
    return list(zip(q, _unit(rng.normal(size=q.shape)), strict=True))


def _flange_twist(arm: object, q: np.ndarray, qd: np.ndarray) -> np.ndarray:
    """Twist of the flange by central differences of its pose."""
    import pinocchio as pin

    ahead, behind = (arm.fk(q + sign * _STEP * qd) for sign in (1, -1))
    v = (ahead[:3, 3] - behind[:3, 3]) / (2 * _STEP)
    return np.concatenate([v, pin.log3(ahead[:3, :3] @ behind[:3, :3].T) / (2 * _STEP)])


def _jacobian_error(arm: object, q: np.ndarray, qd: np.ndarray) -> float:
    return float(abs(arm.jacobian(q) @ qd - _flange_twist(arm, q, qd)).max())


def _block(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """diag(J_1, J_2)."""
    whole = np.zeros((len(first) + len(second), first.shape[1] + second.shape[1]))
    whole[: len(first), : first.shape[1]] = first
    whole[len(first) :, first.shape[1] :] = second
    return whole


def _defined(J: np.ndarray, velocity: tuple[int, ...], result: tuple[int, ...]) -> bool:
    """Whether J times an array of one size is an array of the other."""
    try:
        return (J @ np.zeros(velocity)).shape == result
    except ValueError:
        return False


def _unit(vectors: np.ndarray) -> np.ndarray:
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)
