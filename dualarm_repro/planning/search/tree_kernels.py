"""Two trees that grow towards each other, and the shortening of what joins them, compiled.

RRT-Connect: J. J. Kuffner and S. M. LaValle, ICRA 2000. Shortcuts: R. Geraerts and M. H. Overmars,
Creating high-quality paths for motion planning, Int. J. Robotics Research 26(8), 2007. Every edge
is certified by :func:`...scene.edge_kernels.edge_free`.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...copies import copy_row
from ...kernel import kernel
from ...scene.edge_kernels import edge_buffers, edge_free

MET, SPENT, MORE = 0, 1, 2


class Trees(NamedTuple):
    """Nodes (2, M, nq) of the trees of start and goal, their parents (2, M), and in ``counts`` how
    many each tree has, which of them grows next, and configurations that were looked at."""

    nodes: np.ndarray
    parent: np.ndarray
    counts: np.ndarray


@kernel
def search(model, trees, samples, places, step, margin, most, patience):
    """From the nodes 0 of both trees: a free path between them, shortened.

    Parameters
    ----------
    samples : (S, nq)
        Configurations to grow towards [rad, m].
    places : (P, 2)
        Shares 0 ... 1 of the length, see :func:`shortened`.
    step : float
        Longest edge of a tree [rad].
    most : (2,)
        Configurations that may be looked at before the trees meet, and in all.

    Returns
    -------
    outcome, path (N, nq)
        MET and the path; SPENT, or MORE where only the samples are used up, and the start.
    """
    buffers = edge_buffers(model)
    start, goal, count = trees.nodes[0, 0], trees.nodes[1, 0], trees.counts
    if count[3] == 0:
        for n in range(2):
            end = trees.nodes[n, 0]
            free, looked = edge_free(model, end, end, margin, False, buffers)
            count[3] += looked
            if not free:
                return SPENT, trees.nodes[0, :1].copy()
        free, looked = edge_free(model, start, goal, margin, True, buffers)
        count[3] += looked
        if free:
            path = np.empty((2, len(start)))
            copy_row(start, path[0])
            copy_row(goal, path[1])
            return MET, path
    outcome, a, b = grow(model, trees, samples, step, margin, most[0], buffers)
    if outcome != MET:
        return outcome, trees.nodes[0, :1].copy()
    path = joined(trees, a, b)
    return MET, shortened(model, path, places, margin, most[1], patience, count, buffers)


@kernel
def grow(model, trees, samples, step, margin, most, buffers):
    """Grow both trees by samples (S, nq) until they meet.

    Parameters
    ----------
    step : float
        Longest edge of a tree [rad].
    most : int
        Configurations that may be looked at.

    Returns
    -------
    outcome, a, b
        MET and the nodes of the first and second tree that coincide; SPENT; MORE where the samples
        are used up.
    """
    count, reached = trees.counts, np.empty(samples.shape[1])
    for n in range(len(samples)):
        target = samples[n]
        if count[3] >= most or max(count[0], count[1]) >= trees.nodes.shape[1] - 1:
            return SPENT, 0, 0
        side = count[2]
        count[2] = 1 - side
        first = _extended(model, trees, side, target, step, margin, buffers)
        if first < 0:
            continue
        copy_row(trees.nodes[side, first], reached)
        while count[3] < most and count[1 - side] < trees.nodes.shape[1] - 1:
            second = _extended(model, trees, 1 - side, reached, step, margin, buffers)
            if second < 0:
                break
            if _square(trees.nodes[1 - side, second], reached) == 0.0:
                return (MET, first, second) if side == 0 else (MET, second, first)
    return MORE, 0, 0


@kernel
def _extended(model, trees, side, target, step, margin, buffers):
    """The new node of a tree on the way to ``target``, at most a step away; -1 if it is barred."""
    nodes, count = trees.nodes[side], trees.counts
    near, least = 0, np.inf
    for n in range(count[side]):
        square = _square(nodes[n], target)
        if square < least:
            near, least = n, square
    way, new = least**0.5, nodes[count[side]]
    if way == 0.0:
        return near
    copy_row(target, new)
    if way > step:
        for j in range(len(new)):
            new[j] = nodes[near, j] + step / way * (target[j] - nodes[near, j])
    free, looked = edge_free(model, nodes[near], new, margin, True, buffers)
    count[3] += looked
    if not free:
        return -1
    trees.parent[side, count[side]] = near
    count[side] += 1
    return count[side] - 1


@kernel
def _square(a, b):
    total = 0.0
    for j in range(len(a)):
        total += (a[j] - b[j]) ** 2
    return total


@kernel
def joined(trees, a, b):
    """The way from the start by node ``a`` and node ``b`` to the goal (N, nq)."""
    before, after = 1, 0
    n = a
    while trees.parent[0, n] >= 0:
        n, before = trees.parent[0, n], before + 1
    n = b
    while trees.parent[1, n] >= 0:
        n, after = trees.parent[1, n], after + 1
    path = np.empty((before + after, trees.nodes.shape[2]))
    n = a
    for row in range(before - 1, -1, -1):
        copy_row(trees.nodes[0, n], path[row])
        n = trees.parent[0, n]
    n = b
    for row in range(before, before + after):
        n = trees.parent[1, n]
        copy_row(trees.nodes[1, n], path[row])
    return path


@kernel
def shortened(model, path, places, margin, most, patience, count, buffers):
    """A path without the detours that straight edges between two of its points save.

    Rows are left out from the far end first; then pairs of ``places`` (S, 2), shares 0 ... 1 of the
    length, are joined where that is free, until ``patience`` of them in turn have saved nothing.
    """
    rows = np.empty((len(path) + 2 * len(places) + 2, path.shape[1]))
    size = 0
    at = 0
    copy_row(path[0], rows[0])
    while at < len(path) - 1:
        ahead = len(path) - 1
        while ahead > at + 1:
            free = False
            if count[3] < most:
                free, more = edge_free(model, path[at], path[ahead], margin, True, buffers)
                count[3] += more
            if free:
                break
            ahead = at + 1 + (ahead - at - 1) // 2 if count[3] < most else at + 1
        at, size = ahead, size + 1
        copy_row(path[at], rows[size])
    size += 1
    new, fruitless = np.empty((2, path.shape[1])), 0
    for n in range(len(places)):
        if size < 3 or count[3] >= most or fruitless >= patience:
            break
        length = 0.0
        for k in range(size - 1):
            length += _square(rows[k], rows[k + 1]) ** 0.5
        low, high = min(places[n, 0], places[n, 1]), max(places[n, 0], places[n, 1])
        first = _point(rows, size, low * length, new[0])
        last = _point(rows, size, high * length, new[1])
        fruitless += 1
        if last <= first:
            continue
        before = _along(rows, first, last, new)
        direct = _square(new[0], new[1]) ** 0.5
        if direct > before * (1.0 - 1e-3):
            continue
        free, more = edge_free(model, new[0], new[1], margin, True, buffers)
        count[3] += more
        if not free:
            continue
        fruitless = 0
        size = _replaced(rows, size, first, last, new)
    return rows[:size].copy()


@kernel
def _point(rows, size, way, out):
    """The point of a path that lies ``way`` from its start into ``out``; returns the row before."""
    for k in range(size - 1):
        length = _square(rows[k], rows[k + 1]) ** 0.5
        if way <= length or k == size - 2:
            share = min(way / length, 1.0) if length > 0.0 else 0.0
            for j in range(len(out)):
                out[j] = rows[k, j] + share * (rows[k + 1, j] - rows[k, j])
            return k
        way -= length
    return size - 2


@kernel
def _along(rows, first, last, new):
    """Length of a path from ``new[0]`` after row ``first`` to ``new[1]`` after row ``last``."""
    length = _square(new[0], rows[first + 1]) ** 0.5 + _square(rows[last], new[1]) ** 0.5
    for k in range(first + 1, last):
        length += _square(rows[k], rows[k + 1]) ** 0.5
    return length


@kernel
def _replaced(rows, size, first, last, new):
    """Put the two points of ``new`` in the place of the rows between them; returns the new size."""
    shift = first + 3 - (last + 1)
    if shift > 0:
        for k in range(size - 1, last, -1):
            copy_row(rows[k], rows[k + shift])
    elif shift < 0:
        for k in range(last + 1, size):
            copy_row(rows[k], rows[k + shift])
    copy_row(new[0], rows[first + 1])
    copy_row(new[1], rows[first + 2])
    return size + shift
