"""Triangles and strokes: what is nearer hides, what is translucent does not."""

import numpy as np

from dualarm_repro.view.scenes.raster import fill_triangles, stroke

RED, BLUE = (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)


def triangle(near):
    """Half of a picture of 8 x 8; a turn to the left on the screen faces the camera."""
    return np.array([[[0.0, 0.0, near], [0.0, 8.0, near], [8.0, 8.0, near]]])


def canvas():
    return np.zeros((8, 8, 4)), np.zeros((8, 8))


def test_the_nearer_triangle_is_seen_whatever_the_order():
    light = np.ones((1, 3))
    for order in (1, -1):
        image, depth = canvas()
        for near, color in [(2.0, RED), (1.0, BLUE)][::order]:
            fill_triangles(triangle(near), light, color, 1.0, False, image, depth)
        assert image[6, 1, :3].tolist() == [1.0, 0.0, 0.0]
        assert image[1, 6, 3] == 0.0


def test_a_translucent_triangle_tints():
    image, depth = canvas()
    fill_triangles(triangle(1.0), np.ones((1, 3)), BLUE, 1.0, False, image, depth)
    fill_triangles(triangle(2.0), np.ones((1, 3)), RED, 0.25, False, image, depth)
    assert image[6, 1].tolist() == [0.25, 0.0, 0.75, 1.0]


def test_what_is_turned_away_is_seen_only_if_asked_for():
    away = triangle(1.0)[:, ::-1].copy()
    for both in (False, True):
        image, depth = canvas()
        fill_triangles(away, np.ones((1, 3)), RED, 1.0, both, image, depth)
        assert bool(image.any()) is both


def test_a_stroke_is_hidden_by_what_is_before_it():
    image, depth = canvas()
    fill_triangles(triangle(2.0), np.ones((1, 3)), BLUE, 1.0, False, image, depth)
    ends = np.array([[[0.0, 6.5, 1.0], [8.0, 6.5, 1.0]]])
    stroke(ends, 0.6, RED, 1.0, image, depth)
    assert image[6, 1, :3].tolist() == [0.0, 0.0, 1.0]
    assert image[6, 7, 0] == 1.0
