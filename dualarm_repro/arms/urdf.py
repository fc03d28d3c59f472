"""Reading a URDF file: the chain from its base to one flange frame, and the shapes of its links."""

from __future__ import annotations

import math
import os
import re
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from xml.etree import ElementTree

import pinocchio as pin

from ..errors import DataFileError, UnknownNameError
from .capsules import enclosing_capsules


class URDF:
    """A URDF file whose joints off the way from the base to the flange are locked.

    A continuous joint becomes a revolute one with the limits -2 pi ... 2 pi, so that every
    configuration is a vector of angles.

    Parameters
    ----------
    path : Path
    flange : str, optional
        Frame name; the default is the last link of the chain with the most joints.
    lock : mapping of joint name to angle [rad]
        Further joints to lock; joints off the chain are locked at 0 unless named here.

    Raises
    ------
    DataFileError
        Missing or broken file, a non-finite number, limits in the wrong order, no joint.
    UnknownNameError
        No such flange frame or joint.
    """

    def __init__(
        self, path: Path, flange: str | None = None, lock: Mapping[str, float] | None = None
    ) -> None:
        self.path = Path(path)
        self._xml = _read(self.path)
        with _reason(self.path, "a URDF that Pinocchio can read"):
            self._full = pin.buildModelFromXML(self._xml)
        lock = dict(lock or {})
        self.flange = self._default_flange() if flange is None else flange
        if not self._full.existFrame(self.flange):
            raise UnknownNameError(self.path, "flange", self.flange, _one_of(self._links()))
        frame = self._full.frames[self._full.getFrameId(self.flange)]
        chain = set(self._full.supports[frame.parentJoint])
        names = list(self._full.names)
        for name in lock:
            if name not in names[1:]:
                raise UnknownNameError(self.path, "lock", name, _one_of(names[1:]))
        self._locked = [k for k, name in enumerate(names) if k and (k not in chain or name in lock)]
        self._reference = pin.neutral(self._full)
        for name, angle in lock.items():
            self._reference[self._full.idx_qs[names.index(name)]] = angle
        self.model = pin.buildReducedModel(self._full, self._locked, self._reference)
        self._check_limits()

    def capsules(self) -> pin.GeometryModel:
        """Capsules that enclose the collision shapes of the links, fixed to the reduced model.

        Raises
        ------
        DataFileError
            A mesh of the file is missing or broken.
        """
        with _reason(self.path, "collision meshes that can be read"):
            shapes = pin.buildGeomFromUrdfString(
                self._full,
                self._xml,
                pin.GeometryType.COLLISION,
                package_dirs=[str(folder) for folder in self.path.resolve().parents],
            )
        _, reduced = pin.buildReducedModel(self._full, shapes, self._locked, self._reference)
        return enclosing_capsules(reduced)

    def _links(self) -> list[str]:
        return [f.name for f in self._full.frames if f.type == pin.FrameType.BODY]

    def _default_flange(self) -> str:
        bodies = [f for f in self._full.frames if f.type == pin.FrameType.BODY]
        return max(
            reversed(bodies), key=lambda frame: len(self._full.supports[frame.parentJoint])
        ).name

    def _check_limits(self) -> None:
        model = self.model
        if model.njoints < 2:
            raise DataFileError(self.path, "joints", 0, f"a moving joint before {self.flange}")
        for joint in range(1, model.njoints):
            low = model.lowerPositionLimit[model.idx_qs[joint]]
            high = model.upperPositionLimit[model.idx_qs[joint]]
            if not (math.isfinite(low) and math.isfinite(high) and low <= high):
                raise DataFileError(
                    self.path, f"limit of joint {model.names[joint]}", (low, high), "lower <= upper"
                )


def _one_of(names: list[str]) -> str:
    return f"one of {', '.join(names)}"


def _read(path: Path) -> str:
    try:
        tree = ElementTree.parse(path)
    except OSError as error:
        raise DataFileError(path, "file", error.strerror, "a readable URDF file") from None
    except (ElementTree.ParseError, UnicodeDecodeError, ValueError) as error:
        raise DataFileError(path, "file", str(error), "well-formed XML") from None
    if tree.getroot().tag != "robot":
        raise DataFileError(path, "root element", tree.getroot().tag, "robot")
    for joint in tree.iter("joint"):
        if joint.get("type") == "continuous":
            joint.set("type", "revolute")
            limit = joint.find("limit")
            if limit is None:
                limit = ElementTree.SubElement(joint, "limit", effort="0", velocity="0")
            limit.set("lower", repr(-2 * math.pi))
            limit.set("upper", repr(2 * math.pi))
    return ElementTree.tostring(tree.getroot(), encoding="unicode")


@contextmanager
def _reason(path: Path, expected: str) -> Iterator[None]:
    """Turn a failure of the parser into one DataFileError.

    The parser writes its reason to the standard error of the process; it is caught there.
    """
    with tempfile.TemporaryFile() as sink:
        saved = os.dup(2)
        os.dup2(sink.fileno(), 2)
        try:
            yield
        except (ValueError, RuntimeError, IndexError) as error:
            sink.seek(0)
            said = re.search(r"^Error:\s*(.+)$", sink.read().decode(errors="replace"), re.M)
            value = said[1] if said else str(error)
            raise DataFileError(path, "content", value, expected) from None
        finally:
            os.dup2(saved, 2)
            os.close(saved)
