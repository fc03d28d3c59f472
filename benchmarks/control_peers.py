"""The control step of two arms by pin-pink and by mink: the same task, limits and damper."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pinocchio as pin
from two_arm_models import mujoco_text, two_arm_model

from dualarm_repro.control.frozen import FrozenScenario
from dualarm_repro.control.settings import ControllerSettings

DT = 1e-3  # [s]
PINK_PAIRS = 8  # nearest pairs watched by the peer's barrier, fewer than the 143 watched here
Step = Callable[[np.ndarray, np.ndarray, np.ndarray], np.ndarray]


def pink_step(scenario: FrozenScenario, settings: ControllerSettings) -> Step:
    """Both arms in one model with their capsules; the same task, limits and damper."""
    import pink
    from pink.barriers import SelfCollisionBarrier
    from pink.limits import ConfigurationLimit, VelocityLimit
    from pink.tasks import FrameTask

    model, geometry, tips = two_arm_model(scenario)
    tasks = [FrameTask(tip, position_cost=1.0, orientation_cost=0.0, gain=1.0) for tip in tips]
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
            # The place after one step: of a target farther away the task sees a turn as a shift.
            pose = configuration.get_transform_frame_to_world(task.frame)
            way = DT * (rate + settings.feedback * (goal - pose.translation))
            task.set_target(pin.SE3(pose.rotation, pose.translation + way))
        return pink.solve_ik(
            *(configuration, tasks, DT),
            solver="daqp",
            barriers=[barrier],
            limits=limits,
            damping=1e-9,
            safety_break=False,
        )

    return step


def mink_step(scenario: FrozenScenario, settings: ControllerSettings) -> Step:
    """Both arms in one MuJoCo model with their capsules; the same task, limits and damper."""
    import mink
    import mujoco

    model = mujoco.MjModel.from_xml_string(mujoco_text(scenario))
    configuration = mink.Configuration(model)
    names = [placed.name for placed in scenario.system.arms]
    tasks = [
        mink.FrameTask(f"{name}_tip", "site", position_cost=1.0, orientation_cost=0.0, gain=1.0)
        for name in names
    ]
    for task in tasks:
        task.gain = DT * settings.feedback
    groups = [
        [mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_GEOM, g) for g in range(model.ngeom)]
        for _ in names
    ]
    left, right = (
        [g for g in group if g.startswith(f"{name}_")]
        for group, name in zip(groups, names, strict=True)
    )
    avoidance = mink.CollisionAvoidanceLimit(
        model,
        [(left, right)],
        gain=DT * DT * settings.damper_gain,  # its bound divides by the step what it holds a way to
        minimum_distance_from_collisions=settings.inner,
        collision_detection_distance=settings.outer,
    )
    speeds = {
        f"{placed.name}_{k}": float(v)
        for placed in scenario.system.arms
        for k, v in enumerate(placed.arm.velocity_limit)
    }
    limits = [
        mink.ConfigurationLimit(
            model, DT * settings.limit_gain, min_distance_from_limits=settings.limit_margin
        ),
        mink.VelocityLimit(model, {name: np.array([v]) for name, v in speeds.items()}),
        avoidance,
    ]

    def step(q: np.ndarray, position: np.ndarray, velocity: np.ndarray) -> np.ndarray:
        configuration.update(q)
        for task, goal, rate in zip(tasks, position, velocity, strict=True):
            pose = configuration.get_transform_frame_to_world(task.frame_name, "site")
            shifted = goal + rate / settings.feedback
            task.set_target(mink.SE3.from_rotation_and_translation(pose.rotation(), shifted))
        return mink.solve_ik(configuration, tasks, DT, "daqp", 1e-9, limits=limits)

    return step
