"""Names stand at what they name and apart from each other; lengths at a window; dark paper."""

import re
from io import BytesIO
from itertools import combinations

import matplotlib.pyplot as plt
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualarm_repro.ledger.finding import entitled, finding_of
from dualarm_repro.scene import Box
from dualarm_repro.view.card import figure_html
from dualarm_repro.view.labels import _apart, name_ends, name_points, push_apart
from dualarm_repro.view.legibility import faults
from dualarm_repro.view.style import BLUE, ORANGE, WIDTH, house_style, ink
from dualarm_repro.view.theme import lean, with_dark_rules
from dualarm_repro.view.window import nearest_to_boxes, opening


@pytest.fixture
def ax():
    with house_style():
        figure, axes = plt.subplots(figsize=(WIDTH, 3))
        axes.set(xlabel="time [s]", ylabel="distance [m]", xlim=(0, 1), ylim=(0, 1))
        yield axes
    plt.close(figure)


def test_names_of_curves_that_end_together_are_apart_and_in_order(ax):
    for height in (0.50, 0.52, 0.49, 0.02):
        ax.plot([0, 1], [0, height], label=f"ends at {height}")
    name_ends(ax)
    assert faults(ax.figure) == []
    names = {text.get_text(): text.get_position()[1] for text in ax.texts}
    assert names["ends at 0.49"] < names["ends at 0.5"] < names["ends at 0.52"]
    assert names["ends at 0.02"] == pytest.approx(0.02)


def test_names_of_near_points_are_apart_and_within_the_axes(ax):
    points = {f"point {k}": np.array([0.97, 0.5 + 0.01 * k]) for k in range(5)}
    name_points(ax, points)
    ax.figure.draw_without_rendering()
    assert faults(ax.figure) == []
    for text in ax.texts:
        assert text.get_window_extent().x1 <= ax.bbox.x1 + 1


def _window(turn):
    """Bars around an opening of 1.0 by 0.8 m about (0, 0.3, 0.5)."""
    long, short = (0.05, 0.6, 0.05), (0.05, 0.05, 0.4)
    places = (((0, 0.3, 0.95), long), ((0, 0.3, 0.05), long),
              ((0, -0.25, 0.5), short), ((0, 0.85, 0.5), short))  # fmt: skip
    return [Box(np.array(c), 2 * np.array(half), turn) for c, half in places]


def test_opening_of_a_window():
    low, high = opening(_window(np.eye(3)))
    np.testing.assert_allclose(low, (-0.2, 0.1), atol=1e-12)
    np.testing.assert_allclose(high, (0.8, 0.9), atol=1e-12)
    c, s = np.cos(0.3), np.sin(0.3)
    assert opening(_window(np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]))) is None
    assert opening(_window(np.eye(3))[:3]) is None


def test_way_to_the_nearest_box():
    track = np.array([[-1.0, 0.3, 0.5], [0.0, 0.5, 0.5], [1.0, 0.3, 0.5]])
    point, on_box = nearest_to_boxes(track, _window(np.eye(3)))
    np.testing.assert_allclose(point, track[1])
    np.testing.assert_allclose(on_box, (0.0, 0.8, 0.5), atol=1e-12)


def test_letters_are_dark_enough_on_white():
    for color in (BLUE, ORANGE):
        linear = [(int(ink(color)[k : k + 2], 16) / 255) ** 2.2 for k in (1, 3, 5)]
        luminance = np.dot((0.2126, 0.7152, 0.0722), linear)
        assert 1.05 / (luminance + 0.05) >= 4.5


@pytest.mark.parametrize(
    ("caption", "title", "rest"),
    [
        ("It holds. The rest follows.", "It holds", "The rest follows."),
        ("As in Fig. 9 it holds at 0.5 m. More.", "As in Fig. 9 it holds at 0.5 m", "More."),
        ("One sentence only", "One sentence only", ""),
        ("It is 3.5 m. (17) says so.", "It is 3.5 m", "(17) says so."),
    ],
)
def test_finding_is_the_first_sentence(caption, title, rest):
    assert finding_of(caption) == (title, rest)


def test_a_file_carries_the_finding(ax):
    ax.plot([0, 1], [0, 1], label="a curve")
    ax.set_aspect("equal")
    ax.figure.legend(loc="outside upper left")
    entitled(ax.figure, "The curve rises in all cases. The rest follows.")
    assert [text.get_text() for text in ax.figure.texts] == ["The curve rises in all cases"]
    assert faults(ax.figure) == []
    places = []

    def look(event):
        (legend,), (title,) = ax.figure.legends, ax.figure.texts
        places.append(title.get_window_extent().y0 - legend.get_window_extent().y1)

    ax.figure.canvas.mpl_connect("draw_event", look)
    ax.figure.savefig(BytesIO(), bbox_inches="tight")
    assert places[-1] > 0


def test_drawing_in_a_page_has_title_text_and_dark_rules(ax):
    ax.plot([0, 1], [0, 1], color=BLUE)
    html = figure_html(ax.figure, "a line", "It rises. By one <m>.")
    assert '<p class="ledger-finding">It rises</p>' in html
    assert "<figcaption>By one &lt;m&gt;.</figcaption>" in html
    assert "<figcaption>" not in figure_html(plt.figure(), "nothing", "It rises.")


def test_lean_drawing_keeps_every_outline():
    svg = b'<path d="M 1.23456 7.891 L 10 0.5" transform="scale(0.12345)"/>'
    assert lean(svg) == b'<path d="M 1.23 7.89 L 10 0.5" transform="scale(0.12345)"/>'


def test_dark_rules_reach_the_colours_that_are_drawn(ax):
    ax.plot([0, 1], [0, 1], color=BLUE)
    ax.plot([0, 1], [1, 0], color="0.25")
    buffer = BytesIO()
    ax.figure.savefig(buffer, format="svg")
    svg = with_dark_rules(buffer.getvalue()).decode()
    rules = svg.split("<style", 1)[1].split("</style>", 1)[0]
    for selector in ("stroke: #0072b2", "stroke: #404040", "fill: #ffffff"):
        assert selector in svg.split("</style>", 1)[1]
        assert re.search(rf'\[style\*="{selector}"\]{{[^}}]*!important}}', rules)
    assert rules.startswith(' type="text/css">@media (prefers-color-scheme: dark)')


@pytest.mark.parametrize(
    ("heights", "at"),
    [([0.2, 0.4, 0.8], 0.8), ([0.2, 0.7, 5.0], 0.7), ([0.2, 0.6, np.nan], 0.6),
     ([0.9, 0.3, -2.0], 0.3), ([3.0, 4.0, 5.0], 1.0)],
)  # fmt: skip
def test_a_name_stands_at_the_last_point_that_is_seen(ax, heights, at):
    ax.plot([0.0, 0.5, 1.0], heights, label="curve")
    ax.set(xlim=(0, 1), ylim=(0, 1))
    name_ends(ax)
    (text,) = ax.texts
    assert text.get_position()[1] == pytest.approx(at)
    assert text.get_position()[0] > 1.0, "beyond the axes"


def test_a_name_at_a_logarithmic_axis_stands_where_its_curve_ends(ax):
    ax.plot([0, 1], [1.0, 100.0], label="curve", color=ORANGE)
    ax.plot([0, 1], [1.0, 10.0], label="_unnamed")
    ax.set(yscale="log", ylim=(1.0, 1e4))
    name_ends(ax)
    (text,) = ax.texts
    assert text.get_position()[1] == pytest.approx(0.5)
    assert text.get_color() == ink(ORANGE)


HEIGHTS = st.lists(st.floats(0.3, 0.7), min_size=1, max_size=8)


@settings(max_examples=50)
@given(HEIGHTS, st.lists(st.sampled_from([0.02, 0.04]), min_size=8, max_size=8))
def test_heights_of_names_are_apart_in_order_and_inside(wanted, rows):
    """Eight names of at most 0.04 that end in the middle have room to both sides."""
    sizes = np.array(rows[: len(wanted)])
    found = _apart(np.array(wanted), sizes)
    order = np.argsort(wanted, kind="stable")
    gaps = np.diff(found[order])
    need = 0.5 * (sizes[order][1:] + sizes[order][:-1])
    assert (gaps >= need - 1e-4).all()
    assert found.min() >= -1e-9
    assert found.max() <= 1.0 + 1e-9
    if len(wanted) == 1:
        assert found[0] == wanted[0]


@pytest.mark.parametrize("names", [2, 6])
def test_names_move_and_what_they_name_does_not(ax, names):
    points = {f"name {k}": np.array([0.5, 0.5 + 0.002 * k]) for k in range(names)}
    texts = name_points(ax, points)
    for text, point in zip(texts, points.values(), strict=True):
        np.testing.assert_array_equal(text.xy, point)
    boxes = [plt.Text.get_window_extent(text) for text in texts]
    assert not any(a.overlaps(b) for a, b in combinations(boxes, 2))
    ends = [ax.transData.transform(point) for point in points.values()]
    assert not any(box.contains(*end) for box in boxes for end in ends)


def test_names_that_do_not_meet_stay(ax):
    points = {"left": np.array([0.2, 0.5]), "right": np.array([0.8, 0.5])}
    assert [text.xyann for text in name_points(ax, points, offset=(0, 14))] == [
        pytest.approx((0, 14)), pytest.approx((0, 14))]  # fmt: skip
    push_apart(ax.figure, [])
