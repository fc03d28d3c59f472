"""A valid argument for every parameter of the public functions: by entry, by name or by type."""

import sys
from functools import cache
from pathlib import Path

import numpy as np
import pinocchio as pin

sys.path.insert(0, str(Path(__file__).parents[1] / "planning"))  # the arrangement of its tests

from window_scene import IMPROVED, window

from dualarm_repro import arms, control, planning, scene, welding
from dualarm_repro.arms import load_arm, load_robot_file
from dualarm_repro.control.frozen import arm_pair
from dualarm_repro.control.readings import Readings
from dualarm_repro.datafiles import data_path
from dualarm_repro.errors import InputError
from dualarm_repro.planning.descent.problem import problem

Q6 = np.array([0.1, 0.3, -0.4, 0.2, 0.5, -0.3])
GOAL6 = Q6 + 0.1
TASKS = """scene: cell.yaml
tasks:
  arm: {start: [0.1, 0.3, -0.4, 0.2, 0.5, -0.3], goal: [0.2, 0.4, -0.3, 0.3, 0.6, -0.2]}
"""
CELL = """arms:
  arm: {robot: irb120, xyz: [0, 0, 0]}
obstacles:
  ball: {kind: sphere, center: [0.9, 0.9, 0.9], radius: 0.1}
"""
BOX = np.array([[-0.1, 0.1], [0.0, 0.2], [1.0, 1.2]])


def rng():
    """A generator that every call begins with anew."""
    return np.random.default_rng(7)


def fitness(points):
    """Largest in the middle of the box."""
    return 2.0 - np.sum((np.asarray(points) - [0.0, 0.1, 1.1]) ** 2, axis=-1)


@cache
def folder():
    """Files of a cell with one arm, and what it is to do."""
    import tempfile

    made = Path(tempfile.mkdtemp(prefix="fuzz-"))
    (made / "cell.yaml").write_text(CELL, encoding="utf-8")
    (made / "tasks.yaml").write_text(TASKS, encoding="utf-8")
    return made


@cache
def made(name):
    """One of the objects that entries work on, built when it is first asked for."""
    return _MAKERS[name]()


def _scene():
    arm, turn = made("arm"), pin.rpy.rpyToMatrix(0.0, 0.0, np.pi / 2)
    placed = [
        scene.PlacedArm(side, arm, pin.SE3(turn, np.array([x, 0.0, 0.0])))
        for side, x in (("left", 0.4), ("right", -0.4))
    ]
    stone = scene.ConvexHull(0.1 * rng().normal(size=(10, 3)) + [0.1, 0.5, 0.9])
    things = {"ball": made("shape"), "wall": scene.HalfSpace((0, 1, 0), -0.5)}
    return scene.Scene(placed, {**things, "block": made("box_shape")}), stone


def _cell():
    return welding.assemble(**{k: v for k, v in VALID["welding.assemble"]().items()})


def _bases():
    bases = np.tile(np.eye(4), (3, 1, 1))
    bases[:, :3, 3] = [[1.0, -1.0, 0.05], [-1.0, -1.0, 0.05], [0.0, 1.0, 0.0]]
    return bases


def _program():
    random, n = rng(), 14
    x = random.normal(size=n)
    A, G = random.normal(size=(6, n)), random.normal(size=(5, n))
    return {
        "target": 0.1 * random.normal(size=n),
        **{"A": A, "b": A @ x, "G": G, "h": G @ x + 0.1, "lower": x - 1.0, "upper": x + 1.0},
    }


def _circles(**timing):
    tips = made("system").tips(made("q_pair"))
    normals = np.tile([1.0, 0.0, 0.0], (2, 1))
    return {
        "tips": tips,
        "normals": normals,
        "angles": np.array([0.1, 0.2]),
        "radius": 0.03,
        **timing,
    }


def _plan():
    return planning.plan_apf_compiled(**VALID["planning.plan_apf"]())


def _points(arm="arm"):
    return planning.control_points(made(arm), "end_effector")


def _coordinated():
    return planning.plan_master_slave(**VALID["planning.plan_master_slave"]())


_MAKERS = {
    "arm": lambda: load_arm("irb120"),
    "robot": lambda: load_robot_file(data_path("robots", "irb120.yaml")),
    "welder": lambda: load_arm("kr16-2"),
    "shape": lambda: scene.Sphere((0.9, 0.9, 0.9), 0.1),
    "box_shape": lambda: scene.Box((0.0, 0.9, 0.4), (0.1, 0.2, 0.3)),
    "capsule": lambda: scene.Capsule((0.0, 0.2, 0.1), (0.1, 0.2, 0.9), 0.05),
    "half_space": lambda: scene.HalfSpace((0.0, 0.0, 1.0), -0.5),
    "hull": lambda: scene.ConvexHull(rng().normal(size=(10, 3))),
    "pose": lambda: pin.SE3(pin.rpy.rpyToMatrix(0.1, 0.2, 0.3), np.array([0.1, 0.2, 0.3])),
    "placed": lambda: scene.PlacedArm("arm", made("arm")),
    "obstacles": lambda: planning.obstacles_of(made("alone"), ()),
    "alone": lambda: scene.Scene([made("placed")], {"ball": made("shape")}),
    "scene": lambda: _scene()[0],
    "moving_scene": lambda: scene.Scene(
        made("scene").arms, {**made("scene").obstacles, "stone": _scene()[1]}
    ),
    "path": lambda: scene.JointPath([Q6, GOAL6]),
    "pose_path": lambda: scene.PosePath([pin.SE3.Identity(), made("pose")]),
    "system": lambda: arm_pair(load_arm("xarm7"), 0.6),
    "q_pair": lambda: np.tile([0.2, 0.3, 0.1, 0.9, -0.2, 0.6, 0.3], 2),
    "circles": lambda: control.Circles.through(**_circles(duration=0.02)),
    "settings": lambda: IMPROVED.changed(termination=IMPROVED.termination.changed(step_limit=15)),
    "control_settings": lambda: control.ControllerSettings(),
    "network": lambda: control.NetworkSettings(),
    "readings": lambda: Readings.of(
        made("system"), noise=np.full((3, len(made("system").arrays.pairs)), 1e-4), delay=1
    ),
    "motion": lambda: control.simulate(
        made("system"), made("circles"), made("q_pair"), made("control_settings")
    ),
    "controller": lambda: control.VelocityController(made("system")),
    "program": lambda: control.QuadraticProgram(**_program()),
    "solution": lambda: control.solve(made("program")),
    "cell": _cell,
    "seam": lambda: welding.saddle_seam(0.1, 0.06, 6),
    "torch": lambda: welding.Torch(0.35, 0.0, 0.02, 0.10),
    "tools": lambda: welding.Tools("axial", 0.15, 0.06, made("torch"), "along_bisector"),
    "workpiece": lambda: welding.Workpiece(0.1, 0.06, 0.6, 0.15, 6),
    "placement": lambda: welding.Placement(made("cell"), welding.Objective()),
    "jobs": lambda: made("placement").jobs(np.array([[0.0, 0.1, 1.1]])),
    "separation": lambda: welding.Separation(made("cell")),
    "search": lambda: welding.GeneticSettings(population=8, generations=2),
    "survey": lambda: welding.survey(made("placement"), BOX, 0.2),
    "points": _points,
    "plan": _plan,
    "coordinated": _coordinated,
    "planning_problem": lambda: problem(
        made("placed"), Q6, GOAL6, made("obstacles"), made("settings")
    ),
    "path_problem": lambda: planning.PathProblem(made("alone"), Q6, GOAL6),
    "occupancy": lambda: arms.occupancy(made("arm"), 0.2, rng(), 500),
    "witness": lambda: scene.signed_distance(made("shape"), made("capsule")),
    "joint_pull": lambda: planning.JointAttraction(GOAL6, 1.0),
    "position_pull": lambda: planning.PositionAttraction(made("placed"), np.ones(3), 1.0),
    "repulsion": lambda: planning.PointRepulsion(**VALID["planning.PointRepulsion"]()),
    "sum": lambda: planning.Sum([made("joint_pull"), made("position_pull")]),
    "link_clearance": lambda: planning.link_clearance(
        made("scene"), {"left": made("path"), "right": made("path")}, 0.1
    ),
    "task_set": lambda: planning.load_tasks(folder() / "tasks.yaml"),
    "scenario": lambda: control.load_scenario(data_path("scenes", "patent_crossing_xarm7.yaml")),
    "method": lambda: planning.method("apf-improved"),
}

#: The object whose methods are called, by class.
INSTANCES = {
    "arms.Arm": "arm",
    "arms.DHRobot": "robot",
    "arms.Occupancy": "occupancy",
    "scene.Box": "box_shape",
    "scene.Capsule": "capsule",
    "scene.ConvexHull": "hull",
    "scene.HalfSpace": "half_space",
    "scene.JointPath": "path",
    "scene.PosePath": "pose_path",
    "scene.Scene": "scene",
    "scene.Sphere": "shape",
    "scene.Witness": "witness",
    "planning.CoordinatedPlan": "coordinated",
    "planning.JointAttraction": "joint_pull",
    "planning.LinkClearance": "link_clearance",
    "planning.Method": "method",
    "planning.Obstacles": "obstacles",
    "planning.PathProblem": "path_problem",
    "planning.Plan": "plan",
    "planning.PointRepulsion": "repulsion",
    "planning.PositionAttraction": "position_pull",
    "planning.Sum": "sum",
    "control.ArmSystem": "system",
    "control.Circles": "circles",
    "control.ControllerSettings": "control_settings",
    "control.Motion": "motion",
    "control.NetworkSettings": "network",
    "control.Solution": "solution",
    "control.VelocityController": "controller",
    "welding.Cell": "cell",
    "welding.Jobs": "jobs",
    "welding.Objective": "objective",
    "welding.Placement": "placement",
    "welding.Separation": "separation",
}
_MAKERS["objective"] = welding.Objective


def _both():
    return {"left": made("path"), "right": made("path")}


def _run(**more):
    return {
        **{"system": made("system"), "circles": made("circles"), "q0": made("q_pair")},
        **{"settings": made("control_settings"), "dt": 1e-3, **more},
    }


def _states():
    """Per joint and task row: what a network begins with, and what pushes it in three steps."""
    size = made("system").nq + 6
    return {"y0": np.zeros(size), "disturbance": np.full((3, size), 0.01)}


def _field(**more):
    return {"placed": made("placed"), "obstacles": made("obstacles"), **more}


def _descent(start="start"):
    ends = Q6 if start == "start" else np.array([Q6, 0.9 * Q6])
    return _field(**{start: ends}, goal=GOAL6, settings=made("settings"))


def _jobs(**more):
    return {"cell": made("cell"), "jobs": made("jobs"), **more}


#: Arguments of an entry; what is not named here is taken by its name from :data:`BY_NAME`.
VALID = {
    "arms.Arm.ik": lambda: {"T": made("arm").fk(Q6), "reference": Q6, "within_limits": True},
    "arms.Arm.ik_branches": lambda: {"T": made("arm").fk(np.array([Q6, GOAL6])), "reference": Q6},
    "arms.Arm.within_limits": lambda: {"q": Q6, "tolerance": 0.1},
    "arms.Arm.random_configurations": lambda: {"n": 3, "rng": rng()},
    "arms.Arm.limits": lambda: {"enforced": True},
    "arms.Arm.difference": lambda: {"start": Q6, "end": GOAL6},
    "arms.Arm.distance": lambda: {"start": Q6, "end": GOAL6},
    "arms.Arm.nearest": lambda: {"q": Q6, "reference": GOAL6},
    "arms.Arm.from_dh": lambda: {"name": "a", "robot": made("robot"), "shapes": "none"},
    "arms.Arm.reshaped": lambda: {"geometry": lambda: made("arm").geometry, "name": "b"},
    "arms.Exclusion": lambda: {
        **{"first": "a", "second": "b", "evidence": arms.Evidence.ADJACENT},
        **{"touching": 1, "sampled": 2, "flagged": 0},
    },
    "arms.Occupancy.contains": lambda: {"points": rng().normal(size=(4, 3))},
    "arms.load_arm": lambda: {
        **{"name_or_path": "ur5", "flange": "tool0", "lock": {"wrist_3_joint": 0.1}},
        **{"shapes": "none", "packages": []},
    },
    "arms.load_robot_file": lambda: {"path": data_path("robots", "irb120.yaml")},
    "arms.occupancy": lambda: {"arm": made("arm"), "cell": 0.2, "rng": rng(), "samples": 500},
    "arms.rotation_volumes": lambda: {
        **{"arm": made("arm"), "cells": [0.2], "seed": 3, "samples": 500}
    },
    "arms.sample_workspace": lambda: {"arm": made("arm"), "n": 5, "rng": rng()},
    "arms.extents": lambda: {"points": rng().normal(size=(9, 3))},
    "arms.voxel_volume": lambda: {"points": rng().normal(size=(9, 3)), "cells": [0.2, 0.1]},
    "arms.wrist_geometry": lambda: {"name": "a", "chain": made("arm").chain},
    "scene.Box": lambda: {"center": np.zeros(3), "size": np.ones(3), "rotation": np.eye(3)},
    "scene.Capsule": lambda: {"start": np.zeros(3), "end": np.ones(3), "radius": 0.1},
    "scene.Sphere": lambda: {"center": np.zeros(3), "radius": 0.1},
    "scene.HalfSpace": lambda: {"normal": np.array([0.0, 0.0, 1.0]), "offset": 0.1},
    "scene.ConvexHull": lambda: {"points": rng().normal(size=(9, 3))},
    "scene.JointPath": lambda: {"configurations": np.array([Q6, GOAL6]), "index": [0.0, 2.0]},
    "scene.MovingArm": lambda: {
        "arm": made("arm"),
        "path": made("path"),
        "placement": made("pose"),
    },
    "scene.MovingShape": lambda: {"shape": made("capsule"), "path": made("pose_path")},
    "scene.PlacedArm": lambda: {
        **{"name": "a", "arm": made("arm"), "placement": made("pose"), "start": Q6, "goal": GOAL6}
    },
    "scene.PosePath": lambda: {"poses": [pin.SE3.Identity(), made("pose")], "index": [0.0, 2.0]},
    "scene.Scene": lambda: {
        **{
            "arms": list(made("scene").arms),
            "obstacles": {"ball": made("shape"), "window": list(window())},
        },
        **{"moving": {"m": scene.MovingShape(made("capsule"), made("pose_path"))}, "floor": -0.1},
        **{"exempt": [("left", "ball")], "self_collision": True},
    },
    "scene.Scene.stack": lambda: {"left": Q6, "right": Q6},
    "scene.Scene.replaying": lambda: {"name": "left", "path": made("path")},
    "scene.certified_minimum": lambda: {
        **{"scene": made("scene"), "path": np.array([[*Q6, *Q6], [*GOAL6, *GOAL6]])},
        **{"index": [0.0, 1.0], "tolerance": 0.01, "enough": 0.1, "budget": 2000},
    },
    "scene.circle_points": lambda: {
        **{"centers": np.zeros((2, 3)), "axes": np.ones((2, 3)), "radii": np.ones(2), "count": 5}
    },
    "scene.densify": lambda: {"path": np.array([Q6, GOAL6]), "max_step": 0.01, "index": [0.0, 1.0]},
    "scene.facing": lambda: {"normal": np.array([1.0, 0.2, 0.0]), "up": np.array([0.0, 0.0, 1.0])},
    "scene.link_frames": lambda: {
        "chain": made("arm").chain,
        "base": np.eye(3, 4),
        "q": Q6[np.newaxis],
    },
    "scene.load_scene": lambda: {"path": folder() / "cell.yaml"},
    "scene.point_distances": lambda: {
        **{"points": rng().normal(size=(4, 3)), "shapes": [made("box_shape"), made("capsule")]}
    },
    "scene.signed_distance": lambda: {"a": made("box_shape"), "b": made("capsule")},
    "scene.window_frame": lambda: {
        **{"center": np.zeros(3), "rotation": np.eye(3), "opening_width": 0.9},
        **{"opening_height": 1.0, "bar_width": 0.1, "bar_depth": 0.1},
    },
    "planning.FoundPath": lambda: {"path": np.array([Q6, GOAL6]), "reason": "reached"},
    "planning.JointAttraction": lambda: {"target": Q6, "gain": 1.0},
    "planning.PositionAttraction": lambda: _position_pull(),
    "planning.PointRepulsion": lambda: _field(
        **{"points": made("points"), "gain": 1.0, "influence": 0.3, "contact": 1e-4},
        combination=planning.Combination.SUM,
    ),
    "planning.Sum": lambda: {"parts": [made("joint_pull")]},
    "planning.PathProblem": lambda: {
        **{"scene": made("alone"), "start": Q6, "goal": GOAL6},
        **{"settings": planning.PlannerSettings(), "evaluations": 0},
    },
    "planning.PathProblem.distances": lambda: {"q": Q6, "time": 0.0},
    "planning.PathProblem.clearance": lambda: {"q": Q6, "time": 0.0},
    "planning.PathProblem.gradient": lambda: {"q": Q6, "time": 0.0},
    "planning.PathProblem.at_rest": lambda: {"method": "apf"},
    "planning.PathProblem.without": lambda: {"others": {}},
    "planning.Task": lambda: {"start": Q6, "goal": GOAL6, "settings": made("settings")},
    "planning.TaskFaults": lambda: {"faults": [InputError("a", "b", 1, "c")]},
    "planning.Method.planned": lambda: {"path": folder() / "tasks.yaml", "allow_collision": False},
    "planning.CoordinatedPlan.links": lambda: {"max_step": 0.1},
    "planning.Obstacles.at": lambda: {"step": 0},
    "planning.Obstacles.moving": lambda: {"step": 0},
    "planning.Obstacles.with_arm": lambda: {
        "placed": made("placed"),
        "points": made("points"),
        "path": made("path"),
    },
    "planning.Obstacles.distances": lambda: {
        "ends": rng().normal(size=(3, 2, 2, 3)),
        "radius": np.array([0.1, 0.1]),
        "step": 0,
    },
    "planning.at_tool_speed": lambda: {"step": 0.01},
    "planning.certified_clearance": lambda: {
        "scene": made("scene"),
        "paths": _both(),
        "tolerance": 0.01,
    },
    "planning.certify": lambda: {"made": made("planning_problem"), "q": Q6, "step": 0},
    "planning.control_points": lambda: {
        **{"arm": made("arm"), "choice": (3, 5), "weights": [1.0, 0.5], "radius": 0.1}
    },
    "planning.link_clearance": lambda: {"scene": made("scene"), "paths": _both(), "max_step": 0.05},
    "planning.load_tasks": lambda: {"path": folder() / "tasks.yaml"},
    "planning.method": lambda: {"name": "apf-improved"},
    "planning.settings_schema": lambda: {"name": "apf-improved"},
    "planning.obstacles_of": lambda: {"scene": made("scene"), "leave_out": ("ball",)},
    "planning.perturbed": lambda: {"start": Q6, "half_width": 0.1, "count": 3, "rng": rng()},
    "planning.plan_apf": _descent,
    "planning.plan_apf_compiled": _descent,
    "planning.plan_cartesian_ik": _descent,
    "planning.plan_batch": lambda: _descent("starts"),
    "planning.plan_cartesian_ik_batch": lambda: _descent("starts"),
    "planning.plan_file": lambda: {"path": folder() / "tasks.yaml", "name": "apf-improved"},
    "planning.plan_master_slave": lambda: {
        **{"scene": made("scene"), "master_points": "joint_points", "radius": 0.05},
        **{"leave_out": (), "tasks": {"left": planning.Task(Q6, GOAL6, made("settings"))}},
    },
    "planning.posture": lambda: {
        **{"placed": made("placed"), "position": np.array([0.3, 0.1, 0.4]), "tool": "down"},
        **{"elbow": "up", "last_joint": 0.1, "reference": None},
    },
    "planning.require_links_clear": lambda: {"scene": made("scene"), "q": {"left": Q6}},
    "planning.require_sound": lambda: {
        **{"source": "x", "scene": made("alone"), "starts": {"arm": Q6}, "goals": {"arm": GOAL6}}
    },
    "planning.truth": lambda: {"scene": made("alone"), "paths": {"arm": made("path")}},
    "control.ArmSystem": lambda: {
        "arms": list(made("system").arms),
        "exempt": (),
        "self_collision": False,
    },
    "control.ArmSystem.configuration": lambda: {"q": made("q_pair")},
    "control.ArmSystem.tips": lambda: {"q": made("q_pair")},
    "control.Circles": lambda: {
        **{"centre": np.zeros((2, 3)), "u": np.ones((2, 3)), "v": np.ones((2, 3))},
        **{"duration": 2.0, "law": "rest_to_rest"},
    },
    "control.Circles.through": lambda: _circles(duration=1.0),
    "control.Circles.at": lambda: {"t": 0.3},
    "control.Motion.drift": lambda: {"period": 0.001},
    "control.NetworkSettings.numbers": lambda: {"dt": 1e-3},
    "control.NoSolution": lambda: {"source": "x", "problem": made("program"), "reason": "none"},
    "control.QuadraticProgram": _program,
    "control.Solution.certified": lambda: {"tolerance": 1e-8},
    "control.VelocityController": lambda: {
        **{"system": made("system"), "settings": made("control_settings")},
        **{"home": made("q_pair"), "slack": False},
    },
    **{
        f"control.VelocityController.{name}": lambda: {
            **{"q": made("q_pair"), "position": made("circles").at(0.0)[0]},
            "velocity": np.zeros((2, 3)),
        }
        for name in ("velocity", "solution", "problem")
    },
    "control.integrate_network": lambda: {
        k: v
        for k, v in _run(
            **{"network": made("network"), "integrator": "bdf", "sample": 0.01},
            y0=_states()["y0"],
        ).items()
        if k != "dt"
    },
    "control.load_scenario": lambda: {"path": data_path("scenes", "patent_crossing.yaml")},
    "control.pseudo_inverse": lambda: {"settings": made("control_settings")},
    "control.recorded_problems": lambda: {
        **{k: v for k, v in _run().items() if k not in ("q0", "dt")},
        **{"motion": made("motion"), "every": 5},
    },
    "control.simulate": lambda: _run(
        **{"cycles": 1, "slack": True, "slack_weight": 1e4, "smoothing": 0.0},
        readings=made("readings"),
    ),
    "control.simulate_network": lambda: _run(
        network=made("network"), cycles=1, readings=made("readings"), **_states()
    ),
    "control.simulate_primal_dual": lambda: _run(
        iterations=5, readings=made("readings"), disturbance=_states()["disturbance"]
    ),
    "control.solve": lambda: {"problem": made("program"), "solver": "active_set"},
    "control.sticking_out": lambda: {
        **{"arm": made("arm"), "q": Q6, "joint": 2, "points": rng().normal(size=(4, 3))}
    },
    "control.with_capsules": lambda: {
        **{"arm": made("arm"), "widened": {made("arm").geometry.geometryObjects[0].name: 0.01}},
        **{"dropped": [made("arm").geometry.geometryObjects[1].name]},
        "added": [("extra", 2, np.zeros(3), np.ones(3), 0.1)],
    },
    "welding.Cell": lambda: {
        name: getattr(made("cell"), name)
        for name in (
            "arms",
            "bases",
            "rotations",
            "flanges",
            "references",
            "torch_axis",
            "seam",
            "pipe_axes",
            "pipe_cores",
            "pipe_radii",
            "floor",
            "threshold",
            "joint_limits",
        )
    },
    "welding.Cell.limits": lambda: {"robot": 1},
    "welding.Cell.seam_in_world": lambda: {"centre": np.ones(3)},
    "welding.Cell.piece_pose": lambda: {"centre": np.ones(3)},
    "welding.GeneticSettings": lambda: {
        **{"population": 8, "generations": 2, "crossover": 0.8, "elite": 0.05},
        **{"mutation": "gaussian", "stall": 1e-6, "stall_generations": 10, "stall_of": "mean"},
        "infeasible": "zero",
    },
    "welding.Jobs.select": lambda: {"mask": np.array([True])},
    "welding.Objective": lambda: {
        **{"weights": "inverse_volume", "space": "translational", "carriers": "mean"},
        **{"pair": "product", "aggregation": "mean", "unit": "m"},
    },
    "welding.Objective.measures": lambda: {"w": np.ones((2, 3, 5)), "inverse": np.ones((2, 2, 5))},
    "welding.Objective.aggregate": lambda: {"values": np.ones((2, 5))},
    "welding.Placement": lambda: {"cell": made("cell"), "objective": welding.Objective()},
    "welding.Placement.jobs": lambda: {"centres": np.array([[0.0, 0.1, 1.1]])},
    "welding.Placement.measures": lambda: {"jobs": made("jobs")},
    "welding.Placement.score": lambda: {"jobs": made("jobs")},
    "welding.Separation": lambda: {"cell": made("cell")},
    **{
        f"welding.Separation.{name}": lambda: {"q": made("jobs").q, "centres": made("jobs").centres}
        for name in ("cores", "smallest", "per_pair")
    },
    "welding.Separation.posed": lambda: {
        **{"q": made("jobs").q[:, :, 0], "rotations": made("cell").rotations[:1]},
        "centres": made("jobs").centres,
    },
    "welding.Separation.distances": lambda: {
        "ends": made("separation").cores(made("jobs").q, made("jobs").centres)
    },
    "welding.Tools": lambda: {
        **{"grasp": "axial", "gripper_length": 0.15, "gripper_radius": 0.06},
        **{"torch": made("torch"), "torch_axis": "along_bisector"},
    },
    "welding.Torch": lambda: {"length": 0.35, "crank": 0.1, "radius": 0.02, "exempt": 0.1},
    "welding.Workpiece": lambda: {
        **{"radius_main": 0.1, "radius_branch": 0.06, "length": 0.6, "branch_length": 0.15},
        "seam_points": 6,
    },
    "welding.assemble": lambda: {
        **{"arms": [made("welder")] * 3, "bases": _bases(), "workpiece": made("workpiece")},
        **{"posture": "bisector", "tools": made("tools"), "floor": 0.0, "threshold": 1e-3},
        "reference": "workpiece_origin",
    },
    "welding.base_poses": lambda: {"matrices": _bases(), "reading": "literal"},
    "welding.closed_form": lambda: {"arm": made("arm"), "q": np.array([Q6, GOAL6])},
    "welding.evolve": lambda: {
        **{"fitness": fitness, "box": BOX, "settings": made("search"), "rng": rng()},
        "must_find": True,
    },
    "welding.extreme_position": lambda: {
        **{"placement": made("placement"), "box": BOX, "rule": "lowest_welder", "spacing": 0.2},
        **{"starts": 1, "tolerance": 0.05, "known": made("survey")},
    },
    "welding.flange_poses": lambda: _jobs(robot=1),
    "welding.held_poses": lambda: _jobs(robot=1),
    "welding.torch_tips": _jobs,
    "welding.joint_margin": _jobs,
    "welding.flat_rotations": lambda: {"seam": made("seam"), "rule": "bisector"},
    "welding.grid_optimum": lambda: {
        **{"fitness": fitness, "box": BOX, "spacing": 0.1, "starts": 2, "tolerance": 0.02}
    },
    "welding.inverse_volumes": lambda: {
        **{"cell": made("cell"), "q": made("jobs").q, "space": "full", "carriers": "mean"}
    },
    "welding.saddle_seam": lambda: {"radius_main": 0.1, "radius_branch": 0.06, "count": 6},
    "welding.survey": lambda: {"placement": made("placement"), "box": BOX, "spacing": 0.2},
    "welding.watch": lambda: {
        **{"placement": made("placement"), "box": BOX, "settings": made("search"), "rng": rng()}
    },
}


def _position_pull():
    return {"placed": made("placed"), "target": np.ones(3), "gain": 1.0}


#: Arguments by the name of the parameter, for every entry that is not listed above.
BY_NAME = {
    "placement": lambda: made("pose"),
    "q": lambda: Q6,
    "time": lambda: np.array([0.2, 0.7]),
    "step": lambda: 0,
    "name": lambda: "a",
    "scene": lambda: made("scene"),
    "arm": lambda: made("arm"),
    "path": lambda: made("path"),
}
#: Clearances of scenes take the joints of both arms.
for _name in ("clearance", "clearance_gradient", "distances"):
    VALID[f"scene.{_name}"] = lambda: {
        "scene": made("moving_scene"),
        "q": np.array([[*Q6, *Q6], [*GOAL6, *GOAL6]]),
        "time": [0.1, 0.2],
    }
VALID["scene.Scene.configurations"] = lambda: {"q": np.array([*Q6, *Q6])}
