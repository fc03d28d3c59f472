"""Items evaluated once a process, whoever asks; what a test changes it evaluates itself."""

import os
import sys
from functools import cache
from pathlib import Path

from dualarm_repro.datafiles import data_root
from dualarm_repro.ledger import evaluate
from dualarm_repro.papers import load
from dualarm_repro.tracking import recording

REGISTRY = load()
ATTEMPTED = sorted(REGISTRY.checkers)
#: Files that this process opens, whichever way.
OPENED = set()
#: Data files that an item opened without saying so.
READ = {}
#: What each item noted that it reads.
NOTED = {}


def _listen(event, arguments):
    if event == "open" and isinstance(arguments[0], str | os.PathLike):
        OPENED.add(os.fspath(arguments[0]))


sys.addaudithook(_listen)


@cache
def evaluated(item_id):
    """An item at its declared values."""
    OPENED.clear()
    with recording() as noted:
        evaluation = evaluate(REGISTRY, item_id)
    opened = {Path(name) for name in OPENED if Path(name).is_relative_to(data_root())}
    files = {path.relative_to(data_root()).as_posix() for path in opened if path.is_file()}
    READ[item_id] = files - {name.partition("#")[0] for name in noted}
    NOTED[item_id] = frozenset(noted)
    return evaluation
