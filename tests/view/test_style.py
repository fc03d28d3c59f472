"""House style: colours for every eye, contrast on light and on dark paper, one scale in space."""

import re
from itertools import combinations, pairwise

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.colors import to_rgb

from dualarm_repro.view import style, theme
from dualarm_repro.view.style import PALETTE, axes_3d, house_style, ink, same_scale

#: Simulation of full protanopia and deuteranopia in linear RGB: G. M. Machado, M. M. Oliveira,
#: L. A. F. Fernandes, A physiologically-based model for simulation of color vision
#: deficiency, 2009.
EYES = {
    "usual": np.eye(3),
    "protanopia": np.array([[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216],
                            [-0.003882, -0.048116, 1.051998]]),
    "deuteranopia": np.array([[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413],
                              [-0.011820, 0.042940, 0.968881]]),
}  # fmt: skip


def linear(color):
    share = np.array(to_rgb(color))
    return np.where(share <= 0.04045, share / 12.92, ((share + 0.055) / 1.055) ** 2.4)


def contrast(one, other):
    """Contrast ratio of WCAG 2."""
    light, dark = sorted((linear(c) @ (0.2126, 0.7152, 0.0722) for c in (one, other)), reverse=True)
    return (light + 0.05) / (dark + 0.05)


def lab(color, eye):
    """CIE L*a*b* of a colour as an eye sees it."""
    seen = (EYES[eye] @ linear(color)).clip(0.0, 1.0)
    xyz = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]])
    x, y, z = np.cbrt(np.maximum(xyz @ seen / (0.9505, 1.0, 1.089), 1e-6))
    return np.array([116 * y - 16, 500 * (x - y), 200 * (y - z)])


@pytest.mark.parametrize("color", [*PALETTE, style.YELLOW])
def test_letters_in_a_colour_can_be_read_on_white(color):
    assert contrast(ink(color), "white") >= 4.5


@pytest.mark.parametrize("eye", EYES)
def test_colours_are_told_apart_by_every_eye(eye):
    """A difference of 10 in L*a*b* is several times what can just be seen."""
    for one, other in combinations(PALETTE, 2):
        assert np.linalg.norm(lab(one, eye) - lab(other, eye)) > 10.0, (one, other)


def test_a_colour_without_an_ink_keeps_its_own():
    assert ink("#123456") == "#123456"
    assert ink(style.ORANGE.lower()) == ink(style.ORANGE) != style.ORANGE


def rules():
    """Light to dark of what is filled, as the rules of a drawing say."""
    svg = theme.with_dark_rules(b"<svg><defs></defs></svg>").decode()
    return dict(re.findall(r'\[style\*="fill: (#\w+)"\]\{fill:(#\w+)!important\}', svg))


def test_lines_and_letters_can_be_read_on_dark_paper():
    dark = rules()
    paper = dark["#ffffff"]
    for color in PALETTE:
        assert contrast(dark[color.lower()], paper) >= 4.5
        assert contrast(dark[str(ink(color)).lower()], paper) >= 4.5


def test_inks_turn_into_the_colour_of_their_curve():
    dark = rules()
    for color in (style.ORANGE, style.GREEN, style.RED, style.PURPLE, style.SKY):
        assert dark[ink(color).lower()] == dark[color.lower()]


def test_greys_keep_their_order_on_dark_paper():
    dark = rules()
    greys = sorted(
        (linear(light)[0], linear(new) @ (0.2126, 0.7152, 0.0722))
        for light, new in dark.items()
        if light not in ("#b0b0b0",) and len(set(re.findall("..", light[1:]))) == 1
    )
    assert len(greys) >= 20
    assert all(a[1] > b[1] for a, b in pairwise(greys)), "dark ink turns light"


def test_rules_stand_once_before_the_definitions():
    svg = theme.with_dark_rules(b"<svg><defs>x</defs><defs>y</defs></svg>")
    assert svg.count(b"<style") == 1
    assert svg.index(b"<style") < svg.index(b"<defs>")
    assert svg.endswith(b"</style><defs>x</defs><defs>y</defs></svg>")


def test_ink_on_a_coloured_ground_stays():
    dark = rules()
    assert style.FIXED_BLACK.lower() not in dark
    assert style.FIXED_WHITE.lower() not in dark
    assert contrast(style.FIXED_BLACK, "white") > 20.0


@pytest.mark.parametrize(
    ("light", "lean"),
    [(b' d="M 1.239 0.5"', b' d="M 1.23 0.5"'), (b' d="M -0.001 12"', b' d="M -0.00 12"'),
     (b' id="a1.2345"', b' id="a1.2345"')],
)  # fmt: skip
def test_only_outlines_are_shortened(light, lean):
    assert theme.lean(light) == lean


def test_the_style_ends_with_its_context():
    before = mpl.rcParams["font.size"], mpl.rcParams["axes.titlelocation"]
    with house_style():
        assert mpl.rcParams["axes.titlelocation"] == "left"
        assert mpl.rcParams["axes.prop_cycle"].by_key()["color"] == list(PALETTE)
        assert (
            min(mpl.rcParams[k] for k in ("font.size", "legend.fontsize", "xtick.labelsize")) >= 8
        )
        assert mpl.rcParams["savefig.facecolor"] == "white"
    assert (mpl.rcParams["font.size"], mpl.rcParams["axes.titlelocation"]) == before


@pytest.mark.parametrize("stretch", [1.0, 4.0])
def test_sides_of_a_drawing_in_space_have_one_scale(stretch):
    with house_style():
        figure, ax = axes_3d(elev=30, azim=20)
    ax.set(xlim=(0.0, 2.0), ylim=(1.0, -0.0), zlim=(0.0, 0.1))
    same_scale(ax, stretch=stretch)
    box = np.array(ax._box_aspect)
    np.testing.assert_allclose(box / box[0], [1.0, 0.5, 0.05 * stretch])
    assert (ax.elev, ax.azim) == (30, 20)
    assert (ax.get_xlabel(), ax.get_ylabel(), ax.get_zlabel()) == ("x [m]", "y [m]", "z [m]")
    ticks = [len(axis.get_major_locator()()) for axis in (ax.xaxis, ax.yaxis, ax.zaxis)]
    assert ticks[0] >= ticks[1] >= ticks[2]
    plt.close(figure)


def test_several_axes_stand_side_by_side():
    _, axes = axes_3d(columns=3)
    places = [ax.get_position().x0 for ax in axes]
    assert len(axes) == 3
    assert places == sorted(places)
    assert {(ax.elev, ax.azim) for ax in axes} == {(22, -60)}
