"""Scenes of a user's own for the tests of gate and truth, and a replay that knows only coal."""

import coal
import numpy as np
import pinocchio as pin

#: Two IRB 120 face to face, 0.8 m apart. The left one turns through the place of the right one.
LEFT = (
    "left: {robot: irb120, xyz: [-0.4, 0, 0], "
    'start: ["60 deg", "60 deg", -0.5, 0, 0, 0], goal: ["-60 deg", "60 deg", -0.5, 0, 0, 0]}'
)
RIGHT = (
    'right: {robot: irb120, xyz: [0.4, 0, 0], rpy: [0, 0, pi], start: [0, "60 deg", -0.5, 0, 0, 0]}'
)
FLOOR = (
    "floor: 0\nexempt:\n  - [left/capsule_1_joint_1, floor]\n  - [right/capsule_1_joint_1, floor]\n"
)


def both(left, right, rest=""):
    """Two IRB 120 face to face with the ends of each as flow mappings."""
    return (
        f"arms:\n  left: {{robot: irb120, xyz: [-0.4, 0, 0], {left}}}\n"
        f"  right: {{robot: irb120, xyz: [0.4, 0, 0], rpy: [0, 0, pi], {right}}}\n{rest}"
    )


def written(folder, text, name="cell.yaml"):
    """The path of a scene file with this text."""
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def coal_bodies(placed, q):
    """Capsules of an arm in the world by Pinocchio: names, joints, coal shapes and placements."""
    model = placed.arm.model
    data = model.createData()
    pin.forwardKinematics(model, data, np.asarray(q, dtype=float))
    return [
        (
            g.name,
            g.parentJoint,
            g.geometry,
            placed.placement * data.oMi[g.parentJoint] * g.placement,
        )
        for g in placed.arm.geometry.geometryObjects
    ]


def coal_distance(one, other):
    """Signed distance of two (shape, pin.SE3) pairs."""
    (a, at), (b, to) = one, other
    places = [coal.Transform3s(m.rotation, m.translation) for m in (at, to)]
    return coal.distance(a, places[0], b, places[1], coal.DistanceRequest(), coal.DistanceResult())


def replayed(scene, paths, solids=(), steps=12):
    """Smallest distance along a motion by coal, sampled densely: links of different arms
    with each other, and links but the first ones with solids (shape, pin.SE3)."""
    index = np.unique(np.concatenate([path.index for path in paths.values()]))
    fine = np.interp(
        np.linspace(0, len(index) - 1, steps * (len(index) - 1) + 1), range(len(index)), index
    )
    smallest = np.inf
    for time in fine:
        arms = [coal_bodies(one, paths[one.name].at(np.array([time]))[0]) for one in scene.arms]
        for k, bodies in enumerate(arms):
            others = [body for more in arms[k + 1 :] for body in more]
            for _, joint, shape, at in bodies:
                for _, _, other, to in others:
                    smallest = min(smallest, coal_distance((shape, at), (other, to)))
                for solid in solids if joint > 1 else ():
                    smallest = min(smallest, coal_distance((shape, at), solid))
    return smallest
