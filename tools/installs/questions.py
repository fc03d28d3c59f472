"""What an installed wheel has to answer, outside the clone."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from pathlib import Path

from .environment import InstallFailed, run

#: An item whose checker runs symbolic and compiled kinematics in seconds, and the items listed.
ITEM = "xue.eq02"
LISTED = ("--paper", "xue", "--kind", "equation")
SCENE = "example_tasks.yaml"
#: Modules that show that an extra brought what it is for.
MODULES: Mapping[str, tuple[str, ...]] = {
    "dev": ("pytest", "hypothesis", "jupyter_book", "mypy", "ruff"),
    "lab": ("jupyterlab", "jupyterlab_myst"),
    "bench": ("eaik.IK_Robot", "roboticstoolbox", "pink", "ompl.geometric"),
    "cluster": ("dask.distributed",),
    "planners": ("ompl.geometric", "pink", "crocoddyl"),
    "solvers": ("quadprog",),
}
Ask = Callable[..., str]


def _installed(ask: Ask, root: Path) -> None:
    where = Path(ask("-c", "import dualarm_repro; print(dualarm_repro.__file__)").strip())
    if where.resolve().is_relative_to(root):
        raise InstallFailed("import", "the package that is imported is that of the clone")


def _listed(ask: Ask, _: Path) -> None:
    if not any(
        entry["id"] == ITEM for entry in json.loads(_dualarm(ask, "list", *LISTED, "--json"))
    ):
        raise InstallFailed("list", f"{ITEM} is not listed")


def _ran(ask: Ask, folder: Path) -> None:
    _dualarm(ask, "run", ITEM, "--out", folder / "item")
    if not (folder / "item" / f"{ITEM}.json").is_file():
        raise InstallFailed("run", "nothing was written")


def _verified(ask: Ask, _: Path) -> None:
    report = json.loads(_dualarm(ask, "verify", ITEM, "--json"))
    if report["checked"] != 1 or report["drifted"]:
        raise InstallFailed("verify", f"drifted: {report['drifted']}")


def _planned(ask: Ask, folder: Path) -> None:
    """The example arrives and is certified: any other end of the command has another code."""
    told = ask("-c", "from dualarm_repro.datafiles import data_path as d; print(d('scenes'))")
    scene = Path(told.strip()) / SCENE
    _dualarm(ask, "plan", scene, "--method", "apf-bidirectional", "--out", folder / "plan")


def _dualarm(ask: Ask, *arguments: object) -> str:
    return ask("-m", "dualarm_repro.cli", *arguments)


#: Steps in their order.
STEPS: Mapping[str, Callable[[Ask, Path], None]] = {
    "list": _listed,
    "run": _ran,
    "verify": _verified,
    "plan": _planned,
}


def answers(
    python: Path,
    extra: str,
    root: Path,
    folder: Path,
    environment: Mapping[str, str],
    timeout: float,
) -> list[str]:
    """Names of the steps that an environment passed: all of them.

    Raises
    ------
    InstallFailed
        At the first step that failed.
    """
    passed: list[str] = []

    def asking(step: str) -> Ask:
        return lambda *arguments: run(step, [python, *arguments], folder, environment, timeout)

    _installed(asking("import"), root)
    passed.append("import")
    if extra:
        names = ", ".join(MODULES[extra])
        asking("extra")("-c", f"import {names}")
        passed.append("extra")
    for step, check in STEPS.items():
        check(asking(step), folder)
        passed.append(step)
    return passed
