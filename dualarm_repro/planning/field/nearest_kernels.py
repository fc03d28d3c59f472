"""Which shape is nearest to each control point, and in which direction, compiled.

Plain arrays as arguments: passing a tuple of arrays to an inner function would cost more than the
distances themselves.
"""

from __future__ import annotations

import numpy as np

from ...kernel import kernel
from ...scene.boxes import segment_box
from ...scene.points import point_box, point_capsule
from ...scene.segments import segment_segment
from ...scene.vectors import (
    along,
    dot,
    into_frame,
    minus,
    out_of_frame,
    rotated,
    rotated_back,
    scaled,
    vector,
)


@kernel
def nearest_shapes(
    joint, local, radius, frames, cores, core_radius, boxes, half, planes, group, distance, shape
):
    """Distance (K, G) of every control point to every obstacle, and which of its shapes attains it.

    Parameters
    ----------
    joint, local, radius
        See :class:`.control_points.ControlPoints`; ``frames`` (nq + 1, 3, 4) of base and joints.
    cores, core_radius, boxes, half, planes, group
        See :class:`.obstacles.Obstacles`, at one step.
    """
    distance[:] = np.inf
    round_shapes, flat_faced = len(core_radius), len(core_radius) + len(half)
    for k in range(len(joint)):
        a, u = core(local[k], frames[joint[k]])
        is_point = dot(u, u) == 0.0
        for m in range(len(group)):
            if m < round_shapes:
                b = vector(cores[m, 0])
                v = minus(vector(cores[m, 1]), b)
                if is_point:
                    d = point_capsule(a, b, v, core_radius[m])[0]
                else:
                    d = segment_segment(a, u, b, v)[0] - core_radius[m]
            elif m < flat_faced:
                pose, h = boxes[m - round_shapes], vector(half[m - round_shapes])
                if is_point:
                    d = point_box(a, pose, h)[0]
                else:
                    d = segment_box(into_frame(pose, a), rotated_back(pose, u), h)[0]
            else:
                plane = planes[m - flat_faced]
                d = dot(vector(plane), _lowest(a, u, plane)) - plane[3]
            if d - radius[k] < distance[k, group[m]]:
                distance[k, group[m]] = d - radius[k]
                shape[k, group[m]] = m


@kernel
def witness(local, frame, cores, core_radius, boxes, half, planes, number):
    """Point of one control point nearest to shape ``number``, and the direction away from that."""
    a, u = core(local, frame)
    is_point = dot(u, u) == 0.0
    if number < len(core_radius):
        b = vector(cores[number, 0])
        v = minus(vector(cores[number, 1]), b)
        if is_point:
            return a, point_capsule(a, b, v, core_radius[number])[1]
        _, p, _, normal = segment_segment(a, u, b, v)
        return p, scaled(-1.0, normal)
    number -= len(core_radius)
    if number < len(half):
        pose, h = boxes[number], vector(half[number])
        if is_point:
            return a, point_box(a, pose, h)[1]
        _, p, _, normal = segment_box(into_frame(pose, a), rotated_back(pose, u), h)
        return out_of_frame(pose, p), rotated(pose, scaled(-1.0, normal))
    plane = planes[number - len(half)]
    return _lowest(a, u, plane), vector(plane)


@kernel
def core(local, frame):
    """Start of a core in the world and the vector to its end."""
    a = out_of_frame(frame, vector(local[0]))
    return a, minus(out_of_frame(frame, vector(local[1])), a)


@kernel
def _lowest(a, u, plane):
    """Point of a core nearest to a half-space; of a core parallel to it, the middle."""
    climb = dot(vector(plane), u)
    return along(a, 1.0 if climb < 0.0 else 0.0 if climb > 0.0 else 0.5, u)
