"""Figures 1-4, 9, 10 and 12 of `pan` and the robot data: the cell and its arms."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
import pandas as pd
import pinocchio as pin

from ...arms.robot_file import load_robot_file
from ...arms.wrist_geometry import wrist_geometry
from ...datafiles import data_path
from ...errors import UnsupportedArmError
from ...ledger import REGISTRY, Assumed, Bounded, Is, NoOriginal, Residual, Result
from ...scene import posing
from ...view.arm_drawings import frames_figure
from ...view.welding_cell import capsule_figure, cell_figure, vectors_figure
from ...welding import ROBOTS, WELDER, closed_form
from ...welding.ellipsoid import gram_matrices
from .coordination import at_display, flange_poses, torch_tips
from .nominal import nominal_values
from .positions import at_optimum, job_scene_at
from .scenario import SEED, Job, stand_in

checks = partial(REGISTRY.checks, page="pan/cell")
_SHOWN = {"first_seam_point": 0}
_ROWS = {"translational": 3, "full": 6}


@checks(
    "pan.fig01",
    rules=[
        Residual("closure", "both carriers hold the workpiece, to [m]", high=1e-9),
        NoOriginal("drawing", "the drawing"),
    ],
)
def welding_cell(assumed: Assumed) -> Result:
    """Both carriers, the welder and the workpiece."""
    cell, jobs, centre = at_display(assumed)
    index = _SHOWN[assumed["display_configuration"]]
    return Result(
        obtained={"closure": _closure(cell, jobs, centre)},
        caption=(
            "Two carriers hold the main pipe by its ends, the welder follows the seam from the "
            f"other side. Drawn at ({', '.join(f'{v:g}' for v in centre)}) m with the stand-in "
            "arm; the drawing of the document is not in the text edition."
        ),
        alt="Three stick-figure robots around a pipe with a branch, seen from the front and above.",
        figure=lambda: cell_figure(cell, jobs.q[0], centre, index=index),
    )


@checks(
    "pan.fig02",
    rules=[
        Residual("closure", "p2 + R r - p closes for both carriers, to [m]", high=1e-9),
        NoOriginal("drawing", "the drawing"),
    ],
)
def position_vectors(assumed: Assumed) -> Result:
    """Frames and the vectors of (4) and (5)."""
    cell, jobs, centre = at_display(assumed)
    index = _SHOWN[assumed["display_configuration"]]
    grips = np.einsum("ji,kj->ki", cell.rotations[index], cell.flanges[:WELDER, index, :3, 3])
    return Result(
        obtained={"closure": _closure(cell, jobs, centre), "r": grips.tolist()},
        caption=(
            "World, base and workpiece frames with the vectors of (4) and (5). By these "
            "equations p2 leads to the workpiece and p1, p3 to the flanges of the two carriers, "
            f"so the indices do not count robots. The grips are {np.linalg.norm(grips[0]):.3f} "
            f"and {np.linalg.norm(grips[1]):.3f} m from the origin of the workpiece."
        ),
        alt="Coordinate frames joined by arrows from the world to workpiece and flanges.",
        figure=lambda: vectors_figure(cell, jobs.q[0], centre),
    )


@REGISTRY.checks(
    "pan.fig03",
    page="pan/measure",
    rules=[
        Residual("fits", "extreme velocities lie on the drawn ellipsoids, to", high=1e-8),
        NoOriginal("drawing", "configuration and scale of the drawing"),
    ],
)
def three_ellipsoids(assumed: Assumed) -> Result:
    """Velocity ellipsoid of each robot at its reference point."""
    cell, jobs, centre = at_display(assumed)
    index, rows = _SHOWN[assumed["display_configuration"]], _ROWS[assumed["ellipsoid_space"]]
    grams, fits = [], 0.0
    for k, arm in enumerate(cell.arms):
        q, lever = jobs.q[0, k, index : index + 1], cell.lever_arms[k, index : index + 1]
        gram = gram_matrices(arm.chain, cell.bases[k][:3, :3].copy(), q, lever, rows)[0]
        values, vectors = np.linalg.eigh(gram)
        extreme = vectors * np.sqrt(values)
        fits = max(
            fits, float(abs(np.sum(extreme * np.linalg.solve(gram, extreme), axis=0) - 1).max())
        )
        grams.append(gram[:3, :3])
    axes = np.sqrt(np.linalg.eigvalsh(np.array(grams)))[:, ::-1]
    return Result(
        obtained={"fits": fits, "semi_axes": axes.tolist()},
        caption=(
            "Translational velocity ellipsoids for unit joint velocities, the carriers' at the "
            "origin of the workpiece and the welder's at the tip of its torch. Longest and "
            "shortest semi-axes in m/s: "
            + "; ".join(
                f"{name} {a[0]:.2f} and {a[2]:.2f}" for name, a in zip(ROBOTS, axes, strict=True)
            )
            + ". Neither configuration nor scale of the printed drawing is known."
        ),
        alt="Three robots, each with a translucent ellipsoid at the point where it acts.",
        figure=lambda: cell_figure(cell, jobs.q[0], centre, index=index, grams=np.array(grams)),
    )


@checks(
    "pan.fig04",
    rules=[
        Residual("closure", "both carriers hold the workpiece, to [m]", high=1e-9),
        Residual("tip", "the torch stays on the seam, to [m]", high=1e-9),
        NoOriginal("picture", "the picture"),
    ],
)
def real_system(assumed: Assumed) -> Result:
    """The stand-in cell with the thickness of its capsules."""
    cell, jobs, centre = at_display(assumed)
    index = _SHOWN[assumed["display_configuration"]]
    return Result(
        obtained={
            "closure": _closure(cell, jobs, centre),
            "tip": _tip_error(cell, jobs, centre),
            "feasible": bool(jobs.feasible[0]),
            "separation": float(jobs.separation[0]),
        },
        caption=(
            "The document shows a photograph or picture of its hardware, which no computation can "
            "regenerate; here is the stand-in cell, whose smallest separation on the whole seam is "
            f"{jobs.separation[0]:.3f} m."
        ),
        alt="Three thick-limbed robots around a pipe with a branch.",
        figure=lambda: cell_figure(cell, jobs.q[0], centre, index=index, capsules=True),
    )


@checks(
    "pan.fig09",
    rules=[
        Residual("axis_error", "each z axis is the one its joint turns about, to", high=1e-12),
        NoOriginal("parameters", "the Denavit-Hartenberg parameters"),
    ],
)
def link_frames(assumed: Assumed) -> Result:
    """Link frames of the stand-in arm at q = 0."""
    arm = stand_in(assumed["arm"])
    frames = _joint_frames(arm, np.zeros(arm.nq))
    error = 0.0
    for k in range(arm.nq):
        turned = _joint_frames(arm, 0.7 * np.eye(arm.nq)[k])[k]
        turn = pin.log3(frames[k][:3, :3].T @ turned[:3, :3])
        error = max(error, float(abs(turn - [0, 0, 0.7]).max()))
    drawn = np.array([np.eye(4), *frames])
    return Result(
        obtained={"axis_error": error, "origins": drawn[:, :3, 3].tolist()},
        caption=(
            f"Frames 0 to 6 of the stand-in arm ({arm.name}) at q = 0 in the modified convention. "
            "The parameters of the ER16 are called known in the document but are not given, so "
            "the figure cannot be compared."
        ),
        alt="Seven coordinate frames along an arm with an upright upper arm and a level forearm.",
        figure=lambda: frames_figure(drawn, 0.22),
    )


@checks(
    "pan.fig10",
    rules=[
        Bounded("bare", "how far a joint of the arm lies outside its capsules [m]", high=0.0),
        NoOriginal("geometry", "the geometry of the links"),
    ],
)
def spatial_model(assumed: Assumed) -> Result:
    """The stand-in arm with its capsules."""
    arm = stand_in(assumed["arm"], None, assumed["link_radius_scale"])
    geometry = wrist_geometry(arm.name, arm.chain)
    reach = float(geometry.shoulder[0] + geometry.upper_arm[0] + geometry.forearm[0])
    nominal = Job.of(nominal_values())
    job = replace(nominal, arm=arm.name, link_radius_scale=assumed["link_radius_scale"])
    return Result(
        obtained={"bare": _bare(arm), "reach": reach},
        caption=(
            "The stand-in arm with the capsules that stand for its links; its wrist reaches "
            f"{reach:.2f} m from axis 1. No drawing of the ER16 was available, so the radii are "
            "assumed."
        ),
        alt="A six-joint arm drawn as translucent capsules with its skeleton inside.",
        figure=lambda: capsule_figure(job.cell(), np.radians([0, 20, 10, 0, 60, 0]), WELDER),
    )


@checks(
    "pan.tab_none",
    rules=[
        Is("spherical_wrist", "axes 4, 5 and 6 meet in one point", value=True),
        NoOriginal("parameters", "parameters and joint limits of the ER16"),
    ],
)
def robot_data(assumed: Assumed) -> Result:
    """DH parameters and limits of the stand-in arm, with their evidence."""
    name, height = assumed["arm"], assumed["shoulder_height"]
    robot, arm = load_robot_file(data_path("robots", f"{name}.yaml")), stand_in(name, height)
    table = pd.DataFrame(
        {
            "joint": [joint.name for joint in robot.joints],
            "alpha_deg": [np.degrees(float(joint.alpha)) for joint in robot.joints],
            "a_m": [joint.a for joint in robot.joints],
            "d_m": [height, *(joint.d for joint in robot.joints[1:])],
            "offset_deg": [np.degrees(float(joint.offset)) for joint in robot.joints],
            "lower_deg": np.degrees(arm.lower),
            "upper_deg": np.degrees(arm.upper),
        }
    )
    q = arm.random_configurations(20_000, np.random.default_rng(SEED))
    return Result(
        obtained={
            "spherical_wrist": _has_spherical_wrist(arm),
            "largest_measure": float(closed_form(arm, q).max()),
            "evidence": robot.evidence,
        },
        table=table,
        caption=(
            "The document has no table and prints neither parameters nor limits of its robot. "
            f"Used instead: {robot.title}. Its evidence: {robot.evidence}"
        ),
    )


@checks(
    "pan.fig12",
    rules=[
        Residual("tip_error", "the torch stays on the seam through the job, to [m]", high=1e-9),
        NoOriginal("picture", "the picture"),
    ],
)
def simulation(assumed: Assumed) -> Result:
    """The whole job at the optimum obtained."""
    cell, jobs, centre, measures = at_optimum(assumed)
    error = _tip_error(cell, jobs, centre)
    return Result(
        obtained={"tip_error": error, "frames": cell.count},
        caption=(
            f"The cell carries out the whole job of {cell.count} seam points at the optimum "
            f"obtained, with the torch on the seam to {error:.1e} m; the bars beside the bases "
            "rise with the manipulability of each robot. The mean of the system measure is "
            f"{measures.system.mean():.3f}. The program of the document is not available."
        ),
        alt="Three thick-limbed robots at work on the seam of a pipe with a branch.",
        figure=lambda: cell_figure(cell, jobs.q[0], centre, capsules=True),
        scene=lambda: job_scene_at("The whole job at the optimum obtained.", cell, jobs, centre),
    )


def _closure(cell: Any, jobs: Any, centre: np.ndarray) -> float:
    worst = 0.0
    for robot in range(WELDER):
        flange = flange_poses(cell, jobs, robot)[:, :3, 3]
        r = np.einsum("nji,nj->ni", cell.rotations, flange - centre)
        worst = max(worst, float(abs(r - r[0]).max()))
    return worst


def _tip_error(cell: Any, jobs: Any, centre: np.ndarray) -> float:
    return float(abs(torch_tips(cell, jobs) - cell.seam_in_world(centre)).max())


def _bare(arm: Any) -> float:
    """Largest distance of a joint from the capsules at q = 0, negative where all lie inside."""
    links = posing.links_of(arm)
    frames = posing.link_frames(arm.chain, np.eye(4)[:3], np.zeros((1, arm.nq)))
    ends = np.empty((1, len(links.radius), 2, 3))
    posing.place_cores(frames, links.joint, links.local, ends)
    start, along = ends[0, :, 0], ends[0, :, 1] - ends[0, :, 0]
    square = np.maximum(np.sum(along**2, axis=1), 1e-300)
    depths = []
    for frame in _joint_frames(arm, np.zeros(arm.nq)):
        share = np.clip(np.sum((frame[:3, 3] - start) * along, axis=1) / square, 0.0, 1.0)
        nearest = start + share[:, np.newaxis] * along
        depths.append((np.linalg.norm(frame[:3, 3] - nearest, axis=1) - links.radius).min())
    return float(max(depths))


def _joint_frames(arm: Any, q: np.ndarray) -> list[np.ndarray]:
    data = arm.model.createData()
    pin.forwardKinematics(arm.model, data, q)
    return [data.oMi[k].homogeneous for k in range(1, arm.nq + 1)]


def _has_spherical_wrist(arm: Any) -> bool:
    try:
        wrist_geometry(arm.name, arm.chain)
    except UnsupportedArmError:
        return False
    return True
