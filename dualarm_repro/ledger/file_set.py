"""Several files that belong together: all of them appear, or none."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

from ..errors import OutputError
from ..interruption import uninterrupted
from .files import write_text


def write_together(folder: Path, make: Callable[[Path], Sequence[Path]]) -> list[Path]:
    """Call ``make`` with a folder beside ``folder`` and move the files when all are written.

    Parameters
    ----------
    folder
        Where the files belong; made if needed.
    make
        Writes files below the folder that it is given and returns their paths.

    Returns
    -------
    list of Path
        The files at their place, in the order of ``make``.

    Raises
    ------
    OutputError
        The folder or a file cannot be written.
    """
    beside = folder if folder.is_dir() else folder.parent
    try:
        beside.mkdir(parents=True, exist_ok=True)
        with TemporaryDirectory(dir=beside, prefix=f".{folder.name}.") as place:
            staged = Path(place)
            names = [path.relative_to(staged) for path in make(staged)]
            move_together(staged, folder, names)
    except OutputError as error:  # names the temporary folder
        raise OutputError(folder, error.field, error.value, error.expected) from None
    except OSError as error:
        expected = "a folder that can be written"
        raise OutputError(folder, "output", error.strerror, expected) from None
    return [folder / name for name in names]


def write_texts(folder: Path, texts: Mapping[str, str]) -> list[Path]:
    """Write texts by the names of their files, together.

    Raises
    ------
    OutputError
        The folder or a file cannot be written.
    """
    return write_together(
        folder, lambda staged: [write_text(staged / name, text) for name, text in texts.items()]
    )


def move_together(staged: Path, folder: Path, names: Sequence[Path]) -> None:
    """Move files to their places; if one cannot be moved, all is as before.

    Parameters
    ----------
    names
        Paths of the files below both folders.

    Raises
    ------
    OSError
        One cannot be moved.
    """
    places = [folder / name for name in names]
    before = {place: place.read_bytes() if place.is_file() else None for place in places}
    folders = [f for place in places for f in reversed(place.parents) if not f.exists()]
    moved: list[Path] = []
    with uninterrupted():  # while files get their names
        try:
            for name, place in zip(names, places, strict=True):
                place.parent.mkdir(parents=True, exist_ok=True)
                (staged / name).replace(place)
                moved.append(place)
        except OSError:
            for place in moved:
                content = before[place]
                if content is None:
                    place.unlink(missing_ok=True)
                else:
                    place.write_bytes(content)
            for made in reversed(list(dict.fromkeys(folders))):
                if made.is_dir():
                    made.rmdir()
            raise
