"""Compiling ahead: the kinematics of the arms, and what a plan needs late, are compiled by a second
process while the first one is still busy with what it needs before."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from shutil import rmtree
from tempfile import mkdtemp
from threading import Thread

from ..interruption import uninterrupted

#: Modules of the package whose functions are compiled ahead; the first one tells if that was done.
_AHEAD = (
    "planning.field.gift_wrapping",
    "planning.search.splice",
    "view.scenes.raster",
    "arms.codegen.generated",
)

#: Begins the name of the folder in which the second process keeps what it compiles.
_APART = ".ahead-"


@contextmanager
def compiling_ahead(tasks: Path) -> Iterator[None]:
    """:func:`rehearse` in a process of its own, where nothing is compiled yet and there is a second
    core; it ends with the block. What goes wrong there only costs time."""
    folder: Path | None = None
    other: subprocess.Popen[bytes] | None = None
    try:
        with uninterrupted():
            if folder := _place():
                other = _rehearsal(folder, tasks)
        yield
    finally:
        with uninterrupted():
            if other is not None:
                other.kill()  # it may be deaf to any other signal, or stopped
                other.communicate()
            if folder is not None:
                rmtree(folder, ignore_errors=True)


def _place() -> Path | None:
    """A folder for the machine code of the second process; None where it would be of no use."""
    from ..machine_code import compiled_folder, is_kept

    kept = compiled_folder()
    if _cores() < 2 or kept is None or is_kept(_modules()[0]):
        return None
    try:
        kept.mkdir(parents=True, exist_ok=True)
        return Path(mkdtemp(prefix=_APART, dir=kept))
    except OSError:  # where nothing can be kept
        return None


def _cores() -> int:
    """Cores that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def _modules() -> list[str]:
    root = __name__.partition(".")[0]
    return [f"{root}.{name}" for name in _AHEAD]


def _rehearsal(folder: Path, tasks: Path) -> subprocess.Popen[bytes] | None:
    path = os.pathsep.join(str(entry) for entry in sys.path if entry)
    # There is almost no garbage, and looking for it would cost a tenth of the time.
    code = (
        f"import gc, sys; gc.disable(); from {__name__} import end_with_the_first, rehearse; "
        "end_with_the_first(); rehearse(sys.argv[1])"
    )
    # -P: nothing of the folder that the user is in is imported.
    command = [sys.executable, "-P", "-c", code, str(tasks)]
    nothing = subprocess.DEVNULL
    try:
        return subprocess.Popen(
            command,
            env={**os.environ, "PYTHONPATH": path, "NUMBA_CACHE_DIR": str(folder)},
            stdin=subprocess.PIPE,
            stdout=nothing,
            stderr=nothing,
        )
    except (OSError, TypeError):  # no further process, or no interpreter of its own
        return None


def end_with_the_first() -> None:
    """Let this process end when its standard input does, a pipe from the first one, however that
    ends; what it keeps apart goes as well."""

    def watch() -> None:
        os.read(0, 1)
        if folder := _own_folder():
            rmtree(folder, ignore_errors=True)
        os._exit(0)

    Thread(target=watch, daemon=True).start()


def rehearse(tasks: str) -> None:
    """Move the arms of a file of tasks, then wrap a hull, smooth a path and draw a picture, of
    anything: the types are those of a plan.

    The machine code is kept in a folder of its own, and handed over in the order of need.
    """
    import numpy as np

    from ..planning.field.hull_obstacle import hull_track
    from ..planning.search.splice import smoothed
    from ..view.scenes.raster import fill_triangles, stroke

    with suppress(Exception):  # of a file with a fault, which the first process tells
        _move_arms(Path(tasks))
    corners = np.stack(np.meshgrid([0.0, 1.0], [0.0, 1.0], [0.0, 1.0]), axis=-1).reshape(1, 8, 3)
    hull_track(corners)
    _publish()
    smoothed(np.zeros((5, 2)), 1.0, 1.0)
    _publish()
    image, depth, color = np.zeros((2, 2, 4)), np.zeros((2, 2)), (0.0, 0.0, 0.0)
    fill_triangles(corners[:, :3], np.ones((1, 3)), color, 1.0, False, image, depth)
    stroke(corners[:, :2], 1.0, color, 1.0, image, depth)
    _publish()


def _move_arms(tasks: Path) -> None:
    """First those that are to reach a position, whose posture is found by its Jacobian."""
    import numpy as np

    from ..planning.tasks.task_file import arms_and_ends

    arms = sorted(arms_and_ends(tasks), key=lambda one: not one[1])
    for arm, is_sent_to_a_position in arms:
        arm.positions(np.zeros(arm.nq))
        _publish()
        if is_sent_to_a_position:
            arm.jacobian(np.zeros(arm.nq))
            _publish()


def _publish() -> None:
    """Hand over the machine code of functions of which there is none where all is kept."""
    made = _own_folder()
    if made is None:
        return
    for name in _modules():
        for index in (made / name).glob("*/*.nbi"):
            place = made.parent / index.parent.relative_to(made)
            with suppress(OSError):  # there is machine code already
                place.mkdir(parents=True, exist_ok=True)
                # An index after all that it names, so that it is whole at once.
                for part in (*index.parent.glob(f"{index.stem}.*.nbc"), index):
                    os.link(part, place / part.name)


def _own_folder() -> Path | None:
    """Where this process keeps machine code apart; None if it does not."""
    made = Path(os.environ.get("NUMBA_CACHE_DIR", ""))
    return made if made.name.startswith(_APART) else None
