"""A URDF file as the chain from its base to one flange frame, with the shapes of its links."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from functools import cached_property
from hashlib import sha256
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pinocchio as pin

from ...errors import DataFileError, UnknownNameError
from ..joint_type import JointType
from ..shapes import Shapes
from .document import aliases, children, read, renamed
from .flange import default_flange
from .joints import geared, locked_values, read_joints
from .meshes import mesh_files, refuse_broken_mesh
from .parser import bordered
from .shapes import check_count, check_shapes, for_the_parser, with_capsules
from .stand_ins import represented
from .tree import check_tree

_REMEDY = "flange= chooses another chain, lock= fixes a joint"


class URDF:
    """A URDF file whose joints off the way from the base to the flange are locked.

    Parameters
    ----------
    path : Path
    flange : str, optional
        Name of a link; the default is the last one before a gripper on the chain with the most
        joints (:func:`.flange.default_flange`).
    lock : mapping of joint name to angle or length
        Further joints to lock: an angle as in robot files ([rad], ``"90 deg"``, ``"pi/2"``), of a
        prismatic joint a length [m]. Joints off the chain are locked at 0, or as the joint that
        they follow (``mimic``), unless named here.
    shapes : Shapes
        What the links are made of.
    packages : sequence of Path
        Folders below which ``package://`` is looked for first.

    Attributes
    ----------
    model : pinocchio.Model
        Reduced to the joints between base and flange.
    types : tuple of JointType
        How each of them moves.
    remarks : list of str
        Links without a collision shape for which visual ones stand in (:mod:`.stand_ins`), links
        that are seen but not represented, and what the parser had to say about a file that it
        could read.

    Raises
    ------
    DataFileError
        Missing or broken file, links that form no tree, a non-finite number, limits in the wrong
        order, no joint, a joint of the chain that is neither revolute nor prismatic, a collision
        shape that is not known.
    UnknownNameError
        No such flange frame or joint.
    """

    def __init__(
        self,
        path: Path,
        flange: str | None = None,
        lock: Mapping[str, object] | None = None,
        shapes: Shapes = Shapes.ENCLOSING,
        packages: Sequence[Path] = (),
    ) -> None:
        self.path, self.shapes, self._packages = Path(path), shapes, packages
        self._root = read(self.path)
        check_tree(self.path, self._root)
        joints = read_joints(self.path, self._root)
        self.remarks = represented(self.path, self._root, shapes, packages)
        check_shapes(self.path, self._root, shapes)
        self._aliases = aliases(self._root)
        kinematic = renamed(_kinematic(self._root), self._aliases)
        xml = ElementTree.tostring(kinematic, encoding="unicode")
        with bordered(self.path, "content", "a URDF that Pinocchio can read") as said:
            self._full = full = pin.buildModelFromXML(xml)
        links = children(self._root, "link")
        self.flange = default_flange(self._root, joints) if flange is None else flange
        if not isinstance(self.flange, str) or self.flange not in links:
            raise UnknownNameError(self.path, "flange", self.flange, f"one of {', '.join(links)}")
        self.remarks += said
        names = list(full.names)
        limits = {name: self._limits_of(names.index(name)) for name in joints.types}
        values = locked_values(
            self.path, joints, lock or {}, limits | dict.fromkeys(joints.standing, (0.0, 0.0))
        )
        chain = {names[k] for k in full.supports[self._flange_frame(full).parentJoint] if k}
        free = chain - values.keys()
        free -= {name for name, gear in joints.gears.items() if gear.master not in free}
        self._refuse_standing(free & joints.standing.keys(), joints.standing)
        still = geared(self.path, joints, free, values)
        self._locked = [k for k, name in enumerate(names) if k and name not in free]
        self._reference = pin.neutral(full)
        for name, value in still.items():
            self._reference[full.idx_qs[names.index(name)]] = value
        with bordered(self.path, "content", "a chain that Pinocchio can reduce"):
            self.model = pin.buildReducedModel(full, self._locked, self._reference)
        self._with_own_names(self.model.frames)
        self.types = tuple(joints.types[name] for name in list(self.model.names)[1:])
        self._check_limits()
        self._still = still

    @property
    def flange_id(self) -> int:
        """Index of the flange in ``model.frames``."""
        return int(self.model.getFrameId(self.flange, pin.FrameType.BODY))

    def _with_own_names(self, named: Iterable[Any], ending: str = "") -> None:
        """Give frames or shapes the names of the file again."""
        names = {alias: name for name, alias in self._aliases.items()}
        for one in named:
            stem, separator, number = one.name.rpartition(ending) if ending else (one.name, "", "")
            if stem in names:
                one.name = f"{names[stem]}{separator}{number}"

    @cached_property
    def _for_the_parser(self) -> tuple[ElementTree.Element, set[str]]:
        return for_the_parser(self.path, self._root, self._packages)

    def solids(self) -> pin.GeometryModel:
        """The collision shapes of the links as the file has them, fixed to the reduced model.

        Raises
        ------
        DataFileError
            A mesh of the file is missing or broken, or a shape got lost.
        """
        if self.shapes is Shapes.NONE:
            return pin.GeometryModel()
        root, capsules = self._for_the_parser
        xml = ElementTree.tostring(renamed(root, self._aliases), encoding="unicode")
        try:
            with bordered(self.path, "content", "collision meshes that can be read") as said:
                made = pin.buildGeomFromUrdfString(self._full, xml, pin.GeometryType.COLLISION)
        except DataFileError:
            refuse_broken_mesh(self.path, root)
            raise
        self._with_own_names(made.geometryObjects, "_")
        check_count(self.path, self._root, made, said)
        made = with_capsules(made, capsules)
        with bordered(self.path, "content", "shapes that Pinocchio can reduce"):
            _, reduced = pin.buildReducedModel(self._full, made, self._locked, self._reference)
        self._check_vertices(reduced)
        return reduced

    def content(self) -> str:
        """SHA-256 over everything that :meth:`solids` depends on."""
        root, _ = self._for_the_parser
        found = sha256(repr((self.flange, self.shapes.value, sorted(self._still.items()))).encode())
        found.update(ElementTree.tostring(self._root))
        for _, file in mesh_files(root):
            found.update(sha256(file.read_bytes()).digest())
        return found.hexdigest()

    def _flange_frame(self, model: pin.Model) -> pin.Frame:
        name = self._aliases.get(self.flange, self.flange)
        return model.frames[model.getFrameId(name, pin.FrameType.BODY)]

    def _refuse_standing(self, names: set[str], kinds: Mapping[str, str]) -> None:
        for name in sorted(names):
            expected = (
                f"a revolute, continuous or prismatic joint before {self.flange}: "
                f"flange= chooses another chain, lock={{{name!r}: 0}} fixes the joint"
            )
            raise DataFileError(self.path, f"type of joint {name}", kinds[name], expected)

    def _limits_of(self, joint: int) -> tuple[float, float]:
        full = self._full
        at = full.idx_qs[joint]
        return float(full.lowerPositionLimit[at]), float(full.upperPositionLimit[at])

    def _check_limits(self) -> None:
        model = self.model
        if model.njoints < 2:
            expected = f"a moving joint before {self.flange}: {_REMEDY}"
            raise DataFileError(self.path, "joints", 0, expected)
        lower, upper = model.lowerPositionLimit.copy(), model.upperPositionLimit.copy()
        for k, (name, kind) in enumerate(zip(list(model.names)[1:], self.types, strict=True)):
            low, high = lower[k], upper[k]
            if not (math.isfinite(low) and math.isfinite(high) and low <= high):
                expected = f"lower <= upper; {_REMEDY}"
                raise DataFileError(self.path, f"limit of joint {name}", (low, high), expected)
            if kind is JointType.CONTINUOUS:
                lower[k], upper[k] = -np.inf, np.inf
        model.lowerPositionLimit, model.upperPositionLimit = lower, upper

    def _check_vertices(self, geometry: pin.GeometryModel) -> None:
        for shape in geometry.geometryObjects:
            if hasattr(shape.geometry, "vertices"):
                points = np.array(shape.geometry.vertices())
                if not len(points) or not np.isfinite(points).all():
                    field = f"mesh of collision shape {shape.name}"
                    raise DataFileError(self.path, field, len(points), "finite vertices")


def _kinematic(root: ElementTree.Element) -> ElementTree.Element:
    """The robot without its shapes, which the parser of the kinematics has no use for."""
    made = ElementTree.Element(root.tag, root.attrib)
    for part in root:
        if part.tag == "link":
            link = ElementTree.SubElement(made, "link", part.attrib)
            link.extend(one for one in part if one.tag not in ("visual", "collision"))
        elif part.tag == "joint":
            made.append(part)
    return made
