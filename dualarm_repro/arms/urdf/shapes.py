"""Collision elements of a URDF: each is one shape, or refused by name."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from copy import deepcopy
from pathlib import Path
from xml.etree.ElementTree import Element

import coal
import pinocchio as pin

from ...errors import DataFileError
from ..shapes import Shapes
from .document import children
from .fields import anything, has, not_zero, positive
from .meshes import mesh_field, mesh_path

_REMEDY = 'or shapes="none" for the kinematics alone'
_GEOMETRY: dict[str, tuple[str, Callable[[Element], bool]]] = {
    "sphere": ("a positive radius", lambda e: has(e, "radius", 1, positive)),
    "box": ("a size of three positive numbers", lambda e: has(e, "size", 3, positive)),
    "cylinder": ("positive radius and length", lambda e: _round(e)),
    "capsule": ("positive radius and length", lambda e: _round(e)),
    "mesh": ("a filename, and a scale of three numbers other than 0 if any", lambda e: _mesh(e)),
}


def _round(element: Element) -> bool:
    return has(element, "radius", 1, positive) and has(element, "length", 1, positive)


def _mesh(element: Element) -> bool:
    scaled = "scale" not in element.attrib or has(element, "scale", 3, not_zero)
    return bool(element.get("filename", "").strip()) and scaled


def check_shapes(path: Path, root: Element, shapes: Shapes) -> None:
    """Check every collision element, after putting the visual ones in their place if asked for.

    Raises
    ------
    DataFileError
        A shape that is not known, has numbers of the wrong form or stands nowhere; no shape at all.
    """
    if shapes is Shapes.NONE:
        return
    count = visual = 0
    for name, link in children(root, "link").items():
        visual += len(link.findall("visual"))
        if shapes is Shapes.VISUAL:
            for old in link.findall("collision"):
                link.remove(old)
            for shown in link.findall("visual"):
                made = deepcopy(shown)
                made.tag = "collision"
                link.append(made)
        for k, collision in enumerate(link.findall("collision")):
            check_shape(path, f"collision {k} of link {name}", collision)
            count += 1
    if not count:
        seen = f'shapes="visual" for its {visual} visual shapes, ' if visual else ""
        expected = f"a collision shape on some link, {seen}{_REMEDY}"
        raise DataFileError(path, "collision shapes", 0, expected)


def check_shape(path: Path, field: str, collision: Element) -> None:
    """Check one collision or visual element.

    Raises
    ------
    DataFileError
        Not exactly one known shape, or numbers of the wrong form.
    """
    found = [shape for geometry in collision.findall("geometry") for shape in geometry]
    if len(found) != 1 or found[0].tag not in _GEOMETRY:
        tags = ", ".join(str(shape.tag) for shape in found) or "nothing"
        expected = f"one of {', '.join(_GEOMETRY)}, {_REMEDY}"
        raise DataFileError(path, f"{field}: geometry", tags, expected)
    wanted, holds = _GEOMETRY[found[0].tag]
    if not holds(found[0]):
        value = dict(found[0].attrib) or "nothing"
        raise DataFileError(path, f"{field}: {found[0].tag}", value, f"{wanted}, {_REMEDY}")
    if (origin := collision.find("origin")) is not None:
        for attribute in ("xyz", "rpy"):
            if attribute in origin.attrib and not has(origin, attribute, 3, anything):
                place = origin.get(attribute)
                raise DataFileError(path, f"{field}: {attribute}", place, "three finite numbers")


def for_the_parser(path: Path, root: Element, packages: Sequence[Path]) -> tuple[Element, set[str]]:
    """The robot with meshes by absolute path and capsules as cylinders, and the names of those
    shapes that are capsules.

    A capsule of the file has a cylindrical part of the given length, as in SDFormat.

    Raises
    ------
    DataFileError
        A mesh file is missing.
    """
    made, capsules = deepcopy(root), set()
    for name, link in children(made, "link").items():
        for visual in link.findall("visual"):
            link.remove(visual)
        for k, collision in enumerate(link.findall("collision")):
            # The parser reads one group of collisions of a link: that of the first one.
            collision.attrib.pop("name", None)
            for shape in collision.findall("geometry/*"):
                if shape.tag == "capsule":
                    shape.tag = "cylinder"
                    capsules.add(f"{name}_{k}")
                elif shape.tag == "mesh":
                    field = mesh_field(name, k)
                    file = mesh_path(path, field, shape.get("filename", "").strip(), packages)
                    shape.set("filename", str(file.absolute()))
    return made, capsules


def check_count(path: Path, root: Element, geometry: pin.GeometryModel, said: list[str]) -> None:
    """Every collision element of the file has become a shape.

    Raises
    ------
    DataFileError
        The number differs for some link.
    """
    got = Counter(shape.name.rpartition("_")[0] for shape in geometry.geometryObjects)
    for name, link in children(root, "link").items():
        wanted = len(link.findall("collision"))
        if got[name] != wanted:
            reason = f" ({said[0]})" if said else ""
            expected = f"{wanted}, as many as the file has{reason}, {_REMEDY}"
            raise DataFileError(path, f"collision shapes of link {name}", got[name], expected)


def with_capsules(geometry: pin.GeometryModel, names: set[str]) -> pin.GeometryModel:
    """The same shapes with those of the given names as capsules instead of cylinders."""
    made = pin.GeometryModel()
    for shape in geometry.geometryObjects:
        if shape.name in names:
            solid = coal.Capsule(shape.geometry.radius, 2.0 * shape.geometry.halfLength)
            # Without its frame Pinocchio cannot reduce the model.
            place = shape.parentJoint, shape.parentFrame, shape.placement
            shape = pin.GeometryObject(shape.name, *place, solid)
        made.addGeometryObject(shape)
    return made
