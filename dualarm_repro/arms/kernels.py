"""Kinematics of one serial chain for many configurations, by code generated for it.

Straight-line programs (:mod:`.codegen.recursions`) are compiled once for all chains of one
structure; where numba is switched off the same lines run on numpy arrays.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import numpy as np

from .chain import Chain, SlidingChain
from .codegen.generated import Carried, Generated, generated
from .codegen.structure import Constants, structure_of


class Kinematics:
    """T(q) = C_0 M(q_1) C_1 ... M(q_n) C_n and what follows from it, for rows of q (N, n) [rad, m].

    Attributes
    ----------
    chain : Chain or SlidingChain
    constants : ndarray (K,)
        Constants of the chain that are neither 0 nor 1.
    """

    def __init__(self, chain: Chain | SlidingChain) -> None:
        self.chain = chain
        named = Constants()
        self._structure = structure_of(chain, named)
        self.constants = np.array(named.values)

    def __reduce__(self) -> tuple[type[Kinematics], tuple[Chain | SlidingChain]]:
        return Kinematics, (self.chain,)  # code is not pickled, and shared again

    def poses(self, q: np.ndarray) -> np.ndarray:
        """T(q) -> (N, 4, 4) [m]."""
        return self.pose.rows(q, self.constants, (4, 4))

    def positions(self, q: np.ndarray) -> np.ndarray:
        """Position of the flange -> (N, 3) [m]."""
        return self.position.rows(q, self.constants, (3,))

    def frame_origins(self, q: np.ndarray) -> np.ndarray:
        """Origins of the joint frames and of the flange -> (N, n+1, 3) [m]."""
        return self.origins.rows(q, self.constants, (q.shape[1] + 1, 3))

    def jacobians(self, q: np.ndarray) -> np.ndarray:
        """Columns [z_j x (p - o_j); z_j] in base axes at the flange, of a sliding joint [z_j; 0],
        -> (N, 6, n)."""
        return self.jacobian.rows(q, self.constants, (6, q.shape[1]))

    def manipulabilities(self, q: np.ndarray) -> np.ndarray:
        """w = sqrt(det(J J^T)) -> (N,)."""
        return self.manipulability.rows(q, self.constants, (1,))[:, 0]

    def points(self, q: np.ndarray, joint: Sequence[int], local: np.ndarray) -> np.ndarray:
        """Points carried by the joints, as control points or ends of capsules -> (N, P, 3) [m].

        Parameters
        ----------
        joint : (P,) of int
            The joint whose frame carries each point, from 1; 0 is the base. z of the frame is the
            axis of the joint, its origin that of the model.
        local : (P, 3)
            The points in these frames [m].
        """
        named = Constants()
        structure = structure_of(self.chain, named)
        scale = float(np.abs(local).max(initial=0.0))
        carried: Carried = tuple(
            (int(j), named.vector(point, scale)) for j, point in zip(joint, local, strict=True)
        )
        found = generated("points", structure, carried)
        return found.rows(q, np.array(named.values), (len(carried), 3))

    @cached_property
    def pose(self) -> Generated:
        """The code behind :meth:`poses`, and so on."""
        return generated("pose", self._structure)

    @cached_property
    def position(self) -> Generated:
        """The code behind :meth:`positions`."""
        return generated("position", self._structure)

    @cached_property
    def origins(self) -> Generated:
        """The code behind :meth:`frame_origins`."""
        return generated("origins", self._structure)

    @cached_property
    def jacobian(self) -> Generated:
        """The code behind :meth:`jacobians`."""
        return generated("jacobian", self._structure)

    @cached_property
    def manipulability(self) -> Generated:
        """The code behind :meth:`manipulabilities`."""
        return generated("manipulability", self._structure)
