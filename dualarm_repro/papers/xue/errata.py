"""Machine proofs of the errata of `xue`: kinematics, potentials, planning, Table 2."""

from __future__ import annotations

from typing import Any

import numpy as np

from ...arms import load_arm
from ...ledger import REGISTRY, Proof, evaluate
from ...planning.trials.stuck import STATIONARY
from . import document, motions
from .outcomes import TRIALS, VARIANTS, run_variants, starts
from .pages.kinematics import printed_chain as chain
from .pages.kinematics.chain import flanges
from .pages.potentials.improved import rest_slope, term_scaling
from .pages.potentials.traditional import attractive_force_forms
from .pages.truth import RADII
from .reading import nominal
from .stored import ablation_shares, clear_share, minima_shares, virtual_point_counts


@REGISTRY.proves("xue.eq01_angle")
def eq01_angle() -> Proof:
    """Substituting the parameters into (1) as printed and corrected."""
    literal, corrected = (chain.matrices_given(corrected=given) for given in (False, True))
    return Proof(
        "only with the twist angle does (1) reproduce every matrix (2)-(7)",
        len(corrected) == len(chain.LINKS) > len(literal),
        {"matrices_as_printed": literal, "matrices_with_alpha": corrected},
    )


@REGISTRY.proves("xue.table1_shift")
def table1_shift() -> Proof:
    """Column a of the table against the matrices, and what the two readings differ by."""
    column = chain.table_parameters()["a"]
    matrices = chain.printed_parameters()["a"]
    start, goal = (
        float(np.linalg.norm(np.subtract(*flanges(q))))
        for q in (document.master_start(), document.master_goal())
    )
    return Proof(
        "the printed column equals that of the matrices moved up one row; the readings agree at "
        "the start, where only the sum of the lengths counts, and not at the goal",
        column == [*matrices[1:], 0.0] and column != matrices and start < 1e-12 < goal,
        {
            "flange_difference_start": start,
            "flange_difference_goal": goal,
            "reach_matrices": document.reach("matrices"),
            "reach_table": document.reach("table"),
        },
    )


@REGISTRY.proves("xue.table1_unit")
def table1_unit() -> Proof:
    """Lengths read as metres are those of the published robot; as millimetres nothing is."""
    printed, published = chain.printed_lengths(), document.lengths("published")
    metres, millimetres = (
        [k for k in chain.SHARED if np.isclose(unit * printed[k], published[k], atol=1e-12)]
        for unit in (1.0, 1e-3)
    )
    return Proof(
        "read as metres, a1, a3, d4 and d6 are those of the published robot; read as millimetres, "
        "as headed, none is, and the arm would reach a few millimetres",
        metres == list(chain.SHARED) and not millimetres,
        {"reach_if_millimetres_in_mm": document.reach("matrices"), "equal_in_metres": metres},
    )


@REGISTRY.proves("xue.upper_arm")
def upper_arm() -> Proof:
    """The one link length that is not that of the robot named."""
    printed, published = chain.printed_lengths()["a2"], document.lengths("published")["a2"]
    return Proof(
        "the printed upper arm is shorter than the published one",
        published > printed,
        {
            "printed": printed,
            "published": published,
            "reach_matrices": document.reach("matrices"),
            "reach_published_from_floor": document.reach("published"),
        },
    )


@REGISTRY.proves("xue.base_height")
def base_height() -> Proof:
    """Without the published base height the start lies below the floor."""
    height = document.lengths("published")["d1"]
    z = float(load_arm("es165d").fk(document.master_start())[2, 3])
    return Proof(
        "the matrices have no base height, and with the published one the start pose would put the "
        "flange of a standing robot below the floor",
        chain.printed_lengths()["d1"] == 0.0 < height and z + height < 0,
        {"published_height": height, "flange_above_floor_at_start": z + height},
    )


@REGISTRY.proves("xue.start_outside_limits")
def start_outside_limits() -> Proof:
    """The printed start against the ranges of the real robot, mapped to the document's zero."""
    arm = load_arm("es165d")
    start, goal, limit = document.master_start()[1], document.master_goal()[1], arm.upper[1]
    return Proof(
        "axis L is beyond its range at the printed start and within it at the printed goal",
        bool(start > limit > goal),
        {
            "axis_L_at_start_deg": float(90 + np.rad2deg(start)),
            "beyond_range_deg": float(np.rad2deg(start - limit)),
        },
    )


@REGISTRY.proves("xue.force_modulus")
def force_modulus() -> Proof:
    """The two printed sides of (11), and the last one without its modulus."""
    forms = attractive_force_forms()
    return Proof(
        "-grad U_att of (9) equals -k_a (X - X_g) and not, even along a line, -k_a |X - X_g|",
        forms["vector_form"] and not forms["printed_form"],
        forms,
    )


@REGISTRY.proves("xue.eq13_units")
def eq13_units() -> Proof:
    """Dimensions of the two terms, and what a change of the unit of length does."""
    shares, scaling = minima_shares(), term_scaling()
    metres, millimetres = shares[1.0].value, shares[1e-6].value
    return Proof(
        "the two printed terms do not scale alike with the unit of length, which so is a weight: "
        "with lengths in millimetres far more descents end elsewhere than with metres",
        not scaling["one_dimension"] and shares[1e-6].low > shares[1.0].high,
        {**scaling, "minima_share_in_m": metres, "minima_share_in_mm": millimetres},
    )


@REGISTRY.proves("xue.eq13_minima")
def eq13_minima() -> Proof:
    """Descents of (13) without any obstacle."""
    shares = minima_shares()
    return Proof(
        "without any obstacle some descents of (13), weight 1 in metres, end in a minimum "
        "elsewhere; the more the position weighs, the more do",
        shares[1.0].low > 0.0 and shares[0.1].low > shares[1.0].high,
        {f"weight {weight:g}": found.value for weight, found in shares.items()},
    )


def _obtained(item: str) -> dict[str, Any]:
    return motions.present(evaluate(REGISTRY, f"xue.{item}").result, item).obtained


@REGISTRY.proves("xue.slave_goal_angles")
def slave_goal_angles() -> Proof:
    """Calls of inverse kinematics that the goal of the slave costs."""
    values = _obtained("claim_no_ik")
    return Proof(
        "(13) cannot be evaluated for the slave before inverse kinematics has been called for its "
        "goal",
        values["needs_goal_angles"] and values["calls"]["slave"] >= 1 > values["calls"]["master"],
        values,
    )


@REGISTRY.proves("xue.virtual_term_absent")
def virtual_term_absent() -> Proof:
    """A term of the form (9) that always acts keeps the arm off its goal."""
    case = nominal()
    gains = document.gains()
    share = gains["k_w"] / (gains["k_w"] + gains["k_a"])
    offset = share * float(np.linalg.norm(document.slave_end() - case.layout.window_centre))
    return Proof(
        "with the term always on, the end effector would rest on the line from goal to virtual "
        "point, so that a rule for switching it off is needed",
        rest_slope() < 1e-6 and offset > case.planner.goal_tolerance,
        {"rest_share": share, "slave_distance_from_goal": offset},
    )


@REGISTRY.proves("xue.virtual_point_credit")
def virtual_point_credit() -> Proof:
    """Runs of the improved method with and without its virtual point, same starts."""
    shares, counts = ablation_shares(), virtual_point_counts()
    with_point, without = (
        shares[VARIANTS[name].title]["nominal"].value for name in ("improved", "without_virtual")
    )
    return Proof(
        "in the arrangement shown the improved method misses as rarely without the virtual point, "
        "so that the joint term frees the arm; over random arrangements the point saves few of "
        "the runs in which it acts",
        with_point == without and counts["rescued"] < 0.5 * counts["used"],
        {"missed_with": with_point, "missed_without": without, **counts},
    )


@REGISTRY.proves("xue.stop_at_zero")
def stop_at_zero() -> Proof:
    """Where a trapped run stands still the potential is positive."""
    obtained = _obtained("claim_stop_zero")
    return Proof(
        "where a run stands still short of the goal the gradient vanishes, not the potential",
        obtained["at_trap"] > obtained["off_goal"] > 0.0 and obtained["gradient"] < STATIONARY,
        obtained,
    )


@REGISTRY.proves("xue.table2_exchange")
def table2_exchange() -> Proof:
    """The trap column as printed against the text before the table."""
    table, text = document.table_counts(), document.text_counts()
    exchanged = dict(zip(table, reversed(table.values()), strict=True))
    return Proof(
        "the trap column of the table contradicts the text, and agrees with it once its two "
        "entries are exchanged",
        table != text and exchanged == text,
        {"table": table, "text": text, "table_exchanged": exchanged},
    )


@REGISTRY.proves("xue.deterministic_trials")
def deterministic_trials() -> Proof:
    """Ten runs from one and the same start."""
    case = nominal()
    begin = starts(case, 0.0, TRIALS, np.random.default_rng(0))
    found = run_variants(case, ("traditional", "improved"), begin)
    missed = {name: int((~runs.reached).sum()) for name, runs in found.items()}
    return Proof(
        "ten runs from one start all end alike, so that 8 of 10 needs a variation that is not "
        "named",
        all(count in (0, TRIALS) for count in missed.values())
        and all(len(np.unique(runs.last, axis=0)) == 1 for runs in found.values()),
        missed,
    )


@REGISTRY.proves("xue.tool_only")
def tool_only() -> Proof:
    """Arrangements in which the end effectors are clear and links are not."""
    case = nominal()
    replay = motions.replay_of(case, motions.slave_plan(case))
    cores = motions.cores_of(motions.present(replay, "two motions"), case.layout)
    shares = {f"clear at {radius:g} m": clear_share(radius).value for radius in RADII}
    return Proof(
        "there are arrangements in which both end effectors do what the figures show while links "
        "of a tenth of a metre touch window or arm",
        clear_share(0.10).high < 1.0,
        {**shares, "nominal_touches_at": motions.largest_radius(motions.smallest_cores(cores))},
    )


@REGISTRY.proves("xue.layout_conflict")
def layout_conflict() -> Proof:
    """Synchronous distance of the master's undisturbed track and the straight slave line."""
    case, start, end = nominal(), document.slave_start(), document.slave_end()
    base = case.layout.master_base
    track = motions.master_undisturbed(case.layout, case.planner).tcp - base
    share = np.minimum(np.arange(len(track)) / 100.0, 1.0)[:, np.newaxis]
    line = start + share * (end - start)
    sideways = [
        float(np.linalg.norm(track + np.array([0.0, offset, 0.0]) - line, axis=1).min())
        for offset in np.linspace(-4.0, 4.0, 801)
    ]
    _, farthest = motions.present(REGISTRY.declared("xue.meeting_distance", "range").range, "range")
    anywhere = float(np.linalg.norm(track + base - line, axis=1).min())
    return Proof(
        "a base moved sideways only never brings the two end effectors together at one instant; "
        "one moved in three directions does",
        min(sideways) > farthest > anywhere,
        {"best_sideways": min(sideways), "base_of_the_arrangement": anywhere},
    )
