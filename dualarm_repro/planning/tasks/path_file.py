"""Paths of arms from CSV files, one's own or somebody else's: a row a sample, linear in between.

A column ``step``, ``index`` or ``time`` is the common index (without one: the number of the row).
The joints of an arm are ``ARM.q1``, ``ARM.q2`` ...; in the file of one arm plain ``q1`` ..., the
arm being that of the name of the file, ``ARM.csv`` or ``NAME_ARM.csv``. Other columns are left
alone.
"""

from __future__ import annotations

from collections.abc import Iterable
from io import BytesIO
from pathlib import Path

import numpy as np
import pandas as pd

from ...errors import DataFileError, InputError
from ...input_files import contents, path_of
from ...scene import JointPath, PlacedArm, Scene

_INDEX = ("step", "index", "time")
#: Largest file [bytes].
LARGEST_FILE = 200_000_000
#: Farthest of a joint beyond its limits, and of a continuous joint from 0 [rad, m]: what is farther
#: is no path of an arm but another unit or a broken file.
BEYOND, TURNED = 2.0 * np.pi, 200.0 * np.pi
#: Longest way of one arm, its farthest joints added up [rad]: half an hour at full speed. The work
#: of a certificate grows with it.
LONGEST_WAY = 10_000.0


def read_paths(scene: Scene, files: Iterable[str | Path]) -> dict[str, JointPath]:
    """Paths of some arms of a scene.

    Raises
    ------
    DataFileError
        A file that is missing, no table of finite numbers, or has not all joints of an arm; an arm
        that two files name; joints far beyond their limits, or a way beyond :data:`LONGEST_WAY`.
    """
    found: dict[str, JointPath] = {}
    if not isinstance(files, Iterable) or isinstance(files, str | bytes):
        raise InputError("read_paths", "files", files, "paths of CSV files")
    for name in files:
        for arm, path in _read(scene, path_of("read_paths", "files", name)).items():
            if arm in found:
                raise DataFileError(name, arm, "a second path", "one path of each arm")
            found[arm] = path
    return found


def _read(scene: Scene, file: Path) -> dict[str, JointPath]:
    table = _table(file)
    index = next((table[name].to_numpy() for name in _INDEX if name in table), None)
    found = {}
    for placed in scene.arms:
        named = [f"{placed.name}.q{k + 1}" for k in range(placed.arm.nq)]
        if not any(name in table for name in named):
            if not _is_of(scene, placed, file):
                continue
            named = [f"q{k + 1}" for k in range(placed.arm.nq)]
        joints = np.column_stack([_numbers(file, table, name) for name in named])
        extra = f"{named[-1].rpartition('q')[0]}q{placed.arm.nq + 1}"
        if extra in table:
            expected = f"{placed.arm.nq} joints of {placed.name}"
            raise DataFileError(file, "column", extra, expected)
        _require_sane(file, placed, named, joints)
        try:
            found[placed.name] = JointPath(joints, index)
        except InputError as error:
            raise DataFileError(file, error.field, error.value, error.expected) from None
    if not found:
        arms = ", ".join(scene.columns)
        expected = f"columns ARM.q1 ... of one of {arms}, or q1 ... in a file named NAME_ARM.csv"
        raise DataFileError(file, "columns", list(table.columns), expected)
    return found


def _require_sane(file: Path, placed: PlacedArm, named: list[str], joints: np.ndarray) -> None:
    """Refuse joints that no arm reaches, and ways that nobody waits for."""
    for_ever = placed.arm.turns_for_ever
    low = np.where(for_ever, -TURNED, placed.arm.lower - BEYOND)
    high = np.where(for_ever, TURNED, placed.arm.upper + BEYOND)
    for row, joint in np.argwhere((joints < low) | (joints > high))[:1]:
        unit = "m" if placed.arm.slides[joint] else "rad"
        expected = f"a joint within {low[joint]:.4g} ... {high[joint]:.4g} {unit}"
        raise DataFileError(file, f"{named[joint]}, row {row + 1}", joints[row, joint], expected)
    way = float(np.abs(np.diff(joints, axis=0)).max(axis=1, initial=0.0).sum())
    if way > LONGEST_WAY:
        expected = f"at most {LONGEST_WAY:g} rad"
        raise DataFileError(file, f"way of {placed.name}", f"{way:.4g} rad", expected)


def _is_of(scene: Scene, placed: PlacedArm, file: Path) -> bool:
    """Whether a file with plain joint columns is that of an arm."""
    named = [one.name for one in scene.arms if f"_{file.stem}".endswith(f"_{one.name}")]
    if named:
        return placed.name == max(named, key=len)
    return len(scene.arms) == 1


def _table(file: Path) -> pd.DataFrame:
    written = contents(file, "a readable CSV file", LARGEST_FILE)
    try:
        table = pd.read_csv(BytesIO(written), comment="#", skipinitialspace=True)
    except (ValueError, pd.errors.ParserError) as error:
        raise DataFileError(file, "content", str(error), "a CSV table with a header") from None
    if not len(table):
        raise DataFileError(file, "rows", 0, "at least one row")
    for name in _INDEX:
        if name in table:
            _numbers(file, table, name)
    return table


def _numbers(file: Path, table: pd.DataFrame, name: str) -> np.ndarray:
    if name not in table:
        raise DataFileError(file, "column", name, f"a column of that name beside {list(table)}")
    values = pd.to_numeric(table[name], errors="coerce").to_numpy(dtype=float)
    bad = np.flatnonzero(~np.isfinite(values))
    if bad.size:
        raise DataFileError(file, f"{name}, row {bad[0] + 1}", table[name].iloc[bad[0]], "a number")
    return values
