"""Rows of success, and scenes of arms."""

from types import SimpleNamespace

import numpy as np
import pandas as pd
import pinocchio as pin
import pytest

from dualarm_repro.arms import load_arm
from dualarm_repro.scene import ConvexHull, PlacedArm, Sphere
from dualarm_repro.view import arm_scenes
from dualarm_repro.view.arm_scenes import (
    among_spheres,
    inside_hull,
    pair_panel,
    played_pair,
    played_search,
    search_panel,
    standing,
)
from dualarm_repro.view.style import GREEN, MASTER, SLAVE
from dualarm_repro.view.success_table import judged_share, success_row

CAMERA = (1.0, 1.0, 1.0)
PATH = np.linspace(np.zeros(6), (0.6, 0.2, -0.1, 0.0, 0.3, 0.0), 25)
SPHERES = {"one": Sphere([0.2, 0.1, 1.0], 0.1), "other": Sphere([-0.2, 0.1, 1.0], 0.05)}


@pytest.fixture(scope="module")
def placed():
    return [
        PlacedArm(name, load_arm("irb120"), pin.SE3(np.eye(3), np.array([x, 0.0, 0.0])))
        for name, x in (("master", 0.4), ("slave", -0.4))
    ]


def flange(arm, q):
    return arm.placement.act(arm.arm.fk(q)[:3, 3])


def test_a_row_of_success():
    table = pd.DataFrame(
        {
            "x_planner": [True, True, False, False],
            "x_truth": [True, False, False, False],
            "x_failure": ["None", "None", "midway-minimum", "displaced-goal"],
        }
    )
    row = success_row(table, "x")
    assert (row["planner %"], row["true %"], row["of"]) == (50.0, 25.0, 4)
    assert row["displaced-goal"] == row["midway-minimum"] == 1
    share = judged_share(table, "x", "truth")
    assert row["true low %"] == pytest.approx(100 * share.low, abs=0.05)  # shown to 0.1 %
    assert "midway-minimum" not in success_row(table.drop(columns="x_failure"), "x")


def test_scenes_of_arms(placed):
    corners = np.vstack([np.zeros(3), np.eye(3)])
    for made in (
        standing("Two arms.", placed, np.zeros(6), CAMERA),
        inside_hull("A hull.", placed[0], np.zeros(6), ConvexHull(corners), CAMERA),
        among_spheres("A sphere.", {"one": Sphere([0, 0, 1], 0.1)}, CAMERA),
    ):
        assert made.title in made.page_html()


def test_arms_stand_in_one_posture_and_in_their_colours(placed):
    made = standing("t", placed, PATH[-1], CAMERA)
    for arm, color in zip(placed, (MASTER, SLAVE), strict=True):
        data = arm.arm.model.createData()
        pin.forwardKinematics(arm.arm.model, data, PATH[-1])
        pose = made.contents.nodes[f"{arm.name}/6"]
        np.testing.assert_allclose(pose, (arm.placement * data.oMi[6]).homogeneous, atol=1e-9)
        checked = {p.color for p in made.contents.checked if p.node.startswith(f"{arm.name}/")}
        assert checked == {color}


def test_a_hull_is_translucent_and_whole(placed):
    hull = ConvexHull(np.vstack([np.zeros(3), np.eye(3)]))
    made = inside_hull("t", placed[0], np.zeros(6), hull, CAMERA)
    (mesh,) = [p for p in made.contents.parts if p.kind == "mesh"]
    assert 0.0 < mesh.opacity < 1.0
    np.testing.assert_array_equal(mesh.vertices, hull.vertices)
    np.testing.assert_array_equal(mesh.faces, hull.faces)


def test_spheres_are_obstacles_at_their_places():
    made = among_spheres("t", SPHERES, CAMERA)
    found = {p.body: (*p.pose[:3, 3], p.size[0]) for p in made.contents.parts}
    assert found == {n: pytest.approx((*s.center, s.radius)) for n, s in SPHERES.items()}
    assert made.contents.marks == [], "an obstacle marks no place"


def test_a_search_is_played_along_its_path(placed):
    plan = SimpleNamespace(placed=placed[0], path=PATH, problem=SimpleNamespace(start=PATH[0]))
    curve = np.array([flange(placed[0], q) for q in PATH])
    made = played_search("t", plan, SPHERES, {"flange": (curve, GREEN)})
    assert made.contents.motion.frames.tolist() == [*range(0, 25, 3)]
    np.testing.assert_allclose(made.contents.tips["master"], curve, atol=1e-9)
    (line,) = [p for p in made.contents.parts if p.kind == "line"]
    assert line.color == GREEN
    np.testing.assert_array_equal(line.vertices, curve)
    assert {"one", "other"} <= {p.body for p in made.contents.parts}


def dual(placed):
    """Two arms that are played by a map of times, as a search leaves them."""
    played = PATH, 0.5 * PATH
    tips = tuple(np.array([flange(a, q) for q in rows])
                 for a, rows in zip(placed, played, strict=True))  # fmt: skip
    return SimpleNamespace(arms=tuple(placed), played=lambda: played, tips=lambda: tips,
                           master_path=PATH, circles="the circles")  # fmt: skip


def test_both_arms_are_played_with_the_hull_of_the_middle_pose(placed, monkeypatch):
    asked = []
    turn = np.linspace(0.0, 2.0 * np.pi, 8, endpoint=False)
    ring = np.column_stack([np.cos(turn), np.sin(turn), turn])

    def circles(arm, given, q):
        asked.append((arm.name, given, q))
        return ring[np.newaxis]

    monkeypatch.setattr(arm_scenes, "circles_on", circles)
    made = played_pair("t", dual(placed), SPHERES, CAMERA)
    ((name, given, q),) = asked
    assert (name, given) == ("master", "the circles")
    np.testing.assert_array_equal(q, PATH[12][np.newaxis])
    (hull,) = [p for p in made.contents.parts if p.kind == "mesh"]
    assert hull.color == GREEN
    for arm, rows, color in zip(placed, (PATH, 0.5 * PATH), (MASTER, SLAVE), strict=True):
        tips = np.array([flange(arm, row) for row in rows])
        np.testing.assert_allclose(made.contents.tips[arm.name], tips, atol=1e-9)
        lines = [p for p in made.contents.parts if p.kind == "line" and p.color == color]
        np.testing.assert_allclose(lines[0].vertices, tips, atol=1e-9)


def test_panels_show_postures_on_the_way(placed):
    plan = SimpleNamespace(placed=placed[0], path=PATH)
    panel = search_panel("search", plan, {"path": PATH[:, :3]}, {"goal": PATH[-1, :3]})
    assert (panel.title, list(panel.paths), list(panel.marks)) == ("search", ["path"], ["goal"])
    shown = [q for _, q in panel.postures]
    np.testing.assert_array_equal(shown, PATH[::4])
    short = search_panel("short", SimpleNamespace(placed=placed[0], path=PATH[:3]), {}, {})
    np.testing.assert_array_equal([q for _, q in short.postures], PATH[:3])


def test_both_arms_are_shown_at_common_times(placed):
    panel = pair_panel("both", dual(placed))
    assert list(panel.paths) == ["master", "slave"]
    by_arm = {name: [q for arm, q in panel.postures if arm.name == name] for name in panel.paths}
    np.testing.assert_array_equal(by_arm["master"], PATH[[0, 6, 12, 18, 24]])
    np.testing.assert_array_equal(by_arm["slave"], 0.5 * np.array(by_arm["master"]))
