"""Problems of MotionBenchMaker for one Panda.

C. Chamzas et al., MotionBenchMaker: a tool to generate and benchmark motion planning datasets, IEEE
RA-L 7(2), 2022. The obstacles and joint vectors are kept; the hand has its fingers closed, and
cylinders are prisms around them, so that an end of a problem may be in contact here.
"""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from ..datafiles import data_path, opened
from ..scene.scene_file import scene_of
from .case import Case

_FILE = ("benchmarks", "motion_bench_maker_panda.json")


def benchmark_case(set_name: str, number: int) -> Case:
    """Problem ``number`` of a set, as it stands in the file."""
    found = next(one for one in problems() if (one["set"], one["number"]) == (set_name, number))
    opened(data_path(*_FILE))
    content = {"arms": {"panda": {"robot": "panda"}}, "obstacles": found["obstacles"]}
    scene = scene_of(Path(f"{set_name} {number}"), content).scene
    ends = ({"panda": np.array(found[end])} for end in ("start", "goal"))
    return Case(f"{set_name} {number}", scene, *ends)


@cache
def problems() -> tuple[dict[str, Any], ...]:
    """Every problem of the file: ``set``, ``number``, ``obstacles``, ``start``, ``goal``."""
    return tuple(json.loads(data_path(*_FILE).read_text(encoding="utf-8"))["problems"])
