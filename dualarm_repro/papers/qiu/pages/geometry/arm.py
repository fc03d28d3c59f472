"""Figures 1 and 2, Table 1 and equations (1) and (2) of `qiu`: the arm."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial

import numpy as np
import pandas as pd
import pinocchio as pin
import sympy as sp

from .....arms import load_arm
from .....arms.dh import joint_symbols
from .....arms.link_chains import coinciding, frames_at_zero, modified_chain, offset_chain
from .....ledger import REGISTRY, Assumed, Is, NoOriginal, Residual, Result
from .....ledger.captions import captions
from .....view.arm_drawings import dimension_drawing, frames_figure
from ...document import PRINTED, ROBOT, SEED, robot

checks = partial(REGISTRY.checks, page="qiu/geometry")
caption = captions(__file__)


@checks(
    "qiu.fig01",
    rules=[
        Residual("flange_error", "end of the drawn outline to the arm's flange [m]", high=1e-12),
        NoOriginal("dimensions", "the dimensions inside the drawing"),
    ],
)
def dimensions(assumed: Assumed) -> Result:
    """Side view of the public arm with its dimensions."""
    size = assumed["link_lengths"]
    names = ("d1", "a2", "a3", "d4", "d6")
    d1, a2, a3, d4, d6 = (size[name] for name in names)
    top = d1 + a2 + a3
    outline = np.array([[0, 0], [0, d1], [0, d1 + a2], [0, top], [d4, top], [d4 + d6, top]])
    beside = [(-0.08, 0.0)] * 3 + [(0.0, 0.08)] * 2
    lines = list(zip(names, outline[:-1], outline[1:], beside, strict=True))
    tip = load_arm(ROBOT).fk(PRINTED.start)[:3, 3]
    return Result(
        obtained={
            "lengths": size,
            "flange_error": float(np.linalg.norm(outline[-1] - tip[[0, 2]])),
        },
        caption=caption("fig01"),
        alt="Side view of the arm at zero joints as a line from base over elbow and wrist to the "
        "flange, with its five lengths in millimetres.",
        figure=lambda: dimension_drawing(outline, lines),
    )


@checks(
    "qiu.fig02",
    samples=32,
    rules=[
        Residual(
            "convention_difference", "both conventions put the flange alike to [m]", high=1e-12
        ),
        NoOriginal("frames", "the link frames of the sketch"),
    ],
)
def link_frames(assumed: Assumed) -> Result:
    """Frames of the standard table at zero joints, and the flange by either convention."""
    frames = frames_at_zero(load_arm(ROBOT))
    tip = load_arm(ROBOT).fk(PRINTED.start)[:3, 3]
    other = _modified_tip(assumed["link_lengths"])
    return Result(
        obtained={
            "flange": tip.tolist(),
            "convention_difference": float(np.linalg.norm(other - tip)),
            "coinciding_origins": coinciding(frames[1:]),
        },
        caption=caption("fig02"),
        alt="Seven coordinate frames on the skeleton of the arm at zero "
        "joints, from base to flange.",
        figure=lambda: frames_figure(frames, 0.09),
    )


@checks(
    "qiu.tab01",
    samples=32,
    rules=[
        Residual("second_model", "largest difference of the two models' flanges [m]", high=1e-12),
        NoOriginal("rows", "the rows of the table"),
    ],
)
def table_1(assumed: Assumed) -> Result:
    """The table of the public arm, checked against a chain of plain offsets along fixed axes."""
    arm, joints = load_arm(ROBOT), robot().joints
    q = arm.random_configurations(500, np.random.default_rng(SEED))
    other = np.array([flange_by_offsets(row, assumed["link_lengths"]).translation for row in q])
    difference = float(np.abs(arm.fk(q)[:, :3, 3] - other).max())
    columns = {
        "d": [j.d for j in joints],
        "a": [j.a for j in joints],
        "alpha": [float(j.alpha) for j in joints],
    }
    angles = [f"q{k} + {float(j.offset):.4f}" for k, j in enumerate(joints, 1)]
    return Result(
        obtained={**columns, "second_model": difference},
        table=pd.DataFrame({"i": range(1, len(joints) + 1), "theta": angles} | columns),
        caption=caption("tab01"),
    )


@checks(
    "qiu.eq01",
    samples=32,
    rules=[
        Is("product_is_arm", "link transforms multiply to the arm's T(q)", value=True),
        Is("rotations_orthonormal", "every link transform is a rigid motion", value=True),
        NoOriginal("formula", "the link transform"),
    ],
)
def link_transform(assumed: Assumed) -> Result:
    """The link transform of the standard convention in symbols."""
    arm = load_arm(ROBOT)
    transforms = arm.link_transforms()
    rigid = all((m[:3, :3].T * m[:3, :3]).applyfunc(sp.simplify) == sp.eye(3) for m in transforms)
    product = sp.eye(4)
    for transform in transforms:
        product = (product * transform).applyfunc(sp.expand)
    return Result(
        obtained={"product_is_arm": product == arm.symbolic_fk(), "rotations_orthonormal": rigid},
        caption=(
            f"Each of the {len(transforms)} link transforms Rz(theta) Tz(d) Tx(a) Rx(alpha) is a "
            "rigid motion in symbols and their product is the arm's. The printed formula is lost."
        ),
    )


@checks(
    "qiu.eq02",
    samples=32,
    rules=[
        Residual("pinocchio", "largest difference of symbols and Pinocchio", high=1e-12),
        Residual("kernel", "largest difference of symbols and batch kernel", high=1e-12),
        NoOriginal("formula", "the product of transforms"),
    ],
)
def end_effector(assumed: Assumed) -> Result:
    """The product of six link transforms in random postures, three ways."""
    arm = load_arm(ROBOT)
    q = arm.random_configurations(300, np.random.default_rng(SEED))
    entries = sp.lambdify(joint_symbols(6), list(arm.symbolic_fk()), "numpy", cse=True)(*q.T)
    symbolic = np.stack([np.broadcast_to(e, len(q)) for e in entries], axis=1).reshape(-1, 4, 4)
    single = np.array([arm.fk(row) for row in q])
    return Result(
        obtained={
            "pinocchio": float(np.abs(symbolic - single).max()),
            "kernel": float(np.abs(symbolic - arm.fk(q)).max()),
        },
        caption=(
            "The product of six link transforms in symbols agrees with Pinocchio on 300 random "
            f"postures to {np.abs(symbolic - single).max():.1e}. The printed formula is lost."
        ),
    )


def flange_by_offsets(q: np.ndarray, size: Mapping[str, float]) -> pin.SE3:
    """Flange from offsets and the axes z, y, y, x, y, x, as a robot description gives them."""
    steps = (
        ((0.0, 0.0, 0.0), "z"),
        ((0.0, 0.0, size["d1"]), "y"),
        ((0.0, 0.0, size["a2"]), "y"),
        ((0.0, 0.0, size["a3"]), "x"),
        ((size["d4"], 0.0, 0.0), "y"),
        ((size["d6"], 0.0, 0.0), "x"),
    )
    return offset_chain(steps, q)


def _modified_tip(size: dict[str, float]) -> np.ndarray:
    """Flange at zero joints by a modified table of the same arm (3,) [m]."""
    half = np.pi / 2
    rows = (
        (0.0, 0.0, size["d1"], 0.0),
        (-half, 0.0, 0.0, -half),
        (0.0, size["a2"], 0.0, 0.0),
        (-half, size["a3"], size["d4"], 0.0),
        (half, 0.0, 0.0, 0.0),
        (-half, 0.0, size["d6"], np.pi),
    )
    return modified_chain(rows).translation
