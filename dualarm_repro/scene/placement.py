"""Poses of all bodies of a scene for many configurations and times."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import pinocchio as pin

from ..arms.arm import Arm
from .moving import MovingArm
from .posing import frames_of, links_of, place_cores
from .scene import Scene


class Placed(NamedTuple):
    """World coordinates: ``cores`` (N, C, 2, 3), ``boxes`` (N, B, 3, 4), ``hulls`` (N, H, 3, 4)."""

    cores: np.ndarray
    boxes: np.ndarray
    hulls: np.ndarray


def place(scene: Scene, q: np.ndarray, time: np.ndarray) -> Placed:
    """Poses for configurations ``q`` (N, nq) and times (N,)."""
    bodies, count = scene.bodies, len(q)
    cores = np.repeat(bodies.cores[np.newaxis], count, axis=0)
    boxes = np.repeat(bodies.boxes[np.newaxis], count, axis=0)
    hulls = np.tile(np.eye(3, 4), (count, len(bodies.hulls), 1, 1))
    for placed, frames in zip(scene.arms, arm_frames(scene, q), strict=True):
        _place_links(placed.arm, frames, cores, bodies.rows(placed.name, "capsule"))
    for name, mover in scene.moving.items():
        rows = bodies.rows(name, "capsule")
        if isinstance(mover, MovingArm):
            frames = _frames(mover.arm, mover.placement, mover.path.at(time))
            _place_links(mover.arm, frames, cores, rows)
            continue
        pose = mover.path.at(time)
        rotation, origin = pose[:, :, :3], pose[:, :, 3]
        for row in rows:
            cores[:, row] = bodies.cores[row] @ rotation.transpose(0, 2, 1) + origin[:, None]
        for row in bodies.rows(name, "box"):
            local = bodies.boxes[row]
            boxes[:, row] = rotation @ local
            boxes[:, row, :, 3] += origin
        for row in bodies.rows(name, "hull"):
            hulls[:, row] = pose
    return Placed(cores, boxes, hulls)


def arm_frames(scene: Scene, q: np.ndarray) -> list[np.ndarray]:
    """Link frames (N, nq_arm + 1, 3, 4) of every controlled arm for q (N, nq)."""
    return [
        _frames(placed.arm, placed.placement, q[:, scene.columns[placed.name]].copy())
        for placed in scene.arms
    ]


def _frames(arm: Arm, base: pin.SE3, q: np.ndarray) -> np.ndarray:
    return frames_of(arm, base.homogeneous[:3], q)


def _place_links(arm: Arm, frames: np.ndarray, cores: np.ndarray, rows: list[int]) -> None:
    if rows:
        links = links_of(arm)
        place_cores(frames, links.joint, links.local, cores, rows[0])
