"""Figures 1-3 of `xue` and statements on the arms: wrist, mirror image, start and goal."""

from __future__ import annotations

from functools import partial

import numpy as np
import pandas as pd
import pinocchio as pin
import sympy as sp

from .....arms import load_arm
from .....arms.exact_chain import chain_product, same_function
from .....arms.joint_axes import axis_spread, common_origins, joint_frames
from .....arms.reach import symmetric_bases
from .....ledger import REGISTRY, Adopts, Assumed, Is, NoOriginal, Residual, Result
from .....ledger.captions import captions
from .....view.arm_drawings import frames_figure, stick_figure
from .....view.scene3d import Scene3D
from .....view.style import MASTER, SLAVE
from .....view.upright_arm import upright_drawing
from ...document import SEED, lengths, master_goal, master_start, placed_master
from ...reading import nominal
from . import printed_chain as chain

checks = partial(REGISTRY.checks, page="xue/kinematics")
caption = captions(__file__)


@checks(
    "xue.fig01",
    rules=[
        Residual(
            "shared_difference",
            "a1, a3, d4 and d6 of the matrices are those of the published robot, to [m]",
            high=1e-12,
        ),
        NoOriginal("dimensions", "the dimensions inside the drawing"),
    ],
)
def dimensions(assumed: Assumed) -> Result:
    """Side view of the published robot, with the lengths the matrices share with it."""
    printed, published = chain.printed_lengths(), lengths("published")
    differences = {name: published[name] - printed[name] for name in printed}
    table = pd.DataFrame({"matrices_m": printed, "published_m": published})
    return Result(
        obtained={
            "published": published,
            "matrices": printed,
            "shared_difference": max(abs(differences[name]) for name in chain.SHARED),
        },
        table=table.reset_index(names="length"),
        caption=caption("fig01", shared=chain.SHARED, less=differences),
        alt="Side view of a six-joint arm as a line from the floor over shoulder, elbow and wrist "
        "to the flange, with six dimension lines in millimetres.",
        figure=lambda: upright_drawing(published),
    )


@checks(
    "xue.fig02",
    rules=[
        Residual("axis_error", "each z axis is the axis its joint turns about, to", high=1e-12),
        Residual("frame_error", "each frame is the product of printed matrices, to", high=1e-12),
        NoOriginal("drawing", "the drawing of the frames"),
    ],
)
def link_frames(assumed: Assumed) -> Result:
    """Frames 0 to 6 of the matrices at q = 0."""
    arm = load_arm("es165d")
    frames = np.array([np.eye(4), *joint_frames(arm, master_start())])
    turned = [joint_frames(arm, 0.7 * unit)[k] for k, unit in enumerate(np.eye(arm.nq))]
    error = max(
        float(abs(pin.log3(frames[k + 1, :3, :3].T @ turned[k][:3, :3]) - [0, 0, 0.7]).max())
        for k in range(arm.nq)
    )
    columns = [f"{axis}{row}" for row in "xyz" for axis in ("n", "o", "a", "p")]
    table = pd.DataFrame(frames[:, :3].reshape(7, 12), columns=columns)
    table.insert(0, "frame", range(7))
    return Result(
        obtained={
            "origins": frames[:, :3, 3].tolist(),
            "axis_error": error,
            "frame_error": float(abs(frames - _printed_frames(master_start())).max()),
        },
        table=table,
        caption=caption("fig02", shared=common_origins(frames)),
        alt="Seven coordinate frames along an arm with a level upper arm and a hanging forearm.",
        figure=lambda: frames_figure(frames, 0.25, _spans(frames)),
    )


def _spans(frames: np.ndarray) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """The lengths of the chain from point to point; the elbow offset a3 ends above frame 4."""
    origins, size = frames[:, :3, 3], lengths("matrices")
    elbow = origins[3] + size["a3"] * frames[3, :3, 0]
    ends = {"a1": (origins[1], origins[2]), "a2": (origins[2], origins[3]),
            "a3": (origins[3], elbow), "d4": (elbow, origins[4]),
            "d6": (origins[5], origins[6])}  # fmt: skip
    return {f"{name} = {size[name]:g} m": span for name, span in ends.items()}


@checks(
    "xue.fig03",
    samples=32,
    rules=[
        Residual("mirror_error", "the slave is the reflection of the master, to [m]", high=1e-12),
        NoOriginal("bases", "the base poses"),
    ],
)
def both_arms(assumed: Assumed) -> Result:
    """Master and mirrored slave in one posture, their bases apart along y."""
    distance, posture = assumed["base_distance"], assumed["display_posture"]
    q = {"start": master_start(), "goal": master_goal()}[posture]
    master, slave = load_arm("es165d"), load_arm("es165d-slave")
    left, right = symmetric_bases(distance)
    arms = {"master": (master, q, left), "slave": (slave, -q, right)}
    flip = np.array([1.0, -1.0, 1.0])
    tips = {name: place.act(arm.fk(pose)[:3, 3]) for name, (arm, pose, place) in arms.items()}
    error = float(abs(tips["master"] * flip - tips["slave"]).max())

    def scene() -> Scene3D:
        made = Scene3D(f"Both arms of the document at the printed {posture}.", (6.0, -3.0, 2.5))
        made.add_arm("master", master, q, left, MASTER)
        made.add_arm("slave", slave, -q, right, SLAVE)
        return made

    return Result(
        obtained={"flanges": {k: v.tolist() for k, v in tips.items()}, "mirror_error": error},
        caption=caption("fig03", posture=posture, distance=distance),
        alt="Stick figures of two six-joint arms, mirror images of each other, side by side.",
        figure=lambda: stick_figure(arms, elev=18, azim=-35),
        scene=scene,
    )


@checks(
    "xue.claim_spherical_wrist",
    rules=[
        Is("origins_coincide", "frames 4, 5 and 6 less d_6 share their origin", value=True),
        Residual("spread", "largest distance of the three axes' common point [m]", high=1e-12),
    ],
)
def spherical_wrist(assumed: Assumed) -> Result:
    """Axes 4, 5 and 6 pass through one point: in symbols, and in Pinocchio at random poses."""
    frames = [
        chain_product([chain.link_matrix(k) for k in range(1, last + 1)]) for last in (4, 5, 6)
    ]
    wrist, same, sixth = (frame[:3, 3] for frame in frames)
    # Axis 6 is the z axis of frame 6, whose origin lies d_6 further out along it.
    back = sixth - chain.link_matrix(6)[1, 3] * frames[2][:3, 2]
    meets = all(same_function(sp.Matrix(wrist), sp.Matrix(other)) for other in (same, back))
    arm = load_arm("es165d")
    poses = arm.random_configurations(1000, np.random.default_rng(SEED))
    return Result(
        obtained={"origins_coincide": meets, "spread": axis_spread(arm, (4, 5, 6), 5, poses)},
        caption=caption("claim_spherical_wrist"),
    )


@checks(
    "xue.claim_mirror",
    rules=[
        Is("symbolic", "negated alpha and theta give M T(q) M in symbols", value=True),
        Residual("pinocchio", "largest difference of the two models", high=1e-12),
    ],
)
def mirror(assumed: Assumed) -> Result:
    """With M = diag(1, -1, 1, 1): negating alpha and theta turns every T_i into M T_i M."""
    M = sp.diag(1, -1, 1, 1)
    symbolic = all(
        chain.substituted(k, corrected=True, mirrored=True).equals(M * chain.link_matrix(k) * M)
        for k in chain.LINKS
    )
    master, slave = load_arm("es165d"), load_arm("es165d-slave")
    q = master.random_configurations(1000, np.random.default_rng(SEED))
    flip = np.diag([1.0, -1.0, 1.0, 1.0])
    difference = float(abs(slave.fk(-q) - flip @ master.fk(q) @ flip).max())
    goal = slave.fk(-master_goal())[:3, 3]
    return Result(
        obtained={"symbolic": symbolic, "pinocchio": difference, "slave_goal": goal.tolist()},
        caption=caption("claim_mirror"),
    )


@checks("xue.claim_master_start", rules=[Adopts("q", "start angles used [rad]", to="q")])
def start_of_master(assumed: Assumed) -> Result:
    """Start of the master, and how far it is outside the range of the real axis L."""
    arm = load_arm("es165d")
    start = placed_master(nominal().layout).start
    tcp, excess = arm.fk(start)[:3, 3], float(np.rad2deg(start[1] - arm.upper[1]))
    return Result(
        obtained={"q": start.tolist(), "tcp": tcp.tolist(), "excess_deg": excess},
        caption=caption("claim_master_start"),
    )


@checks("xue.claim_master_goal", rules=[Adopts("q", "goal angles used [rad]", to="q")])
def goal_of_master(assumed: Assumed) -> Result:
    """Goal of the master; unlike the start it tells Table 1 from the matrices."""
    arm, goal = load_arm("es165d"), placed_master(nominal().layout).goal
    tcp, inside = arm.fk(goal)[:3, 3], arm.within_limits(goal)
    return Result(
        obtained={"q": goal.tolist(), "tcp": tcp.tolist(), "within_limits": inside},
        caption=caption("claim_master_goal"),
    )


def _printed_frames(q: np.ndarray) -> np.ndarray:
    """Frames 0 to 6 as products of matrices (2)-(7)."""
    frames = [np.eye(4)]
    for k in chain.LINKS:
        link = chain.link_matrix(k).subs(chain.joint_variable(k), q[k - 1])
        frames.append(frames[-1] @ np.array(link, dtype=float))
    return np.array(frames)
