"""One arm: its Pinocchio model, its capsules and its kinematics for one or many configurations."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from copy import copy
from functools import cached_property, partial
from typing import TYPE_CHECKING

import numpy as np
import pinocchio as pin
from numpy.typing import ArrayLike

from ..arguments import checked
from ..errors import ConfigurationError, UnsupportedArmError
from .capsules import capsule_geometry
from .chain import chain_of
from .dh_model import FLANGE, build_model
from .exclusions import Exclusion, Neighbours
from .joint_type import JointType
from .kernels import Kinematics
from .moving_chain import MovingChain
from .poses import check_poses
from .robot_file import DHRobot
from .shapes import Shapes
from .trigonometry import FAR
from .wrist_geometry import WristGeometry, wrist_geometry
from .wrist_ik import distinct, inverse_kinematics

if TYPE_CHECKING:
    import sympy as sp


class Arm(MovingChain):
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
        What of its file is represented otherwise or not at all: links whose visual shapes stand in
        for collision shapes that they lack, links that are seen but not represented, words of the
        parser.
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
        neighbours: Callable[[], tuple[Neighbours, ...]] | None = None,
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
        self._find_hulls, self._find_neighbours = hulls, neighbours
        self._fit = None if exclusions is None else geometry
        self._move_by(Kinematics(chain_of(name, model, self._flange)))
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
        neighbours: Callable[[], tuple[Neighbours, ...]] | None = None,
        solids: Callable[[], pin.GeometryModel | None] | None = None,
    ) -> Arm:
        """The same arm with other capsules, built when they are first asked for.

        Parameters
        ----------
        flange : (str, pinocchio.SE3), optional
            Name and pose, in the frame of the flange, of the frame that becomes the flange.
        exclusions : callable, optional
            Gives the pairs of the new capsules that are not watched; default those of the arm.
        neighbours, solids : callable, optional
            Give :attr:`neighbours`, and the exact shapes in all of the new capsules; default those
            of the arm.
        """
        made = copy(self)
        for known in ("geometry", "exclusions", "neighbours", "solids", "fit"):
            made.__dict__.pop(known, None)
        made._build_geometry, made.name = geometry, name or self.name
        made._find_exclusions = exclusions or (lambda: self.exclusions)
        made._find_neighbours = neighbours or (lambda: self.neighbours)
        made._read_solids = solids or (lambda: self.solids)
        made._fit = self._fit and (geometry if solids else lambda: self.fit)
        if flange is not None:
            made.model, at = self.model.copy(), self.model.frames[self._flange]
            pose, kind = at.placement * flange[1], pin.FrameType.OP_FRAME
            frame = pin.Frame(flange[0], at.parentJoint, self._flange, pose, kind)
            made._flange = made.model.addFrame(frame)
            made._move_by(Kinematics(chain_of(made.name, made.model, made._flange)))
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
    def neighbours(self) -> tuple[Neighbours, ...]:
        """Pairs of shapes of adjacent links that are watched all the same."""
        return self._find_neighbours() if self._find_neighbours else ()

    @cached_property
    def fit(self) -> pin.GeometryModel | None:
        """The capsules as they were fitted around :attr:`solids`, whatever :attr:`geometry` has
        become; None where the evidence was not looked for."""
        return self._fit() if self._fit else None

    @cached_property
    def solids(self) -> pin.GeometryModel | None:
        """The collision shapes that its capsules stand for, as its URDF has them; else None."""
        return self._read_solids() if self._read_solids else None

    @property
    def flange_id(self) -> int:
        """Index of the flange frame in ``model.frames``."""
        return self._flange

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
        from .dh import forward_kinematics  # sympy is slow to import

        return forward_kinematics(self._dh_robot("symbolic forward kinematics"))

    def link_transforms(self) -> list[sp.Matrix]:
        """The link transforms of a DH arm in table order, exact; their product is T(q).

        Raises
        ------
        UnsupportedArmError
            The arm is not given by a DH table.
        """
        from .dh import link_transforms

        return link_transforms(self._dh_robot("symbolic link transforms"))

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
