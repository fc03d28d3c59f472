"""HTML of a scene: the still picture with its names, and what the viewer needs to move it."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from markupsafe import Markup

from ..assets import ASSETS
from ..static_meshcat import viewer_script
from .camera import Camera
from .contents import Contents
from .floor import Floor
from .packed import packed
from .still import SIZE, still

#: Half the width of a letter and the height of a line of a name, in per cent of the picture.
_LETTER, _LINE = 0.5, 4.6
_FIGURE = Markup(
    '<figure class="ledger-scene" data-moves="{moves}"><div class="scene-box">'
    '<img class="scene-still" alt="{title}" width="{width}" height="{height}" src="{picture}">'
    '<div class="scene-marks" aria-hidden="true">{marks}</div></div>'
    '<script type="application/json" class="scene-data">{data}</script>'
    "<figcaption>{title} {told}</figcaption></figure>"
)
_MARK = Markup('<span style="left:{:.1f}%;top:{:.1f}%">{}</span>')
_ALONE = Markup(
    '<!DOCTYPE html><html lang="en"><head><meta charset="utf-8"><title>{title}</title>'
    '<meta name="viewport" content="width=device-width"><style>{style}</style></head>'
    '<body class="scene-alone">{figure}<script>{viewer}</script><script>{script}</script>'
    "</body></html>"
)


def figure(contents: Contents, camera: Camera, floor: Floor | None) -> Markup:
    """The scene for a page that loads its script and style, see :mod:`..assets`."""
    frame = shown_frame(contents)
    ghosts = [] if contents.motion is None else [0, len(contents.motion.frames) - 1]
    picture = still(contents, camera, floor, frame, [g for g in ghosts if g != frame])
    return _FIGURE.format(
        moves="yes" if contents.motion else "no",
        title=contents.title,
        width=SIZE[0],
        height=SIZE[1],
        picture=picture,
        marks=Markup("").join(_marks(contents, camera, frame)),
        data=Markup(packed(contents, camera, floor)),
        told=_told(contents, frame, floor),
    )


def alone(title: str, body: Markup) -> Markup:
    """One file with the scene, viewer, script and style, that needs nothing else."""
    code = viewer_script().read_text(encoding="utf-8").replace("</script", "<\\/script")
    return _ALONE.format(
        title=title,
        style=Markup((ASSETS / "scene.css").read_text(encoding="utf-8")),
        figure=body,
        viewer=Markup(code),
        script=Markup((ASSETS / "scene.js").read_text(encoding="utf-8")),
    )


def shown_frame(contents: Contents) -> int | None:
    """Key frame of the still picture: where bodies are closest, else the middle of the motion."""
    if contents.motion is None:
        return None
    if contents.nearest is not None:
        return int(np.argmin(contents.nearest.distance))
    return len(contents.motion.frames) // 2


def _marks(contents: Contents, camera: Camera, frame: int | None) -> Iterator[Markup]:
    """Names at their places in per cent; one that would cover another stands lower."""
    taken: list[tuple[float, float, float]] = []
    for mark in contents.marks:
        pose = contents.pose(mark.node, frame)
        x, y, _ = camera.project(pose[:3, :3] @ mark.point + pose[:3, 3])
        left, top = 50.0 * (1.0 + float(x)), 50.0 * (1.0 - float(y))
        half = _LETTER * (len(mark.text) + 1)
        while any(abs(left - a) < half + b and abs(top - c) < _LINE for a, b, c in taken):
            top += 0.5 * _LINE
        taken.append((left, half, top))
        yield _MARK.format(left, top, mark.text)


def _told(contents: Contents, frame: int | None, floor: Floor | None) -> str:
    """What the still picture shows, in words."""
    told = []
    found = contents.nearest
    if contents.motion is not None and frame is not None:
        frames = contents.motion.frames
        when = f"Shown: step {frames[frame]} of {frames[-1]}"
        told.append(f"{when}, where {found.what} are closest" if found else when)
    if found is not None:
        at = frame or 0
        value, (one, other) = 1e3 * found.distance[at], found.names[at]
        digits = 0 if abs(value) >= 10.0 else 1
        gap = f"{one} and {other} are {value:.{digits}f} mm apart"
        inside = f"{one} and {other} overlap by {-value:.{digits}f} mm"
        told.append(gap if value > 0.0 else inside)
    text = ": ".join(told)
    text = f"{text[0].upper()}{text[1:]}. " if text else ""
    if contents.motion is not None:
        text += "Faint: first and last posture. "
    text += f"{contents.note} " if contents.note else ""
    if contents.columns:
        text += "Grey columns: the height of the bases is not known. "
    return text + (f"Cells of the floor: {floor.cell:g} m." if floor else "")
