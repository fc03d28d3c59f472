"""Figure 8 of `qiu` and what is said about the slave and both arms together."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np
import pandas as pd

from ...ledger import REGISTRY, Assumed, Bounded, Is, NoOriginal, Result, Rounds
from ...planning.bidirectional_compiled import plan_bidirectional_compiled
from ...planning.splice import smoothed
from ...planning.time_map import hull_tracks, replay, shares, time_map
from ...scene import JointPath, distances
from ...view.diagrams import flow_chart
from ..wording import point
from .execution import both_arms, dual_scene, executed
from .readings import SLAVE as SLAVE_ASSUMPTIONS
from .readings import DualPlan, dual_plan, reconstructed

checks = partial(REGISTRY.checks, page="qiu/master_slave")
SLAVE_MEETING = np.array([[0.158, 0.124, 0.150], [0.169, 0.112, 0.149]])
_SHIFTS = (-6, -3, 3, 6)
_NEAR = {"tolerance": 0.01, "reason": "two runs that agree to one centimetre"}
_STAGES = (
    ("master", "search from both ends", plan_bidirectional_compiled),
    ("master", "join and smooth", smoothed),
    ("moving hull", "poses from both ends to the middle", shares),
    ("moving hull", "circles at the joints, their hulls", hull_tracks),
    ("slave", "search around spheres and hull", plan_bidirectional_compiled),
    ("slave", "join and smooth", smoothed),
    ("slave", "time map of the search", time_map),
    ("slave", "execute both arms by it", replay),
)


def dual_readings(assumed: Assumed) -> dict[str, DualPlan]:
    """Both arms at face value and in the reconstruction."""
    return {
        "face value": dual_plan(assumed),
        "reconstruction": dual_plan(reconstructed(assumed, SLAVE_ASSUMPTIONS)),
    }


@checks(
    "qiu.fig08",
    rules=[
        Is(
            key="master_before_slave",
            value=True,
            label="the slave is searched after the master's path",
        ),
        NoOriginal(key="drawing", label="the flow chart"),
    ],
)
def order_of_work(assumed: Assumed) -> Result:
    """The order of work that the code follows."""
    parts = list(dict.fromkeys(part for part, _, _ in _STAGES))
    rows = [
        (part, text, f"{code.__module__.split('.')[-1]}.{code.__name__}")
        for part, text, code in _STAGES
    ]
    return Result(
        obtained={
            "master_before_slave": parts.index("master") < parts.index("slave"),
            "stages": [f"{part}: {text}" for part, text, _ in rows],
        },
        table=pd.DataFrame(rows, columns=["part", "step", "code"]),
        caption=(
            f"Order of work in {len(rows)} stages with the function behind each: the master among "
            "the spheres, its hull at every pose, the slave around it, both executed by one time "
            "map. The chart of the document is lost."
        ),
        alt="Flow chart in three columns: plan the master, build its moving hull, plan the slave "
        "and execute both arms.",
        figure=lambda: flow_chart(rows),
    )


def _summary(plan: DualPlan) -> dict[str, Any]:
    slave = plan.slave
    pairs = zip(slave.ends, SLAVE_MEETING, strict=True)
    return {
        "reason": str(slave.reason),
        "searches": slave.searches,
        "ends": [end.tolist() for end in slave.ends],
        "gap_tip": float(np.linalg.norm(slave.ends[0] - slave.ends[1])),
        "distance_to_print": [float(np.linalg.norm(end - printed)) for end, printed in pairs],
    }


@checks(
    "qiu.claim_slave_counts",
    rules=[
        Rounds(key="forward", to="forward", label="searches of the forward half"),
        Rounds(key="backward", to="backward", label="searches of the backward half"),
    ],
    samples=16,
)
def counts(assumed: Assumed) -> Result:
    """Searches of the slave's halves while the hull of the master moves."""
    face, other = (_summary(plan) for plan in dual_readings(assumed).values())
    return Result(
        obtained={
            "forward": face["searches"],
            "backward": face["searches"],
            "face_value": face,
            "reconstruction": other,
        },
        caption=(
            f"The slave's halves need {face['searches']} searches each at face value "
            f"({face['reason']}) "
            f"and {other['searches']} in the reconstruction ({other['reason']}); 39 are printed."
        ),
    )


@checks(
    "qiu.claim_slave_meet",
    rules=[
        Rounds(key="forward", to="forward", label="end of the forward half [m]", **_NEAR),
        Rounds(key="backward", to="backward", label="end of the backward half [m]", **_NEAR),
    ],
    samples=16,
)
def meeting(assumed: Assumed) -> Result:
    """Where the slave's halves end, against print."""
    face, other = (_summary(plan) for plan in dual_readings(assumed).values())
    printed_gap = float(np.linalg.norm(SLAVE_MEETING[0] - SLAVE_MEETING[1]))
    return Result(
        obtained={
            "forward": face["ends"][0],
            "backward": face["ends"][1],
            "gap_tip": face["gap_tip"],
            "printed_gap_tip": printed_gap,
            "distance_to_print": face["distance_to_print"],
            "reconstruction": other,
        },
        caption=(
            f"The slave's halves end at ({point(np.array(face['ends'][0]), 3)}) m, "
            f"{1e3 * max(face['distance_to_print']):.0f} mm from print, and in the reconstruction "
            f"{1e3 * max(other['distance_to_print']):.0f} mm from print. Gap of the tips "
            f"{1e3 * face['gap_tip']:.1f} mm, printed {1e3 * printed_gap:.1f} mm."
        ),
    )


@checks(
    "qiu.claim_master_timeline",
    rules=[
        Is(key="from_both_ends", value=True, label="poses run from both ends towards the middle"),
        Bounded(key="unevenness", high=1e-12, label="largest deviation from an even schedule"),
        Is(key="middle_held", value=True, label="the middle pose is held in the last searches"),
        Bounded(
            key="replay_difference",
            high=1e-9,
            label="clearance with the master replayed as a moving obstacle differs by [m]",
        ),
    ],
    samples=16,
)
def schedule(assumed: Assumed) -> Result:
    """The schedule of master poses, and the time map that execution replays."""
    plan = dual_plan(assumed)
    searches, spread = plan.slave.searches, plan.spread
    seen = shares(searches, spread)
    moving = np.diff(seen[: spread + 1])
    share = time_map(plan.slave, spread)
    return Result(
        obtained={
            "from_both_ends": bool(
                share[0] == 0.0 and share[-1] == 1.0 and (np.diff(share) >= 0).all()
            ),
            "unevenness": float(np.ptp(moving)),
            "middle_held": bool(searches > spread and (seen[spread:] == 0.5).all()),
            "held_searches": max(searches - spread, 0),
            "wait_samples": len(both_arms(plan)[0]) - len(share),
            "replay_difference": _replay_difference(plan),
        },
        table=pd.DataFrame({"sample": range(len(share)), "share_of_master_path": share}),
        caption=(
            f"The master's poses are spread over {spread} searches from both ends and its middle "
            "pose is "
            f"held for the remaining {max(searches - spread, 0)}. The map from the slave's "
            f"{len(share)} "
            "samples to the master's path is an output of the plan; replaying it gives the same "
            "clearance "
            "whether the master is controlled or a moving obstacle."
        ),
    )


def _replay_difference(plan: DualPlan) -> float:
    """Distance of the arms with both controlled, minus that with the master as a moving
    obstacle.
    """
    master, slave = both_arms(plan)
    scene = dual_scene()
    moving = scene.replaying("master", JointPath(master))
    one = distances(scene, scene.stack(master=master, slave=slave))
    two = distances(moving, slave, np.arange(len(slave), dtype=float))
    pairs = (found[:, where.pairs.between("master", "slave")] for found, where in
             ((one, scene), (two, moving)))  # fmt: skip
    smallest = [found.min() for found in pairs]
    return float(abs(smallest[0] - smallest[1]))


@checks(
    "qiu.claim_no_collision",
    rules=[
        Bounded(key="arms", low=0.0, label="smallest distance of the links of both arms [m]"),
        Bounded(key="smallest", low=0.0, label="smallest distance of any links and obstacles [m]"),
    ],
    samples=16,
)
def no_collision(assumed: Assumed) -> Result:
    """Contact of whole links while both arms execute their paths, in step and out of step."""
    scale, radii = assumed["link_radius_scale"], assumed["link_radii"]
    plans = dual_readings(assumed)
    checks_ = {name: executed(plan, radius_scale=scale) for name, plan in plans.items()}
    face, other = checks_["face value"], checks_["reconstruction"]
    plan = plans["reconstruction"]
    shifted = {k: executed(plan, shift=k, radius_scale=scale).clearance["arms"] for k in _SHIFTS}
    uniform = executed(plan, "uniform", radius_scale=scale).clearance["arms"]
    thin = executed(plan, radius_scale=0.8 * scale)
    return Result(
        obtained={
            "arms": face.clearance["arms"],
            "smallest": face.smallest,
            "face_value": {**face.clearance, "beyond_limits": face.beyond_limits},
            "reconstruction": {**other.clearance, "beyond_limits": other.beyond_limits},
            "reconstruction_thinner_links": thin.clearance,
            "out_of_step": {str(k): v for k, v in shifted.items()},
            "uniform_speed": uniform,
            "control_points": plans["face value"].slave.control_clearance,
            "links": len(radii),
        },
        caption=(
            "At face value the planner sees "
            f"{1e3 * plans['face value'].slave.control_clearance:.0f} mm at "
            f"its control points, while the links of the arms come to "
            f"{1e3 * face.clearance['arms']:.0f} mm. In the reconstruction the arms keep "
            f"{1e3 * other.clearance['arms']:.0f} mm and the spheres "
            f"{1e3 * other.clearance['obstacles']:.0f} "
            f"mm. Played {_SHIFTS[-1]} samples out of step the arms keep "
            f"{1e3 * min(shifted.values()):.0f} mm at worst, at uniform speed {1e3 * uniform:.0f} "
            "mm."
        ),
    )
