"""The arithmetic of one generation, compiled; every random number is drawn by the caller."""

from __future__ import annotations

import numpy as np

from ..kernel import kernel

_FEW = 128  # individuals up to which sorting by insertion is the fastest


@kernel
def sorted_by_value(individuals, values):
    """Individuals (P, n) and values (P,) in falling order; equal ones stay in order."""
    count = len(values)
    order = np.empty(count, np.int64)
    if count > _FEW:
        order[:] = np.argsort(-values, kind="mergesort")
    else:
        for i in range(count):
            j = i
            while j > 0 and values[order[j - 1]] < values[i]:
                order[j] = order[j - 1]
                j -= 1
            order[j] = i
    first, second = np.empty_like(individuals), np.empty_like(values)
    for i in range(count):
        second[i] = values[order[i]]
        for c in range(individuals.shape[1]):
            first[i, c] = individuals[order[i], c]
    return first, second


@kernel
def ranked(individuals, values):
    """Both in falling order of the values, how many of these are positive, and the mean distance
    of two individuals."""
    first, second = sorted_by_value(individuals, values)
    feasible = 0
    while feasible < len(second) and second[feasible] > 0.0:
        feasible += 1
    return first, second, feasible, mean_distance(first)


@kernel
def mean_distance(points):
    """Mean distance of two of the points (P, n)."""
    count, size = points.shape
    across, square, total = points.T.copy(), np.empty(count), np.zeros(count)
    for i in range(1, count):
        for j in range(i):
            square[j] = 0.0
        for c in range(size):
            at = across[c, i]
            for j in range(i):
                square[j] += (across[c, j] - at) * (across[c, j] - at)
        for j in range(i):
            total[j] += np.sqrt(square[j])
    return total.sum() / (0.5 * count * (count - 1))


@kernel
def pointed_at(wheel, start, count):
    """Slot of a wheel of rising shares at each of ``count`` equally spaced pointers (count,)."""
    chosen, slot = np.empty(count, np.int64), 0
    for k in range(count):
        pointer = min((k + start) / count, wheel[-1])
        while wheel[slot] < pointer:
            slot += 1
        chosen[k] = slot
    return chosen


@kernel
def next_generation(individuals, wheel, start, order, draws, noise, left, low, high, gaussian):
    """The children :func:`bred` by the parents that pointers from ``start`` on choose, taken in the
    ``order`` (K,), with a step of ``left`` of the box."""
    slots = pointed_at(wheel, start, len(order))
    chosen, step = np.empty(len(order), np.int64), np.empty(len(low))
    for k in range(len(order)):
        chosen[k] = slots[order[k]]
    for c in range(len(low)):
        step[c] = left * (high[c] - low[c])
    return bred(individuals, chosen, draws, noise, step, low, high, gaussian)


@kernel
def bred(individuals, chosen, draws, noise, step, low, high, gaussian):
    """The next generation (P, n): the first pass on, pairs of parents are crossed, the others move.

    Parameters
    ----------
    chosen : (2 C + M,)
        Rows of the parents.
    draws : (C, n)
        Below one half a coordinate is that of the first C parents, else that of the next C.
    noise, step : (M, n), (n,)
        The last M parents are shifted by ``noise * step`` where ``gaussian``, else they go ``step``
        in the direction of the noise, as far as the box ``low``, ``high`` allows.
    """
    count, size = individuals.shape
    pairs, mutants = len(draws), len(noise)
    elite = count - pairs - mutants
    children, parents = np.empty_like(individuals), np.empty((mutants, size))
    for i in range(elite):
        for c in range(size):
            children[i, c] = individuals[i, c]
    for i in range(pairs):
        first, second = chosen[i], chosen[pairs + i]
        for c in range(size):
            parent = first if draws[i, c] < 0.5 else second
            children[elite + i, c] = individuals[parent, c]
    for i in range(mutants):
        for c in range(size):
            parents[i, c] = individuals[chosen[2 * pairs + i], c]
    moved = children[elite + pairs :]
    if gaussian:
        shifted(parents, noise, step, low, high, moved)
    else:
        stepped(parents, noise, step, low, high, moved)
    return children


@kernel
def shifted(parents, noise, deviation, low, high, children):
    """Parents with noise of a deviation per coordinate, kept inside the box."""
    for i in range(len(parents)):
        for c in range(len(low)):
            moved = parents[i, c] + deviation[c] * noise[i, c]
            children[i, c] = min(max(moved, low[c]), high[c])


@kernel
def stepped(parents, noise, step, low, high, children):
    """Parents moved by ``step`` (n,) in the direction of the noise, as far as the box allows."""
    size = len(low)
    direction = np.empty(size)
    for i in range(len(parents)):
        square, inside = 0.0, 1.0
        for c in range(size):
            square += noise[i, c] * noise[i, c]
        for c in range(size):
            direction[c] = step[c] * noise[i, c] / np.sqrt(square)
            ahead = high[c] - parents[i, c] if direction[c] > 0 else parents[i, c] - low[c]
            inside = min(inside, ahead / max(abs(direction[c]), 1e-300))
        for c in range(size):
            moved = parents[i, c] + inside * direction[c]
            children[i, c] = min(max(moved, low[c]), high[c])
