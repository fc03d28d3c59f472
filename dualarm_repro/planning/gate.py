"""One gate before any method: limits and contacts of all arms together, at the start and when all
have arrived, parked arms and self-collision included."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping
from dataclasses import replace
from itertools import product
from pathlib import Path
from typing import Annotated

import numpy as np

from ..arguments import LATER, checked
from ..arms.exclusions import shape_of
from ..errors import InputError
from ..scene import JointPath, PlacedArm, Scene, distances
from ..scene.bodies import Body
from ..scene.exact_shapes import exact_minimum
from .faults import TaskFaults

START, GOAL = "start", "goal"
#: A posture may lie this far beyond a limit [rad, m], which is rounding of what a file says.
ROUNDING = 1e-9
#: Configurations in which a mounted capsule has to touch what it stands on.
_SAMPLES = 64
_TOLERANCE = 1e-3  # [m], of no weight at a single posture


@checked
def require_sound(
    source: Path | str,
    scene: Scene,
    starts: Mapping[str, Annotated[np.ndarray, LATER]],
    goals: Mapping[str, Annotated[np.ndarray, LATER]],
    allow_collision: bool = False,
) -> None:
    """Raise if an arm may not start where it is to start, or may not end where it is to end.

    Parameters
    ----------
    source
        File that is named in the lines.
    starts, goals : mapping of arm to (nq,)
        [rad, m], of every arm of the scene; a parked arm has the same in both.
    allow_collision : bool
        Let bodies touch at the start and at the goal.

    Raises
    ------
    TaskFaults
        With a line for each joint beyond its limits and for each two owners that touch, and the
        ``exempt`` line wherever the contact is one of mounting.
    """
    for field, ends in (("starts", starts), ("goals", goals)):
        for placed in scene.arms:
            if placed.name not in ends:
                expected = f"a configuration of {placed.name}"
                raise InputError("require_sound", field, list(ends), expected)
            if placed.arm.configurations(ends[placed.name]).ndim != 1:
                expected = f"({placed.arm.nq},) for {placed.name}"
                raise InputError("require_sound", field, np.shape(ends[placed.name]), expected)
    faults = list(limit_faults(source, scene, starts, goals))
    if not allow_collision:
        faults += contact_faults(source, scene, starts, goals)
    if faults:
        raise TaskFaults(faults)


def limit_faults(
    source: object,
    scene: Scene,
    starts: Mapping[str, np.ndarray],
    goals: Mapping[str, np.ndarray],
) -> Iterator[InputError]:
    """A fault for each joint that starts or ends beyond its limits."""
    for placed in scene.arms:
        for when, q in ((START, starts[placed.name]), (GOAL, goals[placed.name])):
            if when == GOAL and np.array_equal(q, starts[placed.name]):
                continue
            for joint in np.flatnonzero(beyond_limits(placed, q) > ROUNDING).tolist():
                low, high = placed.arm.lower[joint], placed.arm.upper[joint]
                name = placed.arm.model.names[joint + 1]
                field = f"{placed.name}.{when}: {name}"
                unit = "m" if placed.arm.slides[joint] else "rad"
                yield InputError(source, field, float(q[joint]), f"{low:.6g} to {high:.6g} {unit}")


def beyond_limits(placed: PlacedArm, q: np.ndarray) -> np.ndarray:
    """By how much each joint of (..., nq) is beyond its limits [rad, m]; 0 inside, and for a
    continuous joint."""
    return np.maximum(np.maximum(placed.arm.lower - q, q - placed.arm.upper), 0.0)


def contact_faults(
    source: object,
    scene: Scene,
    starts: Mapping[str, np.ndarray],
    goals: Mapping[str, np.ndarray],
) -> list[InputError]:
    """A fault for each two owners that touch at the start or when all arms are at their goals."""
    last = max((float(mover.path.index[-1]) for mover in scene.moving.values()), default=0.0)
    q = np.array([scene.stack(**starts), scene.stack(**goals)])
    found = distances(scene, q, np.array([0.0, last]))
    touching = np.flatnonzero((found <= 0.0).any(axis=0)).tolist()
    mounts = [k for k in touching if _mounted(scene, k)]
    deepest: dict[tuple[str, str], float] = {}
    for k in mounts:
        one, other = map(shape_of, scene.pairs.names[k])
        deepest[one, other] = min(float(found[:, k].min()), deepest.get((one, other), 0.0))
    faults = [_mount_fault(source, pair, distance) for pair, distance in deepest.items()]
    groups: dict[tuple[str, tuple[str, str]], list[int]] = defaultdict(list)
    for k in touching:
        if k not in mounts:
            when = " and ".join(
                w for w, d in zip((START, GOAL), found[:, k], strict=True) if d <= 0
            )
            groups[when, _owners(scene.pairs.bodies[k])].append(k)
    ends = {START: starts, GOAL: goals}
    for (when, owners), pairs in groups.items():
        worst = min(pairs, key=lambda k: found[:, k].min())
        one, other = map(shape_of, scene.pairs.names[worst])
        at = ends[when.split(" and ")[0]]
        value = {name: at[name].tolist() for name in owners if name in at}
        more = f"; {len(pairs) - 1} more pairs of theirs touch" if len(pairs) > 1 else ""
        expected = f"{one} and {other} apart, not at a distance of {found[:, worst].min():.4g} m"
        faults.append(InputError(source, when, value, expected + more))
    told = {(when, owners) for whens, owners in groups for when in whens.split(" and ")}
    for when, placed in product(ends, scene.arms):
        if (when, (placed.name, placed.name)) not in told:
            faults += _exact_faults(source, scene, placed, when, ends[when][placed.name])
    return faults


def _exact_faults(
    source: object, scene: Scene, placed: PlacedArm, when: str, q: np.ndarray
) -> Iterator[InputError]:
    """A fault if exact shapes of one arm touch, of which its capsules do not tell."""
    found = exact_minimum(scene, placed, JointPath([q]), _TOLERANCE, np.inf)
    if found is not None and found[0].upper <= 0.0:
        expected = f"{' and '.join(found[1])} apart; the shapes of the robot file touch"
        yield InputError(source, when, {placed.name: q.tolist()}, expected)


def _owners(pair: tuple[Body, Body]) -> tuple[str, str]:
    first, second = pair
    return first.owner, second.owner


def _mount_fault(source: object, pair: tuple[str, str], distance: float) -> InputError:
    """A contact that no posture avoids: the remedy is an exemption."""
    expected = "bodies apart; they touch in every posture, so if one is mounted on the other add "
    line = f"`exempt: [[{pair[0]}, {pair[1]}]]`"
    return InputError(source, "mounting", f"{' - '.join(pair)} {distance:.4g} m", expected + line)


def _mounted(scene: Scene, k: int) -> bool:
    """Whether the bodies of a pair touch in each of 64 postures spread over all joints."""
    first, second = scene.pairs.bodies[k]
    movable = {placed.name for placed in scene.arms}
    if first.owner == second.owner:
        return False
    moved = [body.joint or 0 for body in (first, second) if body.owner in movable]
    if max(moved) > 1:  # only what the first joint carries can be part of a mounting
        return False
    names = {first.owner, second.owner}
    few = replace(
        scene,
        arms=[placed for placed in scene.arms if placed.name in names],
        obstacles={n: s for n, s in scene.obstacles.items() if n in names},
        moving={},
        floor=scene.floor,
        exempt=(),
    )
    if scene.pairs.names[k] not in few.pairs.names:
        return False
    row = few.pairs.names.index(scene.pairs.names[k])
    rng = np.random.default_rng(0)
    arms = {one.name: one.arm.random_configurations(_SAMPLES, rng) for one in few.arms}
    return bool((distances(few, few.stack(**arms))[:, row] <= 0.0).all())
