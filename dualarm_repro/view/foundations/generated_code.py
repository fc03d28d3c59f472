"""That the generated code of an arm is the derived kinematics: it is run on symbols."""

from __future__ import annotations

import numpy as np
import sympy as sp

from ...arms import Arm
from ...arms.codegen.generated import generated
from ...arms.codegen.structure import Constants, structure_of
from ...arms.dh import joint_symbols
from ...errors import UnsupportedArmError


def pose_code(arm: Arm) -> str:
    """The statements that compute T(q) of the arm, row by row, of sums and products."""
    return generated("pose", structure_of(arm.chain, Constants())).source


def symbolic_run(arm: Arm) -> sp.Matrix:
    """T(q) (4, 4) of a DH arm as its generated code gives it for exact lengths and symbols q.

    Raises
    ------
    UnsupportedArmError
        The arm is not given by a DH table, or a constant of the code is not the exact one.
    """
    named = Constants()
    structure = structure_of(arm.chain, named)
    exact: dict[str, sp.Expr] = {}
    for index, constant in enumerate(exact_constants(arm)):
        rotation, translation = structure.rotations[index], structure.translations[index]
        for r in range(3):
            for term, value in zip((*rotation[r], translation[r]), constant[r, :], strict=True):
                if term.name:
                    exact[term.name] = value
                elif value != term.sign:
                    raise UnsupportedArmError(f"arm {arm.name}: {value} was taken for {term.text}")
    constants = [exact[f"k{i}"] for i in range(len(named.values))]
    off = np.abs(np.array(constants, dtype=float) - named.values).max(initial=0.0)
    if off > 1e-15:
        raise UnsupportedArmError(f"arm {arm.name}: a constant of the code is off by {off:g}")
    q = joint_symbols(arm.nq)
    run = generated("pose", structure).function({})
    entries = run([sp.sin(x) for x in q], [sp.cos(x) for x in q], q, constants)
    return sp.Matrix(4, 4, [sp.nsimplify(entry) for entry in entries])


def is_derived(arm: Arm) -> bool:
    """Whether the code, run on symbols, is the product of the link transforms, exactly."""
    difference = symbolic_run(arm) - arm.symbolic_fk()
    return difference.applyfunc(lambda x: sp.expand(x, trig=True)).is_zero_matrix is True


def compiled_difference(arm: Arm, count: int, seed: int) -> float:
    """max |T(q) - T'(q)| over entries and random configurations: compiled code, lines on arrays."""
    named = Constants()
    code = generated("pose", structure_of(arm.chain, named))
    q = arm.random_configurations(count, np.random.default_rng(seed))
    constants = np.array(named.values)
    compiled = code.rows(q, constants, (code.size,))
    return float(np.abs(compiled - code.by_numpy(q, constants)).max())


def exact_constants(arm: Arm) -> list[sp.Matrix]:
    """C_0 ... C_n of T(q) = C_0 Rz(q_1) C_1 ... Rz(q_n) C_n of a DH arm, exact.

    A link transform of a modified table is A Rz(q), its last two columns are free of q; one of a
    standard table is Rz(offset) Rz(q) B, where B leaves the x axis as it is.
    """
    links, variables = arm.link_transforms(), joint_symbols(arm.nq)
    pairs = list(zip(links[: arm.nq], variables, strict=True))
    modified = not any(link[:, 2:].has(q) for link, q in pairs)
    constants = [sp.eye(4)]
    for link, q in pairs:
        before, after = link.subs(q, 0), sp.eye(4)
        if not modified:
            cosine, sine = before[0, 0], before[1, 0]
            turn = sp.diag(sp.Matrix([[cosine, -sine], [sine, cosine]]), 1, 1)
            before, after = turn, turn.T * before
        constants[-1] = constants[-1] * before
        constants.append(after)
    for flange in links[arm.nq :]:
        constants[-1] = constants[-1] * flange
    return constants
