"""Names of the arms in ``data/robots``, and loading of an arm by name or from a file."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import partial
from pathlib import Path

import pinocchio as pin
from example_robot_data import getModelPath

from ..arguments import checked
from ..datafiles import data_path
from ..errors import DataFileError, InputError, UnknownNameError
from ..input_files import path_of
from ..settings import choice
from .arm import Arm
from .capsules import enclosing_capsules
from .fit.links import FittedLinks
from .robot_file import DHRobot, MirrorRobot, URDFRobot, changed, load_robot_file
from .shapes import Shapes
from .urdf import URDF


def arm_names() -> list[str]:
    """Names that :func:`load_arm` knows, in alphabetical order."""
    return sorted(path.stem for path in data_path("robots").glob("*.yaml"))


@checked
def load_arm(
    name_or_path: str | Path,
    *,
    flange: str | None = None,
    lock: Mapping[str, object] | None = None,
    shapes: Shapes | str | None = None,
    packages: Sequence[str | Path] = (),
) -> Arm:
    """Load an arm by its name in ``data/robots``, or from a robot YAML or URDF file.

    Joints turn (revolute, continuous) or slide (prismatic, then in metres wherever a joint vector
    is given in radians). The options after the name are for URDF files and robots made of one.

    Parameters
    ----------
    name_or_path : str or Path
        A name of :func:`arm_names`, or the path of a ``.yaml``/``.yml`` robot file or of a URDF
        file.
    flange : str, optional
        Link used as flange; default the last one before a gripper on the chain of most joints.
    lock : mapping of joint name to angle or length, optional
        Joints to fix: [rad], ``"90 deg"`` or ``"pi/2"``, of a prismatic joint [m]. Joints off the
        way to the flange are fixed anyway, at 0 or where the joint they follow puts them.
    shapes : Shapes, optional
        ``fitted`` (default of a URDF): several capsules around each collision shape, and pairs
        left out by evidence (``Arm.exclusions``); ``enclosing`` (default of a robot file): one
        around each; ``visual``: around the visual shapes; ``none``: kinematics alone.
    packages : sequence of paths, optional
        Folders in which ``package://`` is looked for before those above the file and those of
        ``ROS_PACKAGE_PATH``.

    Raises
    ------
    InputError
        An argument of the wrong type.
    UnknownNameError
        No arm, flange, joint or kind of shapes of that name; the message lists those there are.
    DataFileError
        The file is missing, broken, or says something that is not represented: a joint, a shape, a
        gear, a value to lock at. The message says how to do without.
    UnsupportedArmError
        The file is no serial chain.
    """
    names = arm_names()
    given_path = path_of("load_arm", "name", name_or_path)
    if str(name_or_path) in names:
        path, name = data_path("robots", f"{name_or_path}.yaml"), str(name_or_path)
    else:
        path = given_path
        name = path.stem
        if not path.suffix and not path.exists():
            expected = f"one of {', '.join(names)}, or the path of a URDF or YAML file"
            raise UnknownNameError("load_arm", "name", str(name_or_path), expected)
    kind = None if shapes is None else choice(Shapes, "load_arm", "shapes", shapes)
    if not isinstance(lock, Mapping | None):
        raise InputError("load_arm", "lock", lock, "a mapping of joint name to angle or length")
    if not isinstance(flange, str | None):
        raise InputError("load_arm", "flange", flange, "the name of a link")
    folders = _folders(packages)
    if path.suffix not in (".yaml", ".yml"):
        urdf = URDF(path, flange, lock, kind or Shapes.FITTED, folders)
        return _from_urdf(name, f"{name} (URDF)", urdf, urdf)
    robot = load_robot_file(path)
    if isinstance(robot, URDFRobot):
        return _from_urdf_robot(name, path, robot, flange, lock, kind, folders)
    other = None if kind is Shapes.NONE else shapes
    given = {"flange": flange, "lock": lock, "shapes": other, "packages": packages or None}
    if given := {key: value for key, value in given.items() if value is not None}:
        expected = f"none of these, since {name} is no URDF"
        raise InputError("load_arm", ", ".join(given), given, expected)
    if isinstance(robot, MirrorRobot):
        original = load_robot_file(path.with_name(f"{robot.of}.yaml"))
        if not isinstance(original, DHRobot):
            raise DataFileError(path, "of", robot.of, "the name of an arm given by a DH table")
        return Arm.from_dh(name, changed(original.mirrored(), title=robot.title), kind)
    return Arm.from_dh(name, robot, kind)


def _folders(packages: object) -> tuple[Path, ...]:
    given = [packages] if isinstance(packages, str | Path) else packages
    if not isinstance(given, Iterable):
        raise InputError("load_arm", "packages", packages, "paths of folders")
    return tuple(path_of("load_arm", "packages", folder) for folder in given)


def _from_urdf_robot(
    name: str,
    path: Path,
    robot: URDFRobot,
    flange: str | None,
    lock: Mapping[str, object] | None,
    shapes: Shapes | None,
    packages: Sequence[Path],
) -> Arm:
    fixed = {joint: float(angle) for joint, angle in robot.lock.items()} if lock is None else lock
    options = flange or robot.flange, fixed, shapes or robot.shapes, packages
    model, solids = (
        URDF(_urdf_path(path, field, urdf), *options)
        for field, urdf in (("urdf", robot.urdf), ("collision", robot.collision or robot.urdf))
    )
    return _from_urdf(name, robot.title, model, solids)


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


def _from_urdf(name: str, title: str, urdf: URDF, solids: URDF) -> Arm:
    capsules: Callable[[], pin.GeometryModel] = partial(_enclosed, solids)
    exclusions = hulls = neighbours = None
    if solids.shapes in (Shapes.FITTED, Shapes.VISUAL):
        fitted = FittedLinks(solids)
        capsules, exclusions, hulls = fitted.geometry, fitted.exclusions, fitted.hulls
        neighbours = fitted.neighbours
    return Arm(
        name,
        title,
        urdf.model,
        urdf.flange_id,
        capsules,
        types=urdf.types,
        exclusions=exclusions,
        hulls=hulls,
        neighbours=neighbours,
        solids=solids.solids,
        remarks=solids.remarks,
    )


def _enclosed(urdf: URDF) -> pin.GeometryModel:
    return enclosing_capsules(urdf.solids())
