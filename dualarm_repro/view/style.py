"""House style of the figures: colours that survive colour-blindness, opaque paper in dark mode."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, TypedDict, Unpack

import matplotlib as mpl
import matplotlib.pyplot as plt
from matplotlib.rcsetup import cycler

if TYPE_CHECKING:
    from matplotlib.typing import RcKeyType

#: Okabe and Ito's palette, which stays distinct under the common kinds of colour-blindness.
BLUE, ORANGE, GREEN, RED, PURPLE, SKY, YELLOW, BLACK = (
    "#0072B2", "#E69F00", "#009E73", "#D55E00", "#CC79A7", "#56B4E9", "#F0E442", "#000000",
)  # fmt: skip
PALETTE = (BLUE, ORANGE, GREEN, RED, PURPLE, SKY, BLACK)
MASTER, SLAVE = BLUE, RED

_SETTINGS: dict[RcKeyType, Any] = {
    "axes.prop_cycle": cycler(color=PALETTE),
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.titlesize": "medium",
    "figure.constrained_layout.use": True,
    "figure.dpi": 100,
    "figure.facecolor": "white",
    "font.size": 10,
    "grid.alpha": 0.3,
    "legend.frameon": False,
    "savefig.facecolor": "white",
    "svg.fonttype": "path",
}


class View(TypedDict, total=False):
    """Where a 3-D drawing is seen from: elevation and azimuth [deg]."""

    elev: float
    azim: float


_VIEW: View = {"elev": 22, "azim": -60}


@contextmanager
def house_style() -> Iterator[None]:
    """Draw figures inside this context."""
    with mpl.rc_context(_SETTINGS):
        yield


def axes_3d(
    width: float = 6.4, height: float = 5.2, columns: int = 1, **view: Unpack[View]
) -> tuple[mpl.figure.Figure, Any]:
    """Figure with one or several 3-D axes labelled x, y, z in metres.

    ``view`` goes to ``Axes3D.view_init``.
    """
    figure = plt.figure(figsize=(width, height))
    axes = [figure.add_subplot(1, columns, k + 1, projection="3d") for k in range(columns)]
    for ax in axes:
        ax.set(xlabel="x [m]", ylabel="y [m]", zlabel="z [m]")
        ax.locator_params(nbins=5)
        ax.view_init(**(_VIEW | view))
    return figure, axes[0] if columns == 1 else axes
