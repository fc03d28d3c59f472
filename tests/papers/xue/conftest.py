"""Print with changes, to see verdicts follow it."""

from collections.abc import Callable, Iterator
from typing import Any

import pytest

from dualarm_repro.ledger import Registry
from dualarm_repro.papers.xue.pages.kinematics import chain, printed_chain

_MEMOS = (printed_chain.link_matrix, printed_chain.general_matrix, chain.symbolic_pose)


@pytest.fixture
def reprint(registry: Registry) -> Iterator[Callable[..., None]]:
    """Replace parts of what an item prints, until the test is over."""
    kept = registry.papers["xue"]

    def change(item: str, **printed: Any) -> None:
        paper = registry.papers["xue"]
        found = paper.items[item]
        changed = found.model_copy(update={"printed": {**found.printed, **printed}})
        registry._papers["xue"] = paper.model_copy(update={"items": {**paper.items, item: changed}})
        _forget()

    yield change
    registry._papers["xue"] = kept
    _forget()


def _forget() -> None:
    for memo in _MEMOS:
        memo.cache_clear()
