"""How the URDF files of example-robot-data load, and what a plan for two of one is worth."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any
from unittest.mock import patch

import numpy as np
import pandas as pd
from example_robot_data import getModelPath

from ..arms import load_arm
from ..cache_folder import CACHE_VARIABLE
from ..ledger.study import Study
from ..scene.audit import audit
from .public_pair import OF_PAIR, planned_pair

POSTURES = 300
EXACT, ROUNDING = 1e-12, 1e-9  # of forward kinematics [m, 1], and of capsules around meshes [m]
_ANY = "ur_description/urdf/ur5_robot.urdf"
_REMEDIES = ("flange=", "lock=", "shapes=", "packages=")
_OF_LOADED = (
    "joints", "flange", "prismatic", "continuous", "shapes", "capsules", "excluded", "excess",
    "exact", "contained", "home_clear", "home_flagged", "clear", "false_alarms", "missed",
)  # fmt: skip


def public_files() -> list[str]:
    """The URDF files of the package, below its folder of robots."""
    root = Path(getModelPath(_ANY))
    return sorted(path.relative_to(root).as_posix() for path in root.glob("*/**/*.urdf"))


def _cells() -> list[dict[str, Any]]:
    return [{"file": file} for file in public_files()]


def _cell(cell: Mapping[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    """What :func:`..scene.audit.audit` finds, without paths of the machine, and what a plan for two
    of the arm is worth (:func:`.public_pair.planned_pair`)."""
    root = Path(getModelPath(_ANY))
    with TemporaryDirectory() as fresh, patch.dict(os.environ, {CACHE_VARIABLE: fresh}):
        found = audit(root / cell["file"], rng, POSTURES)
        said = found["said"].replace(f"{root}/", "")
        row = {"loads": found["loads"], "said": said, "seconds": found["seconds"]}
        row |= dict.fromkeys((*_OF_LOADED, *OF_PAIR))
        row["remedy"] = any(word in said for word in _REMEDIES)
        if found["loads"]:
            found["exact"] = bool(found["fk"] <= EXACT)
            found["contained"] = bool(found["outside"] <= ROUNDING)
            row |= {key: found[key] for key in _OF_LOADED}
            row |= planned_pair(load_arm(root / cell["file"]), rng)
    return row


PUBLIC_ARMS = Study(
    name="public_arms",
    title="How the URDF files of example-robot-data load",
    cells=_cells,
    compute=_cell,
    seed=20_150,
    settings={"postures": POSTURES},
    measured=("seconds",),
    peers={"ompl": "pair_"},
)


def summary(rows: pd.DataFrame) -> dict[str, Any]:
    """Counts over the rows of the stored table."""
    loaded = rows[rows["loads"].astype(bool)]
    refused = rows[~rows["loads"].astype(bool)]
    clear = loaded[loaded["home_clear"].astype(bool)]
    alarms = 100.0 * loaded["false_alarms"] / loaded["clear"].clip(lower=1)
    pairs = loaded[loaded["pair_reached"].notna()]
    return {
        "files": len(rows),
        "load": len(loaded),
        "refused with the remedy": int(refused["remedy"].sum()),
        "forward kinematics as Pinocchio's to 1e-12": int(loaded["exact"].sum()),
        "shapes within their capsules": int(loaded["contained"].sum()),
        "home pose clear by meshes": len(clear),
        "of these accepted": int((~clear["home_flagged"].astype(bool)).sum()),
        "false alarms in at most 10 % of clear postures": int((alarms <= 10.0).sum()),
        "postures that touch and were missed": int(loaded["missed"].sum()),
        "of": int((POSTURES - loaded["clear"]).sum()),
        "pairs with a task": len(pairs),
        "of these planned and certified free": int((pairs["pair_lower"] > 0.0).sum()),
        "reports that promise more than the meshes keep": int(
            (pairs["pair_lower"] > pairs["pair_meshes"] + ROUNDING).sum()
        ),
    }
