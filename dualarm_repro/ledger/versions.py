"""Versions of the distributions that code can reach."""

from __future__ import annotations

import platform
import re
from collections.abc import Iterable
from functools import cache
from importlib.metadata import PackageNotFoundError, requires, version

#: Distributions behind names that are imported, where the two differ or where one library loads
#: others by name at run time.
DISTRIBUTIONS = {
    "coal": ("coal",),
    "cma": ("cma",),
    "cvxpy": ("cvxpy", "clarabel"),
    "example_robot_data": ("example-robot-data-loaders",),
    "mpl_toolkits": ("matplotlib",),
    "ompl": ("ompl",),
    "PIL": ("pillow",),
    "pinocchio": ("pin",),
    "pink": ("pin-pink",),
    "umsgpack": ("u-msgpack-python",),
    "qpsolvers": ("qpsolvers", "daqp", "proxsuite", "piqp"),
    "yaml": ("pyyaml",),
}
_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9._-]*")


def versions(imported: Iterable[str]) -> dict[str, str]:
    """Versions of Python and of every distribution behind the imported names.

    Requirements of requirements count; what is not installed is ``absent``.
    """
    names = {"numpy"}
    for top in imported:
        names.update(DISTRIBUTIONS.get(top, (top.replace("_", "-"),)))
    reached: set[str] = set()
    waiting = sorted(names)
    while waiting:
        name = waiting.pop()
        if name not in reached:
            reached.add(name)
            waiting += _required(name)
    found = {name: number for name in sorted(reached) if (number := _version(name)) != "absent"}
    absent = {name: "absent" for name in sorted(names) if _version(name) == "absent"}
    return {"python": platform.python_version(), **found, **absent}


@cache
def _version(name: str) -> str:
    try:
        return version(name)
    except PackageNotFoundError:
        return "absent"


@cache
def _required(name: str) -> tuple[str, ...]:
    """What an installed distribution requires without extras."""
    try:
        lines = requires(name) or []
    except PackageNotFoundError:
        return ()
    plain = (line for line in lines if "extra ==" not in line)
    named = (match[0] for line in plain if (match := _NAME.match(line)))
    return tuple(name.lower().replace("_", "-") for name in named)
