"""Names of the arms in ``data/robots``, and loading of an arm by name or from a file."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from example_robot_data import getModelPath

from ..datafiles import data_path
from ..errors import DataFileError, InputError, UnknownNameError
from .arm import Arm
from .robot_file import DHRobot, MirrorRobot, URDFRobot, changed, load_robot_file
from .urdf import URDF


def arm_names() -> list[str]:
    """Names that :func:`load_arm` knows, in alphabetical order."""
    return sorted(path.stem for path in data_path("robots").glob("*.yaml"))


def load_arm(
    name_or_path: str | Path, *, flange: str | None = None, lock: Mapping[str, float] | None = None
) -> Arm:
    """Load an arm by its name in ``data/robots``, or from a robot YAML or URDF file.

    Parameters
    ----------
    name_or_path : str or Path
        A name of :func:`arm_names`, or the path of a ``.yaml``/``.yml`` robot file or of a URDF
        file.
    flange : str, optional
        Only for a URDF: frame used as flange; default the last link of the longest chain.
    lock : mapping of joint name to angle [rad], optional
        Only for a URDF: joints to fix. Joints off the way to the flange are fixed anyway, at 0.

    Raises
    ------
    UnknownNameError
        No arm, flange frame or joint of that name; the message lists those there are.
    DataFileError
        The file is missing, broken, or a field has a value of the wrong form.
    UnsupportedArmError
        The file is no serial chain of revolute joints.
    """
    names = arm_names()
    if str(name_or_path) in names:
        path, name = data_path("robots", f"{name_or_path}.yaml"), str(name_or_path)
    else:
        path = Path(name_or_path)
        name = path.stem
        if not path.suffix and not path.exists():
            expected = f"one of {', '.join(names)}, or the path of a URDF or YAML file"
            raise UnknownNameError("load_arm", "name", str(name_or_path), expected)
    if path.suffix not in (".yaml", ".yml"):
        urdf = URDF(path, flange, lock)
        return _from_urdf(name, f"{name} (URDF)", urdf, urdf)
    robot = load_robot_file(path)
    if isinstance(robot, URDFRobot):
        return _from_urdf_robot(name, path, robot, flange, lock)
    if flange is not None or lock is not None:
        given = {"flange": flange, "lock": lock}
        raise InputError("load_arm", "flange, lock", given, f"neither, since {name} is no URDF")
    if isinstance(robot, MirrorRobot):
        original = load_robot_file(path.with_name(f"{robot.of}.yaml"))
        if not isinstance(original, DHRobot):
            raise DataFileError(path, "of", robot.of, "the name of an arm given by a DH table")
        return Arm.from_dh(name, changed(original.mirrored(), title=robot.title))
    return Arm.from_dh(name, robot)


def _from_urdf_robot(
    name: str, path: Path, robot: URDFRobot, flange: str | None, lock: Mapping[str, float] | None
) -> Arm:
    fixed = {joint: float(angle) for joint, angle in robot.lock.items()} if lock is None else lock
    model, shapes = (
        URDF(_urdf_path(path, field, urdf), flange or robot.flange, fixed)
        for field, urdf in (("urdf", robot.urdf), ("collision", robot.collision or robot.urdf))
    )
    return _from_urdf(name, robot.title, model, shapes)


def _urdf_path(path: Path, field: str, urdf: str) -> Path:
    """A URDF next to the robot file, or one of example-robot-data."""
    beside = path.parent / urdf
    if beside.exists():
        return beside
    try:
        return Path(getModelPath(urdf)) / urdf
    except OSError:
        expected = "a URDF beside the robot file or below robots of example-robot-data"
        raise DataFileError(path, field, urdf, expected) from None


def _from_urdf(name: str, title: str, urdf: URDF, shapes: URDF) -> Arm:
    return Arm(name, title, urdf.model, urdf.flange, shapes.capsules)
