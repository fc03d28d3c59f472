"""The scenes of the four documents as tasks in joint space, by their declared readings."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pinocchio as pin

from ..control import ControllerSettings
from ..errors import InputError
from ..ledger import REGISTRY
from ..papers import load
from ..papers.pan import reading as pan
from ..papers.patent import document as patent
from ..papers.qiu import document as qiu
from ..papers.qiu import reading as qiu_reading
from ..papers.xue import document as xue
from ..papers.xue import reading as xue_reading
from ..scene import PlacedArm, Scene
from ..welding.cell import ROBOTS
from .case import Case


def document_case(name: str) -> Case:
    """The task of a document."""
    load()
    return _TASKS[name]()


def _xue() -> Case:
    """Master past, slave through the window; joints turn fully, as the printed start needs."""
    layout = xue_reading.nominal().layout
    slave = xue.placed_slave(layout)
    if slave is None:
        raise InputError("xue", "slave", layout, "points within reach")
    posed = {"master": xue.placed_master(layout), "slave": slave}
    free = xue.arm_in_use("full_turns", xue.lengths("matrices")["a2"])
    turning = {"master": free, "slave": free.mirrored()}
    arms = [PlacedArm(name, arm, posed[name].placement) for name, arm in turning.items()]
    scene = Scene(arms, {"window": layout.window()}, self_collision=False)
    starts = {name: one.start for name, one in posed.items()}
    return Case("xue", scene, starts, {name: one.goal for name, one in posed.items()})


def _qiu() -> Case:
    """Both arms among the two spheres."""
    slave = qiu_reading.Slave.nominal()
    goals = {"master": slave.posture(), "slave": slave.slave_posture()}
    starts = {name: np.asarray(qiu.PRINTED.start, dtype=float) for name in qiu.ARMS}
    return Case("qiu", slave.scene(), starts, goals)


def _patent() -> Case:
    """Two redundant arms whose circles cross, to where avoidance has them half way."""
    scenario = patent.frozen("crossing")
    motion = patent.run(scenario, ControllerSettings())
    scene, half = scenario.system.scene, motion.q[len(motion.q) // 2]
    ends = (scenario.q0, half)
    starts, goals = ({n: q[part] for n, part in scene.columns.items()} for q in ends)
    return Case("patent", scene, starts, goals)


def _pan() -> Case:
    """Three arms of the welding cell without workpiece, half way round the seam."""
    names = (*pan.Job.names(), "display_position")
    assumed = {name: REGISTRY.assumption(f"pan.{name}") for name in names}
    cell, jobs, _ = pan.at_display(assumed)
    arms = [
        PlacedArm(robot.replace(" ", "_"), arm, pin.SE3(base))
        for robot, arm, base in zip(ROBOTS, cell.arms, cell.bases, strict=True)
    ]
    scene = Scene(arms, floor=cell.floor, self_collision=False, exempt=_standing(arms, cell.floor))
    ends = (0, cell.count // 2)
    starts, goals = ({one.name: jobs.q[0, k, at] for k, one in enumerate(arms)} for at in ends)
    return Case("pan", scene, starts, goals)


def _standing(arms: list[PlacedArm], floor: float | None) -> list[tuple[str, str]]:
    """The first capsule of an arm stands on the floor."""
    if floor is None:
        return []
    from ..scene import links_of

    return [
        (f"{one.name}/{name}", "floor")
        for one in arms
        for name, joint in zip(links_of(one.arm).names, links_of(one.arm).joint, strict=True)
        if joint == 1
    ]


_TASKS: dict[str, Callable[[], Case]] = {
    "xue": _xue, "qiu": _qiu, "patent": _patent, "pan": _pan,
}  # fmt: skip
DOCUMENTS = tuple(_TASKS)
