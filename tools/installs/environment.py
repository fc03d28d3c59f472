"""An environment that holds the wheel and what it asks for, and knows nothing of the clone."""

from __future__ import annotations

import math
import os
import resource
import shutil
import signal
import subprocess
import sys
from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path

from .rows import HIGHEST, LOCK, LOCKED, LOWEST, Row

#: Seconds of computing that an installation or one question may take, and by how much more of the
#: clock a busy machine may stretch them.
TIMEOUT = 900
_BUSY = 8
_RESOLUTION = {LOWEST: "lowest-direct", HIGHEST: "highest"}


class InstallFailed(Exception):
    """A command ended with an error: ``step`` names it, the message holds its last line."""

    def __init__(self, step: str, message: str) -> None:
        super().__init__(step, message)
        self.step, self.message = step, message


def interpreter(python: str) -> Path | None:
    """A Python of that version on the path, or among those of pyenv; none where it does not run."""
    folder = Path(os.environ.get("PYENV_ROOT", Path.home() / ".pyenv")) / "versions"
    beside = sorted(folder.glob(f"{python}.*/bin/python{python}"))
    named = shutil.which(f"python{python}")
    for path in (Path(sys.executable), *([Path(named)] if named else []), *beside):
        ask = "import sys, ssl; print('%d.%d' % sys.version_info[:2])"
        told = subprocess.run([path, "-c", ask], capture_output=True, text=True, check=False)
        if told.returncode == 0 and told.stdout.strip() == python:
            return path
    return None


def build_wheel(root: Path, folder: Path) -> Path:
    """A wheel of the clone, in a folder.

    Raises
    ------
    InstallFailed
        The build failed.
    """
    command = [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", folder]
    run("build", command, root, os.environ)
    return next(folder.glob("*.whl"))


def install(
    row: Row, uv: Path, wheel: Path, root: Path, folder: Path, timeout: float = TIMEOUT
) -> Path:
    """Make the environment of a row; its Python.

    Raises
    ------
    InstallFailed
        No such Python, or something could not be installed.
    """
    base = interpreter(row.python)
    if base is None:
        raise InstallFailed("python", f"no Python {row.python} on this machine")
    python, outside = folder / "bin" / "python", variables(folder)
    run("venv", [uv, "venv", "-q", "--python", base, folder], folder.parent, outside)
    pip = [uv, "pip", "install", "-q", "--python", python]
    if row.versions == LOCKED:
        locked = [*pip, "--no-deps", "--require-hashes", "-r", root / LOCK]
        run("install", locked, folder, outside, timeout)
        run("install", [*pip, "--no-deps", wheel], folder, outside, timeout)
    else:
        asked = f"{wheel}[{row.extra}]" if row.extra else str(wheel)
        chosen = ["--resolution", _RESOLUTION[row.versions]]
        run("install", [*pip, *chosen, asked], folder, outside, timeout)
    return python


def variables(folder: Path) -> Mapping[str, str]:
    """Environment variables of a process that has caches of its own and never saw the clone.

    Compiled kernels lie beside the environments: their key holds the versions that made them, so
    rows share only what the same versions compiled.
    """
    known = ("PYTHONPATH", "VIRTUAL_ENV", "PYTHONHOME")
    kept = {name: value for name, value in os.environ.items() if name not in known}
    own = {"DUALARM_CACHE": folder / "cache", "NUMBA_CACHE_DIR": folder.parent / "kernels"}
    return {**kept, **{name: str(path) for name, path in own.items()}, "MPLBACKEND": "agg"}


def run(
    step: str,
    command: Sequence[object],
    folder: Path,
    environment: Mapping[str, str],
    timeout: float = TIMEOUT,
) -> str:
    """Standard output of a command.

    Raises
    ------
    InstallFailed
        It ended with another code than 0, or took too long; what counts is its own computing, so
        that a busy machine fails nothing.
    """
    try:
        done = subprocess.run(
            [str(part) for part in command], cwd=folder, env=environment, timeout=_BUSY * timeout,
            capture_output=True, text=True, check=False, preexec_fn=partial(_at_most, timeout),
        )  # fmt: skip
    except subprocess.TimeoutExpired:
        raise InstallFailed(step, f"still running after {_BUSY * timeout:g} s") from None
    if done.returncode == -signal.SIGXCPU:
        raise InstallFailed(step, f"more than {timeout:g} s of computing")
    if done.returncode:
        raise InstallFailed(step, _reason(done.stderr or done.stdout, done.returncode))
    return done.stdout


def _at_most(seconds: float) -> None:
    """Limit the computing of this process."""
    whole = math.ceil(seconds)
    resource.setrlimit(resource.RLIMIT_CPU, (whole, whole + 5))


def _reason(text: str, code: int) -> str:
    """The lines that say why, without addresses and folders, which differ between machines."""
    lines = [" ".join(line.split()) for line in text.splitlines() if line.strip()]
    words = " ".join(lines[-3:]).split()
    kept = ("(…)" if "://" in word or word.count("/") > 2 else word for word in words)
    return f"exit code {code}: {' '.join(kept)}"[:400]
