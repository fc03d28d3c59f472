"""Which other libraries the suites compare with, which of them are here, and which are missing."""

from __future__ import annotations

from importlib.metadata import PackageNotFoundError, version

#: Distribution, and what it is compared in.
PEERS = {
    "pin": "kinematics, distances, collision checks",
    "coal": "distances",
    "roboticstoolbox-python": "kinematics, inverse kinematics",
    "eaik": "inverse kinematics, all branches",
    "ik-geo": "inverse kinematics, all branches",
    "ssik": "inverse kinematics, all branches",
    "ompl": "planning",
    "pin-pink": "control step",
    "mink": "control step",
    "mujoco": "control step, below mink",
    "daqp": "quadratic programs",
    "quadprog": "quadratic programs",
    "proxsuite": "quadratic programs",
    "piqp": "quadratic programs",
    "pymoo": "genetic search",
    "deap": "genetic search",
    "cma": "search of an optimum",
}
#: What the times of this project itself depend on.
GROUND = ("numpy", "scipy", "numba", "llvmlite")


def versions() -> dict[str, str]:
    """Version of every library that is installed, in the order above."""
    found = {}
    for name in (*GROUND, *PEERS):
        try:
            found[name] = version(name)
        except PackageNotFoundError:
            continue
    return found


def missing() -> dict[str, str]:
    """Peers that are not installed, with what they would be compared in."""
    here = versions()
    return {name: what for name, what in PEERS.items() if name not in here}
