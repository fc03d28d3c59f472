"""The stored table of public arms for the reader: counts, loading, self-collision, refusals."""

from __future__ import annotations

import pandas as pd

from .cell_table import table
from .page import Page
from .public_arms import PUBLIC_ARMS, summary

_WHOLE = "{:.0f}"


def counts_page() -> Page:
    """How many of the files do what.

    Raises
    ------
    DataFileError, LedgerError
        Nothing is stored, or it is stale; ``make arms`` computes it.
    """
    found = summary(PUBLIC_ARMS.load())
    return table(pd.DataFrame({"": list(found), "files": list(found.values())}))


def loading_page() -> Page:
    """What each file that loads becomes; raises as :func:`counts_page`."""
    rows = _loaded()
    shown = {
        "file": _names(rows),
        "joints": rows["joints"],
        "flange": [_breaking(name) for name in rows["flange"]],
        "FK exact": rows["exact"].astype(bool),
        "shapes": rows["shapes"],
        "capsules": rows["capsules"],
        "inside": rows["contained"].astype(bool),
        "excess": rows["excess"],
        "first load [s]": rows["seconds"],
    }
    whole = dict.fromkeys(("joints", "shapes", "capsules"), _WHOLE)
    return table(pd.DataFrame(shown), {**whole, "excess": "{:.2f}", "first load [s]": "{:.1f}"})


def contact_page() -> Page:
    """Self-collision of each file that loads, and a plan for two; raises as :func:`counts_page`."""
    rows = _loaded()
    shown = {
        "file": _names(rows),
        "home": [
            "touches" if not clear else "refused" if flagged else "accepted"
            for clear, flagged in zip(rows["home_clear"], rows["home_flagged"], strict=True)
        ],
        "clear": rows["clear"],
        "false alarms [%]": 100.0 * rows["false_alarms"] / rows["clear"].clip(lower=1),
        "missed": rows["missed"],
        "left out": rows["excluded"],
        "plan": rows["pair_reason"],
        "apart [m]": rows["pair_apart"],
        "report [mm]": 1e3 * rows["pair_lower"].astype(float),
        "meshes [mm]": 1e3 * rows["pair_meshes"].astype(float),
    }
    whole = dict.fromkeys(("clear", "missed", "left out"), _WHOLE)
    tenth = dict.fromkeys(("false alarms [%]", "report [mm]", "meshes [mm]"), "{:.1f}")
    return table(pd.DataFrame(shown), {**whole, **tenth, "apart [m]": "{:.2f}"})


def refused_page() -> Page:
    """What is said of each file that does not load; raises as :func:`counts_page`."""
    rows = PUBLIC_ARMS.load()
    rows = rows[~rows["loads"].astype(bool)].reset_index(drop=True)
    said = table(pd.DataFrame({"file": _names(rows), "said": rows["said"].str.partition(": ")[2]}))
    return Page(f'<div class="refused-files">{said.html}</div>')


def _loaded() -> pd.DataFrame:
    rows = PUBLIC_ARMS.load()
    return rows[rows["loads"].astype(bool)].reset_index(drop=True)


def _names(rows: pd.DataFrame) -> list[str]:
    return [_breaking(file.rpartition("/")[2].removesuffix(".urdf")) for file in rows["file"]]


def _breaking(name: str) -> str:
    """A long name, which may go on in the next line after an underscore."""
    return name.replace("_", "_\u200b")
