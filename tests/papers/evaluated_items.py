"""Items evaluated once a process, whoever asks; what a test changes it evaluates itself."""

import os
import sys
from functools import cache
from pathlib import Path

from long_tests import long_where

from dualarm_repro.datafiles import data_root
from dualarm_repro.ledger import evaluate, prove
from dualarm_repro.ledger.reference import read_costs
from dualarm_repro.papers import load
from dualarm_repro.tracking import recording

REGISTRY = load()
ATTEMPTED = sorted(REGISTRY.checkers)
#: Beyond this processor time [s] an item is computed in the long form only, and by the book.
SOON = 1.0
#: Files that this process opens, whichever way.
OPENED = set()
#: Data files that an item opened without saying so.
READ = {}
#: What each item noted that it reads.
NOTED = {}


def is_dear(item_id):
    """Whether an item, or one of the statements that it rests on, takes long."""
    ids = (item_id, *REGISTRY.look(item_id).statements)
    return any(read_costs().get(one, 0.0) > SOON for one in ids)


def tried(item_ids):
    """Items as parameters of a test."""
    return long_where(is_dear, item_ids)


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


@cache
def proved(erratum_id):
    """The proof of an erratum, run once."""
    return prove(REGISTRY, erratum_id)
