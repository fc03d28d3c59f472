"""What the project sets out to reach, suite by suite: gates that must hold, and goals.

A claim names its task and implementations as the suite does; where a suite has no such row, the run
says that it was not measured.
"""

from __future__ import annotations

from claims import Claim, Kind

_POSE, _JACOBIAN = "pose of the flange", "Jacobian and manipulability"
_INVERSE, _STEP = "inverse kinematics, all branches", "control step of two Pandas with avoidance"
_MASTER = "search of one master"
_WELD = "the same with every constraint, and its fitness"

GOALS: dict[str, tuple[Claim, ...]] = {
    "kinematics": (
        Claim("poses, roboticstoolbox", _POSE, 30.0, 70.0, "roboticstoolbox ETS"),
        Claim("poses, loop over Pinocchio", _POSE, 60.0, 120.0, "pinocchio, Python loop"),
        Claim(
            "Jacobian and manipulability, roboticstoolbox",
            *(_JACOBIAN, 300.0, 800.0, "roboticstoolbox ETS"),
        ),
        Claim("all branches of the inverse, EAIK", _INVERSE, 6.0, 10.0, "EAIK"),
    ),
    "memory_bound": (
        Claim(
            "poses, touching the same memory",
            *("poses of 100 000 configurations", 4.0, None, "touching the memory", Kind.AT_MOST),
        ),
    ),
    "single_calls": (
        Claim("one pose, Pinocchio's own call", "one pose", 1.5, None, "pinocchio", Kind.AT_MOST),
        Claim(
            "one Jacobian, Pinocchio's own call",
            *("one Jacobian", 1.5, None, "pinocchio", Kind.AT_MOST),
        ),
        Claim(
            "one manipulability, Pinocchio's own call",
            *("one manipulability", 1.5, None, "pinocchio", Kind.AT_MOST),
        ),
    ),
    "bidirectional": (
        Claim(
            "master plan, RRT-Connect of OMPL",
            *(_MASTER, 50.0, 140.0, "RRT-Connect of OMPL, whole links"),
        ),
    ),
    "control": (
        Claim(
            "control step, pin-pink with barriers",
            *(_STEP, 30.0, 75.0, "pin-pink, self-collision barrier"),
        ),
    ),
    "start_up": (
        Claim("import of the package", "import", 0.3, kind=Kind.SECONDS),
        Claim("dualarm --help", "dualarm --help", 0.3, kind=Kind.SECONDS),
        Claim("dualarm list", "dualarm list", 0.8, kind=Kind.SECONDS),
        Claim("dualarm plan for two arms", "dualarm plan, two arms", 3.0, kind=Kind.SECONDS),
        Claim(
            "the first plan ever, which compiles",
            *("dualarm plan, two arms, first ever", 15.0, None, None, Kind.SECONDS),
        ),
    ),
}
