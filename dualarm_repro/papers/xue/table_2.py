"""Table 2 of `xue` and what the text says about it: trapped runs, steps and times."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from time import perf_counter
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from ...errors import InputError
from ...ledger import REGISTRY, Assumed, Bounded, Is, NoOriginal, Result, Role
from ...planning.batch import plan_batch
from ...tracking import memo
from ...view.shares import Share, count_grid_figure, shares_figure
from .layout import placed_slave
from .motions import Case, slave_obstacles
from .stored import (
    MANY_MISSED,
    ablation_shares,
    held_share,
    lottery_shares,
    missed,
    repeated_shares,
    virtual_point_counts,
)
from .trials import METHODS, PUSH, TRIALS, Outcome, run_methods, starts, summary, wilson

checks = partial(REGISTRY.checks, page="xue/table2")

#: Section 3.3, the text before Table 2: all ten improved runs succeed, the traditional method is
#: trapped in eight.
TEXT = {"traditional": "8", "improved": "0"}
#: An outcome that shows in this share of the arrangements does not hang on what is not printed.
DECISIVE = 0.95
_REPEATS = 3
MISS_LABEL = "share of trials that miss the goal"


class Trials(NamedTuple):
    """Ten runs of both methods from the same starts."""

    traditional: Outcome
    improved: Outcome


@memo(512)
def trials_of(case: Case, reading: str, half_width: float, seed: int) -> Trials | None:
    """Ten seeded trials; None where the slave has nothing to plan in this arrangement."""
    if slave_obstacles(case) is None:
        return None
    begin = starts(case, half_width, TRIALS, np.random.default_rng(seed))
    old = "five_points" if reading == "five_points" else "traditional"
    try:
        runs = run_methods(case, (old, "without_virtual", "improved"), begin)
    except InputError:  # the unperturbed start touches an obstacle
        return None
    return Trials(*(summary(case, method, runs[method]) for method in (old, "improved")))


def assumed_trials(assumed: Assumed) -> Trials | None:
    """The trials that the assumptions describe."""
    names = ("classical_method", "trial_perturbation", "trial_seed")
    return trials_of(Case.of(assumed), *(assumed[name] for name in names))


@checks(
    "xue.tab02",
    rules=[
        Bounded(key="missed.traditional", low=6, label="traditional runs of 10 that miss the goal"),
        Bounded(key="missed.improved", high=1, label="improved runs of 10 that miss the goal"),
        Bounded(
            key="text_over_table",
            low=1.0,
            label="random arrangements with the text's outcome per one with the table's, at least",
        ),
        Is(
            key="rows_agree_with_text",
            value=False,
            role=Role.CONTRADICTS,
            label="the rows of the table say what the text says",
        ),
    ],
    samples=32,
)
def both_methods(assumed: Assumed) -> Result:
    """Both readings of the print against ten trials, many trials and the lottery."""
    trials, shares = assumed_trials(assumed), lottery_shares(assumed["classical_method"])
    printed = printed_counts()
    many = repeated_shares()
    text, table = shares["text"], shares["table"]
    return Result(
        obtained={
            "reading_of_table": printed,
            "reading_of_text": TEXT,
            "rows_agree_with_text": printed == TEXT,
            **_counts(trials),
            "text_over_table": text.low / table.high,
            "many_trials": {
                rule: {name: found._asdict() for name, found in methods.items()}
                for rule, methods in many.items()
            },
            "lottery": {name: found._asdict() for name, found in shares.items()},
            "lottery_mean_missed": {
                name: float(missed(name).mean())
                for name in (assumed["classical_method"], "improved")
            },
        },
        table=_trial_table(trials),
        caption=(
            f"Print gives the 8 traps to the improved method, the text to the traditional one. "
            f"{_sentence(trials)} Over random arrangements in which Fig. 9 holds, the outcome of "
            f"the text (at least {MANY_MISSED} traditional, no improved runs missed) shows in "
            f"{_percent(text)}, that of the table in {_percent(table)}. {_likelier(text, table)}"
        ),
        alt=(
            "Bars with intervals: share of trials that miss, per method and rule of the joint step."
        ),
        figure=lambda: shares_figure(_named(many), MISS_LABEL),
    )


@checks(
    "xue.claim_success_10",
    rules=[
        Is(key="trials", to="trials", label="number of runs"),
        Bounded(key="missed.improved", high=0, label="improved runs of 10 that miss the goal"),
        Bounded(
            key="lottery.low",
            low=DECISIVE,
            label=(
                "random arrangements in which all ten succeed, lower bound; else a printed layout"
            ),
        ),
    ],
    samples=32,
)
def improved_succeeds(assumed: Assumed) -> Result:
    """Ten runs of the improved method, and the same over random arrangements."""
    trials = assumed_trials(assumed)
    found = lottery_shares(assumed["classical_method"])["improved_never_missed"]
    virtual = virtual_point_counts()
    return Result(
        obtained={
            "trials": TRIALS,
            **_counts(trials),
            "lottery": found._asdict(),
            "virtual_point": virtual,
        },
        caption=(
            f"{_sentence(trials)} Over random arrangements in which Fig. 9 holds all ten improved "
            f"runs succeed in {_percent(found)}: the arrangement, which is not printed, decides. "
            f"In {virtual['used']} of {virtual['runs']} runs there the virtual point acted, in "
            f"{virtual['rescued']} of these the goal was then reached."
        ),
        alt=(
            "Bars with intervals: share of trials that miss the goal, for nine variants of the "
            "method."
        ),
        figure=lambda: shares_figure(ablation_shares(), MISS_LABEL),
    )


@checks(
    "xue.claim_trapped_8",
    rules=[
        Is(key="trials", to="trials", label="number of runs"),
        Bounded(key="missed.traditional", low=6, label="traditional runs of 10 that miss the goal"),
        Bounded(key="unproved", high=0, label="runs called trapped whose gradient does not vanish"),
        Bounded(
            key="lottery.low",
            low=DECISIVE,
            label=(
                "random arrangements with at least 7 of 10 missed, lower bound; else a printed "
                "layout"
            ),
        ),
    ],
    samples=32,
)
def traditional_trapped(assumed: Assumed) -> Result:
    """Ten runs of the traditional method, and the same over random arrangements."""
    trials, reading = assumed_trials(assumed), assumed["classical_method"]
    found = lottery_shares(reading)["traditional_mostly_missed"]
    old = None if trials is None else trials.traditional
    unproved = None if old is None else old.trapped - old.stationary
    gradient = None if trials is None else trials.traditional.gradient
    return Result(
        obtained={
            "trials": TRIALS,
            **_counts(trials),
            "unproved": unproved,
            "largest_gradient": gradient,
            "lottery": found._asdict(),
        },
        caption=(
            f"{_sentence(trials)} {_certified(trials)}"
            f"Over random arrangements at least {MANY_MISSED} of 10 miss in {_percent(found)}; of "
            f"the traditional runs that stand still there pushes leave {_percent(held_share())}."
        ),
        alt=(
            "Grid of counts: traditional runs that miss over improved runs that miss, per random "
            "arrangement; the printed pair is framed."
        ),
        figure=lambda: _lottery_figure(reading),
    )


@checks(
    "xue.claim_times",
    rules=[
        Bounded(
            key="step_ratio", low=1.0, label="steps of the traditional over the improved method"
        ),
        NoOriginal(key="computer", label="the computer and which runs are timed"),
    ],
    samples=32,
)
def times(assumed: Assumed) -> Result:
    """Steps of both methods, which do not depend on the machine, and times measured here."""
    trials, timed = assumed_trials(assumed), assumed["timed_runs"]
    exchange = assumed["table2_exchange"]
    steps = _steps(trials, timed)
    old, new = steps["traditional"], steps["improved"]
    ratio = None if not (old and new) else old / new
    printed = REGISTRY.printed("xue.claim_times")
    labels = "as printed" if exchange == "trap_column" else "exchanged"
    printed_ratio = float(printed["traditional"]) / float(printed["improved"])
    return Result(
        obtained={
            "mean_steps": steps,
            "step_ratio": ratio,
            "printed_ratio": printed_ratio if exchange == "trap_column" else 1.0 / printed_ratio,
        },
        measured={} if trials is None else _milliseconds(Case.of(assumed), assumed),
        caption=(
            f"Over {timed} runs the traditional method makes {_number(old)} steps on average and "
            f"the improved one {_number(new)}. With the labels {labels} the printed times have a "
            f"ratio of {printed_ratio:.2f}. A run that ends in a trap adds the steps of the trap "
            "detection, so the order follows from what is counted as a planning time, which is "
            "not printed."
        ),
    )


def printed_counts() -> dict[str, str]:
    """The trap column of Table 2 by row, as printed."""
    printed = REGISTRY.printed("xue.tab02")
    return {name: printed[name]["trapped"] for name in TEXT}


def _counts(trials: Trials | None) -> dict[str, Any]:
    if trials is None:
        return {"missed": {"traditional": None, "improved": None}}
    return {
        "missed": {name: getattr(trials, name).missed for name in TEXT},
        "trapped": {name: getattr(trials, name).trapped for name in TEXT},
        "stationary": {name: getattr(trials, name).stationary for name in TEXT},
        "held": {name: getattr(trials, name).held for name in TEXT},
        "virtual_point_used": trials.improved.used,
        "intervals": {name: list(wilson(getattr(trials, name).missed, TRIALS)) for name in TEXT},
    }


def _steps(trials: Trials | None, timed: str) -> dict[str, float | None]:
    field = "steps_reached" if timed == "successful" else "steps_all"
    return {
        name: None
        if trials is None or np.isnan(getattr(getattr(trials, name), field))
        else getattr(getattr(trials, name), field)
        for name in TEXT
    }


def _milliseconds(case: Case, assumed: Assumed) -> dict[str, float]:
    """Mean time per run, planning only, best of some repeats [ms]."""
    placed, obstacles = placed_slave(case.layout), slave_obstacles(case)
    rng = np.random.default_rng(assumed["trial_seed"])
    begin = starts(case, assumed["trial_perturbation"], TRIALS, rng)
    found = {}
    for name in TEXT:
        settings, best = METHODS[name].settings(case), np.inf
        for _ in range(_REPEATS):
            since = perf_counter()
            plan_batch(placed, begin, placed.goal, obstacles, settings)
            best = min(best, perf_counter() - since)
        found[f"ms_per_run_{name}"] = 1e3 * best / TRIALS
    return found


def _sentence(trials: Trials | None) -> str:
    if trials is None:
        return "In this arrangement there is nothing to plan."
    return (
        f"In the arrangement shown {trials.traditional.missed} of {TRIALS} traditional and "
        f"{trials.improved.missed} of {TRIALS} improved runs miss the goal."
    )


def _percent(found: Share) -> str:
    return f"{found.value:.1%} (95 % interval {found.low:.1%} to {found.high:.1%})"


def _likelier(text: Share, table: Share) -> str:
    """What the lottery says between the two readings."""
    if text.low > table.high:
        return "The text's reading is the likelier one."
    if table.low > text.high:
        return "The table's reading is the likelier one."
    return "The intervals overlap: the lottery does not tell the two readings apart."


def _named(shares: Mapping[str, Mapping[str, Share]]) -> dict[str, dict[str, Share]]:
    """Shares by rule and method under the titles of both."""
    return {
        rule.replace("_", " "): {METHODS[name].title: share for name, share in row.items()}
        for rule, row in shares.items()
    }


def _certified(trials: Trials | None) -> str:
    """How many of the runs called trapped are proved to be, for a caption."""
    if trials is None:
        return ""
    found = trials.traditional
    return (
        f"Of {found.trapped} that stand still {found.stationary} are certified to do so where the "
        f"gradient vanishes (|dU/dq| at most {found.gradient:.1e}), and {found.held} stay there "
        f"after pushes of {PUSH:g} rad: the others rest on a saddle. "
    )


def _number(value: float | None) -> str:
    return "no" if value is None else f"{value:.0f}"


def _trial_table(trials: Trials | None) -> pd.DataFrame | None:
    if trials is None:
        return None
    table, rows = printed_counts(), []
    for name in TEXT:
        found = getattr(trials, name)
        low, high = wilson(found.missed, found.runs)
        readings = {"text": TEXT[name], "table": table[name]}
        interval = {"missed_low": low, "missed_high": high}
        rows.append({"method": name, **readings, **found._asdict(), **interval})
    return pd.DataFrame(rows)


def _lottery_figure(reading: str) -> Any:
    counts = np.zeros((TRIALS + 1, TRIALS + 1), dtype=int)
    np.add.at(counts, (missed(reading), missed("improved")), 1)
    return count_grid_figure(
        counts,
        "improved runs of 10 that miss",
        "traditional runs of 10 that miss",
        tuple(int(TEXT[name]) for name in ("traditional", "improved")),
    )
