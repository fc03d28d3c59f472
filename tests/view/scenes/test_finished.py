"""What every scene gets: feet on the floor, trails with both ends, a camera that sees all."""

import numpy as np
import pinocchio as pin
import pytest

from dualarm_repro.arms import load_arm
from dualarm_repro.scene import PlacedArm
from dualarm_repro.view.scene3d import Scene3D
from dualarm_repro.view.scenes.arm_parts import FOOT, foot
from dualarm_repro.view.scenes.contents import Mark
from dualarm_repro.view.scenes.finished import extent, finished
from dualarm_repro.view.scenes.surfaces import surface

PATH = np.linspace(np.zeros(6), (0.9, 0.4, -0.3, 0.1, 0.5, 0.0), 31)


def scene(height=0.0, grid=True, turn=(0.0, 0.0, 0.0), floor=None, path=PATH):
    arm = load_arm("irb120")
    base = pin.SE3(pin.rpy.rpyToMatrix(*turn), np.array([0.3, 0.0, height]))
    made = Scene3D("t", camera=(2.0, -2.0, 1.0), grid=grid)
    made.add_arm("arm", arm, path[0], base)
    made.animate({"arm": (arm, path)})
    made.contents.floor = floor
    return made, [(PlacedArm("arm", arm, base), path[0])]


def added(made, arms):
    contents, camera, floor = finished(made.contents, arms)
    new = [part for part in contents.parts if part not in made.contents.parts]
    return contents, camera, floor, new


def test_what_was_put_into_a_scene_stays_as_it_is():
    made, arms = scene()
    before = len(made.contents.parts), len(made.contents.marks)
    contents, _, _, new = added(made, arms)
    assert (len(made.contents.parts), len(made.contents.marks)) == before
    assert len(contents.parts) == before[0] + len(new)


def test_the_way_of_the_flange_is_drawn_with_both_ends():
    made, arms = scene()
    contents, _, _, new = added(made, arms)
    (trail,) = [part for part in new if part.kind == "line"]
    arm, base = arms[0][0].arm, arms[0][0].placement
    tips = np.array([base.act(arm.fk(q)[:3, 3]) for q in PATH])
    np.testing.assert_allclose(trail.vertices, tips, atol=1e-12)
    balls = [part.pose[:3, 3] for part in new if part.kind == "tapered"]
    np.testing.assert_allclose(balls, tips[[0, -1]], atol=1e-12)
    texts = {mark.text: mark.point for mark in contents.marks}
    np.testing.assert_allclose(texts["goal"], tips[-1], atol=1e-12)
    np.testing.assert_allclose(texts["start"], tips[0], atol=1e-12)


def test_a_way_that_is_drawn_already_is_not_drawn_again():
    made, arms = scene()
    tips = made.contents.tips["arm"]
    made.add_path("track", tips, "#D55E00")
    _, _, _, new = added(made, arms)
    assert not [part for part in new if part.kind == "line"]
    other, arms = scene()
    other.add_path("track", tips[:10], "#D55E00")
    assert [part for part in added(other, arms)[3] if part.kind == "line"], "it ends elsewhere"


def test_a_place_that_has_a_name_gets_no_second_one():
    made, arms = scene()
    made.contents.marks.append(Mark("my goal", "world", made.contents.tips["arm"][-1]))
    texts = [mark.text for mark in added(made, arms)[0].marks]
    assert "goal" not in texts
    assert "start" in texts


def test_a_way_back_to_its_start_has_no_ends():
    made, arms = scene(path=np.vstack([PATH, PATH[::-1]]))
    texts = {mark.text for mark in added(made, arms)[0].marks}
    assert not {"start", "goal"} & texts


@pytest.mark.parametrize(("height", "columns"), [(0.0, False), (0.8, True)])
def test_an_arm_stands_on_the_floor(height, columns):
    made, arms = scene(height, floor=0.0)
    contents, _, floor, new = added(made, arms)
    feet = [part for part in new if part.kind == "rod" and part.color == FOOT]
    assert len(feet) == 2
    ends = []
    for part in feet:
        z = (surface(part).vertices @ contents.pose(part.node)[:3, :3].T)[:, 2]
        z = z + contents.pose(part.node)[2, 3]
        ends.append((z.min(), z.max()))
    (below, plate), (bottom, top) = ends
    assert plate == pytest.approx(bottom)
    low = height + foot(arms[0][0].arm)[0]
    assert bottom == pytest.approx(min(0.0, low))
    assert below < plate
    assert top > low
    assert bool(contents.columns) is columns
    assert floor.height == 0.0


def test_an_arm_that_hangs_or_has_no_floor_gets_no_foot():
    made, arms = scene(1.0, turn=(np.pi, 0.0, 0.0))
    assert not [part for part in added(made, arms)[3] if part.color == FOOT and part.kind == "rod"]
    made, arms = scene(grid=False)
    _, _, floor, new = added(made, arms)
    assert floor is None
    assert not [part for part in new if part.kind == "rod"]


def test_the_camera_sees_every_corner_wherever_it_moves():
    made, arms = scene()
    contents, camera, _, _ = added(made, arms)
    seen = camera.project(extent(contents))
    assert abs(seen[:, :2]).max() <= 1.0
    assert seen[:, 2].min() > 0.0


def test_the_extent_holds_all_that_is_drawn_at_every_key_frame():
    made, _ = scene()
    corners = extent(made.contents)
    low, high = corners.min(axis=0), corners.max(axis=0)
    count = len(made.contents.motion.frames)
    assert count <= 24, "each of them is looked at"
    for part in made.contents.parts:
        vertices = surface(part).vertices
        for frame in range(count):
            pose = made.contents.pose(part.node, frame)
            placed = vertices @ pose[:3, :3].T + pose[:3, 3]
            assert (placed >= low - 1e-9).all()
            assert (placed <= high + 1e-9).all()


def test_an_empty_scene_can_be_looked_at():
    contents, camera, floor = finished(Scene3D("t", camera=(1.0, 1.0, 1.0)).contents, [])
    assert np.isfinite(camera.eye).all()
    assert contents.parts == []
    assert floor.cell > 0.0
