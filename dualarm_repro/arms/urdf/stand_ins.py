"""Visual shapes in the place of collision shapes, for links that have none beside links that do."""

from __future__ import annotations

from collections.abc import Sequence
from copy import deepcopy
from pathlib import Path
from xml.etree.ElementTree import Element

from ...errors import DataFileError, shorten
from ..shapes import Shapes
from .document import children
from .meshes import mesh_path
from .shapes import check_shape


def represented(path: Path, root: Element, shapes: Shapes, packages: Sequence[Path]) -> list[str]:
    """Let visual shapes stand in where a link has no collision shape, and say for which links.

    A link that is seen is there: what collides with it collides. A file without any collision shape
    is left alone, and so is a link of which nothing is seen.

    Returns
    -------
    list of str
        A remark on the links that visual shapes stand in for, and one on those of which something
        is not represented: it is no known shape, or its mesh is missing. Where no shapes are wanted
        one on each link.
    """
    links = children(root, "link")
    seen = {
        name: link.findall("visual")
        for name, link in links.items()
        if link.find("visual") is not None and link.find("collision") is None
    }
    if shapes is Shapes.NONE:
        return [f"link {name} has a visual but no collision shape" for name in seen]
    if shapes is Shapes.VISUAL or len(seen) == len(links) or root.find("link/collision") is None:
        return []
    stood: list[str] = []
    lost: dict[str, str] = {}
    for name, visuals in seen.items():
        for k, visual in enumerate(visuals):
            made = deepcopy(visual)
            made.tag = "collision"
            try:
                _check(path, f"visual {k}", made, packages)
            except DataFileError as error:
                lost.setdefault(name, f"{name} ({error.field} = {shorten(error.value)})")
                continue
            links[name].append(made)
            stood += [name] if name not in stood else []
    remarks = []
    if stood:
        remarks.append(
            f"visual shapes stand in for missing collision shapes of links {', '.join(stood)}"
        )
    if lost:
        reason = (
            "not represented, without collision shape and with a visual one that is no shape or"
        )
        remarks.append(f"{reason} has no file: {', '.join(lost.values())}")
    return remarks


def _check(path: Path, field: str, shape: Element, packages: Sequence[Path]) -> None:
    check_shape(path, field, shape)
    for mesh in shape.findall("geometry/mesh"):
        mesh_path(path, f"{field}: mesh", mesh.get("filename", "").strip(), packages)
