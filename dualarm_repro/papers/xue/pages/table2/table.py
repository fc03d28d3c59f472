"""Table 2 of `xue` and what the text says about it: trapped runs, steps and times."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from .....errors import InputError
from .....ledger import REGISTRY, Assumed, Bounded, Exceeds, Is, Result, Role, Rounds
from .....ledger.captions import captions
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
caption = captions(__file__)

MISS_LABEL = "share of trials that miss the goal"
#: Assumptions about the trials: reading of the traditional method, variation of starts, seed.
TRIAL_SETTINGS = ("classical_method", "trial_perturbation", "trial_seed")


class Trials(NamedTuple):
    """Ten runs of both methods from the same starts."""

    traditional: Outcome
    improved: Outcome


@memo(512)
def trials_of(case: Case, reading: str, half_width: float, seed: int) -> Trials | None:
    """Ten seeded trials; None where the slave has nothing to plan in this arrangement."""
    if slave_obstacles(case) is None:
        return None
    begin, old = starts(case, half_width, TRIALS, np.random.default_rng(seed)), variant_of(reading)
    try:
        runs = run_variants(case, (old, "without_virtual", "improved"), begin)
    except InputError:  # the unperturbed start touches an obstacle
        return None
    return Trials(*(summary(case, method, runs[method]) for method in (old, "improved")))


def assumed_trials(assumed: Assumed) -> Trials | None:
    """The trials that the assumptions describe."""
    return trials_of(Case.of(assumed), *(assumed[name] for name in TRIAL_SETTINGS))


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
    rows, words, many = table_counts(), text_counts(), stored.repeated_shares()
    difference = shown["text"].astype(float) - shown["table"]
    return Result(
        obtained={
            "reading_of_table": rows,
            "reading_of_text": words,
            "rows_agree_with_text": rows == words,
            **_counts(trials),
            "text_less_table": stored.mean_with_interval(difference),
            "many_trials": {rule: _plain(methods) for rule, methods in many.items()},
            "lottery": _plain(shares),
            "lottery_mean_missed": {
                name: float(stored.missed(name).mean()) for name in (reading, "improved")
            },
        },
        table=_trial_table(trials),
        caption=caption("tab02", trials=trials, runs=TRIALS),
        alt="Bars with intervals: share of trials that miss, per method and rule of the joint "
        "step.",
        figure=lambda: shares_figure(_named(many), MISS_LABEL, _printed_mark()),
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
    arrived = None if trials is None else TRIALS - trials.improved.missed
    return Result(
        obtained={
            "trials": TRIALS,
            "successes": "all" if arrived == TRIALS else arrived,
            **_counts(trials),
            "lottery": found._asdict(),
            "virtual_point": stored.virtual_point_counts(),
        },
        caption=caption("claim_success_10", trials=trials, runs=TRIALS),
        alt="Bars with intervals: share of trials that miss the goal, for nine variants of the "
        "method.",
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
    values = {"many": max(text_counts().values()), "push": PUSH, "witnesses": witnesses}
    left = stored.held_share(variant_of(reading))
    return Result(
        obtained={
            "trials": TRIALS,
            **_counts(trials),
            "unproved": None if old is None else old.trapped - old.stationary,
            "largest_gradient": None if old is None else old.gradient,
            "lottery": found._asdict(),
        },
        caption=caption("claim_trapped_8", trials=trials, runs=TRIALS, left=left, **values),
        alt="Grid of counts: traditional runs that miss over improved runs that miss, per random "
        "arrangement; the printed pair is framed.",
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
    held = {name: stored.held(one) for name, one in methods.items()}
    missed = {name: stored.missed(one) for name, one in methods.items()}
    shown = (
        stored.is_declared(table)
        & (held["traditional"] == words["traditional"])
        & (missed["traditional"] == words["traditional"])
        & (missed["improved"] == words["improved"])
        & (table[f"{name}_stationary"] == table[f"{name}_trapped"]).to_numpy()
    )
    for k in np.flatnonzero(shown):
        seen = {"held": held, "missed": missed}
        judged = {key: {m: int(v[k]) for m, v in found.items()} for key, found in seen.items()}
        return [stored.choice(int(k), "holds", **judged)]
    return []


def _counts(trials: Trials | None) -> dict[str, Any]:
    if trials is None:
        nothing = dict.fromkeys(METHODS_OF_TABLE_2)
        return {"missed": nothing, "held": nothing}
    found = trials._asdict()
    return {
        **{
            field: {name: getattr(one, field) for name, one in found.items()}
            for field in ("missed", "trapped", "stationary", "held")
        },
        "virtual_point_used": trials.improved.used,
        "intervals": {k: list(Share.of(one.missed, TRIALS)[1:]) for k, one in found.items()},
    }


def _printed_mark() -> tuple[float, str]:
    """Where the text's count of trapped runs lies among the shares, and its name."""
    trapped = text_counts()["traditional"]
    return trapped / TRIALS, f"printed in the text: {trapped} of {TRIALS}"


def _plain(shares: Mapping[str, Share]) -> dict[str, dict[str, float]]:
    return {name: share._asdict() for name, share in shares.items()}


def _named(shares: Mapping[str, Mapping[str, Share]]) -> dict[str, dict[str, Share]]:
    """Shares by rule and method under the titles of both."""
    return {
        rule.replace("_", " "): {VARIANTS[name].title: share for name, share in row.items()}
        for rule, row in shares.items()
    }


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
    marked = text_counts()["traditional"], text_counts()["improved"]
    labels = ("improved runs of 10 that miss", "traditional runs of 10 that miss")
    return count_grid_figure(counts, *labels, marked)
