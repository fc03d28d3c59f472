"""What an arrangement has to show for the printed facts to hold in it, and by how much it does.

Print says: undisturbed, the slave touches the window and meets the master on its way (Fig. 9); the
master passes the window (Fig. 8), and the slave passes through it and by the master (Figs 10, 11);
ten traditional runs end in eight traps, ten improved ones in none (Table 2). Demanded beside that
is what keeps the facts from being empty or a coincidence: repulsion and master are needed, a good
part of both paths is left where the arms meet, whole links are clear, no end lies in line with the
edge of a bar, the traps are true minima, and the facts survive small shifts of window and bases.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from ...planning.field.control_points import end_effector
from ...planning.trials.encounter import inside_opening
from ...planning.trials.held import held
from ...planning.trials.replay import Replay
from ...planning.trials.stuck import stationary
from ...scene import facing
from . import motions
from .document import Layout, gains
from .outcomes import TRIALS, VARIANTS, run_variants, starts
from .reading import Case

#: Demands, metres: depth at which the undisturbed slave enters a bar, distance at which the tips
#: meet, and distance of Start and End from the planes of the edges of the bars.
DEPTH, MEETING, EDGE = 0.01, 0.12, 0.02
#: Share of either path that is left where the arms meet.
LEFT = 0.15
#: Shifts that the facts have to survive, metres: of the window and its opening, and of the bases.
SHIFTS = {
    **dict.fromkeys(("window_centre_x", "window_centre_y", "window_centre_z",
                     "window_opening_width", "window_opening_height"), 0.01),
    **dict.fromkeys(("master_base_x", "master_base_y", "master_base_z", "base_distance"), 0.02),
}  # fmt: skip
NO_MEETING, NO_MASTER, NO_SLAVE = {"fig_9": -10.0}, {"fig_8": -5.0}, {"fig_11": -3.0}


def margins(
    case: Case,
    radius: float,
    meeting: float,
    *,
    strict: bool = True,
    at_least: float = -np.inf,
) -> dict[str, float]:
    """By how much every fact of the figures is met [m]; negative where it is not.

    Cut off at the first motion that is missing.

    Parameters
    ----------
    radius
        Of all links [m].
    meeting
        Distance of the tips that means contact [m].
    strict
        Demand DEPTH, MEETING and EDGE as well; otherwise the facts alone, as they are judged.
    at_least
        Cut off too where the failures add up to less than this [m].
    """
    found: dict[str, float] = {}
    for part in _margins(case, radius, meeting, strict):
        found |= part
        if failures(found) < at_least:
            break
    return found


def failures(found: Mapping[str, float]) -> float:
    """Sum of the margins that are negative [m]."""
    return float(sum(min(value, 0.0) for value in found.values()))


def _margins(case: Case, radius: float, meeting: float, strict: bool) -> Iterator[dict[str, float]]:
    """The margins, what is cheap to compute first."""
    layout, planner, points = case.layout, case.planner, case.planner.control_points
    slave = motions.slave_undisturbed(layout, planner)
    if slave is None or not slave.reached:
        yield NO_MEETING
        return
    depth, near, edge = (DEPTH, MEETING, EDGE) if strict else (0.0, meeting, 0.0)
    ends = motions.points_to_window(slave, layout, points)[[0, -1]]
    yield {
        "off_edges": from_edges(layout) - edge,
        "enters_bar": -motions.points_to_window(slave, layout).min() - depth,
        "ends_out_of_range": ends.min() - gains()["d_0"],
    }
    undisturbed = motions.master_undisturbed(layout, planner)
    nearest = motions.points_to_window(undisturbed, layout, points).min()
    yield {"avoidance_needed": radius - nearest}
    replay = motions.replay_of(case, slave)
    if replay is None:
        yield NO_MASTER
        return
    yield {"meets": near - apart_on_the_way(replay)}
    plan = motions.slave_plan(case)
    avoiding = motions.replay_of(case, plan)
    alone = motions.replay_of(case, motions.slave_without_master(case))
    if plan is None or avoiding is None or alone is None or not plan.reached:
        yield NO_SLAVE
        return
    way = facing(layout.normal)
    opening = inside_opening(plan.tcp, layout.window_centre, way, layout.opening)
    yield {
        "master_needed": meeting - alone.apart().min(),
        "tips_apart": avoiding.apart().min() - meeting,
        "through": max(opening, -1.0),
    }
    cores = motions.smallest_cores(motions.cores_of(avoiding, layout))
    yield {
        "slave_clear": cores["slave_window"] - radius,
        "master_clear": cores["master_window"] - radius,
        "arms_clear": 0.5 * cores["arms"] - radius,
    }


def apart_on_the_way(replay: Replay) -> float:
    """Smallest distance of the tips while a share LEFT of the path of either lies ahead [m]."""
    times = np.arange(replay.plan.steps + 1)
    other = end_effector(replay.other, replay.track.at(replay.times))
    ahead = np.minimum(_ahead(replay.plan.tcp)[times], _ahead(other)[times])
    return float(replay.apart(moving=True)[ahead >= LEFT].min(initial=np.inf))


def _ahead(track: np.ndarray) -> np.ndarray:
    """Share of the length of a track (N, 3) that lies ahead at each of its points (N,)."""
    advance = np.linalg.norm(np.diff(track, axis=0), axis=1)
    return 1.0 - np.concatenate([[0.0], np.cumsum(advance)]) / advance.sum()


def from_edges(layout: Layout) -> float:
    """Smallest distance of Start and End to a plane in which the side of a bar lies [m]."""
    across = facing(layout.normal)[:, :2]
    ends = np.abs((np.array(layout.slave_points()) - layout.window_centre) @ across)
    inner = 0.5 * np.array(layout.opening)
    edges = np.stack([inner, inner + layout.window_bar])
    return float(np.abs(ends[:, np.newaxis] - edges).min())


def counts(case: Case, half_width: float, seed: int, *, certified: bool = True) -> dict[str, int]:
    """Ten runs of both methods: how many miss, and how many traditional ones end in a minimum.

    Parameters
    ----------
    certified
        Look where the runs end; otherwise a run that stands still counts as one in a minimum.
    """
    begin = starts(case, half_width, TRIALS, np.random.default_rng(seed))
    runs = run_variants(case, ("traditional", "without_virtual", "improved"), begin)
    old = runs["traditional"]
    resting = int(old.stuck.sum())
    if certified and resting:
        made, last = VARIANTS["traditional"].problem(case), old.last[old.stuck]
        flat = stationary(made, last, old.gradient[old.stuck])
        resting = int(held(made, last, flat).sum())
    missed = {name: int((~runs[name].reached).sum()) for name in ("traditional", "improved")}
    return {**missed, "minima": resting}


def neighbours(layout: Layout) -> Iterator[tuple[str, Layout]]:
    """The arrangement with each number of SHIFTS made larger and smaller."""
    for name, shift in SHIFTS.items():
        for sign in (1.0, -1.0):
            changed: Mapping[str, Any] = {name: getattr(layout, name) + sign * shift}
            yield f"{name} {sign * shift:+g}", replace(layout, **changed)
