"""House style of the figures: one width, letters of 8 pt or more, colours for every eye.

Matplotlib is imported when something is drawn with it: a 3-D scene needs only the colours.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from typing import TYPE_CHECKING, Any, TypedDict, Unpack

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from matplotlib.typing import RcKeyType

#: Okabe and Ito's palette, which stays distinct under the common kinds of colour-blindness.
BLUE, ORANGE, GREEN, RED, PURPLE, SKY, YELLOW, BLACK = (
    "#0072B2", "#E69F00", "#009E73", "#D55E00", "#CC79A7", "#56B4E9", "#F0E442", "#000000",
)  # fmt: skip
PALETTE = (BLUE, ORANGE, GREEN, RED, PURPLE, SKY, BLACK)
MASTER, SLAVE = BLUE, RED
#: The palette as letters, dark enough to be read on white (contrast 4.5 and more).
_INKS = {
    ORANGE: "#8F6200", GREEN: "#007556", RED: "#B34E00", PURPLE: "#A0437A", SKY: "#1F6F9F",
    YELLOW: "#7A7000",
}  # fmt: skip
#: Ink on a coloured ground, which stays as it is on dark paper, see ``theme``.
FIXED_BLACK, FIXED_WHITE = "#010101", "#FEFEFE"
#: Width of the column of text in which a figure is shown [CSS px], and as inches of a figure.
PAGE_PX = 720
WIDTH = PAGE_PX / 96
#: Free around a figure in a page [in].
PAD = 0.05
#: Smallest letters [pt], at the width of the page.
SMALL = 8.0

_SETTINGS: dict[RcKeyType, Any] = {
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.titlesize": 9.5,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "axes.labelsize": 9.5,
    "axes3d.xaxis.panecolor": (0.95, 0.95, 0.95, 0.5),
    "axes3d.yaxis.panecolor": (0.95, 0.95, 0.95, 0.5),
    "axes3d.zaxis.panecolor": (0.95, 0.95, 0.95, 0.5),
    "figure.constrained_layout.use": True,
    "figure.dpi": 100,
    "figure.facecolor": "white",
    "font.size": 9.5,
    "grid.alpha": 0.3,
    "legend.fontsize": 9,
    "legend.frameon": False,
    "lines.solid_capstyle": "round",
    "savefig.facecolor": "white",
    "svg.fonttype": "path",
    "xtick.labelsize": 8.5,
    "ytick.labelsize": 8.5,
}


def ink(color: Any) -> Any:
    """The colour of letters that name what is drawn in a colour of the palette."""
    return _INKS.get(str(color).upper(), color)


class View(TypedDict, total=False):
    """Where a 3-D drawing is seen from: elevation and azimuth [deg]."""

    elev: float
    azim: float


_VIEW: View = {"elev": 22, "azim": -60}
_TICKS = 5  # along the longest side of a 3-D drawing


@contextmanager
def house_style() -> Iterator[None]:
    """Draw figures inside this context."""
    import matplotlib as mpl

    with mpl.rc_context(_settings()):
        yield


@cache
def _settings() -> dict[RcKeyType, Any]:
    from matplotlib.rcsetup import cycler

    return {"axes.prop_cycle": cycler(color=PALETTE), **_SETTINGS}


def axes_3d(
    width: float = 6.4, height: float = 5.2, columns: int = 1, **view: Unpack[View]
) -> tuple[Figure, Any]:
    """Figure with one or several 3-D axes labelled x, y, z in metres.

    ``view`` goes to ``Axes3D.view_init``.
    """
    import matplotlib.pyplot as plt

    figure = plt.figure(figsize=(width, height))
    axes = [figure.add_subplot(1, columns, k + 1, projection="3d") for k in range(columns)]
    for ax in axes:
        name_axes(ax)
        ax.view_init(**(_VIEW | view))
    return figure, axes[0] if columns == 1 else axes


def name_axes(ax: Any) -> None:
    """Name the axes of a 3-D drawing, in metres."""
    ax.set(xlabel="x [m]", ylabel="y [m]", zlabel="z [m]")


def same_scale(ax: Any, zoom: float = 1.0, stretch: float = 1.0) -> None:
    """One scale for the three axes of a 3-D drawing, with as many ticks as a side has room for.

    Parameters
    ----------
    zoom
        More than 1 fills the frame better.
    stretch
        How much larger z is drawn than x and y.
    """
    from matplotlib.ticker import MaxNLocator

    sides = [abs(high - low) for low, high in (ax.get_xlim(), ax.get_ylim(), ax.get_zlim())]
    drawn = [sides[0], sides[1], stretch * sides[2]]
    ax.set_box_aspect(drawn, zoom=zoom)
    for axis, side in zip((ax.xaxis, ax.yaxis, ax.zaxis), drawn, strict=True):
        share = side / max(drawn)
        count = 1 if share < 0.12 else max(2, round(_TICKS * share))
        axis.set_major_locator(MaxNLocator(count))
        axis.set_tick_params(pad=0)
        axis.labelpad = 2
