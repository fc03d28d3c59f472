"""The motion of all arms of a scene as an argument: one path of each."""

from __future__ import annotations

from collections.abc import Mapping

from ...errors import InputError, UnknownNameError
from ...scene import JointPath, Scene


def require_paths(source: str, scene: Scene, paths: Mapping[str, JointPath]) -> None:
    """Raise unless there is a path of every arm and of nothing else.

    Raises
    ------
    InputError
        No mapping of name to JointPath.
    UnknownNameError
        An arm without a path, or a path without an arm.
    """
    if not isinstance(paths, Mapping):
        raise InputError(source, "paths", paths, "a mapping of arm to JointPath")
    if set(paths) != set(scene.columns):
        expected = f"paths of all of {', '.join(scene.columns)}"
        raise UnknownNameError(source, "paths", sorted(map(str, paths)), expected)
    for name, path in paths.items():
        if not isinstance(path, JointPath):
            raise InputError(source, f"path of {name}", path, "a JointPath")
