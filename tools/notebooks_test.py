"""Run the notebooks of the built book as a reader would: from a wheel, outside the clone.

A wheel is built and installed with the locked dependencies into an empty environment; the notebooks
that the pages offer are copied into a folder beside it, and ``pytest --nbmake`` runs them there. So
a page that needs a file of the clone, or a module that the wheel leaves out, fails. ``--short``
runs two.
"""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path

from prerun import ROOT

LOCK = "requirements.lock"
#: Pages of the short form: one that only uses the library, one that shows items and data files.
SHORT = ("foundations/pinocchio", "xue/truth")
#: Seconds a cell may take.
TIMEOUT = 1800
#: Exit code where there is nothing to run.
NOT_RUN = 3


def notebooks_in(html: Path, chosen: Sequence[str] = ()) -> list[Path]:
    """The notebooks that the pages of a built book offer, all or those of some pages.

    Raises
    ------
    FileNotFoundError
        A chosen page offers none, or no page does.
    """
    folder = html / "_sources"
    found = [folder / f"{page}.ipynb" for page in chosen] or sorted(folder.rglob("*.ipynb"))
    missing = [path.as_posix() for path in found if not path.is_file()]
    if missing or not found:
        named = ", ".join(missing) or f"none in {folder}"
        raise FileNotFoundError(f"no notebooks: {named}; make book writes them")
    return found


def build_wheel(folder: Path) -> Path:
    """A wheel of the clone, in a folder.

    Raises
    ------
    subprocess.CalledProcessError
        The build failed.
    """
    command = [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(folder)]
    subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
    return next(folder.glob("*.whl"))


def install(wheel: Path, environment: Path) -> Path:
    """An environment with the locked dependencies and the wheel alone; its Python.

    Raises
    ------
    subprocess.CalledProcessError
        Something could not be installed.
    """
    python = environment / "bin" / "python"
    uv = ROOT / ".boot" / "bin" / "uv"
    if uv.is_file():
        _run(uv, "venv", "-q", "--python", sys.executable, environment)
        pip = (uv, "pip", "install", "-q", "--python", python)
    else:
        _run(sys.executable, "-m", "venv", environment)
        pip = (python, "-m", "pip", "install", "-q", "--disable-pip-version-check")
    _run(*pip, "--no-deps", "--require-hashes", "-r", ROOT / LOCK)
    _run(*pip, "--no-deps", wheel)
    return python


def outside() -> Mapping[str, str]:
    """The environment variables of a process that knows nothing of the clone."""
    kept = {k: v for k, v in os.environ.items() if k not in ("PYTHONPATH", "VIRTUAL_ENV")}
    return kept | {"MPLBACKEND": "agg", "JUPYTER_PREFER_ENV_PATH": "1"}


def run(python: Path, notebooks: Sequence[Path], html: Path, folder: Path, *options: str) -> int:
    """Run notebooks in a folder of their own; the exit code of pytest.

    Raises
    ------
    RuntimeError
        The package that they would import is that of the clone.
    """
    folder.mkdir(parents=True, exist_ok=True)
    for path in notebooks:
        target = folder / path.relative_to(html / "_sources")
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(path, target)
    ask = "import dualarm_repro; print(dualarm_repro.__file__)"
    told = subprocess.run(
        [python, "-c", ask], cwd=folder, env=outside(), capture_output=True, text=True, check=True
    )
    where = Path(told.stdout.strip()).resolve()
    if where.is_relative_to(ROOT):
        raise RuntimeError(f"the notebooks would import {where}, which is in the clone")
    command = [python, "-m", "pytest", "-q", "--nbmake", f"--nbmake-timeout={TIMEOUT}", *options]
    return subprocess.run([*command, "."], cwd=folder, env=outside(), check=False).returncode


def main(arguments: Sequence[str] | None = None) -> int:
    """Build, install and run; 1 if a notebook failed, 3 if there is none to run."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--html", type=Path, default=ROOT / "_build" / "html")
    parser.add_argument("--short", action="store_true", help="two pages instead of all")
    parser.add_argument("--jobs", default="auto", help="notebooks at a time")
    chosen = parser.parse_args(arguments)
    try:
        found = notebooks_in(chosen.html, SHORT if chosen.short else ())
    except FileNotFoundError as error:
        print(f"notebooks: NOT RUN, {error}", file=sys.stderr)
        return NOT_RUN
    with tempfile.TemporaryDirectory(prefix="notebooks-") as name:
        folder = Path(name)
        python = install(build_wheel(folder), folder / "environment")
        code = run(python, found, chosen.html, folder / "pages", "-n", chosen.jobs)
    return 1 if code else 0


def _run(*command: object) -> None:
    subprocess.run([str(part) for part in command], check=True)


if __name__ == "__main__":
    sys.exit(main())
