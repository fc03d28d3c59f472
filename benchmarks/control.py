"""One control step of two seven-joint arms: kinematics, all distances, avoidance rows and QP."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from importlib.util import find_spec

import daqp
import numpy as np
import pinocchio as pin
from timing import OURS, Row, timed

from dualarm_repro.control.controller import VelocityController
from dualarm_repro.control.frozen import FrozenScenario
from dualarm_repro.control.settings import ControllerSettings
from dualarm_repro.control.simulate import simulate
from dualarm_repro.control.solvers import SOLVERS, solve
from dualarm_repro.papers.patent.document import frozen

TASK = "control step of two Pandas with avoidance"
DT, LOOP = 1e-3, 200
SAME = 1e-3  # difference of two minimisers [rad/s]
# Share of the tip velocity by which a peer may miss the path, which to pink and mink is a weighted
# aim and no constraint; the avoidance rows have to hold.
ALIKE = 0.05
PINK_PAIRS = 8  # nearest pairs watched by the peer's barrier, fewer than the 143 watched here


def measure() -> Iterator[Row]:
    """Rows of this suite; peers that are not installed are left out."""
    scenario, settings = frozen("crossing"), ControllerSettings()
    motion = simulate(scenario.system, scenario.circles, scenario.q0, settings)
    busy = np.flatnonzero(motion.rows > 0)
    picked = busy[:: max(1, len(busy) // LOOP)][:LOOP]
    samples = [(motion.q[k], *scenario.circles.at(motion.time[k])) for k in picked]
    controller = VelocityController(scenario.system, settings)
    steps: dict[str, Callable] = {
        OURS: controller.velocity,
        "kinematics and rows here, DAQP": _daqp(controller),
    }
    for module, name, peer in (
        ("pink", "pin-pink, self-collision barrier", _pink),
        ("mink", "mink, collision avoidance limit", _mink),
    ):
        if find_spec(module):
            steps[name] = peer(scenario, settings)
    for name, step in steps.items():
        _check_same_motion(name, step, controller, samples)
        yield timed(TASK, name, _loop(step, samples), len(samples))
    yield from _solvers(controller, samples)


def _check_same_motion(
    name: str, step: Callable, controller: VelocityController, samples: list
) -> None:
    """Every peer moves the tips as asked and keeps the arms apart, or nothing is compared."""
    for sample in samples:
        x, p = step(*sample), controller.problem(*sample)
        off = float(np.abs(p.A @ x - p.b).max())
        approach = float((p.G @ x - p.h).max(initial=0.0))
        if not (off <= ALIKE * np.abs(p.b).max() and approach <= 1e-9):
            raise RuntimeError(f"{name}: off the path by {off:.1e}, too near by {approach:.1e} m/s")


def _solvers(controller: VelocityController, samples: list) -> Iterator[Row]:
    """The problems alone: the same minimiser from every solver, certified by each."""
    problems = [controller.problem(*sample) for sample in samples]
    exact = np.array([solve(p).x for p in problems])
    for solver in SOLVERS:
        if solver == "cvxpy":  # a language for problems, not a solver for a loop
            continue
        found = np.array([solve(p, solver).x for p in problems])
        if np.abs(found - exact).max() > SAME:
            raise RuntimeError(f"{solver} finds another minimiser")
        name = OURS if solver == "active_set" else solver
        call = partial(_solve_all, problems, solver)
        yield timed("velocity problem, certified answer", name, call, len(problems))


def _solve_all(problems: list, solver: str) -> None:
    for problem in problems:
        solve(problem, solver)


def _loop(step: Callable, samples: list) -> Callable[[], None]:
    def run() -> None:
        for sample in samples:
            step(*sample)

    return run


def _daqp(controller: VelocityController) -> Callable:
    def step(q: np.ndarray, position: np.ndarray, velocity: np.ndarray) -> np.ndarray:
        p = controller.problem(q, position, velocity)
        m = len(p.b)
        rows, sense = np.vstack([p.A, p.G]), np.zeros(p.size + m + len(p.h), dtype=np.int32)
        sense[p.size : p.size + m] = 5
        upper = np.concatenate([p.upper, p.b, p.h])
        lower = np.concatenate([p.lower, p.b, np.full(len(p.h), -1e30)])
        return daqp.solve(np.eye(p.size), -p.target, rows, upper, lower, sense)[0]

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


def _mink(scenario: FrozenScenario, settings: ControllerSettings) -> Callable:
    """Both arms in one MuJoCo model with their capsules; the same task, limits and damper."""
    import mink
    import mujoco

    model = mujoco.MjModel.from_xml_string(_mujoco_text(scenario))
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
        gain=DT * DT * settings.damper_gain,  # it bounds a displacement by gain (d - min) / dt
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


def _mujoco_text(scenario: FrozenScenario) -> str:
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
