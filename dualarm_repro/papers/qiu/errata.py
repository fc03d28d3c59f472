"""Machine proofs of the errata of `qiu`."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.spatial.transform import Rotation

from ...ledger import REGISTRY, Proof
from ...ledger.printed import read_number
from ...planning.checks.hull_cover import protrusions
from ...planning.field.control_points import end_effector
from ...planning.field.repulsive_force import inverse_distance_force
from ...planning.search.failure import Failure, classify
from ...planning.search.search_field import balance_distance, repulsive_torque_at
from ...planning.search.search_problem import search_problem
from ...planning.tasks.tip_goal import nearest_posture
from .document import PRINTED, SEED, goal_to_surface, placed, reach, repelling, shoulder_to_goal
from .pages.geometry.task import gap_by_turn
from .pages.two_sided.halves import truth
from .reading import CONTROL_POINTS, Hull, Improved, Slave, Splice, Traditional
from .studies.fit import calibrated_master

_DIRECTIONS = 400


@REGISTRY.proves("qiu.start_tip")
def start_tip() -> Proof:
    """The tip at the printed joints of both arms against both printed tips."""
    gaps, beyond = {}, {}
    places = {"master": ("claim_start", "tcp"), "slave": ("claim_slave_task", "start")}
    for name, (item, key) in places.items():
        texts = REGISTRY.printed(f"qiu.{item}")[key]
        there, half = np.transpose([read_number(text) for text in texts])
        gap = end_effector(placed(name), PRINTED.start) - there
        gaps[name], beyond[name] = gap.tolist(), float(max(abs(gap) - half))
    largest = max(float(np.linalg.norm(gap)) for gap in gaps.values())
    return Proof(
        "at the printed joints both flanges miss the printed tips by more than the printed digits",
        min(beyond.values()) > 0.0,
        {"differences": gaps, "distance": largest, "beyond_digits": beyond},
    )


@REGISTRY.proves("qiu.goal_out_of_reach")
def goal_out_of_reach() -> Proof:
    """Distance of the printed goal from the shoulder against the straight arm, and by a search."""
    distance, missing = shoulder_to_goal(), shoulder_to_goal() - reach()
    best = nearest_posture(placed("master"), PRINTED.master_goal, PRINTED.start)
    return Proof(
        "no posture brings the flange to the printed goal: the straight arm is shorter than its "
        "distance from the shoulder, and the best posture found misses it by just that much",
        distance > reach() and abs(best.residual - missing) < 1e-6,
        {"distance": distance, "reach": reach(), "shortfall": missing, "found": best.residual},
    )


@REGISTRY.proves("qiu.singular_goal")
def singular_goal() -> Proof:
    """Singular values of the Jacobian nearest to the goal, at the start and along the path used."""
    arm = placed("master").arm
    best = nearest_posture(placed("master"), PRINTED.master_goal, PRINTED.start)
    position = np.linalg.svd(arm.jacobian(best.q)[:3], compute_uv=False)
    path = Splice.nominal().smooth(Improved.nominal().plan().path)
    along = np.linalg.svd(arm.jacobian(path), compute_uv=False)[:, -1]
    start = np.linalg.svd(arm.jacobian(PRINTED.start), compute_uv=False)
    return Proof(
        "where the flange is nearest to the printed goal the position Jacobian is singular, and "
        "at the printed start, all joints zero, the whole Jacobian is, with axes 4 and 6 aligned",
        bool(position[-1] < 1e-3 * position[0] and start[-1] < 1e-9 * start[0]),
        {
            "smallest_at_the_printed_start": float(start[-1]),
            "position_singular_values": position.tolist(),
            "smallest_along_the_path_used": float(along.min()),
        },
    )


@REGISTRY.proves("qiu.symmetry_axis")
def symmetry_axis() -> Proof:
    """Reflections of the master base in the coordinate axes and planes."""
    master, slave = PRINTED.bases.values()
    about_x, in_yz, shift = master * [1, -1, -1], master * [-1, 1, 1], slave - master
    mirrored = np.allclose(about_x, master) and np.allclose(in_yz, slave)
    return Proof(
        "a half turn about the X axis leaves the master base where it is; a reflection in the YZ "
        "plane, or a translation along X, carries it to the slave base",
        bool(mirrored and np.allclose(shift[1:], 0.0)),
        {"about_x": about_x.tolist(), "in_yz": in_yz.tolist(), "translation": shift.tolist()},
    )


@REGISTRY.proves("qiu.base_yaw")
def base_yaw() -> Proof:
    """Distance of the tip at zero joints from the printed tip for the four quarter turns."""
    gaps = gap_by_turn()
    order = sorted(gaps, key=gaps.__getitem__)
    return Proof(
        "of the four quarter turns one brings the tip at zero joints ten times nearer to the "
        "printed one than any other",
        order[0] == 90 and 10.0 * gaps[order[0]] < gaps[order[1]],
        {f"{yaw} deg": gap for yaw, gap in gaps.items()},
    )


@REGISTRY.proves("qiu.gains_against_points")
def gains_against_points() -> Proof:
    """Repulsion over the largest attraction with the flange at the printed trap.

    The flange is put at the trap in many orientations and every branch of the inverse kinematics.
    """
    arm, start, eta0 = placed("master"), PRINTED.start, PRINTED.eta0
    largest, ratios = PRINTED.threshold * PRINTED.zeta, []
    reading = Traditional.nominal(gain_ratio=eta0 / PRINTED.zeta)
    made = search_problem(arm, start, start, repelling(), reading.settings())
    target = arm.placement.inverse().act(PRINTED.trap)
    rotations = Rotation.random(_DIRECTIONS, rng=np.random.default_rng(SEED))
    for rotation in rotations.as_matrix():
        pose = np.eye(4)
        pose[:3, :3], pose[:3, 3] = rotation, target
        for q in arm.arm.ik(pose):
            ratios.append(float(np.linalg.norm(repulsive_torque_at(made, q))) / largest)
    points = np.vstack([PRINTED.trap, PRINTED.meeting])
    surface = [float(np.linalg.norm(p - PRINTED.centres[0]) - PRINTED.radius) for p in points]
    flange = inverse_distance_force(surface[0], eta0, PRINTED.influence, 1e-3)
    return Proof(
        "with the textbook form of (7)-(9) and the printed gains, repulsion exceeds the largest "
        "possible attraction in every posture drawn with its flange at the printed trap, so that "
        "none of them is in balance",
        min(ratios) > 10.0,
        {
            "postures": len(ratios),
            "least_repulsion_over_attraction": min(ratios),
            "force_on_the_flange": float(flange),
            "largest_attraction": largest,
            "distances_of_printed_points": surface,
            "balance_distance": balance_distance(eta0, PRINTED.influence, largest, 0.5),
        },
    )


@REGISTRY.proves("qiu.goal_inside_range")
def goal_inside_range() -> Proof:
    """Distances of the printed goal from both spheres, and the class of the failed search."""
    gaps, plan = goal_to_surface().tolist(), Traditional.nominal().plan()
    failure = classify(plan)
    return Proof(
        "both spheres reach the goal with their repulsion, and the one-way search with the "
        "printed gains fails because its goal is no equilibrium: begun at the goal, "
        "it rests at the same place",
        max(gaps) < PRINTED.influence and failure is Failure.DISPLACED_GOAL,
        {"goal_to_surfaces": gaps, "failure": str(failure), "searches": plan.searches},
    )


@REGISTRY.proves("qiu.control_point_frames")
def control_point_frames() -> Proof:
    """Origins of joints 3, 5 and 6 under a modified table and in a robot description."""
    arm = placed("master").arm
    origins = arm.joint_positions(PRINTED.start)
    modified = origins[[2, 4, 5]]
    described = origins[np.array(CONTROL_POINTS["elbow_wrist_flange"].frames) - 1]
    apart = [np.linalg.norm(points[1] - points[2]) for points in (modified, described)]
    return Proof(
        "with the frames of a modified table the last two control points are one point; with "
        "those of a robot description the three are distinct",
        bool(apart[0] < 1e-12 and apart[1] > 0.01),
        {"modified": modified.tolist(), "description": described.tolist()},
    )


@REGISTRY.proves("qiu.hull_incomplete")
def hull_incomplete() -> Proof:
    """How far links stick out of the hull over random postures."""
    arm = placed("master")
    q = arm.arm.random_configurations(100, np.random.default_rng(SEED))
    most = protrusions(arm, q, Hull.nominal().circles()).max(axis=1)
    least, median, largest = (float(of(most)) for of in (np.min, np.median, np.max))
    return Proof(
        "in every one of 100 random postures a link sticks out of the hull",
        least > 0.0,
        {"least": least, "median": median, "largest": largest},
    )


@REGISTRY.proves("qiu.collision_scope")
def collision_scope() -> Proof:
    """The plan of both arms at face value: clear at the control points, not for whole links."""
    reading = Slave.nominal()
    plan = reading.dual_plan()
    check = plan.contact(reading.scene())
    seen = plan.slave.control_clearance
    return Proof(
        "one and the same plan is free for the control points and collides with whole links, so "
        "that the statement depends on the geometry it was tested for",
        seen > 0.0 > check.clearance["arms"],
        {"control_points": seen, "links": check.clearance["arms"]},
    )


@REGISTRY.proves("qiu.smoothing_clearance")
def smoothing_clearance() -> Proof:
    """Clearance before and after the spline, for growing mu."""
    plan, splice = calibrated_master(Improved).plan(), Splice.nominal()
    before = truth(plan).clearance
    changes = {}
    for mu in (0.1, 1.0, 10.0, 100.0, 1e4):
        after = truth(plan, replace(splice, smoothing_weight=mu).smooth(plan.path)).clearance
        changes[f"{mu:g}"] = {name: after[name] - before[name] for name in before}
    by_mu = [min(row.values()) for row in changes.values()]
    worst = min(by_mu)
    return Proof(
        "smoothing brings the calibrated path closer to an obstacle, the more so the larger mu",
        worst < -1e-4 and by_mu == sorted(by_mu, reverse=True),
        {"change_of_clearance_by_mu": changes, "worst": worst},
    )
