"""Compiling ahead: what a plan needs late is compiled by a second process while the first one is
still busy with what it needs early."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager

#: A module whose functions a plan needs late.
_LATE = "dualarm_repro.planning.field.gift_wrapping"


@contextmanager
def compiling_ahead() -> Iterator[None]:
    """:func:`rehearse` in a process of its own, where nothing is compiled yet and there is a second
    core; it ends with the block. What goes wrong there only costs time."""
    other = _rehearsal() if _is_due() else None
    try:
        yield
    finally:
        if other is not None:
            other.terminate()
            other.wait()


def _is_due() -> bool:
    from ..machine_code import is_kept

    return (os.cpu_count() or 1) > 1 and is_kept(_LATE) is False


def _rehearsal() -> subprocess.Popen[bytes] | None:
    path = os.pathsep.join(entry for entry in sys.path if entry)
    command = [sys.executable, "-c", f"from {__name__} import rehearse; rehearse()"]
    nothing = subprocess.DEVNULL
    try:
        return subprocess.Popen(
            command,
            env={**os.environ, "PYTHONPATH": path},
            stdin=nothing,
            stdout=nothing,
            stderr=nothing,
        )
    except OSError:
        return None


def rehearse() -> None:
    """Wrap a hull, smooth a path and draw a picture, of anything: the types are those of a plan."""
    import numpy as np

    from ..planning.field.hull_obstacle import hull_track
    from ..planning.search.splice import smoothed
    from ..view.scenes.raster import fill_triangles, stroke

    corners = np.stack(np.meshgrid([0.0, 1.0], [0.0, 1.0], [0.0, 1.0]), axis=-1).reshape(1, 8, 3)
    hull_track(corners)
    smoothed(np.zeros((5, 2)), 1.0, 1.0)
    image, depth, color = np.zeros((2, 2, 4)), np.zeros((2, 2)), (0.0, 0.0, 0.0)
    fill_triangles(corners[:, :3], np.ones((1, 3)), color, 1.0, False, image, depth)
    stroke(corners[:, :2], 1.0, color, 1.0, image, depth)
