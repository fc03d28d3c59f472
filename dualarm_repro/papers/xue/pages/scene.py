"""Figure 4 and the inputs of section 3.3: gains, Start and End, equal speed."""

from __future__ import annotations

from functools import partial

import numpy as np

from ....ledger import REGISTRY, Adopts, Assumed, Bounded, Is, NoOriginal, Residual, Result, Role
from ....ledger.captions import captions
from ....ledger.rules import Rounds
from ....planning.field.control_points import end_effector
from ....planning.trials.speeds import mean_advance
from ....scene import facing
from ....view.replays import add_stage
from ....view.scene3d import Scene3D
from ....view.style import BLACK, GREEN, ORANGE
from ....view.tracks import tracks_figure
from ..document import Layout, master_goal, placed_master, placed_slave
from ..motions import master_track, present, slave_undisturbed
from ..reading import improved, nominal, traditional

checks = partial(REGISTRY.checks, page="xue/scene")
caption = captions(__file__)


@checks(
    "xue.fig04",
    rules=[
        Rounds("start", "Start in the figure, in the frame of the document", to="start"),
        Rounds("end", "End in the figure, in the frame of the document", to="end"),
        Residual("off_centre", "virtual point to the middle of the bars [m]", high=1e-12),
        NoOriginal("window", "size, place and direction of the window"),
    ],
)
def window(assumed: Assumed) -> Result:
    """The window with Start, End and the virtual point in its middle."""
    layout = Layout.of(assumed)
    (start, end), origin = layout.slave_points(), layout.frame_origin
    centre, bars = layout.window_centre, layout.window()
    middle = np.mean([bar.center for bar in bars], axis=0)
    sides = (np.array([start, end]) - centre) @ facing(layout.normal)[:, 2]
    return Result(
        obtained={
            "start": (start - origin).tolist(),
            "end": (end - origin).tolist(),
            "off_centre": float(abs(middle - centre).max()),
            "between": bool(sides[0] * sides[1] < 0.0),
            "centre": centre.tolist(),
            "opening": list(layout.opening),
        },
        caption=caption("fig04", ends=(start, end), bar=layout.window_bar),
        alt="A rectangular frame of four bars in space, a point on either side and one in its "
        "middle.",
        figure=lambda: tracks_figure(
            bars, [], {"Start": start, "End": end, "virtual point": centre}, elev=18, azim=-60
        ),
        scene=lambda: stage(
            "The window with Start (green), End (black) and the virtual point.", layout
        ),
    )


@checks(
    "xue.claim_gains",
    rules=[Adopts(name, f"{name} of the planner", to=name) for name in ("k_a", "k_w", "k_r")]
    + [
        Adopts("d_0", "d_0 of the planner", to="d_0"),
        Is("both", "the traditional method has the same", value=True, role=Role.ADOPTS),
    ],
)
def gains(assumed: Assumed) -> Result:
    """The gains of the planners that are run."""
    case = nominal(virtual_gain=assumed["virtual_gain"])
    new = improved(case.planner, case.layout.window_centre, master_goal())
    old = traditional(case.planner, "end_effector")
    repels, repelled = (present(made.repulsion, "repulsion") for made in (new, old))
    used = {
        "k_a": new.attraction.gain,
        "k_w": float(present(new.virtual_point, "virtual point").gain),
        "k_r": repels.gain,
        "d_0": repels.influence,
    }
    both = new.attraction.gain == old.attraction.gain and repels == repelled
    return Result(
        obtained={**used, "both": both}, caption=caption("claim_gains", unit=assumed["length_unit"])
    )


def _register_slave_point(item: str, field: str, name: str) -> None:
    @checks(item, samples=32, rules=[Adopts("position", f"{name} used [m]", to="position")])
    def slave_point(assumed: Assumed) -> Result:
        unit, layout = assumed["length_unit"], Layout.of(assumed)
        slave = placed_slave(layout)
        if slave is None:
            text = f"From this base {name} or its fellow is out of reach."
            return Result({"position": None}, text)
        q = getattr(slave, field)
        reached = end_effector(slave, q) - layout.frame_origin
        inside = bool(slave.arm.within_limits(q))
        return Result(
            obtained={"position": reached.tolist(), "q": q.tolist(), "within_limits": inside},
            caption=caption("slave_point", name=name, unit=unit),
        )


_register_slave_point("xue.claim_slave_start", "start", "Start")
_register_slave_point("xue.claim_slave_end", "goal", "End")


@checks(
    "xue.claim_equal_speed",
    rules=[
        Bounded(
            "beyond_shortened",
            "relative difference of mean speeds, in the sense assumed, that short steps leave",
            high=1e-9,
            role=Role.ADOPTS,
        )
    ],
    samples=8,
)
def equal_speed(assumed: Assumed) -> Result:
    """Speeds of the two motions that are run, in the joints and at the tools.

    Joint steps have one bound v and are shorter before a goal. With a share s of shorter steps the
    mean lies in [(1 - s) v, v], so that two means may differ by the larger s of themselves; an
    advance of the end effector that is set has no such steps.
    """
    sense = assumed["equal_speed_meaning"]
    case = nominal(equal_speed_meaning=sense)
    track = present(master_track(case), "motion of the master")
    slave = present(slave_undisturbed(case.layout, case.planner), "motion of the slave")
    flange = end_effector(placed_master(case.layout), track.configurations)
    tools = (mean_advance(flange, track.index), slave.tcp_length / slave.steps)
    joints = (mean_advance(track.configurations, track.index), slave.length / slave.steps)
    pairs = {"same_step": joints, "same_tool_speed": tools}
    differences = {name: abs(a - b) / max(a, b) for name, (a, b) in pairs.items()}
    (other,) = differences.keys() - {sense}
    paths, bound = {"master": track.configurations, "slave": slave.path}, case.planner.max_step
    shortened = {name: _shortened(path, bound) for name, path in paths.items()}
    allowed = max(shortened.values()) if sense == "same_step" else 0.0
    return Result(
        obtained={
            "difference": differences[sense],
            "shortened": shortened,
            "beyond_shortened": max(differences[sense] - allowed, 0.0),
            "other_difference": differences[other],
            "joints_rad_per_instant": {"master": joints[0], "slave": joints[1]},
            "tool_m_per_instant": {"master": tools[0], "slave": tools[1]},
        },
        caption=caption("claim_equal_speed", sense=sense, other=other),
    )


def _shortened(path: np.ndarray, bound: float) -> float:
    """Share of the steps of a path (N, nq) that are shorter than their bound [rad]."""
    steps = np.linalg.norm(np.diff(path, axis=0), axis=1)
    return float(np.mean(steps < (1.0 - 1e-9) * bound))


def stage(title: str, layout: Layout) -> Scene3D:
    """The window, Start and End of the slave, and the virtual point."""
    made, (start, end) = Scene3D(title, (3.4, -1.6, 2.6), 480), layout.slave_points()
    marks = {"Start": (start, 0.04, GREEN), "End": (end, 0.04, BLACK)}
    marks["virtual point"] = (layout.window_centre, 0.03, ORANGE)
    return add_stage(made, layout.window(), marks)
