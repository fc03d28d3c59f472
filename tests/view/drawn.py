"""Reads back what stands in a figure: curves by name, texts, and whether the axes hold the data."""

import numpy as np


def curves(ax):
    """Points (N, 2) of every named line."""
    named = [line for line in ax.lines if not str(line.get_label()).startswith("_")]
    return {line.get_label(): np.column_stack(line.get_data()).astype(float) for line in named}


def in_space(ax):
    """Points (N, 3) of every line of 3-D axes, in the order in which they were drawn."""
    return [np.column_stack([np.asarray(v, dtype=float) for v in line.get_data_3d()])
            for line in ax.lines]  # fmt: skip


def words(ax):
    """Texts that are not empty."""
    return [text.get_text() for text in ax.texts if text.get_text()]


def outside(ax):
    """Points of curves in plane axes that their limits leave out; lines across all are none."""
    low, high = np.sort([ax.get_xlim(), ax.get_ylim()], axis=1).T
    slack = 1e-9 * (high - low)
    found = []
    for line in ax.lines:
        if not all(line.get_transform().contains_branch_seperately(ax.transData)):
            continue
        points = np.column_stack(line.get_data()).astype(float)
        points = points[np.isfinite(points).all(axis=1)]
        beyond = (points < low - slack) | (points > high + slack)
        found += points[beyond.any(axis=1)].tolist()
    return found
