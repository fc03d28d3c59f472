"""The arms of `pan`, where their bases stand, and the cell at work."""

from __future__ import annotations

import re
from dataclasses import replace
from functools import partial

import numpy as np
import pandas as pd
import pinocchio as pin

from .....arms import Arm
from .....arms.wrist_geometry import wrist_geometry
from .....errors import DataFileError, UnsupportedArmError
from .....ledger import REGISTRY, Adopts, Assumed, Bounded, Is, NoOriginal, Residual, Result, Role
from .....ledger.assumptions import alternatives
from .....ledger.captions import captions
from .....ledger.printed import rounds_to
from .....scene import posing
from .....view.arm_drawings import frames_figure
from .....view.welding_cell import capsule_figure, cell_figure
from .....welding import WELDER, Cell, Jobs, base_poses, closed_form, torch_tips
from ...document import (
    BASES,
    SEED,
    placed_bases,
    printed_base_matrix,
    printed_bases,
    robot_table,
    stand_in,
)
from ...print_forms import printed_text
from ...reading import SHOWN, Job, at_display, at_optimum, job_scene_at
from .coordination import grip_change

checks = partial(REGISTRY.checks, page="pan/cell")
caption = captions(__file__)


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
    robot, arm = robot_table(name), stand_in(name, height)
    q = arm.random_configurations(20_000, np.random.default_rng(SEED))
    return Result(
        obtained={
            "spherical_wrist": _has_spherical_wrist(arm),
            "largest_measure": float(closed_form(arm, q).max()),
            "evidence": robot.evidence,
        },
        table=_parameters(name, height),
        caption=caption("tab_none", title=robot.title),
    )


def _parameters(first: str, height: float) -> pd.DataFrame:
    """Tables of all arms among the choices, that of one first, the interpolated one as raised."""
    names = dict.fromkeys((first, *alternatives("pan.arm", 0)))
    rows = []
    for name in names:
        arm = stand_in(name, height)
        raised = float(arm.chain.translation[0][2])
        rows += [
            {
                "arm": name,
                "joint": joint.name,
                "alpha_deg": np.degrees(float(joint.alpha)),
                "a_m": joint.a,
                "d_m": joint.d if k else raised,
                "offset_deg": np.degrees(float(joint.offset)),
                "lower_deg": np.degrees(arm.lower[k]),
                "upper_deg": np.degrees(arm.upper[k]),
                "speed_deg_s": np.degrees(arm.model.upperVelocityLimit[k]),
            }
            for k, joint in enumerate(robot_table(name).joints)
        ]
    return pd.DataFrame(rows)


def _capsules(first: str) -> pd.DataFrame:
    """Capsules of all arms among the choices as their files have them, that of one first."""
    columns = [f"{end}_{axis}_m" for end in ("start", "end") for axis in "xyz"]
    return pd.DataFrame(
        [
            {
                "arm": name,
                "joint": capsule.joint,
                **dict(zip(columns, (*capsule.start, *capsule.end), strict=True)),
                "radius_m": capsule.radius,
            }
            for name in dict.fromkeys((first, *alternatives("pan.arm", 0)))
            for capsule in robot_table(name).capsules
        ]
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
        caption=caption("fig09", arm=arm.name),
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
    nominal = Job.of(REGISTRY.nominal("pan"))
    job = replace(nominal, arm=arm.name, link_radius_scale=assumed["link_radius_scale"])
    return Result(
        obtained={"bare": _bare(arm), "reach": reach},
        table=_capsules(arm.name),
        caption=caption("fig10"),
        alt="A six-joint arm drawn as translucent capsules with its skeleton inside.",
        figure=lambda: capsule_figure(job.cell(), np.radians([0, 20, 10, 0, 60, 0]), WELDER),
    )


@checks("pan.claim_bases", rules=[Adopts(name, f"{name} [m]", to=name) for name in BASES])
def positions(assumed: Assumed) -> Result:
    """Origins of the base frames that the cell uses."""
    poses = placed_bases(assumed["base_transform"], assumed["base_orientation"])
    listed, used = printed_bases(), poses[:, :3, 3]
    return Result(
        obtained=dict(zip(BASES, used.tolist(), strict=True)),
        caption=caption(
            "claim_bases",
            gap=np.linalg.norm(used - listed, axis=1).max(),
            spread=np.linalg.norm(listed[:, :2], axis=1),
        ),
    )


@checks(
    "pan.eq_base",
    rules=[
        Adopts("matrix", "pose of base 1 in the world, as used", to="matrix"),
        Is(
            "labelled_is_listed",
            "read as its label says, the matrix puts base 1 where the list has it",
            value=False,
            role=Role.CONTRADICTS,
        ),
    ],
)
def matrix(assumed: Assumed) -> Result:
    """The printed matrix as pose of base 1, and what follows from its label."""
    printed, listed = printed_base_matrix(), REGISTRY.printed("pan.claim_bases")["base1"]
    used = placed_bases(assumed["base_transform"], assumed["base_orientation"])[0]
    reading = label_reading(printed_text("pan.eq_base", "label"))
    labelled = base_poses(printed[np.newaxis], reading)[0, :3, 3] + 0.0
    as_pose = _listed(base_poses(printed[np.newaxis], "inverted")[0, :3, 3], listed)
    return Result(
        obtained={
            "matrix": used.tolist(),
            "labelled_is_listed": _listed(labelled, listed) if as_pose else None,
            "as_labelled": float(np.linalg.norm(labelled - printed_bases()[0])),
        },
        caption=caption("eq_base", listed=as_pose, reading=reading, labelled=labelled),
    )


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
    index = SHOWN[assumed["display_configuration"]]
    return Result(
        obtained={"closure": grip_change(cell, jobs, centre)},
        caption=caption("fig01", centre=centre),
        alt="Three stick-figure robots around a pipe with a branch, seen from the front and above.",
        figure=lambda: cell_figure(cell, jobs.q[0], centre, index=index),
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
    index = SHOWN[assumed["display_configuration"]]
    return Result(
        obtained={
            "closure": grip_change(cell, jobs, centre),
            "tip": _tip_error(cell, jobs, centre),
            "feasible": bool(jobs.feasible[0]),
            "separation": float(jobs.separation[0]),
        },
        caption=caption("fig04"),
        alt="Three thick-limbed robots around a pipe with a branch.",
        figure=lambda: cell_figure(cell, jobs.q[0], centre, index=index, capsules=True),
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
    return Result(
        obtained={"tip_error": _tip_error(cell, jobs, centre), "frames": cell.count},
        caption=caption("fig12", measure=measures.system.mean()),
        alt="Three thick-limbed robots at work on the seam of a pipe with a branch.",
        figure=lambda: cell_figure(cell, jobs.q[0], centre, capsules=True),
        scene=lambda: job_scene_at("The whole job at the optimum obtained.", cell, jobs, centre),
    )


@checks("pan.claim_teaching", rules=[NoOriginal("experiment", "an experiment with taught robots")])
def teaching(assumed: Assumed) -> Result:
    """A statement about practice."""
    return Result(
        obtained={},
        caption=(
            "That coordinated robots cannot be taught by hand is a statement about practice; the "
            "document reports no experiment, and no computation can decide it."
        ),
    )


def _tip_error(cell: Cell, jobs: Jobs, centre: np.ndarray) -> float:
    return float(abs(torch_tips(cell, jobs) - cell.seam_in_world(centre)).max())


def _bare(arm: Arm) -> float:
    """Largest distance of a joint from the capsules at q = 0, negative where all lie inside."""
    links = posing.links_of(arm)
    frames = posing.link_frames(arm.chain, np.eye(4)[:3], np.zeros((1, arm.nq)))
    ends = np.empty((1, len(links.radius), 2, 3))
    posing.place_cores(frames, links.joint, links.local, ends, 0)
    start, along = ends[0, :, 0], ends[0, :, 1] - ends[0, :, 0]
    square = np.maximum(np.sum(along**2, axis=1), 1e-300)
    joints = np.array(_joint_frames(arm, np.zeros(arm.nq)))[:, np.newaxis, :3, 3]
    share = np.clip(np.sum((joints - start) * along, axis=-1) / square, 0.0, 1.0)
    apart = np.linalg.norm(joints - (start + share[..., np.newaxis] * along), axis=-1)
    return float((apart - links.radius).min(axis=1).max())


def _joint_frames(arm: Arm, q: np.ndarray) -> list[np.ndarray]:
    data = arm.model.createData()
    pin.forwardKinematics(arm.model, data, q)
    return [data.oMi[k].homogeneous for k in range(1, arm.nq + 1)]


def _has_spherical_wrist(arm: Arm) -> bool:
    try:
        wrist_geometry(arm.name, arm.chain)
    except UnsupportedArmError:
        return False
    return True


def label_reading(label: str) -> str:
    """How ``base_poses`` has to read a matrix of that label.

    By (6) and (8) T_ab carries coordinates from b to a: T_B1w from the world to base 1.

    Raises
    ------
    DataFileError
        The label names no base and the world.
    """
    found = re.fullmatch(r"T_(B\d|w)(B\d|w)", label)
    if not found or "w" not in found.groups() or found[1] == found[2]:
        raise DataFileError("printed matrix", "label", label, "T_B1w or T_wB1")
    return "literal" if found[2] == "w" else "inverted"


def _listed(position: np.ndarray, listed: list[str]) -> bool:
    """Whether a position rounds to the listed one."""
    return all(rounds_to(float(v), text) for v, text in zip(position, listed, strict=True))
