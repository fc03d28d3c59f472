"""What a shell offers after a Tab: ids, documents, assumptions, studies, planners."""

from __future__ import annotations

import os

#: Environment variables in which the shells hand over what was typed.
_LINE = ("COMP_WORDS", "_TYPER_COMPLETE_ARGS")


def item_ids(incomplete: str) -> list[str]:
    """Ids of the items, from the inventory, which is read in no time."""
    from ..datafiles import data_path

    lines = data_path("papers", "inventory.csv").read_text(encoding="utf-8").splitlines()[1:]
    return [line.partition(",")[0] for line in lines if line.startswith(incomplete)]


def papers(incomplete: str) -> list[str]:
    """Ids of the documents."""
    return sorted({item_id.partition(".")[0] for item_id in item_ids(incomplete)})


def assumptions(incomplete: str) -> list[str]:
    """``name=`` for every assumption of the items that were named before."""
    from ..papers import load

    line = next((os.environ[name] for name in _LINE if name in os.environ), "")
    names: list[str] = []
    for item_id in set(line.split()) & set(item_ids("")):
        item = load().item(item_id)
        names += [f"{name}=" for name in (*item.assumptions, *item.context)]
    return sorted({name for name in names if name.startswith(incomplete)})


def studies(incomplete: str) -> list[str]:
    """Names of what is stored."""
    from ..datafiles import data_path

    root = data_path("results")
    found = (path.relative_to(root).with_suffix("") for path in root.rglob("*.parquet"))
    return sorted(name for name in map(str, found) if name.startswith(incomplete))


def methods(incomplete: str) -> list[str]:
    """Names of the planners."""
    from ..baselines.registry import enlist

    return [name for name in enlist() if name.startswith(incomplete)]
