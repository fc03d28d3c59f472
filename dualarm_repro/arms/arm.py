"""One arm: its Pinocchio model, its capsules and its kinematics for one or many configurations."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from copy import copy
from functools import cached_property, partial
from types import ModuleType

import numpy as np
import pinocchio as pin
import sympy as sp
from numpy.typing import ArrayLike

from ..arguments import checked
from ..errors import ConfigurationError, UnsupportedArmError
from . import dh, kernels, sliding
from .capsules import capsule_geometry
from .chain import chain_of
from .dh_model import FLANGE, build_model
from .exclusions import Exclusion
from .joint_space import JointSpace
from .joint_type import JointType
from .kernels import Chain
from .poses import check_poses
from .robot_file import DHRobot
from .shapes import Shapes
from .sliding import SlidingChain
from .trigonometry import FAR
from .wrist_geometry import WristGeometry, wrist_geometry
from .wrist_ik import distinct, inverse_kinematics


class Arm(JointSpace):
    """A serial arm of joints that turn (revolute, continuous) or slide (prismatic).

    The unit of a joint is rad, of a prismatic joint m; so are those of its limits and its speed.

    Attributes
    ----------
    name, title : str
    model : pinocchio.Model
        Reduced to the joints between base and flange; nq = nv.
    nq : int
    types : tuple of JointType
        How each joint moves.
    lower, upper, velocity_limit : ndarray (nq,)
        Joint limits [rad, m], infinite for a continuous joint; speed limits [rad/s, m/s].
    remarks : tuple of str
        What its file says that is not represented and does no harm: links that are seen but have
        no collision shape, words of the parser.
    """

    def __init__(
        self,
        name: str,
        title: str,
        model: pin.Model,
        flange: int,
        geometry: Callable[[], pin.GeometryModel],
        robot: DHRobot | None = None,
        types: Sequence[JointType] | None = None,
        exclusions: Callable[[], tuple[Exclusion, ...] | None] | None = None,
        hulls: Callable[[], Mapping[str, np.ndarray]] | None = None,
        solids: Callable[[], pin.GeometryModel] | None = None,
        remarks: Sequence[str] = (),
    ) -> None:
        super().__init__(
            name,
            types or (JointType.REVOLUTE,) * model.nq,
            model.lowerPositionLimit.copy(),
            model.upperPositionLimit.copy(),
        )
        self.title, self.model = title, model
        self._flange = flange
        self._build_geometry, self._robot = geometry, robot
        self._find_exclusions, self._read_solids = exclusions, solids
        self._find_hulls = hulls
        self._data = model.createData()
        self._chain = chain_of(name, model, self._flange)
        self.remarks = tuple(remarks)
        self.velocity_limit = model.velocityLimit.copy()

    @classmethod
    @checked
    def from_dh(cls, name: str, robot: DHRobot, shapes: Shapes | None = None) -> Arm:
        """Arm of a DH table; one without capsules has shapes only if they are to be ``none``."""
        capsules = partial(capsule_geometry, robot.capsules)
        if not robot.capsules and shapes is not Shapes.NONE:
            capsules = partial(_without_shapes, name)
        elif shapes is Shapes.NONE:
            capsules = partial(capsule_geometry, ())
        model = build_model(robot, name)
        return cls(name, robot.title, model, model.getFrameId(FLANGE), capsules, robot)

    @checked
    def reshaped(
        self,
        geometry: Callable[[], pin.GeometryModel],
        name: str | None = None,
        flange: tuple[str, pin.SE3] | None = None,
        exclusions: Callable[[], tuple[Exclusion, ...] | None] | None = None,
    ) -> Arm:
        """The same arm with other capsules, built when they are first asked for.

        Parameters
        ----------
        flange : (str, pinocchio.SE3), optional
            Name and pose, in the frame of the flange, of the frame that becomes the flange.
        exclusions : callable, optional
            Gives the pairs of the new capsules that are not watched; default those of the arm.
        """
        made = copy(self)
        made.__dict__.pop("geometry", None)
        made._build_geometry, made.name = geometry, name or self.name
        if exclusions is not None:
            made.__dict__.pop("exclusions", None)
            made._find_exclusions = exclusions
        if flange is not None:
            made.__dict__.pop("_wrist_geometry", None)
            made.model, at = self.model.copy(), self.model.frames[self._flange]
            pose, kind = at.placement * flange[1], pin.FrameType.OP_FRAME
            frame = pin.Frame(flange[0], at.parentJoint, self._flange, pose, kind)
            made._flange = made.model.addFrame(frame)
            made._chain = chain_of(made.name, made.model, made._flange)
        made._data = made.model.createData()
        return made

    def __repr__(self) -> str:
        return f"<Arm {self.name}: {self.nq} joints, {self.title}>"

    @cached_property
    def geometry(self) -> pin.GeometryModel:
        """Capsules of the links (coal), in the frames of the joints, without collision pairs."""
        return self._build_geometry()

    @cached_property
    def exclusions(self) -> tuple[Exclusion, ...] | None:
        """Pairs of its shapes that are not watched, by evidence; None if none was looked for.

        A capsule belongs to the shape whose name it has, up to ``.k`` of its k-th capsule.
        """
        return self._find_exclusions() if self._find_exclusions else None

    @cached_property
    def hulls(self) -> Mapping[str, np.ndarray]:
        """Of capsules by name the corners (V, 3) of the convex hull of what they contain, in the
        frame of their joint [m]: between the shape and the capsule."""
        return self._find_hulls() if self._find_hulls else {}

    @cached_property
    def solids(self) -> pin.GeometryModel | None:
        """The collision shapes that its capsules stand for, as its URDF has them; else None."""
        return self._read_solids() if self._read_solids else None

    @property
    def chain(self) -> Chain:
        """The constant transforms of the batch kernels.

        Raises
        ------
        UnsupportedArmError
            A joint slides, which whoever asks for this chain does not know.
        """
        if isinstance(self._chain, SlidingChain):
            name = self.model.names[1 + int(np.argmax(self._chain.slides))]
            raise UnsupportedArmError(
                f"arm {self.name}: joint {name} is prismatic, and this method knows joints that "
                f"turn only: lock={{{name!r}: ...}} fixes it"
            )
        return self._chain

    @property
    def motion(self) -> Chain | SlidingChain:
        """The constant transforms, whether joints slide or not."""
        return self._chain

    @property
    def stretched(self) -> float:
        """Length of the way from the base over all joint origins to the flange, with every
        prismatic joint out to its farther limit [m]."""
        steps = np.linalg.norm(self._chain.translation, axis=1).sum()
        slides = self.slides
        return float(steps + np.maximum(abs(self.lower[slides]), abs(self.upper[slides])).sum())

    @property
    def flange_id(self) -> int:
        """Index of the flange frame in ``model.frames``."""
        return self._flange

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
        q = self.configurations(q)
        if q.ndim == 2:
            return self._kernels.poses(self._chain, q)
        pin.forwardKinematics(self.model, self._data, q)
        return pin.updateFramePlacement(self.model, self._data, self._flange).homogeneous

    def positions(self, q: ArrayLike) -> np.ndarray:
        """Flange position p(q) in the base frame [m], (nq,) -> (3,) or (N, nq) -> (N, 3)."""
        return self._batch(self._kernels.positions, self.configurations(q))

    def joint_positions(self, q: ArrayLike) -> np.ndarray:
        """Origins of the joint frames 1 ... nq and of the flange in the base frame [m].

        The frame of a joint is the one its variable turns: link frame i of a modified DH table,
        link frame i-1 of a standard one.

        Returns
        -------
        ndarray (nq + 1, 3) or (N, nq + 1, 3)
        """
        return self._batch(self._kernels.frame_origins, self.configurations(q))

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
        q = self.configurations(q)
        if q.ndim == 2:
            return self._kernels.jacobians(self._chain, q)
        frame = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
        jacobian = pin.computeFrameJacobian(self.model, self._data, q, self._flange, frame)
        return jacobian.reshape(6, self.nq)  # Pinocchio drops the axis of a single joint

    def manipulability(self, q: ArrayLike) -> float | np.ndarray:
        """Yoshikawa's measure w(q) = sqrt(det(J J^T)).

        T. Yoshikawa, Manipulability of robotic mechanisms, IJRR 4(2), 1985. In m^3 for six joints.

        Returns
        -------
        float or ndarray (N,)
        """
        q = self.configurations(q)
        if q.ndim == 2:
            return self._kernels.manipulabilities(self._chain, q)
        return float(np.prod(np.linalg.svd(self.jacobian(q), compute_uv=False)))

    def ik(
        self, T: ArrayLike, *, reference: ArrayLike | None = None, within_limits: bool = True
    ) -> np.ndarray:
        """Every configuration with T(q) = T, for six joints with a spherical wrist (closed form).

        Parameters
        ----------
        T : (4, 4)
            Pose of the flange in the base frame [m].
        reference : (nq,) [rad], optional
            Of the angles that differ by full turns the one nearest to it is returned, and where
            the pose leaves an angle undetermined (axes 4 and 6 aligned: q4; wrist centre on axis
            1: q1) it takes this value. Default: the middle of the range.
        within_limits : bool
            Drop the branches that no full turn brings within the limits.

        Returns
        -------
        ndarray (k, nq)
            Distinct configurations, k <= 8; k = 0 if the pose is out of reach.

        Raises
        ------
        UnsupportedArmError
            The arm lacks the structure the closed form needs.
        InputError
            T is no pose.
        """
        pose = check_poses(f"arm {self.name}", T, ndim=2)
        branches = self._solve(pose[np.newaxis], reference, within_limits)[0]
        return branches[distinct(branches)]

    def ik_branches(
        self, T: ArrayLike, *, reference: ArrayLike | None = None, within_limits: bool = True
    ) -> np.ndarray:
        """The eight branches of :meth:`ik` for many poses, each at its own index.

        Branch 4 a + 2 b + c has the shoulder turned back (a), the elbow angle negative (b) and the
        wrist angle negative (c); between singularities a branch is continuous in T.

        Parameters
        ----------
        T : (N, 4, 4)
        reference, within_limits
            As in :meth:`ik`.

        Returns
        -------
        ndarray (N, 8, nq)
            NaN for a branch that does not exist or is outside the limits.
        """
        poses = check_poses(f"arm {self.name}", T, ndim=3)
        return self._solve(poses, reference, within_limits)

    def symbolic_fk(self) -> sp.Matrix:
        """T(q) of a DH arm as a sympy Matrix (4, 4) in q_1 ... q_n, exact.

        Raises
        ------
        UnsupportedArmError
            The arm is not given by a DH table.
        """
        return dh.forward_kinematics(self._dh_robot("symbolic forward kinematics"))

    def link_transforms(self) -> list[sp.Matrix]:
        """The link transforms of a DH arm in table order, exact; their product is T(q).

        Raises
        ------
        UnsupportedArmError
            The arm is not given by a DH table.
        """
        return dh.link_transforms(self._dh_robot("symbolic link transforms"))

    @checked
    def mirrored(self, name: str | None = None) -> Arm:
        """The reflection M T(q) M at -q, M = diag(1, -1, 1, 1), of a DH arm.

        Raises
        ------
        UnsupportedArmError
            The arm is not given by a DH table.
        """
        robot = self._dh_robot("the mirror image").mirrored()
        return Arm.from_dh(name or f"{self.name}-mirrored", robot)

    def _batch(self, kernel: Callable[..., np.ndarray], q: np.ndarray) -> np.ndarray:
        return kernel(self._chain, q) if q.ndim == 2 else kernel(self._chain, q[np.newaxis])[0]

    @property
    def _kernels(self) -> ModuleType:
        return sliding if isinstance(self._chain, SlidingChain) else kernels

    @cached_property
    def _wrist_geometry(self) -> WristGeometry:
        return wrist_geometry(self.name, self.chain)

    def _solve(
        self, poses: np.ndarray, reference: ArrayLike | None, within_limits: bool
    ) -> np.ndarray:
        geometry = self._wrist_geometry
        near = np.where(self.turns_for_ever, 0.0, 0.5 * np.add(*self.usual_range))
        if reference is not None:
            near = self.configurations(reference)
            if near.ndim != 1 or not (np.abs(near) < FAR).all():
                expected = f"{self.nq} angles below {FAR:g} [rad]"
                raise ConfigurationError(f"arm {self.name}", "reference", near, expected)
        return inverse_kinematics(geometry, poses, near, *self.limits(within_limits))

    def _dh_robot(self, wanted: str) -> DHRobot:
        if self._robot is None:
            raise UnsupportedArmError(f"arm {self.name}: {wanted} needs an arm given by a DH table")
        return self._robot


def _without_shapes(name: str) -> pin.GeometryModel:
    raise UnsupportedArmError(
        f"arm {name}: its table has no capsules, so that it would collide with nothing: expected "
        'capsules, or shapes="none"'
    )
