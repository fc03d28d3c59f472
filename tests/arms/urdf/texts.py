"""URDF text for tests, and forward kinematics of it by the rules of the format."""

import math
from xml.etree import ElementTree

import numpy as np

LIMIT = "<limit lower='-2.5' upper='2.5' effort='10' velocity='2'/>"
ROD = "<cylinder radius='0.05' length='0.3'/>"


def link(name, shape=ROD, tag="collision", origin="<origin xyz='0 0 0.15'/>"):
    """A link with one shape, or none."""
    body = f"<{tag}>{origin}<geometry>{shape}</geometry></{tag}>" if shape else ""
    return f"<link name='{name}'>{body}</link>"


def joint(name, parent, child, kind="revolute", axis="0 0 1", limit=LIMIT, extra=""):
    """A joint 0.3 m above its parent."""
    return (
        f"<joint name='{name}' type='{kind}'><parent link='{parent}'/><child link='{child}'/>"
        f"<origin xyz='0 0 0.3' rpy='0.1 0.2 0.3'/><axis xyz='{axis}'/>{limit}{extra}</joint>"
    )


def write(folder, *parts, name="arm.urdf"):
    """The file of a robot."""
    path = folder / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f"<robot name='r'>{''.join(parts)}</robot>", encoding="utf-8")
    return path


def one_link(folder, shape, **options):
    """A joint that carries one link."""
    return write(folder, link("b", None), link("l1", shape, **options), joint("j1", "b", "l1"))


def _turn(axis, angle):
    x, y, z = axis / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross


def forward(path, tip, values):
    """T of a link by its own rules: origin, then motion about or along the axis."""
    root = ElementTree.parse(path).getroot()
    up = {one.find("child").get("link"): one for one in root.findall("joint")}
    pose = np.eye(4)
    while tip in up:
        one = up[tip]
        roll, pitch, yaw = map(float, one.find("origin").get("rpy").split())
        step = np.eye(4)
        step[:3, :3] = (
            _turn(np.array([0, 0, 1.0]), yaw)
            @ _turn(np.array([0, 1.0, 0]), pitch)
            @ _turn(np.array([1.0, 0, 0]), roll)
        )
        step[:3, 3] = [float(x) for x in one.find("origin").get("xyz").split()]
        axis = np.array([float(x) for x in one.find("axis").get("xyz").split()])
        motion, value = np.eye(4), values.get(one.get("name"), 0.0)
        if one.get("type") == "prismatic":
            motion[:3, 3] = axis / np.linalg.norm(axis) * value
        elif one.get("type") != "fixed":
            motion[:3, :3] = _turn(axis, value)
        pose, tip = step @ motion @ pose, one.find("parent").get("link")
    return pose
