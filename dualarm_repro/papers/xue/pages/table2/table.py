"""Table 2 of `xue` and what the text says about it: trapped runs, steps and times."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from .....errors import InputError
from .....ledger import REGISTRY, Assumed, Bounded, Exceeds, Is, Result, Role, Rounds
from .....ledger.shares import Share
from .....planning.trials.stuck import PUSH
from .....tracking import memo
from .....view.shares import count_grid_figure, shares_figure
from ... import stored
from ...document import METHODS_OF_TABLE_2, table_counts, text_counts
from ...motions import slave_obstacles
from ...outcomes import TRIALS, VARIANTS, Outcome, run_variants, starts, summary, variant_of
from ...reading import Case

checks = partial(REGISTRY.checks, page="xue/table2")

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
    old = variant_of(reading)
    try:
        runs = run_variants(case, (old, "without_virtual", "improved"), begin)
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
        Rounds(
            "held.traditional",
            "traditional runs of 10 held in a trap, against the entry of the other row",
            to="improved.trapped",
        ),
        Rounds(
            "held.improved",
            "improved runs of 10 held in a trap, against the entry of the other row",
            to="traditional.trapped",
        ),
        Rounds(
            "missed.traditional",
            "traditional runs of 10 that do not arrive, against the same",
            to="improved.trapped",
        ),
        Exceeds(
            "text_less_table",
            "share of random arrangements with the text's outcome less that with the table's",
        ),
        Is(
            "rows_agree_with_text",
            "the rows of the table say what the text says",
            value=False,
            role=Role.CONTRADICTS,
        ),
    ],
    samples=32,
)
def both_methods(assumed: Assumed) -> Result:
    """Both readings of the print against ten trials, many trials and the lottery."""
    trials, reading = assumed_trials(assumed), assumed["classical_method"]
    shares, shown = stored.lottery_shares(reading), stored.outcomes_of_table_2(reading)
    difference = stored.mean_with_interval(shown["text"].astype(float) - shown["table"])
    rows, words, many = table_counts(), text_counts(), stored.repeated_shares()
    return Result(
        obtained={
            "reading_of_table": rows,
            "reading_of_text": words,
            "rows_agree_with_text": rows == words,
            **_counts(trials),
            "text_less_table": difference,
            "many_trials": {
                rule: {name: found._asdict() for name, found in methods.items()}
                for rule, methods in many.items()
            },
            "lottery": {name: found._asdict() for name, found in shares.items()},
            "lottery_mean_missed": {
                name: float(stored.missed(name).mean()) for name in (reading, "improved")
            },
        },
        table=_trial_table(trials),
        caption=(
            f"The rows print {rows['improved']} traps for the improved and {rows['traditional']} "
            f"for the traditional method, the text {words['improved']} and "
            f"{words['traditional']}. {_sentence(trials)} Over random arrangements in which Fig. 9 "
            f"holds, the outcome of the text (at least {max(words.values())} traditional runs held "
            f"in a trap, no improved run missed) shows in {_percent(shares['text'])}, that of the "
            f"table in {_percent(shares['table'])}. {_likelier(difference)}"
        ),
        alt=(
            "Bars with intervals: share of trials that miss, per method and rule of the joint step."
        ),
        figure=lambda: shares_figure(_named(many), MISS_LABEL),
    )


@checks(
    "xue.claim_success_10",
    rules=[
        Is("trials", "number of runs", to="trials"),
        Is("successes", "improved runs that arrive", to="successes"),
    ],
    samples=32,
)
def improved_succeeds(assumed: Assumed) -> Result:
    """Ten runs of the improved method, and the same over random arrangements."""
    trials = assumed_trials(assumed)
    found = stored.lottery_shares(assumed["classical_method"])["improved_never_missed"]
    virtual = stored.virtual_point_counts()
    arrived = None if trials is None else TRIALS - trials.improved.missed
    return Result(
        obtained={
            "trials": TRIALS,
            "successes": "all" if arrived == TRIALS else arrived,
            **_counts(trials),
            "lottery": found._asdict(),
            "virtual_point": virtual,
        },
        caption=(
            f"{_sentence(trials)} Over random arrangements in which Fig. 9 holds all ten improved "
            f"runs succeed in {_percent(found)}. "
            f"In {virtual['used']} of {virtual['runs']} runs there the virtual point acted, in "
            f"{virtual['rescued']} of these the goal was then reached."
        ),
        alt=(
            "Bars with intervals: share of trials that miss the goal, for nine variants of the "
            "method."
        ),
        figure=lambda: shares_figure(stored.ablation_shares(), MISS_LABEL),
    )


@checks(
    "xue.claim_trapped_8",
    rules=[
        Is("trials", "number of runs", to="trials"),
        Rounds(
            "held.traditional",
            "traditional runs that stand still and stay after small pushes",
            to="trapped",
        ),
        Rounds("missed.traditional", "traditional runs that do not arrive", to="trapped"),
        Bounded("unproved", "runs called trapped whose gradient does not vanish", high=0),
    ],
    samples=32,
)
def traditional_trapped(assumed: Assumed) -> Result:
    """Ten runs of the traditional method, and the same over random arrangements."""
    trials, reading = assumed_trials(assumed), assumed["classical_method"]
    found = stored.lottery_shares(reading)["traditional_mostly_held"]
    old = None if trials is None else trials.traditional
    witnesses = trapped_witnesses(reading)
    shown = (
        f" One that shows just what the text says is {witnesses[0]['choice']}." if witnesses else ""
    )
    return Result(
        obtained={
            "trials": TRIALS,
            **_counts(trials),
            "unproved": None if old is None else old.trapped - old.stationary,
            "largest_gradient": None if old is None else old.gradient,
            "lottery": found._asdict(),
        },
        caption=(
            f"{_sentence(trials)} {_certified(trials)}"
            f"Over random arrangements at least {max(text_counts().values())} of 10 are held in "
            f"{_percent(found)}; of the traditional runs that stand still there pushes leave "
            f"{_percent(stored.held_share(variant_of(reading)))}.{shown}"
        ),
        alt=(
            "Grid of counts: traditional runs that miss over improved runs that miss, per random "
            "arrangement; the printed pair is framed."
        ),
        figure=lambda: _lottery_figure(reading),
        witnesses=witnesses,
    )


def trapped_witnesses(reading: str) -> list[dict[str, Any]]:
    """A declared arrangement of the lottery with the outcome of the text, if there is one.

    As many traditional runs as the text prints are held, all where the gradient vanishes, and no
    other is missed; no improved run misses.
    """
    table, words, name = stored.lottery_table(), text_counts(), variant_of(reading)
    methods = {"traditional": reading, "improved": "improved"}
    shown = (
        stored.is_declared(table)
        & (stored.held(reading) == words["traditional"])
        & (stored.missed(reading) == words["traditional"])
        & (stored.missed("improved") == words["improved"])
        & (table[f"{name}_stationary"] == table[f"{name}_trapped"]).to_numpy()
    )
    return [
        stored.choice(
            int(k),
            "holds",
            held={name: int(stored.held(one)[k]) for name, one in methods.items()},
            missed={name: int(stored.missed(one)[k]) for name, one in methods.items()},
        )
        for k in np.flatnonzero(shown)[:1]
    ]


def _counts(trials: Trials | None) -> dict[str, Any]:
    if trials is None:
        nothing = dict.fromkeys(METHODS_OF_TABLE_2)
        return {"missed": nothing, "held": nothing}
    return {
        **{
            field: {name: getattr(found, field) for name, found in trials._asdict().items()}
            for field in ("missed", "trapped", "stationary", "held")
        },
        "virtual_point_used": trials.improved.used,
        "intervals": {
            name: list(Share.of(found.missed, TRIALS)[1:])
            for name, found in trials._asdict().items()
        },
    }


def _sentence(trials: Trials | None) -> str:
    if trials is None:
        return "In this arrangement there is nothing to plan."
    return (
        f"In the arrangement shown {trials.traditional.missed} of {TRIALS} traditional and "
        f"{trials.improved.missed} of {TRIALS} improved runs miss the goal."
    )


def _percent(found: Share) -> str:
    return f"{found.value:.1%} (95 % interval {found.low:.1%} to {found.high:.1%})"


def _likelier(difference: Mapping[str, float]) -> str:
    """What the lottery says between the two readings."""
    if difference["low"] > 0.0:
        return "The text's reading is the likelier one."
    if difference["high"] < 0.0:
        return "The table's reading is the likelier one."
    return (
        f"The difference, {100 * difference['value']:.1f} points (95 % interval "
        f"{100 * difference['low']:.1f} to {100 * difference['high']:.1f}), does not tell the two "
        "readings apart."
    )


def _named(shares: Mapping[str, Mapping[str, Share]]) -> dict[str, dict[str, Share]]:
    """Shares by rule and method under the titles of both."""
    return {
        rule.replace("_", " "): {VARIANTS[name].title: share for name, share in row.items()}
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
        f"after pushes of {PUSH:g} rad"
        + (": the others rest on a saddle. " if found.held < found.trapped else ". ")
    )


def _trial_table(trials: Trials | None) -> pd.DataFrame | None:
    if trials is None:
        return None
    table, words, rows = table_counts(), text_counts(), []
    for name, found in trials._asdict().items():
        _, low, high = Share.of(found.missed, found.runs)
        seconds = REGISTRY.printed("xue.tab02")[name]["mean_time"]
        readings = {"text": words[name], "table": table[name], "printed_time_s": float(seconds)}
        interval = {"missed_low": low, "missed_high": high}
        rows.append({"method": name, **readings, **found._asdict(), **interval})
    return pd.DataFrame(rows)


def _lottery_figure(reading: str) -> Any:
    counts = np.zeros((TRIALS + 1, TRIALS + 1), dtype=int)
    np.add.at(counts, (stored.missed(reading), stored.missed("improved")), 1)
    return count_grid_figure(
        counts,
        "improved runs of 10 that miss",
        "traditional runs of 10 that miss",
        tuple(text_counts()[name] for name in METHODS_OF_TABLE_2),
    )
