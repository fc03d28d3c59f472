"""An axis of a drawing: values to pixels, and round ticks."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np


@dataclass(frozen=True)
class Axis:
    """Values ``low`` ... ``high`` lie at the pixels ``start`` ... ``end`` of the drawing."""

    label: str
    low: float
    high: float
    start: float
    end: float

    def at(self, value: float) -> float:
        """Pixel of a value, to a tenth."""
        share = (value - self.low) / (self.high - self.low)
        return round(float(self.start + share * (self.end - self.start)), 1)

    @property
    def ticks(self) -> list[tuple[float, str]]:
        """Pixel and text of each tick."""
        from matplotlib.ticker import MaxNLocator

        values: Any = MaxNLocator(nbins=6, steps=[1, 2, 2.5, 5, 10]).tick_values(
            self.low, self.high
        )
        slack = 1e-9 * (self.high - self.low)
        inside = values[(values >= self.low - slack) & (values <= self.high + slack)]
        step = float(inside[1] - inside[0]) if len(inside) > 1 else 1.0
        digits = max(0, int(np.ceil(-np.log10(step) - 1e-9)))
        if digits and abs(step * 10**digits - round(step * 10**digits)) > 1e-6:
            digits += 1
        return [(self.at(v), f"{v + 0.0:.{digits}f}".replace("-", "−")) for v in inside]
