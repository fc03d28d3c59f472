"""The still picture of a scene: it stands for it until it is turned, on paper and without WebGL."""

from __future__ import annotations

from base64 import b64encode
from io import BytesIO

import numpy as np

from .camera import Camera
from .contents import Contents, Part
from .floor import Floor
from .raster import fill_triangles, stroke
from .surfaces import surface

#: Size of the picture [pixels], and how many times larger it is drawn.
SIZE, _TIMES = (960, 540), 2
_GRID = (0.52, 0.55, 0.59)
_CONTACT = "#D00000"
_RULER = "#D55E00"
#: Light from the upper left, before the camera, in its axes right, up, forward.
_LAMP = np.array([-0.45, 0.70, -0.55])


def still(
    contents: Contents, camera: Camera, floor: Floor | None, frame: int | None, ghosts: list[int]
) -> str:
    """A picture with transparent ground as a data URI (WebP).

    Parameters
    ----------
    frame
        Key frame that is shown; None for a scene without motion.
    ghosts
        Further key frames, whose arms are drawn faintly.
    """
    width, height = SIZE[0] * _TIMES, SIZE[1] * _TIMES
    image, depth = np.zeros((height, width, 4)), np.zeros((height, width))
    canvas = _Canvas(camera, image, depth)
    found = contents.nearest
    hit = found.contacts[frame or 0] if found else set()
    solid = [part for part in contents.parts if part.opacity >= 1.0]
    for part in solid:
        canvas.part(part, contents.pose(part.node, frame), touching=part.body in hit)
    if floor:
        canvas.strokes(floor.lines(), 0.6, _GRID, 0.75)
    if found and np.isfinite(found.distance[frame or 0]):
        canvas.strokes(found.ends[frame or 0][np.newaxis], 2.0, _rgb(_RULER), 1.0)
    for at in ghosts:
        for part in solid:
            if contents.motion and part.node in contents.motion.poses:
                canvas.part(part, contents.pose(part.node, at), opacity=0.13)
    clear = [part for part in contents.parts if part.opacity < 1.0]
    eye = camera.eye
    clear.sort(key=lambda p: -np.linalg.norm(contents.pose(p.node, frame)[:3, 3] - eye))
    for part in clear:
        canvas.part(part, contents.pose(part.node, frame))
    return _encoded(image)


class _Canvas:
    def __init__(self, camera: Camera, image: np.ndarray, depth: np.ndarray) -> None:
        self._camera, self._image, self._depth = camera, image, depth

    def part(
        self, part: Part, pose: np.ndarray, opacity: float | None = None, touching: bool = False
    ) -> None:
        shown = part.opacity if opacity is None else opacity
        color = _rgb(_CONTACT if touching else part.color)
        if part.vertices is not None and part.kind in ("points", "line"):
            points = part.vertices @ pose[:3, :3].T + pose[:3, 3]
            if part.kind == "line":
                self.strokes(np.stack([points[:-1], points[1:]], axis=1), 1.7, color, shown)
            else:
                self.strokes(np.stack([points, points], axis=1), 1.1, color, 0.8 * shown)
            return
        made = surface(part)
        vertices = made.vertices @ pose[:3, :3].T + pose[:3, 3]
        normals = made.normals @ pose[:3, :3].T @ self._camera.axes.T
        lamp = _LAMP / np.linalg.norm(_LAMP)
        light = 0.50 + 0.42 * np.clip(normals @ lamp, 0.0, None) + 0.18 * np.abs(normals[:, 2])
        corners = self._pixels(vertices)[made.faces]
        both = part.kind == "mesh" and (shown >= 1.0 or part.opacity < 1.0)
        fill_triangles(corners, light[made.faces], color, shown, both, self._image, self._depth)

    def strokes(self, ends: np.ndarray, half: float, color: tuple, opacity: float) -> None:
        """Draw segments (S, 2, 3) of the world."""
        if len(ends):
            pixels = self._pixels(np.asarray(ends, dtype=float))
            stroke(pixels, half * _TIMES, color, opacity, self._image, self._depth)

    def _pixels(self, points: np.ndarray) -> np.ndarray:
        seen = self._camera.project(points)
        height, width = self._depth.shape
        x, y = 0.5 * (seen[..., 0] + 1.0) * width, 0.5 * (1.0 - seen[..., 1]) * height
        return np.stack([x, y, 1.0 / seen[..., 2]], axis=-1)


def _encoded(image: np.ndarray) -> str:
    from PIL import Image

    height, width = SIZE[1], SIZE[0]
    small = image.reshape(height, _TIMES, width, _TIMES, 4).mean(axis=(1, 3))
    alpha = small[..., 3:]
    small[..., :3] /= np.where(alpha > 0.0, alpha, 1.0)
    pixels = (255.0 * np.clip(small, 0.0, 1.0)).round().astype(np.uint8)
    buffer = BytesIO()
    Image.fromarray(pixels, "RGBA").save(buffer, "WEBP", quality=82, method=4)
    return "data:image/webp;base64," + b64encode(buffer.getvalue()).decode()


def _rgb(color: str) -> tuple[float, float, float]:
    red, green, blue = (int(color[k : k + 2], 16) / 255 for k in (1, 3, 5))
    return red, green, blue
