"""The still picture: what is where, what hides what, and what turns red."""

from base64 import b64decode
from io import BytesIO

import numpy as np
import pytest
from PIL import Image

from dualarm_repro.view.scenes.camera import framed
from dualarm_repro.view.scenes.contents import WORLD, Contents, Motion, Part
from dualarm_repro.view.scenes.floor import Floor
from dualarm_repro.view.scenes.nearest import Nearest
from dualarm_repro.view.scenes.still import SIZE, still

POINTS = np.array([[-0.5, -0.5, -0.5], [0.5, 0.5, 0.5]])
CAMERA = framed(np.array([0.0, -1.0, 0.3]), POINTS)


def box(place, color, opacity=1.0, body=None, node=WORLD, edge=0.3):
    pose = np.eye(4)
    pose[:3, 3] = place
    return Part(node, "box", (edge,) * 3, color, pose, opacity, body)


def scene(*parts, motion=None, nearest=None):
    made = Contents("t", np.ones(3), grid=False, parts=list(parts), motion=motion, nearest=nearest)
    made.nodes["cart"] = np.eye(4)
    return made


def picture(made, frame=None, ghosts=(), floor=None):
    data = still(made, CAMERA, floor, frame, list(ghosts)).partition("base64,")[2]
    image = Image.open(BytesIO(b64decode(data))).convert("RGBA")
    assert image.size == SIZE
    return np.asarray(image, dtype=float) / 255.0


def at(image, place):
    """The colour and opacity where a place of the world is seen."""
    x, y, _ = CAMERA.project(np.asarray(place, dtype=float))
    height, width = image.shape[:2]
    return image[int(0.5 * (1 - y) * height), int(0.5 * (x + 1) * width)]


def reddish(pixel):
    return pixel[0] > 1.5 * max(pixel[1], pixel[2])


def bluish(pixel):
    return pixel[2] > 1.3 * pixel[0]


def test_a_box_stands_where_it_is_and_leaves_the_rest_clear():
    image = picture(scene(box((0.2, 0.0, 0.1), "#0072B2")))
    pixel = at(image, (0.2, 0.0, 0.1))
    assert bluish(pixel)
    assert pixel[3] == 1.0
    assert at(image, (-0.3, 0.0, 0.1))[3] == 0.0


def test_the_nearer_box_hides_the_farther_whatever_the_order():
    near, far = box((0, -0.4, 0), "#D55E00"), box((0, 0.4, 0), "#0072B2", edge=0.1)
    for parts in ((near, far), (far, near)):
        assert reddish(at(picture(scene(*parts)), (0.0, -0.4, 0.0)))


def test_what_is_translucent_lets_the_rest_through():
    clear, behind = box((0, -0.4, 0), "#D55E00", opacity=0.3), box((0, 0.4, 0), "#0072B2")
    pixel = at(picture(scene(clear, behind)), (0.0, 0.4, 0.0))
    assert pixel[3] == 1.0
    assert bluish(pixel)
    alone = at(picture(scene(clear)), (0.0, -0.4, 0.0))
    # of one face in front, as faces behind are not painted; the picture is compressed
    assert alone[3] == pytest.approx(0.3, abs=0.02)


def touching(contacts, distance=-0.01):
    ends = np.array([[[-0.45, -0.4, 0.4], [0.45, -0.4, 0.4]]])
    return Nearest(np.array([distance]), ends, [("a", "b")], [contacts], "bodies")


def test_a_body_in_contact_turns_red():
    parts = box((-0.25, 0, 0), "#0072B2", body="a"), box((0.25, 0, 0), "#0072B2", body="b")
    image = picture(scene(*parts, nearest=touching({"a"})))
    assert reddish(at(image, (-0.25, 0.0, 0.0)))
    assert bluish(at(image, (0.25, 0.0, 0.0)))


def test_the_shortest_way_is_drawn():
    found = touching(set(), 0.1)
    image = picture(scene(box((0.3, 0.3, -0.4), "#0072B2", edge=0.05), nearest=found))
    assert at(image, (0.0, -0.4, 0.4))[3] > 0.5
    assert at(image, (0.0, -0.4, 0.2))[3] == 0.0
    beyond = touching(set(), np.inf)
    image = picture(scene(box((0.3, 0.3, -0.4), "#0072B2", edge=0.05), nearest=beyond))
    assert at(image, (0.0, -0.4, 0.4))[3] == 0.0


def test_a_frame_is_drawn_whole_and_the_others_faintly():
    poses = np.tile(np.eye(4), (3, 1, 1))
    poses[:, 0, 3] = -0.3, 0.0, 0.3
    motion = Motion(np.arange(3), 20, {"cart": poses})
    made = scene(box((0, 0, 0), "#0072B2", node="cart", edge=0.2), motion=motion)
    image = picture(made, frame=1, ghosts=[0, 2])
    opacity = [at(image, (x, 0.0, 0.0))[3] for x in (-0.3, 0.0, 0.3)]
    assert opacity[1] == 1.0
    assert 0.0 < opacity[0] < 0.6
    assert 0.0 < opacity[2] < 0.6
    assert at(picture(made, frame=1), (0.3, 0.0, 0.0))[3] == 0.0


@pytest.mark.parametrize(
    ("kind", "vertices"),
    [("line", [[-0.4, 0, 0.2], [0.4, 0, 0.2]]), ("points", [[0.0, 0, 0.2], [0.3, 0, 0.2]])],
)
def test_polylines_and_clouds_are_drawn_at_their_points(kind, vertices):
    part = Part(WORLD, kind, (0.02,), "#D55E00", vertices=np.array(vertices))
    image = picture(scene(part))
    assert at(image, (0.0, 0.0, 0.2))[3] > 0.3
    assert at(image, (0.0, 0.0, -0.2))[3] == 0.0
    between = at(image, (0.15, 0.0, 0.2))[3]
    assert bool(between > 0.3) is (kind == "line")


def test_the_floor_is_a_grid_below():
    floor = Floor(-0.4, 0.25, (-0.5, -0.5), (0.5, 0.5))
    image = picture(scene(), floor=floor)
    assert at(image, (0.0, 0.0, -0.4))[3] > 0.2
    assert at(image, (0.125, 0.125, -0.4))[3] < 0.2
