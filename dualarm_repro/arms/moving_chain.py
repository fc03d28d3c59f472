"""Where the flange and the joints of an arm are and how they move, for one posture or many."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pinocchio as pin
from numpy.typing import ArrayLike

from ..errors import UnsupportedArmError
from .chain import Chain, SlidingChain
from .codegen.generated import Compiled, nothing
from .joint_space import JointSpace
from .kernels import Kinematics

# One configuration as the compiled code takes it; what differs is checked and converted first.
_ARRAY, _ROW, _FLOAT, _POSE, _empty = np.ndarray, (8,), np.dtype(np.float64), (4, 4), np.empty
_CODE = ("_one_pose", "_one_jacobian", "_one_manipulability")


class MovingChain(JointSpace):
    """T(q), J(q) and w(q) of a serial chain by code generated for it, see :mod:`.codegen`.

    Attributes
    ----------
    model : pinocchio.Model
        Names the joints.
    """

    model: pin.Model
    _kinematics: Kinematics
    _one_pose: tuple[Compiled, np.ndarray]
    _one_jacobian: tuple[Compiled, np.ndarray]
    _one_manipulability: tuple[Compiled, np.ndarray]

    @property
    def chain(self) -> Chain:
        """The constant transforms of the batch kernels.

        Raises
        ------
        UnsupportedArmError
            A joint slides, which whoever asks for this chain does not know.
        """
        if isinstance(self._kinematics.chain, SlidingChain):
            name = self.model.names[1 + int(np.argmax(self._kinematics.chain.slides))]
            raise UnsupportedArmError(
                f"arm {self.name}: joint {name} is prismatic, and this method knows joints that "
                f"turn only: lock={{{name!r}: ...}} fixes it"
            )
        return self._kinematics.chain

    @property
    def motion(self) -> Chain | SlidingChain:
        """The constant transforms, whether joints slide or not."""
        return self._kinematics.chain

    @property
    def stretched(self) -> float:
        """Length of the way from the base over all joint origins to the flange, with every
        prismatic joint out to its farther limit [m]."""
        steps = np.linalg.norm(self._kinematics.chain.translation, axis=1).sum()
        slides = self.slides
        return float(steps + np.maximum(abs(self.lower[slides]), abs(self.upper[slides])).sum())

    def fk(self, q: ArrayLike) -> np.ndarray:
        """Pose T(q) of the flange in the base frame.

        Parameters
        ----------
        q : (nq,) or (N, nq) [rad, m]

        Returns
        -------
        ndarray (4, 4) or (N, 4, 4)
            Translation in metres.

        Raises
        ------
        ConfigurationError
            Wrong shape, NaN or infinity.
        """
        if type(q) is _ARRAY and q.strides == _ROW and q.dtype is _FLOAT:
            run, constants = self._one_pose
            if run(q, constants, one := _empty(_POSE)):
                return one
        q, known = self.configurations(q), self._kinematics
        self._one_pose = known.pose.compiled, known.constants
        return self._shaped(q, self._kinematics.poses)

    def positions(self, q: ArrayLike) -> np.ndarray:
        """Flange position p(q) in the base frame [m], (nq,) -> (3,) or (N, nq) -> (N, 3)."""
        return self._shaped(self.configurations(q), self._kinematics.positions)

    def joint_positions(self, q: ArrayLike) -> np.ndarray:
        """Origins of the joint frames 1 ... nq and of the flange in the base frame [m].

        The frame of a joint is the one its variable turns: link frame i of a modified DH table,
        link frame i-1 of a standard one.

        Returns
        -------
        ndarray (nq + 1, 3) or (N, nq + 1, 3)
        """
        return self._shaped(self.configurations(q), self._kinematics.frame_origins)

    def jacobian(self, q: ArrayLike) -> np.ndarray:
        """Geometric Jacobian [v; omega] = J(q) dq at the flange origin, axes of the base.

        Returns
        -------
        ndarray (6, nv) or (N, 6, nv)
            Rows 0-2 in metres per radian, rows 3-5 without unit; of a prismatic joint rows 0-2
            without unit, rows 3-5 zero.

        Raises
        ------
        ConfigurationError
            Wrong shape, NaN or infinity.
        """
        if type(q) is _ARRAY and q.strides == _ROW and q.dtype is _FLOAT:
            run, constants = self._one_jacobian
            if run(q, constants, one := _empty((6, self.nq))):
                return one
        q, known = self.configurations(q), self._kinematics
        self._one_jacobian = known.jacobian.compiled, known.constants
        return self._shaped(q, self._kinematics.jacobians)

    def manipulability(self, q: ArrayLike) -> float | np.ndarray:
        """Yoshikawa's measure w(q) = sqrt(det(J J^T)).

        T. Yoshikawa, Manipulability of robotic mechanisms, IJRR 4(2), 1985. In m^3 for six joints.

        Returns
        -------
        float or ndarray (N,)
        """
        if type(q) is _ARRAY and q.strides == _ROW and q.dtype is _FLOAT:
            run, constants = self._one_manipulability
            if run(q, constants, one := _empty((1, 1))):
                return float(one[0, 0])
        q, known = self.configurations(q), self._kinematics
        self._one_manipulability = known.manipulability.compiled, known.constants
        w = self._kinematics.manipulabilities(np.atleast_2d(q))
        return w if q.ndim == 2 else float(w[0])

    def _move_by(self, kinematics: Kinematics) -> None:
        """Take over the kinematics, and forget what was derived from others."""
        self._kinematics = kinematics
        self.__dict__.pop("_wrist_geometry", None)
        # Compiled code for one configuration, straight at hand: a call takes less than 1 us. The
        # first call puts it there.
        unknown: tuple[Compiled, np.ndarray] = nothing, kinematics.constants
        self._one_pose = self._one_jacobian = self._one_manipulability = unknown

    def __getstate__(self) -> dict[str, object]:
        unknown = nothing, self._kinematics.constants  # machine code stays in its process
        return self.__dict__ | dict.fromkeys(_CODE, unknown)

    def _shaped(self, q: np.ndarray, rows: Callable[[np.ndarray], np.ndarray]) -> np.ndarray:
        """Values of rows for one configuration (nq,) or for many (N, nq)."""
        return rows(q) if q.ndim == 2 else rows(q[np.newaxis])[0]
