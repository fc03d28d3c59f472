"""Table 1 and equations (1)-(8): the kinematic chain of the master."""

from __future__ import annotations

from functools import partial

import numpy as np
import pandas as pd
import sympy as sp

from .....arms import load_arm
from .....arms.exact_chain import chain_product, craig_transform, evaluated, same_function
from .....arms.joint_axes import joint_placements
from .....errors import DataFileError
from .....ledger import REGISTRY, Assumed, Bounded, Is, Residual, Result, Role, Rounds
from .....ledger.captions import captions
from .....ledger.formula import parse
from .....tracking import memo
from ...document import READINGS, SEED, master_goal, master_start, reach
from . import printed_chain as chain

checks = partial(REGISTRY.checks, page="xue/kinematics")
caption = captions(__file__)
#: Configurations at which (8) is multiplied out as printed.
_FORMULA = 100
#: A printed "0" would else stand for anything below one half.
_Column = partial(Rounds, tolerance=1e-12, reason="parameters of one chain, exact")


@checks(
    "xue.tab01",
    rules=[
        _Column("d", "column d is that of matrices (2)-(7)", to="d"),
        _Column("alpha", "column alpha is that of the matrices", to="alpha"),
        _Column("a_one_row_up", "column a is theirs, one row too high", to="a"),
        Is(
            "shift_explains",
            "column a under its own header is not that of the matrices, one row down it is",
            value=True,
            role=Role.CONTRADICTS,
        ),
        Bounded(
            "goal_distance",
            "the table read under its own header misses the matrices at the goal by [m]",
            low="last_digit",
            role=Role.CONTRADICTS,
        ),
    ],
)
def table_1(assumed: Assumed) -> Result:
    """Table 1 against the parameters recovered from the matrices, and the two goal poses."""
    parameters, column = chain.printed_parameters(), chain.table_parameters()["a"]
    shifted = [*parameters["a"][1:], 0.0]
    matrices, by_table = goals = flanges(master_goal())
    table = pd.DataFrame(
        {
            "link": list(chain.LINKS),
            "a_printed": REGISTRY.printed("xue.tab01")["a"],
            "a_matrices": parameters["a"],
            "d_matrices": parameters["d"],
            "alpha_matrices": parameters["alpha"],
        }
    )
    return Result(
        obtained={
            **parameters,
            "a_one_row_up": shifted,
            "shift_explains": column == shifted and column != parameters["a"],
            "goal_matrices": matrices.tolist(),
            "goal_table": by_table.tolist(),
            "goal_distance": float(np.linalg.norm(np.subtract(*goals))),
            "reach": {reading: reach(reading) for reading in READINGS},
        },
        table=table,
        caption=caption("tab01"),
    )


@checks(
    "xue.eq01",
    rules=[
        Is("links_with_alpha", "with alpha, (1) gives all six matrices (2)-(7)", value=6),
        Is(
            "is_product",
            "with alpha, (1) is Rx(alpha) Tx(a) Rz(theta) Tz(d) in symbols",
            value=True,
        ),
        Is(
            "only_with_alpha",
            "with the length a inside sine and cosine, as printed, (1) does not",
            value=True,
            role=Role.CONTRADICTS,
        ),
    ],
)
def general_transform(assumed: Assumed) -> Result:
    """Equation (1) as printed and corrected, against the six matrices."""
    literal, corrected = (len(chain.matrices_given(corrected=c)) for c in (False, True))
    return Result(
        obtained={
            "is_product": same_function(
                chain.general_matrix(corrected=True),
                craig_transform(chain.ALPHA, chain.A, chain.THETA, chain.D),
            ),
            "links_as_printed": literal,
            "links_with_alpha": corrected,
            "only_with_alpha": literal < corrected == len(chain.LINKS),
        },
        caption=caption("eq01"),
    )


def _register_link(k: int) -> None:
    """Equations (2)-(7): one printed link transform each."""

    @checks(
        f"xue.eq{k + 1:02d}",
        rules=[
            Is("equals_eq_1", "equals (1), corrected, for this link's parameters", value=True),
            Is("equals_dh", "equals Rx(alpha) Tx(a) Rz(theta) Tz(d) of the arm", value=True),
            Residual("pinocchio", "largest difference to Pinocchio's placement", high=1e-12),
        ],
    )
    def link_transform(assumed: Assumed) -> Result:
        arm, printed = load_arm("es165d"), chain.link_matrix(k)
        return Result(
            obtained={
                "equals_eq_1": same_function(chain.substituted(k, corrected=True), printed),
                "equals_dh": same_function(arm.link_transforms()[k - 1], printed),
                "pinocchio": _largest_difference_to_pinocchio(k),
            },
            caption=caption("link_transform", number=k + 1),
        )


for _k in chain.LINKS:
    _register_link(_k)


@checks(
    "xue.eq08",
    rules=[
        Is("product_is_dh", "product of the printed matrices is the arm's T(q)", value=True),
        Is(
            "names", "the printed matrix names twelve entries over the last row of T(q)", value=True
        ),
        Residual(
            "formula", "(8) as printed, with matrices (2)-(7) put in, to Pinocchio", high=1e-12
        ),
        Residual("pinocchio", "largest difference to Pinocchio", high=1e-12),
        Residual("kernel", "largest difference to the batch kernel", high=1e-12),
        Residual("orthonormal", "n, o, a are orthonormal to", high=1e-12),
    ],
)
def end_effector_pose(assumed: Assumed) -> Result:
    """Equation (8): the product in symbols, in Pinocchio and in the batch kernel."""
    arm = load_arm("es165d")
    q = arm.random_configurations(1000, np.random.default_rng(SEED))
    symbolic = symbolic_poses(q)
    pinocchio = np.array([arm.fk(row) for row in q])
    rotations = symbolic[:, :3, :3]
    identity = rotations @ rotations.transpose(0, 2, 1) - np.eye(3)
    start, goal = (arm.fk(pose)[:3, 3] for pose in (master_start(), master_goal()))
    return Result(
        obtained={
            "product_is_dh": same_function(symbolic_pose(), arm.symbolic_fk()),
            "names": _names_entries(REGISTRY.printed("xue.eq08")["matrix"]),
            "formula": float(abs(printed_product(q[:_FORMULA]) - pinocchio[:_FORMULA]).max()),
            "pinocchio": float(abs(symbolic - pinocchio).max()),
            "kernel": float(abs(symbolic - arm.fk(q)).max()),
            "orthonormal": float(abs(identity).max()),
            "tcp_start": start.tolist(),
            "tcp_goal": goal.tolist(),
        },
        caption=caption("eq08", count=len(q)),
    )


@memo()
def symbolic_pose() -> sp.Matrix:
    """T(q) as the product of the printed matrices (2)-(7)."""
    return chain_product([chain.link_matrix(k) for k in chain.LINKS])


def _names_entries(matrix: list[list[str]]) -> bool:
    """Whether twelve different names stand above the last row of a homogeneous transform."""
    names = [cell for row in matrix[:3] for cell in row]
    last = [sp.sympify(cell) for cell in matrix[3]]
    return (
        len(set(names)) == len(names) == 12
        and all(name.replace("_", "").isalpha() for name in names)
        and last == list(symbolic_pose().row(3))
    )


def symbolic_poses(q: np.ndarray) -> np.ndarray:
    """The printed product evaluated at configurations (N, 6), shape (N, 4, 4)."""
    return evaluated(symbolic_pose(), [chain.joint_variable(k) for k in chain.LINKS], q)


def flanges(q: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Flange at angles (6,) by the matrices and by Table 1 under its own headers, (3,) each [m]."""
    return symbolic_poses(q[np.newaxis])[0, :3, 3], chain.table_pose(q)[:3, 3]


def printed_product(q: np.ndarray) -> np.ndarray:
    """Right side of (8) at configurations (N, 6), (N, 4, 4); NaN if it asks for other factors."""
    links = {
        k: sp.lambdify(chain.joint_variable(k), chain.link_matrix(k), "numpy") for k in chain.LINKS
    }
    formula = parse(REGISTRY.printed("xue.eq08")["formula"])
    found = []
    for row in q:
        given = {f"T_{k - 1}{k}": link(row[k - 1]) for k, link in links.items()}
        try:
            found.append(np.broadcast_to(formula.value(1, given), (4, 4)))
        except (DataFileError, IndexError, ValueError):
            found.append(np.full((4, 4), np.nan))
    return np.array(found)


def _largest_difference_to_pinocchio(k: int) -> float:
    """Printed link transform against the placement of joint k in the model, over a turn."""
    angles = np.linspace(-np.pi, np.pi, 37)
    printed = evaluated(chain.link_matrix(k), [chain.joint_variable(k)], angles[:, np.newaxis])
    return float(abs(joint_placements(load_arm("es165d"), k, angles) - printed).max())
