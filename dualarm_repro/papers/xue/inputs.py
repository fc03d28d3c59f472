"""Figure 4 and the inputs of section 3.3: gains, Start and End, equal speed."""

from __future__ import annotations

from functools import partial

import numpy as np

from ...ledger import REGISTRY, Adopts, Assumed, Is, NoOriginal, Result, Role, Rounds
from ...planning.control_points import end_effector
from ...view.scene3d import Scene3D
from ...view.tracks import tracks_figure
from ..wording import point
from .layout import Layout, placed_master, placed_slave
from .motion_scenes import stage
from .motions import Case, master_track, slave_undisturbed
from .scenario import GAINS

checks = partial(REGISTRY.checks, page="xue/scene")


@checks(
    "xue.fig04",
    samples=32,
    rules=[
        Rounds(key="start", to="start", label="Start in the figure"),
        Rounds(key="end", to="end", label="End in the figure"),
        NoOriginal(key="window", label="size, place and direction of the window"),
    ],
)
def window(assumed: Assumed) -> Result:
    """The window with Start, End and the virtual point in its middle."""
    layout = Layout.of(assumed)
    start, end = layout.slave_points()
    centre, bars = layout.window_centre, layout.window()

    def scene() -> Scene3D:
        return stage("The window with Start (green), End (black) and the virtual point.", layout)

    return Result(
        obtained={
            "start": start.tolist(),
            "end": end.tolist(),
            "centre": centre.tolist(),
            "opening": [layout.window_opening_width, layout.window_opening_height],
        },
        caption=(
            f"Start ({point(start, 2)}) and End ({point(end, 2)}) m as printed, on either side of "
            f"a window found by search: opening {layout.window_opening_width:g} by "
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
        scene=scene,
    )


@checks(
    "xue.claim_gains",
    rules=[Adopts(key=name, to=name, label=f"{name} used") for name in GAINS],
)
def gains(assumed: Assumed) -> Result:
    """The gains the planners are built with."""
    unit, virtual = assumed["length_unit"], assumed["virtual_gain"]
    used = {**GAINS, "k_w": float(virtual)}
    values = ", ".join(f"{name} = {value:g}" for name, value in used.items())
    return Result(
        obtained=used,
        caption=(
            f"Used as printed: {values}, with d_0 in {unit}; k_w is the gain named k_av elsewhere."
        ),
    )


def _register_slave_point(item: str, field: str, name: str) -> None:
    @checks(
        item, samples=32, rules=[Adopts(key="position", to="position", label=f"{name} used [m]")]
    )
    def slave_point(assumed: Assumed) -> Result:
        unit, layout = assumed["length_unit"], Layout.of(assumed)
        slave = placed_slave(layout)
        if slave is None:
            return Result(
                {"position": None}, f"From this base {name} or its fellow is out of reach."
            )
        q = getattr(slave, field)
        origin = layout.slave_base if layout.slave_frame == "slave_base" else np.zeros(3)
        reached = end_effector(slave, q) - origin
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
    samples=32,
    rules=[
        Is(key="equal", value=True, role=Role.ADOPTS, label="equal speed, in the sense assumed")
    ],
)
def equal_speed(assumed: Assumed) -> Result:
    """The index that both motions share."""
    case = Case.of(assumed)
    track, slave = master_track(case), slave_undisturbed(case.layout, case.method)
    if track is None or slave is None:
        return Result({"equal": False}, "In this arrangement there are not two motions to compare.")
    steps = np.diff(track.index)
    speed = slave.tcp_length / slave.steps
    flange = end_effector(placed_master(case.layout), track.configurations)
    moved = np.linalg.norm(np.diff(flange, axis=0), axis=1)
    per_instant = float(moved.sum() / track.index[-1])
    same_step = case.encounter.equal_speed_meaning == "same_step"
    equal = np.allclose(steps, 1.0) if same_step else np.isclose(per_instant, speed)
    return Result(
        obtained={
            "equal": bool(equal),
            "master_m_per_step": per_instant,
            "slave_m_per_step": speed,
        },
        caption=(
            "Each arm makes one bounded joint step per instant. Its end effector then covers "
            f"{100 * per_instant:.2f} cm per step on average for the master and {100 * speed:.2f} "
            "cm for the slave: equal speed of the joints is not equal speed of the tools, and "
            "which of them is meant is not printed."
        ),
    )
