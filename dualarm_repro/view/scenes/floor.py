"""The grid on the floor: round cells, as wide as the action."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

_CELLS = (0.05, 0.1, 0.2, 0.25, 0.5, 1.0, 2.0)


@dataclass(frozen=True)
class Floor:
    """A square grid.

    Attributes
    ----------
    height : float
        [m]
    cell : float
        Edge of a cell [m].
    low, high : (float, float)
        Corners, multiples of the cell [m].
    """

    height: float
    cell: float
    low: tuple[float, float]
    high: tuple[float, float]

    @classmethod
    def under(cls, points: np.ndarray, height: float) -> Floor:
        """The grid under points (N, 3) with eight cells or so from side to side."""
        low, high = points[:, :2].min(axis=0), points[:, :2].max(axis=0)
        wanted = float((high - low).max()) / 8.0
        cell = min(_CELLS, key=lambda one: abs(np.log(one / max(wanted, 1e-3))))
        first, last = np.floor(low / cell) * cell, np.ceil(high / cell) * cell
        return cls(height, cell, (first[0], first[1]), (last[0], last[1]))

    def lines(self) -> np.ndarray:
        """Segments (S, 2, 3) [m], each no longer than a cell."""
        x = np.arange(round(self.low[0] / self.cell), round(self.high[0] / self.cell) + 1)
        y = np.arange(round(self.low[1] / self.cell), round(self.high[1] / self.cell) + 1)
        along = [((a, b), (a + 1, b)) for a in x[:-1] for b in y]
        across = [((a, b), (a, b + 1)) for a in x for b in y[:-1]]
        flat = self.cell * np.array(along + across, dtype=float).reshape(-1, 2, 2)
        return np.concatenate([flat, np.full((*flat.shape[:2], 1), self.height)], axis=2)
