"""What the project sets out to reach, suite by suite: gates that must hold, and goals.

A claim names its task and implementations as the suite does; where a suite has no such row, the run
says that it was not measured.
"""

from __future__ import annotations

from claims import Claim, Kind

_POSE, _JACOBIAN = "pose of the flange", "Jacobian and manipulability"
_INVERSE, _STEP = "inverse kinematics, all branches", "control step of two Pandas with avoidance"
_MASTER, _BOTH = "search of one master", "master, its hull, and the slave around it"
_SAMPLED, _STATES = "OMPL RRT-Connect, simplified", "pin.computeCollisions every 0.02 rad"
_WHOLE = "RRT-Connect of OMPL, whole links, simplified"
_WELD = "joint paths and manipulabilities of a weld at one position"

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
    "edges": (
        Claim("edges proved, one arm", "edge validity, one arm", 50.0, 130.0, _STATES),
        Claim(
            "edges proved, two arms",
            *("edge validity, two arms with 12 joints", 50.0, 130.0, _STATES),
        ),
    ),
    "capsule_distances": (
        Claim(
            "distances of capsules, Pinocchio's C++ loop",
            *("distances of capsules, poses included", 3.0, 5.0, "pin.computeDistances"),
        ),
    ),
    "sampled_paths": (
        Claim("path of one arm, OMPL", "path, one arm", 8.0, 20.0, _SAMPLED),
        Claim("path of two arms in turn, OMPL", "path, two arms in turn", 8.0, 20.0, _SAMPLED),
        Claim("path of 12 joints at once, OMPL", "path, 12 joints at once", 8.0, 20.0, _SAMPLED),
    ),
    "bidirectional": (
        Claim("master plan, RRT-Connect of OMPL", _MASTER, 50.0, 140.0, _WHOLE),
        Claim("plan of two arms, RRT-Connect of OMPL", _BOTH, 8.0, 20.0, _WHOLE),
    ),
    "control": (
        Claim(
            "control step, pin-pink with barriers",
            *(_STEP, 30.0, 75.0, "pin-pink, self-collision barrier"),
        ),
        Claim(
            "control step, mink with avoidance",
            *(_STEP, 8.0, 15.0, "mink, collision avoidance limit"),
        ),
    ),
    "genetic": (
        Claim(
            "generation of a genetic algorithm, pymoo",
            *("generation of a genetic algorithm, 50 individuals", 60.0, 145.0, "pymoo"),
        ),
    ),
    "welding": (
        Claim(
            "fitness of a weld, roboticstoolbox",
            *(_WELD, 25.0, 60.0, "roboticstoolbox IK and manipulability"),
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
