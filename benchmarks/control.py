"""One control step of two seven-joint arms: kinematics, all distances, avoidance rows and QP."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from importlib.util import find_spec

import daqp
import numpy as np
import pinocchio as pin
from timing import OURS, Row, timed

from dualarm_repro.control.controller import VelocityController
from dualarm_repro.control.frozen import FrozenScenario
from dualarm_repro.control.settings import ControllerSettings
from dualarm_repro.control.simulate import simulate
from dualarm_repro.papers.patent.document import frozen

TASK = "control step of two Pandas with avoidance"
DT, LOOP = 1e-3, 200
PINK_PAIRS = 8  # nearest pairs watched by the peer's barrier, fewer than the 143 watched here


def measure() -> Iterator[Row]:
    """Rows of this suite; peers that are not installed are left out."""
    scenario, settings = frozen("crossing"), ControllerSettings()
    motion = simulate(scenario.system, scenario.circles, scenario.q0, settings)
    busy = np.flatnonzero(motion.rows > 0)
    picked = busy[:: max(1, len(busy) // LOOP)][:LOOP]
    samples = [(motion.q[k], *scenario.circles.at(motion.time[k])) for k in picked]
    controller = VelocityController(scenario.system, settings)
    yield timed(TASK, OURS, _loop(controller.velocity, samples), len(samples))
    yield timed(
        TASK, "kinematics and rows here, DAQP", _loop(_daqp(controller), samples), len(samples)
    )
    if find_spec("pink"):
        yield timed(
            TASK,
            "pin-pink, self-collision barrier",
            _loop(_pink(scenario, settings), samples),
            len(samples),
        )


def _loop(step: Callable, samples: list) -> Callable[[], None]:
    def run() -> None:
        for sample in samples:
            step(*sample)

    return run


def _daqp(controller: VelocityController) -> Callable:
    def step(q: np.ndarray, position: np.ndarray, velocity: np.ndarray) -> None:
        p = controller.problem(q, position, velocity)
        m = len(p.b)
        rows, sense = np.vstack([p.A, p.G]), np.zeros(p.size + m + len(p.h), dtype=np.int32)
        sense[p.size : p.size + m] = 5
        upper = np.concatenate([p.upper, p.b, p.h])
        lower = np.concatenate([p.lower, p.b, np.full(len(p.h), -1e30)])
        daqp.solve(np.eye(p.size), -p.target, rows, upper, lower, sense)

    return step


def _pink(scenario: FrozenScenario, settings: ControllerSettings) -> Callable:
    """Both arms in one model with their capsules; the same task, limits and damper."""
    import pink
    from pink.barriers import SelfCollisionBarrier
    from pink.limits import ConfigurationLimit, VelocityLimit
    from pink.tasks import FrameTask

    model, geometry, tips = _two_arm_model(scenario)
    tasks = [
        FrameTask(tip, position_cost=1.0, orientation_cost=0.0, gain=DT * settings.feedback)
        for tip in tips
    ]
    barrier = SelfCollisionBarrier(
        PINK_PAIRS, gain=settings.damper_gain, safe_displacement_gain=0.0, d_min=settings.inner
    )
    tighter = model.copy()
    tighter.lowerPositionLimit += settings.limit_margin
    tighter.upperPositionLimit -= settings.limit_margin
    limits = [
        ConfigurationLimit(tighter, config_limit_gain=DT * settings.limit_gain),
        VelocityLimit(model),
    ]
    configuration = pink.Configuration(
        model,
        model.createData(),
        scenario.q0,
        collision_model=geometry,
        collision_data=geometry.createData(),
    )

    def step(q: np.ndarray, position: np.ndarray, velocity: np.ndarray) -> np.ndarray:
        configuration.update(q)
        for task, goal, rate in zip(tasks, position, velocity, strict=True):
            # The task's error is corrected by its gain; the rate of the path is added to the goal.
            shifted = goal + rate / settings.feedback
            task.set_target(
                pin.SE3(configuration.get_transform_frame_to_world(task.frame).rotation, shifted)
            )
        return pink.solve_ik(
            *(configuration, tasks, DT),
            solver="daqp",
            barriers=[barrier],
            limits=limits,
            damping=1e-9,
            safety_break=False,
        )

    return step


def _two_arm_model(scenario: FrozenScenario) -> tuple[pin.Model, pin.GeometryModel, list[str]]:
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
