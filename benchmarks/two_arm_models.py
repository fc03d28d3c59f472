"""Two arms with their capsules as one model of Pinocchio and as one of MuJoCo."""

from __future__ import annotations

import numpy as np
import pinocchio as pin

from dualarm_repro.control.frozen import FrozenScenario


def mujoco_text(scenario: FrozenScenario) -> str:
    """MJCF of both arms: hinges about z, capsules, a site at each flange."""

    def pose(placement: pin.SE3) -> str:
        x, y, z, w = pin.Quaternion(placement.rotation).coeffs()
        numbers = " ".join(f"{v:.17g}" for v in placement.translation)
        return f'pos="{numbers}" quat="{w:.17g} {x:.17g} {y:.17g} {z:.17g}"'

    text = []
    for placed in scenario.system.arms:
        arm = placed.arm
        shapes: dict[int, list[str]] = {k: [] for k in range(arm.model.njoints)}
        for shape in arm.geometry.geometryObjects:
            size = f"{shape.geometry.radius:.17g} {shape.geometry.halfLength:.17g}"
            shapes[shape.parentJoint].append(
                f'<geom name="{placed.name}_{shape.name}" type="capsule" size="{size}" '
                f"{pose(shape.placement)} />"
            )
        text.append(f'<body name="{placed.name}" {pose(placed.placement)}>{"".join(shapes[0])}')
        for k in range(1, arm.model.njoints):
            low, high = arm.lower[k - 1], arm.upper[k - 1]
            text.append(
                f'<body {pose(arm.model.jointPlacements[k])}><inertial pos="0 0 0" mass="1" '
                f'diaginertia="1 1 1"/><joint name="{placed.name}_{k - 1}" type="hinge" '
                f'axis="0 0 1" limited="true" range="{low:.17g} {high:.17g}"/>{"".join(shapes[k])}'
            )
        flange = arm.model.frames[arm.flange_id].placement
        text.append(f'<site name="{placed.name}_tip" {pose(flange)}/>')
        text.append("</body>" * arm.model.njoints)
    options = '<compiler angle="radian"/><option><flag contact="disable"/></option>'
    return f"<mujoco>{options}<worldbody>{''.join(text)}</worldbody></mujoco>"


def two_arm_model(scenario: FrozenScenario) -> tuple[pin.Model, pin.GeometryModel, list[str]]:
    """One model of both arms with all pairs of capsules of different arms."""
    model, geometry, tips, owners = pin.Model(), pin.GeometryModel(), [], []
    for placed in scenario.system.arms:
        arm, joints = placed.arm, [0]
        for k in range(1, arm.model.njoints):
            placement = arm.model.jointPlacements[k]
            if k == 1:
                placement = placed.placement * placement
            name, speed = f"{placed.name}_{arm.model.names[k]}", arm.velocity_limit[k - 1 : k]
            limits = (np.full(1, 1e3), speed, arm.lower[k - 1 : k], arm.upper[k - 1 : k])
            joints.append(model.addJoint(joints[-1], arm.model.joints[k], placement, name, *limits))
        flange = arm.model.frames[arm.flange_id]
        tips.append(f"{placed.name}_tip")
        model.addFrame(pin.Frame(tips[-1], joints[-1], 0, flange.placement, pin.FrameType.OP_FRAME))
        for shape in arm.geometry.geometryObjects:
            joint = joints[shape.parentJoint]
            pose = placed.placement * shape.placement if joint == 0 else shape.placement
            name = f"{placed.name}_{shape.name}"
            geometry.addGeometryObject(pin.GeometryObject(name, joint, pose, shape.geometry))
            owners.append((placed.name, joint))
    for i, (left, a) in enumerate(owners):
        for j, (right, b) in enumerate(owners[i + 1 :], start=i + 1):
            if left != right and (a or b):
                geometry.addCollisionPair(pin.CollisionPair(i, j))
    return model, geometry, tips
