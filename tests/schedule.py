"""Which tests share a worker, and which start first.

Tests of a file share what its fixtures build, so they stay together; so do those of several files
that build the same. A file whose tests share nothing may be torn apart. What takes longest starts
first, so that no worker is left alone with it at the end.
"""

import re

from xdist.scheduler import LoadScopeScheduling

#: Files whose tests share the evaluations of a document, which the name of the test names first.
BY_DOCUMENT = (
    "tests/papers/test_ledger_of_papers.py",
    "tests/papers/test_statistics.py",
    "tests/papers/test_trust.py",
)
#: Documents whose own tests share these evaluations as well; those of patent would take too long.
SHARING = re.compile(r"tests/papers/(pan|qiu|xue)/")
#: Files whose tests share what the command line exports.
REPLAYED = "tests/replay/"
#: Processor time of what takes longest [s], by the beginning of its group; it need not be exact.
COSTS = {
    "items of patent": 100,
    "tests/ledger/test_closure.py": 60,
    "tests/book/test_chapters_of_programs.py": 50,
    "tests/cli/test_plan_own_arms.py": 40,
    "tests/fuzz": 40,
    "items of": 60,
    "tests/replay": 35,
    "tests/papers/patent/test_room.py": 30,
    "tests/cli": 25,
    "tests/book/test_browser.py": 20,
    "tests/baselines/test_planners.py": 30,
    "tests/faults": 15,
    "tests/arms/codegen": 20,
    "tests/papers": 15,
    "tests/book": 15,
    "tests/arena": 10,
    "tests/examples": 10,
}


def group_of(nodeid: str) -> str:
    """The tests that run on one worker, one after another."""
    file, _, test = nodeid.partition("::")
    if file in BY_DOCUMENT and (named := re.search(r"\[(?:\d+-)?([a-z]+)[\].-]", test)):
        return f"items of {named[1]}"
    if named := SHARING.match(file):
        return f"items of {named[1]}"
    if file.startswith(REPLAYED):
        return REPLAYED
    return file


def cost_of(group: str) -> int:
    """What a group takes, as far as it is known [s]."""
    return max((cost for name, cost in COSTS.items() if group.startswith(name)), default=0)


def order_of(nodeid: str) -> tuple[int, bool]:
    """What is sorted by: the dearest group first; in it, while no item has been computed, what
    looks at how each is."""
    return -cost_of(group_of(nodeid)), nodeid.partition("::")[0] not in BY_DOCUMENT


class DearestFirst(LoadScopeScheduling):
    """Groups in the order in which they were collected, which :func:`order_of` has sorted."""

    def _split_scope(self, nodeid: str) -> str:
        return group_of(nodeid)
