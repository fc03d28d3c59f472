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
from .....ledger.captions import point
from .....view.arm_drawings import dimension_drawing, frames_figure
from ...document import PRINTED, ROBOT, SEED, robot

checks = partial(REGISTRY.checks, page="qiu/geometry")


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
    d1, a2, a3, d4, d6 = (size[name] for name in ("d1", "a2", "a3", "d4", "d6"))
    top = d1 + a2 + a3
    outline = np.array([[0, 0], [0, d1], [0, d1 + a2], [0, top], [d4, top], [d4 + d6, top]])
    beside = {
        "d1": (-0.08, 0),
        "a2": (-0.08, 0),
        "a3": (-0.08, 0),
        "d4": (0, 0.08),
        "d6": (0, 0.08),
    }
    lines = [
        (name, outline[k], outline[k + 1], offset)
        for k, (name, offset) in enumerate(beside.items())
    ]
    tip = load_arm(ROBOT).fk(PRINTED.start)[:3, 3]
    return Result(
        obtained={
            "lengths": size,
            "flange_error": float(np.linalg.norm(outline[-1] - tip[[0, 2]])),
        },
        caption=(
            "Dimensions of the public IRB 120 in millimetres: "
            + ", ".join(f"{name} = {1000 * value:.0f}" for name, value in size.items())
            + ". The drawing itself is lost, so nothing printed stands against them."
        ),
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
    difference = float(np.linalg.norm(_modified_tip(assumed["link_lengths"]) - tip))
    return Result(
        obtained={
            "flange": tip.tolist(),
            "convention_difference": difference,
            "coinciding_origins": coinciding(frames[1:]),
        },
        caption=(
            f"Link frames of the standard table at zero joints; the flange is at ({point(tip, 3)}) "
            "m. A modified table of the same lengths puts the flange at the same "
            "place. The sketch is lost."
        ),
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
    arm, made = load_arm(ROBOT), robot()
    q = arm.random_configurations(500, np.random.default_rng(SEED))
    other = np.array([flange_by_offsets(row, assumed["link_lengths"]).translation for row in q])
    difference = float(np.abs(arm.fk(q)[:, :3, 3] - other).max())
    rows = [
        {
            "i": k,
            "theta": f"q{k} + {float(j.offset):.4f}",
            "d": j.d,
            "a": j.a,
            "alpha": float(j.alpha),
        }
        for k, j in enumerate(made.joints, 1)
    ]
    return Result(
        obtained={
            "d": [j.d for j in made.joints],
            "a": [j.a for j in made.joints],
            "alpha": [float(j.alpha) for j in made.joints],
            "second_model": difference,
        },
        table=pd.DataFrame(rows),
        caption=(
            "The standard table of the public arm agrees on 500 random configurations with a "
            f"second model that knows only offsets and axes, to {difference:.1e} m. "
            "The printed rows are lost."
        ),
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
