"""Figure 4 and the inputs of section 3.3: gains, Start and End, equal speed."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np

from ....ledger import (
    REGISTRY,
    Adopts,
    Assumed,
    Bounded,
    Is,
    NoOriginal,
    Residual,
    Result,
    Role,
    Rounds,
)
from ....ledger.captions import point
from ....planning.field.control_points import end_effector
from ....planning.trials.speeds import largest_joint_step, mean_advance
from ....scene import facing
from ....view.replays import add_stage
from ....view.scene3d import Scene3D
from ....view.style import BLACK, GREEN, ORANGE
from ....view.tracks import tracks_figure
from ..document import Layout, master_goal, placed_master, placed_slave
from ..motions import master_track, slave_undisturbed
from ..reading import improved, nominal, traditional

checks = partial(REGISTRY.checks, page="xue/scene")


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
    start, end = layout.slave_points()
    origin, centre, bars = layout.frame_origin, layout.window_centre, layout.window()
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
        caption=(
            f"Start ({point(start, 2)}) and End ({point(end, 2)}) m as printed, "
            + ("on either side" if sides[0] * sides[1] < 0.0 else "both on one side")
            + f" of a window found by search: opening {layout.window_opening_width:g} by "
            f"{layout.window_opening_height:g} m about ({point(centre, 2)}) m, bars of "
            f"{layout.window_bar:g} m. Nothing of the window is printed, so there is nothing to "
            "compare it with."
        ),
        alt=(
            "A rectangular frame of four bars in space, a point on either side and one in its "
            "middle."
        ),
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
    case = nominal()
    planner = replace(case.planner, virtual_gain=assumed["virtual_gain"])
    new = improved(planner, case.layout.window_centre, master_goal())
    old = traditional(planner, "end_effector")
    used = {
        "k_a": new.attraction.gain,
        "k_w": float(new.virtual_point.gain),
        "k_r": new.repulsion.gain,
        "d_0": new.repulsion.influence,
    }
    same = (old.attraction.gain, old.repulsion.gain, old.repulsion.influence)
    both = same == (used["k_a"], used["k_r"], used["d_0"])
    values = ", ".join(f"{name} = {value:g}" for name, value in used.items())
    unit = assumed["length_unit"]
    return Result(
        obtained={**used, "both": both},
        caption=(
            f"The planners run with {values}, with d_0 in {unit}; k_w is the gain named k_av "
            "elsewhere."
        ),
    )


def _register_slave_point(item: str, field: str, name: str) -> None:
    @checks(item, samples=32, rules=[Adopts("position", f"{name} used [m]", to="position")])
    def slave_point(assumed: Assumed) -> Result:
        unit, layout = assumed["length_unit"], Layout.of(assumed)
        slave = placed_slave(layout)
        if slave is None:
            return Result(
                {"position": None}, f"From this base {name} or its fellow is out of reach."
            )
        q = getattr(slave, field)
        reached = end_effector(slave, q) - layout.frame_origin
        inside = slave.arm.within_limits(q)
        return Result(
            obtained={"position": reached.tolist(), "q": q.tolist(), "within_limits": bool(inside)},
            caption=(
                f"{name} = ({point(reached, 2)}) {unit} is used as printed. Inverse kinematics "
                f"gives the angles ({point(q, 3)}) rad, which (13) needs and print does not give; "
                f"they are {'inside' if inside else 'outside'} the joint ranges of the real robot."
            ),
        )


_register_slave_point("xue.claim_slave_start", "start", "Start")
_register_slave_point("xue.claim_slave_end", "goal", "End")


@checks(
    "xue.claim_equal_speed",
    rules=[
        Bounded(
            "difference",
            "speeds of master and slave in the sense assumed, relative difference",
            high=1e-4,
            role=Role.ADOPTS,
        )
    ],
)
def equal_speed(assumed: Assumed) -> Result:
    """Speeds of the two motions that are run, in the joints and at the tools."""
    case = nominal()
    case = case._replace(
        encounter=replace(case.encounter, equal_speed_meaning=assumed["equal_speed_meaning"])
    )
    track, slave = master_track(case), slave_undisturbed(case.layout, case.planner)
    flange = end_effector(placed_master(case.layout), track.configurations)
    tools = (mean_advance(flange, track.index), slave.tcp_length / slave.steps)
    joints = (largest_joint_step(track), largest_joint_step(slave.joint_path()))
    pairs = {"same_step": joints, "same_tool_speed": tools}
    differences = {sense: abs(a - b) / max(a, b) for sense, (a, b) in pairs.items()}
    senses = {
        "same_step": "the largest joint step per instant",
        "same_tool_speed": "the mean advance of the end effector per instant",
    }
    sense = case.encounter.equal_speed_meaning
    other = next(name for name in senses if name != sense)
    return Result(
        obtained={
            "difference": differences[sense],
            "other_difference": differences[other],
            "joint_step_rad": {"master": joints[0], "slave": joints[1]},
            "tool_m_per_instant": {"master": tools[0], "slave": tools[1]},
        },
        caption=(
            f"Equal speed is read as {senses[sense]}, in which the two motions run differ by "
            f"{differences[sense]:.1%}. In the other reading, {senses[other]}, they differ by "
            f"{differences[other]:.0%} ({100 * tools[0]:.2f} and {100 * tools[1]:.2f} cm at the "
            "tools); which of them is meant is not printed."
        ),
    )


def stage(title: str, layout: Layout) -> Scene3D:
    """The window, Start and End of the slave, and the virtual point."""
    made, (start, end) = Scene3D(title, (3.4, -1.6, 2.6), 480), layout.slave_points()
    marks = {"Start": (start, 0.04, GREEN), "End": (end, 0.04, BLACK)}
    marks["virtual point"] = (layout.window_centre, 0.03, ORANGE)
    return add_stage(made, layout.window(), marks)
