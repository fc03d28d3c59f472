"""The scene of a task shows every body that is judged."""

import textwrap

import numpy as np
import pytest

from dualarm_repro.scene import load_scene
from dualarm_repro.view.task_scene import drawn_scene

EVERYTHING = """
    arms:
      left:
        robot: irb120
        tool: {shapes: [{kind: capsule, start: [0, 0, 0], end: [0, 0, 0.2], radius: 0.02}]}
      right: {robot: panda, xyz: [0, 1.5, 0]}
    obstacles:
      ball: {kind: sphere, center: [0, 0.7, 1.2], radius: 0.1}
      pole: {kind: capsule, start: [1, 0.5, 0], end: [1, 0.5, 1], radius: 0.05}
      can: {kind: cylinder, start: [1, 1, 0], end: [1, 1, 0.3], radius: 0.05}
      table: {kind: box, center: [-1, 1, 0.3], size: [0.5, 0.5, 0.1]}
      wall: {kind: halfspace, normal: [1, 0, 0], offset: -2}
      rock: {kind: hull, points: [[1, 2, 0], [1.2, 2, 0], [1, 2.2, 0], [1, 2, 0.2]]}
      window:
        {kind: window, center: [0, 3, 1], normal: [0, 1, 0], opening_width: 0.6,
         opening_height: 0.7, bar_width: 0.1, bar_depth: 0.05}
    moving:
      cart:
        shape: {kind: box, center: [0, 0, 0], size: [0.2, 0.2, 0.2]}
        path: [{at: 0, xyz: [2, 0, 0.2]}, {at: 20, xyz: [2, 1, 0.2]}]
    floor: -0.1
"""


@pytest.fixture
def scene(tmp_path):
    path = tmp_path / "scene.yaml"
    path.write_text(textwrap.dedent(EVERYTHING), encoding="utf-8")
    return load_scene(path)


def test_every_body_is_drawn_whatever_its_shape(scene):
    index = np.arange(21.0)
    rows = {
        "left": np.linspace(np.zeros(6), np.full(6, 0.5), 21),
        "right": np.tile([0, 0, 0, -1.5, 0, 1.5, 0], (21, 1)),
    }
    made = drawn_scene(scene, "everything", rows, index)
    drawn = {part.body for part in made.contents.parts}
    owners = {body.owner for body in scene.bodies.all} - {"floor", "left", "right"}
    assert owners == {"ball", "pole", "can", "table", "wall", "rock", "window", "cart"}
    assert owners <= drawn
    assert {"left:6", "right:7"} <= drawn
    assert sum(part.body == "window" for part in made.contents.parts) == 4
    assert made.contents.floor == -0.1
    last = made.contents.pose("cart", len(made.contents.motion.frames) - 1)
    assert last[:3, 3] == pytest.approx([2, 1, 0.2])
    assert "tool" in {name.split("/")[-1].split("_")[0] for name, _ in scene.pairs.names}
    assert len(made.html()) > 10_000


def test_what_is_shown_as_nearest_is_what_the_scene_watches(scene):
    rows = {"left": np.zeros((1, 6)), "right": np.array([[0, 0, 0, -1.5, 0, 1.5, 0]])}
    goals = {"left": np.full(6, 0.3)}
    made = drawn_scene(scene, "still", rows, np.zeros(1), goals)
    assert made.contents.motion is None
    assert made.contents.nearest.distance.shape == (1,)
    assert any(part.opacity < 0.5 for part in made.contents.parts if "goal" in part.node)
