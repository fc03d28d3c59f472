"""Problems of MotionBenchMaker for one Panda.

C. Chamzas et al., MotionBenchMaker: a tool to generate and benchmark motion planning datasets, IEEE
RA-L 7(2), 2022. The obstacles and joint vectors are kept. The goals are grasps by open fingers; the
hand of the catalogue has them closed, so that here fingers may touch what they touch at the goal.
Nothing else may, and since capsules enclose the links, some ends are in contact.
"""

from __future__ import annotations

import json
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from ..datafiles import data_path, opened
from ..scene import Scene, distances
from ..scene.scene_file import scene_of
from .case import Case

_FILE = ("benchmarks", "motion_bench_maker_panda.json")


def benchmark_case(set_name: str, number: int) -> Case:
    """Problem ``number`` of a set, as it stands in the file."""
    found = next(one for one in problems() if (one["set"], one["number"]) == (set_name, number))
    opened(data_path(*_FILE))
    content = {"arms": {"panda": {"robot": "panda"}}, "obstacles": found["obstacles"]}
    scene = scene_of(Path(f"{set_name} {number}"), content).scene
    start, goal = (np.array(found[end]) for end in ("start", "goal"))
    grasped = replace(scene, exempt=_grasped(scene, goal))
    return Case(f"{set_name} {number}", grasped, {"panda": start}, {"panda": goal})


@cache
def problems() -> tuple[dict[str, Any], ...]:
    """Every problem of the file: ``set``, ``number``, ``obstacles``, ``start``, ``goal``."""
    return tuple(json.loads(data_path(*_FILE).read_text(encoding="utf-8"))["problems"])


def _grasped(scene: Scene, goal: np.ndarray) -> list[tuple[str, str]]:
    """Fingers and the obstacles that any of them touches at the goal (nq,) [rad]."""
    near = distances(scene, goal) <= 0.0
    pairs = [
        (*sorted(pair, key=_is_finger, reverse=True), touching)
        for pair, touching in zip(scene.pairs.names, near.tolist(), strict=True)
        if _is_finger(pair[0]) != _is_finger(pair[1])
    ]
    objects = {other for _, other, touching in pairs if touching and other in scene.obstacles}
    return [(finger, other) for finger, other, _ in pairs if other in objects]


def _is_finger(body: str) -> bool:
    return "finger" in body
