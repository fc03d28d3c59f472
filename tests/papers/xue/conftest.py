"""Print with changes, to see verdicts follow it."""

from collections.abc import Callable, Iterator
from contextlib import ExitStack
from typing import Any

import pytest

from dualarm_repro.ledger import Registry


@pytest.fixture
def reprint(registry: Registry) -> Iterator[Callable[..., None]]:
    """Replace parts of what an item prints, until the test is over."""
    with ExitStack() as changes:

        def change(item: str, **printed: Any) -> None:
            name = f"xue.{item}"
            changed = {**registry.printed(name), **printed}
            changes.enter_context(registry.with_printed(name, changed))

        yield change
