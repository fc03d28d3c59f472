"""Triangles and strokes on a picture with a depth buffer."""

import numpy as np

from ...kernel import kernel


@kernel
def fill_triangles(corners, shade, color, opacity, both, image, depth):
    """Paint triangles in place.

    ``corners`` (T, 3, 3) hold x and y in pixels and 1/depth, which is linear on the picture;
    ``shade`` (T, 3) is the light at the corners; ``image`` (H, W, 4) is premultiplied;
    ``both``: triangles turned away are seen as well. What is translucent is painted on top
    and hides nothing.
    """
    height, width = depth.shape
    for t in range(len(corners)):
        a, b, c = corners[t, 0], corners[t, 1], corners[t, 2]
        area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        turned = area > 0.0 and not both
        if turned or area == 0.0 or min(a[2], b[2], c[2]) <= 0.0:
            continue
        left = max(0, int(np.floor(min(a[0], b[0], c[0]))))
        right = min(width - 1, int(np.ceil(max(a[0], b[0], c[0]))))
        top = max(0, int(np.floor(min(a[1], b[1], c[1]))))
        bottom = min(height - 1, int(np.ceil(max(a[1], b[1], c[1]))))
        for row in range(top, bottom + 1):
            y = row + 0.5
            for column in range(left, right + 1):
                x = column + 0.5
                u = ((x - a[0]) * (c[1] - a[1]) - (y - a[1]) * (c[0] - a[0])) / area
                v = ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) / area
                w = 1.0 - u - v
                if u < 0.0 or v < 0.0 or w < 0.0:
                    continue
                near = w * a[2] + u * b[2] + v * c[2]
                if near <= depth[row, column]:
                    continue
                light = w * shade[t, 0] + u * shade[t, 1] + v * shade[t, 2]
                if opacity >= 1.0:
                    depth[row, column] = near
                for k in range(3):
                    tone = min(1.0, color[k] * light)
                    image[row, column, k] = opacity * tone + (1.0 - opacity) * image[row, column, k]
                image[row, column, 3] = opacity + (1.0 - opacity) * image[row, column, 3]


@kernel
def stroke(ends, half, color, opacity, image, depth):
    """Draw segments (S, 2, 3), given as ``corners`` above, ``half`` pixels to either side."""
    height, width = depth.shape
    for s in range(len(ends)):
        a, b = ends[s, 0], ends[s, 1]
        if min(a[2], b[2]) <= 0.0:
            continue
        dx, dy = b[0] - a[0], b[1] - a[1]
        square = dx * dx + dy * dy
        left = max(0, int(min(a[0], b[0]) - half))
        right = min(width - 1, int(max(a[0], b[0]) + half) + 1)
        top = max(0, int(min(a[1], b[1]) - half))
        bottom = min(height - 1, int(max(a[1], b[1]) + half) + 1)
        for row in range(top, bottom + 1):
            for column in range(left, right + 1):
                x, y = column + 0.5 - a[0], row + 0.5 - a[1]
                along = 0.0
                if square > 0.0:
                    along = min(1.0, max(0.0, (x * dx + y * dy) / square))
                x, y = x - along * dx, y - along * dy
                if x * x + y * y > half * half:
                    continue
                near = a[2] + along * (b[2] - a[2])
                if near * 1.002 <= depth[row, column]:
                    continue
                if opacity >= 1.0:
                    depth[row, column] = max(near, depth[row, column])
                for k in range(3):
                    image[row, column, k] = (
                        opacity * color[k] + (1.0 - opacity) * image[row, column, k]
                    )
                image[row, column, 3] = opacity + (1.0 - opacity) * image[row, column, 3]
