"""HTML of a scene: names where their points are seen, and words that say what is shown."""

import numpy as np
import pytest
from bs4 import BeautifulSoup

from dualarm_repro.view.scenes.camera import framed
from dualarm_repro.view.scenes.contents import WORLD, Contents, Mark, Motion, Part
from dualarm_repro.view.scenes.floor import Floor
from dualarm_repro.view.scenes.markup import alone, figure, shown_frame
from dualarm_repro.view.scenes.nearest import Nearest

FLOOR = Floor(0.0, 0.25, (-1.0, -1.0), (1.0, 1.0))
CAMERA = framed(np.array([1.0, -1.0, 0.6]), np.array([[-1.0, -1.0, 0.0], [1.0, 1.0, 1.0]]))


def contents(distances=None, frames=(0, 3, 7), **more):
    made = Contents("Two <boxes>.", np.ones(3), grid=True, **more)
    made.parts.append(Part(WORLD, "box", (0.2, 0.3, 0.4), "#0072B2"))
    if frames:
        made.nodes["cart"] = np.eye(4)
        poses = np.tile(np.eye(4), (len(frames), 1, 1))
        made.motion = Motion(np.array(frames), 20, {"cart": poses})
    if distances is not None:
        count = len(distances)
        names = [("left, link 3", "ball")] * count
        made.nearest = Nearest(
            np.array(distances), np.zeros((count, 2, 3)), names, [set()] * count,
            "arms and obstacles",
        )  # fmt: skip
    return made


def soup(made):
    return BeautifulSoup(figure(made, CAMERA, FLOOR), "html.parser")


def caption(made):
    return soup(made).figcaption.get_text()


def test_a_scene_in_motion_is_shown_where_bodies_are_closest():
    made = contents([0.3, 0.0123, 0.2])
    assert shown_frame(made) == 1
    assert caption(made) == (
        "Two <boxes>. Shown: step 3 of 7, where arms and obstacles are closest: left, link 3 and "
        "ball are 12 mm apart. Faint: first and last posture. Cells of the floor: 0.25 m."
    )


@pytest.mark.parametrize(
    ("distance", "told"),
    [(0.00432, "left, link 3 and ball are 4.3 mm apart"),
     (-0.0157, "left, link 3 and ball overlap by 16 mm"),
     (-0.0012, "left, link 3 and ball overlap by 1.2 mm")],
)  # fmt: skip
def test_distances_are_told_to_a_sensible_digit(distance, told):
    text = caption(contents([distance], frames=()))
    assert told[0].upper() + told[1:] in text
    assert "Shown" not in text
    assert "Faint" not in text


def test_without_distances_the_middle_of_the_motion_is_shown():
    made = contents()
    assert shown_frame(made) == 1
    assert "Shown: step 3 of 7. Faint:" in caption(made)
    assert shown_frame(contents(frames=())) is None


def test_notes_and_columns_are_explained():
    made = contents(frames=(), note="Bars: manipulability.")
    made.columns = True
    assert caption(made) == (
        "Two <boxes>. Bars: manipulability. Grey columns: the height of the bases is not known. "
        "Cells of the floor: 0.25 m."
    )


def test_names_stand_where_the_camera_sees_their_points():
    made = contents(frames=())
    point = np.array([0.4, 0.1, 0.6])
    made.nodes["arm"] = np.eye(4)
    made.nodes["arm"][:3, 3] = 0.5 * point
    made.marks += [Mark("flange", "arm", 0.5 * point), Mark("a & b", WORLD, point + 0.5)]
    first, second = soup(made).select(".scene-marks span")
    x, y, _ = CAMERA.project(point)
    expected = f"left:{50 * (1 + x):.1f}%;top:{50 * (1 - y):.1f}%"
    assert first["style"] == expected
    assert (first.get_text(), second.get_text()) == ("flange", "a & b")


def test_names_of_one_point_stand_below_each_other():
    made = contents(frames=())
    made.marks += [Mark(name, WORLD, np.zeros(3)) for name in ("one", "two", "three")]
    tops = [float(span["style"].split("top:")[1].rstrip("%"))
            for span in soup(made).select("span")]  # fmt: skip
    assert len(tops) == 3
    assert min(np.diff(tops)) >= 4.5  # the height of a line is 4.6 % of the picture


def test_the_picture_has_its_size_and_its_words():
    image = soup(contents(frames=())).img
    assert (image["width"], image["height"], image["alt"]) == ("960", "540", "Two <boxes>.")
    assert image["src"].startswith("data:image/webp;base64,")


def test_a_file_of_its_own_needs_nothing_else():
    page = BeautifulSoup(alone("a <title>", figure(contents(), CAMERA, FLOOR)), "html.parser")
    assert page.title.get_text() == "a <title>"
    assert len(page.find_all("script")) == 3
    assert not page.find_all(src=lambda where: where and not where.startswith("data:"))
    assert not page.find_all("link")
    assert page.style.get_text()
