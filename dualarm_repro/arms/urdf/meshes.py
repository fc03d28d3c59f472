"""Where the mesh files of a URDF are."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from pathlib import Path
from urllib.parse import unquote
from xml.etree.ElementTree import Element

import coal
import numpy as np

from ...errors import DataFileError
from ...input_files import LARGEST_MESH, require_regular
from .parser import bordered

_SCHEMES = ("package://", "model://")
_VARIABLES = {"ROS_PACKAGE_PATH": "", "AMENT_PREFIX_PATH": "share"}


def mesh_path(urdf: Path, field: str, name: str, packages: Sequence[Path]) -> Path:
    """The file of a mesh.

    ``package://`` and ``model://`` are looked for below ``packages``, then below the folders that
    hold the URDF, then below those of ``ROS_PACKAGE_PATH`` and ``AMENT_PREFIX_PATH``; a folder may
    also be the package itself. A relative name counts from the folder of the URDF.

    Raises
    ------
    DataFileError
        There is no such file; the message says where it was looked for.
    """
    candidates = list(_candidates(urdf, name, packages))
    for candidate in candidates:
        if candidate.is_file():
            require_regular(candidate, "a mesh file", LARGEST_MESH)
            return candidate
    if name.startswith(_SCHEMES):
        roots = [*map(str, packages), f"the folders above {urdf.name}", *_VARIABLES]
        expected = f"a file of a package below {', '.join(roots)}: name its folder by packages="
    else:
        expected = "an existing mesh file"
    raise DataFileError(urdf, field, ShownWhole(name), expected)


class ShownWhole(str):
    """A text that a message shows with its end, however long it is."""

    def __repr__(self) -> str:
        shown = str.__repr__(self)
        return shown if len(shown) <= 110 else f"{shown[:20]}...{shown[-80:]}"


def mesh_field(link: str, number: int) -> str:
    """What a message calls a mesh."""
    return f"mesh of collision {number} of link {link}"


def mesh_files(root: Element) -> list[tuple[str, Path]]:
    """Meshes of a robot, whose names are paths, with what a message calls them."""
    return [
        (mesh_field(link.get("name", ""), k), Path(mesh.get("filename", "")))
        for link in root.findall("link")
        for k, collision in enumerate(link.findall("collision"))
        for mesh in collision.findall("geometry/mesh")
    ]


def refuse_broken_mesh(urdf: Path, root: Element) -> None:
    """Raise for the first mesh that cannot be read.

    Raises
    ------
    DataFileError
        Names it and its link.
    """
    for field, file in mesh_files(root):
        try:
            with bordered(urdf, field, "a mesh"):
                coal.MeshLoader().load(str(file), np.ones(3))
        except DataFileError:
            raise DataFileError(urdf, field, ShownWhole(file), "a mesh that can be read") from None


def _candidates(urdf: Path, name: str, packages: Sequence[Path]) -> Iterator[Path]:
    folders = [*packages, *urdf.resolve().parents]
    for variable, below in _VARIABLES.items():
        for part in os.environ.get(variable, "").split(os.pathsep):
            if part:
                folders.append(Path(part) / below)
    for scheme in _SCHEMES:
        if name.startswith(scheme):
            rest = Path(name.removeprefix(scheme))
            for folder in folders:
                yield folder / rest
                if rest.parts and folder.name == rest.parts[0]:
                    yield folder / Path(*rest.parts[1:])
            return
    if name.startswith("file://"):
        yield Path(name.removeprefix("file://"))
        yield Path(unquote(name.removeprefix("file://")))
        return
    if "://" not in name:
        for folder in (urdf.resolve().parent, *folders):
            yield folder / name
