"""Drawings of replayed motions and of an upright arm."""

import matplotlib.pyplot as plt
import numpy as np
import pinocchio as pin
from matplotlib.collections import PolyCollection
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from dualarm_repro.arms import load_arm
from dualarm_repro.planning import plan_apf_compiled
from dualarm_repro.planning.descent.termination import StopReason
from dualarm_repro.planning.field.obstacles import obstacles_of
from dualarm_repro.planning.settings import (
    APFSettings,
    Attraction,
    Termination,
    Trap,
    Update,
)
from dualarm_repro.planning.trials.replay import Replay
from dualarm_repro.scene import JointPath, PlacedArm, Scene, window_frame
from dualarm_repro.scene.posing import links_of
from dualarm_repro.view import replays
from dualarm_repro.view.link_bodies import capsules_at, draw_flat
from dualarm_repro.view.scene3d import Scene3D
from dualarm_repro.view.tracks import top_view_figure, tracks_figure
from dualarm_repro.view.upright_arm import upright_drawing

BARS = window_frame((1.2, 0.0, -0.8), np.eye(3), 0.5, 0.5, 0.1, 0.1)
SETTINGS = APFSettings(
    attraction=Attraction(gain=3.0, joint_weight=1.0),
    control_points="end_effector",
    update=Update(rule="gradient", gain=0.05, max_step=0.05),
    termination=Termination(
        joint_tolerance=0.02,
        step_limit=500,
        trap=Trap(rule="block_means", steps=50, threshold=1e-3),
    ),
)


def replay():
    arm = PlacedArm("slave", load_arm("es165d"))
    start, goal = np.zeros(6), np.array([0.4, 0.2, 0.0, 0.0, 0.3, 0.0])
    plan = plan_apf_compiled(arm, start, goal, obstacles_of(Scene([arm])), SETTINGS)
    assert plan.reason is StopReason.REACHED
    master = PlacedArm("master", load_arm("es165d"), pin.SE3(np.eye(3), np.array([0.0, 1.0, 0.0])))
    track = JointPath(np.linspace(start, goal, 9))
    return Replay(plan, master, track, obstacles_of(Scene([arm], {"window": BARS})))


def test_replays_are_drawn_from_either_side():
    shown = replay()
    marks = {"start": shown.plan.tcp[0]}
    figure = replays.replay_figure(top_view_figure, shown, BARS, marks)
    names = {line.get_label() for line in figure.axes[0].lines}
    assert {name for name in names if not name.startswith("_")} == {"master", "slave"}
    contacts = {"meets": shown.plan.tcp[replays.contacts_of(shown)[1]]}
    assert replays.replay_figure(tracks_figure, shown, BARS, marks, contacts, elev=20).axes


def test_arms_are_drawn_as_bodies_at_the_same_instant():
    shown, marks = replay(), {"start": replay().plan.tcp[0]}
    figure = replays.replay_figure(tracks_figure, shown, BARS, marks, instants=[4, 8], elev=20)
    space, above, _ = figure.axes
    links = len(links_of(shown.other.arm).radius)
    tubes = [c for c in space.collections if isinstance(c, Poly3DCollection)]
    assert len(tubes) == len(BARS) + 2 * 2
    outlines = [c for c in above.collections if isinstance(c, PolyCollection)]
    assert [len(c.get_paths()) for c in outlines] == [links] * 4
    assert {text.get_text().strip() for text in above.texts} >= {"8"}


def test_a_meeting_is_marked_between_the_end_effectors():
    shown = replay()
    step, middle = replays.meeting(shown)
    own, other = shown.plan.tcp[step], shown.track.at(np.array([float(step)]))
    apart = np.linalg.norm(own - middle)
    assert apart == np.min(0.5 * shown.apart(moving=True))
    assert other.shape == (1, 6)


def test_the_outline_of_a_link_has_its_radius():
    body = replays.bodies_at(replay(), 3)[1]
    ends, radii = capsules_at(body)
    assert ends.shape == (len(radii), 2, 3)
    figure, ax = plt.subplots()
    draw_flat(ax, body, [0, 1])
    (first, *_) = ax.collections[0].get_paths()
    gaps = np.linalg.norm(first.vertices - ends[0, 0, :2], axis=1)
    assert gaps.min() >= radii[0] - 1e-9
    plt.close(figure)


def test_scenes_hold_what_is_added():
    shown, made = replay(), Scene3D("two arms", (3.0, 3.0, 3.0))
    replays.add_stage(made, BARS, {"goal": (shown.plan.tcp[-1], 0.03, "#000000")})
    assert replays.add_contacts(replays.add_replay(made, shown), shown) is made
    assert "two arms" in made.html()
    alone = Scene3D("one arm", (3.0, 3.0, 3.0))
    assert replays.add_plan(alone, shown.plan) is alone


def test_every_length_has_its_dimension_line():
    size = {"d1": 0.65, "a1": 0.285, "a2": 1.15, "a3": 0.25, "d4": 1.225, "d6": 0.25}
    (axes,) = upright_drawing(size).axes
    assert {f"{name} = {1000 * value:.0f}" for name, value in size.items()} <= {
        text.get_text() for text in axes.texts
    }
