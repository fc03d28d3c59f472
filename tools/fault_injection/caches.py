"""What is kept between two commands goes bad: records, tables, machine code, notebooks."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from pathlib import Path

from .calls import Place, called
from .jobs import FORWARD, OUT, PRERUN, SHOW, STUDY
from .laboratory import Laboratory, Trial, each_damage, ordinary

#: File endings of machine code: its index and itself.
_INDEX, _CODE = "*.nbi", "*.nbc"


def records(lab: Laboratory) -> Iterator[Trial]:
    """Records and the import graph of a cache: a bad one is a miss."""
    lab.undisturbed(SHOW)
    for pattern in ("records/*.json", "sources.json"):
        for way, place in _with_cache(lab, lab.warm(), pattern):
            yield Trial("damaged record", f"{pattern}, {way}", lab.survives(SHOW, place))


def machine_code(lab: Laboratory) -> Iterator[Trial]:
    """Machine code of a cache and its index: compiled again."""
    lab.undisturbed(FORWARD)
    filled = lab.scratch / "compiled"
    called(FORWARD.command, lab.place(cache=filled))
    for pattern in (_INDEX, _CODE):
        for way, place in _with_cache(lab, filled, f"compiled/**/{pattern}"):
            name = f"{pattern.removeprefix('*')}, {way}"
            yield Trial("damaged machine code", name, lab.survives(FORWARD, place))


def tables(lab: Laboratory) -> Iterator[Trial]:
    """Table and record of a stored study: seen, and computed again."""
    stored = lab.undisturbed(STUDY).folder
    told = (*STUDY.command, "status")

    def prepared() -> Place:
        place = lab.place(prefix=ordinary() or ())
        shutil.copytree(stored, place.folder, dirs_exist_ok=True)
        return place

    for pattern in ("tiny.parquet", "tiny.json"):
        for way, place in each_damage(lab, lambda f, p=pattern: list((f / OUT).glob(p)), prepared):
            status = called(told, place)
            wrong = "" if status.code == 0 and "up to date" not in status.out else "not noticed"
            if path := next((p for p in (place.folder / OUT).glob(pattern) if p.is_dir()), None):
                path.rmdir()  # nobody can replace a folder by a file
            yield Trial("damaged table", f"{pattern}, {way}", wrong or lab.survives(STUDY, place))


def notebooks(lab: Laboratory) -> Iterator[Trial]:
    """The cache of executed notebooks: its register and its notebooks."""
    lab.undisturbed(PRERUN)

    def prepared() -> Place:
        place = lab.place(prefix=ordinary() or ())
        called(PRERUN.command, place)
        shutil.rmtree(place.folder / OUT)
        return place

    for pattern in ("global.db", "*.ipynb", "pages.json"):
        for way, place in each_damage(lab, lambda f, p=pattern: list(_below(f, p)), prepared):
            name = f"{pattern}, {way}"
            yield Trial("damaged notebook cache", name, lab.survives(PRERUN, place))


def _below(folder: Path, pattern: str) -> Iterator[Path]:
    return (folder / "_build" / ".jupyter_cache").rglob(pattern)


def _with_cache(lab: Laboratory, filled: Path, pattern: str) -> Iterator[tuple[str, Place]]:
    """Places with copies of a cache, as far as it is damaged, whose files have gone bad."""
    above = pattern.partition("/")[0]

    def prepared() -> Place:
        place = lab.place(prefix=ordinary() or ())
        own = place.folder / "cache"
        own.mkdir()
        for source in {filled / name for name in (above, "records", "sources.json")}:
            if source.is_dir():
                shutil.copytree(source, own / source.name)
            elif source.is_file():
                shutil.copy2(source, own / source.name)
        return Place(place.folder, own, prefix=place.prefix)

    yield from each_damage(lab, lambda folder: sorted((folder / "cache").glob(pattern)), prepared)
