"""Machine proofs of the errata on potentials, planning and Table 2 of `xue`."""

from __future__ import annotations

import numpy as np

from ...ledger import REGISTRY, Proof, evaluate
from ...planning.descent.termination import StopReason
from ...planning.field.control_points import end_effector
from .chosen import nominal
from .layout import placed_master
from .link_truth import RADII
from .motions import master_track, master_undisturbed, slave_plan
from .new_potentials import rest_slope, term_scaling
from .potentials import attractive_force_forms
from .scenario import GAINS, SLAVE_END, SLAVE_START
from .stored import ablation_shares, clear_share, minima_shares, virtual_point_counts
from .trap_counts import table_counts, text_counts
from .trials import FLAT, METHODS, TRIALS, run_methods, starts
from .truth import largest_radius, link_cores


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


@REGISTRY.proves("xue.slave_goal_angles")
def slave_goal_angles() -> Proof:
    """Calls of inverse kinematics that the goal of the slave costs."""
    values = evaluate(REGISTRY, "xue.claim_no_ik").result.obtained
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
    layout = case.layout
    share = GAINS["k_w"] / (GAINS["k_w"] + GAINS["k_a"])
    offset = share * float(np.linalg.norm(SLAVE_END - layout.window_centre))
    return Proof(
        "with the term always on, the end effector would rest on the line from goal to virtual "
        "point, so that a rule for switching it off is needed",
        rest_slope() < 1e-6 and offset > case.method.goal_tolerance,
        {"rest_share": share, "slave_distance_from_goal": offset},
    )


@REGISTRY.proves("xue.virtual_point_credit")
def virtual_point_credit() -> Proof:
    """Runs of the improved method with and without its virtual point, same starts."""
    shares = ablation_shares()
    with_point, without = (
        shares[METHODS[name].title]["nominal"].value for name in ("improved", "without_virtual")
    )
    counts = virtual_point_counts()
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
    obtained = evaluate(REGISTRY, "xue.claim_stop_zero").result.obtained
    return Proof(
        "where a run stands still short of the goal the gradient vanishes, not the potential",
        obtained["at_trap"] > obtained["off_goal"] > 0.0 and obtained["gradient"] < FLAT,
        obtained,
    )


@REGISTRY.proves("xue.table2_exchange")
def table2_exchange() -> Proof:
    """The trap column as printed against the text before the table."""
    table, text = table_counts(), text_counts()
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
    found = run_methods(case, ("traditional", "improved"), begin)
    missed = {name: int((runs.reason != StopReason.REACHED).sum()) for name, runs in found.items()}
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
    cores = link_cores(case.layout, slave_plan(case), master_track(case)).smallest
    shares = {f"clear at {radius:g} m": clear_share(radius).value for radius in RADII}
    return Proof(
        "there are arrangements in which both end effectors do what the figures show while links "
        "of a tenth of a metre touch window or arm",
        clear_share(0.10).high < 1.0,
        {**shares, "nominal_touches_at": largest_radius(cores)},
    )


@REGISTRY.proves("xue.layout_conflict")
def layout_conflict() -> Proof:
    """Synchronous distance of the master's undisturbed track and the straight slave line."""
    case = nominal()
    master = master_undisturbed(case.layout, case.method)
    track = end_effector(placed_master(case.layout), master.path) - case.layout.master_base
    share = np.minimum(np.arange(len(track)) / 100.0, 1.0)[:, np.newaxis]
    line = SLAVE_START + share * (SLAVE_END - SLAVE_START)
    sideways = [
        float(np.linalg.norm(track + np.array([0.0, offset, 0.0]) - line, axis=1).min())
        for offset in np.linspace(-4.0, 4.0, 801)
    ]
    farthest = REGISTRY.declared("xue.meeting_distance", "range").range[1]
    anywhere = float(np.linalg.norm(track + case.layout.master_base - line, axis=1).min())
    return Proof(
        "a base moved sideways only never brings the two end effectors together at one instant; "
        "one moved in three directions does",
        min(sideways) > farthest > anywhere,
        {"best_sideways": min(sideways), "base_of_the_arrangement": anywhere},
    )
